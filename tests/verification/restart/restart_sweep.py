"""Restarts of every shipped scene: cut at a third and at two thirds of its steps, each has to come to the end of the run in one piece.

python3 restart_sweep.py PROGRAM INPUTS SCRATCH [PATTERN]

Scenes that take longer than a minute are left out, and said to be. Fails for a difference above 1e-9 of a quantity's scale, other Newton iterations
or another exit code.
"""
import glob
import os
import shutil
import subprocess
import sys

from run_files import rows, worst_difference

program, inputs, scratch = sys.argv[1:4]
pattern = sys.argv[4] if len(sys.argv) > 4 else ""
# Sizes at which scenes whose defaults are those of a result take seconds.
SMALLER = {
    "hertz_elastic": ["variables/n=2", "variables/steps=4"], "hertz_plastic": ["variables/n=2", "variables/steps=10"],
    "hertz_elastic_as_printed": ["variables/n=2", "variables/steps=4"], "conical_extrusion": ["variables/steps=20", "stepping/end time=0.2"],
    "hertz_whole": ["variables/n=2", "variables/steps=4"], "cb1": ["variables/steps=4"], "block_pile_axisymmetric": ["variables/steps=20"],
    "patch_test_plastic": ["variables/steps=10"], "3d/sphere_indentation": ["variables/n=2", "variables/depth=0.1"],
    "3d/square_billet": ["variables/n=4"], "3d/ironing": ["variables/n=1"], "rolling_disk": ["variables/n=3"], "partial_slip": ["variables/n=8"]}


def run(scene, settings, results, *more):
    options = [word for setting in (*settings, "output/checkpoints/every step=1", "output/checkpoints/keep=1000") for word in ("--set", setting)]
    return subprocess.run([program, "run", scene, "-o", results, "--quiet", *options, *more], capture_output=True, text=True, timeout=60, check=False)


failed = 0
for scene in sorted(glob.glob(os.path.join(inputs, "**", "*.xml"), recursive=True)):
    name = os.path.relpath(scene, inputs)[:-len(".xml")]
    kind = name.split(os.sep)[0]
    if kind == "studies" or os.path.basename(name).startswith("point_") or name.endswith("ledger") or pattern not in name:
        continue
    settings = SMALLER.get(name.split(os.sep, 1)[1], [])
    straight, cut = os.path.join(scratch, "straight"), os.path.join(scratch, "cut")
    shutil.rmtree(straight, ignore_errors=True)
    try:
        whole = run(scene, settings, straight)
        steps = len(rows(straight))
        if steps < 2:
            print(f"{name}: {steps} steps, nothing to cut", flush=True)
            continue
        for step in sorted({max(1, steps // 3), max(1, 2 * steps // 3)}):
            shutil.rmtree(cut, ignore_errors=True)
            shutil.copytree(straight, cut)
            rest = run(scene, settings, cut, "--restart", str(step))
            worst, where = worst_difference(straight, cut)
            good = rest.returncode == whole.returncode and worst <= 1e-9
            failed += not good
            print(f"{name}: step {step} of {steps}, exit {whole.returncode}: {'' if good else f'WRONG, exit {rest.returncode}, '}{worst:.1e} {where}",
                  flush=True)
    except subprocess.TimeoutExpired:
        print(f"{name}: takes too long", flush=True)
sys.exit(1 if failed else 0)
