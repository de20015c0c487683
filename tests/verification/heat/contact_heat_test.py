"""Heat across contact against closed forms and MOOSE: patches, a flux that varies along the joint, half spaces that rub, a brake, random scenes.

usage: contact_heat_test.py MORTISE DIRECTORY [number of random scenes [first seed]]
"""
import math
import sys

import moose_cases
from contact_heat_scenes import Rod, at, brake, cosine, patch, refined, rubbing, wild_scene
from heat_scenes import Runs, exchanged, put

PATCHES = [("Q4", 2), ("T3", 2), ("Q8", 2), ("T6", 2), ("H8", 3), ("Tet4", 3)]


def patches(runs, check):
    """A uniform flux through an inclined interface is exact: meshes that do not match, a slave of which a part is not covered, both choices of the slave.

    Bounds: 1e-8, the strain of bodies under the pressure that holds them together is 1e-9."""
    for element, dimension in PATCHES + [("Q4", 0), ("T3", 0), ("Q8", 0)]:
        for slave in ("lower", "upper"):
            scene, exact = patch(element, dimension, slave)
            code, said, values, _ = runs.run(f"patch_{element}_{dimension}_{slave}", scene)
            worst = max((abs(values[name] - value) for name, value in exact.items()), default=math.nan) if code == 0 else math.nan
            where = {0: "about an axis", 2: "plane", 3: "in space"}[dimension]
            check(code == 0 and worst < 1e-8 * 100, f"patch of {element} {where}, slave {slave}: exit {code}, temperatures are off by {worst:.1e} of 100")


def varied_flux(runs, check, cases):
    """A flux cos(pi x): temperatures at places converge in second order, of quadratic elements in no less."""
    for element, conductance, slave, levels in cases:
        errors = []
        for level in levels:
            scene, exact = cosine(element, conductance, slave, level)
            code, said, values, _ = runs.run(f"cosine_{element}_{conductance:g}_{slave}_{level}", scene)
            errors.append(math.sqrt(sum((values[name] - value) ** 2 for name, value in exact.items()) / len(exact)) if code == 0 else math.nan)
        order = math.log(errors[-2] / errors[-1]) / math.log(levels[-1] / levels[-2])
        check(order > 1.8, f"cos(pi x), {element}, h = {conductance:g} k/L, slave {slave}: errors " + ", ".join(f"{error:.2e}" for error in errors) + f", order {order:.2f}")


def half_spaces(runs, check):
    """Surfaces that rub with a flux of heat q are warmer by 2 share q sqrt(t / (pi k rho c)); shares are those of the effusivities, or given with h = 0."""
    for share, levels in ((None, (1, 2)), (0.25, (2,))):
        errors = []
        for level in levels:
            scene, rise = rubbing(share, level)
            code, said, values, _ = runs.run(f"rubbing_{share}_{level}", scene)
            errors.append(max(abs(values[side] / (rise[side] * values["power"]) - 1) for side in rise) if code == 0 else math.nan)
        text = "shares of half spaces" if share is None else f"a share of {share}, h = 0"
        check(errors[-1] < 0.005 and errors[-1] <= errors[0], f"surfaces that rub, {text}: temperatures are off by " + ", ".join(f"{error:.2e}" for error in errors))


def drags(runs, check):
    """A drag beyond the elastic shear at once, far or little, in long and short steps, with expansion and without: heat of friction appears in the first
    iteration that slips. The line search takes what full steps give; as both converge to 1e-9, temperatures differ by less than 1e-6."""
    worst, failed = 0.0, []
    cases = [(first, expansion, step) for first in (0.3, 1.5, 5, 30) for expansion in (None, 1e-5) for step in (0.02, 0.2)]
    for first, expansion, step in cases:
        scene, _ = rubbing(None, 1)
        put(scene, "stepping/step", step)
        elastic = float(scene["boundary conditions"]["drive"]["x"].split()[0])
        put(scene, "boundary conditions/drive/x", f"{first * elastic:.6g} + 0.2*t")
        for one in scene["materials"].values():
            one["thermomechanics"] = {"expansion coefficient": expansion, "reference temperature": 0}
            if expansion is None:
                one.pop("thermomechanics")
        found = []
        for search in ("backtrack", "none"):
            put(scene, "newton/line search", search)
            code, said, values, _ = runs.run("drag", scene)
            found.append(values.get("pad", math.nan) if code == 0 else math.nan)
        error = abs(found[0] / found[1] - 1)
        worst = max(worst, error)
        if not error < 1e-6:
            failed.append(f"{first} of the elastic shear, expansion {expansion}, steps of {step}: {found}")
    check(not failed, f"{len(cases)} drags at once: temperatures differ from those of full steps by {worst:.1e}" + "".join("\n        " + one for one in failed))


