"""Long runs of impacts for docs/results/dynamics.md: tables on the screen, and the figure of energies.

usage: dynamics_study.py MORTISE INPUTS DIRECTORY [energy | pairs | impedance | noise | disc | snap ...]      needs python3-matplotlib for energy

Without names all of them are run, which takes about half an hour. dynamics_orders.py has the orders. docs/images/dynamics_energy.svg is the picture
that this leaves in DIRECTORY.
"""
import math
import os
import sys

from impacts import DiscBalance, Runs, disc_on_floor, largest_gain, largest_rise, pair_of_blocks, random_pair, start_energy

GAP = "inertia/contact condition=gap"


def alpha(radius, balance="over the step", mass="removed"):
    return [GAP, f"inertia/spectral radius={radius}", f"inertia/balance={balance}", f"inertia/contact mass={mass}"]


SCHEMES = {
    "gap rate, radius 1": ["inertia/contact mass=removed"], "gap rate, radius 1, mass kept": ["inertia/contact mass=kept"],
    **{f"over the step, radius {radius}{', mass kept' if mass == 'kept' else ''}": alpha(radius, "over the step", mass) for mass in ("removed", "kept") for radius in (1, 0.9, 0.8)},
    **{f"at the end, radius {radius}{', mass kept' if mass == 'kept' else ''}": alpha(radius, "at the end", mass) for mass in ("removed", "kept") for radius in (1, 0.9, 0.8)},
    "newmark": [GAP, "inertia/scheme=newmark"], "newmark, mass kept": [GAP, "inertia/scheme=newmark", "inertia/contact mass=kept"],
    "backward euler": [GAP, "inertia/scheme=backward euler"], "backward euler, mass kept": [GAP, "inertia/scheme=backward euler", "inertia/contact mass=kept"]}


def energy(runs, inputs, steps=10000):
    """The bar between two walls, all over the energy at the start: energy at the end, how far it is above the start and above an earlier step, how far contact
    work is above an earlier step, impacts."""
    print("| scheme | energy at the end | largest above the start | largest rise | largest rise of contact work | impacts |\n|---|---|---|---|---|---|")
    curves = {}
    for name, settings in SCHEMES.items():
        _, columns = runs.file(name.replace(" ", "_").replace(",", ""), os.path.join(inputs, "dynamics", "bouncing_bar.xml"),
                               [f"variables/steps={steps}", "checks/energy stays/low=-1e300", "checks/energy stays/high=1e300", *settings])
        start = 0.5 * 0.1 * 0.01**2
        total = [1.0] + [(kinetic + stored) / start for kinetic, stored in zip(columns["kinetic energy"], columns["stored energy"])]
        # An impact begins where a force follows a pause of 20 steps; the first one begins at once.
        forces = [0.0] * 20 + [abs(left) + abs(right) for left, right in zip(columns["force on the left"], columns["force on the right"])]
        impacts = sum(1 for k in range(20, len(forces)) if forces[k] > 0 and max(forces[k - 20:k]) == 0)
        curves[name] = ([0.0] + columns["time"], total)
        ended = "" if len(total) == steps + 1 else f" after {len(total) - 1} steps"
        rises = f"{max(total) - 1:.1e} | {largest_rise(total):.1e} | {largest_rise([0.0] + columns['contact work']) / start:.1e}"
        print(f"| {name} | {total[-1]:.6g}{ended} | {rises} | {impacts} |", flush=True)
    return curves


def draw(curves, stem):
    """Energy over time, without contact mass on a broken axis and with it on a logarithmic one."""
    sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "..", "packages", "studies", "plots"))
    from style import COLOURS, DASHES, plt  # the one look of all pictures
    figure = plt.figure(figsize=(7.5, 4.6), layout="constrained")
    grid = figure.add_gridspec(3, 2, height_ratios=(4, 2, 1.2))
    above, all_kept, names = figure.add_subplot(grid[0, 0]), figure.add_subplot(grid[:2, 1]), figure.add_subplot(grid[2, :])
    below = figure.add_subplot(grid[1, 0], sharex=above)
    families = ("gap rate", "over the step", "at the end", "newmark", "backward euler")
    for name, (time, total) in curves.items():
        kept = name.endswith(", mass kept")
        label = name[:-len(", mass kept")] if kept else name
        family = next(number for number, family in enumerate(families) if name.startswith(family))
        dashes = DASHES[1] if "0.9" in name or family == 3 else DASHES[3] if "0.8" in name else DASHES[0]  # Newmark lies on "at the end, radius 1"
        for axes in (all_kept,) if kept else (above, below):
            axes.plot(time[::40], total[::40], color=COLOURS[family], linestyle=dashes, linewidth=1.2, label=label)
    above.set_ylim(0.965, 1.003)
    below.set_ylim(0, 0.965)
    above.tick_params(labelbottom=False)
    above.set_title("contact mass removed")
    all_kept.set_title("contact mass kept")
    all_kept.set_yscale("log")
    all_kept.set_ylim(0.05, 20)
    all_kept.set_yticks([0.1, 0.2, 0.5, 1, 2, 5, 10], ["0.1", "0.2", "0.5", "1", "2", "5", "10"])
    all_kept.minorticks_off()
    for axes in (below, all_kept):
        axes.set_xlabel("time over L / c")
    above.set_ylabel("energy over that at the start")
    handles, labels = above.get_legend_handles_labels()
    names.axis("off")
    names.legend(handles, labels, loc="center", ncols=3)
    figure.savefig(stem + ".svg", metadata={"Date": None})


