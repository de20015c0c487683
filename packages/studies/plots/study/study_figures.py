# Figures of a study: each function gives a matplotlib figure.
from matplotlib.colors import to_rgb
from matplotlib.ticker import FixedLocator, FuncFormatter, MaxNLocator, NullFormatter


def formulation(curve):
    """The first of its pairs."""
    return points[curve["points"][0]]["formulation"].split(" + ")[0]


def style(index):
    """Of a curve: colour and marker of its formulation; of several with the same, the later ones are lighter and have dashes of their own."""
    curve = curves[index]
    same = [other for other in curves if formulation(other) == formulation(curve)]
    at = same.index(curve)
    colour, marker = FORMULATIONS.get(formulation(curve), OTHER_FORMULATION)
    white = 0.6 * at / len(same)
    return {"color": tuple(one + white * (1 - one) for one in to_rgb(colour)), "marker": marker, "markersize": 6, "linestyle": DASHES[at % len(DASHES)],
            "fillstyle": "full" if at == 0 else "none"}


def ticks_at(axis, values):
    """Ticks at these values, written out; a logarithmic axis of less than a decade has next to none of its own."""
    values = sorted({float(f"{value:.3g}") for value in values if np.isfinite(value) and value > 0})
    if 0 < len(values) <= 8:
        axis.set_major_locator(FixedLocator(values))
        axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:.3g}"))
        axis.set_minor_formatter(NullFormatter())


def round_off_of(axes, values):
    """Marks what errors below which say nothing, if there are any."""
    if (values[np.isfinite(values)] <= ROUND_OFF).any():
        axes.axhspan(1e-18, ROUND_OFF, color="#EEEEEE", zorder=0)
        axes.annotate("round-off", (0, ROUND_OFF), xycoords=("axes fraction", "data"), ha="left", va="top")


def error_against_h(error):
    figure, axes = one_panel(f"error of {error['name']}")
    values = array(error["error"])
    for index, curve in enumerate(curves):
        axes.loglog(h[curve["points"]], values[curve["points"]], label=plain(f"{curve['name']}: {order_words(error, index)}"), **style(index))
    round_off_of(axes, values)
    ticks_at(axes.xaxis, h)
    axes.set_xlabel(plain(f"h = {study['h']}"))
    axes.set_ylabel("relative error")
    legend_below(axes)
    return figure


def error_against_time(error):
    figure, axes = one_panel(f"error of {error['name']}")
    values = array(error["error"])
    front = error["front"]
    if front:
        # To the right of its last point nothing is better; above its first nothing is faster.
        shown = values[np.isfinite(values)]
        x, y = [wall[front[0]], *wall[front], np.nanmax(wall[finished])], [shown.max(), *values[front], values[front[-1]]]
        axes.step(x, y, where="post", color="#999999", linewidth=4, alpha=0.5, label="what no run beats", linestyle="-", zorder=1)
    for target in error["targets"]:
        axes.axhline(target["error"], color="#555555", linewidth=0.8, linestyle=":")
        axes.annotate(percent(target["error"]), (1, target["error"]), xycoords=("axes fraction", "data"), ha="right", va="bottom")
    for index, curve in enumerate(curves):
        axes.loglog(wall[curve["points"]], values[curve["points"]], label=plain(curve["name"]), **style(index))
    for confirmed, dashes, label in ((True, "-", "cheapest within a bound"), (False, ":", "cheapest, not confirmed by a finer run")):
        best = [target["cheapest"]["point"] for target in error["targets"] if target["cheapest"] and target["cheapest"]["confirmed"] == confirmed]
        if best:
            axes.plot(wall[best], values[best], "o", markersize=15, markerfacecolor="none", markeredgecolor="black", markeredgewidth=1.2, label=label,
                      fillstyle="none" if confirmed else "left", alpha=1.0 if confirmed else 0.5)
    round_off_of(axes, values)
    low, high = np.nanmin(wall[finished]), np.nanmax(wall[finished])
    if high < 10 * low:
        ticks_at(axes.xaxis, [m * 10.0**k for k in range(-4, 7) for m in (1, 2, 5) if 0.9 * low < m * 10.0**k < 1.1 * high])
    axes.set_xlabel("wall time / s")
    axes.set_ylabel("relative error")
    legend_below(axes)
    return figure


UNTIMED = "outside the timers"


def split(point):
    """Seconds by phase; what no timer of these has counted, and what the process took besides, come last."""
    time = point["time"]
    shares = {name: sum(time.get(one, 0.0) for one in timers) for name, (timers, _, _) in PHASES.items()}
    shares["rest"] = max(0.0, time.get("total", 0.0) - sum(shares.values()))
    shares[UNTIMED] = max(0.0, point["wall_s"] - time.get("total", 0.0))
    return shares


def cost_by_phase():
    """Bars of the wall time of the finest run of each curve."""
    finest = [i for i in ([i for i in curve["points"] if i in finished][-1:] for curve in curves) if i]
    shown = [i for one in finest for i in one]
    figure, axes = one_panel("", 1.0 + 0.6 * len(shown))
    figure.subplots_adjust(left=0.15 / WIDTH, right=1 - 0.25 / WIDTH)
    shares = [split(points[i]) for i in shown]
    begin = np.zeros(len(shown))
    for name in shares[0]:
        _, colour, hatch = PHASES.get(name, ([], "#E5E5E5", ""))
        width = np.array([100 * share[name] / sum(share.values()) for share in shares])
        axes.barh(range(len(shown)), width, left=begin, height=0.4, color=colour, hatch=hatch, edgecolor="white", linewidth=0.5, label=name)
        begin += width
    for row, i in enumerate(shown):
        label = textwrap.shorten(points[i]["label"], 42, placeholder="…")
        axes.annotate(plain(f"{label}: {wall[i]:.3g} s"), (0, row - 0.24), va="bottom", annotation_clip=False)
    axes.set_yticks([])
    axes.set_ylim(len(shown) - 0.5, -0.75)
    axes.grid(False, axis="y")
    axes.set_xlim(0, 100)
    axes.set_xlabel("share of the wall time / %")
    legend_below(axes, 2)
    return figure


def newton_iterations():
    figure, axes = one_panel("Newton iterations per step")
    iterations = column("newton_iterations") / column("steps")
    for index, curve in enumerate(curves):
        axes.semilogx(h[curve["points"]], iterations[curve["points"]], label=plain(curve["name"]), **style(index))
    ticks_at(axes.xaxis, h)
    axes.yaxis.set_major_locator(MaxNLocator(integer=True))
    axes.set_ylim(bottom=0)
    axes.set_xlabel(plain(f"h = {study['h']}"))
    axes.set_ylabel("iterations / steps")
    legend_below(axes)
    return figure
