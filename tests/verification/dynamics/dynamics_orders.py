"""Orders of dynamics in the element and in the step, by least squares in logarithms: one table for docs/results/dynamics.md.

usage: dynamics_orders.py MORTISE INPUTS DIRECTORY [impedance | rest | smooth | lasting | precession ...]
"""
import math
import os
import statistics
import sys

from impacts import Runs, frequency_of_bar, from_static, pressed_bar, vibrating_bar


def fitted_order(sizes, errors):
    """Slope of log error over log size."""
    return statistics.linear_regression([math.log(size) for size in sizes], [math.log(error) for error in errors]).slope


def row(what, by, sizes, errors, theory):
    last = math.log(errors[-2] / errors[-1]) / math.log(sizes[-2] / sizes[-1])
    print(f"| {what} | {by} | {sizes[0]:.4g} to {sizes[-1]:.4g} | {errors[0]:.2e} to {errors[-1]:.2e} | {fitted_order(sizes, errors):.2f} | {last:.2f} "
          f"| {theory} |", flush=True)


def impedance(runs, inputs, cells, courant):
    """Momentum that the striker keeps, and the integral of |force - 1| while 1 is exact and |force| afterwards."""
    quantities, columns = runs.file(f"impedance_{cells}_{courant}", os.path.join(inputs, "dynamics", "matched_impedance.xml"),
                                    [f"variables/n={cells}", f"variables/courant={courant}"])
    times = [0.0] + columns["time"]
    away = 0.0
    for before, after, force in zip(times, times[1:], columns["force"]):
        inside = max(min(after, 1.0) - before, 0.0)
        away += inside * abs(abs(force) - 1) + (after - before - inside) * abs(force)
    return abs(quantities["momentum of the striker"]), away


def block_to_rest(runs, inputs, step):
    """Errors of the path and of the time at which momentum is first 0, between two steps. The block is stiff: an elastic one shears, and swings when it stops."""
    quantities, columns = runs.file(f"rest_{step}", os.path.join(inputs, "dynamics", "block_to_rest.xml"), [f"stepping/step={step}", "variables/E=1e9"])
    times, momenta = [0.0] + columns["time"], [1.0] + columns["momentum"]
    k = next(k for k, momentum in enumerate(momenta) if momentum <= 0)
    rest = times[k - 1] + (times[k] - times[k - 1]) * momenta[k - 1] / (momenta[k - 1] - momenta[k])
    return abs(quantities["path"] - 1 / 6), abs(rest - 1 / 3)


def vibration(runs, steps, balance, radius):
    """Largest error of the end of a vibrating bar, over the amplitude."""
    _, columns = runs.scene(f"bar_{balance.replace(' ', '_')}_{radius}_{steps}", vibrating_bar(steps, balance, radius))
    frequency = frequency_of_bar()
    return max(abs(end - 0.01 / frequency * math.sin(frequency * time)) for end, time in zip(columns["end"], columns["time"])) * frequency / 0.01


def pressed(runs, balance, steps, density=1.0):
    """How the end of a pressed bar moves."""
    return runs.scene(f"pressed_{balance.replace(' ', '_')}_{steps}_{density:g}", pressed_bar(balance, density, steps))[1]["end"]


def at_common_times(coarse, fine):
    """Largest difference over time, over the largest displacement, of a run and one with twice as many steps or as many."""
    return max(abs(one - other) for one, other in zip(coarse, fine[1::2] if len(fine) == 2 * len(coarse) else fine)) / max(abs(end) for end in coarse)


