"""Contact pairs that the program finds: none missed, none through a wall, the same whatever bodies are called and in which order they stand.

usage: automatic_contact_test.py MPIRUN MORTISE DIRECTORY
"""
import json
import os
import random
import re
import shutil
import subprocess
import sys
import xml.etree.ElementTree as ElementTree

E, NU = 1000.0, 0.3


def parameter(name, kind, value):
    return f'<Parameter name="{name}" type="{kind}" value="{value}"/>'


def named(name, *content):
    return f'<ParameterList name="{name}">' + "".join(content) + "</ParameterList>"


def block(name, x, y, width, height, cells_x, cells_y, material="linear"):
    return (name, named(name, parameter("material", "string", material), named(
        "mesh", parameter("type", "string", "block"), parameter("width", "double", width), parameter("height", "double", height), parameter("cells x", "int", cells_x),
        parameter("cells y", "int", cells_y), parameter("translation", "string", f"{x}, {y}"))))


def disk(name, x, y, cells):
    return (name, named(name, parameter("material", "string", "linear"), named(
        "mesh", parameter("type", "string", "disk"), parameter("cells around", "int", cells), parameter("cells across", "int", 4),
        parameter("translation", "string", f"{x!r}, {y!r}"))))


def scene(bodies, conditions, quantities="", automatic=(), steps=1):
    return named(
        "parts",
        named("materials", named("linear", parameter("type", "string", "small strain linear"), parameter("young's modulus", "double", E),
                                 parameter("poisson's ratio", "double", NU)),
              named("stiff", parameter("type", "string", "small strain linear"), parameter("young's modulus", "double", 10 * E),
                    parameter("poisson's ratio", "double", NU))),
        named("bodies", *[body for _, body in bodies]),
        named("boundary conditions", *conditions),
        named("automatic contact", parameter("pairs", "string", "automatic"), *automatic),
        named("stepping", parameter("step", "double", 1.0 / steps)), named("output", parameter("fields", "string", "")),
        named("quantities", quantities))


class Runner:
    def __init__(self, mpirun, program, directory):
        self.mpirun, self.program, self.directory = mpirun, program, directory
        shutil.rmtree(directory, ignore_errors=True)
        os.makedirs(directory)

    def run(self, name, text, ranks=1, code=0):
        """Quantities, and contact pairs as (slave, master) sets of effective.xml, each set as the sets that it is a union of."""
        path, results = os.path.join(self.directory, name + ".xml"), os.path.join(self.directory, f"{name}_{ranks}")
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        command = ([self.mpirun, "-n", str(ranks)] if ranks > 1 else []) + [self.program, "run", path, "-o", results, "--quiet"]
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode != code:
            sys.exit(f"{' '.join(command)} ended with {done.returncode}:\n{done.stdout}{done.stderr}")
        if code != 0:
            return {}, [], done.stdout + done.stderr
        with open(os.path.join(results, "summary.json"), encoding="utf-8") as file:
            quantities = json.load(file)["quantities"]
        effective = os.path.join(results, "effective.xml")
        root = ElementTree.parse(effective).getroot()
        sets = {entry.get("name"): entry.find("Parameter[@name='of']").get("value").split(", ") for entry in root.findall("ParameterList[@name='sets']/ParameterList")}

        def parts(name):
            return [part for one in sets[name] for part in parts(one)] if name.startswith("masters of") else [name]

        pairs = [(entry.find("Parameter[@name='slave']").get("value"), parts(entry.find("Parameter[@name='master']").get("value")))
                 for entry in root.findall("ParameterList[@name='contact']/ParameterList")]
        with open(effective, encoding="utf-8") as file:
            return quantities, pairs, file.read()


def check(holds, text):
    print(("ok      " if holds else "FAILED  ") + text)
    return 0 if holds else 1


def close(one, other, tolerance):
    return one.keys() == other.keys() and all(abs(one[name] - other[name]) <= tolerance * max(abs(one[name]), 1e-6) for name in one)


def wall():
    """A wall of 18 bricks between two plates: 20 parts, which touch at 47 places. Alternate rows begin with half a brick."""
    bodies = [block("floor", 0, 0, 4, 0.5, 9, 1)]
    for row in range(4):
        widths = [1, 1, 1, 1] if row % 2 == 0 else [0.5, 1, 1, 1, 0.5]
        x = 0.0
        for n, width in enumerate(widths):
            bodies.append(block(f"brick {row}{n}", x, 0.5 + 0.5 * row, width, 0.5, int(4 * width) + (row + n) % 2, 3 + n % 2))
            x += width
    bodies.append(block("top", 0, 2.5, 4, 0.5, 7, 2))
    return bodies


