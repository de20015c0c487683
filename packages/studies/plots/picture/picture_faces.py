# Faces of a mesh that are drawn: plane cells in 2D, outer sides of solids in 3D, and how faces are cut into triangles.
import numpy as np

# Sides of solids, with their corners counterclockwise seen from outside, then mid-side nodes; for each the shape of the side.
SIDES = {
    "tetrahedron4": [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]],
    "tetrahedron10": [[0, 2, 1, 6, 5, 4], [0, 1, 3, 4, 8, 7], [1, 2, 3, 5, 9, 8], [2, 0, 3, 6, 7, 9]],
    "wedge6": [[0, 2, 1], [3, 4, 5], [0, 1, 4, 3], [1, 2, 5, 4], [2, 0, 3, 5]],
    "wedge15": [[0, 2, 1, 8, 7, 6], [3, 4, 5, 9, 10, 11], [0, 1, 4, 3, 6, 13, 9, 12], [1, 2, 5, 4, 7, 14, 10, 13], [2, 0, 3, 5, 8, 12, 11, 14]],
    "pyramid5": [[0, 3, 2, 1], [0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]],
    "hexahedron8": [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]],
    "hexahedron20": [[0, 3, 2, 1, 11, 10, 9, 8], [4, 5, 6, 7, 12, 13, 14, 15], [0, 1, 5, 4, 8, 17, 12, 16], [1, 2, 6, 5, 9, 18, 13, 17],
                     [2, 3, 7, 6, 10, 19, 14, 18], [3, 0, 4, 7, 11, 16, 15, 19]]}
FACE_SHAPES = {3: "triangle3", 4: "quadrilateral4", 6: "triangle6", 8: "quadrilateral8"}
CORNERS = {"triangle3": 3, "quadrilateral4": 4, "triangle6": 3, "quadrilateral8": 4}
CUTS = 4  # parts of a side of a quadratic face


class Cut:
    """A face shape cut into triangles: points N @ nodes; triangles; for each side of the face the points along it."""

    def __init__(self, N, triangles, rims):
        self.N, self.triangles, self.rims = np.array(N, dtype=float), np.array(triangles), np.array(rims)


def _triangle(functions):
    place, N = {}, []
    for j in range(CUTS + 1):
        for i in range(CUTS + 1 - j):
            place[i, j] = len(N)
            N.append(functions(i / CUTS, j / CUTS))
    triangles = [[place[i, j], place[i + 1, j], place[i, j + 1]] for i, j in place if i + j < CUTS]
    triangles += [[place[i + 1, j], place[i + 1, j + 1], place[i, j + 1]] for i, j in place if i + j < CUTS - 1]
    along = range(CUTS + 1)
    return Cut(N, triangles, [[place[k, 0] for k in along], [place[CUTS - k, k] for k in along], [place[0, CUTS - k] for k in along]])


def _square(functions):
    place = lambda i, j: i + (CUTS + 1) * j
    along, cells = range(CUTS + 1), [(i, j) for j in range(CUTS) for i in range(CUTS)]
    N = [functions(2 * i / CUTS - 1, 2 * j / CUTS - 1) for j in along for i in along]
    triangles = [[place(i, j), place(i + 1, j), place(i + 1, j + 1)] for i, j in cells]
    triangles += [[place(i, j), place(i + 1, j + 1), place(i, j + 1)] for i, j in cells]
    return Cut(N, triangles, [[place(k, 0) for k in along], [place(CUTS, k) for k in along], [place(CUTS - k, CUTS) for k in along],
                              [place(0, CUTS - k) for k in along]])


def _triangle6(x, y):
    rest = 1 - x - y
    return [rest * (2 * rest - 1), x * (2 * x - 1), y * (2 * y - 1), 4 * rest * x, 4 * x * y, 4 * y * rest]


