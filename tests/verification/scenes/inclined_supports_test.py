"""Supports along directions that are not the axes of the model.

usage: inclined_supports_test.py MPIRUN MORTISE DIRECTORY

A ring under pressure is the same problem whether a quarter of it is computed, with planes of symmetry along the axes, or a sector between any two
angles: energies are in proportion to the angle, forces on the planes of symmetry are equal. Blocks that are turned with all that holds and drives them
have the energies and forces of those that are not. Two rings that are pressed together have Lame's pressure, uniform, in any sector. What is tied keeps
a uniform stress.
"""
import math
import sys

from scene_writer import Bench, named, numbers, parameter

bench = Bench(*sys.argv[1:4])
run, equal = bench.run, bench.equal


def ring_mesh(space, inner, outer, start, end, cells, across=3):
    sector = dict(inner_radius=inner, outer_radius=outer, start_angle=float(start), end_angle=float(end), cells_across=across, cells_around=cells)
    if not space:
        return named("mesh", type="ring sector", **sector)
    return named("mesh", named("profile", type="ring sector", **sector), type="extruded", height=0.3, cells_z=1)


def symmetry(name, set, degrees, space):
    """A plane through the z axis under an angle to the x axis; along the axes in their own words."""
    if degrees == 0:
        return named(name, set=set, y=0)
    if degrees == 90:
        return named(name, set=set, x=0)
    normal = [-math.sin(math.radians(degrees)), math.cos(math.radians(degrees))] + [0.0] * space
    return named(name, parameter("x axis", numbers(*normal)), set=set, x=0)


def planes(bodies, start, end, space):
    conditions = []
    for body in bodies:
        conditions += [symmetry(f"{body} start", f"{body}/start", start, space), symmetry(f"{body} end", f"{body}/end", end, space)]
        if space:
            conditions.append(named(f"{body} floor", set=f"{body}/sweep start", z=0))
    return named("boundary conditions", *conditions)


STEEL = named("steel", type="neo hooke", **{"young's modulus": 1000.0, "poisson's ratio": 0.3})
PLASTIC = named("steel", named("hardening", type="linear", yield_stress=120.0, modulus=50.0), type="j2 plasticity", **{"young's modulus": 1000.0, "poisson's ratio": 0.3})


def reactions(*sets):
    return [named(f"{set.replace('/', ' ')} {c}".replace(" ", "_"), type="reaction", set=set, component=c) for set in sets for c in "xy"]


BALANCE = [named("stored", type="energy", of="stored"), named("external", type="energy", of="external work"), named("imbalance", type="momentum imbalance")]


def one_ring(name, element, start, end, cells, ranks, material=STEEL, solver="automatic"):
    space = element[0] in "HW" or element.startswith("Tet")
    return run(name, [parameter("kinematics", "three dimensional" if space else "plane strain"), named("materials", material),
                      named("bodies", named("ring", ring_mesh(space, 1.0, 2.0, start, end, cells), material="steel", element=element)),
                      planes(["ring"], start, end, space),
                      named("loads", named("push", type="follower pressure", set="ring/inner", pressure="60*t")), named("stepping", step=0.5),
                      named("linear solver", type=solver), named("quantities", *reactions("ring/start", "ring/end"), *BALANCE)], ranks)


def check_rings():
    for element, material, solver in [("Q4 F-bar", STEEL, "automatic"), ("Q8", STEEL, "automatic"), ("T6", STEEL, "automatic"), ("Q4 F-bar", PLASTIC, "automatic"),
                                      ("H8", STEEL, "iterative"), ("H20", STEEL, "automatic"), ("W15", STEEL, "automatic")]:
        kind = f"ring {element} {'plastic' if material is PLASTIC else 'elastic'}"
        quarter = one_ring(kind + " quarter", element, 0, 90, 9, 1, material)
        if quarter is None:
            continue
        force = {"start": abs(quarter["ring_start_y"]), "end": abs(quarter["ring_end_x"])}  # meshes of triangles are not symmetric
        tolerance = 1e-8 if solver == "iterative" else 1e-9
        for number, (start, end) in enumerate([(0, 30), (10, 40), (75, 105), (-135, -105)]):
            name = f"{kind} {start} to {end}"
            sector = one_ring(name, element, start, end, 3, 1 + number % 3, material, solver)
            if sector is None:
                continue
            equal(name + ": stored energy", sector["stored"], quarter["stored"] / 3, tolerance)
            equal(name + ": external work", sector["external"], quarter["external"] / 3, tolerance)
            for end_name, angle in (("start", start), ("end", end)):
                along = (-math.sin(math.radians(angle)), math.cos(math.radians(angle)))
                r = [sector[f"ring_{end_name}_{c}"] for c in "xy"]
                equal(f"{name}: force on {end_name}", abs(r[0] * along[0] + r[1] * along[1]), force[end_name], tolerance)
                equal(f"{name}: shear on {end_name}", r[0] * along[1] - r[1] * along[0], 0.0, tolerance, force[end_name])
            equal(name + ": balance", sector["imbalance"], 0.0, 1e-8, 1.0)


