"""Meshes of generators, written to each format and read back: the same quantities on 1, 2 and 3 ranks.

usage: mesh_files_test.py MPIRUN MORTISE DIRECTORY

Two blocks are pressed on one another with friction. Their meshes are taken from a run's fields, written here as text of Gmsh 2.2 and of Abaqus, by the
program gmsh as 4.1 and in binary, and by `mortise export` as Exodus II. Nodes keep their order but for gmsh's own files, so that quantities agree to round-off.
"""
import json
import os
import re
import shutil
import subprocess
import sys

import h5py
import numpy

TOLERANCE = 1e-12  # over the scale of each quantity
SHAPES = {  # number in XDMF: corners, nodes, number in Gmsh, name in Abaqus, order in Gmsh, sides by corners (and edges between them)
    4: (3, 3, 2, "CPE3", None),
    5: (4, 4, 3, "CPE4", None),
    36: (3, 6, 9, "CPE6", None),
    37: (4, 8, 16, "CPE8", None),
    6: (4, 4, 4, "C3D4", None),
    9: (8, 8, 5, "C3D8", None),
    8: (6, 6, 6, "C3D6", None),
    38: (4, 10, 11, "C3D10", [0, 1, 2, 3, 4, 5, 6, 7, 9, 8]),
    48: (8, 20, 17, "C3D20", [0, 1, 2, 3, 4, 5, 6, 7, 8, 11, 16, 9, 17, 10, 18, 19, 12, 15, 13, 14]),
    40: (6, 15, 18, "C3D15", [0, 1, 2, 3, 4, 5, 6, 8, 12, 7, 13, 14, 9, 11, 10]),
}
SIDES = {  # corners of the sides; in the order of Abaqus' faces
    (2, 3): [(0, 1), (1, 2), (2, 0)],
    (2, 4): [(0, 1), (1, 2), (2, 3), (3, 0)],
    (3, 4): [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)],
    (3, 6): [(0, 2, 1), (3, 4, 5), (0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5)],
    (3, 8): [(0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)],
}
SCENE = """<ParameterList name="two blocks">
  <Parameter name="kinematics" type="string" value="{kinematics}"/>
  <ParameterList name="materials"><ParameterList name="soft">
    <Parameter name="type" type="string" value="neo hooke"/><Parameter name="young's modulus" type="double" value="1"/>
    <Parameter name="poisson's ratio" type="double" value="0.3"/></ParameterList></ParameterList>
  <ParameterList name="bodies">
    <ParameterList name="lower"><Parameter name="material" type="string" value="soft"/>{element}{lower}</ParameterList>
    <ParameterList name="upper"><Parameter name="material" type="string" value="soft"/>{element}{upper}</ParameterList>
  </ParameterList>
  <ParameterList name="boundary conditions">
    <ParameterList name="floor"><Parameter name="set" type="string" value="lower/bottom"/>{fixed}</ParameterList>
    <ParameterList name="hand"><Parameter name="set" type="string" value="upper/top"/>{moved}</ParameterList>
  </ParameterList>
  <ParameterList name="contact"><ParameterList name="joint">
    <Parameter name="slave" type="string" value="upper/bottom"/><Parameter name="master" type="string" value="lower/top"/>
    <ParameterList name="friction"><Parameter name="type" type="string" value="coulomb"/>
      <Parameter name="coefficient" type="double" value="0.2"/></ParameterList></ParameterList></ParameterList>
  <ParameterList name="stepping"><Parameter name="step" type="double" value="0.5"/></ParameterList>
  <ParameterList name="output"><Parameter name="fields" type="string" value="displacement"/></ParameterList>
  <ParameterList name="quantities">
    <ParameterList name="push"><Parameter name="type" type="string" value="reaction"/><Parameter name="set" type="string" value="upper/top"/>
      <Parameter name="component" type="string" value="{up}"/></ParameterList>
    <ParameterList name="drag"><Parameter name="type" type="string" value="reaction"/><Parameter name="set" type="string" value="upper/top"/>
      <Parameter name="component" type="string" value="x"/></ParameterList>
    <ParameterList name="peak"><Parameter name="type" type="string" value="peak pressure"/></ParameterList>
    <ParameterList name="energy"><Parameter name="type" type="string" value="energy"/><Parameter name="of" type="string" value="stored"/></ParameterList>
  </ParameterList>
</ParameterList>
"""


