"""Impacts against theory: what contact may do with energy, momentum, impulses, limits of small mass and small steps.

usage: dynamics_test.py MORTISE INPUTS DIRECTORY

dynamics_study.py has the long sweeps of docs/results/dynamics.md.
"""
import math
import os
import re
import subprocess
import sys
from xml.etree import ElementTree

from impacts import DiscBalance, Runs, block, disc_on_floor, from_static, largest_gain, material, named, one_layer, pair_of_blocks, pressed_bar, random_pair, start_energy


def without_motion(scene, path):
    """Writes a scene without inertia, and without the quantities and checks of motion."""
    tree = ElementTree.parse(scene)
    root = tree.getroot()
    for entry in list(root):
        if entry.get("name") in ("inertia", "checks"):
            root.remove(entry)
        elif entry.get("name") == "quantities":
            for quantity in list(entry):
                words = [parameter.get("value") for parameter in quantity]
                if any(word in words for word in ("kinetic", "contact work", "energy error")):
                    entry.remove(quantity)
    tree.write(path)
    return path


def main():
    mortise, inputs, directory = sys.argv[1:4]
    runs, failures = Runs(mortise, directory), 0

    def check(holds, text):
        nonlocal failures
        failures += not holds
        print(("ok      " if holds else "FAILED  ") + text, flush=True)

    # Contact takes energy and gives none, whichever side is the slave: z >= 0, g = 0 where z > 0 and g >= 0 before.
    for seed in (0, 2, 7, 8):
        _, columns = runs.scene(f"pair_{seed}", pair_of_blocks(**random_pair(seed)))
        gain = largest_gain(columns, start_energy(**random_pair(seed)))
        check(gain < 1e-12, f"random pair {seed}: contact work rises by at most {gain:.1e} of the energy at the start")
        drift = max(abs(p - columns["momentum y"][0]) for p in columns["momentum y"])
        size = max(abs(p) for title in ("momentum x", "momentum y") for p in columns[title])
        check(drift < 1e-12 * size, f"random pair {seed}: momentum across drifts by {drift / size:.1e}")

    # A disc that slips throughout: J_t = mu J_n, and the angular momentum changes by R J_t. Its depth of 3 % of the radius shortens the arm.
    _, columns = runs.scene("disc", disc_on_floor(0.1, 0.02, 0.1, 0.0))
    disc = DiscBalance(columns, 0.02, 0.1)
    check(abs(disc.share / 0.1 - 1) < 0.02, f"slipping disc: impulses along and across are {disc.share:.4f} to 1, by Coulomb 0.1")
    check(abs(disc.change - 1) < 0.05, f"slipping disc: angular momentum changes by {disc.change:.4f} R J_t")

    # Contact that lasts is a support: both balances are the same, as multipliers have no part in the motion, and of second order.
    def ends(balance, steps, density=1.0):
        return runs.scene(f"pressed_{balance.replace(' ', '_')}_{steps}_{density:g}", pressed_bar(balance, density, steps))[1]["end"]
    over, end, finer, finest = ends("over the step", 100), ends("at the end", 100), ends("at the end", 200), ends("at the end", 400)
    apart = max(abs(one - other) for one, other in zip(over, end))
    check(apart < 1e-13, f"lasting contact: the two balances differ by {apart:.1e}")
    errors = [max(abs(one - other) for one, other in zip(coarse, fine[1::2])) for coarse, fine in ((end, finer), (finer, finest))]
    order = math.log2(errors[0] / errors[1])
    check(1.8 < order < 2.2, f"lasting contact: half the step changes the end by {errors[0]:.2e} and {errors[1]:.2e}, of order {order:.2f}")

    # A bar that is thrown with a velocity of 1: supports may begin with it, and are reported where they do not.
    def started(of_support, speed=1):
        support = named("boundary conditions", named("drive", set="bar/left", x=of_support))
        bar = named("bodies", block(2, "bar", "soft", 1.0, 0.0, 4, 1))
        start = named("initial conditions", named("throw", **{"body": "bar", "velocity x": speed}))
        path = runs.write("start", [named("materials", material("soft", 1.0, 1.0)), bar, support, start, named("inertia", scheme="generalised alpha"),
                                    named("stepping", **{"end time": 0.1, "step": 0.05})])
        done = subprocess.run([mortise, "run", path, "-o", os.path.join(directory, "start")], capture_output=True, text=True)
        words = ("prescribes the displacement", "the velocity", '"1/(x-x)" is inf at x = 0, y = 0, z = 0')
        return done.returncode, [text for text in words if text in done.stdout + done.stderr]
    for support, said in (("t", []), ("2*t", ["the velocity"]), ("0.1 + t", ["prescribes the displacement"])):
        found = started(support)
        check(found == (0, said), f"a support x = {support} of a bar with a velocity of 1 gives {found}")
    found = started("t", "1/(x-x)")
    check(found[0] == 2 and len(found[1]) == 1, f"a velocity that has no value is refused: {found}")

    # Balance at the end with massive contact nodes multiplies the energy in an impact: no such end state is accepted.
    bar = os.path.join(inputs, "dynamics", "bouncing_bar.xml")
    settings = [f"inertia/{one}" for one in ("balance=at the end", "contact mass=kept", "contact condition=gap")]
    command = [mortise, "run", bar, "-o", os.path.join(directory, "gain")] + [word for one in settings for word in ("--set", one)]
    gain = subprocess.run(command, capture_output=True, text=True)
    check(gain.returncode == 3 and "contact has given the energy" in gain.stdout + gain.stderr, f"contact that gives energy ends with exit code {gain.returncode}")

    # Without mass the static solution, E = 1, of first order in the density.
    away = [from_static(ends("at the end", 200, density)) for density in (1e-3, 1e-4)]
    check(8 < away[0] / away[1] < 12, f"small mass: the end is at most {away[0]:.1e} and {away[1]:.1e} of its way from the static place for densities of 1e-3 and 1e-4")

    # Statics ends where the edge of the collar begins, at the largest force, which a thin ring needs at t = 1; the compliance of contact takes some of it.
    scene = without_motion(os.path.join(inputs, "dynamics", "snap_fit.xml"), os.path.join(directory, "static_snap_fit.xml"))
    done = subprocess.run([mortise, "run", scene, "-o", os.path.join(directory, "static_snap_fit"), "--quiet", "--set", "stepping/step=0.02"],
                          capture_output=True, text=True)
    times = [float(time) for time in re.findall(r"last converged state is that of time ([0-9.]+)", done.stdout + done.stderr)]
    check(done.returncode != 0 and times != [] and 0.8 < times[0] < 1.0, f"snap fit without inertia: exit code {done.returncode}, ends at {times} of the time of a thin ring's largest force")
    # Advice, each with its numbers.
    def said(name, scene, *settings):
        words = [word for setting in settings for word in ("--set", setting)]
        done = subprocess.run([mortise, "run", scene, "-o", os.path.join(directory, name), *words], capture_output=True, text=True)
        return done.stdout + done.stderr

    impedance = os.path.join(inputs, "dynamics", "matched_impedance.xml")
    bar = os.path.join(inputs, "dynamics", "bouncing_bar.xml")
    text = said("tolerance", bar, "inertia/contact condition=gap", "inertia/spectral radius=0.8", "inertia/impact tolerance=1e-3", "variables/n=10", "variables/courant=0.9",
                "variables/steps=50")
    check('of the kinetic energy, ' in text and 'above the "impact tolerance" of 0.001' in text, "a step in which closing takes too much is halved")
    text = said("speed", impedance, "variables/n=10", "stepping/step=1.5")
    check("the step of 1.5 is longer than" in text and "crosses the search reach of" in text, "a step that is longer than the way through the search reach is told")
    check("accelerations and forces of supports ring" not in text, "motion that is not prescribed does not jump")
    whole = runs.write("layer", one_layer())
    text = said("layer", whole)
    check("4 nodes of contact surfaces keep their mass" in text, "contact nodes without interior nodes keep their mass")
    check("a prescribed velocity jumps by about 1 at t = 0.5" in text, "a kink of prescribed motion is told")
    print(f"{failures} failed")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
