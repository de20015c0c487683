"""Scenes that a test writes, runs of them, and what is wrong with their results."""
import json
import os
import shutil
import subprocess
import sys


def parameter(name, value):
    kind = {bool: "bool", int: "int", float: "double", str: "string"}[type(value)]
    return f'<Parameter name="{name}" type="{kind}" value="{str(value).lower() if kind == "bool" else value}"/>'


def named(name, *content, **parameters):
    """A list of parameters, whose names have _ for spaces, and of other lists."""
    return f'<ParameterList name="{name}">' + "".join(parameter(key.replace("_", " "), value) for key, value in parameters.items()) + "".join(content) + "</ParameterList>"


def numbers(*values):
    return ", ".join(f"{value:.17g}" for value in values)


class Bench:
    """Runs scenes in a directory of its own, which it empties, and collects faults."""

    def __init__(self, mpirun, mortise, directory):
        self.mpirun, self.mortise, self.directory = mpirun, os.path.abspath(mortise), os.path.abspath(directory)
        self.faults = []
        shutil.rmtree(self.directory, ignore_errors=True)
        os.makedirs(self.directory)

    def call(self, name, content, ranks=1, arguments=(), command="run"):
        """Writes a scene and calls the program: exit code, what it said, and the quantities of a run that succeeded, or None."""
        scene = os.path.join(self.directory, name + ".xml")
        with open(scene, "w", encoding="utf-8") as file:
            file.write(named(name, *content))
        output = os.path.join(self.directory, name)
        launched = [self.mpirun, "-n", str(ranks)] if ranks > 1 else []
        done = subprocess.run(launched + [self.mortise, command, scene, "-o", output, *arguments], capture_output=True, text=True)
        quantities = None
        if command == "run" and done.returncode == 0:
            with open(os.path.join(output, "summary.json"), encoding="utf-8") as file:
                quantities = json.load(file)["quantities"]
        return done.returncode, done.stdout + done.stderr, quantities

    def run(self, name, content, ranks=1, arguments=()):
        """The quantities of a run, which has to succeed, or None."""
        code, said, quantities = self.call(name, content, ranks, ["--quiet", *arguments])
        self.expect(f"{name} on {ranks} rank(s) {' '.join(arguments)}", code == 0, f"exit code {code}: {said[-600:]}")
        return quantities

    def expect(self, name, is_so, what):
        if not is_so:
            self.faults.append(f"{name}: {what}")

    def equal(self, name, value, expected, tolerance, scale=None):
        """|value - expected| <= tolerance * scale, by default the size of what is expected."""
        size = abs(expected) if scale is None else scale
        self.expect(name, abs(value - expected) <= tolerance * size, f"{value!r} instead of {expected!r}, difference {abs(value - expected):.2e}, allowed {tolerance * size:.2e}")

    def end(self):
        for fault in self.faults:
            print(fault)
        sys.exit(1 if self.faults else 0)
