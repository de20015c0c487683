"""A scene with meshes of Gmsh as a deck of CalculiX: what the ordinary parts need of it, no more. Expressions of a scene are sampled over time."""
import math
from xml.etree import ElementTree

ONLY_LAST = 1000000                                   # a frequency of increments: the last one is always printed
COMPONENTS = {"x": 1, "y": 2, "z": 3}


def parameters(element):
    return {child.get("name"): child.get("value") for child in element if child.tag == "Parameter"}


def lists(element):
    return {child.get("name"): child for child in element if child.tag == "ParameterList"} if element is not None else {}


class Expressions:
    """Values of a scene's expressions of t, x, y, z with its variables and tables."""

    def __init__(self, variables, tables):
        self.names = {name: getattr(math, name) for name in ("sin", "cos", "tan", "sqrt", "exp", "pi")}
        self.names.update(min=min, max=max)
        for name, table in tables.items():
            times, values = ([float(word) for word in parameters(table)[key].split(",")] for key in ("times", "values"))
            self.names[name] = lambda t, times=times, values=values: interpolated(t, times, values)
        for name, value in variables.items():
            self.names[name] = self.value(value)

    def value(self, text, **place):
        return float(eval(text.replace("^", "**"), {"__builtins__": {}}, {**self.names, **place}))


def interpolated(t, times, values):
    for (t0, v0), (t1, v1) in zip(zip(times, values), zip(times[1:], values[1:])):
        if t <= t1:
            return v0 + (v1 - v0) * max(t - t0, 0.0) / (t1 - t0)
    return values[-1]


