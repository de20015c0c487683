"""Computes examples of CalculiX with contact and ties by CalculiX and by Mortise on the same meshes, and writes the comparison as a page.

usage: calculix_examples.py MORTISE CCX DIRECTORY [PAGE [EXAMPLES]]

EXAMPLES is the folder of the decks (Debian: calculix-ccx-test). Scenes stand in calculix_examples/, one for each deck; DIRECTORY takes decks, scenes and
results. A case may change its deck, or split each hexahedron of it into eight, to show where a difference comes from; both programs then compute the
changed deck. A difference above its bound is wrong, and the exit code is 1.
"""
import json
import os
import shutil
import subprocess
import sys

from calculix_decks import deck_lines, refined, with_requests
from calculix_results import blocks_of, force, largest, mean, peak, pressure, reaction, times

SCENES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "calculix_examples")
EXAMPLES = "/usr/share/doc/calculix-ccx-test/examples/test"
X, Y, Z = range(3)

FULL = ("C3D20R", "C3D20")
STIFF = {"contact/joint/formulation/law/stiffness": "1e9"}
SWAPPED = {"ties/joint/slave": "lower/Master", "ties/joint/master": "upper/Slave"}
UPPER = [("9,3,1.,10,3,-1.", "12,3,1.,11,3,-1."), ("13,3,1.,10,3,-1.", "15,3,1.,11,3,-1."), ("14,3,1.,10,3,-1.", "16,3,1.,11,3,-1.")]
NODAL = [("TYPE=SURFACE TO SURFACE", "TYPE=NODE TO SURFACE"), ("1.e7,3.", "1.e7,.001")]
LAW = "discretisation: the law acts on nodal means of the gap in Mortise, at integration points in CalculiX; there is a single facet"
NODES = "discretisation: nodes on a surface against mortar, on meshes that do not match"
AXIS = "CalculiX takes a wedge of 2 degrees for the ring: its chord is shorter by 1 - cos(1 degree) = 0.015 %"
REDUCED = "reduced integration of C3D20R against full integration of H20"
INFINITY = "CalculiX rounds the corner of a linear law between nodes and surface: its pressure is less by its third number, 3"
TIE = "the tie of CalculiX holds its slave nodes alone, here those of the coarse side; Mortise holds means over facets"
EDGE = "discretisation: edges of the plates lie within the only row of slave facets, and the force at a point has no limit"
KINK = ("discretisation: adjusting leaves a flat strip, one facet wide; a node at its edge carries pressure on both of its facets in Mortise, an integration "
        "point of CalculiX on its own alone")
PLANE = ("equations of the deck keep both touching faces plane; a slave of Mortise cannot be kept so, and the scene has the cube's upper face plane; "
         "the law as below")