def two_blocks(name, degrees, space, ranks, friction):
    """The upper block is pressed on the lower one, then drawn along it. All nodes that are held are held in all components."""
    turned = dict(rotation=float(degrees)) if degrees else {}
    if space and degrees:
        turned["rotation axis"] = "1, 2, -0.5"
    if space:
        a = [v / math.sqrt(5.25) for v in (1.0, 2.0, -0.5)]
        c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
        cross = [[0, -a[2], a[1]], [a[2], 0, -a[0]], [-a[1], a[0], 0]]
        rotation = [[(c if i == j else 0.0) + (1 - c) * a[i] * a[j] + s * cross[i][j] for j in range(3)] for i in range(3)]
    else:
        c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
        rotation = [[c, -s], [s, c]]
    size = len(rotation)
    place = lambda v: numbers(*(sum(rotation[i][j] * v[j] for j in range(size)) for i in range(size)))
    axes = [parameter("x axis", numbers(*(row[0] for row in rotation)))] if degrees else []
    if degrees and space:
        axes.append(parameter("y axis", numbers(*(row[1] for row in rotation))))
    up = "z" if space else "y"
    if space:
        lower = named("mesh", type="brick", width=2.0, depth=1.0, height=0.5, cells_x=4, cells_y=2, cells_z=2, **turned)
        upper = named("mesh", type="brick", width=0.8, depth=0.6, height=0.4, cells_x=3, cells_y=2, cells_z=2, translation=place([0.3, 0.2, 0.5]), **turned)
    else:
        lower = named("mesh", type="block", width=2.0, height=0.5, cells_x=9, cells_y=3, **turned)
        upper = named("mesh", type="block", width=0.8, height=0.4, cells_x=5, cells_y=3, translation=place([0.3, 0.5]), **turned)
    rest = {key: 0 for key in "xyz"[:size]}
    drive = {**rest, "x": "0.2*max(0, t - 0.5)", up: "-0.02*min(1, 2*t)"}
    law = [named("friction", type="coulomb", coefficient=0.3)] if friction else []
    element = "H8" if space else "Q4 F-bar"
    found = run(name, [parameter("kinematics", "three dimensional" if space else "plane strain"), named("materials", STEEL),
                       named("bodies", named("lower", lower, material="steel", element=element), named("upper", upper, material="steel", element=element)),
                       named("boundary conditions", named("floor", *axes, set="lower/bottom", **rest), named("drive", *axes, set="upper/top", **drive)),
                       named("contact", named("joint", *law, slave="upper/bottom", master="lower/top")), named("stepping", step=0.25),
                       named("quantities", *[named("r" + c, type="reaction", set="upper/top", component=c) for c in "xyz"[:size]], *BALANCE)], ranks)
    if found is None:
        return None
    r = [found["r" + c] for c in "xyz"[:size]]
    found["force"] = [sum(rotation[i][j] * r[i] for i in range(size)) for j in range(size)]  # R^T r
    return found


def check_blocks():
    for space in (False, True):
        for friction in (False, True):
            kind = f"blocks in {'3D' if space else '2D'}{' with friction' if friction else ''}"
            straight = two_blocks(kind, 0, space, 1, friction)
            for number, degrees in enumerate((25, 90, 200)):
                name = f"{kind} turned by {degrees}"
                found = two_blocks(name, degrees, space, 1 + number, friction)
                if straight is None or found is None:
                    continue
                scale = max(abs(f) for f in straight["force"])
                for i, (mine, theirs) in enumerate(zip(found["force"], straight["force"])):
                    equal(f"{name}: force {'xyz'[i]}", mine, theirs, 1e-7, scale)
                equal(name + ": stored energy", found["stored"], straight["stored"], 1e-7)


def two_rings(name, start, end, space, ranks, slave, joint, over=0.0, element=None, cells=(4, 4), pressure=0.0):
    sides = ["inner/outer", "outer/inner"]
    if slave == "outer":
        sides.reverse()
    joined = named("ties", named("joint", slave=sides[0], master=sides[1])) if joint == "tie" else named("contact", named("joint", slave=sides[0], master=sides[1]))
    element = element or ("H8" if space else "Q4")
    load = [named("loads", named("push", type="follower pressure", set="inner/inner", pressure=f"{pressure}*t"))] if pressure else []
    quantities = [named("pressure", type="mean", field="contact pressure", on="joint"), named("peak", type="peak pressure")] if joint == "contact" else []
    return run(name, [parameter("kinematics", "three dimensional" if space else "plane strain"), named("materials", STEEL),
                      named("bodies", named("inner", ring_mesh(space, 1.0, 2.0 + over, start, end, cells[0]), material="steel", element=element),
                            named("outer", ring_mesh(space, 2.0, 3.0, start, end, cells[1]), material="steel", element=element)),
                      planes(["inner", "outer"], start, end, space), joined, *load, named("stepping", step=1.0),
                      named("quantities", *quantities, *reactions("inner/end", "outer/end"), *BALANCE)], ranks)


