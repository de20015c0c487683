"""Meshes of bent or straight blocks for CalculiX and Mortise: hexahedra and quadratic tetrahedra, with surfaces by their sides."""

CORNERS = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
EDGES = [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)]
FACES = [(0, 1, 2, 3), (4, 5, 6, 7), (0, 1, 4, 5), (1, 2, 5, 6), (2, 3, 6, 7), (3, 0, 7, 4)]
TETRAHEDRA = [(0, 1, 2, 6), (0, 2, 3, 6), (0, 3, 7, 6), (0, 7, 4, 6), (0, 4, 5, 6), (0, 5, 1, 6)]
TETRAHEDRON_EDGES = [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)]
TETRAHEDRON_FACES = [(0, 1, 2), (0, 3, 1), (1, 3, 2), (2, 3, 0)]
SIDES = {"left": (0, 0), "right": (0, 1), "front": (1, 0), "back": (1, 1), "bottom": (2, 0), "top": (2, 1)}


class Block:
    """A grid of cells in the unit cube, placed by a function of three coordinates. Numbers of nodes and elements begin after `first`."""

    def __init__(self, name, kind, cells, place, first):
        self.name, self.kind, self.place, self.first = name, kind, place, first
        self.nodes, self.elements, self.grid = {}, [], [2 * count for count in cells]
        self.sides = {side: [] for side in SIDES}
        for k in range(cells[2]):
            for j in range(cells[1]):
                for i in range(cells[0]):
                    self.add_cell([tuple(2 * (a + b) for a, b in zip((i, j, k), corner)) for corner in CORNERS])

    def add_cell(self, corners):
        middle = lambda a, b: tuple((p + q) // 2 for p, q in zip(a, b))
        if self.kind == "C3D10":
            for cell in TETRAHEDRA:
                points = [corners[node] for node in cell]
                self.add_element(points, points + [middle(points[a], points[b]) for a, b in TETRAHEDRON_EDGES], TETRAHEDRON_FACES)
        else:
            edges = [middle(corners[a], corners[b]) for a, b in EDGES] if self.kind == "C3D20" else []
            self.add_element(corners, corners + edges, FACES)

    def add_element(self, corners, points, faces):
        self.elements.append([self.node(point) for point in points])
        for side, (axis, end) in SIDES.items():
            for number, face in enumerate(faces):
                if all(corners[node][axis] == end * self.grid[axis] for node in face):
                    self.sides[side].append((self.first + len(self.elements), number + 1))

    def node(self, point):
        if point not in self.nodes:
            self.nodes[point] = self.first + len(self.nodes) + 1
        return self.nodes[point]

    def on(self, side):
        axis, end = SIDES[side]
        return [number for point, number in self.nodes.items() if point[axis] == end * self.grid[axis]]

    def lines(self):
        """Nodes, elements, and of each side a surface NAME_SIDE and a set of nodes N_NAME_SIDE."""
        result = ["*NODE"]
        for point, number in self.nodes.items():
            result.append(f"{number}, " + ", ".join(f"{x:.15g}" for x in self.place(*(p / g for p, g in zip(point, self.grid)))))
        result.append(f"*ELEMENT, TYPE={self.kind}, ELSET={self.name}")
        for number, element in enumerate(self.elements):
            words = [str(self.first + number + 1)] + [str(node) for node in element]
            result += [", ".join(words[i:i + 10]) + ("," if i + 10 < len(words) else "") for i in range(0, len(words), 10)]
        for side, faces in self.sides.items():
            result.append(f"*SURFACE, NAME={self.name}_{side}, TYPE=ELEMENT")
            result += [f"{element}, S{face}" for element, face in faces]
            result.append(f"*NSET, NSET=N_{self.name}_{side}")
            result += [f"{node}," for node in self.on(side)]
        return result
