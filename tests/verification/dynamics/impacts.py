"""Scenes of impacts that tests and studies of dynamics write, and their runs."""
import csv
import json
import math
import os
import random
import subprocess
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "scenes"))
from scene_writer import named, numbers  # noqa: E402


class Runs:
    """Runs scenes below a directory. A result is (quantities of the end, columns of the history)."""

    def __init__(self, mortise, directory):
        self.mortise, self.directory = os.path.abspath(mortise), os.path.abspath(directory)
        os.makedirs(self.directory, exist_ok=True)

    def file(self, name, path, settings=()):
        output = os.path.join(self.directory, name)
        words = [word for setting in settings for word in ("--set", setting)]
        done = subprocess.run([self.mortise, "run", path, "-o", output, "--quiet", *words], capture_output=True, text=True)
        if done.returncode not in (0, 3, 4):  # 3: it ended early, with fewer rows than asked for; 4: a check was missed
            sys.exit(f"{name}: exit code {done.returncode}\n{done.stdout[-1000:]}{done.stderr[-1000:]}")
        with open(os.path.join(output, "summary.json"), encoding="utf-8") as file:
            quantities = json.load(file)["quantities"]
        with open(os.path.join(output, "history.csv"), encoding="utf-8") as file:
            rows = list(csv.reader(file))
        columns = {title: [float(row[k]) for row in rows[1:]] for k, title in enumerate(rows[0])}
        return quantities, columns

    def write(self, name, content):
        path = os.path.join(self.directory, name + ".xml")
        with open(path, "w", encoding="utf-8") as file:
            file.write(named(name, *content))
        return path

    def scene(self, name, content, settings=()):
        return self.file(name, self.write(name, content), settings)


def energies(*names):
    kinds = {"kinetic energy": "kinetic", "stored energy": "stored", "contact work": "contact work", "friction": "friction"}
    return "".join(named(name, type="energy", of=kinds[name]) for name in names)


def material(name, modulus, density, ratio=0.0, law="small strain linear"):
    return named(name, **{"type": law, "young's modulus": modulus, "poisson's ratio": ratio, "density": density})


def block(dimension, name, substance, length, start, cells, across, shift=0.0):
    """A block along x from `start` on, 1 wide."""
    if dimension == 2:
        mesh = named("mesh", type="block", width=length, height=1.0, cells_x=cells, cells_y=across, translation=numbers(start, shift))
    else:
        mesh = named("mesh", type="brick", width=length, depth=1.0, height=1.0, cells_x=cells, cells_y=across, cells_z=across,
                     translation=numbers(start, shift, shift))
    return named(name, mesh, material=substance)


def pair_of_blocks(dimension, moduli, densities, across, cells, speeds, friction=0.0, second_is_slave=False, inertia=None, courant=0.9, waves=3.0,
                   ratio=0.0):
    """A block strikes another one at rest with `speeds` along x and across. The run lasts for `waves` ways of a wave through the slower one."""
    celerity = [(modulus / density) ** 0.5 for modulus, density in zip(moduli, densities)]
    step = courant * min(1.0 / (cells * c) for c in celerity)
    end = waves / max(min(celerity), 0.2 * max(celerity))
    surfaces = ("second/left", "first/right") if second_is_slave else ("first/right", "second/left")
    law = named("friction", type="coulomb", coefficient=friction) if friction else ""
    fields = ("",)
    return [
        f'<Parameter name="kinematics" type="string" value="{"plane strain" if dimension == 2 else "three dimensional"}"/>',
        named("materials", material("one", moduli[0], densities[0], ratio), material("other", moduli[1], densities[1], ratio)),
        named("bodies", block(dimension, "first", "one", 1.0, 0.0, cells, across[0]), block(dimension, "second", "other", 1.0, 1.0, cells, across[1])),
        named("inertia", **{"scheme": "generalised alpha", **(inertia or {})}),
        named("initial conditions", named("throw", body="first", velocity_x=speeds[0], velocity_y=speeds[1])),
        named("contact", named("joint", law, slave=surfaces[0], master=surfaces[1], geometry="reference")),
        named("stepping", end_time=end, step=step), named("output", fields=fields[0], every_step=0),
        named("quantities", named("force", type="contact force", component="x"), named("impulse", type="impulse", component="x"), named("peak", type="peak pressure"),
              *[named(f"momentum {c}", type="momentum", component=c) for c in "xyz"[:dimension]],
              energies("kinetic energy", "stored energy", "contact work"), named("energy error", type="energy error", against="mechanical"))]


