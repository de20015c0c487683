"""Multigrid of displacements and temperatures: iterations do not grow with the mesh, whatever surfaces conduct.

usage: hot_blocks_test.py MORTISE SCENE DIRECTORY

An iteration of multigrid solves as large a share of any mesh. A bound of 1.5 on the growth from n = 8 to 16 is far below that of GMRES by itself, whose
iterations are in proportion to n.
"""
import json
import os
import subprocess
import sys


def iterations(mortise, scene, directory, n, conductance):
    """Iterations of GMRES to 1e-10 for each matrix, and the summary."""
    results = os.path.join(directory, f"{n}_{conductance}")
    settings = {"variables/n": n, "variables/conductance": conductance, "linear solver/type": "iterative", "linear solver/largest tolerance": 1e-10,
                "output/fields": ""}
    command = [mortise, "run", scene, "-o", results]
    for path, value in settings.items():
        command += ["--set", f"{path}={value}"]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL, timeout=300)
    with open(os.path.join(results, "summary.json")) as file:
        summary = json.load(file)
    counts = [iteration["linear_iterations"] for step in summary["steps"] for iteration in step["newton"]]
    return sum(counts) / sum(count > 0 for count in counts)


def main():
    mortise, scene, directory = sys.argv[1:4]
    failed = False
    for conductance in (1e-3, 1, 1e5):
        coarse, fine = (iterations(mortise, scene, directory, n, conductance) for n in (8, 16))
        good = fine <= 1.5 * coarse
        failed = failed or not good
        print(f"{'' if good else 'FAILED: '}conductance {conductance:g}: {coarse:.1f} iterations with n = 8, {fine:.1f} with n = 16")
    sys.exit(1 if failed else 0)


main()
