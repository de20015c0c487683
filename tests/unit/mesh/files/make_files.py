#!/usr/bin/env python3
"""Writes the meshes of this folder with programs that know nothing of Mortise: gmsh, and meshio with netCDF4 (Debian: gmsh, python3-meshio,
python3-netcdf4). They all are the box of 2 x 1 x 1, or the rectangle of 2 x 1, with the names that mesh_file_formats_test.cpp expects."""

import pathlib
import subprocess
import tempfile

import meshio

FOLDER = pathlib.Path(__file__).parent

PLANE = """
Point(1) = {0, 0, 0};
Extrude {2, 0, 0} { Point{1}; Layers{2}; }
Extrude {0, 1, 0} { Curve{1}; Layers{1}; RECOMBINE }
"""
BOX = PLANE + """
Extrude {0, 0, 1} { Surface{5}; Layers{1}; RECOMBINE }
"""
NAMES_3D = """
Physical Volume("steel") = {1};
Physical Volume("all") = {1};
Physical Surface("top") = {27};
Physical Surface(77) = {26};
Physical Point("origin") = {1};
"""
NAMES_2D = """
Physical Surface("sheet") = {5};
Physical Curve("bottom") = {1};
Physical Point("origin") = {1};
"""
FORMATS = {"22_text": "-setnumber Mesh.MshFileVersion 2.2", "22_binary": "-setnumber Mesh.MshFileVersion 2.2 -bin",
           "41_text": "-setnumber Mesh.MshFileVersion 4.1", "41_binary": "-setnumber Mesh.MshFileVersion 4.1 -bin"}


def gmsh(geometry, order, options, name):
    with tempfile.NamedTemporaryFile("w", suffix=".geo") as file:
        file.write(geometry + f"Mesh.ElementOrder = {order}; Mesh.SecondOrderIncomplete = 1;\n")
        file.flush()
        dimension = "-3" if geometry.find("Surface{5}") >= 0 else "-2"
        subprocess.run(["gmsh", dimension, file.name, "-v", "1", "-o", name] + options.split(), check=True, cwd=FOLDER)


def geometry(shape):
    recombine = "Recombine;" if shape.startswith(("hexahedra", "quadrilaterals", "wedges")) else ""
    if shape.startswith("wedges"):
        return (PLANE.replace("RECOMBINE", "") + BOX[len(PLANE):].replace("RECOMBINE", recombine)) + NAMES_3D
    solid = shape.startswith(("hexahedra", "tetrahedra"))
    return (BOX + NAMES_3D if solid else PLANE + NAMES_2D).replace("RECOMBINE", recombine)


def main():
    for shape in ["hexahedra8", "hexahedra20", "tetrahedra4", "tetrahedra10", "wedges6", "wedges15", "triangles3", "triangles6", "quadrilaterals4",
                  "quadrilaterals8"]:
        order = 2 if shape in ["hexahedra20", "tetrahedra10", "wedges15", "triangles6", "quadrilaterals8"] else 1
        for suffix, options in FORMATS.items():
            gmsh(geometry(shape), order, options, f"gmsh_{suffix[0]}/{shape}_{suffix}.msh")
        if shape.startswith(("hexahedra", "tetrahedra", "wedges")):  # gmsh writes curves of plane meshes as trusses
            gmsh(geometry(shape), order, "-format inp -setnumber Mesh.SaveGroupsOfElements 1 -setnumber Mesh.SaveGroupsOfNodes 1", f"abaqus/{shape}.inp")
        if shape in ["tetrahedra10", "triangles6"]:
            mesh = meshio.read(FOLDER / f"gmsh_4/{shape}_41_text.msh")
            largest = max(block.dim for block in mesh.cells)
            meshio.write(FOLDER / f"exodus/{shape}.e", meshio.Mesh(mesh.points, [block for block in mesh.cells if block.dim == largest]))
    gmsh(geometry("tetrahedra4"), 1, "-part 2 -setnumber Mesh.MshFileVersion 4.1", "gmsh_4/tetrahedra4_partitioned.msh")
    gmsh(geometry("hexahedra8").replace(NAMES_3D, ""), 1, "-setnumber Mesh.MshFileVersion 4.1", "gmsh_4/hexahedra8_without_groups.msh")
    gmsh(geometry("hexahedra8"), 1, "-setnumber Mesh.MshFileVersion 4.0", "gmsh_4/version_40.msh")
    gmsh(geometry("hexahedra8"), 1, "-setnumber Mesh.MshFileVersion 1", "gmsh_2/version_1.msh")


if __name__ == "__main__":
    main()
