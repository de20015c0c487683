"""Meshes of Gmsh (MSH 4.1, text, second order) with the physical groups of a drawing: nodes, cells of each group, faces of a body's elements."""

CORNERS = {8: 2, 9: 3, 11: 4}                         # of Gmsh's kinds: edge of three nodes, triangle of six, tetrahedron of ten
FACES = {3: [(0, 1), (1, 2), (2, 0)], 4: [(0, 1, 2), (0, 3, 1), (1, 3, 2), (2, 3, 0)]}  # in CalculiX' order


class PartMesh:
    """Nodes by their numbers; `groups` has the cells of each physical group by dimension and name."""

    def __init__(self, path):
        with open(path, encoding="utf-8") as file:
            lines = iter(file.read().split("\n"))
        names, of_entity = {}, {}
        self.nodes, self.groups = {}, {}
        for line in lines:
            if line == "$PhysicalNames":
                for _ in range(int(next(lines))):
                    dimension, tag, name = next(lines).split(" ", 2)
                    names[int(dimension), int(tag)] = name.strip('"')
            elif line == "$Entities":
                counts = [int(word) for word in next(lines).split()]
                for dimension, count in enumerate(counts):
                    for _ in range(count):
                        words = next(lines).split()
                        first = 4 if dimension == 0 else 7
                        groups = words[first + 1:first + 1 + int(words[first])]
                        of_entity[dimension, int(words[0])] = [names[dimension, int(tag)] for tag in groups]
            elif line == "$Nodes":
                for _ in range(int(next(lines).split()[0])):
                    count = int(next(lines).split()[3])
                    tags = [int(next(lines)) for _ in range(count)]
                    for tag in tags:
                        self.nodes[tag] = tuple(float(word) for word in next(lines).split()[:3])
            elif line == "$Elements":
                for _ in range(int(next(lines).split()[0])):
                    dimension, entity, kind, count = (int(word) for word in next(lines).split())
                    cells = [tuple(int(word) for word in next(lines).split()[1:]) for _ in range(count)]
                    for name in of_entity.get((dimension, entity), []):
                        if kind not in CORNERS:
                            raise RuntimeError(f"{path}: group {name} has cells of Gmsh's kind {kind}; allowed are those of second order, 8, 9 and 11")
                        self.groups.setdefault((dimension, name), []).extend(cells)
        self.dimension = max(dimension for dimension, _ in self.groups)

    def elements(self, body):
        """Cells of a body in CalculiX' order, in the plane counterclockwise."""
        cells = self.groups[self.dimension, body]
        if self.dimension == 3:
            return [cell[:8] + (cell[9], cell[8]) for cell in cells]
        turned = []
        for cell in cells:
            (ax, ay, _), (bx, by, _), (cx, cy, _) = (self.nodes[node] for node in cell[:3])
            area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
            turned.append(cell if area > 0 else (cell[0], cell[2], cell[1], cell[5], cell[4], cell[3]))
        return turned

    def faces(self, body, name):
        """Element of the body (counted from 0), face (from 1) and nodes of each face that a group of the drawing has."""
        elements = self.elements(body)
        wanted = {tuple(sorted(cell[:self.dimension])): cell for cell in self.groups[self.dimension - 1, name]}
        found = []
        for number, cell in enumerate(elements):
            for face, corners in enumerate(FACES[self.dimension + 1]):
                key = tuple(sorted(cell[corner] for corner in corners))
                if key in wanted:
                    found.append((number, face + 1, wanted[key]))
        return found

    def area(self, cell):
        """Of a face with straight edges."""
        a, b, c = (self.nodes[node] for node in cell[:3])
        u, v = [y - x for x, y in zip(a, b)], [y - x for x, y in zip(a, c)]
        cross = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
        return 0.5 * sum(x * x for x in cross) ** 0.5