def precession(runs, inputs, balance, steps):
    """Error of the rate at which the angular momentum goes round in the axes of a free body with J1 = J2: (J3 - J1) w3 / J1.

    The angular momentum is constant in space, so that turning it back by the rotation of the body gives it in the body's axes.
    """
    quantities, _ = runs.file(f"precession_{balance.replace(' ', '_')}_{steps}", os.path.join(inputs, "dynamics", "spinning_box.xml"),
                              [f"variables/steps={steps}", f"inertia/balance={balance}"])
    rotation = [-math.radians(quantities[f"rotation {c}"]) for c in "xyz"]
    angle = math.sqrt(sum(c * c for c in rotation))
    axis, momentum = [c / angle for c in rotation], (0.5 * 1.16, 0.0, 2.0)  # over m / 12
    across = (axis[1] * momentum[2] - axis[2] * momentum[1], axis[2] * momentum[0] - axis[0] * momentum[2], axis[0] * momentum[1] - axis[1] * momentum[0])
    inside = sum(a * b for a, b in zip(axis, momentum))
    body = [math.cos(angle) * m + math.sin(angle) * c + (1 - math.cos(angle)) * inside * a for m, c, a in zip(momentum, across, axis)]
    return abs(math.atan2(body[1], body[0]) / 4 - (2.0 - 1.16) / 1.16)


def all_impedance(runs, inputs):
    cells, courants = (10, 20, 40, 80, 160), (3.6, 1.8, 0.9, 0.45)
    for by, sizes, pairs in (("h at Courant number 0.9", [1 / n for n in cells], [(n, 0.9) for n in cells]),
                             ("step, 40 elements", [0.5 * courant / 40 for courant in courants], [(40, courant) for courant in courants])):
        kept, away = zip(*[impedance(runs, inputs, *pair) for pair in pairs])
        row("matched impedance: momentum that is kept", by, sizes, kept, "")
        row("matched impedance: force, integral of the error", by, sizes, away, "")


def all_rest(runs, inputs):
    steps = (0.004, 0.002, 0.001, 0.0005)
    path, rest = zip(*[block_to_rest(runs, inputs, step) for step in steps])
    row("block sliding to rest: path", "step", steps, path, "1")
    row("block sliding to rest: time", "step", steps, rest, "1")


def all_smooth(runs, inputs):
    counts = (25, 50, 100, 200, 400)
    for balance in ("over the step", "at the end"):
        for radius in (0.8, 1.0):
            row(f"vibrating bar, {balance}, radius {radius:g}", "step", [2.5 / n for n in counts], [vibration(runs, n, balance, radius) for n in counts], "2")
    counts = (100, 200, 400, 800)
    scene = os.path.join(inputs, "dynamics", "damped_oscillator.xml")
    errors = [runs.file(f"oscillator_{n}", scene, [f"variables/steps={n}"])[0]["largest error"] for n in counts]
    row("damped oscillator, Newmark", "step", [4 / n for n in counts], errors, "2")


def all_lasting(runs, inputs):
    counts = (50, 100, 200, 400)
    ends = {balance: [pressed(runs, balance, n) for n in (*counts, 800)] for balance in ("over the step", "at the end")}
    row("lasting contact: to half the step", "step", [4 / n for n in counts], [at_common_times(*pair) for pair in zip(ends["at the end"], ends["at the end"][1:])], "2")
    print(f"The balances differ by at most {max(at_common_times(*pair) for pair in zip(*ends.values())):.1e}.")
    densities = (1e-2, 1e-3, 1e-4, 1e-5)
    row("lasting contact: to the static place", "density", densities, [from_static(pressed(runs, "at the end", 400, density)) for density in densities], "1")


def all_precession(runs, inputs):
    counts = (100, 200, 400, 800)
    for balance, theory in (("at the end", "2"), ("over the step", "1")):
        row(f"free rigid body: rate of precession, {balance}", "step", [4 / n for n in counts], [precession(runs, inputs, balance, n) for n in counts], theory)


PARTS = {"impedance": all_impedance, "rest": all_rest, "smooth": all_smooth, "lasting": all_lasting, "precession": all_precession}


def main():
    mortise, inputs, directory = sys.argv[1:4]
    runs = Runs(mortise, directory)
    print("| error | over | from, to | error from, to | fitted order | of the last two | theory |\n|---|---|---|---|---|---|---|")
    for part in sys.argv[4:] or PARTS:
        PARTS[part](runs, inputs)


if __name__ == "__main__":
    main()
