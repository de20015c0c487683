"""Heat across contact by CalculiX (*GAP CONDUCTANCE) and by Mortise on the same meshes.

usage: calculix_heat.py MORTISE CCX DIRECTORY [PAGE [CASE ...]]

PAGE takes the table, of all cases or of those that are named. A difference above its bound is wrong, and the exit code is 1. Units: mm, N, t, s, K.
"""
import json
import math
import os
import re
import subprocess
import sys

from calculix_heat_meshes import Block

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "heat"))
from heat_scenes import Runs  # noqa: E402

LOWER, UPPER = (2e5, 0.3, 7.8e-9, 45, 4.6e8, 1.2e-5), (7e4, 0.33, 2.7e-9, 200, 9e8, 2.3e-5)
PRESSURES, CONDUCTANCES = (0, 10, 30, 100), (0, 20, 50, 100)   # a conductance that is lost at once where a node opens would let iterations cycle
STIFFNESS = 1e6                                       # of contact in both programs


class Case:
    """Two bodies, a slave above or outside and a master; temperatures, supports and a pressure by sides."""

    def __init__(self, name, what, bodies, pair, expands, temperatures, supports, pressure, initial, steps, bound, cause=""):
        self.name, self.what, self.bodies, self.pair, self.expands, self.temperatures = name, what, bodies, pair, expands, temperatures
        self.duration = 1 if steps == 1 else 0.2
        self.supports, self.pressure, self.initial, self.steps, self.bound, self.cause = supports, pressure, initial, steps, bound, cause

    def mesh(self):
        return [line for body in self.bodies for line in body.lines()]

    def deck(self):
        slave, master = self.pair
        lines = self.mesh() + ["*NSET, NSET=NALL"] + [f"{node}," for body in self.bodies for node in body.nodes.values()]
        for body, (modulus, ratio, density, conductivity, capacity, expansion) in zip(self.bodies, (LOWER, UPPER)):
            lines += [f"*MATERIAL, NAME=M_{body.name}", "*ELASTIC", f"{modulus}, {ratio}", "*DENSITY", f"{density}", "*CONDUCTIVITY", f"{conductivity}",
                      "*SPECIFIC HEAT", f"{capacity}"]
            lines += ["*EXPANSION, ZERO=0", f"{expansion}"] if self.expands else []
            lines.append(f"*SOLID SECTION, ELSET={body.name}, MATERIAL=M_{body.name}")
        lines += ["*AMPLITUDE, NAME=AT_ONCE", "0, 1, 1000, 1"] if self.steps > 1 else []
        lines += ["*SURFACE INTERACTION, NAME=JOINT", "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR", f"{STIFFNESS:.6g}", "*GAP CONDUCTANCE"]
        lines += [f"{h}, {p}, 0" for h, p in zip(CONDUCTANCES, PRESSURES)]
        lines += ["*CONTACT PAIR, INTERACTION=JOINT, TYPE=SURFACE TO SURFACE", f"{slave}, {master}", "*INITIAL CONDITIONS, TYPE=TEMPERATURE",
                  f"NALL, {self.initial}", "*BOUNDARY"]
        lines += [f"N_{side}, {axis}, {axis}" for side, axis in self.supports]
        if self.steps > 1:
            # A transient step of CalculiX has inertia. It begins in equilibrium under the pressure, and rings all the same; the first step has to ask for energies.
            lines += ["*STEP, INC=1000", "*COUPLED TEMPERATURE-DISPLACEMENT, STEADY STATE", "1, 1"] + self.conditions(False) + ["*EL FILE", "ENER", "*END STEP"]
        lines += ["*STEP, INC=1000", "*COUPLED TEMPERATURE-DISPLACEMENT" + (", DIRECT" if self.steps > 1 else ", STEADY STATE")]
        lines += [f"{self.duration / self.steps}, {self.duration}" if self.steps > 1 else f"{0.25 if self.expands and self.pressure else 1}, 1"] + self.conditions(True)
        for side in self.temperatures:
            lines += [f"*NODE PRINT, NSET=N_{side}, TOTALS=ONLY", "RFL"]
        lines += [f"*NODE PRINT, NSET=N_{slave}", "NT", f"*NODE PRINT, NSET=N_{master}", "NT", f"*CONTACT PRINT, SLAVE={slave}, MASTER={master}", "CF", "*END STEP"]
        return lines

    def conditions(self, heated):
        """Temperatures, from the start of a transient step on, and the pressure."""
        amplitude = ", AMPLITUDE=AT_ONCE" if self.steps > 1 else ""
        lines = ["*BOUNDARY" + amplitude] + [f"N_{side}, 11, 11, {value if heated else self.initial}" for side, value in self.temperatures.items()]
        return lines + (["*DLOAD" + amplitude] + self.pressure_lines() if self.pressure else [])

    def end(self):
        """Time of CalculiX at the end: a transient step follows one of 1."""
        return self.duration if self.steps == 1 else 1 + self.duration

    def pressure_lines(self):
        side, value = self.pressure
        name, _, place = side.partition("_")
        body = next(one for one in self.bodies if one.name == name)
        return [f"{element}, P{face}, {value}" for element, face in body.sides[place]]

    def scene(self, mesh):
        kind = {"C3D8": "H8", "C3D20": "H20", "C3D10": "Tet10"}
        slave, master = self.pair
        materials = {}
        for body, (modulus, ratio, density, conductivity, capacity, expansion) in zip(self.bodies, (LOWER, UPPER)):
            materials[body.name] = {"type": "small strain linear", "young's modulus": modulus, "poisson's ratio": ratio, "density": density,
                                    "heat": {"conductivity": conductivity, "conductivity acts in": "reference", "specific heat": capacity}}
            if self.expands:
                materials[body.name]["thermomechanics"] = {"reference temperature": 0, "expansion coefficient": expansion}
        of = lambda side: side.partition("_")[0] + "/" + side
        scene = {
            "kinematics": "three dimensional", "materials": materials,
            "bodies": {body.name: {"material": body.name, "element": kind[body.kind], "mesh": {"type": "file", "file": mesh, "blocks": body.name}} for body in self.bodies},
            "boundary conditions": {f"{side} {axis}": {"set": of(side), "xyz"[axis - 1]: 0} for side, axis in self.supports},
            "contact": {"joint": {"slave": of(slave), "master": of(master), "geometry": "reference",
                                  "formulation": {"type": "pressure overclosure", "law": {"type": "linear", "stiffness": STIFFNESS}}, "heat": {"conductance": {
                "type": "table", "pressures": ", ".join(map(str, PRESSURES)), "conductances": ", ".join(map(str, CONDUCTANCES))}}}},
            "heat": {"analysis": "transient" if self.steps > 1 else "steady", "initial temperature": self.initial,
                     "temperatures": {side: {"set": of(side), "temperature": f"{value}*t" if self.expands else value} for side, value in self.temperatures.items()}},
            "stepping": {"step": self.duration / self.steps, "end time": self.duration}, "output": {"fields": ""},
            "quantities": {**{f"flow {side}": {"type": "heat flow", "set": of(side)} for side in self.temperatures},
                           **{f"mean {side}": {"type": "mean", "field": "temperature", "on": of(side)} for side in self.pair},
                           **{f"highest {side}": {"type": "extremum", "field": "temperature", "on": of(side)} for side in self.pair},
                           **{f"lowest {side}": {"type": "extremum", "field": "temperature", "on": of(side), "which": "minimum"} for side in self.pair},
                           **{f"force {axis}": {"type": "contact force", "component": axis} for axis in "xyz"},
                           "balance": {"type": "heat balance"}},
        }
        if self.pressure:
            scene["loads"] = {"pressure": {"type": "dead traction", "set": of(self.pressure[0]), "z": -self.pressure[1]}}
        return scene


