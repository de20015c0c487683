# The figure around the image: title, colour bar, axes, undeformed outline. All sizes are pixels of the picture.
import textwrap

import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.ticker import MaxNLocator

WIDTH, DPI = 1200, 150
TOP, LEFT, RIGHT, BELOW = 92, 118, 212, 84  # room for title, numbers of axes, an upright bar; numbers below
BAR, WIDE_BELOW = 30, 190  # thickness of the bar; room below a wide image, with a bar there
FRAME = 34  # around a solid, which has no axes

plt.rcParams.update({"font.size": 9.5, "axes.grid": False, "savefig.bbox": None, "savefig.dpi": DPI, "figure.dpi": DPI, "axes.spines.top": True,
                     "axes.spines.right": True})


class Layout:
    """Where things are in the picture, for all of its steps."""

    def __init__(self, low, high, has_axes):
        margin = 0.03 * max(float((high - low).max()), 1e-300)
        low, high = low - margin, high + margin
        span = np.maximum(high - low, 1e-300)
        self.has_axes = has_axes
        self.is_wide = span[0] > 1.75 * span[1]
        self.left = LEFT if has_axes else FRAME
        below = BELOW if has_axes else FRAME
        room = WIDTH - self.left - (FRAME if self.is_wide else RIGHT)
        self.height = int(np.clip(room * span[1] / span[0], 170 if self.is_wide else 300, 960))
        # A tall model has a narrow image, with the bar beside it.
        self.width = int(np.clip(1.15 * self.height * span[0] / span[1], 360, room))
        self.title = self.left
        self.left += (room - self.width) // 2
        self.bottom = (WIDE_BELOW if has_axes else WIDE_BELOW - 50) if self.is_wide else below
        self.total = TOP + self.height + self.bottom
        self.pixel = max(span[0] / self.width, span[1] / self.height)
        middle = (low + high) / 2
        half = 0.5 * self.pixel * np.array([self.width, self.height])
        self.low, self.high = middle - half, middle + half

    def in_raster(self, points):
        """Camera coordinates as pixels of the raster."""
        fine = self.pixel / FINE
        return np.column_stack([(points[:, :2] - self.low) / fine, points[:, 2] / fine])

    def box(self, left, bottom, width, height):
        """Pixels as matplotlib's share of the figure."""
        return [left / WIDTH, bottom / self.total, width / WIDTH, height / self.total]


def picture_of(model, step, layout, colours, labels):
    """The figure of one step. labels: kinematics -> names of the axes."""
    figure = plt.figure(figsize=(WIDTH / DPI, layout.total / DPI))
    axes = figure.add_axes(layout.box(layout.left, layout.bottom, layout.width, layout.height))
    axes.set_xlim(layout.low[0], layout.high[0])
    axes.set_ylim(layout.low[1], layout.high[1])
    axes.patch.set_visible(False)
    center, values = model.field.at(step)
    make = lambda some: Triangles(some, layout.in_raster(model.points(step)), center, values, model.field.is_whole)
    image = shaded(make(model.solid), make(model.ghosts), colours, layout.width, layout.height, model.is_plane)
    # In shares of the axes, not in coordinates of the model: their round-off would make a column of pixels appear twice.
    axes.imshow(np.concatenate([image[..., :3].clip(0, 1), image[..., 3:].clip(0, 1)], axis=2), interpolation="nearest", aspect="auto", zorder=2,
                extent=(0, 1, 0, 1), transform=axes.transAxes)
    if model.is_deformed:
        add_undeformed(axes, model)
    add_rigid_lines(axes, model, step)
    if model.is_plane and model.slaves is not None:
        add_slave_lines(axes, model, step, values, colours)
    if layout.has_axes:
        axes.set_xlabel(labels[0])
        axes.set_ylabel(labels[1])
        for axis in (axes.xaxis, axes.yaxis):
            axis.set_major_locator(MaxNLocator(7, steps=[1, 2, 2.5, 5, 10], min_n_ticks=2))
        if layout.height < 260:
            axes.yaxis.set_major_locator(MaxNLocator(3, steps=[1, 2, 5, 10]))
        axes.tick_params(direction="out", length=3)
    else:
        axes.set_axis_off()
        add_triad(figure, layout, model.camera)
    add_bar(figure, layout, colours, model.field.label)
    add_title(figure, layout, model, step)
    return figure


def add_undeformed(axes, model):
    """Over a plane model, behind a solid, whose own outlines would be mistaken for it."""
    points = model.points()
    curves = [curve[:, :, :2] for curve in outline_curves(model.solid + ([] if model.is_plane else model.ghosts), points)]
    axes.add_collection(LineCollection([one for curve in curves for one in curve], colors="#555555" if model.is_plane else "#999999",
                                       linewidths=0.7, linestyles=(0, (4, 3)) if model.is_plane else "-", zorder=3 if model.is_plane else 1))


