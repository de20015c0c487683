"""Scenes of heat across contact with exact solutions, and coupled ones with random everything."""
import json
import math
import random

from heat_scenes import block, exchanged, material, put  # noqa: F401

QUADRATIC = ("Q8", "T6", "H20", "Tet10")


def stiff(conductivity):
    return {"type": "hencky", "young's modulus": 1e9, "poisson's ratio": 0.3, "heat": {"conductivity": conductivity, "conductivity acts in": "reference"}}


def box(dimension, lengths, cells, start, angle):
    """A rectangle, or a cuboid whose last length is along z, turned by an angle about the origin, in space about the y axis."""
    if dimension == 2:
        c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
        place = (c * start[0] - s * start[1], s * start[0] + c * start[1])
        return block(lengths[0], lengths[1], cells[0], cells[1], *place, angle=angle)
    c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
    place = (c * start[0] - s * start[1], 0, s * start[0] + c * start[1])
    return {"type": "brick", "width": lengths[0], "depth": 1, "height": lengths[1], "cells x": cells[0], "cells y": cells[2], "cells z": cells[1],
            "rotation": -angle, "rotation axis": "0, 1, 0", "translation": ", ".join(f"{x:.17g}" for x in place)}


def temperature_at(point, body):
    return {"type": "temperature", "body": body, **{axis: f"{x:.17g}" for axis, x in zip("xyz", point)}}


def patch(element, dimension, slave):
    """A uniform flux 5 through an inclined interface, of which the upper body covers a part; dimension 0: about an axis, where the flux is along it.

    Returns the scene and temperatures by the names of its quantities."""
    k, h, flux, angle = {"lower": 15.0, "upper": 40.0}, 3.0, 5.0, 30.0
    if dimension == 0:
        return round_patch(element, slave)
    c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
    up = "y" if dimension == 2 else "z"
    height = f"({c:.17g}*{up} - {s:.17g}*x)"
    along = f"({c:.17g}*x + {s:.17g}*{up})"
    of_lower, of_upper = f"{flux}*{height}/{k['lower']}", f"{flux / h:.17g} + {flux}*{height}/{k['upper']}"
    bottom, top = "bottom", "top"
    across = {"y axis": "0, 1, 0"} if dimension == 3 else {}
    axis = f"{c:.17g}, {s:.17g}" if dimension == 2 else f"{c:.17g}, 0, {s:.17g}"
    normal = "y" if dimension == 2 else "z"
    # Each body is held along the interface at its far side; the lower one across it as well.
    held = {"set": "lower/" + bottom, "x": 0, "x axis": axis, **across, normal: 0}
    guided = {"set": "upper/" + top, "x": 0, "x axis": axis, **across}
    if dimension == 3:
        held["y"], guided["y"] = 0, 0
    press = {"type": "dead traction", "set": "upper/" + top, "x": s * 1.0, normal: -c * 1.0}
    scene = {
        "kinematics": "plane strain" if dimension == 2 else "three dimensional",
        "materials": {"lower": stiff(k["lower"]), "upper": stiff(k["upper"])},
        "bodies": {"lower": {"material": "lower", "element": element, "mesh": box(dimension, (2.0, 0.7), (8, 2, 2), (0.0, -0.7), angle)},
                   "upper": {"material": "upper", "element": element, "mesh": box(dimension, (1.25, 1.2), (6, 3, 3), (0.5, 0.0), angle)}},
        "sets": {"open": {"of": "lower/" + top, "kind": "sides", "where": f"max(0.5 - {along}, {along} - 1.75)"}},
        "boundary conditions": {"held": held, "guided": guided},
        "loads": {"press": press},
        "contact": {"joint": {"slave": "lower/top", "master": "upper/bottom", "heat": {"conductance": {"type": "constant", "value": h}}}},
        "heat": {"analysis": "steady", "initial temperature": 0,
                 "temperatures": {"lower": {"set": "lower/" + bottom, "temperature": of_lower}, "upper": {"set": "upper/" + top, "temperature": of_upper}},
                 "loads": {"open": {"type": "heat flux", "set": "open", "flux": flux}}},
        "output": {"fields": ""}, "quantities": {},
    }
    if slave == "upper":
        scene = exchanged(scene)
    exact = {}
    for body, lowest, highest, start, end, jump in (("lower", -0.7, 0.0, 0.0, 2.0, 0.0), ("upper", 0.0, 1.2, 0.5, 1.75, flux / h)):
        for i in range(5):
            for j in range(3):
                a, b = start + (end - start) * (0.02 + 0.24 * i), lowest + (highest - lowest) * (0.01 + 0.49 * j)
                flat = (c * a - s * b, s * a + c * b)
                name = f"{body} {i} {j}"
                scene["quantities"][name] = temperature_at(flat if dimension == 2 else (flat[0], 0.37, flat[1]), body)
                exact[name] = jump + flux * b / k[body]
    return scene, exact