def blocks_of(text):
    """Blocks of the last time in a file of results, headline and rows, and that time."""
    result, rows = {}, None
    for line in text.splitlines():
        match = re.match(r"^ *(\S.*?) for set (\S+) and time +(\S+)", line)
        contact = re.match(r"^ *statistics for slave set +(\S+), master set (\S+) and time +(\S+)", line)
        if contact:
            rows = result["statistics"] = []
            result["time"] = float(contact.group(3))
        elif match:
            rows = result[(match.group(1).split(" (")[0], match.group(2).upper())] = []
        elif line.split() and rows is not None:
            try:
                rows.append([float(word) for word in line.split()])
            except ValueError:
                pass
    return result


def values_of(case, text):
    """Values of CalculiX by the names of the scene's quantities."""
    blocks = blocks_of(text)
    values = {}
    if abs(blocks.get("time", 0) - case.end()) > 1e-6:
        return values
    for side in case.temperatures:
        values[f"flow {side}"] = blocks["total heat generation", f"N_{side}".upper()][0][0]
    for side in case.pair:
        nodes = [row[1] for row in blocks["temperatures", f"N_{side}".upper()]]
        values.update({f"mean {side}": sum(nodes) / len(nodes), f"highest {side}": max(nodes), f"lowest {side}": min(nodes)})
    for axis, value in zip("xyz", blocks["statistics"][0]):
        values[f"force {axis}"] = value
    return values


def two_blocks(kind, cells=((3, 3, 2), (2, 2, 2))):
    return [Block("LOWER", kind, cells[0], lambda x, y, z: (2 * x, 2 * y, z), 0), Block("UPPER", kind, cells[1], lambda x, y, z: (2 * x, 2 * y, 1 + z), 100000)]