def add_slave_lines(axes, model, step, values, colours):
    """Contact fields live on a line, the slave surface, which has their colours in a width that can be seen."""
    columns = np.column_stack([model.points(step)[:, :2], values, model.slaves])
    parts, shades = [], []
    for curves in outline_curves(model.solid, columns):
        curves = curves[(curves[:, 0, 3] == 1) & (curves[:, -1, 3] == 1)]
        count = curves.shape[1] - 1
        # Whole numbers are those of the nearest node: of an end, or of the one in the middle of a quadratic side.
        nearest = np.rint(np.arange(count) * (2 if count > 2 else 1) / (count - 1)) * count / (2 if count > 2 else 1)
        of = curves[:, nearest.astype(int), 2] if model.field.is_whole else (curves[:, :-1, 2] + curves[:, 1:, 2]) / 2
        parts.append(np.stack([curves[:, :-1, :2], curves[:, 1:, :2]], axis=2).reshape(-1, 2, 2))
        shades.append(colours(of.reshape(-1)))
    axes.add_collection(LineCollection(np.concatenate(parts), colors="black", linewidths=6.5, capstyle="butt", zorder=5))
    axes.add_collection(LineCollection(np.concatenate(parts), colors=np.concatenate(shades), linewidths=5, capstyle="projecting", zorder=6))


def add_rigid_lines(axes, model, step):
    """Profiles of rigid bodies, which have no inside."""
    if len(model.lines):
        axes.add_collection(LineCollection(model.points(step)[model.lines][:, :, :2], colors="#1A1A1A", linewidths=2.6, capstyle="round", zorder=4))


def add_triad(figure, layout, camera):
    """Directions of x, y and z at the lower left corner."""
    size = 92
    axes = figure.add_axes(layout.box(12, max(12, layout.bottom - 40), size, size))
    axes.set_xlim(-1.35, 1.35)
    axes.set_ylim(-1.35, 1.35)
    axes.set_axis_off()
    for name, direction in zip("xyz", camera.axes):
        x, y = direction[:2]
        if np.hypot(x, y) < 0.12:
            continue
        axes.annotate("", (x, y), (0, 0), arrowprops={"arrowstyle": "-|>", "color": "black", "linewidth": 1.0, "shrinkA": 0, "shrinkB": 0})
        length = np.hypot(x, y)
        axes.text(x + 0.3 * x / length, y + 0.3 * y / length, name, ha="center", va="center", fontsize=9)


def add_bar(figure, layout, colours, label):
    """The colour bar, with the extreme values at its ends."""
    values, texts = colours.ticks()
    if layout.is_wide:
        box, turned = layout.box(layout.left, 66, layout.width, BAR), "horizontal"
    else:
        tall = min(layout.height - 70, 560)
        box, turned = layout.box(layout.left + layout.width + 34, layout.bottom + (layout.height - 70 - tall) / 2, BAR, tall), "vertical"
    axes = figure.add_axes(box)
    bar = figure.colorbar(matplotlib.cm.ScalarMappable(colours.norm, colours.map), cax=axes, orientation=turned)
    bar.set_ticks(values, labels=texts)
    bar.minorticks_off()
    if layout.is_wide and len(texts) > 1:
        # The texts at the ends stay within the picture.
        for text, side in ((axes.get_xticklabels()[0], "left"), (axes.get_xticklabels()[-1], "right")):
            text.set_horizontalalignment(side)
    bar.outline.set_linewidth(0.6)
    if layout.is_wide:
        bar.set_label(plain(label))
    else:
        axes.set_title(plain(textwrap.fill(label, 18)), loc="left", fontsize=9.5, x=-0.4, pad=12)
    axes.set_label("bar")


def add_title(figure, layout, model, step):
    name = shortened(plain_line(model.run.title), 72)
    figure.text(layout.title / WIDTH, 1 - 30 / layout.total, plain(name), fontsize=11, fontweight="bold", va="center")
    words = f"step {step},  t = {model.run.time(step):.6g}"
    if model.moves:
        words += f",  displacements × {model.warp:.6g}".rstrip() if model.warp != 1 else ",  true displacements"
        if model.is_deformed:
            words += "  (dashed: undeformed)" if model.is_plane else "  (grey lines: undeformed)"
    figure.text(layout.title / WIDTH, 1 - 64 / layout.total, words, fontsize=9.5, va="center", color="#333333")


def plain_line(text):
    """One line: control characters would break it."""
    return "".join(one if one.isprintable() else "?" for one in text)
