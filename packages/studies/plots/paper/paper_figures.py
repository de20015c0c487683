# Figures of the page: each function gives a matplotlib figure.
from matplotlib.collections import PolyCollection
from matplotlib.tri import Triangulation

DRAWN_AS_LINES = 1500  # more cells than these are drawn as dots, or the page becomes heavy


def colour_bar(figure, axes, drawn, label):
    flat = axes.get_xlim()[1] - axes.get_xlim()[0] > 2 * (axes.get_ylim()[1] - axes.get_ylim()[0])
    figure.colorbar(drawn, ax=axes, label=label, orientation="horizontal" if flat else "vertical", shrink=0.9, aspect=30 if flat else 20)


def mesh_lines(axes, cells):
    many = len(cells) > DRAWN_AS_LINES
    axes.add_collection(PolyCollection(cells, facecolors="none", edgecolors="black", linewidths=0.08 if many else 0.3, rasterized=many))


def frame(axes, points, names):
    axes.grid(False)
    axes.set_aspect("equal")
    low, high = points.min(axis=0), points.max(axis=0)
    rim = 0.03 * (high - low).max()
    axes.set_xlim(low[0] - rim, high[0] + rim)
    axes.set_ylim(low[1] - rim, high[1] + rim)
    axes.set_xlabel(names[0] + " / mm")
    axes.set_ylabel(names[1] + " / mm")


def on_mesh(figure, axes, fields, values, label, names=("x", "y"), lying=False):
    """Values of cells, each in one colour, or of nodes, linear between them, on the deformed mesh. Colours begin at 0. lying: y to the right."""
    position = fields.position[:, ::-1] if lying else fields.position
    cells = [cell for cell, inside in zip(fields.cells, fields.inside) if inside]
    polygons = [position[cell] for cell in cells]
    frame(axes, np.concatenate(polygons), names[::-1] if lying else names)
    of_cells = len(values) == len(fields.cells)
    if of_cells:
        values = values[fields.inside]
    limits = {"vmin": min(0.0, values.min()), "vmax": values.max()}
    for cell, inside in zip(fields.cells, fields.inside):
        if not inside:
            axes.plot(*position[cell].T, color="black", linestyle="-", linewidth=1.2)
    if of_cells:
        drawn = PolyCollection(polygons, array=values, cmap="cividis", rasterized=len(polygons) > DRAWN_AS_LINES)
        drawn.set_clim(**limits)
        axes.add_collection(drawn)
    else:
        triangles = [cell[[0, i, i + 1]] for cell in cells for i in range(1, len(cell) - 1)]
        mesh = Triangulation(position[:, 0], position[:, 1], triangles)
        drawn = axes.tripcolor(mesh, values, shading="gouraud", cmap="cividis", rasterized=True, **limits)
    mesh_lines(axes, polygons)
    colour_bar(figure, axes, drawn, label)


def displacement_and_stress(run, title, names=("x", "y")):
    fields = run.fields
    figure, axes = panels(2, title)
    on_mesh(figure, axes[0], fields, np.linalg.norm(fields.displacement, axis=1), "displacement / mm", names)
    on_mesh(figure, axes[1], fields, fields.von_mises(), "von Mises stress / MPa", names)
    return figure


def mesh_near_contact(run, title, size):
    """Von Mises stress in a square of half width `size` around the contact."""
    figure, axes = panels(1, title)
    on_mesh(figure, axes[0], run.fields, run.fields.von_mises(), "von Mises stress / MPa")
    axes[0].set_xlim(0, 2 * size)
    axes[0].set_ylim(-size, size)
    return figure


def hertz_profile(axes, pressure, half_width, label):
    x = half_width * np.sin(np.linspace(0, np.pi / 2, 200))
    axes.plot(x, pressure * np.sqrt(1 - (x / half_width) ** 2), color="black", linestyle="-", linewidth=1.0, label=label)


def method_of(run):
    return "node to segment" if run.name.endswith(RIVAL) else "dual mortar"


def contact_profile(axes, run, label, shear=False, filled=True):
    """In the colour of the formulation; shear dashed."""
    x, pressure, tangential = run.fields.contact()
    colour, marker = FORMULATIONS[method_of(run)]
    axes.plot(x, tangential if shear else pressure, color=colour, marker=marker, markersize=4, linewidth=1.0, linestyle="--" if shear else "-",
              fillstyle="full" if filled else "none", label=label)


def finish_profile(axes, end):
    axes.set_xlim(0, end)
    axes.set_xlabel("x / mm")
    axes.set_ylabel("contact stress / MPa")
    legend_below(axes)


def against_displacement(found, quantity, label, title, stroke, scale=1e-6):
    """A quantity of every step over the way of the rear face, of a run and of its rivals."""
    figure, axes = one_panel(title)
    for run, dashes in zip(found, DASHES):
        history = run.history
        axes.plot(np.append(0.0, stroke * history["time"]), scale * np.append(0.0, np.abs(history[quantity])), color=FORMULATIONS[method_of(run)][0],
                  linestyle=dashes, label=method_of(run))
    axes.set_xlabel("displacement of the rear face / mm")
    axes.set_ylabel(label)
    axes.set_ylim(bottom=0)
    legend_below(axes)
    return figure