def wall_conditions(bodies):
    conditions = [named("ground", parameter("set", "string", f"{bodies[0]}/bottom"), parameter("y", "double", 0)),
                  named("hand", parameter("set", "string", f"{bodies[-1]}/top"), parameter("y", "string", "-0.03*t"))]
    ends = [(bodies[0], bodies[0]), (bodies[1], bodies[4]), (bodies[5], bodies[9]), (bodies[10], bodies[13]), (bodies[14], bodies[18]), (bodies[19], bodies[19])]
    for n, (left, right) in enumerate(ends):
        conditions += [named(f"left {n}", parameter("set", "string", f"{left}/left"), parameter("x", "double", 0)),
                       named(f"right {n}", parameter("set", "string", f"{right}/right"), parameter("x", "double", 0))]
    return conditions


def test_wall(runner):
    bodies = wall()
    names = [name for name, _ in bodies]

    def quantities(top):
        return named("push", parameter("type", "string", "reaction"), parameter("set", "string", f"{top}/top"), parameter("component", "string", "y")) + named(
            "spread", parameter("type", "string", "spread"))

    found, pairs, effective = runner.run("wall", scene(bodies, wall_conditions(names), quantities("top")))
    touching = sum(len(masters) for _, masters in pairs)
    failures = check(touching == 47, f"20 parts touch at 47 places: {touching} found, in {len(pairs)} pairs")
    # Uniaxial strain of 0.03 over a height of 3 and a width of 4.
    exact = -E * (1 - NU) / ((1 + NU) * (1 - 2 * NU)) * 0.01 * 4
    failures += check(abs(found["push"] - exact) <= 1e-9 * abs(exact), f"the push is {found['push']:.12g}, exactly {exact:.12g}")
    failures += check(found["spread"] <= 1e-8, f"the stress is uniform to {found['spread']:.1e}")
    by_hand, pairs_by_hand, _ = runner.run("wall_by_hand", effective)
    failures += check(pairs_by_hand == pairs and close(by_hand, {**found}, 1e-10) or pairs_by_hand == pairs and abs(by_hand["push"] - found["push"]) <= 1e-10 * abs(exact),
                      "pairs by hand, those of effective.xml, give the same")
    for ranks in (2, 3):
        other, pairs_there, _ = runner.run("wall", scene(bodies, wall_conditions(names), quantities("top")), ranks)
        failures += check(pairs_there == pairs and abs(other["push"] - found["push"]) <= 1e-10 * abs(exact), f"the same pairs and push on {ranks} ranks")

    # Other names in another order: each pair by its sides' old names.
    renamed = {name: f"part {chr(97 + (7 * n) % 26)}{n}" for n, name in enumerate(names)}
    shuffled = [(renamed[name], body.replace(f'name="{name}"', f'name="{renamed[name]}"', 1)) for name, body in bodies]
    random.Random(3).shuffle(shuffled)
    other, pairs_there, _ = runner.run("wall_renamed", scene(shuffled, wall_conditions([renamed[name] for name in names]), quantities(renamed["top"])))
    old = {new: name for name, new in renamed.items()}

    def plain(pairs, names=None):
        back = (lambda text: re.sub(r"part [a-z]\d+", lambda match: old[match.group(0)], text)) if names else (lambda text: text)
        return sorted((back(slave), sorted(back(master) for master in masters)) for slave, masters in pairs)

    failures += check(plain(pairs_there, old) == plain(pairs), "the same sides under other names and in another order")
    failures += check(abs(other["push"] - found["push"]) <= 1e-10 * abs(exact), "and the same push")
    return failures