def ring_on_shaft(kind):
    bent = lambda inner, outer: lambda x, y, z: ((inner + (outer - inner) * x) * math.cos(math.pi / 2 * y), (inner + (outer - inner) * x) * math.sin(math.pi / 2 * y), 4 * z)
    return [Block("LOWER", kind, (1, 4, 1), bent(10, 20), 0), Block("UPPER", kind, (1, 3, 1), bent(20, 30), 100000)]


INERTIA = "a transient step of CalculiX has inertia: its contact force goes from 153 by 21, 127, 44 ... to 79.9, and with it the conductance"
FACETS = ("three facets on a quarter: gaps of the meshes. CalculiX has forces of 323 where the same state is the first of four increments, and finds none "
          "with 7 facets; Mortise has 272 and a flow of 6330 with 11")
OF_BLOCKS = dict(pair=("UPPER_bottom", "LOWER_top"), temperatures={"LOWER_bottom": 0, "UPPER_top": 100}, pressure=("UPPER_top", 20), initial=0,
                 supports=[("LOWER_bottom", 3), ("LOWER_left", 1), ("LOWER_front", 2), ("UPPER_left", 1), ("UPPER_front", 2)])
OF_RING = dict(pair=("UPPER_left", "LOWER_right"), temperatures={"LOWER_left": 25, "UPPER_right": 0}, pressure=None, initial=0, expands=True,
               supports=[(f"{body}_{side}", axis) for body in ("LOWER", "UPPER") for side, axis in (("front", 2), ("back", 1), ("bottom", 3))])
CASES = [
    Case("blocks_hexahedra", "block on block, C3D8, steady", two_blocks("C3D8"), expands=False, steps=1, bound=1e-5, **OF_BLOCKS),
    Case("blocks_tetrahedra", "the same, C3D10", two_blocks("C3D10"), expands=False, steps=1, bound=1e-5, **OF_BLOCKS),
    Case("blocks_transient", "the same, C3D20, ten steps of 0.02", two_blocks("C3D20"), expands=False, steps=10, bound=5e-3, cause=INERTIA, **OF_BLOCKS),
    Case("blocks_expanding", "block on block with expansion, C3D20, steady", two_blocks("C3D20"), expands=True, steps=1, bound=1e-2, **OF_BLOCKS),
    Case("ring", "ring on a shaft that grows as it is heated, C3D20, steady", ring_on_shaft("C3D20"), steps=1, bound=0.3, cause=FACETS, **OF_RING),
]


def main():
    program, ccx, directory = (os.path.abspath(path) if os.sep in path else path for path in sys.argv[1:4])
    runs, rows, wrong = Runs(program, directory), [], 0
    for case in [case for case in CASES if not sys.argv[5:] or case.name in sys.argv[5:]]:
        mesh = os.path.join(directory, case.name + "_mesh.inp")
        for path, lines in ((mesh, case.mesh()), (os.path.join(directory, case.name + ".inp"), case.deck())):
            with open(path, "w", encoding="utf-8") as file:
                file.write("\n".join(lines) + "\n")
        subprocess.run([ccx, case.name], cwd=directory, capture_output=True, text=True, timeout=3600, env=dict(os.environ, OMP_NUM_THREADS="1"))
        with open(os.path.join(directory, case.name + ".dat"), encoding="utf-8") as file:
            theirs = values_of(case, file.read())
        if not theirs:
            print(f"{case.name}: CalculiX has no result", flush=True)
            wrong += 1
            continue
        code, said, ours, _ = runs.run(case.name, case.scene(mesh))
        if code != 0:
            print(f"{case.name}: Mortise ends with {code}: {said[-400:]}")
            wrong += 1
            continue
        span = max(case.temperatures.values()) - min(case.temperatures.values())
        force = max(abs(theirs[f"force {axis}"]) for axis in "xyz")
        for place, (name, a) in enumerate(theirs.items()):
            b = ours[name]
            scale = abs(a) if name.startswith("flow") else force if name.startswith("force") else span
            apart = abs(a - b) / scale
            wrong += apart > case.bound
            rows.append(f"| {case.what if place == 0 else ''} | {name.replace('_', ', ').lower()} | {a:.6g} | {b:.6g} | {apart:.1e} | {case.cause if place == 0 else ''} |")
            print(("ok      " if apart <= case.bound else "FAILED  ") + f"{case.name}: {name}: CalculiX {a:.7g}, Mortise {b:.7g}, apart by {apart:.1e}", flush=True)
    if len(sys.argv) > 4:
        with open(sys.argv[4], "w", encoding="utf-8") as file:
            file.write("\n".join(rows) + "\n")
    print(f"{wrong} differences above their bounds")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