FACET = "discretisation: a corner of a slave facet touches; nodes carry pressure in Mortise, integration points in CalculiX"
# Deck, what it is, end time, and the ways to compute it: what is changed, how often hexahedra are split, texts of the deck to replace, bounds of the
# differences, their cause, and what is changed in the scene.
# Then the quantities: what it is, its name in the scene, what CalculiX is asked for and how that becomes one number.
CASES = [
    ("contactenergy", "cube on cube, C3D8; linear law, surfaces; small strain", 1, [
        ("", 0, [], [1e-6] * 6, "")], [
        ("displacement of the top", "top_displacement", mean("Nall", Z, (11, 12, 15, 16))),
        ("displacement of the cube's lower face", "bottom_displacement", mean("Nall", Z, (9, 10, 13, 14))),
        ("largest displacement of the base", "base_displacement", largest("Nall", Z, range(1, 9))),
        ("reaction", "reaction_z", reaction("Nfix", Z)),
        ("contact force", "contact_force", force("Sslav", "Smast", Z)),
        ("largest pressure", "peak_pressure", peak())]),
    ("contact1", "cube on cube, C3D8; exponential law, nodes on surface", 1, [
        ("", 0, [], [1e-6, 1e-6, 2e-5], "")], [
        ("displacement of the cube's lower face", "cube_displacement", mean("Nall", Z, (9, 10, 13, 14))),
        ("displacement of the base's upper face", "base_displacement", mean("Nall", Z, (3, 4, 7, 8))),
        ("contact force", "contact_force", times(0.03, peak()))]),
    ("contact4", "block on block, C3D20; linear law, surfaces", 1, [
        ("", 0, [], [0.002, 0.002, 1e-6], LAW),
        ("stiffness 1e9", 0, [("1.E7,1.", "1.E9,1.")], [5e-5, 0.002, 1e-6], "", STIFF)], [
        ("displacement of the top", "top_displacement", mean("Nfix2", Z)),
        ("largest displacement of the base", "base_displacement", largest("Nall", Z, range(1, 21))),
        ("contact force", "contact_force", force("Sslav", "Smast", Z))]),
    ("plate", "plate on plate, CPS8R; linear law, surfaces", 1, [
        ("", 0, [], [0.02, 0.02, 1e-6, 0.02], "reduced integration of CPS8R against full integration of Q8"),
        ("CPS8", 0, [("CPS8R", "CPS8")], [2e-4, 2e-4, 1e-6, 2e-4], LAW)], [
        ("displacement of the top", "top_displacement", mean("Nnunten", Y)),
        ("displacement of a corner at the top", "corner_displacement", mean("Nnunten", Y, (1, 4))),
        ("contact force", "contact_force", force("UPPER", "LOWER", Y)),
        ("mean pressure", "mean_pressure", pressure("UPPER", "LOWER"))]),
    ("ring2", "ring in ring, CAX8; press fit, linear law, surfaces", 1, [
        ("", 0, [], [3e-4] * 3, AXIS)], [
        ("radial displacement within", "inner_displacement", mean("Nall", X, (5,))),
        ("radial displacement outside", "outer_displacement", mean("Nall", X, (15,))),
        ("mean pressure", "mean_pressure", pressure("slave", "master"))]),
    ("cubespring", "cube on cube, C3D8; linear law, nodes on surface", 1, [
        ("", 0, [], [0.006, 0.005, 1e-5, 0.001], INFINITY),
        ("with 0.001 in place of 3", 0, [("1.e6,3.", "1.e6,.001")], [3e-4, 3e-4, 1e-5, 0.001], NODES)], [
        ("mean displacement of the top", "top_displacement", mean("Nload", Z)),
        ("largest displacement", "largest_displacement", largest("Nload", Z)),
        ("reaction", "reaction_z", reaction("Nfix", Z)),
        ("largest pressure", "peak_pressure", peak())]),
    ("friction1", "cube on cube, C3D8; friction that sticks, nodes on surface", 1, [
        ("", 0, [], [0.001, 0.001, 1e-5, 0.001], INFINITY),
        ("with 0.001 in place of 3", 0, [("1.e7,3.", "1.e7,.001")], [1e-4, 1e-4, 1e-5, 0.001], NODES)], [
        ("mean displacement of the top", "top_displacement", mean("Nload", Z)),
        ("largest displacement", "largest_displacement", largest("Nload", Z)),
        ("reaction", "reaction_z", reaction("Nfix", Z)),
        ("largest pressure", "peak_pressure", peak())]),
    ("fricloop", "cube drawn to and fro, C3D8; friction that slides, surfaces", 5, [
        ("", 0, [], [1e-4, 2e-4, 1, 1], PLANE),
        ("equations at the upper nodes", 0, UPPER, [1e-4, 2e-4, 0.05, 0.02], LAW),
        ("equations at the upper nodes, stiffness 1e9", 0, UPPER + [("\n1.e7", "\n1.e9")], [1e-4, 1e-5, 0.001, 0.001], "", STIFF)], [
        ("contact force at the end", "contact_force", force("Sslav", "Smast", Z)),
        ("force of friction at the end", "shear_force", force("Sslav", "Smast", Y)),
        ("displacement of the lower face", "bottom_y", mean("Nall", Y, (9, 10, 13, 14))),
        ("displacement of the upper face", "top_y", mean("Nall", Y, (11, 12, 15, 16)))]),
    ("beamptied1", "cantilever of two halves, C3D20R; a tie of nodes and a surface; small strain", 1, [
        ("", 0, [], [0.01, 0.01, 1e-6], REDUCED),
        ("C3D20", 0, [FULL], [1e-5, 1e-5, 1e-6], "")], [
        ("mean displacement of the end", "tip_y", mean("LOAD", Y)),
        ("mean displacement of the joint", "joint_y", mean("dep", Y)),
        ("reaction", "reaction_y", reaction("FIX", Y))]),
    ("beamptied2", "the same with a tie of surfaces", 1, [
        ("", 0, [], [0.01, 0.01, 1e-6], REDUCED),
        ("C3D20", 0, [FULL], [1e-5, 1e-5, 1e-6], "")], [
        ("mean displacement of the end", "tip_y", mean("LOAD", Y)),
        ("mean displacement of the joint", "joint_y", mean("dep", Y)),
        ("reaction", "reaction_y", reaction("FIX", Y))]),
    ("beamptied5", "two halves of a beam pressed together, C3D20R; friction, surfaces; the static step", 1, [
        ("", 0, [], [0.005, 1e-4], REDUCED),
        ("C3D20", 0, [FULL], [5e-5, 5e-5], "")], [
        ("reaction", "reaction_z", reaction("FIX", Z)),
        ("mean displacement of the joint", "joint_z", mean("dep", Z))]),
    ("cubef2f1", "tetrahedra C3D10 on hexahedra C3D20, sheared; law TIED; small strain", 1, [
        ("", 0, [], [0.01, 0.01], "the law's stiffness, 6 E/h of the fine side, against a tie"),
        ("stiffness 1e9, in Mortise the fine side as slave", 0, [("1.e7", "1.e9")], [2e-4, 2e-4], "", SWAPPED)], [
        ("force at the top", "drive_force", reaction("Ntop", X, 0.5)),
        ("largest z displacement of the top", "top_z", largest("Ntop", Z))]),
    ("cubef2f3", "the same with a tie", 1, [
        ("", 0, [], [0.08, 0.03], TIE),
        ("the fine side as slave, in Mortise too", 0, [("Slave,Master", "Master,Slave")], [2e-4, 2e-4], "", SWAPPED)], [
        ("force at the top", "drive_force", reaction("Ntop", X, 0.5)),
        ("largest z displacement of the top", "top_z", largest("Ntop", Z))]),
    ("punch1", "cylinder on cube, C3D20; adjusted, linear law, surfaces", 1, [
        ("", 0, [], [0.1, 0.1, 1e-6], KINK),
        ("nodes on surface in CalculiX", 0, NODAL, [0.04, 0.04, 1e-5], "both have pressures at nodes: the rest of it"),
        ("each element split into 8", 1, [], [0.06, 0.06, 1e-5], KINK),
        ("nodes on surface, each element split into 8", 1, NODAL, [0.02, 0.02, 1e-5], "as above: it halves with the size of the elements")], [
        ("mean displacement of the top", "top_displacement", mean("Nload", Z)),
        ("largest displacement of the top", "largest_displacement", largest("Nload", Z)),
        ("reaction", "reaction_z", reaction("Nfix", Z))]),
    ("contact2", "two cantilevers drawn together, C3D20; linear law, surfaces; large rotations; the first two steps", 2, [
        ("", 0, [], [0.003, 0.004, 0.01], FACET)], [
        ("displacement of node 395", "node_395", mean("Nall", Y, (395,))),
        ("displacement of node 501", "node_501", mean("Nall", Y, (501,))),
        ("contact force", "contact_force", force("Sslav", "Smast", Y))]),
    ("beamcontact", "cantilever between two plates, C3D20R and C3D8; linear law, surfaces", 1, [
        ("", 0, [], [1, 1, 1, 1], REDUCED + "; " + EDGE),
        ("C3D20", 0, [FULL], [1, 1, 1, 1], EDGE),
        ("C3D20, each element split into 8", 1, [FULL], [0.03, 0.03, 0.03, 0.03], "discretisation: the plates' edges are sharp, and the force at a point has no limit")], [
        ("contact force on plate 1", "force_one", force("Sslav1", "Smast1", X)),
        ("contact force on plate 2", "force_two", force("Sslav2", "Smast2", X)),
        ("displacement of node 204", "node_204", mean("Nall", X, (204,)))]),
]
MISSING = [
    ("ring1", "temperatures and thermal expansion"),
    ("changefric, friction2", "a friction coefficient that changes with time: `coefficient` is an expression of pressure and slip; friction2 also frees "
                              "supports in a later step"),
    ("changesurfbeh, contact2's third step", "a tie that becomes contact, and a pair that ends, in a later step"),
    ("fricloop as it is",
     "slave nodes that share their displacement along the normal: a slave node that follows a reference point carries no multiplier"),
    ("thread", "sections of pre-tension, and equations of several nodes"),
    ("bolt", "plane stress and axisymmetric bodies in one scene"),
    ("scheibe2f2f, scheibe2n2f, ringfcontact1 to 5, and decks of segments", "cyclic symmetry; most of them also frequencies"),
    ("contact5, contact5lin, ball, contdamp1, contdamp2", "dynamics"),
    ("contact7, contact8, contact9", "conduction of heat"),
    ("contact10, contact11", "shells and beams"),
    ("metalforming, metalformingmortar", "names that stand for a surface of elements and one of nodes"),
    ("beamptied3, beamptied4, beamptied6, beamptied7", "frequencies: their static steps are those of beamptied5 and of the ties"),
]


