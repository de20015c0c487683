# What the runs of the paper left, read once and asked for by name. argument: the directory of `mortise paper`
import csv
import json
import os

import numpy as np

directory = sys.argv[1]
POLYLINE, NODES = 2, {4: 3, 5: 4}  # XDMF's numbers: a polyline, whose number of nodes follows; triangle and quadrilateral
TENSOR = ("xx", "xy", "xz", "yy", "yz", "zz")


def numbers(text):
    return float(text) if text else float("nan")


def table(path):
    """Columns of a CSV file as arrays; a column that holds text is left out."""
    with open(path, encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    columns = {}
    for name in rows[0] if rows else ():
        try:
            columns[name] = np.array([numbers(row[name]) for row in rows])
        except ValueError:
            pass
    return columns


class Fields:
    """The last written step of fields.h5."""

    def __init__(self, path):
        with h5py.File(path) as file:
            last = max(file["steps"], key=int)
            self.values = {name: data[:] for name, data in file["steps"][last].items()}
            self.reference = file["mesh/coordinates"][:, :2]
            self.body = file["mesh/body"][:]
            topology = file["mesh/topology"][:]
        self.cells, at = [], 0
        while at < len(topology):
            kind = int(topology[at])
            at += 2 if kind == POLYLINE else 1
            count = int(topology[at - 1]) if kind == POLYLINE else NODES[kind]
            self.cells.append(topology[at : at + count])
            at += count
        # Profiles of rigid bodies are lines; all others have an inside.
        self.inside = np.array([len(cell) > 2 for cell in self.cells])
        self.displacement = self.values["displacement"][:, :2]
        self.position = self.reference + self.displacement

    def von_mises(self):
        s = dict(zip(TENSOR, self.values["cauchy_stress"].T))
        pairs = (s["xx"] - s["yy"]) ** 2 + (s["yy"] - s["zz"]) ** 2 + (s["zz"] - s["xx"]) ** 2
        return np.sqrt(0.5 * pairs + 3 * (s["xy"] ** 2 + s["xz"] ** 2 + s["yz"] ** 2))

    def nodes_of(self, body):
        return np.unique(np.concatenate([self.cells[e] for e in np.flatnonzero(self.body == body)]))

    def contact(self):
        """x, pressure and shear of the slave nodes by their current x: all others have neither a pressure nor a gap."""
        pressure, gap = self.values["contact_pressure"].ravel(), self.values["gap"].ravel()
        slave = np.flatnonzero((pressure != 0) | (gap != 0))
        slave = slave[np.argsort(self.position[slave, 0], kind="stable")]
        return self.position[slave, 0], pressure[slave], self.values["contact_shear"].ravel()[slave]


class Run:
    """One run: how it ended, and what it left if it left anything."""

    def __init__(self, record):
        identity = record["identity"]
        self.name, self.scene, self.settings = identity["name"], identity["scene"], identity["settings"]
        self.exit, self.said = record["exit"], record["said"]
        self.seconds, self.reused = record["seconds"], record["reused"]
        self.path = os.path.join(directory, self.name)
        self.summary = {}
        if os.path.isfile(self.file("summary.json")):
            with open(self.file("summary.json"), encoding="utf-8") as file:
                self.summary = json.load(file)
        # A run that stopped on its way has results of another state than the paper's.
        self.complete = bool(self.summary.get("converged"))
        self.loaded = {}

    def file(self, name):
        return os.path.join(self.path, name)

    def once(self, name, read):
        if name not in self.loaded:
            self.loaded[name] = read(self.file(name))
        return self.loaded[name]

    @property
    def history(self):
        return self.once("history.csv", table)

    @property
    def newton(self):
        return self.once("newton.csv", table)

    @property
    def fields(self):
        return self.once("fields.h5", Fields)

    def quantity(self, name):
        """The value at the end; None if the scene has no such quantity or it has no value."""
        return self.summary.get("quantities", {}).get(name)

    def iterations(self):
        return [len(step["newton"]) - 1 for step in self.summary.get("steps", [])]

    def residuals(self, time):
        """Relative momentum residuals of the iterations 0 (before the first), 1, ... of the step that ended at `time`, of its last try. The table has 0
        for what may be round-off: there the absolute one is taken over the force that the last other one is relative to."""
        n = self.newton
        ends = np.isclose(n["time"], time, rtol=0, atol=1e-9)
        if not ends.any():
            return []
        rows = ends & (n["try"] == n["try"][ends].max())
        relative, absolute = n["momentum"][rows], n["momentum_absolute"][rows]
        known = np.flatnonzero(relative > 0)
        if len(known) == 0:
            return list(relative)
        return list(np.where(relative > 0, relative, absolute * relative[known[-1]] / absolute[known[-1]]))


with open(os.path.join(directory, "paper.json"), encoding="utf-8") as file:
    record = json.load(file)
runs = {one["identity"]["name"]: Run(one) for one in record["runs"]}


RIVAL = "_node_to_segment"


def rivals(*names):
    """The same runs with nodes on segments, as far as they left results; they may have stopped on their way."""
    return [runs[name + RIVAL] for name in names if name + RIVAL in runs and os.path.isfile(runs[name + RIVAL].file("fields.h5"))]


def complete(*names):
    """Those of the named runs that were asked for and came to their end."""
    return [runs[name] for name in names if name in runs and runs[name].complete]
