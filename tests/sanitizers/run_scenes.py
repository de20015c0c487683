#!/usr/bin/env python3
"""Runs the program over scenes that reach most of it, to be built with sanitizers. Standard library only.

    python3 -I tests/sanitizers/run_scenes.py --program build/asan/apps/mortise/mortise --ranks 2 [--only NAME] [-o DIR]

Accuracy is for other tests: a run may miss its checks. Exit code 1 if a run ends otherwise than it should, or if a sanitizer says anything.
"""

import argparse
import os
import shutil
import signal
import subprocess
import sys
import time

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
GOOD = (0, 4)  # done; a check was missed
SIGNS = ("AddressSanitizer", "LeakSanitizer", "runtime error:")
SECONDS = 1500

# name, command, file below inputs/, settings
RUNS = [
    ("friction", "run", "verification/sliding_block.xml", ["stepping/end time=0.2"]),
    ("plasticity", "run", "verification/cook_plastic.xml", ["variables/n=4"]),
    ("augmented_lagrange", "run", "tutorial/press_3_friction.xml", ["contact/interface/formulation/type=augmented lagrange", "stepping/end time=0.3"]),
    ("rigid_body", "run", "verification/rolling_disk.xml", ["variables/n=2", "stepping/end time=1.5"]),
    ("quadratic_facets", "run", "verification/patch_quadratic.xml", []),
    ("quadratic_facets_3d", "run", "verification/3d/patch_test_quadratic.xml", []),
    ("rigid_body_3d", "run", "verification/3d/punch.xml", ["variables/n=2", "stepping/end time=0.2"]),
    ("iterative", "run", "paper/hertz_elastic.xml", ["variables/n=1", "variables/steps=2", "linear solver/type=iterative"]),
    ("profiles", "run", "paper/hertz_elastic.xml", ["variables/n=1", "variables/steps=2", "output/contact profiles=true", "output/every step=1"]),
    ("plastic_contact", "run", "tutorial/press_4_plasticity.xml", ["stepping/end time=0.2"]),
    ("point", "point", "tutorial/point_cyclic.xml", ["path/steps=40"]),
]


class Runs:
    def __init__(self, arguments):
        self.arguments = arguments
        self.wrong = 0

    def start(self, command, file, settings, output, more=()):
        line = [self.arguments.program, command, os.path.join(ROOT, "inputs", file), "-o", output, *more]
        for setting in settings:
            line += ["--set", setting]
        if self.arguments.ranks > 1:
            line = ["mpirun", "-n", str(self.arguments.ranks), *line]
        return subprocess.Popen(line, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace")

    def finish(self, name, process, expected):
        """Waits for the run and reports it. True if it ended as it should."""
        start = time.time()
        try:
            text = process.communicate(timeout=SECONDS)[0]
        except subprocess.TimeoutExpired:
            process.kill()
            text = process.communicate()[0] + f"\nstopped after {SECONDS} s"
        signs = [sign for sign in SIGNS if sign in text]
        good = process.returncode in expected and not signs
        print(f"{'ok   ' if good else 'WRONG'} {name} ({time.time() - start:.0f} s)", flush=True)
        if not good:
            self.wrong += 1
            print(f"exit code {process.returncode}, expected one of {expected}\n{text[-20000:]}", flush=True)
        return good

    def scene(self, name, command, file, settings):
        output = self.directory(name)
        self.finish(name, self.start(command, file, settings, output), GOOD)

    def directory(self, name):
        output = os.path.join(self.arguments.output, f"{name}_np{self.arguments.ranks}")
        shutil.rmtree(output, ignore_errors=True)
        return output

    def signal_and_restart(self):
        """A run that is told to stop leaves a checkpoint, and goes on from it to its end."""
        file, output = "tutorial/press_4_plasticity.xml", self.directory("signal")
        short = ["stepping/end time=0.2", "stepping/step=0.02", "output/checkpoints/every step=1"]
        process = self.start("run", file, short, output)
        steps = os.path.join(output, "steps.jsonl")
        while process.poll() is None and not (os.path.exists(steps) and os.path.getsize(steps) > 0):
            time.sleep(0.05)
        process.send_signal(signal.SIGUSR1)  # mpirun hands it on
        if self.finish("signal", process, (3,)):
            self.finish("restart", self.start("run", file, short, output, ["--restart"]), GOOD)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", required=True)
    parser.add_argument("--ranks", type=int, default=1)
    parser.add_argument("--only", help="name of one run")
    parser.add_argument("-o", "--output", default="results/sanitizers")
    arguments = parser.parse_args()
    arguments.program = os.path.abspath(arguments.program)
    runs = Runs(arguments)
    for run in RUNS:
        # A material point is one process.
        if arguments.only in (None, run[0]) and (run[1] == "run" or arguments.ranks == 1):
            runs.scene(*run)
    if arguments.only in (None, "signal"):
        runs.signal_and_restart()
    print(f"{runs.wrong} wrong")
    return 1 if runs.wrong else 0


if __name__ == "__main__":
    sys.exit(main())