def parameter(name, kind, value):
    return f'<Parameter name="{name}" type="{kind}" value="{value}"/>'


def mesh_list(parameters):
    return '<ParameterList name="mesh">' + "".join(parameters) + "</ParameterList>"


def block(dimension, cells, width, height, shift, swept):
    """A generated block: in 3D a brick, or for wedges a swept rectangle turned so that its ends are bottom and top."""
    if dimension == 2:
        return mesh_list([parameter("type", "string", "block"), parameter("width", "double", width), parameter("height", "double", height),
                          parameter("cells x", "int", cells), parameter("cells y", "int", 2), parameter("translation", "string", f"{shift}, {0 if shift == 0 else 1}")])
    place = parameter("translation", "string", f"{shift}, {shift}, {0 if shift == 0 else 1}")
    if swept:
        profile = '<ParameterList name="profile">' + "".join(
            [parameter("type", "string", "block"), parameter("width", "double", width), parameter("height", "double", width), parameter("cells x", "int", cells),
             parameter("cells y", "int", cells)]) + "</ParameterList>"
        return mesh_list([parameter("type", "string", "extruded"), parameter("height", "double", height), parameter("cells z", "int", 2), profile, place])
    return mesh_list([parameter("type", "string", "brick"), parameter("width", "double", width), parameter("depth", "double", width), parameter("height", "double", height),
                      parameter("cells x", "int", cells), parameter("cells y", "int", cells), parameter("cells z", "int", 2), place])


def scene(dimension, element, meshes, swept=False):
    up = "y" if dimension == 2 else "z"
    directions = ["x", "y", "z"][:dimension]
    text = SCENE.format(kinematics="plane strain" if dimension == 2 else "three dimensional", element=parameter("element", "string", element) if element else "",
                        lower=meshes[0], upper=meshes[1], up=up, fixed="".join(parameter(i, "double", 0) for i in directions),
                        moved="".join(parameter(i, "string", {"x": "0.02*t", up: "-0.05*t"}.get(i, "0")) for i in directions))
    if swept:
        text = text.replace("/bottom", "/start").replace("/top", "/end")
    return text


def run(mpirun, program, path, results, ranks=1):
    command = [program, "run", path, "-o", results, "--quiet"]
    if ranks > 1:
        command = [mpirun, "-n", str(ranks)] + command
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(command)} ended with {done.returncode}:\n{done.stdout}{done.stderr}")
    with open(os.path.join(results, "summary.json"), encoding="utf-8") as file:
        return json.load(file)["quantities"]