def compute(program, ccx, directory, examples, name, level, changes, settings, quantities, end):
    """Values of CalculiX and of Mortise."""
    os.makedirs(directory, exist_ok=True)
    lines = with_requests(deck_lines(examples, name), dict.fromkeys(request for _, _, (request, _) in quantities))
    for _ in range(level):
        lines = refined(lines)
    text = "\n".join(lines) + "\n"
    for old, new in changes:
        if old not in text:
            raise RuntimeError(f"{name}: the deck has no {old}")
        text = text.replace(old, new)
    with open(os.path.join(directory, name + ".inp"), "w", encoding="utf-8") as file:
        file.write(text)
    # Its exit code does not count: contact2 ends with an error in a step that is not compared.
    subprocess.run([ccx, name], cwd=directory, capture_output=True, text=True, timeout=600, env=dict(os.environ, OMP_NUM_THREADS="1"))
    with open(os.path.join(directory, name + ".dat"), encoding="utf-8") as file:
        blocks = blocks_of(file.read())
    theirs = [value(blocks, end) for _, _, (_, value) in quantities]
    shutil.copy(os.path.join(SCENES, name + ".xml"), directory)
    command = [program, "run", name + ".xml", "-o", name, "--quiet"] + [word for path, value in settings.items() for word in ("--set", f"{path}={value}")]
    done = subprocess.run(command, cwd=directory, capture_output=True, text=True, timeout=600)
    if done.returncode != 0:
        raise RuntimeError(f"{name}: Mortise ends with {done.returncode}: {done.stdout}{done.stderr}")
    with open(os.path.join(directory, name, "summary.json"), encoding="utf-8") as file:
        summary = json.load(file)["quantities"]
    return theirs, [summary[quantity] for _, quantity, _ in quantities]


