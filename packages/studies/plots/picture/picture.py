# Draws a run. Argument: JSON with run, field, step, warp, view, profile, steps, output; null is the default.
import io
import json

INPUT, FILES = 2, 5  # exit codes of the program
FRAME_MS, LAST_MS = 200, 1500  # how long an animation shows a step, and the last one


def png(figure, path):
    figure.savefig(path, format="png", metadata={"Software": None})
    plt.close(figure)


def palette_of(colours, is_plane):
    """256 colours of a GIF: those of the bar, as lines and light darken them, and greys. One palette for all steps: colours do not flicker."""
    shades = (1, 0.45) if is_plane else (1, 0.9, 0.78, 0.4)
    bar = colours(np.linspace(colours.low, colours.high, 224 // len(shades)))
    every = np.concatenate([*[shade * bar for shade in shades], np.repeat(np.linspace(0, 1, 32)[:, None], 3, axis=1)])
    return np.rint(255 * every).astype(int)


def draw_steps(model, steps, layout, colours, labels, output):
    """A GIF, or a PNG of each step."""
    if not output.endswith(".gif"):
        for step in steps:
            write(f"{output[:-4]}-{step:06}.png", lambda path: png(picture_of(model, step, layout, colours, labels), path))
        return
    try:
        from PIL import Image
    except ImportError:
        raise mortise_results.FileProblem("an animation needs Pillow; please install python3-pil (Debian), or name the output .png for one picture of each "
                                          "step") from None
    frames, palette = [], Image.new("P", (1, 1))
    palette.putpalette(palette_of(colours, model.is_plane).ravel().tolist())
    for step in steps:
        buffer = io.BytesIO()
        png(picture_of(model, step, layout, colours, labels), buffer)
        frames.append(Image.open(buffer).convert("RGB").quantize(palette=palette, dither=Image.Dither.NONE))
    times = [FRAME_MS] * (len(frames) - 1) + [LAST_MS]
    write(output, lambda path: frames[0].save(path, format="GIF", save_all=True, append_images=frames[1:], duration=times, loop=0))


def write(path, save):
    """The file has its name when it is complete."""
    try:
        save(path + ".part")
        os.replace(path + ".part", path)
    except OSError as error:
        try:
            os.remove(path + ".part")
        except OSError:
            pass
        raise mortise_results.FileProblem(f"cannot write {path}: {error.strerror or error}") from None


def draw(run, wanted):
    """Draws, and returns what there is to say of it."""
    if wanted["profile"] is not None:
        figure, time = profile_figure(run, wanted["profile"], wanted["step"])
        write(wanted["output"], lambda path: png(figure, path))
        return f"contact \"{wanted['profile']}\" at t = {time:.6g}"
    every = run.steps
    last = wanted["step"] if wanted["step"] is not None or not every else every[-1]
    run.time(last)  # that there is such a step
    steps = every if wanted["steps"] else [last]
    field = DrawnField(run, wanted["field"], steps)
    model = Model(run, field, steps, wanted["warp"], wanted["view"])
    colours = field.colours((field.at(step) for step in steps), model.deforming)
    layout = Layout(*model.bounds(steps), model.is_plane)
    labels = ("r", "z") if run.kinematics == "axisymmetric" else ("x", "y")
    if wanted["steps"]:
        draw_steps(model, steps, layout, colours, labels, wanted["output"])
    else:
        write(wanted["output"], lambda path: png(picture_of(model, last, layout, colours, labels), path))
    said = f"{len(steps)} steps" if wanted["steps"] else f"step {last}, t = {run.time(last):.6g}"
    return f"{field.name} from {colours.low:.9g} to {colours.high:.9g}, {said}, displacements x {model.warp:.6g}"


if __name__ == "__main__":
    sys.stdout.reconfigure(encoding="utf-8", errors="backslashreplace")  # names may have letters that the locale lacks
    request = json.loads(sys.argv[1])
    try:
        print(draw(mortise_results.open(request["run"]), request))
    except mortise_results.UnknownName as error:
        print(error)
        sys.exit(INPUT)
    except mortise_results.FileProblem as error:
        print(error)
        sys.exit(FILES)
