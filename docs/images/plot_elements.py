#!/usr/bin/python3
"""Runs Cook's membrane and the necking bar with each element and draws what comes out: docs/images/elements.png.

usage: docs/images/plot_elements.py MORTISE_PROGRAM      from the repository's root; needs python3-matplotlib
"""
import csv
import json
import os
import subprocess
import sys
import tempfile

sys.path.insert(0, "packages/studies/plots")
from style import panels, save

ELEMENTS = ["Q4 F-bar", "Q4", "T3"]
SIZES = [4, 8, 16, 32, 64]


def run(program, scene, settings, directory):
    words = [program, "run", scene, "-o", directory, "--set", "output/fields="]
    for setting in settings:
        words += ["--set", setting]
    ended = subprocess.run(words, stdout=subprocess.DEVNULL, check=False).returncode
    if ended not in (0, 4):  # 4: a check is missed, as elements that lock do
        sys.exit(f"{' '.join(words)} ended with {ended}")


def main(program):
    figure, axes = panels(2, "Plastic flow and the elements")
    with tempfile.TemporaryDirectory() as directory:
        for element in ELEMENTS:
            corners = []
            for size in SIZES:
                run(program, "inputs/verification/cook_plastic.xml", [f"variables/n={size}", f"bodies/membrane/element={element}"], directory)
                with open(os.path.join(directory, "summary.json"), encoding="utf-8") as file:
                    corners.append(json.load(file)["quantities"]["corner_uy"])
            print(element, "corner_uy", dict(zip(SIZES, corners)))
            axes[0].semilogx(SIZES, corners, marker="o", markersize=3, base=2, label=element)
            run(program, "inputs/verification/necking.xml", [f"bodies/bar/element={element}"], directory)
            with open(os.path.join(directory, "history.csv"), encoding="utf-8") as file:
                rows = list(csv.DictReader(file))
            print(element, "force_max", rows[-1]["force_max"], "neck_radius_ratio", rows[-1]["neck_radius_ratio"])
            axes[1].plot([float(row["pull"]) for row in rows], [float(row["force"]) for row in rows], label=element)
    axes[0].set_xticks(SIZES, [str(size) for size in SIZES])
    axes[0].set_xlabel("elements along a side")
    axes[0].set_ylabel("Cook's membrane: corner $u_y$ / mm")
    axes[0].legend()
    axes[1].set_xlabel("pull of half the bar / mm")
    axes[1].set_ylabel("necking bar: force / kN")
    save(figure, "docs/images/elements")


if len(sys.argv) != 2:
    sys.exit(__doc__)
main(sys.argv[1])