PAGE = """# CalculiX' examples with contact and ties

This page compares {decks} of CalculiX' own examples (Debian: `calculix-ccx-test`, CalculiX 2.20) with the same problems in Mortise, on the same mesh
files. `tests/verification/calculix/calculix_examples.py` writes it. It takes the decks from the package and the scenes from
`tests/verification/calculix/calculix_examples/`.

    python3 tests/verification/calculix/calculix_examples.py build/release/apps/mortise/mortise ccx results/calculix_examples docs/results/calculix_examples.md

Pairs with a linear or an exponential law are `pressure overclosure` with the numbers of the deck. Decks with `NLGEOM` have St. Venant's and Kirchhoff's
law in both programs; all others have small strains. No example has a table for a law. Where the deck as it is differs, a row below it changes the one
thing that is named, in both programs if it is the mesh. `-` is a difference below 2e-6, which CalculiX' seven digits do not show. Forces and displacements
are means or sums over sets, unless a node or the largest one is named. Each difference has a bound in the script; {wrong} are above theirs.

| deck | what it is | quantity | CalculiX | Mortise | difference | cause |
|---|---|---|---|---|---|---|
{rows}

## What the differences are

* **Elements.** `C3D20R` and `CPS8R` are computed with full integration here. With `C3D20` and `CPS8` in the deck, ties and contacts that press
  evenly agree to five digits and more.
* **Laws.** A law is applied to nodal means of the gap here, and at integration points in CalculiX. On a single facet under a moment the soft law of a deck
  shows it; a stiff law or small facets do not.
* **Nodes on a surface.** CalculiX rounds the linear law there, which shifts it by a constant pressure. A set of nodes has the area of all faces that
  meet in a node: in `contact1` three faces of 0.01, two of which are free surfaces.
* **Ties.** CalculiX ties nodes to places of the other side. With the coarse side as slave, as in `cubef2f3`, most of the fine side is free, and the
  joint is 5.6 % too soft. Mortise differs by 0.2 % between its two choices of the slave.
* **Edges.** In `punch1` and `beamcontact` contact ends within a facet or at its edge. Coarse meshes decide what comes of it, in both programs. CalculiX'
  own two methods differ by 5.7 % on the mesh of `punch1`. The plates' forces of `beamcontact` are a couple with an arm of less than two facets of that
  mesh. That its differences vanish is not shown.

## Bodies of a single facet

In `contactenergy`, `contact4`, `plate` and `fricloop` one slave facet alone keeps a body from turning. In these scenes the upper corners share their
height, by a reference point, which bears the loads too. In the first three symmetry does the same.

## Examples that are not computed

| deck | what is missing |
|---|---|
{missing}

Not tried are hueeber1 to 4, which have 8500 elements, and contact3, contact6, cubef2f2 and punch2, which are like others here.
"""


