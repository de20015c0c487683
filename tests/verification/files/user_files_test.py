"""Mesh files as users' programs write them, through `mortise check`: which are read, and what the others are refused for.

usage: user_files_test.py DIRECTORY MORTISE [MORTISE ...]

Writes the files and a scene for each to DIRECTORY. Ends with an error if the last program does not do with each what is expected. With several
programs a table of what each of them does is printed.
"""
import os
import subprocess
import sys

import netCDF4
import numpy

NODES = "*NODE\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n5,0,0,1\n6,1,0,1\n7,1,1,1\n8,0,1,1\n"
CUBE = "*ELEMENT, TYPE=C3D8, ELSET=CUBE\n1, 1,2,3,4,5,6,7,8\n"
TOP = "*SURFACE, NAME=TOP\nCUBE, S2\n"
PLATE = "*NODE\n1,-2,-2,2\n2,3,-2,2\n3,3,3,2\n4,-2,3,2\n*ELEMENT, TYPE=S4, ELSET=PLATE\n1, 1,2,3,4\n"


def parameter(name, value, kind="string"):
    return f'<Parameter name="{name}" type="{kind}" value="{value}"/>'


def parameter_list(name, *entries):
    return f'<ParameterList name="{name}">' + "".join(entries) + "</ParameterList>"


def scene(file, dimension=3, set_name="part", mesh=()):
    """A body from a file, whose set is held."""
    kinematics = "plane strain" if dimension == 2 else "three dimensional"
    held = [parameter(axis, "0", "double") for axis in "xyz"[:dimension]]
    steel = [parameter("type", "hencky"), parameter("young's modulus", "1", "double"), parameter("poisson's ratio", "0.3", "double")]
    return parameter_list(
        "scene", parameter("kinematics", kinematics), parameter_list("materials", parameter_list("steel", *steel)),
        parameter_list("bodies", parameter_list("part", parameter("material", "steel"),
                                                parameter_list("mesh", parameter("type", "file"), parameter("file", file), *mesh))),
        parameter_list("boundary conditions", parameter_list("hold", parameter("set", set_name), *held)))


def rigid_plate(file, set_name):
    """A cube below a rigid plate of a file, whose set is the master."""
    cube = [parameter("type", "brick"), parameter("cells x", "1", "int"), parameter("cells y", "1", "int"), parameter("cells z", "1", "int")]
    steel = [parameter("type", "hencky"), parameter("young's modulus", "1", "double"), parameter("poisson's ratio", "0.3", "double")]
    held = [parameter(axis, "0", "double") for axis in "xyz"]
    return parameter_list(
        "scene", parameter("kinematics", "three dimensional"), parameter_list("materials", parameter_list("steel", *steel)),
        parameter_list("bodies", parameter_list("cube", parameter("material", "steel"), parameter_list("mesh", *cube)),
                       parameter_list("plate", parameter("rigid", "true", "bool"), parameter_list("mesh", parameter("type", "file"), parameter("file", file)))),
        parameter_list("boundary conditions", parameter_list("hold", parameter("set", "cube/bottom"), *held),
                       parameter_list("plate", parameter("set", "plate/reference"), parameter("z", "-1.1*t"), *held[:2],
                                      *(parameter(f"rotation {axis}", "0", "double") for axis in "xyz"))),
        parameter_list("contact", parameter_list("pair", parameter("slave", "cube/top"), parameter("master", set_name))))


