"""Long runs of impacts for docs/results/dynamics.md: tables on the screen, and the figure of energies.

usage: dynamics_study.py MORTISE INPUTS DIRECTORY [energy | pairs | impedance | noise | disc ...]      needs python3-matplotlib for energy

Without names all of them are run, which takes about half an hour.
"""
import math
import os
import sys

from impacts import Runs, change_of_spin, disc_on_floor, largest_gain, pair_of_blocks, random_pair

GAP = "inertia/contact condition=gap"


def alpha(radius, balance="over the step", mass="removed"):
    return [GAP, f"inertia/spectral radius={radius}", f"inertia/balance={balance}", f"inertia/contact mass={mass}"]


SCHEMES = {
    "gap rate, radius 1": ["inertia/contact mass=removed"], "gap rate, radius 1, mass kept": ["inertia/contact mass=kept"],
    **{f"over the step, radius {radius}{', mass kept' if mass == 'kept' else ''}": alpha(radius, "over the step", mass) for mass in ("removed", "kept") for radius in (1, 0.9, 0.8)},
    **{f"at the end, radius {radius}{', mass kept' if mass == 'kept' else ''}": alpha(radius, "at the end", mass) for mass in ("removed", "kept") for radius in (1, 0.9, 0.8)},
    "newmark": [GAP, "inertia/scheme=newmark"], "newmark, mass kept": [GAP, "inertia/scheme=newmark", "inertia/contact mass=kept"],
    "backward euler": [GAP, "inertia/scheme=backward euler"]}


def energy(runs, inputs, steps=10000):
    """The bar between two walls: energy over that at the start, its largest rise, bounces."""
    print("| scheme | energy at the end | largest | impacts |\n|---|---|---|---|")
    curves = {}
    for name, settings in SCHEMES.items():
        _, columns = runs.file(name.replace(" ", "_").replace(",", ""), os.path.join(inputs, "dynamics", "bouncing_bar.xml"),
                               [f"variables/steps={steps}", "checks/energy stays/low=-1e300", "checks/energy stays/high=1e300", *settings])
        start = 0.5 * 0.1 * 0.01**2
        total = [(kinetic + stored) / start for kinetic, stored in zip(columns["kinetic energy"], columns["stored energy"])]
        forces = [abs(left) + abs(right) for left, right in zip(columns["force on the left"], columns["force on the right"])]
        impacts = sum(1 for k in range(20, len(forces)) if forces[k] > 0 and max(forces[k - 20:k]) == 0)
        curves[name] = (columns["time"], total)
        print(f"| {name} | {total[-1]:.6g} | {max(total) - 1:+.2e} | {impacts} |", flush=True)
    return curves


def draw(curves, path):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    figure, axes = plt.subplots(figsize=(7.5, 4.5))
    for name in ("gap rate, radius 1", "over the step, radius 1", "over the step, radius 0.8", "at the end, radius 0.8", "at the end, radius 1",
                 "at the end, radius 1, mass kept", "newmark", "backward euler"):
        time, total = curves[name]
        axes.plot(time[::20], total[::20], label=name, linewidth=1.2)
    axes.set_yscale("log")
    axes.set_ylim(0.05, 30)
    axes.set_xlabel("time over L / c")
    axes.set_ylabel("energy over that at the start")
    axes.legend(fontsize=8)
    figure.tight_layout()
    figure.savefig(path, metadata={"Date": None})


def pairs(runs, count=200):
    """Random pairs: largest rise of the contact work in a step, over the energy; gain of the printed energy."""
    gains, errors = [], []
    for seed in range(count):
        _, columns = runs.scene(f"pair_{seed}", pair_of_blocks(**random_pair(seed)))
        gains.append(largest_gain(columns))
        errors.append((min(columns["energy error"][1:]), seed))
    print(f"{count} pairs: contact work rises by at most {max(gains):.1e} of the energy in a step; the printed energy by at most {-min(errors)[0]:.1e} (pair {min(errors)[1]})")


