# HTML of the paper's tables.
def difference(ours, paper):
    if ours is None or paper is None or not np.isfinite(ours) or paper == 0:
        return "–"
    return f"{100 * (ours / paper - 1):+.2f} %"


def comparison(rows, caption, reference="paper"):
    """rows: name, ours, reference's (either may be None)."""
    cells = [[name, number(ours), number(theirs), difference(ours, theirs)] for name, ours, theirs in rows]
    return html_table(["quantity", "ours", reference, "difference"], cells, caption)


def beside(rows, found, labels, caption):
    """rows: label and name of a quantity; one column for each of the runs `found`."""
    cells = [[label, *[number(run.quantity(name)) for run in found]] for label, name in rows]
    return html_table(["quantity", *labels], cells, caption)


def how_far(run):
    """What a run that stopped on its way reached, and why it stopped."""
    if run.complete:
        return "It came to its end."
    times = run.history["time"] if "time" in run.history else []
    reached = times[-1] if len(times) else 0.0
    return f"It stopped at time {reached:.3g} of the scene: {escaped(run.said.splitlines()[-1] if run.said else 'it said nothing')}"


def own_checks(run):
    """Quantities that have to vanish, as far as the scene names them."""
    names = {"oscillation": "total variation of the nodal pressures along the surface over their peak, − 1",
             "energy_error": "external work − internal work − friction, over the external work",
             "energy_error_of_plasticity": "external work − stored energy − plastic work − friction, over the external work",
             "momentum_imbalance": "imbalance of momentum, relative"}
    rows = [[label, run.quantity(name), 0.0] for name, label in names.items() if run.quantity(name) is not None]
    return comparison(rows, f"{run.name}: what has to vanish", "exact") if rows else ""


def command(run):
    words = ["./dev run", f"inputs/paper/{run.scene}.xml"]
    for setting in run.settings:
        if not setting.startswith("output/"):  # what is written changes no result
            words.append(f"--set {setting}")
    return " ".join(words)


def friction(run):
    """What was on, whatever the run is called."""
    return "with friction" if run.summary["effects"].get("friction") else "no friction"


def stages(run):
    """How often Newton needed how many iterations."""
    counts = run.iterations()
    return ", ".join(f"{counts.count(k)} × {k}" for k in sorted(set(counts)))


def overview(all_runs):
    rows = []
    for run in all_runs:
        state = "done" if run.exit == 0 else f"<b>exit code {run.exit}</b>"
        if run.exit == 4:
            state += " (a check of the scene missed)"
        summary = run.summary
        rows.append([run.name, state, summary.get("dofs", "–"), len(summary.get("steps", [])) or "–", stages(run) or "–",
                     f"{run.seconds:.1f}" + (" (earlier call)" if run.reused else ""), f"<code>{escaped(command(run))}</code>"])
    head = ["run", "ended", "unknowns", "steps", "Newton iterations (steps × iterations)", "seconds", "by itself"]
    return html_table(head, rows, "What was run")


def missed(run):
    """What a run that did not end well said, and the checks that it missed."""
    if run.exit == 0:
        return ""
    lines = [f"{check['name']}: {check['quantity']} = {check['value']}, bounds {check['low']} to {check['high']}"
             for check in run.summary.get("checks", []) if not check["ok"]]
    text = run.said or "\n".join(lines) or "It said nothing."
    return f'<div class="failed"><b>{escaped(run.name)}</b> ended with exit code {run.exit}:<pre>{escaped(text)}</pre></div>'
