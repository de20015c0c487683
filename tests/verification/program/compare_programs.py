"""Runs scenes by two programs in turn: are their results equal in every bit, and how many user seconds does each take? A table in Markdown.

usage: compare_programs.py BASE CURRENT INPUTS DIRECTORY RANKS REPEATS scene ...

Scenes are paths below INPUTS. Compared are the exit code, history.csv, newton.csv without its times, the fields, and of summary.json quantities, steps,
calls and bytes. A program whose repeats differ among themselves does not repeat: then nothing is said of equality. Seconds are the least of the
repeats. Exit code 1: something differs.
"""
import csv
import glob
import hashlib
import json
import os
import resource
import shutil
import subprocess
import sys


def content(path):
    with open(path, "rb") as file:
        return hashlib.sha256(file.read()).hexdigest()


def iterations(path):
    with open(path, newline="") as file:
        return [[value for title, value in row.items() if title != "seconds"] for row in csv.DictReader(file)]


def record(results, code):
    """Name -> what is compared."""
    found = {"exit": code}
    if os.path.exists(os.path.join(results, "summary.json")):
        with open(os.path.join(results, "summary.json")) as file:
            summary = json.load(file)
        found.update((name, summary[name]) for name in ("quantities", "steps", "calls", "bytes"))
        found["history.csv"] = content(os.path.join(results, "history.csv"))
        found["newton.csv"] = iterations(os.path.join(results, "newton.csv"))
    found["fields"] = {os.path.basename(path): content(path) for path in sorted(glob.glob(os.path.join(results, "fields", "*.h5")))}
    return found


def user_seconds():
    return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime


def run(program, scene, results, ranks):
    """What is compared, and user seconds."""
    shutil.rmtree(results, ignore_errors=True)
    launch = ["mpirun", "-n", str(ranks)] if ranks > 1 else []
    before = user_seconds()
    done = subprocess.run(launch + [program, "run", scene, "-o", results, "--quiet"], capture_output=True, text=True)
    return record(results, done.returncode), user_seconds() - before


def compare(programs, scene, directory, ranks, repeats):
    """Row of the table but for its name, whether something differs, and the seconds of both."""
    records, seconds = ([], []), ([], [])
    for _ in range(repeats):
        for i, program in enumerate(programs):
            found, user = run(program, scene, os.path.join(directory, ("base", "current")[i], scene.replace(os.sep, "_")), ranks)
            records[i].append(found)
            seconds[i].append(user)
    base, current = records[0][0], records[1][0]
    differing = [name for name in sorted(base.keys() | current.keys()) if base.get(name) != current.get(name)]
    if not all(found == of_program[0] for of_program in records for found in of_program):
        result, differing = "does not repeat", []
    else:
        result = "equal" if not differing else "differ: " + ", ".join(differing)
    steps = current.get("steps", [])
    counts = f"{len(steps)} | {sum(len(step['newton']) - step['solves'] for step in steps)}"
    least = [min(of_program) for of_program in seconds]
    return f"{current['exit']} | {counts} | {result} | {least[0]:.2f} | {least[1]:.2f} | {least[1] / least[0]:.3f}", bool(differing), least


def main():
    base, current, inputs, directory, ranks, repeats, *scenes = sys.argv[1:]
    differences, sums = 0, [0.0, 0.0]
    print("| scene | exit | steps | Newton iterations | results | base, s | current, s | ratio |\n|---|---|---|---|---|---|---|---|")
    for scene in scenes:
        row, differs, seconds = compare((base, current), os.path.join(inputs, scene), directory, int(ranks), int(repeats))
        differences += differs
        sums = [total + user for total, user in zip(sums, seconds)]
        print(f"| `{os.path.splitext(scene)[0]}` | {row} |", flush=True)
    print(f"| all {len(scenes)} | | | | {differences} differ | {sums[0]:.2f} | {sums[1]:.2f} | {sums[1] / sums[0]:.3f} |")
    return differences > 0


sys.exit(main())
