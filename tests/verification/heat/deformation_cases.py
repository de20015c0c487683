"""Heat and deformation of homogeneous bodies against closed forms: expansion, rotation, heat of plastic flow and of elastic strain. Bars that are pulled
have the order of the rule, go on after a restart and do not depend on the number of ranks."""
import json
import math
import os
import subprocess

from heat_scenes import block, material

ORDERS = {"backward euler": 1, "trapezoidal": 2}  # of the heat of deformation in the length of steps
LAWS = ("hencky", "neo hooke", "ciarlet neo hooke", "st venant kirchhoff", "small strain linear", "j2 plasticity")


def expanding(law, **thermal):
    """Steel with an expansion coefficient of 2e-5; plastic flow needs 100."""
    result = material(law=law, expansion=2e-5, **thermal)
    if law == "j2 plasticity":
        result["hardening"] = {"type": "perfect", "yield stress": 100}
    return result


def expansion(runs, check):
    """Free bodies bear no stress and stretch by exp(alpha d theta). Confined ones have the law's pressure of F_e = exp(-alpha d theta) I."""
    rise, modulus, ratio = 100, 2e5, 0.3
    strain, bulk, shear = 2e-5 * rise, modulus / 3 / (1 - 2 * ratio), modulus / 2 / (1 + ratio)
    lame, square, beta = bulk - 2 * shear / 3, math.exp(-2 * strain), ratio / (1 - 2 * ratio)
    hencky = -3 * bulk * strain
    confined = {"hencky": hencky, "j2 plasticity": hencky, "small strain linear": hencky, "neo hooke": shear * (square - math.exp(6 * beta * strain)),
                "ciarlet neo hooke": shear * (square - 1) + lame / 2 * (square ** 3 - 1), "st venant kirchhoff": 3 * bulk * (square - 1) / 2 * square}
    for law in LAWS:
        for element in ("Q4" if law == "small strain linear" else "Q4 F-bar",):
            scene = {"kinematics": "axisymmetric", "materials": {"a": expanding(law)}, "bodies": {"rod": {"material": "a", "element": element, "mesh": block(2, 3, 2, 3)}},
                     "boundary conditions": {"axis": {"set": "rod/left", "x": 0}, "foot": {"set": "rod/bottom", "y": 0}},
                     "heat": {"analysis": "steady", "initial temperature": 300, "temperatures": {"all": {"set": "rod/top", "temperature": f"300 + {rise}*t"}}},
                     "output": {"fields": ""}, "quantities": {"far": {"type": "displacement", "x": 2, "y": 3, "component": "x"}}}
            for component in ("xx", "yy", "zz", "xy"):
                scene["quantities"][component] = {"type": "extremum", "field": "stress " + component, "which": "maximum absolute"}
            name = f"{law}_{element}".replace(" ", "_")
            code, _, values, _ = runs.run("free_rod_" + name, scene)
            stretch = strain if law == "small strain linear" else math.expm1(strain)
            stress = max(values.get(component, math.inf) for component in ("xx", "yy", "zz", "xy"))
            check(code == 0 and stress < -1e-7 * hencky and abs(values["far"] / 2 - stretch) < 1e-8 * strain,
                  f"free expansion, {law}, {element}: exit {code}, stress {stress:.1e}, stretch {values.get('far', math.nan) / 2:.9e} of {stretch:.9e}")
            scene["boundary conditions"] = {"walls": {"set": "rod/surface", "x": 0, "y": 0}}
            scene["quantities"] = {which: {"type": "extremum", "field": "stress " + component, "which": which}
                                   for which, component in (("maximum", "zz"), ("minimum", "yy"))}
            code, _, values, _ = runs.run("confined_rod_" + name, scene)
            wrong = max((abs(value / confined[law] - 1) for value in values.values()), default=math.inf)
            check(code == 0 and wrong < 1e-8, f"confined expansion, {law}, {element}: exit {code}, pressure {-confined[law]:.4f} but for {wrong:.1e}")


def halved(runs, check, name, scene, exact, expected_order):
    """The temperature "hot" at the end of steps that are halved has the order, and its limit is exact."""
    counts = (16, 32, 64)
    found = []
    for steps in counts:
        code, said, values, _ = runs.run(f"{name}_{steps}", {**scene, "stepping": {"step": 1 / steps}})
        if code != 0:
            check(False, f"{name}: exit {code}: {said.strip().splitlines()[-1]}")
            return
        found.append(values["hot"])
    errors = [value - exact for value in found]
    order = math.log2(errors[1] / errors[2])
    limit = found[2] + (found[2] - found[1]) / (2 ** expected_order - 1)
    check(abs(order - expected_order) < 0.1 and abs(limit - exact) < 0.05 * abs(errors[2]),
          f"{name}: {found[2]:.4f}, in the limit {limit:.4f} of {exact:.4f}; errors {', '.join(f'{error:.2e}' for error in errors)}, of order {order:.2f}")