class Mesh:
    """One body of a run, with the sides at its lowest and highest place."""

    def __init__(self, file, body, dimension, names):
        with h5py.File(file) as data:
            coordinates, topology, bodies = (data[name][...] for name in ("coordinates", "topology", "body"))
        topology = topology.reshape(-1)
        elements, at = [], 0
        for of_body in bodies.reshape(-1):
            number = int(topology[at])
            nodes = [int(node) for node in topology[at + 1:at + 1 + SHAPES[number][1]]]
            at += 1 + len(nodes)
            if number in (8, 40):  # back from VTK's order
                nodes = [nodes[first + (a + 3) % 6] for first in range(0, len(nodes) - 3, 6) for a in range(6)] + (nodes[12:] if number == 40 else [])
            if of_body == body:
                elements.append((number, nodes))
        used = sorted({node for _, nodes in elements for node in nodes})
        place = {node: number for number, node in enumerate(used)}
        self.coordinates = coordinates[used]
        self.elements = [(number, [place[node] for node in nodes]) for number, nodes in elements]
        self.dimension = dimension
        heights = self.coordinates[:, dimension - 1]
        self.sides = {names[0]: self.sides_at(heights.min()), names[1]: self.sides_at(heights.max())}

    def sides_at(self, height):
        """(element, side) whose corners have the height."""
        found = []
        for element, (number, nodes) in enumerate(self.elements):
            for side, corners in enumerate(SIDES[self.dimension, SHAPES[number][0]]):
                if all(abs(self.coordinates[nodes[corner]][self.dimension - 1] - height) < 1e-9 for corner in corners):
                    found.append((element, side))
        return found

    def facet(self, element, side):
        """Corners of a side, then the nodes in the middle of its edges."""
        number, nodes = self.elements[element]
        corners = SIDES[self.dimension, SHAPES[number][0]][side]
        facet = [nodes[corner] for corner in corners]
        if SHAPES[number][1] > SHAPES[number][0]:
            ends = list(zip(corners, corners[1:] + corners[:1])) if self.dimension == 3 else [corners]
            for a, b in ends:
                middle = 0.5 * (self.coordinates[nodes[a]] + self.coordinates[nodes[b]])
                facet.append(min(nodes[SHAPES[number][0]:], key=lambda node: numpy.linalg.norm(self.coordinates[node] - middle)))
        return facet

    def gmsh(self):
        facets = {2: 1, 3: 2, 4: 3, 6: 9, 8: 16} if self.dimension == 3 else {2: 1, 3: 8}
        groups = list(self.sides)
        lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", str(len(groups) + 1)]
        lines += [f'{self.dimension - 1} {g + 1} "{name}"' for g, name in enumerate(groups)] + [f'{self.dimension} 9 "all of it"', "$EndPhysicalNames"]
        lines += ["$Nodes", str(len(self.coordinates))]
        lines += [f"{n + 1} " + " ".join(repr(float(x)) for x in point) for n, point in enumerate(self.coordinates)] + ["$EndNodes"]
        elements = []
        for number, nodes in self.elements:
            order = SHAPES[number][4] or range(len(nodes))
            elements.append((SHAPES[number][2], 9, [nodes[a] for a in order]))
        for g, name in enumerate(groups):
            for side in self.sides[name]:
                facet = self.facet(*side)
                elements.append((facets[len(facet)], g + 1, facet))
        lines += ["$Elements", str(len(elements))]
        lines += [f"{e + 1} {kind} 2 {group} {group} " + " ".join(str(node + 1) for node in nodes) for e, (kind, group, nodes) in enumerate(elements)]
        return "\n".join(lines + ["$EndElements", ""])

    def abaqus(self):
        lines = ["*HEADING", "a block", "*NODE"] + [f"{n + 1}, " + ", ".join(repr(float(x)) for x in point[:self.dimension]) for n, point in enumerate(self.coordinates)]
        last = None
        for e, (number, nodes) in enumerate(self.elements):
            if number != last:
                lines.append(f"*ELEMENT, TYPE={SHAPES[number][3]}, ELSET=ALL_OF_IT")
                last = number
            words = [str(e + 1)] + [str(node + 1) for node in nodes]
            lines += [", ".join(words[:12]) + ("," if len(words) > 12 else "")] + ([", ".join(words[12:])] if len(words) > 12 else [])
        for name, sides in self.sides.items():
            lines += [f"*SURFACE, NAME={name}, TYPE=ELEMENT"] + [f"{element + 1}, S{side + 1}" for element, side in sides]
        return "\n".join(lines + [""])


