# Pressure and shear along a slave surface, from profiles.csv.
import numpy as np


def profile_figure(run, pair, step):
    """The figure, and the time that it is of."""
    if run.mesh.dimension == 3:
        raise mortise_results.UnknownName("profiles along a line are of scenes in 2D; in 3D please draw a field of contact: --field contact_pressure")
    table = run.profiles
    pairs = list(dict.fromkeys(str(one) for one in table["pair"]))
    if pair not in pairs:
        raise mortise_results.UnknownName("profiles.csv: " + mortise_results._unknown("contact pair", pair, pairs))
    of_pair = np.array([str(one) == pair for one in table["pair"]])
    times = np.asarray(table["time"], dtype=float)
    known = sorted(set(times[of_pair]))
    time = known[-1]
    if step is not None:
        rows = np.flatnonzero(np.asarray(run.history["step"]) == step)
        time = float(np.asarray(run.history["time"], dtype=float)[rows[0]]) if len(rows) else None
        if time not in known:
            raise mortise_results.UnknownName(f"profiles.csv has no profile of step {step}; it has those of t = {', '.join(f'{one:.6g}' for one in known)}: "
                                              "the output times of the scene and its end")
    chosen = of_pair & (times == time)
    column = lambda name: np.asarray(table[name], dtype=float)[chosen]
    figure, axes = plt.subplots(figsize=(WIDTH / DPI, 720 / DPI))
    figure.subplots_adjust(left=0.11, right=0.97, top=0.84, bottom=0.13)
    arc, part = column("arc_length"), column("part")
    first = True
    for one in np.unique(part):
        at = part == one
        for name, colour, dashes in (("pressure", COLOURS[0], "-"), ("shear", COLOURS[1], "--")):
            axes.plot(arc[at], column(name)[at], color=colour, linestyle=dashes, marker="o", markersize=3, label=name if first else None)
        first = False
    axes.axhline(0, color="#555555", linewidth=0.6)
    axes.grid(True)
    axes.set_xlabel("arc length of the slave surface")
    axes.set_ylabel("pressure, shear")
    axes.legend(loc="best")
    figure.text(0.11, 0.95, plain(shortened(plain_line(run.title), 72)), fontsize=11, fontweight="bold", va="center")
    figure.text(0.11, 0.895, plain(f"contact \"{shortened(plain_line(pair), 40)}\",  t = {time:.6g}"), fontsize=9.5, va="center", color="#333333")
    return figure, time
