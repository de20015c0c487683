"""Start of contact: clearances beyond facets, overlaps that are open, patterns of rigid bodies, sets in any order, adjusted ties after a restart.

usage: contact_start_test.py MPIRUN MORTISE DIRECTORY

Two blocks of height 1 on one another, with Young's modulus E, Poisson's ratio 0 and small strain, are two springs in a row: pressed into one another by d
they bear E d / 2 for each unit of area.
"""
import sys

from scene_writer import Bench, named, parameter

bench = Bench(*sys.argv[1:4])
run, expect = bench.call, bench.expect
E = 1000.0

def close(name, value, expected, tolerance, scale=1.0):
    bench.equal(name, value, expected, tolerance, scale)


SMALL = named("materials", named("m", type="small strain linear", **{"young's modulus": E, "poisson's ratio": 0.0}))


def column(space, gap, cells, contact, element=None, more=()):
    """Two blocks of the size 1, so far apart."""
    def mesh(at, n):
        if space:
            return named("mesh", type="brick", cells_x=n, cells_y=n, cells_z=2, translation=f"0, 0, {at!r}")
        return named("mesh", type="block", cells_x=n, cells_y=2, translation=f"0, {at!r}")
    up = "z" if space else "y"
    held = {key: 0 for key in ("xyz" if space else "xy")}
    element = element or ("H8" if space else "Q4")
    return [parameter("kinematics", "three dimensional" if space else "plane strain"), SMALL,
            named("bodies", named("lower", mesh(0.0, cells[0]), material="m", element=element), named("upper", mesh(1.0 + gap, cells[1]), material="m", element=element)),
            named("boundary conditions", named("floor", set="lower/bottom", **held), named("top", set="upper/top", **held)), contact,
            named("quantities", named("force", type="reaction", set="upper/top", component=up)), named("stepping", step=0.5), *more]


def pair(**parameters):
    return named("contact", named("joint", slave="upper/bottom", master="lower/top", **parameters))


def check_clearances():
    for space in (False, True):
        for cells in ((4, 3), (2, 5)) if not space else ((2, 3),):
            for gap in (0.05, 0.5, 1.2):
                for words in (f"{-gap - 0.02!r}", f"-{gap + 0.02!r}*t"):
                    name = f"{'3D' if space else '2D'} {cells[0]} {cells[1]} gap {gap} {words}"
                    code, said, found = run(name.replace("*", ""), column(space, gap, cells, pair(clearance=words)))
                    expect(name, code == 0, f"exit code {code}: {said[-400:]}")
                    if found:
                        close(name, abs(found["force"]), E * 0.02 / 2, 1e-6, 10.0)
            for overlap in (0.02, 0.1, 0.3):
                for clearance in (1.5 * overlap, 0.75 * overlap):
                    name = f"{'3D' if space else '2D'} {cells[0]} {cells[1]} overlap {overlap} clearance {clearance:g}"
                    code, said, found = run(name, column(space, -overlap, cells, pair(clearance=f"{clearance!r}")))
                    expect(name, code == 0, f"exit code {code}: {said[-400:]}")
                    expect(name, "make the slave finer" not in said, said)
                    if found:
                        close(name, abs(found["force"]), max(0.0, E * (overlap - clearance) / 2), 1e-6, E * overlap)
    code, said, _ = run("clearance beyond a reach", column(False, 0.5, (4, 3), pair(clearance="-0.52", **{"search reach": 0.3})))
    expect("clearance beyond a reach", code == 2 and "search reach" in said and "-0.52" in said, f"{code}: {said}")
    code, said, found = run("clearance within a reach", column(False, 0.5, (4, 3), pair(clearance="-0.52", **{"search reach": 0.6})))
    expect("clearance within a reach", code == 0 and found is not None and abs(abs(found["force"]) - 10.0) < 1e-5, f"{code}: {said}")


def check_overlap_taken_up():
    for overlap in (0.1, 0.2):
        name = f"overlap of {overlap} taken up"
        code, said, found = run(name, column(False, -overlap, (4, 3), pair(**{"overlap taken up at": 1.0}), more=()))
        expect(name, code == 0 and found is not None, f"exit code {code}: {said[-400:]}")
        expect(name, "until t = 1" in said and "make the slave finer" not in said and "first step pushes" not in said, said)