def round_patch(element, slave):
    """About an axis: a flux along it through a cone; both bodies have the same conductivity, and the jump is that of the flux across the cone."""
    k, h, flux = 15.0, 3.0, 5.0
    slope, jump = 0.5, flux / math.sqrt(1 + 0.25) / h
    corners = lambda points: ", ".join(str(x) for point in points for x in point)
    scene = {
        "kinematics": "axisymmetric", "materials": {"lower": stiff(k), "upper": stiff(k)},
        "bodies": {"lower": {"material": "lower", "element": element, "mesh": {"type": "block", "corners": corners([(1, 0), (3, 0), (3, 2), (1, 1)]), "cells x": 8, "cells y": 3}},
                   "upper": {"material": "upper", "element": element, "mesh": {"type": "block", "corners": corners([(1, 1), (2.5, 1.75), (2.5, 3), (1, 3)]), "cells x": 5, "cells y": 4}}},
        "sets": {"open": {"of": "lower/top", "kind": "sides", "where": "x - 2.5"}},
        "boundary conditions": {"foot": {"set": "lower/bottom", "x": 0, "y": 0}, "guide": {"set": "upper/top", "x": 0}},
        "loads": {"press": {"type": "dead traction", "set": "upper/top", "y": -1}},
        "contact": {"joint": {"slave": "lower/top", "master": "upper/bottom", "heat": {"conductance": {"type": "constant", "value": h}}}},
        "heat": {"analysis": "steady", "initial temperature": 0,
                 "temperatures": {"lower": {"set": "lower/bottom", "temperature": 0}, "upper": {"set": "upper/top", "temperature": f"{jump + flux * 3 / k:.17g}"}},
                 "loads": {"open": {"type": "heat flux", "set": "open", "flux": f"{flux / math.sqrt(1 + slope ** 2):.17g}"}}},
        "output": {"fields": ""}, "quantities": {},
    }
    if slave == "upper":
        scene = exchanged(scene)
    exact = {}
    for i in range(5):
        r = 1.03 + 0.36 * i
        edge = 1 + slope * (r - 1)
        for j in range(3):
            for body, z, shift in (("lower", edge * (0.01 + 0.49 * j), 0.0), ("upper", edge + (3 - edge) * (0.01 + 0.49 * j), jump)):
                scene["quantities"][f"{body} {i} {j}"] = temperature_at((r, z), body)
                exact[f"{body} {i} {j}"] = shift + flux * z / k
    return scene, exact


