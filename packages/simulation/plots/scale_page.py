# The page of run_scale. Argument: its directory.
import json

directory = sys.argv[1]
with open(os.path.join(directory, "scale.json"), encoding="utf-8") as file:
    scale = json.load(file)
points = scale["points"]
series = [name for name in ("strong", "weak") if any(point["series"] == name for point in points)]


def of(name):
    return [point for point in points if point["series"] == name]


def value(number, digits=3):
    return "–" if number is None else f"{number:.{digits}g}"


def efficiencies(name):
    """Of the whole and of each phase that takes a percent of the time on one rank, beside the memory's."""
    figure, axes = plt.subplots(figsize=(4.8, 3.6))
    finished = [point for point in of(name) if point["finished"]]
    axes.plot([p["ranks"] for p in of(name) if p["bandwidth_efficiency"] is not None],
              [p["bandwidth_efficiency"] for p in of(name) if p["bandwidth_efficiency"] is not None],
              color="#AAAAAA", linewidth=5, linestyle="-", alpha=0.6, label="memory bandwidth")
    axes.plot([p["ranks"] for p in finished], [p["efficiency"] for p in finished], color="#000000", linestyle="-", marker="o", label="whole run")
    shown = [phase for phase in scale["phases"] if finished and finished[0]["phases"][phase]["seconds"] > 0.01 * finished[0]["seconds"]]
    for index, phase in enumerate(shown):
        known = [(p["ranks"], p["phases"][phase]["efficiency"]) for p in finished if p["phases"][phase]["efficiency"] is not None]
        axes.plot(*zip(*known), color=COLOURS[index % len(COLOURS)], linestyle=DASHES[index % len(DASHES)], marker=".", label=phase)
    axes.axhline(1.0, color="#555555", linewidth=0.7, linestyle=":")
    axes.set_xscale("log", base=2)
    axes.set_xticks([p["ranks"] for p in of(name)], [str(p["ranks"]) for p in of(name)])
    axes.set_ylim(bottom=0)
    axes.set_xlabel("ranks")
    axes.set_ylabel("efficiency")
    axes.set_title(f"{name} scaling")
    axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
    return figure


def table(name):
    head = ["ranks", "unknowns", "Newton", "linear", "memory / MiB", "s", "efficiency", "GB/s", "memory's efficiency"]
    rows = [[str(p["ranks"]), *([value(p["dofs"], 9), value(p["newton_iterations"], 9), value(p["linear_iterations"], 9), value(p["memory_mib"], 4),
                                 value(p["seconds"], 4), value(p["efficiency"])] if p["finished"] else ["<b>failed</b>", *["–"] * 5]),
             value(p["bandwidth_gb_s"]), value(p["bandwidth_efficiency"])] for p in of(name)]
    return html_table(head, rows, f"{name} series: whole runs")


def phases(name):
    finished = [point for point in of(name) if point["finished"]]
    rows = [[escaped(phase), *[f"{value(p['phases'][phase]['seconds'])} ({value(p['phases'][phase]['efficiency'], 2)})" for p in finished]]
            for phase in scale["phases"]]
    return html_table(["phase", *[f"{p['ranks']} rank(s)" for p in finished]], rows, f"{name} series: seconds (efficiency) of each phase")


MEANING = {"strong": "The same scene on growing numbers of ranks: efficiency t<sub>1</sub> / (p t<sub>p</sub>).",
           "weak": "The scene grows with the ranks: efficiency t<sub>1</sub> / t<sub>p</sub>, for the same number of unknowns per rank."}
parts = [paragraph(f"Scene <code>{escaped(scale['scene'])}</code>, Mortise {escaped(scale['version'])}; the fastest of {scale['repeats']} run(s), times "
                   "are means over the ranks. Phases that stream matrices through memory, the solution above all, cannot use ranks better than the "
                   "memory serves them: its efficiency was measured on this machine beforehand, by a triad on as many processes.")]
for name in series:
    image = svg(efficiencies(name))
    with open(os.path.join(directory, "scale.svg" if name == "strong" else "scale_weak.svg"), "wb") as file:
        file.write(image)
    parts += [f"<section><h2>{name.capitalize()} scaling</h2>", paragraph(MEANING[name]),
              html_image(image, f"{name.capitalize()} scaling", "efficiency of the run and its phases, beside that of the memory alone"), table(name),
              phases(name), "</section>"]
failed = [point for point in points if not point["finished"]]
parts += ["<section><h2>What failed</h2>", *([] if failed else [paragraph("All runs came to their end.")]),
          *[f'<div class="failed"><b>{p["series"]}, {p["ranks"]} rank(s)</b><pre>{escaped(p["said"])}</pre></div>' for p in failed], "</section>"]
write_page(os.path.join(directory, "report.html"), html_page(f"Scaling of {os.path.basename(scale['scene'])}", parts))