def check_order_of_bodies():
    chosen = set()
    for order in (("a", "b"), ("b", "a")):
        blocks = {"a": named("a", named("mesh", type="block", cells_x=4, cells_y=3), material="m"),
                  "b": named("b", named("mesh", type="block", cells_x=4, cells_y=3, translation="0, 1"), material="m")}
        code, said, _ = run("order " + "".join(order), [parameter("kinematics", "plane strain"), SMALL, named("bodies", *(blocks[one] for one in order)),
                                                        named("automatic contact", pairs="automatic"),
                                                        named("boundary conditions", named("f", set="a/bottom", x=0, y=0), named("t", set="b/top", x=0, y=-0.01))])
        expect("order of bodies", code == 0, said)
        chosen.add([line.split('the slave is "')[1].split('"')[0] for line in said.splitlines() if 'the slave is "' in line][0])
    expect("order of bodies", len(chosen) == 1, f"slaves {chosen}")


def check_patterns_of_rigid_bodies():
    for way in ("translation", "rotation"):
        step = named("pattern", copies=3, translation="3, 0") if way == "translation" else named("pattern", copies=3, rotation=120.0, rotation_point="0.5, -3")
        bodies = named("bodies", named("tool", named("mesh", type="block", cells_x=2, cells_y=2, translation="0, 1"), step, parameter("reference point", "0.5, 1.5"), rigid=True),
                       named("block", named("mesh", type="block", cells_x=3, cells_y=3), step, material="m"))
        conditions, pairs, quantities = [], [], []
        for n, suffix in enumerate(("", " 2", " 3")):
            conditions += [named(f"floor{suffix}", set=f"block{suffix}/bottom", x=0, y=0), named(f"drive{suffix}", set=f"tool{suffix}/reference", x=0, y=0, rotation="0.2")]
            pairs.append(named(f"joint{suffix}", slave=f"block{suffix}/top", master=f"tool{suffix}/bottom"))
            quantities += [named(f"moment{n}", type="reaction", set=f"tool{suffix}/reference", component="rotation")]
        code, said, found = run(f"pattern by {way}", [parameter("kinematics", "plane strain"), SMALL, bodies, named("contact", *pairs), named("boundary conditions", *conditions),
                                                     named("quantities", *quantities)])
        expect(f"pattern by {way}", code == 0 and found is not None, f"{code}: {said[-500:]}")
        if found:
            for n in (1, 2):
                close(f"pattern by {way}", found[f"moment{n}"], found["moment0"], 1e-7, abs(found["moment0"]))
            expect(f"pattern by {way}", abs(found["moment0"]) > 0.01, f"moment {found['moment0']}")


def check_tools_to_the_axis():
    """Rigid revolved tools whose profile ends on the axis: a flat one presses uniformly, a cone as one with a tiny hole does."""
    def pressed(name, points, ranks=1):
        tool = named("mesh", named("profile", type="profile", points=points, cell_size=0.3), type="revolved", angle=90.0, cells_around=12)
        block = named("mesh", type="brick", cells_x=4, cells_y=3, cells_z=4, translation="0, -1, 0")
        code, said, found = run(name, [parameter("kinematics", "three dimensional"), SMALL,
                                named("bodies", named("block", block, material="m", element="H8"), named("tool", tool, parameter("reference point", "0, 0, 0"), rigid=True)),
                                named("contact", named("joint", slave="block/back", master="tool/profile")),
                                named("boundary conditions", named("floor", set="block/front", y=0), named("x", set="block/left", x=0), named("z", set="block/bottom", z=0),
                                      named("drive", set="tool/reference", x=0, y="-0.1*t", z=0, **{"rotation x": 0, "rotation y": 0, "rotation z": 0})),
                                named("quantities", named("force", type="reaction", set="tool/reference", component="y"), named("peak", type="peak pressure")), named("stepping", step=0.5)], ranks)
        expect(name, code == 0 and found is not None, f"exit code {code}: {said[-500:]}")
        return found
    for ranks in (1, 2):
        flat = pressed(f"flat tool {ranks}", "0, 0, 4, 0", ranks)
        if flat:
            close(f"flat tool {ranks}", flat["force"], -E * 0.1, 1e-6, E * 0.1)
            close(f"flat tool {ranks}: peak", flat["peak"], E * 0.1, 1e-6, E * 0.1)
    cone, hollow = pressed("cone", "0, 0, 4, 1"), pressed("cone with a hole", "0.0001, 0.000025, 4, 1")
    if cone and hollow:
        close("cone", cone["force"], hollow["force"], 1e-3, abs(hollow["force"]))


