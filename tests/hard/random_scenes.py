#!/usr/bin/env python3
"""Runs random scenes and checks each by means that do not depend on the run itself. Standard library only.

    python3 -I tests/hard/random_scenes.py --program build/release/apps/mortise/mortise [--count 500] [--seed 1] [--jobs 2] [-o DIR]

Prints how many are right, stopped with a reason, WRONG, and keeps what is wrong in DIR/wrong/NUMBER. Exit code 4 if anything is wrong.
"""

import argparse
import collections
import concurrent.futures
import math
import os
import random
import shutil
import sys
import time

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))  # -I leaves it out
from random_bodies import Scene
from scene_checks import check_alone, check_companion, companions_of, false_reason, stop_is_told
from scene_writer import run

FAMILIES = {"pressed": 8, "over_the_edge": 5, "walls": 3, "dead_load": 3, "lifted": 1, "pushed_too_hard": 1, "held_by_friction": 2, "dragged": 3, "corner": 4}


def make(seed, number):
    """The scene of this number: the same on every machine."""
    chance = random.Random(f"{seed}/{number}")
    family = chance.choices(list(FAMILIES), list(FAMILIES.values()))[0]
    return Scene(chance, family, 3 if family != "corner" and chance.random() < 0.3 else 2), chance


def judge(arguments, number):
    """(verdict, family, what there is to say, seconds) of one scene."""
    start = time.time()
    scene, chance = make(arguments.seed, number)
    directory = os.path.join(arguments.output, f"{number:04d}")
    shutil.rmtree(directory, ignore_errors=True)
    main = run(arguments.program, scene.to_scene(), os.path.join(directory, "main"), arguments.ranks, arguments.limit)
    name = f"{scene.family} {scene.d}D"
    wrong, stops = [], []
    if main.ended and scene.has_no_answer():
        wrong.append("it came to its end, but nothing holds the block")
    elif main.ended:
        wrong += check_alone(scene, main)
        for kind in companions_of(scene, chance):
            other = getattr(scene, kind)()
            result = run(arguments.program, other.to_scene(), os.path.join(directory, kind), 1, arguments.limit)
            if result.ended:
                wrong += [f"{kind}: {text}" for text in check_companion(kind, scene, main, result)]
            elif stop_is_told(result):
                stops.append(f"{kind}: {result.reason}")
            else:
                wrong.append(f"{kind}: exit code {result.code}: {result.reason}")
    elif false_reason(scene, main):
        wrong.append(f"a false reason: {main.reason}")
    elif stop_is_told(main) and (main.code == 3 or scene.has_no_answer()):
        if not scene.has_no_answer():
            stops.append(main.reason)
    else:
        wrong.append(f"exit code {main.code}: {main.reason}")
    verdict = "WRONG" if wrong else "stopped" if stops else "right"
    text = "; ".join(wrong or stops)
    if wrong:
        kept = os.path.join(arguments.output, "wrong", f"{number:04d}")
        shutil.rmtree(kept, ignore_errors=True)
        shutil.copytree(directory, kept)
        with open(os.path.join(kept, "why.txt"), "w") as file:
            file.write("\n".join([name] + wrong + stops) + "\n")
    if not arguments.keep:
        shutil.rmtree(directory, ignore_errors=True)
    return verdict, name, text, time.time() - start


def main():
    parser = argparse.ArgumentParser(description="random scenes, each checked by means that do not depend on the run itself")
    parser.add_argument("--program", required=True)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--first", type=int, default=0, help="number of the first scene")
    parser.add_argument("--count", type=int, default=500)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--ranks", type=int, default=1, help="MPI ranks of the scene itself; its companions run on one")
    parser.add_argument("--limit", type=float, default=60.0, help="seconds of processor time that a run may take on each rank")
    parser.add_argument("--keep", action="store_true", help="keep all runs, not only those that are wrong")
    parser.add_argument("-o", "--output", default="results/random")
    arguments = parser.parse_args()
    arguments.program = os.path.abspath(arguments.program)
    os.makedirs(arguments.output, exist_ok=True)
    numbered = collections.defaultdict(list)
    counts, by_family, start = collections.Counter(), collections.defaultdict(collections.Counter), time.time()
    numbers = range(arguments.first, arguments.first + arguments.count)
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        for done, (number, result) in enumerate(zip(numbers, pool.map(lambda number: judge(arguments, number), numbers)), 1):
            verdict, name, text, seconds = result
            counts[verdict] += 1
            by_family[name][verdict] += 1
            numbered[verdict].append(str(number))
            left = (time.time() - start) / done * (arguments.count - done)
            print(f"{number} {name}: {verdict}, {seconds:.1f} s; about {math.ceil(left)} s left" + (f"\n  {text}" if text else ""), flush=True)
    print()
    for name in sorted(by_family):
        print(f"{name}: " + ", ".join(f"{by_family[name][verdict]} {verdict}" for verdict in ("right", "stopped", "WRONG")))
    for verdict in ("stopped", "WRONG"):
        if numbered[verdict]:
            print(f"{verdict}: " + " ".join(numbered[verdict]))
    print(f"seed {arguments.seed}: {counts['right']} right, {counts['stopped']} stopped with a reason, {counts['WRONG']} WRONG, {time.time() - start:.0f} s")
    return 4 if counts["WRONG"] else 0


if __name__ == "__main__":
    sys.exit(main())
