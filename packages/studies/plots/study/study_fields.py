# Differences of displacements between runs on different meshes. arguments: the file to write, "axisymmetric" or "plane", directories of the finest
# run and of the others.
import json

from matplotlib.tri import Triangulation


def shapes(count, r, s):
    """Shape functions and their derivatives by r and s, (nodes, points), of the triangle 0 <= r, s, r + s <= 1 or the square [-1, 1]^2."""
    if count == 3:
        one = np.ones_like(r)
        return np.array([1 - r - s, r, s]), np.array([-one, one, 0 * one]), np.array([-one, 0 * one, one])
    signs = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)])[:, :, None]
    a, b = 1 + signs[:, 0] * r, 1 + signs[:, 1] * s
    return 0.25 * a * b, 0.25 * signs[:, 0] * b, 0.25 * a * signs[:, 1]


def interpolated(fields, cells, r, s):
    """Position, displacement (points, 2), displacement gradient (points, 2, 2) and area per area of the reference cell, at a point of each cell."""
    N, Nr, Ns = shapes(cells.shape[1], r, s)
    X, U = fields.reference[cells], fields.displacement[cells]  # (points, nodes, 2)
    x, u = np.einsum("np,pni->pi", N, X), np.einsum("np,pni->pi", N, U)
    J = np.stack([np.einsum("np,pni->pi", Nr, X), np.einsum("np,pni->pi", Ns, X)], axis=2)
    du = np.stack([np.einsum("np,pni->pi", Nr, U), np.einsum("np,pni->pi", Ns, U)], axis=2)
    return x, u, du @ np.linalg.inv(J), np.linalg.det(J), J


def integration_points(count):
    """r, s, weight: three Gauss points each way, as gradients of the finest run jump within cells; for triangles the square is collapsed."""
    gauss = list(zip(*np.polynomial.legendre.leggauss(3)))
    square = [(r, s, w * v) for r, w in gauss for s, v in gauss]
    if count == 4:
        return square
    return [((1 + r) / 2, (1 + s) / 2 * (1 - r) / 2, w * (1 - r) / 8) for r, s, w in square]


class Locator:
    """Finds the cells of one body that points lie in. Points outside, beside chords of a curved side, get the cell with the nearest centre, and the
    displacement is continued beyond it."""

    def __init__(self, fields, cells):
        self.fields, self.cells = fields, cells
        self.count = cells.shape[1]
        triangles = cells if self.count == 3 else np.concatenate([cells[:, [0, 1, 2]], cells[:, [0, 2, 3]]])
        self.of_triangle = np.tile(np.arange(len(cells)), 1 if self.count == 3 else 2)
        self.finder = Triangulation(*fields.reference.T, triangles).get_trifinder()
        self.centre = fields.reference[cells].mean(axis=1)

    def values(self, x):
        """Displacement and its gradient at points."""
        found = self.finder(x[:, 0], x[:, 1])
        cell = np.where(found >= 0, self.of_triangle[found], 0)
        for i in np.flatnonzero(found < 0):
            cell[i] = np.argmin(((self.centre - x[i]) ** 2).sum(axis=1))
        cells = self.cells[cell]
        start = 1 / 3 if self.count == 3 else 0.0
        local = np.full((2, len(x)), start)
        for _ in range(20):  # Newton for x(r, s) = x; one iteration does for triangles and parallelograms
            at, u, gradient, _, J = interpolated(self.fields, cells, *local)
            step = np.linalg.solve(J, (x - at)[:, :, None])[:, :, 0]
            local = np.clip(local + step.T, -2, 2)
            if np.abs(step).max() < 1e-12:
                break
        _, u, gradient, _, _ = interpolated(self.fields, cells, *local)
        return u, gradient


def blocks(fields):
    """Cells of each body by their number of nodes: ((body, count), cells)."""
    found = {}
    for body, cell, inside in zip(fields.body, fields.cells, fields.inside):
        if inside:
            found.setdefault((int(body), len(cell)), []).append(cell)
    return {key: np.array(cells) for key, cells in found.items()}


def errors(fields, locators, axisymmetric):
    """||u - u_ref|| / ||u_ref|| and the same of the gradients, over the mesh of `fields`."""
    sums = np.zeros(4)
    for (body, count), cells in blocks(fields).items():
        for r, s, weight in integration_points(count):
            x, u, gradient, area, _ = interpolated(fields, cells, np.full(len(cells), r), np.full(len(cells), s))
            u_ref, gradient_ref = locators[body].values(x)
            volume = weight * area * (x[:, 0] if axisymmetric else 1.0)
            for i, squared in enumerate(((u - u_ref) ** 2, u_ref**2, (gradient - gradient_ref) ** 2, gradient_ref**2)):
                sums[i] += (volume * squared.reshape(len(cells), -1).sum(axis=1)).sum()
    ratio = lambda difference, size: np.sqrt(difference / size) if size > 0 else None
    return {"displacement": ratio(*sums[:2]), "gradient": ratio(*sums[2:])}


target, kinematics, finest, *others = sys.argv[1:]
reference = Fields(finest)
locators = {body: Locator(reference, cells) for (body, _), cells in blocks(reference).items()}
rows = [errors(Fields(one), locators, kinematics == "axisymmetric") for one in others]
with open(target, "w", encoding="utf-8") as file:
    json.dump(rows, file)
