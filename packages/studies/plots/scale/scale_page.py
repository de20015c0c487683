# The page of run_scale. Argument: its directory.
import json

directory = sys.argv[1]
with open(os.path.join(directory, "scale.json"), encoding="utf-8") as file:
    scale = json.load(file)
points = scale["points"]
series = [name for name in ("strong", "weak") if any(point["series"] == name for point in points)]


def of(name):
    return [point for point in points if point["series"] == name]


def finished(name):
    return [point for point in of(name) if point["finished"]]


def times(name):
    """Seconds by phase, beside those of full efficiency."""
    found = finished(name)
    figure, axes = one_panel(f"wall time, {name} scaling")
    begin = np.zeros(len(found))
    for phase in scale["phases"]:
        _, colour, hatch = PHASES[phase]
        seconds = np.array([p["phases"][phase]["seconds"] for p in found])
        axes.bar(range(len(found)), seconds, bottom=begin, width=0.6, color=colour, hatch=hatch, edgecolor="white", linewidth=0.5, label=phase)
        begin += seconds
    ideal = [(i, p["seconds"] * p["efficiency"]) for i, p in enumerate(found) if p["efficiency"] is not None]
    for i, seconds in ideal:
        axes.plot([i - 0.4, i + 0.4], [seconds, seconds], color="black", linestyle="-", linewidth=2, label="efficiency of 1" if i == ideal[0][0] else None)
    axes.set_xticks(range(len(found)), [str(p["ranks"]) for p in found])
    axes.set_xlim(-0.6, len(found) - 0.4)
    axes.grid(False, axis="x")
    axes.set_xlabel("ranks")
    axes.set_ylabel("wall time / s")
    legend_below(axes, 2)
    return figure


def efficiencies(name):
    """Of the whole and of each phase that takes a percent of the time on one rank, beside the memory's."""
    figure, axes = one_panel(f"efficiency, {name} scaling")
    found = finished(name)
    curve = lambda key: zip(*[(p["ranks"], p[key]) for p in of(name) if p.get(key) is not None])
    if any(p["bandwidth_efficiency"] is not None for p in of(name)):
        axes.plot(*curve("bandwidth_efficiency"), color="#AAAAAA", linewidth=5, linestyle="-", alpha=0.6, label="memory bandwidth")
    if any(p["efficiency"] is not None for p in found):
        axes.plot(*curve("efficiency"), color="#000000", linestyle="-", marker="o", label="whole run")
    shown = [phase for phase in scale["phases"] if found and found[0]["phases"][phase]["seconds"] > 0.01 * found[0]["seconds"]]
    for index, phase in enumerate(shown):
        known_of = [(p["ranks"], p["phases"][phase]["efficiency"]) for p in found if p["phases"][phase]["efficiency"] is not None]
        if known_of:
            axes.plot(*zip(*known_of), color=PHASES[phase][1], linestyle=DASHES[index % len(DASHES)], marker=".", label=phase)
    axes.axhline(1.0, color="#555555", linewidth=0.7, linestyle=":")
    axes.set_xscale("log", base=2)
    axes.set_xticks([p["ranks"] for p in of(name)], [str(p["ranks"]) for p in of(name)])
    axes.set_ylim(bottom=0)
    axes.set_xlabel("ranks")
    axes.set_ylabel("efficiency")
    legend_below(axes, 2)
    return figure


def table(name):
    whole = lambda key, digits: [value(p.get(key), digits) for p in of(name)]
    columns = [("ranks", [str(p["ranks"]) for p in of(name)]), ("ended", ["well" if p["finished"] else f"<b>{p['state']}</b>" for p in of(name)]),
               ("unknowns", whole("dofs", 9)), ("Newton iterations", whole("newton_iterations", 9)), ("linear iterations", whole("linear_iterations", 9)),
               ("memory / MiB", whole("memory_mib", 3)), ("contact, largest over mean work", whole("contact_imbalance", 3)), ("wall / s", whole("seconds", 3)),
               ("middle repeat / s", [value(middle(p)) if p["finished"] else "–" for p in of(name)]),
               ("efficiency", whole("efficiency", 2)), ("memory bandwidth / (GB/s)", whole("bandwidth_gb_s", 3)),
               ("its efficiency", whole("bandwidth_efficiency", 2))]
    return column_table(columns, f"{name.capitalize()} scaling: whole runs", ["ended"])