def cell(a, x, y, **heat):
    """A square of one cell, insulated, all of whose nodes are moved."""
    return {"kinematics": "plane strain", "materials": {"a": a}, "bodies": {"cell": {"material": "a", "element": "Q4", "mesh": block(1, 1, 1, 1)}},
            "boundary conditions": {"motion": {"set": "cell/surface", "x": x, "y": y}},
            "heat": {"analysis": "transient", "initial temperature": 300, **heat}, "output": {"fields": ""},
            "quantities": {"hot": {"type": "temperature", "x": 0.5, "y": 0.5}}}


def adiabatic_shear(runs, check):
    """Simple shear gamma without elastic strain: rho c d theta = chi s(theta) sigma_0 d gamma/sqrt(3) with s = exp(-w (theta - theta_0))."""
    w, share, yield_stress, storage = 4e-3, 0.9, 400, 1e-2 * 100
    # The elastic strain at yield heats nothing: with this modulus it is 1e-8, and takes 1e-6 K.
    flowing = material(modulus=4e10, law="j2 plasticity", expansion=0)
    flowing["hardening"] = {"type": "perfect", "yield stress": yield_stress}
    flowing["thermomechanics"] |= {"yield stress factor": f"exp(-{w}*(temperature - 300))", "plastic heat share": share}
    exact = 300 + math.log(1 + w * share * yield_stress / math.sqrt(3) / storage) / w
    for integration, order in ORDERS.items():
        halved(runs, check, f"adiabatic shear, {integration}", cell(flowing, "t*y", 0, integration=integration), exact, order)


def isentropic_expansion(runs, check):
    """A change of volume J with constant K and alpha cools to theta_0 exp(-3 K alpha ln J / (rho c))."""
    logarithm, storage = 0.05, 1e-2 * 100
    stretched = "({0}*(exp(" + str(logarithm / 2) + "*t) - 1))"
    heating = expanding("hencky", **{"thermoelastic heating": True})
    exact = 300 * math.exp(-3 * 2e5 / 3 / (1 - 2 * 0.3) * 2e-5 * logarithm / storage)
    for integration, order in ORDERS.items():
        halved(runs, check, f"isentropic expansion, {integration}", cell(heating, stretched.format("x"), stretched.format("y"), integration=integration), exact, order)


def bar(a, thinnest, integration):
    """A round bar that is pulled by 0.4 of 4; the radius is `thinnest` at its foot and 1 at its top."""
    return {"kinematics": "axisymmetric", "materials": {"a": a},
            "bodies": {"bar": {"material": "a", "element": "Q4 F-bar", "mesh": {"type": "block", "corners": f"0, 0, {thinnest}, 0, 1, 4, 0, 4", "cells x": 2, "cells y": 8}}},
            "boundary conditions": {"axis": {"set": "bar/left", "x": 0}, "foot": {"set": "bar/bottom", "y": 0}, "pull": {"set": "bar/top", "y": "0.4*t"}},
            "heat": {"analysis": "transient", "initial temperature": 300, "integration": integration}, "output": {"fields": "", "checkpoints": {"every step": 1, "keep": 100}},
            "quantities": {"foot": {"type": "temperature", "x": 0, "y": 0}, "top": {"type": "temperature", "x": 1, "y": 4},
                           "radius": {"type": "displacement", "x": (1 + thinnest) / 2, "y": 2, "component": "x"}, "force": {"type": "reaction", "set": "bar/top", "component": "y"},
                           "heat": {"type": "deformation heat", "measure": "energy"}, "stored": {"type": "stored heat", "measure": "energy"}, "balance": {"type": "heat balance"}}}


def hot_elastic():
    """A law whose constants and expansion depend on the temperature."""
    return material(2, expansion="2e-5*(1 + 1e-3*(temperature - 300))", **{"thermoelastic heating": True, "young's modulus": "2e5*(1 - 5e-4*(temperature - 300))"})


def hot_plastic(**thermal):
    """A law that flows, hardens and softens with heat."""
    result = material(law="j2 plasticity", expansion=2e-5, **{"yield stress factor": "exp(-2e-3*(temperature - 300))", **thermal})
    result["hardening"] = {"type": "linear", "yield stress": 400, "modulus": 1000}
    return result