def cosine(element, conductance, slave, level):
    """A flux cos(pi x) across a joint at y = 0 of two squares (in space of a slice) with insulated sides; `conductance` counts in k/L of the lower body.

    Above: cos(pi x) (cosh(pi y)/h + sinh(pi y)/(pi k_1)), below: cos(pi x) sinh(pi y)/(pi k_2)."""
    k_lower, k_upper = 2.0, 5.0
    h = conductance * k_lower
    dimension = 3 if element in ("H8", "Tet4", "H20", "Tet10") else 2
    up = "y" if dimension == 2 else "z"
    wave = "cos(3.141592653589793*x)"
    e = math.exp(math.pi)
    cosh, sinh = (e + 1 / e) / 2, (e - 1 / e) / 2
    cells = {"lower": (7 * level, 5 * level, level), "upper": (5 * level, 4 * level, 2 * level)}
    sides = {"bottom": "bottom", "top": "top"}
    supports = {"foot": {"set": "lower/bottom", "x": 0, up: 0}, "guide": {"set": "upper/top", "x": 0}}
    if dimension == 3:
        for support in supports.values():
            support["y"] = 0
    mesh = lambda body, low: box(dimension, (1.0, 1.0), cells[body], (0.0, low), 0.0)
    scene = {
        "kinematics": "plane strain" if dimension == 2 else "three dimensional", "materials": {"lower": stiff(k_lower), "upper": stiff(k_upper)},
        "bodies": {"lower": {"material": "lower", "element": element, "mesh": mesh("lower", -1.0)}, "upper": {"material": "upper", "element": element, "mesh": mesh("upper", 0.0)}},
        "boundary conditions": supports, "loads": {"press": {"type": "dead traction", "set": "upper/" + sides["top"], up: -1}},
        "contact": {"joint": {"slave": "lower/top", "master": "upper/bottom", "heat": {"conductance": {"type": "constant", "value": h}}}},
        "heat": {"analysis": "steady", "initial temperature": 0, "temperatures": {
            "lower": {"set": "lower/bottom", "temperature": f"{wave}*{-sinh / (math.pi * k_lower):.17g}"},
            "upper": {"set": "upper/top", "temperature": f"{wave}*{cosh / h + sinh / (math.pi * k_upper):.17g}"}}},
        "output": {"fields": ""}, "quantities": {},
    }
    if slave == "upper":
        scene = exchanged(scene)
    exact = {}
    for body, sign in (("lower", -1), ("upper", 1)):
        for i in range(11):
            for j in range(4):
                x, y = 0.05 + 0.09 * i, sign * (0.001 + 0.24 * j)
                s = math.sinh(math.pi * y)
                scene["quantities"][f"{body} {i} {j}"] = temperature_at((x, y) if dimension == 2 else (x, 0.5, y), body)
                exact[f"{body} {i} {j}"] = math.cos(math.pi * x) * (s / (math.pi * k_lower) if sign < 0 else math.cosh(math.pi * y) / h + s / (math.pi * k_upper))
    return scene, exact


class Rod:
    """A rod that is held and heated at its top, by a temperature that rises from 0 to 200. It grows by its mean temperature until it touches a cold wall,
    which cools it: with a conductance h that begins at 0 with the pressure there is one state. Nothing moves sideways. In it, of the length L and with small
    strains (2e-4),

        theta_s = Theta - q L / k,   theta_w = q W / k,   q = h(p) (theta_s - theta_w),
        p (L + W) / E = a L (Theta + theta_s) / 2 + a W theta_w / 2 - gap."""
    length, wall, conductivity, modulus, expansion, hottest = 10.0, 1.0, 50.0, 2e5, 1e-6, 200.0

    def __init__(self, strength, exponent, gap, steps):
        """h = strength p^exponent; the gap, over the growth of the rod that is as hot as its top in the end."""
        self.strength, self.exponent, self.steps = strength, exponent, steps
        self.gap = gap * self.expansion * self.length * self.hottest

    def scene(self, law):
        steel = {"type": "hencky", "young's modulus": self.modulus, "poisson's ratio": 0, "heat": {"conductivity": self.conductivity},
                 "thermomechanics": {"expansion coefficient": self.expansion, "reference temperature": 0}}
        laws = {"power": {"type": "power", "factor": self.strength, "hardness": 1, "exponent": self.exponent},
                "function": {"type": "function", "conductance": f"{self.strength}*pressure^{self.exponent}"},
                "table": {"type": "table", "pressures": "0, 1000", "conductances": f"0, {1000 * self.strength}"}}
        return {
            "kinematics": "plane strain", "materials": {"steel": steel},
            "bodies": {"rod": {"material": "steel", "mesh": block(2, self.length, 2, 10, 0, self.gap)},
                       "wall": {"material": "steel", "mesh": block(2, self.wall, 3, 1, 0, -self.wall)}},
            "sets": {f"whole {body}": {"of": body, "kind": "nodes"} for body in ("rod", "wall")},
            "boundary conditions": {"foot": {"set": "wall/bottom", "y": 0}, "held": {"set": "rod/top", "y": 0}, "rod": {"set": "whole rod", "x": 0},
                                    "wall": {"set": "whole wall", "x": 0}},
            "contact": {"joint": {"slave": "rod/bottom", "master": "wall/top", "heat": {"conductance": laws[law]}}},
            "heat": {"analysis": "steady", "initial temperature": 0,
                     "temperatures": {"hot": {"set": "rod/top", "temperature": f"{self.hottest}*t"}, "cold": {"set": "wall/bottom", "temperature": 0}}},
            "stepping": {"step": 1 / self.steps, "end time": 1}, "output": {"fields": ""},
            "quantities": {"force": {"type": "reaction", "set": "wall/bottom", "component": "y"}, "q": {"type": "heat flow", "pair": "joint"}}}

    def state(self):
        """p and q, by bisection: what p should be falls as p rises."""
        low, high = 0.0, self.modulus
        for _ in range(200):
            p = 0.5 * (low + high)
            h = self.strength * p ** self.exponent
            q = h * self.hottest / (1 + h * (self.length + self.wall) / self.conductivity)
            surface, of_wall = self.hottest - q * self.length / self.conductivity, q * self.wall / self.conductivity
            growth = self.expansion * (self.length * (self.hottest + surface) + self.wall * of_wall) / 2 - self.gap
            low, high = (p, high) if self.modulus * growth / (self.length + self.wall) > p else (low, p)
        return p, q


