"""What heat costs: Newton iterations and user seconds of each scene of inputs/heat, with heat and without, as a table in Markdown.

usage: heat_costs.py MORTISE INPUTS DIRECTORY [scene ...]

Without heat a scene has no temperatures and no properties, laws and loads that need one. Quantities, checks and fields are left out of both runs.
"""
import json
import os
import resource
import subprocess
import sys
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


def cost(mortise, directory, name, scene):
    """Steps, Newton iterations and user seconds of a run."""
    path, results = os.path.join(directory, name + ".xml"), os.path.join(directory, name)
    ElementTree.ElementTree(scene).write(path)
    before = user_seconds()
    done = subprocess.run([mortise, "run", path, "-o", results], capture_output=True, text=True)
    seconds = user_seconds() - before
    if done.returncode != 0:
        raise SystemExit(f"{name}: exit {done.returncode}: {done.stdout.strip().splitlines()[-1:]} {done.stderr}")
    with open(os.path.join(results, "summary.json")) as file:
        steps = json.load(file)["steps"]
    return len(steps), sum(len(step["newton"]) - step["solves"] for step in steps), seconds


def main():
    mortise, inputs, directory, *names = sys.argv[1:]
    os.makedirs(directory, exist_ok=True)
    folder = os.path.join(inputs, "heat")
    print("| scene | steps | Newton iterations | without heat | user seconds | without heat |\n|---|---|---|---|---|---|")
    for name in names or sorted(os.path.splitext(file)[0] for file in os.listdir(folder) if file.endswith(".xml")):
        path = os.path.join(folder, name + ".xml")
        steps, iterations, seconds = cost(mortise, directory, name, bare(path))
        plain_steps, plain_iterations, plain_seconds = cost(mortise, directory, name + "_without", without_heat(bare(path)))
        in_steps = "" if plain_steps == steps else f" in {plain_steps} steps"
        print(f"| `{name}` | {steps} | {iterations} | {plain_iterations}{in_steps} | {seconds:.2f} | {plain_seconds:.2f} |", flush=True)


main()
