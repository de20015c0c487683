"""A ring pressed into another: Lame's pressure for each way to say the interference, each side as slave, in the plane, axisymmetric and in 3D.

usage: press_fit_test.py MPIRUN MORTISE DIRECTORY

Radii a = 20, b = 40, c = 60, radial interference d = 0.005, E = 196000 for both rings. With free ends the pressure is
  p = E d / b (c^2 - b^2) (b^2 - a^2) / (2 b^2 (c^2 - a^2))
whatever Poisson's ratio is (Timoshenko, Strength of Materials II, thick cylinders). Facets of two meshes that do not match leave each other by parts of
their sagitta. Where these are not small against the interference the pressure has ripples, so that such meshes have to be fine.
"""
import json
import math
import os
import re
import shutil
import subprocess
import sys

A, B, C, D, E, NU, H = 20.0, 40.0, 60.0, 0.005, 196000.0, 0.3, 8.0
LAME = E * D / B * (C**2 - B**2) * (B**2 - A**2) / (2 * B**2 * (C**2 - A**2))


def parameter(name, kind, value):
    return f'<Parameter name="{name}" type="{kind}" value="{value}"/>'


def named(name, *content):
    return f'<ParameterList name="{name}">' + "".join(content) + "</ParameterList>"


def ring(kinematics, inner, outer, cells, element):
    radial = 5
    if kinematics == "axisymmetric":
        mesh = named("mesh", parameter("type", "string", "block"), parameter("width", "double", outer - inner), parameter("height", "double", H),
                     parameter("cells x", "int", radial), parameter("cells y", "int", cells // 4), parameter("translation", "string", f"{inner!r}, 0"))
    else:
        sector = [parameter("type", "string", "ring sector"), parameter("inner radius", "double", inner), parameter("outer radius", "double", outer),
                  parameter("cells across", "int", radial), parameter("cells around", "int", cells)]
        mesh = named("mesh", *sector) if kinematics == "plane stress" else named("mesh", parameter("type", "string", "extruded"), parameter("height", "double", H),
                                                                                 parameter("cells z", "int", 2), named("profile", *sector))
    return parameter("material", "string", "steel") + parameter("element", "string", element) + mesh


def scene(kinematics, element, cells, way, slave, friction=0.0, push=False, begins=""):
    swept = kinematics == "three dimensional"
    drawn = D if way.startswith("drawn") else 0.0
    inner, outer = ("right", "left") if kinematics == "axisymmetric" else ("outer", "inner")
    sides = [f"shaft/{inner}", f"hub/{outer}"]
    if slave == "hub":
        sides.reverse()
    conditions = []
    for body in ("shaft", "hub"):
        if kinematics == "axisymmetric":
            if not (push and body == "shaft"):
                conditions.append((f"{body}/bottom", "y", "0"))
        else:
            start, end = ("start", "end")
            conditions += [(f"{body}/{start}", "y", "0"), (f"{body}/{end}", "x", "0")]
        if swept:
            conditions.append((f"{body}/sweep start", "z", "0"))
    if push:
        conditions = [("hub/right", "y", "0"), ("shaft/left", "y", "max(0, t - 1)*0.05")]  # slave nodes that are held bear no shear
    if kinematics == "axisymmetric":
        force = 2 * math.pi * B * H
    else:
        force = B * (H if swept else 1.0)
    ways = {"drawn": "", "drawn, ramped": parameter("overlap taken up at", "double", 1.0), "clearance": parameter("clearance", "double", -D),
            "clearance, ramped": parameter("clearance", "string", f"-{D}*min(t, 1)")}
    law = named("friction", parameter("type", "string", "coulomb"), parameter("coefficient", "double", friction)) if friction else ""
    quantities = named("force", parameter("type", "string", "contact force"), parameter("component", "string", "x")) + named(
        "peak", parameter("type", "string", "peak pressure"))
    if push:
        quantities += named("push", parameter("type", "string", "reaction"), parameter("set", "string", "shaft/left"), parameter("component", "string", "y"))
    text = named(
        "press fit", parameter("kinematics", "string", kinematics),
        named("materials", named("steel", parameter("type", "string", "small strain linear"), parameter("young's modulus", "double", E), parameter("poisson's ratio", "double", NU))),
        named("bodies", named("shaft", ring(kinematics, A, B + drawn, cells[0], element)), named("hub", ring(kinematics, B, C, cells[1], element))),
        named("boundary conditions", *[named(f"{n}", parameter("set", "string", where), parameter(component, "string", value)) for n, (where, component, value) in enumerate(conditions)]),
        named("contact", named("fit", parameter("slave", "string", sides[0]), parameter("master", "string", sides[1]), ways[way], begins, law)),
        named("stepping", parameter("end time", "double", 2.0 if push else 1.0), parameter("step", "double", 0.125 if push else 0.25 if "ramped" in way else 1.0)),
        named("output", parameter("fields", "string", "")), named("quantities", quantities))
    return text, force


def run(mpirun, program, directory, name, text, ranks=1, code=0):
    path, results = os.path.join(directory, name + ".xml"), os.path.join(directory, f"{name}_{ranks}")
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)
    command = ([mpirun, "-n", str(ranks)] if ranks > 1 else []) + [program, "run", path, "-o", results, "--quiet"]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != code:
        sys.exit(f"{' '.join(command)} ended with {done.returncode}:\n{done.stdout}{done.stderr}")
    if code != 0:
        return done.stdout + done.stderr
    with open(os.path.join(results, "summary.json"), encoding="utf-8") as file:
        return json.load(file)["quantities"]


def main():
    mpirun, program, directory = sys.argv[1:4]
    shutil.rmtree(directory, ignore_errors=True)
    os.makedirs(directory)
    failures, number = 0, 0

    def check(holds, text):
        nonlocal failures
        failures += not holds
        print(("ok      " if holds else "FAILED  ") + text)

    ways = ("drawn", "drawn, ramped", "clearance", "clearance, ramped")
    cases = [("axisymmetric", "Q4", (16, 16)), ("axisymmetric", "Q8", (16, 12)), ("plane stress", "Q4", (24, 24)), ("plane stress", "Q8", (40, 32)),
             ("three dimensional", "H8", (24, 24)), ("three dimensional", "H20", (12, 12))]
    for kinematics, element, cells in cases:
        for way in ways if kinematics != "three dimensional" else ("drawn, ramped", "clearance"):
            for slave in ("shaft", "hub"):
                text, area = scene(kinematics, element, cells, way, slave)
                number += 1
                found = run(mpirun, program, directory, f"fit_{number}", text, 2 if number % 3 == 0 else 1)
                mean = abs(found["force"]) / area
                check(abs(mean / LAME - 1) < 0.01 and abs(found["peak"] / LAME - 1) < 0.03,
                      f"{kinematics}, {element}, {way}, slave {slave}: mean pressure {mean / LAME:.4f}, peak {found['peak'] / LAME:.4f} of Lame's {LAME:.4f}")
    # Quadratic facets of two meshes of one circle leave each other by parts of their sagitta: that is no overlap, and no place to move nodes to.
    refuse = parameter("initial overlap", "string", "error")
    found = run(mpirun, program, directory, "touching", scene("plane stress", "Q8", (12, 9), "clearance", "shaft", begins=refuse)[0])
    check(abs(abs(found["force"]) / B / LAME - 1) < 0.01, "round quadratic surfaces that touch are not refused as overlapping")
    text = run(mpirun, program, directory, "overlapping", scene("plane stress", "Q4", (24, 24), "drawn", "shaft", begins=refuse)[0], code=2)
    depth = re.search(r"overlap by ([0-9.e-]+) at the start", text)
    check(depth is not None and abs(float(depth[1]) / D - 1) < 0.02, "overlaps that are real are refused where they are said to be errors")
    adjust = parameter("start", "string", "adjust") + parameter("tolerance", "double", 0.1)
    text = run(mpirun, program, directory, "adjusted", scene("plane stress", "Q8", (12, 9), "clearance", "shaft", begins=adjust)[0], code=2)
    check("are curved" in text, "nodes are not moved onto curved masters")
    # Pushed out by its lower end: each facet slips at mu p, which Poisson's ratio changes by as much as the push is of the pressure.
    text, area = scene("axisymmetric", "Q8", (16, 12), "clearance, ramped", "shaft", 0.1, True)
    found = run(mpirun, program, directory, "push_out", text)
    check(abs(abs(found["push"]) / (0.1 * LAME * area) - 1) < 0.05, f"pushed out with a coefficient of 0.1: {abs(found['push']):.1f}, {0.1 * LAME * area:.1f} by Coulomb and Lame")
    print(f"{failures} failed")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