def check_pairs_of_rings():
    for space in (False, True):
        for slave in ("inner", "outer"):
            kind = f"{'3D' if space else '2D'} {slave} is slave"
            quarter = two_rings(f"fit {kind} quarter", 0, 90, space, 1, slave, "contact", over=0.01, cells=(12, 12))
            quarter_fine = None if space else two_rings(f"fit finer {kind} quarter", 0, 90, space, 1, slave, "contact", over=0.01, cells=(24, 24))
            tied = two_rings(f"tied {kind} quarter", 0, 90, space, 1, slave, "tie", cells=(12, 12), pressure=30.0)
            for number, (start, end) in enumerate([(0, 30), (10, 40), (100, 130)]):
                name = f"{kind} {start} to {end}"
                fit = two_rings("fit " + name, start, end, space, 1 + number, slave, "contact", over=0.01)
                finer = None if space else two_rings("fit finer " + name, start, end, space, 1, slave, "contact", over=0.01, cells=(8, 8))
                if fit is not None and quarter is not None:
                    # Nodes on inclined supports carry no multiplier, those of the quarter do: gaps of second order in the length of a facet.
                    coarse = fit["pressure"] - quarter["pressure"]
                    equal(f"fit {name}: pressure", fit["pressure"], quarter["pressure"], 0.01)
                    equal(f"fit {name}: peak", fit["peak"], quarter["peak"], 0.02)
                    equal(f"fit {name}: balance", fit["imbalance"], 0.0, 1e-8, 1.0)
                    if finer is not None:
                        equal(f"fit {name}: difference of a finer mesh", finer["pressure"] - quarter_fine["pressure"], 0.0, 0.5, abs(coarse))
                joined = two_rings("tied " + name, start, end, space, 1 + number, slave, "tie", pressure=30.0)
                if joined is not None and tied is not None:
                    equal(f"tied {name}: stored energy", joined["stored"], tied["stored"] / 3, 1e-9)
                    equal(f"tied {name}: external work", joined["external"], tied["external"] / 3, 1e-9)
                    size = {body: math.hypot(joined[f"{body}_end_x"], joined[f"{body}_end_y"]) for body in ("inner", "outer")}
                    equal(f"tied {name}: force", sum(size.values()), sum(abs(tied[f"{body}_end_x"]) for body in size), 1e-9)
                    # Along the axes the tie leaves out the component that is prescribed: its force at the common node is shared out in another way.
                    for body in size:
                        equal(f"tied {name}: force on {body}", size[body], abs(tied[f"{body}_end_x"]), 0.02)
                    equal(f"tied {name}: balance", joined["imbalance"], 0.0, 1e-8, 1.0)


def tied_blocks(name, degrees, space, ranks, cells):
    """Two blocks whose meshes do not match are pulled apart; all supports are rollers in turned axes, so that the stress is uniform."""
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    axis = numbers(c, s, *([0.0] * space))
    axes = [parameter("x axis", axis)] + ([parameter("y axis", numbers(-s, c, 0.0))] if space else [])
    mesh = lambda at, n: (named("mesh", type="brick", width=1.0, depth=0.5, height=0.5, cells_x=n, cells_y=n + 1, cells_z=2, rotation=float(degrees),
                                translation=numbers(-s * at, c * at, 0.0)) if space else
                          named("mesh", type="block", width=1.0, height=0.5, cells_x=n, cells_y=2, rotation=float(degrees), translation=numbers(-s * at, c * at)))
    bottom, top = ("front", "back") if space else ("bottom", "top")
    rollers = [named("floor", *axes, set=f"lower/{bottom}", y=0), named("pull", *axes, set=f"upper/{top}", y="0.1*t")]
    rollers += [named(f"{body} left", *axes, set=f"{body}/left", x=0) for body in ("lower", "upper")]
    if space:
        rollers += [named(f"{body} down", set=f"{body}/bottom", z=0) for body in ("lower", "upper")]
    element = "H8" if space else "Q8"
    return run(name, [parameter("kinematics", "three dimensional" if space else "plane strain"), named("materials", STEEL),
                      named("bodies", *[named(body, mesh(at, n), material="steel", element=element) for body, at, n in (("lower", 0.0, cells[0]), ("upper", 0.5, cells[1]))]),
                      named("boundary conditions", *rollers), named("ties", named("joint", slave=f"upper/{bottom}", master=f"lower/{top}")), named("stepping", step=0.5),
                      named("quantities", named("least", type="extremum", field="von mises", which="minimum"), named("most", type="extremum", field="von mises", which="maximum"),
                            *BALANCE)], ranks)