class PartDeck:
    """The deck of one scene; `pairs` are (slave, master, stiffness of the penalty), named body/group."""

    def __init__(self, scene, mesh, pairs):
        root = ElementTree.parse(scene).getroot()
        self.mesh, self.pairs, self.root = mesh, pairs, lists(root)
        self.kinematics = parameters(root)["kinematics"]
        variables = parameters(self.root["variables"]) if "variables" in self.root else {}
        self.expressions = Expressions(variables, lists(self.root.get("tables")))
        self.unions = {name: parameters(entry)["of"].split(", ") for name, entry in lists(self.root.get("sets")).items()}
        self.bodies = {name: parameters(entry) for name, entry in lists(self.root["bodies"]).items()}
        stepping = parameters(self.root["stepping"])
        self.end, self.step = float(stepping.get("end time", 1)), float(stepping.get("step", 1))
        self.times = [self.end * i / round(2 * self.end / self.step) for i in range(round(2 * self.end / self.step) + 1)]
        self.first, number = {}, 1
        for body in self.bodies:
            self.first[body] = number
            number += len(mesh.elements(body))
        self.lines, self.sets, self.amplitudes, self.prints = [], {}, 0, []

    def members(self, name):
        """Bodies and groups that a set of the scene is made of."""
        if name in self.unions:
            return [part for one in self.unions[name] for part in self.members(one)]
        body, _, group = name.partition("/")
        return [(body, group)]

    def nodes(self, name):
        found = set()
        for body, group in self.members(name):
            cells = [cell for _, _, cell in self.mesh.faces(body, group)] if group else self.mesh.elements(body)
            found.update(node for cell in cells for node in cell)
        return sorted(found)

    def node_set(self, name):
        if name not in self.sets:
            self.sets[name] = f"N{len(self.sets)}"
            self.lines.append(f"*NSET, NSET={self.sets[name]}")
            self.lines += [f"{node}," for node in self.nodes(name)]
        return self.sets[name]

    def surface(self, name, label):
        self.lines.append(f"*SURFACE, NAME={label}, TYPE=ELEMENT")
        for body, group in self.members(name):
            self.lines += [f"{self.first[body] + element}, S{face}" for element, face, _ in self.mesh.faces(body, group)]

    def amplitude(self, values):
        self.amplitudes += 1
        self.lines.append(f"*AMPLITUDE, NAME=A{self.amplitudes}")
        self.lines += [f"{time:.10g}, {value:.12g}" for time, value in zip(self.times, values)]
        return f"A{self.amplitudes}"

    def write_bodies(self):
        used = sorted({node for body in self.bodies for cell in self.mesh.elements(body) for node in cell})
        self.lines.append("*NODE, NSET=NALL")
        self.lines += [f"{node}, " + ", ".join(f"{x:.12g}" for x in self.mesh.nodes[node]) for node in used]
        kind = {"three dimensional": "C3D10", "plane strain": "CPE6", "axisymmetric": "CAX6"}[self.kinematics]
        for number, body in enumerate(self.bodies):
            self.lines.append(f"*ELEMENT, TYPE={kind}, ELSET=E{number}")
            self.lines += [f"{self.first[body] + i}, " + ", ".join(map(str, cell)) for i, cell in enumerate(self.mesh.elements(body))]
        self.lines.append("*ELSET, ELSET=EALL")
        self.lines += [f"E{number}" for number in range(len(self.bodies))]

    def write_materials(self):
        materials = list(lists(self.root["materials"]))
        for number, material in enumerate(lists(self.root["materials"]).values()):
            values = parameters(material)
            modulus, ratio = float(values["young's modulus"]), float(values["poisson's ratio"])
            self.lines.append(f"*MATERIAL, NAME=M{number}")
            if values["type"] == "neo hooke":
                shear, bulk = modulus / (2 * (1 + ratio)), modulus / (3 * (1 - 2 * ratio))
                self.lines += ["*HYPERELASTIC, NEO HOOKE", f"{shear / 2:.10g}, {2 / bulk:.10g}"]
                continue
            self.lines += ["*ELASTIC", f"{modulus}, {ratio}"]
            if values["type"] == "j2 plasticity":
                hardening = parameters(lists(material)["hardening"])
                yields, slope = float(hardening["yield stress"]), float(hardening["modulus"])
                self.lines += ["*PLASTIC", f"{yields}, 0", f"{yields + 5 * slope}, 5"]
        for number, body in enumerate(self.bodies.values()):
            self.lines.append(f"*SOLID SECTION, ELSET=E{number}, MATERIAL=M{materials.index(body['material'])}")

    def write_contact(self):
        friction = parameters(lists(self.root["automatic contact"])["friction"])["coefficient"]
        for number, (slave, master, stiffness) in enumerate(self.pairs):
            self.surface(slave, f"S{number}")
            self.surface(master, f"M{number}")
            self.lines += [f"*SURFACE INTERACTION, NAME=I{number}", "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR", f"{stiffness:.6g}",
                           "*FRICTION", f"{self.expressions.value(friction):.10g}, {stiffness / 10:.6g}",
                           f"*CONTACT PAIR, INTERACTION=I{number}, TYPE=SURFACE TO SURFACE", f"S{number}, M{number}"]

    def write_supports(self):
        """Supports that stay where they are stand before the step; lines of the others are left for it."""
        fixed, moved = ["*BOUNDARY"], []
        for condition in lists(self.root["boundary conditions"]).values():
            values = parameters(condition)
            for component, number in COMPONENTS.items():
                text = values.get(component)
                if text is None:
                    continue
                label = self.node_set(values["set"])
                nodes = self.nodes(values["set"])
                samples = {node: [self.expressions.value(text, t=time, **dict(zip("xyz", self.mesh.nodes[node]))) for time in self.times] for node in nodes}
                if not any(any(sample) for sample in samples.values()):
                    fixed.append(f"{label}, {number}, {number}")
                elif all(sample == samples[nodes[0]] for sample in samples.values()):
                    moved += [f"*BOUNDARY, AMPLITUDE={self.amplitude(samples[nodes[0]])}", f"{label}, {number}, {number}, 1"]
                else:
                    for node in nodes:
                        moved += [f"*BOUNDARY, AMPLITUDE={self.amplitude(samples[node])}", f"{node}, {number}, {number}, 1"]
        self.lines += fixed
        return moved

    def loads(self):
        result = []
        for number, load in enumerate(lists(self.root.get("loads")).values()):
            values = parameters(load)
            if values["type"] == "follower pressure":
                self.surface(values["set"], f"P{number}")
                result += [f"*DSLOAD, AMPLITUDE={self.amplitude([self.expressions.value(values['pressure'], t=time) for time in self.times])}", f"P{number}, P, 1"]
                continue
            if values["type"] != "dead traction" or self.mesh.dimension != 3:
                raise RuntimeError(f"a deck of a part has no load of type {values['type']} here")
            forces = {}
            for body, group in self.members(values["set"]):
                for _, _, cell in self.mesh.faces(body, group):
                    for node in cell[3:]:              # on a plane face with straight edges the nodes in the middle bear all of it
                        forces[node] = forces.get(node, 0.0) + self.mesh.area(cell) / 3
            for component, direction in COMPONENTS.items():
                if component in values:
                    name = self.amplitude([self.expressions.value(values[component], t=time) for time in self.times])
                    result += [f"*CLOAD, AMPLITUDE={name}"] + [f"{node}, {direction}, {force:.10g}" for node, force in forces.items()]
        return result

    def text(self, quantities):
        """The deck; it prints the forces and displacements that the scene's quantities are made of, and stresses of the last increment."""
        self.write_bodies()
        self.write_materials()
        self.write_contact()
        requests = []
        for values in quantities.values():
            if values["type"] == "reaction":
                requests += [f"*NODE PRINT, NSET={self.node_set(values['set'])}, TOTALS=ONLY", "RF"]
            elif values["type"] == "mean":
                requests += [f"*NODE PRINT, NSET={self.node_set(values['on'])}", "U"]
        moved = self.write_supports()
        loads = self.loads()
        requests += [f"*EL PRINT, ELSET=EALL, FREQUENCY={ONLY_LAST}", "S, PEEQ", f"*CONTACT PRINT, FREQUENCY={ONLY_LAST}", "CSTR"]
        printed = [line for pair in dict.fromkeys(zip(requests[::2], requests[1::2])) for line in pair]
        step = ["*STEP, NLGEOM, INC=100000", "*STATIC", f"{self.step}, {self.end}, {self.step * 1e-4}, {self.step}"]
        return "\n".join(self.lines + step + moved + loads + printed + ["*END STEP"]) + "\n"
