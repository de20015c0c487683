"""Ties of axisymmetric bodies against a closed form, and beside contact with friction in 3D for both solvers, on 1 to 3 ranks, and after a restart.

usage: ties_test.py MPIRUN MORTISE DIRECTORY
"""
import sys

from scene_writer import Bench, named, parameter

bench = Bench(*sys.argv[1:4])
run, close = bench.run, bench.equal
E, NU = 1000.0, 0.3


def material(name, poisson, kind="small strain linear"):
    return named("materials", named(name, type=kind, **{"young's modulus": E, "poisson's ratio": poisson}))


def tubes_error(name, cells, slave, ranks):
    """Two tubes of radii 1, 2 and 3 are one under a pressure p within, held along the axis:
    u(r) = (1 + nu) / E p a^2 / (c^2 - a^2) ((1 - 2 nu) r + c^2 / r), Timoshenko, Theory of Elasticity, thick cylinders in plane strain."""
    a, b, c, p = 1.0, 2.0, 3.0, 1.0
    sides = ["inner/right", "outer/left"] if slave == "inner" else ["outer/left", "inner/right"]
    tube = lambda at, width, nx, ny: named("mesh", type="block", width=width, height=1.0, cells_x=nx, cells_y=ny, translation=f"{at}, 0")
    found = run(name, [parameter("kinematics", "axisymmetric"), material("m", NU),
                       named("bodies", named("inner", tube(a, b - a, cells, 3), material="m", element="Q8"), named("outer", tube(b, c - b, cells, 4), material="m", element="Q8")),
                       named("ties", named("joint", slave=sides[0], master=sides[1])),
                       named("boundary conditions", *(named(f"{body} {side}", set=f"{body}/{side}", y=0) for body in ("inner", "outer") for side in ("bottom", "top"))),
                       named("loads", named("push", type="dead traction", set="inner/left", x=p)), named("stepping", step=1.0),
                       named("quantities", *(named(f"u{number}", type="mean", field="displacement x", on=on) for number, on in enumerate(("inner/left", "outer/left", "outer/right"))))],
                ranks)
    if found is None:
        return None
    exact = lambda r: (1 + NU) / E * p * a**2 / (c**2 - a**2) * ((1 - 2 * NU) * r + c**2 / r)
    return max(abs(found[f"u{number}"] / exact(r) - 1.0) for number, r in enumerate((a, b, c)))


def check_tubes():
    for slave in ("inner", "outer"):
        coarse, fine = tubes_error(f"tubes {slave} coarse", 3, slave, 2), tubes_error(f"tubes {slave} fine", 6, slave, 1)
        if coarse is not None and fine is not None:
            close(f"tubes, slave {slave}", fine, 0.0, 1e-3, 1.0)
            bench.expect(f"tubes, slave {slave}", fine < 0.3 * coarse, f"errors {coarse:.2e} and {fine:.2e}, not of second order")


def on_base(solver, poisson, drawn):
    """Two bricks side by side, tied along their common face, on a base with friction; meshes do not match."""
    brick = lambda width, height, nx, ny, nz, at: named("mesh", type="brick", width=width, depth=1.0, height=height, cells_x=nx, cells_y=ny, cells_z=nz, translation=at)
    sets = named("sets", named("feet", of="one/bottom, other/bottom", kind="sides"), named("lids", of="one/top, other/top", kind="nodes"))
    conditions = [named("floor", set="base/bottom", x=0, y=0, z=0), named("press", set="lids", z="-0.01*min(1, 2*t)", **({"x": "0.04*max(0, t - 0.5)", "y": 0} if drawn else {}))]
    if not drawn:
        conditions = [named("floor", set="base/bottom", z=0), named("press", set="lids", z="-0.01*t"), named("x", set="base/left", x=0), named("y", set="base/front", y=0),
                      named("one x", set="one/left", x=0), named("one y", set="one/front", y=0), named("other y", set="other/front", y=0)]
    friction = [named("friction", type="coulomb", coefficient=0.2)] if drawn else []
    return [parameter("kinematics", "three dimensional"), material("m", poisson), sets,
            named("bodies", named("base", brick(2.0, 0.5, 7, 4, 2, "0, 0, 0"), material="m", element="H8"), named("one", brick(1.0, 0.8, 3, 3, 3, "0, 0, 0.5"), material="m", element="H8"),
                  named("other", brick(1.0, 0.8, 4, 4, 4, "1, 0, 0.5"), material="m", element="H8")),
            named("ties", named("seam", slave="other/left", master="one/right")), named("contact", named("feet", *friction, slave="feet", master="base/top")),
            named("boundary conditions", *conditions), named("linear solver", type=solver), named("stepping", step=0.25),
            named("output", named("checkpoints", every_step=1, keep=10)),
            named("quantities", *(named("force_" + c, type="reaction", set="lids", component=c) for c in "xyz"), named("most", type="extremum", field="stress zz"),
                  named("least", type="extremum", field="stress zz", which="minimum"), named("imbalance", type="momentum imbalance"))]


def check_beside_contact():
    for solver, tolerance in (("mumps", 1e-9), ("iterative", 1e-6)):
        for ranks in (1, 2):
            name = f"pressed {solver} {ranks}"
            found = run(name, on_base(solver, 0.0, False), ranks)
            if found:
                stress = -E * 0.01 / 1.3
                close(name + ": largest stress", found["most"], stress, tolerance)
                close(name + ": smallest stress", found["least"], stress, tolerance)
                close(name + ": force", found["force_z"], 2.0 * stress, tolerance)
    reference = None
    for solver, ranks in (("mumps", 1), ("mumps", 3), ("iterative", 1), ("iterative", 2)):
        name = f"drawn {solver} {ranks}"
        content = on_base(solver, 0.3, True)
        found = run(name, content, ranks)
        if found is None:
            continue
        reference = reference or found
        again = run(name, content, 3 - ranks if ranks < 3 else 2, ["--restart", "2"])
        for which, values in (("", found), (" after a restart", again or {})):
            for quantity in [key for key in values if key.startswith("force")]:
                close(f"{name}{which}: {quantity}", values[quantity], reference[quantity], 1e-6, abs(reference["force_z"]))
        close(name + ": balance", found["imbalance"], 0.0, 1e-6, 1.0)
    if reference:
        ratio = abs(reference["force_x"] / reference["force_z"])
        bench.expect("drawn", 0.05 < ratio < 0.2 + 1e-9, f"{ratio} of the pressing force")


check_tubes()
check_beside_contact()
bench.end()