def check_uniform_stress():
    for space in (False, True):
        for number, degrees in enumerate((20, 45, 130)):
            name = f"tied blocks in {'3D' if space else '2D'} at {degrees}"
            found = tied_blocks(name, degrees, space, 1 + number, (3, 2))
            if found is not None:
                equal(name + ": uniform stress", found["least"], found["most"], 1e-9)
                equal(name + ": balance", found["imbalance"], 0.0, 1e-8, 1.0)


def punched(name, degrees, covers_all, ranks):
    """A base, the slave, under a punch that covers all or the right half of it; the end node of the slave on the roller carries no multiplier if turned."""
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    axes = [parameter("x axis", numbers(c, s))] if degrees else []
    turned = dict(rotation=float(degrees)) if degrees else {}
    at = 0.0 if covers_all else 1.5
    mesh = lambda width, x, y, nx: named("mesh", type="block", width=width, height=1.0, cells_x=nx, cells_y=2, translation=numbers(c * x - s * y, s * x + c * y), **turned)
    return run(name, [parameter("kinematics", "plane strain"), named("materials", STEEL),
                      named("bodies", named("base", mesh(3.0, 0.0, 0.0, 3), material="steel", element="Q4"), named("punch", mesh(3.0 - at, at, 1.0, 4), material="steel", element="Q4")),
                      named("boundary conditions", named("floor", *axes, set="base/bottom", y=0), named("wall", *axes, set="base/left", x=0),
                            named("guide", *axes, set="punch/left", x=0), named("press", *axes, set="punch/top", y="-0.02*t")),
                      named("contact", named("joint", slave="base/top", master="punch/bottom")), named("stepping", step=1.0),
                      named("quantities", named("mean", type="mean", field="contact pressure", on="joint"), named("length", type="contact length"),
                            named("peak", type="peak pressure"), named("variation", type="pressure variation"), *BALANCE)], ranks)


def check_reports():
    for covers_all in (True, False):
        kind = f"punch over {'all' if covers_all else 'half'}"
        straight = punched(kind, 0, covers_all, 1)
        for number, degrees in enumerate((30, 200)):
            turned = punched(f"{kind} turned by {degrees}", degrees, covers_all, 1 + number)
            for quantity in straight if straight and turned else ():
                equal(f"{kind} turned by {degrees}: {quantity}", turned[quantity], straight[quantity], 1e-7, max(abs(straight[quantity]), 1e-3))
        if straight and covers_all:
            equal(kind + ": length", straight["length"], 3.0, 1e-2)


def block_with(name, *conditions):
    return bench.call(name, [parameter("kinematics", "plane strain"), named("materials", STEEL),
                      named("bodies", named("block", named("mesh", type="block", cells_x=2, cells_y=2), material="steel", element="Q4")),
                      named("boundary conditions", *conditions), named("stepping", step=1.0)])


def check_words():
    whole = named("floor", set="block/bottom", x=0, y=0)
    wrong = {"two values along one direction": ([named("a", set="block/bottom", x_axis="1, 1", x=0), named("b", set="block/bottom", x_axis="2, 2", x=0.1)], "contradict one another"),
             "three directions in the plane": ([whole, named("a", set="block/bottom", x_axis="1, 1", x=0.1)], "contradict one another"),
             "three numbers in the plane": ([whole, named("a", set="block/top", x_axis="1, 1, 0", x=0)], "has 3 numbers"),
             "no direction": ([whole, named("a", set="block/top", x_axis="0, 0", x=0)], "not all are zero"),
             "one number": ([whole, named("a", set="block/top", x_axis="1", x=0)], "two numbers"),
             "nothing held along the slope": ([named("a", set="block/bottom", x_axis="1, 1", x=0), named("b", set="block/left", x_axis="1, 1", x=0)], "translation along (0.707, -0.707)"),
             "a y axis alone": ([whole, named("a", set="block/top", y_axis="1, 0", x=0)], "please give both"),
             "held along one direction": ([named("a", set="block/bottom", x_axis="1, 1", x=0)], "can move")}
    for name, (conditions, words) in wrong.items():
        code, said, _ = block_with(name, *conditions)
        bench.expect(name, code == 2 and words in said, f"exit code {code}, said {said!r}, expected {words!r}")
    code, said, _ = block_with("the same twice", whole, named("a", set="block/bottom", x_axis="1, 1", x=0, y=0))
    bench.expect("the same twice", code == 0, said)


check_rings()
check_blocks()
check_pairs_of_rings()
check_uniform_stress()
check_reports()
check_words()
bench.end()
