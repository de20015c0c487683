"""Runs that are killed, and go on: nothing that was done before the last checkpoint is lost, and the end is that of a run in one piece.

Arguments: mpirun, the program, a scene, a directory for results; then, for more than the few kills of the test, --moments N --writes N.
Exit code 69 without strace, which kills at single writes.
"""
import argparse
import glob
import os
import random
import shutil
import signal
import subprocess
import sys
import time

from run_files import checkpoints, rows, same

parser = argparse.ArgumentParser()
for name in ("mpirun", "program", "scene", "scratch"):
    parser.add_argument(name)
parser.add_argument("--moments", type=int, default=8)
parser.add_argument("--writes", type=int, default=16)
arguments = parser.parse_args()
if shutil.which("strace") is None:
    sys.exit(69)
random.seed(1)


def command(results, ranks=1, *more):
    first = [arguments.mpirun, "-n", str(ranks)] if ranks > 1 else []
    return [*first, arguments.program, "run", arguments.scene, "-o", results, "--set", "output/checkpoints/every step=1", *more]


straight = os.path.join(arguments.scratch, "straight")
shutil.rmtree(arguments.scratch, ignore_errors=True)
os.makedirs(arguments.scratch)
begin = time.monotonic()
subprocess.run(command(straight), check=True, stdout=subprocess.DEVNULL, timeout=300)
duration = time.monotonic() - begin
wrong, lost_most, without_checkpoint, inside = [], 0, 0, 0


def recover(name, results, ranks):
    """Goes on with a run that was killed, and compares."""
    global lost_most, without_checkpoint, inside
    done, left = rows(results), checkpoints(results)
    inside += bool(glob.glob(os.path.join(results, "checkpoints", "*.part")))
    if left:
        step = left[-1]
        lost_most = max(lost_most, len(done) - step)
        if len(done) - step > 1 or step > len(done):
            wrong.append(f"{name}: {len(done)} steps were done, the checkpoint is of step {step}")
    else:
        without_checkpoint += 1
        if len(done) > 1:
            wrong.append(f"{name}: {len(done)} steps were done, there is no checkpoint")
    ending = subprocess.run(command(results, ranks, *(["--restart"] if left else [])), capture_output=True, text=True, timeout=300, check=False)
    if ending.returncode != 0:
        wrong.append(f"{name}: the restart ended with {ending.returncode}: {ending.stdout[-300:]}{ending.stderr[-300:]}")
    elif not same(straight, results):
        wrong.append(f"{name}: the end is another")
    elif len(glob.glob(os.path.join(results, "fields", "step-*.h5"))) != len(glob.glob(os.path.join(straight, "fields", "step-*.h5"))):
        wrong.append(f"{name}: fields are missing")


for number in range(arguments.moments):
    results, ranks = os.path.join(arguments.scratch, "moment"), 2 if number % 4 == 3 else 1
    shutil.rmtree(results, ignore_errors=True)
    process = subprocess.Popen(command(results, ranks), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)
    time.sleep(random.uniform(0.1, 1.0) * duration * ranks)
    if ranks > 1:  # one of the ranks: mpirun ends the other
        subprocess.run(["pkill", "-KILL", "-n", "-P", str(process.pid)], check=False)
    else:
        os.killpg(process.pid, signal.SIGKILL)
    process.wait()
    recover(f"moment {number}", results, ranks)

counted = os.path.join(arguments.scratch, "counted")
trace = os.path.join(arguments.scratch, "trace")
subprocess.run(["strace", "-f", "-e", "trace=pwrite64", "-o", trace, *command(counted)], check=True, stdout=subprocess.DEVNULL, timeout=600)
with open(trace, encoding="utf-8") as file:
    writes = sum("pwrite64(" in line for line in file)
for number in range(arguments.writes):
    results, when = os.path.join(arguments.scratch, "write"), 1 + number * (writes - 1) // max(1, arguments.writes - 1)
    shutil.rmtree(results, ignore_errors=True)
    subprocess.run(["strace", "-f", "-e", "trace=none", "-e", f"inject=pwrite64:signal=KILL:when={when}", "-o", "/dev/null", *command(results)],
                   check=False, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, timeout=600)
    recover(f"write {when} of {writes}", results, 1)

print(f"{arguments.moments} kills at random moments (a quarter of them of one of two ranks), {arguments.writes} at single writes of {writes}: "
      f"{len(wrong)} not recovered; at most {lost_most} steps after the last checkpoint; {without_checkpoint} before the first one; "
      f"{inside} within a checkpoint")
print("\n".join(wrong))
sys.exit(1 if wrong else 0)