def exodus(path, nodes, blocks, sides, dimension=3, title="a title"):
    """blocks: (type, connectivity); sides: (element, side), from 1. The classic format, as Cubit writes it."""
    file = netCDF4.Dataset(path, "w", format="NETCDF3_64BIT_OFFSET")
    file.api_version = numpy.float32(4.93)
    file.version = numpy.float32(4.93)
    file.floating_point_word_size = numpy.int32(8)
    file.file_size = numpy.int32(1)
    file.title = title
    for name, length in (("len_string", 33), ("len_line", 81), ("four", 4), ("num_dim", dimension), ("num_nodes", len(nodes)),
                         ("num_elem", sum(len(block[1]) for block in blocks)), ("num_el_blk", len(blocks)), ("num_side_sets", 1),
                         ("num_side_ss1", len(sides)), ("time_step", None)):
        file.createDimension(name, length)
    for axis in range(dimension):
        file.createVariable("coord" + "xyz"[axis], "f8", ("num_nodes",))[:] = [node[axis] for node in nodes]
    file.createVariable("eb_status", "i4", ("num_el_blk",))[:] = 1
    file.createVariable("eb_prop1", "i4", ("num_el_blk",))[:] = range(1, len(blocks) + 1)
    file["eb_prop1"].setncattr("name", "ID")
    for number, (kind, connectivity) in enumerate(blocks, 1):
        file.createDimension(f"num_el_in_blk{number}", len(connectivity))
        file.createDimension(f"num_nod_per_el{number}", len(connectivity[0]))
        variable = file.createVariable(f"connect{number}", "i4", (f"num_el_in_blk{number}", f"num_nod_per_el{number}"))
        variable[:] = connectivity
        variable.elem_type = kind
    file.createVariable("ss_status", "i4", ("num_side_sets",))[:] = 1
    file.createVariable("ss_prop1", "i4", ("num_side_sets",))[:] = 1
    file["ss_prop1"].setncattr("name", "ID")
    file.createVariable("elem_ss1", "i4", ("num_side_ss1",))[:] = [element for element, _ in sides]
    file.createVariable("side_ss1", "i4", ("num_side_ss1",))[:] = [side for _, side in sides]
    file.close()


CUBE_NODES = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
HEX = ("HEX8", [[1, 2, 3, 4, 5, 6, 7, 8]])
SQUARES = [(0, 0, 0), (1, 0, 0), (2, 0, 0), (0, 1, 0), (1, 1, 0), (2, 1, 0)]
TWO_QUADS = ("QUAD4", [[1, 2, 5, 4], [2, 3, 6, 5]])


def quadratic_tetrahedra(middle):
    """Two of them; the node in the middle of one edge is moved along it."""
    corners = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 1)]
    nodes, middles, elements = list(corners), {}, []
    for own in ((0, 1, 2, 3), (1, 2, 3, 4)):
        element = list(own)
        for a, b in ((0, 1), (1, 2), (0, 2), (0, 3), (1, 3), (2, 3)):
            ends = (own[a], own[b])
            if ends not in middles:
                middles[ends] = len(nodes)
                nodes.append(tuple(0.5 * (x + y) for x, y in zip(corners[ends[0]], corners[ends[1]])) if ends != (0, 1) else (middle, 0, 0))
            element.append(middles[ends])
        elements.append(element)
    text = "*NODE\n" + "".join(f"{n}, {x}, {y}, {z}\n" for n, (x, y, z) in enumerate(nodes, 1)) + "*ELEMENT, TYPE=C3D10\n"
    return text + "".join(f"{e}, " + ", ".join(str(n + 1) for n in element) + "\n" for e, element in enumerate(elements, 1))


class Files:
    """Cases: what the file is, its scene, the exit code that is right, and what the output has to say."""

    def __init__(self, directory):
        self.directory = os.path.abspath(directory)
        self.cases = []

    def path(self, name):
        return os.path.join(self.directory, name)

    def write(self, name, content):
        with open(self.path(name), "wb") as file:
            file.write(content if isinstance(content, bytes) else content.encode())
        return name

    def add(self, what, scene_text, code, says=""):
        name = f"scene_{len(self.cases) + 1}.xml"
        self.write(name, scene_text)
        self.cases.append((what, self.path(name), code, says))

    def deck(self, what, text, code=0, says="", set_name="part", dimension=3, mesh=()):
        name = self.write(f"deck_{len(self.cases) + 1}.inp", text)
        self.add(what, scene(name, dimension, set_name, mesh), code, says)


