"""Three of the ordinary parts of inputs/parts on coarse meshes of Gmsh, against a closed form, CalculiX and an axisymmetric model.

    ordinary_parts_test.py GMSH MORTISE DIRECTORY
"""
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from ordinary_parts import meshed, run_mortise


def check(holds, text):
    print(("ok      " if holds else "FAILED  ") + text, flush=True)
    return 0 if holds else 1


def test_dovetail(run):
    """All of the flank slips: thrust over pull is (1 - mu)/(1 + mu) while it is drawn in, and (1 + mu)/(1 - mu) once it slips back."""
    code, found = run("dovetail", {"stepping/step": 0.5, "tables/speed/values": "0, 1, 0.2"}, h=6, w=3)
    up, down = 220 * 4 * 3, 0.2 * 220 * 4 * 3
    there, back = abs(found.get("largest_thrust", 0.0)) / up, abs(found.get("thrust", 0.0)) / down
    failures = check(code == 0 and abs(there * 1.2 / 0.8 - 1) <= 0.01, f"dovetail ends with {code}; thrust over pull is {there:.5g}, of a wedge {0.8 / 1.2:.5g}")
    return failures + check(abs(back * 0.8 / 1.2 - 1) <= 0.01, f"let go to a fifth it is {back:.5g}, of a wedge {1.2 / 0.8:.5g}")


def test_gear_teeth(run):
    """The force on the teeth; that of CalculiX 2.20, surface to surface, is of the mesh as drawn (docs/results/ordinary_parts.md)."""
    code, found = run("gear_teeth", {}, h=0.5)
    force, theirs = found.get("reaction", 0.0), 4336.829
    return check(code == 0 and abs(force / theirs - 1) <= 0.01, f"gear_teeth ends with {code}; the force is {force:.5g}, of CalculiX {theirs:.5g}")


def test_press_bush(run):
    """A quarter of the force of the same rings with axisymmetric Q8 cells of 0.5 mm (docs/results/ordinary_parts.md)."""
    code, found = run("press_bush", {}, h=6)
    force, theirs = found.get("reaction", 0.0), -6134.413 / 4
    return check(code == 0 and abs(force / theirs - 1) <= 0.02, f"press_bush ends with {code}; the force is {force:.5g}, of axisymmetric rings {theirs:.5g}")


def main():
    gmsh, program, directory = sys.argv[1:4]

    def run(name, settings, **sizes):
        place = os.path.join(directory, name)
        meshed(name, place, gmsh, **sizes)
        result = run_mortise(program, name, place, settings.items())
        print(f"        {name}: {result.get('dofs')} dofs, {result['steps']} steps, {result['iterations']} iterations, {result['seconds']:.1f} s")
        return result["code"], result["quantities"]

    return 1 if sum(test(run) for test in (test_dovetail, test_gear_teeth, test_press_bush)) else 0


if __name__ == "__main__":
    sys.exit(main())