def pulled_bars(runs, check):
    """Displacements and temperatures of pulled bars: differences of runs with 16, 32 and 64 steps have the order of the rule. Flow of the even bar has
    one direction; where that turns the law of plasticity is of first order by itself."""
    for name, a, thinnest in (("uneven elastic bar", hot_elastic(), 0.7), ("even plastic bar", hot_plastic(), 1)):
        for integration, expected in ORDERS.items():
            found, missing = [], 0
            for steps in (16, 32, 64):
                code, said, values, columns = runs.run(f"{name}_{integration}_{steps}".replace(" ", "_"), {**bar(a, thinnest, integration), "stepping": {"step": 1 / steps}})
                if code != 0:
                    check(False, f"{name}, {integration}: exit {code}: {said.strip().splitlines()[-1]}")
                    return
                found.append(values)
                missing = max(missing, max(columns["balance"]), abs(values["heat"] / values["stored"] - 1))
            orders = {of: math.log2(abs((found[0][of] - found[1][of]) / (found[1][of] - found[2][of]))) for of in ("foot", "top", "radius", "force", "heat")}
            check(all(abs(order - expected) < 0.1 for order in orders.values()) and missing < 1e-10,
                  f"{name}, {integration}: orders {', '.join(f'{of} {order:.2f}' for of, order in orders.items())}; {missing:.1e} of the heat is missing")


def whole_and_in_parts(runs, check):
    """An uneven bar that flows, expands and cools goes on after a restart as it would have, and is the same on any number of ranks."""
    scene = {**bar(hot_plastic(**{"thermoelastic heating": True}), 0.7, "trapezoidal"), "stepping": {"step": 1 / 16}}
    _, _, whole, columns = runs.run("uneven_bar", scene)
    check(max(columns["balance"]) < 1e-10, f"uneven plastic bar: {max(columns['balance']):.1e} of the largest power is missing")
    apart = lambda values: max(abs(values[name] / whole[name] - 1) for name in whole if name != "balance")
    results = os.path.join(runs.directory, "uneven_bar_1")
    done = subprocess.run([runs.mortise, "run", os.path.join(runs.directory, "uneven_bar.xml"), "-o", results, "--restart", "8"], capture_output=True, text=True)
    with open(os.path.join(results, "summary.json")) as file:
        again = json.load(file)["quantities"]
    check(done.returncode == 0 and apart(again) < 1e-9, f"uneven plastic bar after a restart: exit {done.returncode}, quantities differ by {apart(again):.1e}")
    for ranks in (2, 3):
        code, _, values, _ = runs.run("uneven_bar", scene, ranks)
        check(code == 0 and apart(values) < 1e-9, f"uneven plastic bar on {ranks} ranks: exit {code}, quantities differ by {apart(values):.1e}")


def quarter_turn(runs, check):
    """A bar with a gradient of its temperature conducts as if it had not been turned by 90 degrees in one step, and nothing heats."""
    for element in ("Q4", "Q4 F-bar", "Q8"):
        ends = []
        for turn in (0, 90):
            scene = {"kinematics": "plane strain", "materials": {"a": expanding("j2 plasticity", **{"thermoelastic heating": True})},
                     "bodies": {"bar": {"material": "a", "element": element, "mesh": block(3, 0.5, 1 if element == "Q8" else 6, 1)}}, "variables": {"turn": f"{turn}*pi/180/0.05"},
                     "boundary conditions": {"turn": {"set": "bar/surface", "x": "x*(cos(turn*t) - 1) - y*sin(turn*t)", "y": "x*sin(turn*t) + y*(cos(turn*t) - 1)"}},
                     "heat": {"analysis": "transient", "initial temperature": "300 + 50*x"}, "stepping": {"step": 0.05, "end time": 0.05}, "output": {"fields": ""},
                     "quantities": {"cold": {"type": "temperature", "x": 0, "y": 0}, "hot": {"type": "temperature", "x": 3, "y": 0.5},
                                    "heat": {"type": "deformation heat"}}}
            ends.append(runs.run(f"gradient_{element.replace(' ', '_')}_{turn}", scene))
        (_, _, still, _), (code, _, turned, _) = ends
        apart = max(abs(turned.get(name, math.inf) - still[name]) for name in ("cold", "hot"))
        check(code == 0 and still["hot"] < 445 and apart < 1e-9 and abs(turned["heat"]) < 1e-9,
              f"a quarter turn in one step, {element}: exit {code}, temperatures differ by {apart:.1e}, {turned.get('heat', math.nan):.1e} of heat")


def all_of_them(runs, check):
    for case in (expansion, adiabatic_shear, isentropic_expansion, pulled_bars, whole_and_in_parts, quarter_turn):
        case(runs, check)
