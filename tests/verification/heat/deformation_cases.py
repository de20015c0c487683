"""Heat and deformation of homogeneous bodies against closed forms: expansion, rotation, heat of plastic flow and of elastic strain."""
import math

from heat_scenes import block, material

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
    flowing = material(modulus=4e8, law="j2 plasticity", expansion=0)
    flowing["hardening"] = {"type": "perfect", "yield stress": yield_stress}
    flowing["thermomechanics"] |= {"yield stress factor": f"exp(-{w}*(temperature - 300))", "plastic heat share": share}
    exact = 300 + math.log(1 + w * share * yield_stress / math.sqrt(3) / storage) / w
    for integration in ("backward euler", "trapezoidal"):
        halved(runs, check, f"adiabatic shear, {integration}", cell(flowing, "t*y", 0, integration=integration), exact, 1)


def isentropic_expansion(runs, check):
    """A change of volume J with constant K and alpha cools to theta_0 exp(-3 K alpha ln J / (rho c))."""
    logarithm, storage = 0.05, 1e-2 * 100
    stretched = "({0}*(exp(" + str(logarithm / 2) + "*t) - 1))"
    heating = expanding("hencky", **{"thermoelastic heating": True})
    exact = 300 * math.exp(-3 * 2e5 / 3 / (1 - 2 * 0.3) * 2e-5 * logarithm / storage)
    for integration in ("backward euler", "trapezoidal"):
        halved(runs, check, f"isentropic expansion, {integration}", cell(heating, stretched.format("x"), stretched.format("y"), integration=integration), exact, 1)


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
    for case in (expansion, adiabatic_shear, isentropic_expansion, quarter_turn):
        case(runs, check)