def rubbing(share, level):
    """Two wide flat layers slide over a hundredth of their width: in the middle they are half spaces with a flux of heat. The scene, and the rise of either
    surface over the power per area, 2 share sqrt(t / (pi k rho c)) with t = 1.

    The layers are 1 thick, which heat does not get through: sqrt(k t / (rho c)) is 0.1 and 0.14."""
    rail = {"conductivity": 4.0, "density": 4.0, "capacity": 100.0}
    pad = {"conductivity": 1.0, "density": 1.0, "capacity": 50.0}
    effusivity = {name: math.sqrt(one["conductivity"] * one["density"] * one["capacity"]) for name, one in (("pad", pad), ("rail", rail))}
    of_pad = effusivity["pad"] / sum(effusivity.values()) if share is None else share
    mesh = lambda x, y, width, toward, cells: {**block(width, 1, cells, 20 * level, x, y), "grading y": {"toward": toward, "ratio": 8}}
    pair = {"slave": "pad/bottom", "master": "rail/top", "friction": {"type": "coulomb", "coefficient": 0.3}, "heat": {}}
    # Layers of 1 under a squeeze have the pressure of two oedometers in series, and sheared by friction the displacement that comes before any slip.
    moduli, ratio, squeeze = (1e4, 2e5), 0.3, 1e-3
    shear = 0.3 * squeeze / sum((1 + ratio) * (1 - 2 * ratio) / ((1 - ratio) * modulus) for modulus in moduli)
    elastic = shear * sum(2 * (1 + ratio) / modulus for modulus in moduli)
    if share is not None:
        pair["heat"]["slave share"] = share
    else:
        pair["heat"]["conductance"] = {"type": "constant", "value": 50}
    scene = {
        "kinematics": "plane strain", "materials": {"pad": material(modulus=moduli[0], **pad), "rail": material(modulus=moduli[1], **rail)},
        "bodies": {"pad": {"material": "pad", "mesh": mesh(-10, 1, 20, "start", 10)}, "rail": {"material": "rail", "mesh": mesh(-10.5, 0, 21, "end", 12)}},
        "boundary conditions": {"foot": {"set": "rail/bottom", "x": 0, "y": 0}, "drive": {"set": "pad/top", "x": f"{elastic:.6g} + 0.2*t", "y": -squeeze}},
        "contact": {"joint": pair},
        "heat": {"analysis": "transient", "initial temperature": 0},
        "stepping": {"step": 0.04 / level ** 2, "end time": 1}, "output": {"fields": ""},
        "quantities": {"shear": {"type": "contact traction", "x": 0, "part": "shear"}, "power": {"type": "formula", "value": "abs(shear)*0.2"},
                       "pad": temperature_at((0, 1), "pad"), "rail": temperature_at((0, 1), "rail"), "balance": {"type": "heat balance"}},
    }
    root = 2 / math.sqrt(math.pi)
    return scene, {"pad": root * of_pad / effusivity["pad"], "rail": root * (1 - of_pad) / effusivity["rail"]}


