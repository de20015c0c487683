"""Scenes as nested dictionaries, and runs of them. Standard library only."""

import json
import os
import resource
import shutil
import signal
import subprocess
from xml.sax.saxutils import quoteattr


def parameter(name, value):
    kind = "bool" if isinstance(value, bool) else "int" if isinstance(value, int) else "double" if isinstance(value, float) else "string"
    text = str(value).lower() if isinstance(value, bool) else repr(value) if isinstance(value, float) else str(value)
    return f'<Parameter name={quoteattr(name)} type="{kind}" value={quoteattr(text)}/>'


def to_xml(name, content, depth=0):
    """A list of the scene: its dictionary's members are parameters, or lists where they are dictionaries."""
    pad = "  " * depth
    lines = [f"{pad}<ParameterList name={quoteattr(name)}>"]
    lines += [f"{pad}  {parameter(key, value)}" for key, value in content.items() if not isinstance(value, dict)]
    lines += [to_xml(key, value, depth + 1) for key, value in content.items() if isinstance(value, dict)]
    return "\n".join(lines + [f"{pad}</ParameterList>"])


def numbers(values):
    """Numbers as the scene's lists of them, with all their digits."""
    return ", ".join(repr(float(value)) for value in values)


class Result:
    """Outcome of a run: exit code, last message, quantities at the end."""

    def __init__(self, code, said, directory):
        self.code, self.said, self.quantities, self.steps = code, said, {}, 0
        try:
            with open(os.path.join(directory, "summary.json")) as file:
                summary = json.load(file)
            self.quantities, self.steps = summary["quantities"], len(summary["steps"])
        except (OSError, ValueError, KeyError):
            pass

    @property
    def ended(self):
        return self.code == 0

    @property
    def reason(self):
        lines = self.said.strip().splitlines()
        return lines[-1] if lines else ""

    def __getitem__(self, name):
        value = self.quantities.get(name)
        return float("nan") if value is None else value


def run(program, scene, directory, ranks=1, limit=60.0):
    """Writes the scene into the directory and runs it there. The limit is of processor time, for each rank, as other programs may keep the machine busy; of
    wall time it is twenty times that. Code -1: it did not end within the limit."""
    os.makedirs(directory, exist_ok=True)
    shutil.rmtree(os.path.join(directory, "run"), ignore_errors=True)
    path = os.path.join(directory, "scene.xml")
    with open(path, "w") as file:
        file.write(to_xml("random", scene) + "\n")
    command = [program, "run", path, "-o", os.path.join(directory, "run"), "--quiet"]
    if ranks > 1:
        command = ["mpirun", "-n", str(ranks)] + command
    seconds = int(limit)

    def bound():
        resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds + 5))

    try:
        ending = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=20 * seconds, preexec_fn=bound)
    except subprocess.TimeoutExpired:
        return Result(-1, f"did not end within {20 * seconds} s", directory + "/none")
    if ending.returncode == -signal.SIGXCPU:
        return Result(-1, f"did not end within {seconds} s of processor time", directory + "/none")
    return Result(ending.returncode, ending.stdout, os.path.join(directory, "run"))
