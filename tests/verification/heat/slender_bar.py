"""The bar of inputs/heat/necking.xml as a slender bar: uniaxial stress, conduction along it, explicit steps of heat, up to the largest force.

Equations per reference length, with the section A, true strain e = tau/E + alpha + a d theta and the stretch l = exp(e):
    F = A tau/l,    tau = sigma_y(alpha) (1 - w d theta) where it flows,    u = int (l - 1) dY
    (rho c + 9 K a^2 theta) A theta' = (k A/l^2 theta_Y)_Y + A (chi tau alpha' - a theta tau') - 2 pi r h d theta
The second term of either side is the heat of elastic strain, -3 K a theta (tr e_e)', with tr e_e = tau/3K + 3 a d theta.
usage: slender_bar.py [isothermal]
"""
import math
import sys

YOUNG, POISSON, STORAGE, START, CHI, CONDUCTIVITY, FILM, RADIUS, HALF = 206900, 0.29, 7.8e-9 * 4.6e8, 293, 0.9, 45, 0.0175, 6.413, 53.334 / 2
ISOTHERMAL = sys.argv[1:] == ["isothermal"]
SOFTENING, EXPANSION = (0, 0) if ISOTHERMAL else (0.002, 1e-5)
BULK = YOUNG / 3 / (1 - 2 * POISSON)


def yield_stress(alpha):
    """sigma_y and its slope."""
    decay = math.exp(-16.93 * alpha)
    return 450 + 129.24 * alpha + 265 * (1 - decay), 129.24 + 265 * 16.93 * decay


def state_at(force, area, rise, alpha):
    """tau, alpha and e under a force; None beyond the largest force that the section bears."""
    tau, thermal = force / area, EXPANSION * rise
    for _ in range(6):
        tau = force / area * math.exp(tau / YOUNG + alpha + thermal)
    factor = 1 - SOFTENING * rise
    if tau > factor * yield_stress(alpha)[0]:
        change = 1.0
        while abs(change) > 1e-13:
            value, slope = (factor * one for one in yield_stress(alpha))
            shrink = area * math.exp(-value / YOUNG - alpha - thermal)
            stiffness = shrink * (slope - value * (slope / YOUNG + 1))
            if stiffness <= 0:
                return None
            change = (force - shrink * value) / stiffness
            alpha += change
        tau = factor * yield_stress(alpha)[0]
    return tau, alpha, tau / YOUNG + alpha + thermal


def rates(states, old, rises, radii, areas, size, step):
    """theta' of each cell."""
    result = []
    for i, ((tau, alpha, strain), (tau_old, alpha_old, _), rise) in enumerate(zip(states, old, rises)):
        theta = START + rise
        heat = areas[i] * (CHI * tau * (alpha - alpha_old) - EXPANSION * theta * (tau - tau_old)) / step - 2 * math.pi * radii[i] * FILM * rise
        for j in (i - 1, i + 1):
            if 0 <= j < len(states):
                stretch = (math.exp(strain) + math.exp(states[j][2])) / 2
                heat += CONDUCTIVITY * (areas[i] + areas[j]) / 2 / stretch ** 2 * (rises[j] - rise) / size ** 2
        result.append(heat / areas[i] / (STORAGE + 9 * BULK * EXPANSION ** 2 * theta))
    return result


def main(cells=50, pull_step=2e-3):
    """Steps of the pull at one millimetre per second."""
    size = HALF / cells
    radii = [RADIUS * (0.982 + 0.018 * (i + 0.5) / cells) for i in range(cells)]
    areas = [math.pi * radius ** 2 for radius in radii]
    rises, states, force, pull, marks, largest = [0.0] * cells, [(0.0, 0.0, 0.0)] * cells, 0.0, 0.0, [0.04, 1, 2], (0.0, 0.0, 0.0)
    while True:
        pull += pull_step

        def at(trial):
            found = [state_at(trial, area, rise, old[1]) for area, rise, old in zip(areas, rises, states)]
            return found if None not in found and sum(math.expm1(one[2]) for one in found) * size <= pull else None

        low, high, reached = 0.99 * force, force + 1.3e6 * pull_step, None
        while high - low > 1e-6 * high:
            middle = (low + high) / 2
            found = at(middle)
            low, high, reached = (middle, high, found) if found else (low, middle, reached)
        if reached is None or sum(math.expm1(one[2]) for one in reached) * size < pull - 0.1 * pull_step:
            print(f"largest force {largest[0] / 1000:.3f} kN at a pull of {largest[1]:.3f}: centre {largest[2]:+.3f} K")
            return
        rises = [rise + pull_step * rate for rise, rate in zip(rises, rates(reached, states, rises, radii, areas, size, pull_step))]
        states, force = reached, low
        largest = max(largest, (force, pull, rises[0]))
        if marks and pull > marks[0] - 1e-9:
            mean = sum(rise * area for rise, area in zip(rises, areas)) / sum(areas)
            print(f"pull {pull:.3f}: force {force / 1000:.3f} kN, centre {rises[0]:+.3f} K, mean {mean:+.3f} K, plastic strain {states[0][1]:.4f}")
            marks.pop(0)


main()