def test_thin_wall(runner):
    """Nothing is seen through a plate thinner than the reach, nor from one of its faces to the other."""
    bodies = [block("below", 0, -1, 2, 1, 4, 2), block("plate", 0, 0, 2, 0.05, 8, 1), block("above", 0, 0.05, 2, 1, 5, 2)]
    conditions = [named("floor", parameter("set", "string", "below/bottom"), parameter("x", "double", 0), parameter("y", "double", 0)),
                  named("hand", parameter("set", "string", "above/top"), parameter("x", "double", 0), parameter("y", "string", "-0.01*t")),
                  named("plate", parameter("set", "string", "plate/left"), parameter("x", "double", 0))]
    _, pairs, _ = runner.run("thin", scene(bodies, conditions, automatic=[parameter("reach", "double", 0.4)]))
    sides = sorted(tuple(sorted([slave] + masters)) for slave, masters in pairs)
    return check(sides == [("above/bottom", "plate/top"), ("below/top", "plate/bottom")], f"a thin plate between two blocks: {sides}")


def test_reach(runner):
    """A gap wider than an edge is found with a reach alone, and an overlap is found as well as a gap."""
    conditions = [named("floor", parameter("set", "string", "below/bottom"), parameter("x", "double", 0), parameter("y", "double", 0)),
                  named("hand", parameter("set", "string", "above/top"), parameter("x", "double", 0), parameter("y", "string", "-0.51*t"))]
    failures = 0
    bodies = [block("below", 0, -1, 2, 1, 8, 4), block("above", 0.2, 0.5, 1.6, 1, 8, 4)]
    _, _, text = runner.run("far", scene(bodies, conditions), code=2)
    failures += check("no surfaces of different bodies face one another" in text and "reach" in text, "a gap of two edges is told, and what to do")
    _, pairs, _ = runner.run("reach", scene(bodies, conditions, automatic=[parameter("reach", "double", 0.6)]))
    failures += check([sorted([s] + m) for s, m in pairs] == [["above/bottom", "below/top"]], f"with a reach: {pairs}")
    overlapping = [block("below", 0, -1, 2, 1, 8, 4), block("above", 0.2, -0.02, 1.6, 1, 8, 4)]
    still = [conditions[0], conditions[1].replace("-0.51*t", "0")]
    _, pairs, _ = runner.run("overlap", scene(overlapping, still))
    failures += check([sorted([s] + m) for s, m in pairs] == [["above/bottom", "below/top"]], f"an overlap: {pairs}")
    return failures


def test_sides(runner):
    """The softer side is the slave, else the finer one, else the more curved one."""
    conditions = [named("floor", parameter("set", "string", "below/bottom"), parameter("x", "double", 0), parameter("y", "double", 0)),
                  named("hand", parameter("set", "string", "above/top"), parameter("x", "double", 0), parameter("y", "string", "-0.001*t"))]
    failures = 0
    for name, below, above, slave in (("softer", block("below", 0, -1, 2, 1, 4, 2), block("above", 0, 0, 2, 1, 8, 4, "stiff"), "below/top"),
                                      ("finer", block("below", 0, -1, 2, 1, 4, 2), block("above", 0, 0, 2, 1, 8, 4), "above/bottom")):
        _, pairs, _ = runner.run(name, scene([below, above], conditions))
        failures += check([pair[0] for pair in pairs] == [slave], f"the {name} side is the slave: {pairs}")
    return failures


def test_rollers(runner):
    """Three equal rollers that touch one another: each would be slave and master at once, and is split."""
    height = 3.0 ** 0.5
    bodies = [disk("left", 0.0, 0.0, 12), disk("right", 2.0, 0.0, 12), disk("over", 1.0, height, 12)]
    hold = [named(f"hold {name}", parameter("set", "string", name), parameter("x", "string", f"{x}*t"), parameter("y", "string", f"{y}*t"))
            for name, x, y in (("left", 0.004, 0.002), ("right", -0.004, 0.002), ("over", 0, -0.004))]
    quantities = "".join(named(f"push {name} {i}", parameter("type", "string", "reaction"), parameter("set", "string", name), parameter("component", "string", i))
                         for name in ("left", "right", "over") for i in "xy")
    middle = named("sets", *[named(f"middle of {name}", parameter("of", "string", name), parameter("sphere", "string", f"{x}, {y!r}, 0.5"))
                             for name, x, y in (("left", 0.0, 0.0), ("right", 2.0, 0.0), ("over", 1.0, height))])
    text = scene(bodies, hold, quantities).replace('name="set" type="string" value="', 'name="set" type="string" value="middle of ').replace(
        '<ParameterList name="boundary conditions">', middle + '<ParameterList name="boundary conditions">')
    found, pairs, _ = runner.run("rollers", text)
    failures = check(len(pairs) == 3 and all(len(masters) == 1 for _, masters in pairs), f"three pairs: {pairs}")
    # By symmetry about the vertical line through the third roller.
    failures += check(abs(found["push left x"] + found["push right x"]) < 0.02 * abs(found["push left x"]) and abs(found["push left y"] - found["push right y"]) < 0.02 * abs(found["push over y"]),
                      f"rollers left and right push alike: {found}")
    failures += check(abs(found["push left y"] + found["push right y"] + found["push over y"]) < 1e-9 * abs(found["push over y"]), "forces balance")
    return failures