def main():
    program, ccx, directory = (os.path.abspath(path) if os.sep in path else path for path in sys.argv[1:4])
    page = sys.argv[4] if len(sys.argv) > 4 else None
    examples = sys.argv[5] if len(sys.argv) > 5 else EXAMPLES
    rows, wrong = [], 0
    for name, what, end, ways, quantities in CASES:
        for i, (way, level, changes, bounds, cause, *settings) in enumerate(ways):
            settings = settings[0] if settings else {}
            theirs, ours = compute(program, ccx, os.path.join(directory, f"{name}_{i}"), examples, name, level, changes, settings, quantities, end)
            for j, ((text, _, _), a, b) in enumerate(zip(quantities, theirs, ours)):
                difference = abs(abs(b) - abs(a)) / abs(a) if a * b > 0 or "largest" in text else 2.0
                bound = bounds[min(j, len(bounds) - 1)]
                bad = difference > bound
                wrong += bad
                shown = "-" if difference < 2e-6 else f"{100 * difference:.2g} %"
                first = j == 0
                rows.append([(f"{name}" + (f", {way}" if way else "")) if first else "", what if first and i == 0 else "", text, f"{a:.6g}", f"{b:.6g}",
                             f"**{shown}**, above {100 * bound:.2g} %" if bad else shown, cause if first else ""])
                print("  ".join(rows[-1][:6]), flush=True)
    if page:
        with open(page, "w", encoding="utf-8") as file:
            file.write(PAGE.format(decks=len(CASES), wrong=wrong, rows="\n".join("| " + " | ".join(row) + " |" for row in rows),
                                   missing="\n".join(f"| {decks} | {what} |" for decks, what in MISSING)))
    print(f"{wrong} differences above their bounds")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