def random_pair(seed):
    """Arguments of pair_of_blocks(): moduli and densities over three decades, either side as slave, in 2D and 3D, with and without friction."""
    draw = random.Random(seed)
    def decades():
        return 10.0 ** draw.uniform(-1.5, 1.5)
    dimension = 3 if seed % 10 == 0 else 2
    return {"dimension": dimension, "moduli": (decades(), decades()), "densities": (decades(), decades()), "across": draw.choice([(2, 3), (3, 4), (4, 3), (1, 1)]) if dimension == 2 else (1, 2),
            "cells": 8 if dimension == 2 else 4, "speeds": (0.01, draw.uniform(-0.01, 0.01)), "friction": draw.choice([0.0, 0.1, 0.3, 0.5]),
            "second_is_slave": draw.random() < 0.5, "ratio": draw.choice([0.0, 0.3]), "courant": draw.choice([0.4, 0.9, 2.0])}


def start_energy(densities, speeds, **_):
    """Kinetic energy at the start of pair_of_blocks(), of a block of the volume 1."""
    return 0.5 * densities[0] * sum(speed**2 for speed in speeds)


def largest_rise(values):
    """Largest rise from any value to a later one."""
    lowest, rise = values[0], 0.0
    for value in values:
        lowest = min(lowest, value)
        rise = max(rise, value - lowest)
    return rise


def largest_gain(columns, start):
    """Largest rise of the contact work from the start or any step to a later one, over the energy at the start."""
    return largest_rise([0.0] + columns["contact work"]) / start


def disc_on_floor(friction, across, along, spin, step=0.25, cells=12, rings=4, profiles=False):
    """A disc of E = rho = R = 1 flies obliquely, and turns, onto a rigid floor. It is free for two steps and a half before its lowest point touches."""
    end = 12.0
    times = {"output_times": numbers(*[step * k for k in range(1, round(end / step))])} if profiles else {}
    return [
        '<Parameter name="kinematics" type="string" value="plane strain"/>', named("materials", material("elastic", 1.0, 1.0, 0.3, "hencky")),
        named("bodies", named("disc", named("mesh", type="disk", radius=1.0, cells_around=cells, cells_across=rings), material="elastic"),
              named("floor", named("mesh", type="block", width=6.0, height=1.0, cells_x=1, cells_y=1, translation=numbers(-3.0, -2.0 - 2.5 * step * across)), rigid=True)),
        named("boundary conditions", named("floor", set="floor/reference", x=0.0, y=0.0, rotation=0.0)),
        named("inertia", scheme="generalised alpha"),
        named("initial conditions", named("throw", body="disc", velocity_x=along, velocity_y=-across, spin=spin)),
        named("contact", named("floor", named("friction", type="coulomb", coefficient=friction), slave="disc/arc", master="floor/top")),
        named("stepping", end_time=end, step=step, **times), named("output", fields="", every_step=0, contact_profiles=profiles),
        named("quantities", *[named(f"momentum {c}", type="momentum", component=c) for c in "xy"],
              *[named(f"impulse {c}", type="impulse", component=c) for c in "xy"], named("angular momentum", type="angular momentum"), named("force", type="contact force"),
              energies("kinetic energy", "stored energy", "contact work", "friction"), named("energy error", type="energy error", against="mechanical"))]


