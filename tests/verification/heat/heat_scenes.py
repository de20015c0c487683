"""Scenes of heat, written from dictionaries, and their runs."""
import csv
import json
import os
import random
import subprocess
from xml.etree import ElementTree


def parameter_list(name, entries):
    """A list of parameters: values that are dictionaries are lists."""
    element = ElementTree.Element("ParameterList", name=name)
    for key, value in entries.items():
        if isinstance(value, dict):
            element.append(parameter_list(key, value))
        else:
            kind = "bool" if isinstance(value, bool) else "string"
            text = str(value).lower() if isinstance(value, bool) else str(value)
            ElementTree.SubElement(element, "Parameter", name=key, type=kind, value=text)
    return element


class Runs:
    """Runs scenes in folders of a directory."""

    def __init__(self, mortise, directory):
        self.mortise, self.directory = mortise, directory
        os.makedirs(directory, exist_ok=True)

    def run(self, name, scene, ranks=1):
        """Exit code, what was printed, the last values of quantities, and the columns of history.csv."""
        path = os.path.join(self.directory, name + ".xml")
        ElementTree.ElementTree(parameter_list(name, scene)).write(path)
        results = os.path.join(self.directory, f"{name}_{ranks}")
        launch = ["mpirun", "-n", str(ranks)] if ranks > 1 else []
        done = subprocess.run(launch + [self.mortise, "run", path, "-o", results], capture_output=True, text=True, timeout=300)
        values, columns = {}, {}
        if done.returncode in (0, 3, 4):
            with open(os.path.join(results, "summary.json")) as file:
                values = json.load(file)["quantities"]
            with open(os.path.join(results, "history.csv")) as file:
                rows = list(csv.DictReader(file))
            columns = {title: [float(row[title]) for row in rows if row[title]] for title in rows[0] if title not in ("reason",)} if rows else {}
        return done.returncode, done.stdout + done.stderr, values, columns


def block(width, height, cells_x, cells_y, x=0.0, y=0.0, angle=0.0):
    mesh = {"type": "block", "width": width, "height": height, "cells x": cells_x, "cells y": cells_y, "translation": f"{x}, {y}"}
    if angle:
        mesh["rotation"] = angle
    return mesh


def material(conductivity=50, modulus=2e5, density=1e-2, capacity=100, expansion=None, reference=300, law="hencky", **thermal):
    result = {"type": law, "young's modulus": modulus, "poisson's ratio": 0.3, "density": density,
              "heat": {"conductivity": conductivity, "specific heat": capacity}}
    if expansion is not None:
        result["thermomechanics"] = {"reference temperature": reference, "expansion coefficient": expansion, **thermal}
    return result


def pressed_pair(**changes):
    """Two blocks pressed on each other with friction and a conductance; the upper one is pushed to the side."""
    pair = {"slave": "upper/bottom", "master": "lower/top", "friction": {"type": "coulomb", "coefficient": 0.3},
            "heat": {"conductance": {"type": "power", "factor": 20, "hardness": 500, "exponent": 0.95}}}
    scene = {
        "kinematics": "plane strain",
        "materials": {"a": material(60, expansion=1.2e-5), "b": material(20, modulus=1e5, expansion=2e-5)},
        "bodies": {"upper": {"material": "a", "mesh": block(4, 2, 7, 4, 3, 3)}, "lower": {"material": "b", "mesh": block(10, 3, 13, 4)}},
        "boundary conditions": {"foot": {"set": "lower/bottom", "x": 0, "y": 0}, "drive": {"set": "upper/top", "x": "0.5*t", "y": "-0.01*min(5*t, 1)"}},
        "contact": {"joint": pair},
        "heat": {"analysis": "transient", "initial temperature": 300, "temperatures": {"hot": {"set": "upper/top", "temperature": "300 + 200*t"}}},
        "stepping": {"step": 0.1},
        "output": {"fields": ""},
        "quantities": {"balance": {"type": "heat balance"}, "stored": {"type": "stored heat"}, "across": {"type": "heat flow", "pair": "joint", "measure": "energy"},
                       "friction": {"type": "friction heat"}, "force": {"type": "reaction", "set": "upper/top", "component": "y"},
                       "hottest": {"type": "extremum", "field": "temperature"}},
    }
    for path, value in changes.items():
        put(scene, path, value)
    return scene