def _quadrilateral8(x, y):
    corners = [0.25 * (1 + a * x) * (1 + b * y) * (a * x + b * y - 1) for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    return corners + [0.5 * (1 - x * x) * (1 - y), 0.5 * (1 + x) * (1 - y * y), 0.5 * (1 - x * x) * (1 + y), 0.5 * (1 - x) * (1 - y * y)]


# A bilinear quadrilateral is cut from its centre, so that no diagonal is preferred.
CUT = {
    "triangle3": Cut(np.eye(3), [[0, 1, 2]], [[0, 1], [1, 2], [2, 0]]),
    "quadrilateral4": Cut([*np.eye(4), [0.25] * 4], [[k, (k + 1) % 4, 4] for k in range(4)], [[k, (k + 1) % 4] for k in range(4)]),
    "triangle6": _triangle(_triangle6), "quadrilateral8": _square(_quadrilateral8)}


class Faces:
    """Faces of one shape: nodes [faces x nodes], the cell and the body of each, whether it belongs to a rigid body, and for each of its sides
    whether it is an outline: the edge of a plane body, or a sharp edge of a solid."""

    def __init__(self, shape, nodes, cell, body, rigid):
        self.shape, self.nodes, self.cell, self.body, self.rigid = shape, nodes, cell, body, rigid
        self.outline = np.zeros((len(nodes), CORNERS[shape]), dtype=bool)

    def corners(self):
        return self.nodes[:, : CORNERS[self.shape]]


def _keys(corners, count):
    """Two numbers for each row of nodes that tell it from all other sides: smallest and largest node, and the next to the smallest."""
    ordered = np.sort(corners, axis=1)
    return ordered[:, 0] * count + ordered[:, -1], ordered[:, 1]


def _alone(first, second):
    """True if no other row has the same two numbers."""
    order = np.lexsort((second, first))
    same = (np.diff(first[order]) == 0) & (np.diff(second[order]) == 0)
    alone = np.ones(len(first), dtype=bool)
    alone[order[1:][same]] = alone[order[:-1][same]] = False
    return alone


def faces_of(mesh):
    """All Faces that are drawn."""
    found, sides = [], []  # sides of solids: shape, nodes, cells
    for name, cells in mesh.cells.items():
        ids = mesh.ids[name]
        if name in CORNERS:
            found.append(Faces(name, cells, ids, mesh.body[ids], mesh.is_rigid(name)))
        for side in SIDES.get(name, []):
            sides.append((FACE_SHAPES[len(side)], cells[:, side], ids))
    # A side that two solids have, of whatever shapes, lies inside.
    outer = {}
    for corners in (3, 4):
        members = [(index, nodes[:, :corners]) for index, (shape, nodes, _) in enumerate(sides) if CORNERS[shape] == corners]
        if not members:
            continue
        alone = _alone(*_keys(np.concatenate([of for _, of in members]), len(mesh.nodes)))
        at = 0
        for index, of in members:
            outer[index], at = alone[at : at + len(of)], at + len(of)
    for shape in ("triangle3", "quadrilateral4", "triangle6", "quadrilateral8"):
        chosen = [(nodes[outer[index]], ids[outer[index]]) for index, (of, nodes, ids) in enumerate(sides) if of == shape]
        if not chosen:
            continue
        nodes, cell = np.concatenate([one for one, _ in chosen]), np.concatenate([one for _, one in chosen])
        found.append(Faces(shape, nodes, cell, mesh.body[cell], False))
    _mark_outlines(found, mesh)
    return found


def face_normals(faces, position):
    """Unit normals of faces at the mean of their corners, [faces x 3]."""
    x = position[faces.corners()]
    n = np.cross(x[:, 1] - x[:, 0], x[:, 2] - x[:, 0]) if x.shape[1] == 3 else np.cross(x[:, 2] - x[:, 0], x[:, 3] - x[:, 1])
    return n / np.maximum(np.linalg.norm(n, axis=1, keepdims=True), 1e-300)


SHARP = np.cos(np.radians(35))


def _mark_outlines(all_faces, mesh):
    """A side of a face is an outline if no other face has it, or if the one that has it stands at more than 35 degrees."""
    ends, where = [], []
    for index, faces in enumerate(all_faces):
        corners = faces.corners()
        for side in range(corners.shape[1]):
            pair = np.sort(np.stack([corners[:, side], corners[:, (side + 1) % corners.shape[1]]], axis=1), axis=1)
            ends.append(pair[:, 0] * len(mesh.nodes) + pair[:, 1])
            where.append(np.stack([np.full(len(pair), index), np.arange(len(pair)), np.full(len(pair), side)], axis=1))
    if not ends:
        return
    ends, where = np.concatenate(ends), np.concatenate(where)
    normals = np.zeros((len(ends), 3))
    for index, faces in enumerate(all_faces):
        mine = where[:, 0] == index
        normals[mine] = face_normals(faces, mesh.nodes)[where[mine, 1]]
    order = np.argsort(ends, kind="stable")
    same = np.diff(ends[order]) == 0
    left, right = order[:-1][same], order[1:][same]
    flat = (normals[left] * normals[right]).sum(axis=1) > SHARP
    outline = np.ones(len(ends), dtype=bool)
    outline[left[flat]] = outline[right[flat]] = False
    for index, faces in enumerate(all_faces):
        mine = (where[:, 0] == index) & outline
        faces.outline[where[mine, 1], where[mine, 2]] = True


def outline_curves(all_faces, position):
    """Points of each side that is an outline, [curves x points x columns of position], straight or along mid-side nodes. Columns may be more than
    coordinates: they are interpolated in the same way."""
    curves = []
    for faces in all_faces:
        count = CORNERS[faces.shape]
        quadratic = faces.nodes.shape[1] > count
        for side in range(count):
            nodes = faces.nodes[faces.outline[:, side]]
            a, b = position[nodes[:, side]], position[nodes[:, (side + 1) % count]]
            if not quadratic:
                curves.append(np.stack([a, (a + b) / 2, b], axis=1))
                continue
            middle = position[nodes[:, count + side]]
            s = np.linspace(-1, 1, 2 * CUTS + 1)[None, :, None]
            curves.append(s * (s - 1) / 2 * a[:, None] + (1 - s * s) * middle[:, None] + s * (s + 1) / 2 * b[:, None])
    return curves
