# The page of a study: its answer, figures, tables.
def drawn(figure, stem, title, caption):
    """As a file of its own, and as part of the page."""
    image = svg(figure)
    with open(os.path.join(directory, "plots", stem + ".svg"), "wb") as file:
        file.write(image)
    return html_image(image, title, caption)


def cost_figure(error):
    return drawn(error_against_time(error), "time_" + error["file"], "Cost", f"error of {error['name']} against wall time; rings: the cheapest runs")


def answer():
    lines = [f"{escaped(error['name'])}: {cheapest_of(error, points)}" for error in errors]
    failed = [point for point in points if not point["finished"]]
    parts = ['<section class="answer">', paragraph(summary_of(study)), items(lines)]
    if failed:
        parts.append(paragraph(f"{len(failed)} of {len(points)} runs did not come to their end and count nowhere: see <i>What failed</i>."))
    return [*parts, paragraph(RULE), "</section>", figures([cost_figure(error) for error in errors if has_errors(error)][:1])]


def sections():
    """Figures of each error; the first one's cost stands with the answer."""
    parts, first = [], True
    for error in errors:
        parts.append(f"<section><h2>Error of {escaped(error['name'])}</h2>")
        if has_errors(error):
            accuracy = drawn(error_against_h(error), "error_" + error["file"], "Accuracy", f"error of {error['name']} against mesh size, with fitted orders")
            parts.append(figures([accuracy] if first else [accuracy, cost_figure(error)]))
            first = False
        elif any(map(known, error["error"])):
            parts.append(paragraph("All errors are round-off: there is nothing to draw, and no order."))
        parts += [items(map(escaped, error["notes"])), "</section>"]
    return parts


def cost():
    if not finished:
        return []
    return ["<section><h2>Cost</h2>", figures([
        drawn(cost_by_phase(), "cost", "Cost by phase", "share of the wall time of the finest run of each family"),
        drawn(newton_iterations(), "newton", "Newton iterations", "mean over the steps")]), "</section>"]


def axis_columns():
    return [(escaped(axis["name"]), [escaped(point["labels"][i]) for point in points]) for i, axis in enumerate(study["axes"])] or \
        [("run", [escaped(point["label"]) for point in points])]


def all_points():
    of = lambda name, digits: [cell(point[name], digits) for point in points]
    columns = [*axis_columns(), ("status", [escaped(point["status"]) for point in points]), ("formulation", [escaped(point["formulation"]) for point in points]),
               ("element", [escaped(point["element"]) for point in points]), ("h", of("h", 3)), ("unknowns", of("dofs", 9)), ("steps", of("steps", 9)),
               ("Newton iterations", of("newton_iterations", 9)), ("wall / s", of("wall_s", 3)), ("CPU / s", of("cpu_s", 3)),
               ("memory / MiB", of("memory_mib", 3)),
               *[(f"error of {escaped(error['name'])}", list(map(in_percent, error["error"]))) for error in errors]]
    parts = [column_table(columns, f"All runs; times and memory are medians of {study['repeats']} run(s)",
                          [head for head, _ in axis_columns()] + ["status", "formulation", "element"])]
    if study["finest"]:
        one = study["finest"]
        parts.append(paragraph(f"<b>finest (reference)</b>: {escaped(one['status'])}, {cell(one['dofs'], 9)} unknowns, {cell(one['steps'], 9)} steps,",
                               f"{cell(one['newton_iterations'], 9)} Newton iterations, {cell(one['wall_s'])} s, {cell(one['memory_mib'])} MiB."))
    return parts


def values():
    """The values whose differences are the errors."""
    of = [(error, name) for error in errors for name in ("value", "reference") if any(map(known, error[name]))]
    if not of:
        return []
    columns = [("run", [escaped(point["label"]) for point in points])]
    columns += [(f"{escaped(error['name'])}{', reference' if name == 'reference' else ''}", [cell(one, 8) for one in error[name]]) for error, name in of]
    return [details("Values and references", column_table(columns, "Values of quantities and what they are compared with"))]


def times_to_targets():
    """When each curve reaches the errors that are aimed at, and how that compares with the first of the series."""
    def of(target, index):
        one = target["curves"][index]
        if one["seconds"] is None:
            return "not reached"
        ratio = "" if one["ratio"] is None else f" ({one['ratio']:.2f})"
        return ("≤ " if one["at_most"] else "") + cell(one["seconds"]) + ratio + ("" if one["confirmed"] else " *")

    wanted = [(error, target) for error in errors if has_errors(error) for target in error["targets"]]
    if not wanted:
        return []
    series = study["axes"][study["series"]] if study["axes"] else None
    ratio = f"; in brackets the ratio to {escaped(series['name'])} = {escaped(series['values'][0])}" if series else ""
    rows = [[escaped(curve["name"]), *[of(target, index) for _, target in wanted]] for index, curve in enumerate(curves)]
    return [html_table(["family", *[f"{escaped(error['name'])}, {percent(target['error'])}" for error, target in wanted]], rows,
                       f"Wall time in s from which on a family stays within an error{ratio}. Between runs linear in the logarithms; ≤: the coarsest run "
                       "is that good already; *: not confirmed by a finer run")]


def phases():
    shares = [split(points[i]) for i in finished]
    if not shares:
        return []
    rows = [[escaped(points[i]["label"]), *[cell(seconds, 2) for seconds in share.values()]] for i, share in zip(finished, shares)]
    return [details("Seconds of each phase", html_table(["run", *shares[0]], rows, "Wall time in s by phase"))]


def failures():
    every = points + ([study["finest"]] if study["finest"] else [])
    failed = [point for point in every if not point["finished"]]
    missed = [f"{escaped(point['label'])}: {escaped(one)}" for point in every if point["finished"] for one in point["missed"]]
    parts = [] if failed else [paragraph("All runs came to their end.")]
    if missed:
        parts.append(details(f"{len(missed)} checks of the scene that runs missed, as coarse meshes may", items(missed)))
    said = lambda point: escaped(point["said"] or "It said nothing.")
    return parts + [f'<div class="failed"><b>{escaped(point["label"])}</b>: {escaped(point["status"])}<pre class="said">{said(point)}</pre></div>'
                    for point in failed]


def environment():
    here = study["environment"]
    rows = [["Mortise", escaped(here["version"])], ["processor", escaped("; ".join(here["processors"]))],
            ["first run", escaped(here["first_run"])], ["last run", escaped(here["last_run"])],
            ["scene", escaped(study["scene"])]]
    of = lambda point: command(study["launcher"], "scene.xml", point["settings"], point["ranks"], os.path.join("again", point["name"]), point["peer"], point["peer_penalty"])
    return [html_table(["what", "which"], rows, "Environment", [1]),
            html_commands(study["program"], directory, [(point["label"], of(point)) for point in points])]


write_page(os.path.join(directory, "report.html"), html_page(study["study"], [
    *answer(), *sections(), *cost(), "<section><h2>Tables</h2>", *all_points(), *times_to_targets(), *values(), *phases(), "</section>",
    "<section><h2>What failed</h2>", *failures(), "</section>", "<section><h2>Environment</h2>", *environment(), "</section>"]))
