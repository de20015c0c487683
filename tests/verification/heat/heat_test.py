"""Heat of scenes against theory: balance on random scenes, roles exchanged, orders in the step, homogeneous deformation, bad input, scenes without heat.

usage: heat_test.py MORTISE INPUTS DIRECTORY [number of random scenes]
"""
import copy
import json
import math
import os
import subprocess
import sys

import deformation_cases
from heat_scenes import Runs, block, exchanged, material, pressed_pair, put, random_scene


def orders(runs, check):
    """A cos mode between insulated walls decays as exp(-k pi^2 t / (rho c L^2)); steps are halved."""
    rate = 2.0 * math.pi ** 2 / (1.0 * 4.0)

    def end(integration, steps):
        scene = {"kinematics": "plane strain", "materials": {"a": material(2.0, density=1.0, capacity=4.0)},
                 "bodies": {"bar": {"material": "a", "element": "Q8", "mesh": block(1, 0.1, 40, 1)}},
                 "boundary conditions": {"foot": {"set": "bar/bottom", "x": 0, "y": 0}},
                 "heat": {"analysis": "transient", "integration": integration, "initial temperature": "300 + 10*cos(pi*x)"},
                 "stepping": {"step": 0.2 / steps, "end time": 0.2}, "output": {"fields": ""},
                 "quantities": {"end": {"type": "temperature", "x": 0, "y": 0.05}}}
        return runs.run(f"decay_{integration.replace(' ', '_')}_{steps}", scene)[2]["end"] - 300
    exact = 10 * math.exp(-rate * 0.2)
    for integration, order in (("backward euler", 1), ("trapezoidal", 2)):
        errors = [abs(end(integration, steps) - exact) for steps in (8, 16, 32)]
        found = math.log2(errors[1] / errors[2])
        check(abs(found - order) < 0.15, f"{integration}: errors {errors[0]:.2e}, {errors[1]:.2e}, {errors[2]:.2e}, of order {found:.2f}; theory {order}")