def brakes(runs, check):
    """Heat is torque times angle, whatever turns in a step; the arm of the force is that of an even pressure, or of even wear (a pressure as 1/r)."""
    for turn, wear in ((0.1, False), (0.02, False), (0.02, True)):
        scene, arm = brake(turn, wear)
        code, said, values, _ = runs.run(f"brake_{turn}_{wear}", scene)
        if code != 0:
            check(False, f"brake: exit {code}: {said.strip().splitlines()[-1]}")
            continue
        ratio, plain = values["ratio"] - 1, values["plain"] - 1
        check(abs(ratio) < 1e-6, f"brake, {turn} radians a step: heat over torque times angle is 1 + {plain:.2e}, of the chord {ratio:.2e}")
        check(abs(values["lever"] / arm - 1) < 0.01, f"brake, {'even wear' if wear else 'even pressure'}: arm {values['lever']:.3f}, closed form {arm:.3f}")


def rods(runs, check):
    """Contact that heat closes and cooling opens, with the gap of half to nearly all of the growth, in one step of heating or many, weak and strong laws.

    Bounds: 2e-4 / (1 - gap) of the flow and of the pressure of a rod that keeps its heat. The closed form is linear in strains, which are 2e-4, and what
    is left of the growth beyond the gap is its difference. A conductance that is there at once where surfaces touch leaves no state between open and
    closed: exit code 3, and words that say so."""
    worst, failed, ran = 0.0, [], 0
    for gap in (0.3, 0.7, 0.97):
        for strength, exponent in ((0.02, 1), (50, 1), (50, 0.95), (5, 0.5)):
            for steps in (1, 7):
                rod = Rod(strength, exponent, gap, steps)
                for law in ("power", "function") + (("table",) if exponent == 1 else ()):
                    ran += 1
                    name = f"rod_{gap}_{strength}_{exponent}_{steps}_{law}"
                    code, said, values, _ = runs.run(name, rod.scene(law))
                    p, q = rod.state()
                    error = max(abs(abs(values["force"]) / 2 - p) / (rod.modulus * rod.expansion * rod.hottest), abs(values["q"] / 2 - q) / q) if code == 0 else math.nan
                    worst = max(worst, error * (1 - gap))
                    if not error < 2e-4 / (1 - gap):
                        failed.append(f"{name}: exit {code}, {error:.1e}, {said.strip().splitlines()[-2][:200]}")
    check(not failed, f"{ran} rods that heat presses on a cold wall: p and q are off by {worst:.1e} / (1 - gap)" + "".join("\n        " + one for one in failed))
    scene = Rod(50, 1, 0.7, 20).scene("power")
    put(scene, "contact/joint/heat/conductance", {"type": "constant", "value": 50})
    code, said, _, _ = runs.run("rod_constant", scene)
    check(code == 3 and "begin to touch" in said, f"a rod with a constant conductance: exit {code}, explained: {'begin to touch' in said}")


def wild_scenes(runs, check, count, first):
    """Balance to 1e-10; stored heat and temperatures are those with slave and master exchanged and of finer meshes, up to errors of the meshes."""
    ran = 0
    for seed in range(first, first + count):
        scene, words = wild_scene(seed)
        code, said, values, columns = runs.run(f"wild_{seed}", scene)
        if code != 0:
            check(False, f"wild scene {seed} ({words}) stops with {code}: {said.strip().splitlines()[-1][:200]}")
            continue
        ran += 1
        worst = max(columns["balance"])
        check(worst < 1e-10, f"wild scene {seed} ({words}): {worst:.1e} of the largest power is missing at most")
        others = [("roles exchanged", exchanged(scene))]
        if scene["bodies"]["upper"]["element"] not in ("Tet10", "H20"):  # these take minutes
            others.append(("finer", refined(scene)))
        for text, other in others:
            code, said, again, _ = runs.run(f"wild_{seed}_{text.split()[0]}", other)
            if code != 0:
                check(False, f"wild scene {seed}, {text}, stops with {code}: {said.strip().splitlines()[-1][:200]}")
                continue
            apart = abs(at(values) - at(again)) / max(abs(at(values)), abs(at(again)), 1e-30)
            check(apart < 0.05, f"wild scene {seed}, {text}: stored heat differs by {apart:.1e}")
    return ran


def main():
    runs, failures = Runs(*sys.argv[1:3]), 0
    count, first = (int(word) for word in (sys.argv[3:5] + ["0", "0"][len(sys.argv[3:5]):]))

    def check(holds, text):
        nonlocal failures
        failures += not holds
        print(("ok      " if holds else "FAILED  ") + text, flush=True)

    if count:
        print(f"{wild_scenes(runs, check, count, first)} of {count} random scenes run to their end")
        sys.exit(failures > 0)
    patches(runs, check)
    varied_flux(runs, check, [("T3", 1e3, "upper", (1, 2)), ("Q8", 1e3, "lower", (1, 2)), ("H8", 1.0, "upper", (1, 2))])
    half_spaces(runs, check)
    rods(runs, check)
    drags(runs, check)
    brakes(runs, check)
    moose_cases.compare(runs, check, moose_cases.CASES[:5])
    sys.exit(failures > 0)


main()