def phases(name):
    found = finished(name)
    if not found:
        return ""
    rows = [[escaped(phase), *[f"{value(p['phases'][phase]['seconds'])} ({value(p['phases'][phase]['efficiency'], 2)})" for p in found]]
            for phase in scale["phases"]]
    heads = [f"{p['ranks']} rank{'s' if p['ranks'] > 1 else ''}" for p in found]
    return html_table(["phase", *heads], rows, f"{name.capitalize()} scaling: seconds (efficiency) of each phase")


def written(figure, name):
    image = svg(figure)
    with open(os.path.join(directory, name), "wb") as file:
        file.write(image)
    return image


MEANING = {"strong": "The same scene on growing numbers of ranks: efficiency t<sub>1</sub> / (p t<sub>p</sub>).",
           "weak": "The scene grows with the ranks: efficiency t<sub>1</sub> / t<sub>p</sub>, for the same number of unknowns per rank."}


def meaning(name):
    return growth_words(of(name)) or MEANING[name]


def scales(name):
    """True if there is an efficiency to draw, of more ranks than one or of the memory alone."""
    return len(not_grown(of(name))) < len(finished(name)) - 1 or not not_grown(of(name))


failed = [point for point in points if point["state"] == "failed"]
absent = [point for point in points if point["state"] in ("running", "waiting", "missing")]
parts = ['<section class="answer">', *[paragraph(*series_words(of(name))) for name in series]]
if failed:
    parts.append(paragraph(f"{len(failed)} of {len(points)} runs failed: see <i>What failed</i>."))
if absent:
    parts.append(paragraph(f"{len(absent)} of {len(points)} runs have not ended: "
                           + ", ".join(f"{p['series']} on {p['ranks']} rank(s) is {p['state']}" for p in absent) + "."))
parts.append("</section>")
if finished(series[0]):
    parts.append(figures([html_figure(times(series[0]), f"{series[0].capitalize()} scaling", "wall time by phase; the line is what full efficiency would take")]))
for name in series:
    images = []
    if scales(name):
        image = written(efficiencies(name), "scale.svg" if name == "strong" else "scale_weak.svg")
        images.append(html_image(image, f"{name.capitalize()} scaling", "efficiency of the run and its phases, beside that of the memory alone"))
    if name != series[0] and finished(name):
        images.append(html_figure(times(name), f"{name.capitalize()} scaling", "wall time by phase; the line is what full efficiency would take"))
    parts += [f"<section><h2>{name.capitalize()} scaling</h2>", paragraph(meaning(name)), figures(images), "</section>"]
parts += ["<section><h2>Tables</h2>", *[part for name in series for part in (table(name), phases(name))], "</section>"]
parts += ["<section><h2>What failed</h2>", *([] if failed else [paragraph("All runs came to their end." if not absent else "No run so far.")]),
          *[f'<div class="failed"><b>{p["series"]}, {p["ranks"]} rank(s)</b><pre class="said">{escaped(p["said"])}</pre></div>' for p in failed], "</section>"]
MEMORY = ("Phases that stream matrices through memory, the solution above all, cannot use ranks better than the memory serves them: its efficiency was "
          "measured on this machine beforehand, by a triad on as many processes.")
runs = [(f"{p['series']}, {p['ranks']} rank(s)", command(scale["launcher"], os.path.abspath(scale["scene"]), p["settings"], p["ranks"], f"again/{p['series']}_{p['ranks']}"))
        for p in points]
parts += ["<section><h2>How it was measured</h2>",
          paragraph(f"Scene <code>{escaped(scale['scene'])}</code>, Mortise {escaped(scale['version'])}; the fastest of {scale['repeats']} run(s), times "
                    f"are means over the ranks. {MEMORY if any(p['bandwidth_gb_s'] for p in points) else ''}"),
          html_commands(scale["program"], directory, runs), "</section>"]
write_page(os.path.join(directory, "report.html"), html_page(f"Scaling of {os.path.basename(scale['scene'])}", parts))
