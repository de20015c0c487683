# The page of a study.
def drawn(figure, stem, title, caption):
    """As a file of its own, and as part of the page."""
    image = svg(figure)
    with open(os.path.join(directory, "plots", stem + ".svg"), "wb") as file:
        file.write(image)
    return html_image(image, title, caption)


def stem(name):
    return "".join(one if one.isalnum() or one in "-_" else "_" for one in name)


def cell(value, digits=4):
    return "–" if value is None or not np.isfinite(value) else f"{value:.{digits}g}"


def all_points():
    axes = [axis["name"] for axis in study["axes"]]
    head = ["point", "status", *axes, "formulation", "element", "h", "unknowns", "steps", "Newton iterations", "wall / s", "CPU / s", "memory / MiB"]
    rows = []
    for point in points:
        state = escaped(point["status"])
        rows.append([escaped(point["label"]), state if point["finished"] else f"<b>{state}</b>", *map(escaped, point["labels"]),
                     escaped(point["formulation"]), escaped(point["element"]), cell(point["h"]), cell(point["dofs"], 9), cell(point["steps"], 9),
                     cell(point["newton_iterations"], 9), cell(point["wall_s"]), cell(point["cpu_s"]), cell(point["memory_mib"])])
    if study["finest"]:
        point = study["finest"]
        rows.append(["finest (reference)", escaped(point["status"]), *["–"] * len(axes), escaped(point["formulation"]), escaped(point["element"]), "–",
                     cell(point["dofs"], 9), cell(point["steps"], 9), cell(point["newton_iterations"], 9), cell(point["wall_s"]), cell(point["cpu_s"]),
                     cell(point["memory_mib"])])
    return html_table(head, rows, f"All points; times and memory are medians of {study['repeats']} run(s)")


def errors_of(error):
    rows = [[escaped(point["label"]), cell(value, 9), cell(reference, 9), cell(size, 3)]
            for point, value, reference, size in zip(points, error["value"], error["reference"], error["error"])]
    return html_table(["point", "value", "reference", "error"], rows, f"Errors of {escaped(error['name'])}")


def times_to(error):
    """When each curve reaches the errors that are aimed at, and how that compares with the first of the series."""
    heads = ["curve"]
    for target in error["targets"]:
        heads += [f"s to {percent(target['error'])}", "ratio"]
    rows = []
    for index, curve in enumerate(curves):
        row = [escaped(curve["name"])]
        for target in error["targets"]:
            one = target["curves"][index]
            row += ["not reached" if one["seconds"] is None else ("≤ " if one["at_most"] else "") + cell(one["seconds"], 3), cell(one["ratio"], 3)]
        rows.append(row)
    series = study["axes"][study["series"]]
    caption = (f"Wall time to an error of {escaped(error['name'])}, between points linear in the logarithms; ratio to "
               f"{escaped(series['name'])} = {escaped(series['values'][0])}. ≤: the coarsest point is that good already")
    return html_table(heads, rows, caption)


def section_of(error):
    parts = [f"<section><h2>Error of {escaped(error['name'])}</h2>"]
    if np.isfinite(array(error["error"])).any():
        name = stem(error["name"])
        parts += [drawn(error_against_h(error), "error_" + name, "Accuracy", f"error of {error['name']} against mesh size, with the fitted order"),
                  drawn(error_against_time(error), "time_" + name, "Cost", f"error of {error['name']} against wall time; grey: what no point beats")]
    if error["notes"]:
        parts.append("<ul>" + "".join(f"<li>{escaped(note)}</li>" for note in error["notes"]) + "</ul>")
    return [*parts, times_to(error), "<details><summary>Values</summary>", errors_of(error), "</details></section>"]


def failures():
    every = points + ([study["finest"]] if study["finest"] else [])
    failed = [point for point in every if not point["finished"]]
    missed = [f"<li>{escaped(point['label'])}: {escaped(one)}</li>" for point in every if point["finished"] for one in point["missed"]]
    parts = [] if failed else [paragraph("All points came to their end.")]
    if missed:
        parts += [paragraph("Checks of the scene that points missed:"), "<ul>", *missed, "</ul>"]
    said = lambda point: escaped(point["said"] or "It said nothing.")
    return parts + [f'<div class="failed"><b>{escaped(point["label"])}</b>: {escaped(point["status"])}<pre>{said(point)}</pre></div>'
            for point in failed]


def environment():
    here = study["environment"]
    rows = [["Mortise", escaped(here["version"])], ["processor", escaped("; ".join(here["processors"]))],
            ["first run", escaped(here["first_run"])], ["last run", escaped(here["last_run"])],
            ["scene", escaped(study["scene"])]]
    words = lambda point: escaped(" ".join("--set " + json.dumps(one, ensure_ascii=False) for one in point["settings"]))
    settings = [[escaped(point["label"]), str(point["ranks"]), f"<code>{words(point)}</code>"] for point in points]
    return [html_table(["", ""], rows, "Environment"),
            "<details><summary>Settings of each point</summary>", html_table(["point", "ranks", "settings"], settings, "Settings"), "</details>"]


def cost():
    if not finished:
        return []
    return ["<section><h2>Cost</h2>", drawn(cost_by_effect(), "cost", "Cost by effect", "share of the wall time by what took it, for each point"),
            drawn(newton_iterations(), "newton", "Newton iterations", "mean over the steps"), "</section>"]


parts = [all_points()]
for error in errors:
    parts += section_of(error)
parts += [*cost(), "<section><h2>What failed</h2>", *failures(), "</section>", "<section><h2>Environment</h2>", *environment(), "</section>",
          "<section><h2>Conclusion</h2>", *[paragraph(escaped(one) + ".") for one in study["conclusions"]], "</section>"]
write_page(os.path.join(directory, "report.html"), html_page(study["study"], parts))
