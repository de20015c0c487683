# Figures of a study: each function gives a matplotlib figure.
from matplotlib.ticker import FixedLocator, FuncFormatter, MaxNLocator, NullFormatter

MARKERS = ["o", "s", "^", "D", "v", "P", "X", "<"]
FILLS = [*zip(COLOURS, ["", "///", "\\\\\\", "...", "xxx", "---", ""]), ("#AAAAAA", "..."), ("#DDDDDD", "")]  # of the effects, then of the rest


def style(index):
    """Of a curve: colour, marker and dashes of its own."""
    return {"color": COLOURS[index % len(COLOURS)], "marker": MARKERS[index % len(MARKERS)], "markersize": 4.5,
            "linestyle": DASHES[index % len(DASHES)]}


def one_panel(title):
    figure, axes = plt.subplots(figsize=(4.6, 3.4))
    axes.set_title(title)
    return figure, axes


def ticks_at(axis, values):
    """Ticks at these values, written out; a logarithmic axis of less than a decade has next to none of its own."""
    values = sorted({float(f"{value:.3g}") for value in values if np.isfinite(value) and value > 0})
    if 0 < len(values) <= 8:
        axis.set_major_locator(FixedLocator(values))
        axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:.3g}"))
        axis.set_minor_formatter(NullFormatter())


def legend_below(axes):
    handles, _ = axes.get_legend_handles_labels()
    if handles:
        axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.17), ncols=1 if len(handles) < 4 else 2)


def error_against_h(error):
    figure, axes = one_panel(f"error of {error['name']} against mesh size")
    values = array(error["error"])
    for index, curve in enumerate(curves):
        order = error["orders"][index]
        label = curve["name"] + ("" if order is None else f": order {order:.2f}")
        axes.loglog(h[curve["points"]], values[curve["points"]], label=label, **style(index))
    ticks_at(axes.xaxis, h)
    axes.set_xlabel(f"h = {study['h']}")
    axes.set_ylabel("relative error")
    legend_below(axes)
    return figure


def error_against_time(error):
    figure, axes = one_panel(f"error of {error['name']} against wall time")
    values = array(error["error"])
    front = error["front"]
    if front:
        # To the right of its last point nothing is better; above its first nothing is faster.
        shown = values[np.isfinite(values)]
        x, y = [wall[front[0]], *wall[front], np.nanmax(wall[finished])], [shown.max(), *values[front], values[front[-1]]]
        axes.step(x, y, where="post", color="#999999", linewidth=4, alpha=0.5, label="Pareto front", linestyle="-", zorder=1)
    for target in error["targets"]:
        axes.axhline(target["error"], color="#555555", linewidth=0.7, linestyle=":")
        axes.annotate(percent(target["error"]), (1, target["error"]), xycoords=("axes fraction", "data"), ha="right", va="bottom", fontsize=7)
    for index, curve in enumerate(curves):
        axes.loglog(wall[curve["points"]], values[curve["points"]], label=curve["name"], **style(index))
    low, high = np.nanmin(wall[finished]), np.nanmax(wall[finished])
    if high < 10 * low:
        ticks_at(axes.xaxis, [m * 10.0**k for k in range(-4, 7) for m in (1, 1.5, 2, 3, 5, 7) if 0.95 * low < m * 10.0**k < 1.05 * high])
    axes.set_xlabel("wall time / s")
    axes.set_ylabel("relative error")
    legend_below(axes)
    return figure


def cost_by_effect():
    """Bars of the wall time of each point."""
    shares = [split(points[i]) for i in finished]
    figure, axes = plt.subplots(figsize=(6.3, 0.9 + 0.24 * len(finished)))
    axes.set_title("share of the wall time")
    begin = np.zeros(len(finished))
    for (colour, hatch), title in zip(FILLS, shares[0]):
        width = np.array([100 * share[title] / sum(share.values()) for share in shares])
        axes.barh(range(len(finished)), width, left=begin, height=0.75, color=colour, hatch=hatch, edgecolor="white", linewidth=0.5, label=title)
        begin += width
    axes.set_yticks(range(len(finished)), [f"{points[i]['label']}   {wall[i]:.3g} s" for i in finished])
    axes.invert_yaxis()
    axes.grid(False, axis="y")
    axes.set_xlim(0, 100)
    axes.set_xlabel("%")
    axes.legend(loc="upper left", bbox_to_anchor=(1, 1))
    return figure


def newton_iterations():
    figure, axes = one_panel("Newton iterations per step")
    iterations = column("newton_iterations") / column("steps")
    for index, curve in enumerate(curves):
        axes.semilogx(h[curve["points"]], iterations[curve["points"]], label=curve["name"], **style(index))
    ticks_at(axes.xaxis, h)
    axes.yaxis.set_major_locator(MaxNLocator(integer=True))
    axes.set_ylim(bottom=0)
    axes.set_xlabel(f"h = {study['h']}")
    axes.set_ylabel("iterations / steps")
    legend_below(axes)
    return figure