def brake(turn, wear):
    """A pad on a disk that turns by `turn` in each of five times after one that presses. The scene, and the arm of the force of an even pressure, or of even
    wear: a pressure as 1/r.

    A force of friction is along the chord of the way: heat over torque times angle is tan(turn/2)/(turn/2)."""
    inner, outer, half = 90.0, 140.0, 30.0
    iron = material(50, 1.2e5, 7.2e-9, 5e8)
    lining = material(2, 100, 2.5e-9, 1e9)
    turned = f"{180 / math.pi:.17g}*{turn}*max(t - 1, 0)"
    scene = {
        "kinematics": "three dimensional", "materials": {"iron": iron, "lining": lining},
        "bodies": {"disk": {"material": "iron", "mesh": {"type": "cylinder", "radius": 150, "cells around": 3, "cells across": 2, "height": 12, "cells z": 1}},
                   "pad": {"material": "lining", "mesh": {"type": "extruded", "height": 5, "cells z": 1, "translation": "0, 0, 12", "profile": {
                       "type": "ring sector", "inner radius": inner, "outer radius": outer, "start angle": -half, "end angle": half, "cells across": 4, "cells around": 6}}}},
        "reference points": {"shaft": {"set": "disk/bottom", "position": "0, 0, 0"}},
        "sets": {"face": {"of": "pad/surface", "kind": "sides", "normal": "0, 0, -1"}, "back": {"of": "pad/surface", "kind": "sides", "normal": "0, 0, 1"}},
        "boundary conditions": {"shaft": {"set": "shaft", "x": 0, "y": 0, "z": 0, "rotation x": 0, "rotation y": 0, "rotation z": turned},
                                "calliper": {"set": "back", "x": 0, "y": 0}},
        "loads": {"piston": {"type": "dead traction", "set": "back", "z": "-100/sqrt(x^2 + y^2)" if wear else -1}},
        "contact": {"joint": {"slave": "face", "master": "disk/top", "friction": {"type": "coulomb", "coefficient": 0.4},
                              "heat": {"conductance": {"type": "power", "factor": 20, "hardness": 200}}}},
        "heat": {"analysis": "transient", "initial temperature": 293}, "stepping": {"step": 1, "end time": 6, "output times": "2, 3, 4, 5"}, "output": {"fields": ""},
        "quantities": {"force": {"type": "contact force", "component": "z"}, "torque": {"type": "reaction", "set": "shaft", "component": "rotation z"},
                       "power": {"type": "friction heat", "measure": "power"}, "plain": {"type": "formula", "value": f"power/(torque*{turn})"},
                       "ratio": {"type": "formula", "value": f"plain*{turn / 2}/tan({turn / 2})"}, "lever": {"type": "formula", "value": "torque/(0.4*force)"},
                       "balance": {"type": "heat balance"}},
    }
    return scene, (inner + outer) / 2 if wear else 2 / 3 * (outer ** 3 - inner ** 3) / (outer ** 2 - inner ** 2)