def impedance(runs, inputs):
    """Matched impedance: duration and force against 1, orders in the element and in the step."""
    scene = os.path.join(inputs, "dynamics", "matched_impedance.xml")
    print("| elements | Courant number | impulse | mean force while it acts | duration | striker keeps |\n|---|---|---|---|---|---|")
    for cells, courant in ((10, 0.9), (20, 0.9), (40, 0.9), (80, 0.9), (160, 0.9), (40, 0.45), (40, 1.8), (40, 3.6)):
        quantities, columns = runs.file(f"impedance_{cells}_{courant}", scene, [f"variables/n={cells}", f"variables/courant={courant}"])
        force, step = [abs(f) for f in columns["force"]], columns["time"][1] - columns["time"][0]
        duration = step * sum(f > 0.5 for f in force)
        inside = [f for f, t in zip(force, columns["time"]) if 0.2 < t < 0.8]
        print(f"| {cells} | {courant} | {-quantities['impulse']:.5f} | {sum(inside) / len(inside):.5f} | {duration:.4f} | {quantities['momentum of the striker']:.5f} |", flush=True)


def noise(runs):
    """A plane wave through faces that do not match: rms of the errors of force and largest pressure, which are 1, for 0.3 < t < 0.8."""
    print("| dimension | cells across | contact mass | radius | error of the force | of the largest pressure |\n|---|---|---|---|---|---|")
    for dimension, across in ((2, (3, 4)), (3, (2, 3))):
        for mass, radius in (("removed", 0.8), ("removed", 0.9), ("kept", 0.8)):
            cells = 40 if dimension == 2 else 20
            content = pair_of_blocks(dimension, (4.0, 4.0), (1.0, 1.0), across, cells, (1.0, 0.0), inertia={"contact mass": mass, "spectral radius": radius}, courant=0.5, waves=1.0)
            _, columns = runs.scene(f"noise_{dimension}_{mass}_{radius}", content)
            inside = [k for k, t in enumerate(columns["time"]) if 0.3 < t < 0.8]
            errors = [math.sqrt(sum((abs(columns[title][k]) - 1) ** 2 for k in inside) / len(inside)) for title in ("force", "peak")]
            print(f"| {dimension} | {across[0]} : {across[1]} | {mass} | {radius} | {errors[0]:.4f} | {errors[1]:.4f} |", flush=True)


def disc(runs):
    """A disc that slips throughout: impulses, and the change of spin."""
    print("| elements around | speed across | spin | J_t / (mu J_n) | change of angular momentum over R J_t |\n|---|---|---|---|---|")
    for cells, across, spin in ((12, 0.02, 0.0), (24, 0.02, 0.0), (24, 0.02, -0.02), (24, 0.01, 0.0), (24, 0.01, -0.005)):
        quantities, columns = runs.scene(f"disc_{cells}_{across}_{spin}", disc_on_floor(0.1, across, 0.1, spin, 0.25, cells))
        share, turn = abs(quantities["impulse x"] / quantities["impulse y"]) / 0.1, change_of_spin(columns, spin * math.pi / 2) / quantities["impulse x"]
        print(f"| {4 * cells} | {across} | {spin} | {share:.4f} | {turn:.4f} |", flush=True)


def main():
    mortise, inputs, directory = sys.argv[1:4]
    wanted = sys.argv[4:] or ["energy", "pairs", "impedance", "noise", "disc"]
    runs = Runs(mortise, directory)
    if "energy" in wanted:
        draw(energy(runs, inputs), os.path.join(directory, "dynamics_energy.svg"))
    if "pairs" in wanted:
        pairs(runs)
    if "impedance" in wanted:
        impedance(runs, inputs)
    if "noise" in wanted:
        noise(runs)
    if "disc" in wanted:
        disc(runs)


if __name__ == "__main__":
    main()