def pairs(runs, count=200):
    """Random pairs, each with either side as slave. Over the energy at the start: rise of the contact work, and of the printed energy."""
    print("| slave | runs | steps | pairs whose contact work rises by more than 1e-10 | largest rise of contact work | of the printed energy "
          "| of that above the start |\n|---|---|---|---|---|---|---|")
    for second in (False, True):
        works, totals, above, steps = [], [], [], 0
        for seed in range(count):
            pair = {**random_pair(seed), "second_is_slave": second}
            _, columns = runs.scene(f"pair_{seed}_{int(second)}", pair_of_blocks(**pair))
            start = start_energy(**pair)
            total = [1.0] + [(kinetic + stored) / start for kinetic, stored in zip(columns["kinetic energy"], columns["stored energy"])]
            works.append((largest_gain(columns, start), seed))
            totals.append((largest_rise(total), seed))
            above.append((max(total) - 1, seed))
            steps += len(total) - 1
        largest = " | ".join(f"{rise:.1e} (pair {seed})" for rise, seed in (max(works), max(totals), max(above)))
        print(f"| {'second' if second else 'first'} | {count} | {steps} | {sum(gain > 1e-10 for gain, _ in works)} | {largest} |", flush=True)


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


# Elements around, rings, step, friction, speed across, spin over it; the speed along is 5 times that across. The half width of contact goes with the
# square root of the depth, which goes with the speed: by the mesh, the depth at one mesh, the depth with as many elements in contact, friction, the step.
DISCS = (*[(around, around // 12, 0.1, 0.1, across, ratio) for ratio in (0, -1) for around, across in (
             (48, 0.02), (96, 0.02), (192, 0.02), (48, 0.01), (48, 0.005), (48, 0.0025), (96, 0.005), (192, 0.005), (192, 0.00125))],
         (48, 4, 0.1, 0.1, 0.005, 1), (48, 4, 0.1, 0.05, 0.005, -1), (48, 4, 0.1, 0.2, 0.005, -1), (48, 4, 0.1, 0.4, 0.005, -1), (48, 4, 0.05, 0.1, 0.005, -1))


def disc(runs):
    """A disc that slips throughout: impulses, and the change of the angular momentum about its centre of mass, of friction and of pressures."""
    print("| elements around | step | mu | speed across | spin | J_t / (mu J_n) | change of angular momentum over R J_t | of friction | of pressures "
          "| pressures act ahead by | the same by the fields | change over mu R J_n |\n"
          "|---|---|---|---|---|---|---|---|---|---|---|---|")
    for around, rings, step, friction, across, ratio in DISCS:
        spin = ratio * across
        name = f"disc_{around}_{step}_{friction}_{across}_{ratio}"
        _, columns = runs.scene(name, disc_on_floor(friction, across, 5 * across, spin, step, around // 4, rings, profiles=True))
        found = DiscBalance(columns, across, 5 * across)
        share, by_fields = found.share / friction, found.ahead_by_profiles(os.path.join(runs.directory, name, "profiles.csv"))
        print(f"| {around} | {step} | {friction} | {across} | {spin:g} | {share:.4f} | {found.change:.4f} | {found.friction:.4f} | {found.pressure:+.4f} "
              f"| {found.ahead:+.1e} | {by_fields:+.1e} | {found.change * share:.4f} |", flush=True)


def snap(runs, inputs):
    """Contact work of its own, where normals turn: a ring on a collar, by facets around its section and by the step. Over the largest stored energy."""
    print("| facets around the section | cell size of the shaft | step | largest stored energy over that of a thin ring | contact work at the end "
          "| largest rise of it | energy gained |\n|---|---|---|---|---|---|---|")
    for cells, size, step in ((8, 0.01, 0.0065), (8, 0.01, 0.00325), (16, 0.01, 0.0065), (16, 0.01, 0.00325), (16, 0.005, 0.0065), (32, 0.005, 0.0065),
                              (32, 0.005, 0.00325)):
        quantities, columns = runs.file(f"snap_{cells}_{size}_{step}", os.path.join(inputs, "dynamics", "snap_fit.xml"),
                                        [f"bodies/ring/mesh/cells around={cells}", f"bodies/shaft/mesh/cell size={size}", f"variables/step={step}"])
        stored, work = max(columns["stored"]), [0.0] + columns["contact work"]
        print(f"| {4 * cells} | {size} | {step} | {quantities['largest stored over that on the collar']:.4f} | {work[-1] / stored:.4f} "
              f"| {largest_rise(work) / stored:.4f} | {-min(columns['energy error']):.4f} |", flush=True)


def main():
    mortise, inputs, directory = sys.argv[1:4]
    wanted = sys.argv[4:] or ["energy", "pairs", "impedance", "noise", "disc", "snap"]
    runs = Runs(mortise, directory)
    if "energy" in wanted:
        draw(energy(runs, inputs), os.path.join(directory, "dynamics_energy"))
    if "pairs" in wanted:
        pairs(runs)
    if "impedance" in wanted:
        impedance(runs, inputs)
    if "noise" in wanted:
        noise(runs)
    if "disc" in wanted:
        disc(runs)
    if "snap" in wanted:
        snap(runs, inputs)


if __name__ == "__main__":
    main()