def blocks_of_one_body(program, directory):
    """A body of hexahedra and wedges beside one whose name is what its second block would have: names of blocks differ, and either is read back."""
    folder = os.path.join(directory, "names")
    os.makedirs(folder)
    profile = '<ParameterList name="profile">' + "".join([parameter("type", "string", "block"), parameter("width", "double", 2.0), parameter("height", "double", 1.0),
                                                          parameter("cells x", "int", 2), parameter("cells y", "int", 1)]) + "</ParameterList>"
    ring = mesh_list([parameter("type", "string", "revolved"), parameter("angle", "double", 90.0), parameter("cells around", "int", 3), profile])
    brick = mesh_list([parameter("type", "string", "brick"), parameter("cells x", "int", 1), parameter("cells y", "int", 1), parameter("cells z", "int", 1),
                       parameter("translation", "string", "0, 5, 0")])

    def text(bodies):
        return ('<ParameterList name="names"><Parameter name="kinematics" type="string" value="three dimensional"/><ParameterList name="materials"><ParameterList name="soft">'
                + parameter("type", "string", "neo hooke") + parameter("young's modulus", "double", 1.0) + parameter("poisson's ratio", "double", 0.3)
                + "</ParameterList></ParameterList><ParameterList name='bodies'>" + "".join(f'<ParameterList name="{name}">' + parameter("material", "string", "soft") + mesh + "</ParameterList>"
                                                                                          for name, mesh in bodies)
                + "</ParameterList><ParameterList name='boundary conditions'>" + "".join(
                    f'<ParameterList name="of {name}">' + parameter("set", "string", name) + "".join(parameter(axis, "double", 0.0) for axis in "xyz") + "</ParameterList>" for name, _ in bodies)
                + "</ParameterList></ParameterList>")

    failures = []
    with open(os.path.join(folder, "names.xml"), "w", encoding="utf-8") as file:
        file.write(text([("one", ring), ("one (2)", brick)]))
    for arguments in (["run", "names.xml", "--quiet", "-o", "run"], ["export", "run", "-o", "names.exo"]):
        done = subprocess.run([program, *arguments], cwd=folder, capture_output=True, text=True)
        if done.returncode != 0:
            return [f"{' '.join(arguments)} ended with {done.returncode}: {done.stdout}{done.stderr}"]
    for blocks, elements in (("one, one (3)", 6), ("one (2)", 1)):
        with open(os.path.join(folder, "back.xml"), "w", encoding="utf-8") as file:
            file.write(text([("read", mesh_list([parameter("type", "string", "file"), parameter("file", "string", "names.exo"), parameter("blocks", "string", blocks)]))]))
        done = subprocess.run([program, "check", "back.xml"], cwd=folder, capture_output=True, text=True)
        found = [int(word) for line in done.stdout.splitlines() if "body read:" in line for word in re.findall(r"(\d+) elements", line)]
        if done.returncode != 0 or sum(found) != elements:
            failures.append(f'blocks "{blocks}" of an exported body: expected {elements} elements: {done.returncode}, {done.stdout}{done.stderr}')
    return failures