def put(scene, path, value):
    """Sets or, with None, removes the entry of a path "list/list/name"."""
    *lists, name = path.split("/")
    for one in lists:
        scene = scene.setdefault(one, {})
    if value is None:
        scene.pop(name, None)
    else:
        scene[name] = value


def random_scene(seed):
    """A coupled scene with random materials, laws, meshes and loads."""
    dice = random.Random(seed)
    one = lambda low, high: round(low * (high / low) ** dice.random(), 6)
    law = dice.choice(["hencky", "neo hooke", "st venant kirchhoff", "ciarlet neo hooke"])
    upper = material(one(5, 200), one(5e4, 3e5), one(1e-3, 1e-1), one(20, 500), one(5e-6, 3e-5), law=law)
    lower = material(one(5, 200), one(5e4, 3e5), one(1e-3, 1e-1), one(20, 500), one(5e-6, 3e-5), law=dice.choice(["hencky", "neo hooke"]))
    stiffness = upper["young's modulus"]
    if dice.random() < 0.5:
        upper["thermomechanics"]["young's modulus"] = f"{stiffness}*(1 - 3e-4*(temperature - 300))"
    if dice.random() < 0.3:
        lower["thermomechanics"]["thermoelastic heating"] = True
    if dice.random() < 0.3:
        lower["heat"]["conductivity"] = f"{lower['heat']['conductivity']}*(1 - 2e-4*(temperature - 300))"
    conductance = dice.choice([{"type": "constant", "value": one(0.5, 500)}, {"type": "power", "factor": one(1, 100), "hardness": 800, "exponent": 0.95},
                               {"type": "table", "pressures": "0, 50, 500", "conductances": f"0, {one(1, 20)}, {one(30, 100)}"}])
    element = dice.choice([("Q4", "Q4"), ("Q4 F-bar", "Q4"), ("Q8", "Q8"), ("Q4", "Q8")])
    kinematics = dice.choice(["plane strain", "plane strain", "axisymmetric"])
    scene = pressed_pair(**{"materials": {"a": upper, "b": lower}, "kinematics": kinematics, "contact/joint/heat/conductance": conductance,
                            "contact/joint/friction/coefficient": one(0.05, 0.6), "bodies/upper/element": element[0], "bodies/lower/element": element[1],
                            "bodies/upper/mesh": block(4, 2, dice.randint(4, 9), dice.randint(2, 4), 3, 3),
                            "bodies/lower/mesh": block(10, 3, dice.randint(9, 17), dice.randint(3, 5)),
                            "heat/temperatures/hot/temperature": f"300 + {one(50, 400)}*t", "boundary conditions/drive/y": f"{-one(0.002, 0.02)}*min(5*t, 1)"})
    if kinematics == "axisymmetric":
        put(scene, "boundary conditions/drive/x", f"{one(0.01, 0.05)}*t")
    if dice.random() < 0.5:
        put(scene, "heat/loads", {"air": {"type": "convection", "set": "lower/right", "coefficient": one(0.05, 5), "surroundings": 280}})
    if dice.random() < 0.3:
        put(scene, "contact/joint/heat/slave share", round(dice.random(), 3))
    if dice.random() < 0.3:
        put(scene, "contact/joint/formulation", {"type": dice.choice(["penalty", "augmented lagrange", "standard mortar"])})
    return scene


def exchanged(scene):
    """The scene with slave and master exchanged; the slave's share of the heat of friction stays with its body."""
    other = json.loads(json.dumps(scene))
    pair = other["contact"]["joint"]
    pair["slave"], pair["master"] = pair["master"], pair["slave"]
    if "slave share" in pair["heat"]:
        pair["heat"]["slave share"] = 1 - pair["heat"]["slave share"]
    return other
