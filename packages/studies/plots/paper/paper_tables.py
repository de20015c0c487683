# HTML of the paper's tables.
def difference(ours, paper):
    if not known(ours) or paper is None or paper == 0:
        return "–"
    percent = 100 * (ours / paper - 1)
    return f"{percent:+.{2 if abs(percent) < 1 else 1 if abs(percent) < 99.5 else 0}f} %"


def given(value):
    """A number that is compared with: as the paper prints it, or with as many digits as ours."""
    return "–" if value is None else repr(value) if len(repr(value)) <= 8 else number(value)


def name_of(run):
    """For heads of columns: the method."""
    return "node to segment" if run.name.endswith(RIVAL) else "dual mortar"


def comparison(found, rows, caption, reference="paper", names=name_of):
    """A column for each run of `found`, with its difference to the reference in brackets. rows: label, name of a quantity or function of the run, and
    the reference or None. Rows of which no run knows anything are left out."""
    cells = []
    for label, name, theirs in rows:
        values = [name(run) if callable(name) else run.quantity(name) for run in found]
        if any(map(known, values)):
            beside = lambda ours: number(ours) + (f" ({difference(ours, theirs)})" if known(ours) and theirs else "")
            cells.append([label, *map(beside, values), *([given(theirs)] if any(one is not None for *_, one in rows) else [])])
    heads = ["quantity", *map(names, found), *([reference] if any(one is not None for *_, one in rows) else [])]
    return html_table(heads, cells, caption) if cells else ""


def how_far(run):
    """The time that a run reached which stopped on its way, and why it stopped."""
    if run.complete:
        return "It came to its end."
    times = run.history["time"] if "time" in run.history else []
    reached = times[-1] if len(times) else 0.0
    return f"It stopped at time {reached:.3g} of the scene: {escaped(run.said.splitlines()[-1] if run.said else 'it said nothing')}"


def own_checks(found):
    """Quantities that have to vanish, as far as the scene names them."""
    rows = [("total variation of the nodal pressures along the surface over their peak, − 1", "oscillation", None),
            ("external work − internal work − friction, over the external work", "energy_error", None),
            ("external work − stored energy − plastic work − friction, over the external work", "energy_error_of_plasticity", None),
            ("imbalance of momentum, relative", "momentum_imbalance", None)]
    return comparison(found, rows, "What has to vanish")


def friction(run):
    """Friction or none, whatever the run is called."""
    return "with friction" if run.summary["effects"].get("friction") else "no friction"


def stages(run):
    """Numbers of steps by Newton iterations."""
    counts = run.iterations()
    return ", ".join(f"{counts.count(k)} × {k}" for k in sorted(set(counts)))


CHECK_MISSED = 4  # exit code


def ending(run):
    if run.exit == 0:
        return "well" + (" (was expected to miss checks)" if run.misses else "")
    if run.exit == CHECK_MISSED:
        return "checks missed, as expected" if run.misses else "<b>checks missed</b>"
    return f"<b>exit code {run.exit}</b>"


def overview(all_runs):
    rows = []
    for run in all_runs:
        summary = run.summary
        rows.append([escaped(run.name), ending(run), summary.get("dofs", "–"), len(summary.get("steps", [])) or "–", stages(run) or "–",
                     f"{run.seconds:.3g}" + (" (earlier call)" if run.reused else "")])
    return html_table(["run", "ended", "unknowns", "steps", "Newton iterations (steps × iterations)", "wall / s"], rows, "What was run", [1, 4])


def commands(all_runs):
    """Commands of the runs, without the settings of output: these change no result."""
    of = lambda run: [setting for setting in run.settings if not setting.startswith("output/")]
    return html_commands(record["program"], directory, [
        (run.name, command(record["launcher"], f"scenes/{run.scene}.xml", of(run), record["ranks"], f"again/{run.name}")) for run in all_runs])


def checks_of(run):
    bounds = lambda check: " to ".join(number(check[side], 4) if check[side] is not None else "…" for side in ("low", "high"))
    return [f"{escaped(check['name'])}: {escaped(check['quantity'])} = {number(check['value'], 4)}, bounds {bounds(check)}"
            for check in run.summary.get("checks", []) if not check["ok"]]


def missed(run):
    """Message of a run that did not end well, and the checks that it missed, as expected or not."""
    if run.exit == 0:
        return ""
    if run.exit == CHECK_MISSED and run.misses:
        return (f'<div class="expected"><b>{escaped(run.name)}</b> is expected to miss checks of its scene: {escaped(run.misses)}.'
                + details("Checks that it missed", items(checks_of(run))) + "</div>")
    text = f'<pre class="said">{escaped(run.said)}</pre>' if run.said else ""
    return f'<div class="failed"><b>{escaped(run.name)}</b> ended with exit code {run.exit}:{items(checks_of(run))}{text or "It said nothing."}</div>'