def main():
    mpirun, program, directory = sys.argv[1:4]
    shutil.rmtree(directory, ignore_errors=True)
    os.makedirs(directory)
    gmsh = shutil.which("gmsh")
    failures, compared = [], 0
    cases = [(2, "Q4"), (2, "T6"), (2, "Q8"), (3, "H8"), (3, "H20"), (3, "Tet10"), (3, "W6"), (3, "W15")]
    for dimension, element in cases:
        swept = element.startswith("W")
        names = ("start", "end") if swept else ("bottom", "top")
        folder = os.path.join(directory, element)
        os.makedirs(folder)
        generated = scene(dimension, element, [block(dimension, 3, 1.0, 1.0, 0, swept), block(dimension, 2, 0.8, 0.7, 0.1, swept)], swept)
        path = os.path.join(folder, "generated.xml")
        with open(path, "w", encoding="utf-8") as file:
            file.write(generated)
        expected = run(mpirun, program, path, os.path.join(folder, "generated"))
        bodies = [Mesh(os.path.join(folder, "generated", "fields", "mesh.h5"), body, dimension, names) for body in (0, 1)]
        formats = []
        for name, mesh in zip(("lower", "upper"), bodies):
            for ending, text in (("msh", mesh.gmsh()), ("inp", mesh.abaqus())):
                with open(os.path.join(folder, f"{name}.{ending}"), "w", encoding="utf-8") as file:
                    file.write(text)
            if gmsh:
                for target, options in (("binary.msh", ["-format", "msh22", "-bin"]), ("41.msh", ["-format", "msh41"]), ("41_binary.msh", ["-format", "msh41", "-bin"])):
                    subprocess.run([gmsh, os.path.join(folder, f"{name}.msh"), "-0", "-o", os.path.join(folder, f"{name}_{target}")] + options, check=True,
                                   capture_output=True)
        formats = ["{}.msh", "{}.inp"] + (["{}_binary.msh", "{}_41.msh", "{}_41_binary.msh"] if gmsh else [])
        for n, form in enumerate(formats):
            meshes = [mesh_list([parameter("type", "string", "file"), parameter("file", "string", form.format(name))]) for name in ("lower", "upper")]
            path = os.path.join(folder, form.format("both") + ".xml")
            with open(path, "w", encoding="utf-8") as file:
                file.write(scene(dimension, "", meshes, swept))
            for ranks in ((1, 2, 3) if n < 2 else (1,)):
                found = run(mpirun, program, path, os.path.join(folder, form.format("both") + f"_{ranks}"), ranks)
                for quantity, value in expected.items():
                    difference = abs(found[quantity] - value) / abs(value)
                    compared += 1
                    if not difference <= TOLERANCE * (1 if n < 2 and ranks == 1 else 10):
                        failures.append(f"{element}, {form}, {ranks} ranks: {quantity} is {found[quantity]!r} instead of {value!r} ({difference:.1e})")
        # Exodus, as the program writes it: blocks of bodies, whose surfaces get their names here by their normals.
        exported = os.path.join(folder, "run.exo")
        done = subprocess.run([program, "export", os.path.join(folder, "generated"), "-o", exported], capture_output=True, text=True)
        if done.returncode != 0:
            sys.exit(f"export ended with {done.returncode}:\n{done.stdout}{done.stderr}")
        meshes = [mesh_list([parameter("type", "string", "file"), parameter("file", "string", "run.exo"), parameter("blocks", "string", name)]) for name in ("lower", "upper")]
        text = scene(dimension, "", meshes, swept)
        sets = ""
        for body in ("lower", "upper"):
            for name, sign in zip(names, (-1, 1)):
                text = text.replace(f"{body}/{name}", f"{body} {name}")
                direction = ", ".join(["0"] * (dimension - 1) + [str(sign)])
                sets += (f'<ParameterList name="{body} {name}">' + parameter("of", "string", f"{body}/surface") + parameter("kind", "string", "sides")
                         + parameter("normal", "string", direction) + "</ParameterList>")
        text = text.replace('<ParameterList name="boundary conditions">', f'<ParameterList name="sets">{sets}</ParameterList><ParameterList name="boundary conditions">')
        path = os.path.join(folder, "exodus.xml")
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        for ranks in (1, 2):
            found = run(mpirun, program, path, os.path.join(folder, f"exodus_{ranks}"), ranks)
            for quantity, value in expected.items():
                difference = abs(found[quantity] - value) / abs(value)
                compared += 1
                if not difference <= 10 * TOLERANCE:
                    failures.append(f"{element}, exodus, {ranks} ranks: {quantity} is {found[quantity]!r} instead of {value!r} ({difference:.1e})")
    failures += blocks_of_one_body(program, directory)
    for line in failures:
        print(line)
    print(f"{compared} quantities compared, {len(failures)} differ{'' if gmsh else '; gmsh is not here, so its own files were not written'}")
    return 1 if failures or compared == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