def steps_by_error(runs, check):
    """The mode of orders() with steps by their error: a tolerance a tenth as large leaves an error a tenth as large, in steps that get longer."""
    rate = 2.0 * math.pi ** 2 / (1.0 * 4.0)
    for integration, most in (("backward euler", 1), ("trapezoidal", 2)):
        errors, counts = [], []
        for tolerance in (1e-3, 1e-4):
            scene = {"kinematics": "plane strain", "materials": {"a": material(2.0, density=1.0, capacity=4.0)},
                     "bodies": {"bar": {"material": "a", "element": "Q8", "mesh": block(1, 0.1, 40, 1)}},
                     "boundary conditions": {"foot": {"set": "bar/bottom", "x": 0, "y": 0}},
                     "heat": {"analysis": "transient", "integration": integration, "initial temperature": "300 + 10*cos(pi*x)", "error tolerance": tolerance},
                     "stepping": {"step": 0.01, "end time": 0.6, "maximum step": 0.6, "minimum step": 1e-6}, "output": {"fields": "", "checkpoints": {"every step": 1, "keep": 1000}},
                     "quantities": {"end": {"type": "temperature", "x": 0, "y": 0.05}}}
            name = f"by_error_{integration.replace(' ', '_')}_{tolerance:g}"
            code, _, values, columns = runs.run(name, scene)
            exact = [300 + 10 * math.exp(-rate * t) for t in columns["time"]]
            errors.append(max(abs(a - b) for a, b in zip(columns["end"], exact)) / 20)
            steps = [b - a for a, b in zip(columns["time"], columns["time"][1:])]
            counts.append(len(steps))
            check(code == 0 and steps[-2] > 2 * min(steps), f"steps by error, {integration}, {tolerance:g}: {len(steps)} steps of {min(steps):.2g} to {max(steps):.2g}")
        # Errors of the steps add up: N of them, which are damped, so by less than N.
        check(all(error < tolerance * count for error, tolerance, count in zip(errors, (1e-3, 1e-4), counts)), f"the error is {errors[0]:.1e}, {errors[1]:.1e}")
        growth = math.log(counts[1] / counts[0]) / math.log(10)
        check(abs(growth - 1 / (most + 1)) < 0.2, f"steps grow as tolerance^-{growth:.2f}; theory {1 / (most + 1):.2f}")
        path, results = os.path.join(runs.directory, name + ".xml"), os.path.join(runs.directory, name + "_1")
        done = subprocess.run([runs.mortise, "run", path, "-o", results, "--restart", str(counts[1] // 2)], capture_output=True, text=True)
        with open(os.path.join(results, "summary.json")) as file:
            again = json.load(file)["quantities"]["end"]
        check(done.returncode == 0 and abs(again - values["end"]) < 1e-9, f"restart of steps by error: exit {done.returncode}, off by {again - values['end']:.1e}")


def bodies_of_one_temperature(runs, check):
    """Steps by error from a uniform start, of bodies that conduct so well that they have one temperature (Biot numbers of 1e-5).

    The error is below the tolerance times the number of steps, over the range, as these processes do not amplify errors."""
    tolerance, capacity, length, start = 1e-3, 4.0, 0.1, 300.0
    stored = capacity * length
    cold, glow, steps_of_ode = start, 2e-11, 20000
    for _ in range(steps_of_ode):  # stored dtheta/dt = glow (200^4 - theta^4), midpoint rule
        half = cold + 0.5 / steps_of_ode * glow * (200 ** 4 - cold ** 4) / stored
        cold += 1 / steps_of_ode * glow * (200 ** 4 - half ** 4) / stored
    loads = {
        "convection": ({"type": "convection", "coefficient": 1, "surroundings": 400}, 400 - 100 * math.exp(-1 / stored), 100),
        "radiation": ({"type": "radiation", "emissivity": 1, "stefan-boltzmann constant": glow, "surroundings": 200}, cold, 100),
        "flux": ({"type": "heat flux", "flux": "20*t"}, start + 10 / stored, 10 / stored),
    }
    for name, (load, exact, span) in loads.items():
        for integration in ("backward euler", "trapezoidal"):
            scene = {"kinematics": "plane strain", "materials": {"a": material(1e4, density=1.0, capacity=capacity)},
                     "bodies": {"bar": {"material": "a", "mesh": block(length, 0.1, 2, 1)}}, "boundary conditions": {"foot": {"set": "bar/bottom", "x": 0, "y": 0}},
                     "heat": {"analysis": "transient", "integration": integration, "initial temperature": start, "error tolerance": tolerance,
                              "loads": {"load": {"set": "bar/right", **load}}},
                     "stepping": {"step": 0.01, "end time": 1, "maximum step": 1, "minimum step": 1e-6}, "output": {"fields": ""},
                     "quantities": {"end": {"type": "temperature", "x": 0.05, "y": 0.05}}}
            code, _, values, columns = runs.run(f"uniform_{name}_{integration.split()[0]}", scene)
            error = abs(values.get("end", math.nan) - exact) / max(span, 0.01 * exact)
            count = len(columns["time"]) - 1 if columns else 0
            check(code == 0 and error < tolerance * count, f"steps by error from a uniform start, {name}, {integration}: exit {code}, {count} steps, error {error:.1e}")
    # Two bodies: the difference decays by h (1/C_1 + 1/C_2). Heat of contact is of first order, whatever the rule.
    pair = {"kinematics": "plane strain", "materials": {"a": material(1e4, modulus=1e6, density=1.0, capacity=capacity)},
            "bodies": {"upper": {"material": "a", "mesh": block(1, length, 2, 1, 0, 2 * length)}, "lower": {"material": "a", "mesh": block(1, 2 * length, 3, 1)}},
            "boundary conditions": {"foot": {"set": "lower/bottom", "x": 0, "y": 0}, "press": {"set": "upper/top", "x": 0, "y": -1e-6}},
            "contact": {"joint": {"slave": "upper/bottom", "master": "lower/top", "heat": {"conductance": {"type": "constant", "value": 1}}}},
            "heat": {"analysis": "transient", "integration": "trapezoidal", "initial temperature": start, "error tolerance": tolerance,
                     "initial temperatures": {"hot": {"body": "upper", "temperature": start + 100}}},
            "stepping": {"step": 0.01, "end time": 0.5, "maximum step": 1, "minimum step": 1e-6}, "output": {"fields": ""},
            "quantities": {"upper": {"type": "temperature", "body": "upper", "x": 0.5, "y": 3 * length}, "lower": {"type": "temperature", "body": "lower", "x": 0.5, "y": 0}}}
    code, _, values, columns = runs.run("two_uniform", pair)
    exact = 100 * math.exp(-0.5 * (1 / stored + 1 / (2 * stored)))
    error = abs(values["upper"] - values["lower"] - exact) / 100 if code == 0 else math.nan
    count = len(columns["time"]) - 1 if columns else 0
    check(code == 0 and error < tolerance * count, f"steps by error of two bodies that touch, trapezoidal: exit {code}, {count} steps, error {error:.1e}")


def random_scenes(runs, check, count):
    """Balance to 1e-10 whatever the scene; what flows is that with slave and master exchanged, up to the error of the mesh."""
    ran = 0
    for seed in range(count):
        scene = random_scene(seed)
        code, said, values, columns = runs.run(f"random_{seed}", scene)
        if code != 0:
            check(code == 3 and "reason" in said or "error" not in said, f"random scene {seed} stops with {code}: {said.strip().splitlines()[-1]}")
            continue
        ran += 1
        worst = max(columns["balance"])
        check(worst < 1e-10, f"random scene {seed}: {worst:.1e} of the largest power is missing at most")
        code, _, other, _ = runs.run(f"random_{seed}_exchanged", exchanged(scene))
        if code == 0:
            size = max(abs(values["stored"]), abs(values["across"]))
            apart = abs(values["stored"] - other["stored"]) / size
            check(apart < 0.03, f"random scene {seed}: stored heat with roles exchanged differs by {apart:.1e}")
            check(abs(values["across"] + other["across"]) < 0.05 * size, f"random scene {seed}: heat across is {values['across']:.5g} and {other['across']:.5g}")
    check(ran >= 0.8 * count, f"{ran} of {count} random scenes run to their end")


def exact_cases(runs, check):
    """Free expansion bears no stress; a quarter turn of everything creates no heat; insulated isothermal scenes pass at once."""
    for law in ("hencky", "neo hooke", "ciarlet neo hooke", "st venant kirchhoff", "small strain linear"):
        for element in ("Q4", "Q4 F-bar", "Q8"):
            if law == "small strain linear" and element == "Q4 F-bar":
                continue
            scene = {"kinematics": "plane strain", "materials": {"a": material(expansion=2e-5, law=law)},
                     "bodies": {"plate": {"material": "a", "element": element, "mesh": block(3, 2, 3, 2, angle=20)}},
                     "sets": {"corner": {"of": "plate/bottom", "kind": "nodes", "where": "1e-6 - abs(x)"},
                              "rim": {"of": "plate/bottom, plate/top, plate/left, plate/right", "kind": "sides", "where": "1"}},
                     "boundary conditions": {"corner": {"set": "corner", "x": 0, "y": 0}, "side": {"set": "plate/bottom", "y": 0, "x axis": "0.9396926207859084, 0.3420201433256687"}},
                     "heat": {"analysis": "steady", "initial temperature": 300, "temperatures": {"all": {"set": "plate/top", "temperature": "300 + 100*t"}}},
                     "output": {"fields": ""}, "quantities": {"stress": {"type": "extremum", "field": "stress xy", "which": "maximum absolute"},
                                                              "in plane": {"type": "extremum", "field": "stress xx", "which": "maximum absolute"}}}
            scene["sets"].pop("rim")
            code, said, values, _ = runs.run(f"free_{law.replace(' ', '_')}_{element.replace(' ', '_')}", scene)
            check(code == 0 and values["stress"] < 1e-6 * 2e5 * 2e-3, f"free expansion, {law}, {element}: exit {code}, shear stress {values.get('stress', math.nan):.1e}")

    turned = {"kinematics": "plane strain", "materials": {"a": material(expansion=2e-5)}, "bodies": {"plate": {"material": "a", "mesh": block(3, 2, 3, 2)}},
              "boundary conditions": {"turn": {"set": "plate/bottom", "x": "x*(cos(pi/2*t) - 1) - y*sin(pi/2*t)", "y": "x*sin(pi/2*t) + y*(cos(pi/2*t) - 1)"}},
              "heat": {"analysis": "transient", "initial temperature": 300}, "stepping": {"step": 0.5}, "output": {"fields": ""},
              "quantities": {"hot": {"type": "extremum", "field": "temperature"}, "cold": {"type": "extremum", "field": "temperature", "which": "minimum"}}}
    code, said, values, _ = runs.run("turned", turned)
    check(code == 0 and abs(values["hot"] - 300) < 1e-9 and abs(values["cold"] - 300) < 1e-9, f"a quarter turn: exit {code}, temperatures {values}")


def stored_and_determined(runs, check):
    """Stored heat is a function of the temperature; what nothing determines is no result; free bodies of any element converge."""
    cell = {"kinematics": "plane strain", "materials": {"a": material(50, density=1, capacity="1 + 0.002*(temperature - 300)")},
            "bodies": {"cell": {"material": "a", "mesh": block(1, 1, 1, 1)}}, "boundary conditions": {"foot": {"set": "cell/bottom", "x": 0, "y": 0}},
            "heat": {"analysis": "transient", "initial temperature": 300, "temperatures": {"all": {"set": "cell/surface", "temperature": "300 + 400*sin(pi*t)"}}},
            "stepping": {"step": 0.25, "output times": "0.5"}, "output": {"fields": ""}, "quantities": {"stored": {"type": "stored heat"}}}
    code, _, values, columns = runs.run("cycle", cell)
    exact = 400 + 0.001 * 400 ** 2
    check(code == 0 and abs(columns["stored"][1] - exact) < 1e-6 and abs(values["stored"]) < 1e-6,
          f"a cycle of a specific heat that grows: {columns['stored'][1]:.6f} of {exact:g} is stored in the middle, {values['stored']:.1e} at the end")
    table = copy.deepcopy(cell)
    put(table, "materials/a/heat/specific heat", None)
    put(table, "materials/a/heat/specific heat table", {"temperatures": "500, 505, 510", "values": "1, 101, 1"})
    _, _, values, columns = runs.run("latent", table)
    check(abs(columns["stored"][1] - 900) < 1e-6 and abs(values["stored"]) < 1e-6, f"a latent heat of 500: {columns['stored'][1]:.6f} of 900 is stored, {values['stored']:.1e} at the end")

    open_pair = pressed_pair(**{"heat/analysis": "steady", "bodies/upper/mesh": block(4, 2, 7, 4, 3, 3.1), "boundary conditions/drive": {"set": "upper/top", "x": 0, "y": 0},
                                "contact/joint/friction": None, "quantities": {}})
    code, said, _, _ = runs.run("open", open_pair)
    check(code == 3 and "nothing determines the temperature of" in said, f"a steady body behind an open gap: exit {code}")
    put(open_pair, "heat/temperatures/cold", {"set": "lower/bottom", "temperature": 300})
    code, _, _, _ = runs.run("open_determined", open_pair)
    check(code == 0, f"the same with a temperature on either side: exit {code}")
    scene = {"kinematics": "plane strain", "materials": {"a": material(expansion=1.2e-5)},
             "bodies": {"plate": {"material": "a", "element": "Q8", "mesh": block(40, 10, 32, 8)}}, "sets": {"corner": {"of": "plate/left", "kind": "nodes", "where": "1e-6 - y"}},
             "boundary conditions": {"foot": {"set": "plate/bottom", "y": 0}, "corner": {"set": "corner", "x": 0}},
             "heat": {"analysis": "transient", "initial temperature": 300, "loads": {"air": {"type": "convection", "set": "plate/top", "coefficient": 0.5, "surroundings": 400}}},
             "stepping": {"step": 2, "end time": 20}, "output": {"fields": ""}}
    for element in ("Q8", "T6"):
        scene["bodies"]["plate"]["element"] = element
        code, said, _, _ = runs.run("free_" + element, scene)
        check(code == 0, f"a free plate of {element} that warms up: exit {code}, {said.strip().splitlines()[-1][:60]}")
    flow = {"kinematics": "plane strain", "materials": {"a": material(expansion=1e-5, law="j2 plasticity")}, "bodies": {"block": {"material": "a", "mesh": block(1, 1, 2, 2)}},
            "boundary conditions": {"foot": {"set": "block/bottom", "x": 0, "y": 0}, "press": {"set": "block/top", "y": "-0.1*t/end"}}, "variables": {"end": 1},
            "heat": {"analysis": "steady", "initial temperature": 300, "temperatures": {"foot": {"set": "block/bottom", "temperature": 300}}},
            "stepping": {"step": "0.1*end", "end time": "end"}, "output": {"fields": ""}, "quantities": {"hot": {"type": "extremum", "field": "temperature"}}}
    put(flow, "materials/a/hardening", {"type": "linear", "yield stress": 200, "modulus": 500})
    hot = [runs.run("flow", {**flow, "variables": {"end": end}})[2]["hot"] for end in (1, 100)]
    check(max(abs(value - 300) for value in hot) < 1e-9, f"plastic flow in a steady analysis heats nothing: {hot}")


def bad_input(runs, check):
    """Each mistake has its message."""
    cases = [
        ({"materials/a/heat/conductivity": -3}, "conductivity"),
        ({"materials/a/heat/specific heat": 0}, "specific heat"),
        ({"materials/a/heat/conductivity": "50*(temperature - 400)"}, "conductivity"),
        ({"materials/a/density": None}, "density"),
        ({"materials/a/heat": None, "materials/a/thermomechanics": None}, "has no temperature"),
        ({"materials/a/heat": None, "quantities": {}}, "thermomechanics"),
        ({"materials/a/heat/conductivity": None}, "there is no conductivity"),
        ({"materials/a/thermomechanics/reference temperature": None}, "reference temperature"),
        ({"contact/joint/heat/slave share": 1.2}, "slave share"),
        ({"contact/joint/heat/conductance/factor": -1}, "factor"),
        ({"contact/joint/heat/gap conductance": {"type": "medium", "conductivity": 1, "distance": 0.1}}, "do not meet"),
        ({"contact/joint/heat/conductance": None, "contact/joint/heat/gap conductance": {"type": "medium", "conductivity": 1, "distance": 0.1}}, "do not meet"),
        ({"contact/joint/heat/conductance": {"type": "function", "conductance": "1 + 3*slip_rate"}, "contact/joint/friction": None}, "without friction has no slip"),
        ({"heat/loads": {"glow": {"type": "radiation", "set": "lower/right", "emissivity": 0.5, "stefan-boltzmann constant": 5.67e-8, "surroundings": 300}},
          "heat/temperatures/hot/temperature": -30}, "kelvin"),
        ({"heat/initial temperature": None}, "initial temperature"),
        ({"heat/initial temperature": "1/(x - 3)"}, "finite"),
        ({"heat/analysis": "none"}, "analysis"),
        ({"heat/temperatures/hot/set": "upper/upside"}, "upside"),
        ({"heat/temperatures/hot/temperature": "300 + sqrt(-t)"}, "hot"),
        ({"heat/temperatures/again": {"set": "upper/top", "temperature": 20}}, "again"),
        ({"heat/initial temperatures": {"of all": {"body": "middle", "temperature": 3}}}, "middle"),
        ({"heat/loads": {"glow": {"type": "radiation", "set": "lower/right", "emissivity": 0.5, "stefan-boltzmann constant": 5.67e-8, "surroundings": -5}}}, "glow"),
        ({"heat/loads": {"air": {"type": "convection", "set": "lower/right", "coefficient": -1, "surroundings": 300}}}, "coefficient"),
        ({"heat/analysis": "steady", "heat/temperatures": None, "quantities": {}}, "nothing determines the temperature"),
        ({"quantities/flow": {"type": "heat flow", "pair": "joint", "set": "upper/top"}}, "one of three"),
        ({"quantities/flow": {"type": "heat flow", "load": "wind"}}, "wind"),
        ({"quantities/flow": {"type": "heat flow", "set": "lower/bottom"}}, "no node of"),
        ({"quantities/error": {"type": "energy error"}}, "thermal expansion"),
        ({"heat/initial temperatures": {"one": {"body": "upper", "temperature": 3}, "two": {"body": "upper", "temperature": 4}}}, "two initial temperatures"),
        ({"materials/a/heat": {"conductivity": 0}, "materials/a/thermomechanics": None, "heat/analysis": "steady", "quantities": {}}, "conducts no heat"),
        ({"heat": None, "quantities": {"balance": {"type": "heat balance"}}}, "no temperature"),
        ({"heat": None, "quantities": {}}, "law of conductance"),
    ]
    for changes, expected in cases:
        code, said, _, _ = runs.run("bad", pressed_pair(**changes))
        words = [line for line in said.splitlines() if "error" in line or "reason" in line or "stopped" in line]
        check(code in (2, 3) and expected in said, f"{changes}: exit {code}, {words[:1]}")
    warned = [
        ({"contact/joint/friction": None, "contact/joint/heat/slave share": 0.3, "boundary conditions/drive/x": 0}, "no friction"),
        ({"contact/joint/heat/conductance": None}, "conduct no heat"),
    ]
    for changes, expected in warned:
        code, said, _, _ = runs.run("warned", pressed_pair(**changes))
        check(code == 0 and expected in said, f"{changes}: exit {code}, warned: {expected in said}")


def without_heat(runs, check, inputs):
    """Nothing of heat runs where the scene does not name it."""
    done = subprocess.run([runs.mortise, "run", os.path.join(inputs, "paper", "patch_test.xml"), "-o", os.path.join(runs.directory, "off")], capture_output=True, text=True)
    with open(os.path.join(runs.directory, "off", "summary.json")) as file:
        text = json.dumps({key: value for key, value in json.load(file).items() if key in ("calls", "bytes", "effects", "seconds")})
    check(done.returncode == 0 and "heat" not in text and "temperature" not in text, "a mechanical scene has no effect, call, byte or timer of heat")


def restarts_and_ranks(runs, check):
    # A flux has no temperature: what is lowest is not known.
    scene = pressed_pair(**{"output/checkpoints": {"every step": 1}, "heat/loads": {"flux": {"type": "heat flux", "set": "lower/right", "flux": 5}}})
    _, _, whole, _ = runs.run("whole", scene)
    path, results = os.path.join(runs.directory, "whole.xml"), os.path.join(runs.directory, "whole_1")
    done = subprocess.run([runs.mortise, "run", path, "-o", results, "--restart", "9"], capture_output=True, text=True)
    with open(os.path.join(results, "summary.json")) as file:
        again = json.load(file)["quantities"]
    apart = max(abs(again[name] - whole[name]) / max(abs(whole[name]), 1e-9) for name in whole if name != "balance")
    check(done.returncode == 0 and apart < 1e-9, f"restart: quantities differ by {apart:.1e}")
    for ranks in (2, 3):
        _, _, values, _ = runs.run("whole", scene, ranks)
        apart = max(abs(values[name] - whole[name]) / max(abs(whole[name]), 1e-9) for name in whole if name != "balance")
        check(apart < 1e-9, f"{ranks} ranks: quantities differ by {apart:.1e}")


def steps_in_turn(runs, check, inputs):
    """Steps of fields in turn grow as those of fields together: many iterations in all are no sign of a hard step."""
    steps = {}
    for fields in ("monolithic", "staggered"):
        results = os.path.join(runs.directory, "shrink_fit_" + fields)
        subprocess.run([runs.mortise, "run", os.path.join(inputs, "heat", "shrink_fit.xml"), "-o", results, "--set", "newton/fields=" + fields], check=True,
                       stdout=subprocess.DEVNULL, timeout=300)
        with open(os.path.join(results, "summary.json")) as file:
            steps[fields] = len(json.load(file)["steps"])
    check(steps["staggered"] <= 1.5 * steps["monolithic"], f"steps of a shrink fit: {steps}")


def options_of_contact(runs, check):
    """Perfect conductance; friction that depends on the temperature; fields solved for in turn."""
    wall = {"kinematics": "plane strain", "materials": {"a": material(15, modulus=1e9), "b": material(40, modulus=1e9)},
            "bodies": {"upper": {"material": "a", "mesh": block(10, 7, 6, 4, 0, 12)}, "lower": {"material": "b", "mesh": block(10, 12, 5, 6)}},
            "boundary conditions": {"foot": {"set": "lower/bottom", "x": 0, "y": 0}, "press": {"set": "upper/top", "x": 0, "y": "-1e-6*t"}},
            "contact": {"joint": {"slave": "upper/bottom", "master": "lower/top", "heat": {"conductance": {"type": "perfect"}}}},
            "heat": {"analysis": "steady", "initial temperature": 300, "temperatures": {"hot": {"set": "upper/top", "temperature": 400}, "cold": {"set": "lower/bottom", "temperature": 300}}},
            "output": {"fields": ""}, "quantities": {"across": {"type": "heat flow", "pair": "joint"}, "slave": {"type": "mean", "field": "temperature", "on": "upper/bottom"},
                                                     "master": {"type": "mean", "field": "temperature", "on": "lower/top"}}}
    for roles in ("as given", "exchanged"):
        code, said, values, _ = runs.run("perfect_" + roles.split()[0], wall)
        exact = 10 * 100 / (7 / 15 + 12 / 40)
        check(code == 0 and abs(abs(values["across"]) / exact - 1) < 2e-6 and abs(values["slave"] - values["master"]) < 1e-4,
              f"perfect conductance, roles {roles}: exit {code}, flow {values.get('across', math.nan):.6f} of {exact:.6f}, jump {values['slave'] - values['master']:.1e}")
        pair = wall["contact"]["joint"]
        pair["slave"], pair["master"] = pair["master"], pair["slave"]

    wall["heat"]["temperatures"]["hot"]["temperature"] = "400 - 5*abs(x - 2)"
    wall["quantities"] = {axis: {"type": "extremum", "field": "temperature", "gives": axis} for axis in ("x", "y")}
    wall["bodies"]["upper"]["mesh"] = block(10, 7, 10, 4, 0, 12)
    for ranks in (1, 2):
        _, _, values, _ = runs.run("hottest", wall, ranks)
        check(abs(values["x"] - 2) < 1e-12 and abs(values["y"] - 19) < 1e-12, f"the hottest place on {ranks} ranks: {values}")

    # Insulated bodies of 300 K and of 400 K rub with mu = 0.35; with a temperature that is prescribed mu is that of the start of the step.
    # Stiff bodies stay flat: sums of components are those of tractions.
    rub = pressed_pair(**{"materials": {"a": material(60, modulus=2e9), "b": material(20, modulus=2e9)}, "boundary conditions/drive/y": "-1e-5*min(5*t, 1)", "contact/joint/friction/coefficient": "temperature/1000", "contact/joint/heat": {"friction heats": False},
                          "heat/temperatures": None, "heat/initial temperatures": {"hot": {"body": "upper", "temperature": 400}},
                          "quantities": {"shear": {"type": "contact force", "pair": "joint", "component": "x", "part": "tangential"}, "normal": {"type": "contact force", "pair": "joint", "component": "y", "part": "normal"}}})
    code, said, values, _ = runs.run("rub", rub)
    check(code == 0 and abs(abs(values["shear"] / values["normal"]) - 0.35) < 1e-6, f"friction of 0.001 a kelvin between 300 and 400 K: exit {code}, ratio {values}")
    for ranks in (1, 2):
        code, _, parts, _ = runs.run("rub", rub, ranks)
    check(code == 0 and abs(parts["shear"] / values["shear"] - 1) < 1e-9, f"on 2 ranks: exit {code}, {parts['shear']:.9g}")
    put(rub, "heat/temperatures", {"all": {"set": "upper/surface", "temperature": "400 + 100*t"}, "below": {"set": "lower/surface", "temperature": "300 + 100*t"}})
    put(rub, "bodies/upper/mesh", block(4, 1, 7, 1, 3, 3))
    put(rub, "bodies/lower/mesh", block(10, 3, 13, 1))
    put(rub, "output/checkpoints", {"every step": 1, "keep": 1000})
    code, said, values, columns = runs.run("rub_warm", rub)
    ratios = [abs(a / b) for a, b in zip(columns["shear"], columns["normal"])]
    apart = max(abs(ratio - (0.35 + 0.1 * max(0, t - 0.1))) for ratio, t in zip(ratios[2:], columns["time"][2:]))
    check(code == 0 and apart < 1e-6, f"with temperatures that rise: exit {code}, ratios off by {apart:.1e}")
    done = subprocess.run([runs.mortise, "run", os.path.join(runs.directory, "rub_warm.xml"), "-o", os.path.join(runs.directory, "rub_warm_1"), "--restart", "7"], capture_output=True, text=True)
    with open(os.path.join(runs.directory, "rub_warm_1", "summary.json")) as file:
        again = json.load(file)["quantities"]
    check(done.returncode == 0 and abs(again["shear"] / values["shear"] - 1) < 1e-9, f"after a restart: exit {done.returncode}, {again['shear'] / values['shear'] - 1:.1e}")
    code, said, _, _ = runs.run("rub_cold", {**rub, "materials": {"a": material(60), "b": {**material(20), "heat": {}}}, "heat": {**rub["heat"], "temperatures": {}}})
    check(code == 2 and "depends on the temperature" in said, f"friction of a temperature that one side has not: exit {code}")

    together = pressed_pair()
    for formulation in ("dual mortar", "penalty", "standard mortar"):
        put(together, "contact/joint/formulation", {"type": formulation})
        if formulation == "standard mortar":  # with friction a step is cut, another one in either way
            put(together, "contact/joint/friction", None)
            put(together, "boundary conditions/drive/x", 0)
        put(together, "newton/fields", "monolithic")
        _, _, exact, _ = runs.run("together", together)
        put(together, "newton/fields", "staggered")
        code, said, values, _ = runs.run("in_turn", together)
        apart = max(abs(values[name] - exact[name]) / max(abs(exact[name]), 1e-9) for name in exact if name != "balance") if code == 0 else math.nan
        check(code == 0 and apart < 1e-6, f"fields in turn, {formulation}: exit {code}, quantities differ by {apart:.1e}")
        if formulation == "standard mortar":  # its multipliers are not condensed, which multigrid needs
            continue
        code, said, values, _ = runs.run("in_turn_multigrid", {**together, "linear solver": {"type": "iterative"}})
        apart = max(abs(values[name] - exact[name]) / max(abs(exact[name]), 1e-9) for name in exact if name != "balance") if code == 0 else math.nan
        check(code == 0 and apart < 1e-6, f"fields in turn with multigrid, {formulation}: exit {code}, quantities differ by {apart:.1e}")


def main():
    mortise, inputs, directory = sys.argv[1:4]
    count = int(sys.argv[4]) if len(sys.argv) > 4 else 6
    runs, failures = Runs(mortise, directory), 0

    def check(holds, text):
        nonlocal failures
        failures += not holds
        print(("ok      " if holds else "FAILED  ") + text, flush=True)

    orders(runs, check)
    steps_by_error(runs, check)
    bodies_of_one_temperature(runs, check)
    exact_cases(runs, check)
    deformation_cases.all_of_them(runs, check)
    random_scenes(runs, check, count)
    stored_and_determined(runs, check)
    options_of_contact(runs, check)
    bad_input(runs, check)
    steps_in_turn(runs, check, inputs)
    without_heat(runs, check, inputs)
    restarts_and_ranks(runs, check)
    sys.exit(failures > 0)


main()