def check_sets_in_any_order():
    first = named("one", of="two", kind="nodes", where="0.6 - x")
    second = named("two", of="lower/top", kind="nodes", where="x - 0.4")
    for name, sets in (("after", [second, first]), ("before", [first, second])):
        code, said, _ = run("sets " + name, column(False, 0.0, (4, 4), pair(), more=[named("sets", *sets), ]))
        expect("sets " + name, code == 0, said)
    code, said, _ = run("sets of themselves", column(False, 0.0, (4, 4), pair(), more=[named("sets", first, named("two", of="one"))]))
    expect("sets of themselves", code == 2 and "made of itself" in said, said)


def check_adjusted_ties_restart():
    def ring(inner, outer, cells):
        return named("mesh", type="ring sector", inner_radius=inner, outer_radius=outer, start_angle=0.0, end_angle=90.0, cells_across=2, cells_around=cells)
    content = [parameter("kinematics", "plane strain"), SMALL,
               named("bodies", named("inner", ring(1.0, 2.0, 5), material="m"), named("outer", ring(2.0, 3.0, 7), material="m")),
               named("ties", named("joint", slave="inner/outer", master="outer/inner", start="adjust", tolerance=0.1)),
               named("boundary conditions", named("inner x", set="inner/end", x=0), named("inner y", set="inner/start", y=0), named("outer x", set="outer/end", x=0),
                     named("outer y", set="outer/start", y=0), named("push", set="inner/inner", x="0.01*t*x", y="0.01*t*y")),
               named("quantities", named("force", type="reaction", set="outer/end", component="x")), named("stepping", step=0.25), named("output", named("checkpoints", every_step=1, keep=10))]
    straight = None
    for first, then in ((1, 2), (2, 1), (3, 2), (1, 3)):
        name = f"adjusted tie {first} {then}"
        code, said, found = run(name, content, first)
        expect(name, code == 0, said[-400:])
        straight = straight or found
        code, said, found = run(name, content, then, ["--restart", "2"])
        expect(name, code == 0, f"restart ends with {code}: {said[-400:]}")
        if found and straight:
            close(name, found["force"], straight["force"], 1e-9, abs(straight["force"]))


def check_adjusting():
    """Nominal fit, unlike facets: the round side as slave comes nearer to no overlap at all, the hollow one does not, and the log says so."""
    for slave, warns in (("inner/outer", False), ("outer/inner", True)):
        master = "outer/inner" if slave == "inner/outer" else "inner/outer"
        def ring(inner, outer, cells):
            return named("mesh", type="ring sector", inner_radius=inner, outer_radius=outer, start_angle=0.0, end_angle=90.0, cells_across=2, cells_around=cells)
        code, said, _ = run(f"adjusted {slave.replace('/', ' ')}", [parameter("kinematics", "plane strain"), SMALL,
                            named("bodies", named("inner", ring(1.0, 2.0, 5), material="m"), named("outer", ring(2.0, 3.0, 7), material="m")),
                            named("contact", named("joint", slave=slave, master=master, start="adjust", tolerance=0.2)),
                            named("boundary conditions", *(named(f"{body} {axis}", **{"set": f"{body}/{side}", axis: 0}) for body in ("inner", "outer")
                                                           for axis, side in (("x", "end"), ("y", "start"))))])
        expect(f"adjusted {slave}", code == 0, said[-400:])
        expect(f"adjusted {slave}", ("cut deeper" in said) == warns, said)


def check_decks():
    """Features that a deck of CalculiX cannot hold are refused before anything is run."""
    tie = named("ties", named("joint", slave="upper/bottom", master="lower/top"))
    soft = named("contact", named("joint", named("formulation", named("law", type="linear", stiffness=1000.0), type="pressure overclosure"), slave="upper/bottom", master="lower/top"))
    for name, contact, words in (("tie", tie, "the tie"), ("clearance", pair(clearance="-0.01"), "the clearance"), ("ramp", pair(**{"overlap taken up at": 1.0}), "taken up over time"),
                                 ("soft", soft, "pressure overclosure")):
        code, said, _ = run("deck of a " + name, column(True, 0.0, (2, 2), contact), command="peer")
        expect("deck of a " + name, code == 2 and words in said, f"{code}: {said[-400:]}")


check_clearances()
check_overlap_taken_up()
check_order_of_bodies()
check_patterns_of_rigid_bodies()
check_tools_to_the_axis()
check_sets_in_any_order()
check_adjusted_ties_restart()
check_adjusting()
check_decks()
bench.end()