class DiscBalance:
    """Angular momentum about the centre of mass of disc_on_floor(). What is free in the first step has all of its momenta there.

    The centre of mass moves by the integral of momentum over mass. Its angular momentum changes by that of the friction forces, whose arm is its height
    over the floor, and by that of the pressures, whose arm is their distance ahead of it.
    """

    def __init__(self, columns, across, along):
        times, momenta = [0.0] + columns["time"], [[columns[f"momentum {c}"][0]] + columns[f"momentum {c}"] for c in "xy"]
        impulses = [[0.0] + columns[f"impulse {c}"] for c in "xy"]
        assert max(abs(impulses[i][2]) for i in (0, 1)) == 0, "the disc has to be free in its first steps"
        mass, height = -momenta[1][0] / across, 1.0 + 2.5 * times[1] * across
        centre, self.about, self.centres, of_friction = [0.0, 0.0], [], [0.0], 0.0
        for k in range(1, len(times)):
            step, before = times[k] - times[k - 1], list(centre)
            for i in (0, 1):
                centre[i] += step * 0.5 * (momenta[i][k - 1] + momenta[i][k]) / mass
            self.centres.append(centre[0])
            self.about.append(columns["angular momentum"][k - 1] - centre[0] * momenta[1][k] + centre[1] * momenta[0][k])
            of_friction += (height + 0.5 * (before[1] + centre[1])) * (impulses[0][k] - impulses[0][k - 1])
        along_floor, self.normal = impulses[0][-1], impulses[1][-1]
        self.share = abs(along_floor) / self.normal
        # shares of R J_t: all of the change, that of friction, that of the pressures; how far pressures act ahead of the centre in the mean
        self.change = (self.about[-1] - self.about[0]) / along_floor
        self.friction = of_friction / along_floor
        self.pressure = self.change - self.friction
        self.ahead = self.pressure * along_floor / self.normal
        # after the impact it should not change
        last = self.about[-len(self.about) // 5:]
        self.drift = (max(last) - min(last)) / abs(along_floor)

    def ahead_by_profiles(self, path):
        """The same distance from the pressures at the nodes, which are constant over a step, and the nodes' places in the middle of it."""
        with open(path, encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        nodes = len(rows) // (len(self.centres) - 1)
        states = [[(float(row["x"]), float(row["y"]), float(row["pressure"])) for row in rows[k:k + nodes]] for k in range(0, len(rows), nodes)]
        force = moment = 0.0
        for k in range(1, len(states)):
            for i, (x, y, pressure) in enumerate(states[k]):
                beside = [states[k][(i + turn) % nodes] for turn in (-1, 1)]
                share = pressure * 0.5 * sum(math.hypot(x - other[0], y - other[1]) for other in beside)
                force += share
                moment += share * 0.5 * (x + states[k - 1][i][0] - self.centres[k] - self.centres[k + 1])
        return moment / force


def one_layer():
    """A body of one layer, all of whose nodes lie on contact surfaces, before one that moves until t = 0.5 and stops there."""
    return [
        '<Parameter name="kinematics" type="string" value="plane strain"/>', named("materials", material("elastic", 1.0, 1.0)),
        named("bodies", block(2, "layer", "elastic", 0.2, 1.5, 1, 1), block(2, "mover", "elastic", 1.0, 0.0, 4, 1)),
        named("boundary conditions", named("mover", set="mover/left", x="min(t, 0.5)", y=0.0)),
        named("inertia", scheme="generalised alpha"),
        named("contact", named("front", slave="layer/left", master="mover/right"), named("back", slave="layer/right", master="mover/top")),
        named("stepping", end_time=0.8, step=0.04), named("output", fields="", every_step=0)]


def vibrating_bar(steps, balance, radius, cells=10, end=2.5):
    """A bar of E = rho = L = 1 that is held at the left vibrates in its first mode, which the mesh has too: see frequency_of_bar()."""
    return [
        '<Parameter name="kinematics" type="string" value="plane strain"/>', named("materials", material("elastic", 1.0, 1.0)),
        named("bodies", block(2, "bar", "elastic", 1.0, 0.0, cells, 1)),
        named("boundary conditions", named("wall", set="bar/left", x=0.0, y=0.0)),
        named("inertia", **{"scheme": "generalised alpha", "balance": balance, "spectral radius": radius}),
        named("initial conditions", named("throw", body="bar", velocity_x="0.01*sin(pi*x/2)")),
        named("stepping", end_time=end, step=end / steps), named("output", fields="", every_step=0),
        named("quantities", named("end", type="displacement", x=1.0, y=0.5, component="x"))]


def frequency_of_bar(cells=10):
    """Linear elements with consistent mass have sin(k x) as a mode, w^2 = 6 (1 - cos(k h)) / (h^2 (2 + cos(k h)))."""
    h = 1.0 / cells
    turn = math.cos(math.pi / 2 * h)
    return math.sqrt(6 * (1 - turn) / (2 + turn)) / h


def pressed_bar(balance, density, steps, end=4.0, cells=10, radius=0.8):
    """A bar of E = 1 on a rigid wall, pressed by 0.01 from the start on, which goes down by a fifth and up again smoothly, so that contact lasts."""
    return [
        '<Parameter name="kinematics" type="string" value="plane strain"/>', named("materials", material("elastic", 1.0, density)),
        named("bodies", block(2, "bar", "elastic", 1.0, 0.0, cells, 1),
              named("wall", named("mesh", type="block", width=0.5, height=2.0, cells_x=1, cells_y=1, translation=numbers(-0.5, -0.5)), rigid=True)),
        named("boundary conditions", named("wall", set="wall/reference", x=0.0, y=0.0, rotation=0.0)),
        named("loads", named("push", type="dead traction", set="bar/right", x="-0.01*(1 - 0.2*sin(pi*t/2)^4)")),
        named("initial conditions", named("pressed", body="bar", displacement_x="-0.01*x")),
        named("inertia", **{"scheme": "generalised alpha", "balance": balance, "spectral radius": radius}),
        named("contact", named("wall", slave="bar/left", master="wall/right", geometry="reference")),
        named("stepping", end_time=end, step=end / steps), named("output", fields="", every_step=0),
        named("quantities", named("end", type="displacement", x=1.0, y=0.5, component="x"), named("force", type="contact force", component="x"),
              energies("kinetic energy", "stored energy"))]


def from_static(ends, end=4.0):
    """Largest distance of the end of pressed_bar() from its static place, over the largest displacement."""
    return max(abs(place + 0.01 * (1 - 0.2 * math.sin(math.pi / 2 * end * (k + 1) / len(ends)) ** 4)) for k, place in enumerate(ends)) / 0.01
