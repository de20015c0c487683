"""What heat costs: Newton iterations and user seconds of each scene of inputs/heat, as a table in Markdown: fields together, in turn, without heat.

usage: heat_costs.py MORTISE INPUTS DIRECTORY [scene ...]

Without heat a scene has no temperatures and no properties, laws and loads that need one. Quantities, checks and fields are left out of these runs.
Seconds are the least of three runs, which alternate. No step is hard (`easy iterations`): all runs double their steps alike. Both solutions of a
scene with heat are compared by runs of their own with quantities, over the largest value that a quantity has in the run. They have the same steps, as
the error of a step depends on its length.
"""
import csv
import json
import math
import os
import resource
import subprocess
import sys
from dataclasses import dataclass
from xml.etree import ElementTree


def child(element, name):
    return next((entry for entry in element if entry.get("name") == name), None)


def remove(element, *names):
    for entry in [entry for entry in element if entry.get("name") in names]:
        element.remove(entry)


def entries(scene, name):
    found = child(scene, name)
    return [] if found is None else list(found)


def bare(path):
    """The scene without what it puts out."""
    scene = ElementTree.parse(path).getroot()
    remove(scene, "quantities", "checks", "output")
    output = ElementTree.SubElement(scene, "ParameterList", name="output")
    ElementTree.SubElement(output, "Parameter", name="fields", type="string", value="")
    return scene


def without_heat(scene):
    remove(scene, "heat")
    for material in entries(scene, "materials"):
        remove(material, "heat", "thermomechanics")
    for pair in entries(scene, "contact"):
        remove(pair, "heat")
    for body in entries(scene, "bodies"):
        remove(body, "temperature")
    return scene


def user_seconds():
    return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime


STEPS_ALIKE = "stepping/easy iterations=1000"
IN_TURN = "newton/fields=staggered"


@dataclass
class Cost:
    """Of a run; `reason` says why it has not come to its end."""
    times: list  # ends of steps
    iterations: list  # [step]
    turns: int  # solves of the first field, of fields in turn
    seconds: float
    reason: str = ""

    @property
    def steps(self):
        return len(self.times)

    def total(self):
        return self.reason or str(sum(self.iterations))


def execute(mortise, results, path, *settings):
    """Exit code, summary and user seconds of a run."""
    before = user_seconds()
    arguments = [argument for setting in (STEPS_ALIKE, *settings) for argument in ("--set", setting)]
    done = subprocess.run([mortise, "run", path, "-o", results, *arguments], capture_output=True, text=True)
    seconds = user_seconds() - before
    if not os.path.exists(os.path.join(results, "summary.json")):
        raise SystemExit(f"{path}: exit {done.returncode}: {done.stderr}")
    with open(os.path.join(results, "summary.json")) as file:
        return done.returncode, json.load(file), seconds


def cost(mortise, directory, name, scene, *settings):
    path = os.path.join(directory, name + ".xml")
    ElementTree.ElementTree(scene).write(path)
    code, summary, seconds = execute(mortise, os.path.join(directory, name), path, *settings)
    steps = summary["steps"]
    reason = "" if code == 0 else f"exit {code} after {len(steps)} steps: {summary['reason']}"
    iterations, solves = [len(step["newton"]) - step["solves"] for step in steps], [step["solves"] for step in steps]
    return Cost([step["time"] for step in steps], iterations, sum(solves) // 2, seconds, reason)


def history(results):
    """Quantity -> its values after each step."""
    with open(os.path.join(results, "history.csv")) as file:
        rows = list(csv.DictReader(file))
    return {name: [float(row[name]) for row in rows] for name in list(rows[0])[3:]}


def run_at_times(mortise, results, path, times, *settings):
    """Ends of the steps of a run that stops at times; none if it fails."""
    if times:
        settings += ("stepping/output times=" + ", ".join(times),)
    code, summary, _ = execute(mortise, results, path, *settings)
    return [f"{step['time']:.12g}" for step in summary["steps"]][:-1] if code in (0, 4) else None


def difference(mortise, directory, name, path):
    """Largest difference of a quantity at the end, and which; those that are round-off of something else do not count."""
    kinds = {quantity.get("name"): child(quantity, "type").get("value") for quantity in entries(ElementTree.parse(path).getroot(), "quantities")}
    together, in_turn = (os.path.join(directory, name + ending) for ending in ("_values", "_values_in_turn"))
    times = []
    for _ in range(3):
        steps = run_at_times(mortise, together, path, times)
        times = run_at_times(mortise, in_turn, path, steps, IN_TURN)
        if times is None or times == steps:
            break
    if times is None or times != steps:
        return "-"
    exact, other, worst = history(together), history(in_turn), (0.0, "all")
    for quantity, values in exact.items():
        largest = max((abs(value) for value in values if math.isfinite(value)), default=0.0)
        if largest > 0.0 and math.isfinite(values[-1]) and kinds[quantity] not in ("heat balance", "momentum imbalance", "formula"):
            worst = max(worst, (abs(values[-1] - other[quantity][-1]) / largest, quantity))
    return f"{worst[0]:.0e}, {worst[1]}"


def main():
    mortise, inputs, directory, *names = sys.argv[1:]
    os.makedirs(directory, exist_ok=True)
    folder = os.path.join(inputs, "heat")
    print("| scene | steps | Newton iterations | in turn | turns | without heat | most above it in a step, steps with more than one | user seconds | in turn "
          "| without heat | in turn differs by |\n|" + "---|" * 11)
    for name in names or sorted(os.path.splitext(file)[0] for file in os.listdir(folder) if file.endswith(".xml")):
        path = os.path.join(folder, name + ".xml")
        runs = [(cost(mortise, directory, name, bare(path)), cost(mortise, directory, name + "_in_turn", bare(path), IN_TURN),
                 cost(mortise, directory, name + "_without", without_heat(bare(path)))) for _ in range(3)]
        together, in_turn, without = runs[0]
        seconds = " | ".join(f"{min(run[i].seconds for run in runs):.2f}" for i in range(3))
        alike = together.steps == without.steps
        above = [a - b for a, b in zip(together.iterations, without.iterations)]
        most = f"{max(above)}, {sum(one > 1 for one in above)} of {together.steps}" if alike else "-"
        in_steps = "" if alike else f" in {without.steps} steps"
        in_turn_steps = "" if in_turn.steps == together.steps or in_turn.reason else f" in {in_turn.steps} steps"
        print(f"| `{name}` | {together.steps} | {together.total()} | {in_turn.total()}{in_turn_steps} | {in_turn.turns} | {without.total()}{in_steps} | "
              f"{most} | {seconds} | {difference(mortise, directory, name, path)} |", flush=True)


main()
