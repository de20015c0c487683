# Results of the runs of the paper, read once and asked for by name. argument: the directory of `mortise paper`
import csv
import json
import os

import numpy as np

directory = sys.argv[1]


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


FILES = 5  # exit code: nothing could be written, and what is there is of another run


class Run:
    """One run: how it ended, and what it left if it left anything."""

    def __init__(self, record):
        identity = record["identity"]
        self.name, self.scene, self.settings = identity["name"], identity["scene"], identity["settings"]
        self.exit, self.said = record["exit"], record["said"]
        self.seconds, self.reused = record["seconds"], record["reused"]
        self.misses = record["misses"]  # why it is expected to miss checks
        self.path = os.path.join(directory, self.name)
        self.summary = {}
        if self.exit != FILES and os.path.isfile(self.file("summary.json")):
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
        return self.once("", Fields)

    def quantity(self, name):
        """The value at the end; None if the scene has no such quantity or it has no value."""
        return self.summary.get("quantities", {}).get(name)

    def iterations(self):
        return [len(step["newton"]) - step.get("solves", 1) for step in self.summary.get("steps", [])]

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
    """The runs with nodes on segments, as far as they left results; they may have stopped on their way."""
    asked = [runs[name + RIVAL] for name in names if name + RIVAL in runs]
    return [run for run in asked if run.exit != FILES and last_step_file(run.path)]


def complete(*names):
    """Those of the named runs that were asked for and came to their end."""
    return [runs[name] for name in names if name in runs and runs[name].complete]