def wild_scene(seed):
    """A coupled scene with random dimension, elements, materials, meshes, enforcement, friction, ties, laws of conductance and loads; and words on it."""
    dice = random.Random(7919 * seed + 13)
    one = lambda low, high: round(low * (high / low) ** dice.random(), 6)
    kind = dice.choice(["plane strain", "plane stress", "axisymmetric", "three dimensional", "three dimensional"])
    space = kind == "three dimensional"
    elements = dice.choice([("H8", "H8"), ("H8 F-bar", "H8"), ("Tet4", "H8"), ("Tet10", "H8"), ("H20", "H8")] if space else
                           [("Q4", "Q4"), ("Q4 F-bar", "Q4"), ("Q8", "Q4"), ("T3", "Q4"), ("T6", "Q8")])
    if kind == "plane stress":
        elements = tuple(element.replace(" F-bar", "") for element in elements)
    up = "z" if space else "y"

    def body():
        modulus = one(5e4, 3e5)
        result = material(one(5, 200), modulus, one(1e-3, 1e-1), one(20, 500), one(5e-6, 3e-5), law=dice.choice(["hencky", "neo hooke", "st venant kirchhoff"]))
        if dice.random() < 0.3:
            result["thermomechanics"]["young's modulus"] = f"{modulus}*(1 - 3e-4*(temperature - 300))"
        if dice.random() < 0.3:
            result["thermomechanics"]["thermoelastic heating"] = True
        if dice.random() < 0.3:
            result["heat"]["conductivity"] = f"{result['heat']['conductivity']}*(1 + 5e-4*(temperature - 300))"
        if dice.random() < 0.3:
            result["heat"]["specific heat"] = f"{result['heat']['specific heat']}*(1 + 5e-4*(temperature - 300))"
        return result

    cells = (dice.randint(3, 5), 2, 2), (dice.randint(6, 9), 2, dice.randint(2, 3)), (dice.randint(4, 7), 2, 2)

    def mesh(lengths, cells, x, y):
        if not space:
            return block(lengths[0], lengths[1], cells[0], cells[1], x, y)
        return {"type": "brick", "width": lengths[0], "depth": 1, "height": lengths[1], "cells x": cells[0], "cells y": cells[2], "cells z": cells[1], "translation": f"{x}, 0, {y}"}

    law = dice.choice([{"type": "constant", "value": one(0.5, 500)}, {"type": "power", "factor": one(1, 100), "hardness": 800, "exponent": 0.95},
                       {"type": "table", "pressures": "0, 50, 500", "conductances": f"0, {one(1, 20)}, {one(30, 100)}"},
                       {"type": "function", "conductance": f"{one(1, 30)}*(1 + pressure/500)*(1 + 1e-3*(temperature - 300))"}])
    formulation = dice.choice(["dual mortar", "dual mortar", "penalty", "augmented lagrange", "standard mortar"])
    friction = dice.choice([None, "coulomb", "coulomb", "tresca"])
    tied, integration = dice.random() < 0.4, dice.choice(["backward euler", "backward euler", "trapezoidal"])
    held = {"x": 0, up: 0, **({"y": 0} if space else {})}
    slide = one(0.01, 0.05) if kind == "axisymmetric" else one(0.02, 0.3)
    pair = {"slave": "upper/bottom", "master": "lower/top", "formulation": {"type": formulation}, "heat": {"conductance": law}}
    if friction:
        pair["friction"] = {"type": "coulomb", "coefficient": one(0.05, 0.6)} if friction == "coulomb" else {"type": "tresca", "traction": one(1, 50)}
        if dice.random() < 0.5:
            pair["heat"]["slave share"] = round(dice.random(), 3)
    scene = {
        "kinematics": kind, "materials": {"a": body(), "b": body(), "c": body()},
        "bodies": {"upper": {"material": "a", "element": elements[0], "mesh": mesh((4, 2), cells[0], 3, 3)},
                   "lower": {"material": "b", "element": elements[1], "mesh": mesh((10, 3), cells[1], 0, 0)}},
        "boundary conditions": {"foot": {"set": "lower/bottom", **held}, "drive": {"set": "upper/top", **held, "x": f"{slide}*t", up: f"{-one(0.002, 0.02)}*min(5*t, 1)"}},
        "contact": {"joint": pair},
        "heat": {"analysis": "transient", "integration": integration, "initial temperature": 300, "temperatures": {"hot": {"set": "upper/top", "temperature": f"300 + {one(50, 400)}*t"}}},
        "stepping": {"step": 0.2}, "output": {"fields": ""},
        "quantities": {"balance": {"type": "heat balance"}, "stored": {"type": "stored heat"}, "across": {"type": "heat flow", "pair": "joint", "measure": "energy"},
                       "of_lower": {"type": "stored heat", "body": "lower"}, "force": {"type": "contact force", "component": up}},
    }
    if tied:
        scene["bodies"]["foot"] = {"material": "c", "element": elements[1], "mesh": mesh((10, 1), cells[2], 0, -1)}
        scene["ties"] = {"glue": {"slave": "lower/bottom", "master": "foot/top"}}
        scene["boundary conditions"]["foot"]["set"] = "foot/bottom"
    if dice.random() < 0.5:
        put(scene, "heat/loads", {"air": {"type": "convection", "set": "lower/right", "coefficient": one(0.05, 5), "surroundings": 280}})
    if dice.random() < 0.3:
        put(scene, "heat/temperatures/cold", {"set": ("foot" if tied else "lower") + "/bottom", "temperature": 300})
    return scene, f"{kind}, {elements[0]} on {elements[1]}, {formulation}, {friction or 'no'} friction, {law['type']}, {integration}{', tied' if tied else ''}"


def refined(scene):
    """The scene with half as large cells."""
    other = json.loads(json.dumps(scene))
    for body in other["bodies"].values():
        for axis in ("x", "y", "z"):
            if f"cells {axis}" in body["mesh"]:
                body["mesh"][f"cells {axis}"] *= 2
    return other


def at(values):
    """What is compared between meshes: the heat that all bodies have taken up."""
    return values["stored"]