def stack(swept, thickness, lid_cells, contact):
    """A lid over a pad over a base with long facets, with contact that is found or that is given."""
    bodies = [block("base", -1, -1, 4, 1, 2, 2, "stiff"), block("pad", 0, 0, 2, thickness, 8, 2), block("lid", -0.5, thickness, 3, 0.5, lid_cells, 2, "stiff")]
    conditions = [named("floor", parameter("set", "string", "base/bottom"), parameter("x", "double", 0), parameter("y", "double", 0)),
                  named("middle", parameter("set", "string", "pad/left"), parameter("x", "double", 0)),
                  named("hand", parameter("set", "string", "lid/top"), parameter("x", "double", 0), parameter("y", "double", -0.01 * thickness))]
    quantities = named("push", parameter("type", "string", "reaction"), parameter("set", "string", "lid/top"), parameter("component", "string", "y"))
    if swept:
        conditions += [named(f"{name} {end}", parameter("set", "string", f"{name}/{end}"), parameter("z", "double", 0)) for name, _ in bodies for end in ("start", "end")]
    text = scene(bodies, conditions, quantities)
    if swept:
        profile = '<ParameterList name="mesh"><Parameter name="type" type="string" value="block"/>'
        text = re.sub(re.escape(profile) + "(.*?)</ParameterList>",
                      lambda found: named("mesh", parameter("type", "string", "extruded"), parameter("height", "double", 1), parameter("cells z", "int", 2),
                                          '<ParameterList name="profile"><Parameter name="type" type="string" value="block"/>' + found[1] + "</ParameterList>"), text)
        text = text.replace('<ParameterList name="parts">', '<ParameterList name="parts">' + parameter("kinematics", "string", "three dimensional"), 1)
    return text.replace(named("automatic contact", parameter("pairs", "string", "automatic")), contact) if contact else text


def test_hidden_masters(runner):
    """The base, which the pad hides, does not bear what lies on the pad: the same as with pairs of two bodies each, whatever thickness and facets are."""

    def pair(name, slave, master):
        return named(name, parameter("slave", "string", slave), parameter("master", "string", master))

    def of_two_bodies(pairs):
        """The pairs that were found, without what stands behind another body: the pad is between the others."""
        def neighbours(slave, masters):
            return masters if slave.startswith("pad") else [master for master in masters if master.startswith("pad")]
        return named("contact", *[pair(f"{n} {m}", slave, master) for n, (slave, masters) in enumerate(pairs) for m, master in enumerate(neighbours(slave, masters))])

    failures = 0
    for swept in (False, True):
        for thickness in (0.05, 0.2, 0.8):
            for cells in (3, 12):
                name = f"hidden_{3 if swept else 2}d_{thickness}_{cells}"
                found, pairs, _ = runner.run(name, stack(swept, thickness, cells, ""))
                alone, _, _ = runner.run(name + "_by_hand", stack(swept, thickness, cells, of_two_bodies(pairs)))
                failures += check(len(pairs) == 2 and close(found, alone, 1e-9), f"{name}, {pairs}: the base bears {found['push']:.9g}, and {alone['push']:.9g} in pairs of two bodies each")
    both = named("sets", named("both", parameter("kind", "string", "sides"), parameter("of", "string", "base/top, pad/top")))
    _, _, text = runner.run("hidden_refused", stack(False, 0.2, 3, named("contact", pair("lower", "pad/bottom", "base/top"), pair("upper", "lid/bottom", "both")) + both), code=2)
    failures += check("stands behind that of another body, 0.2 away" in text and "of 0.1" in text, "masters behind one another are refused, with the reach that parts them")
    return failures


def main():
    runner = Runner(*sys.argv[1:4])
    failures = test_wall(runner) + test_thin_wall(runner) + test_reach(runner) + test_sides(runner) + test_rollers(runner) + test_hidden_masters(runner)
    print(f"{failures} failed")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