def write_all(files):
    exodus(files.path("title.exo"), CUBE_NODES, [HEX], [(1, 6)], title="x" * 81)
    files.add("Exodus, title of 81 characters", scene("title.exo", set_name="part/side set 1"), 0)
    exodus(files.path("plane.exo"), SQUARES, [TWO_QUADS], [(1, 1), (2, 1)])
    files.add("Exodus, side 1 of QUAD4 with z: the bottom", scene("plane.exo", 2, "part/side set 1"), 0, "side set 1, surface")
    exodus(files.path("edges.exo"), SQUARES, [TWO_QUADS], [(2, 2), (1, 4)])
    files.add("Exodus, sides 2 and 4 of QUAD4 with z", scene("edges.exo", 2, "part/side set 1"), 0, "side set 1, surface")
    shells = ("SHELL4", TWO_QUADS[1])
    exodus(files.path("shells.exo"), SQUARES, [shells], [(1, 3), (2, 3)])
    files.add("Exodus, edges of SHELL4 in a plane scene", scene("shells.exo", 2, "part/side set 1"), 0, "side set 1, surface")
    exodus(files.path("faces.exo"), SQUARES, [shells], [(1, 1)])
    files.add("Exodus, faces of SHELL4 in a plane scene: noted", scene("faces.exo", 2), 0, "as they lie in the plane of the model")
    plate = [(-2, -2, 2), (3, -2, 2), (3, 3, 2), (-2, 3, 2)]
    exodus(files.path("above.exo"), plate, [("SHELL4", [[1, 2, 3, 4]])], [(1, 2)])
    files.add("Exodus, side 2 of a rigid SHELL4 is the master", rigid_plate("above.exo", "plate/side set 1"), 0, "1 of 1 facets were turned")
    exodus(files.path("named.inp"), CUBE_NODES, [HEX], [(1, 6)])
    files.add("Exodus named .inp", scene("named.inp"), 2, "by its content it is netCDF or HDF5, as Exodus II is")

    own = "*PART, NAME=P\n*END PART\n*ASSEMBLY, NAME=A\n*INSTANCE, NAME=P-1, PART=P\n" + NODES + CUBE + TOP + "*END INSTANCE\n*END ASSEMBLY\n"
    files.deck("*INSTANCE with its own mesh", own, set_name="part/P-1.TOP")
    others = "*ELEMENT, TYPE=SPRINGA, ELSET=SPRINGS\n10, 1, 2\n*ELEMENT, TYPE=MASS, ELSET=MASSES\n11, 1\n*ELEMENT, TYPE=B31\n12, 1, 2\n"
    others += "*ELEMENT, TYPE=GAPUNI, ELSET=GAPS\n13, 3, 4\n*ELSET, ELSET=ALL\n1, 10, 11\n*SPRING, ELSET=SPRINGS\n\n10.\n"
    files.deck("springs, masses, beams, gaps beside solids", NODES + CUBE + others, says="elements that are left out, as they have no cells here")
    files.deck("a set of springs that the scene names", NODES + CUBE + others, 2, "its 1 elements are of types that are not read", "part/SPRINGS")
    files.deck("lines of Gmsh (T3D2) beside solids", NODES + "*ELEMENT, TYPE=T3D2, ELSET=Line1\n1, 1, 2\n*ELEMENT, TYPE=C3D8, ELSET=CUBE\n2, 1,2,3,4,5,6,7,8\n")
    files.write("up.inp", PLATE + "*SURFACE, NAME=FACE\nPLATE, SPOS\n")
    files.add("rigid S4 whose SPOS looks away: refused", rigid_plate("up.inp", "plate/FACE"), 2, "turns its back")
    files.write("down.inp", PLATE + "*SURFACE, NAME=FACE\nPLATE, SNEG\n")
    files.add("rigid S4 whose SNEG is the master", rigid_plate("down.inp", "plate/FACE"), 0, "1 of 1 facets were turned")
    files.deck("*NSET, ELSET=", NODES + CUBE + "*NSET, NSET=OF CUBE, ELSET=CUBE\n", set_name="part/OF CUBE")
    files.deck("sets behind *STEP", NODES + CUBE + "*STEP\n*STATIC\n*SURFACE, NAME=TOP\nCUBE, S2\n*END STEP\n", set_name="part/TOP")
    analytic = "*SURFACE, TYPE=REVOLUTION, NAME=PUNCH\nSTART, 0., 0.\nLINE, 1., 0.\n"
    files.deck("TYPE=REVOLUTION that nobody names", NODES + CUBE + analytic, says='the generator "revolved"')
    files.deck("TYPE=REVOLUTION that the scene names", NODES + CUBE + analytic, 2, "revolved", "part/PUNCH")
    files.deck("a byte order mark", b"\xef\xbb\xbf" + (NODES + CUBE).encode())
    files.deck("lines that end with CR", (NODES + CUBE).replace("\n", "\r"))
    files.deck("text in UTF-16", (NODES + CUBE).encode("utf-16"), 2, "text in UTF-16")
    files.deck("a node that stands twice at one place", NODES + "8, 0, 1, 1\n" + CUBE, says="stand twice with the same coordinates")
    files.deck("a node that stands twice at two places", NODES + "8, 0, 1, 2\n" + CUBE, 2, "node 8 stands twice, with other coordinates")
    files.deck("a *NODE line with two nodes", NODES + "9, 0, 0, 2, 10, 1, 0, 2\n" + CUBE, 2, "node 9 has 7 numbers behind its label")
    files.deck("a *NODE line with a normal", NODES.replace("8,0,1,1", "8,0,1,1,0,0,1") + CUBE)
    files.deck("an error beyond line 65 535", "**\n" * 70000 + NODES + CUBE + "*NSET, NSET=N\n99\n", 2, ":70013: error: there is no node 99")
    files.deck("elements of heat (DC3D8, C3D8T)", NODES + CUBE.replace("C3D8", "DC3D8") + "*ELEMENT, TYPE=C3D4T\n2, 1, 2, 3, 5\n", mesh=[parameter("blocks", "CUBE")])
    files.deck("Tet10 inside out at a corner alone", quadratic_tetrahedra(0.24), says="1 elements are turned inside out at a corner")
    files.deck("Tet10 inside out", quadratic_tetrahedra(-0.5), 2, "element 1 is inverted")
    files.deck("a hexahedron that is a wedge", NODES + CUBE.replace("3,4,5,6,7,8", "3,3,5,6,7,7"), says="1 hexahedra have corners that stand twice: they are wedges")
    files.deck("a hexahedron that is a pyramid", NODES + CUBE.replace("5,6,7,8", "5,5,5,5"), says="they are pyramids")
    files.deck("a quadrilateral that is a triangle", "*NODE\n1,0\n2,1\n3,1,1\n*ELEMENT, TYPE=CPE4\n1, 1,2,3,3\n", dimension=2, says="they are triangles")
    files.deck("a hexahedron with nodes twice that is nothing", NODES + CUBE.replace("1,2,3,4,5", "1,2,1,4,5"), 2, "stands in it twice")
    files.write("gmsh.inp", "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n")
    files.add("Gmsh named .inp", scene("gmsh.inp"), 2, "by its content it is a mesh of Gmsh")
    files.write("deck.msh", NODES + CUBE)
    files.add("Abaqus named .msh", scene("deck.msh"), 2, "by its content it is an input file of Abaqus or CalculiX")
    files.write("drawing.inp", "ISO-10303-21;\nHEADER;\n")
    files.add("STEP named .inp", scene("drawing.inp"), 2, "a drawing in STEP")


def main():
    directory, programs = sys.argv[1], sys.argv[2:]
    os.makedirs(directory, exist_ok=True)
    files = Files(directory)
    write_all(files)
    wrong = 0
    counts = [0] * len(programs)
    for what, path, code, says in files.cases:
        row = []
        for number, program in enumerate(programs):
            result = subprocess.run([program, "check", path], capture_output=True, text=True, timeout=60)
            text = result.stdout + result.stderr
            is_right = result.returncode == code and says in text
            counts[number] += is_right
            row.append("right" if is_right else f"exit {result.returncode}")
        if not is_right:
            wrong += 1
            print(f"WRONG: {what} ({path}): exit {result.returncode} for {code}; expected to read \"{says}\" in\n{text}")
        print("| " + " | ".join([what] + row) + " |")
    print(f"{len(files.cases)} files; right: " + ", ".join(str(count) for count in counts))
    sys.exit(1 if wrong else 0)


main()
