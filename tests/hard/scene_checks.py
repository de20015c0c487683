"""Checks of a random scene that are known without running it, and by its companions."""

import math
import re

ROUND_OFF = 1e-6  # figures of runs that ought to be the same, relative: Newton's tolerances of 1e-9, and a thousand for what amplifies them
LARGE_STRAIN = 0.1  # of forces: laws differ from small strain by twice a strain, which bounds are asked for up to 5 % of
LEAN = 0.03  # of a force that ought to be normal to a plane


def confined(E, nu):
    return E * (1 - nu) / ((1 + nu) * (1 - 2 * nu))


def column(E, nu, d):
    """Stiffness of a free column: plane strain, or in 3D uniaxial stress."""
    return E / (1 - nu**2) if d == 2 else E


def way(scene):
    """By how much the bodies are pressed into one another."""
    return scene.press - scene.at[-1]


def edge(scene):
    """Relative error of the force, as the edge of contact is known to a quarter of a facet on either side."""
    sizes, counts = (scene.w, scene.n), (scene.W, scene.N)
    facets = [max(scene.w[i] / scene.n[i], scene.W[i] / scene.N[i]) for i in range(scene.d - 1)]
    return sum(0.5 * facet / width for facet, width in zip(facets, scene.covered()))


def peaks(scene):
    """Largest ratio of the peaks of two meshes: at a sharp edge pressure grows at most like 1/sqrt(length) that it is a mean over, of either's facets, of
    which a ninth or more is covered."""
    facets = [size / count for sizes, counts in ((scene.w, scene.n), (scene.W, scene.N)) for size, count in zip(sizes[:-1], counts[:-1])]
    return 3 * math.sqrt(max(facets) / min(facets)) ** (scene.d - 1)


def told_excess(result):
    """Possible excess of peaks over their size, as the run warned: a slave that is stiffer and finer than its master."""
    return max([0.0] + [float(number) / 100 for number in re.findall(r"peaks of pressure may be too high by about (\d+) %", result.said)])


def known_force(scene):
    """The exact force, or None."""
    area = math.prod(scene.w[:-1])
    if scene.family == "walls":
        return area * way(scene) / (scene.W[-1] / confined(scene.E[0], scene.nu[0]) + scene.w[-1] / confined(scene.E[1], scene.nu[1]))
    if scene.under_dead_load():
        return area * scene.press
    return None


def bounds(scene):
    """Bounds of elasticity on the force of scenes driven by a way, (low, high): energy of columns cut out of the bodies, and of a block confined on a rigid base."""
    u = way(scene)
    stiffness = [column(scene.E[i], scene.nu[i], scene.d) for i in range(2)]
    low = math.prod(scene.covered()) * u / (scene.W[-1] / stiffness[0] + scene.w[-1] / stiffness[1])
    high = math.prod(scene.w[:-1]) * u * confined(scene.E[1], scene.nu[1]) / scene.w[-1]
    return (1 - LARGE_STRAIN) * max(0.0, 1 - edge(scene)) * low, (1 + LARGE_STRAIN) * high


def check_alone(scene, result):
    """Everything that one run has to satisfy; a list of what it does not."""
    wrong = []
    up = "xyz"[scene.d - 1]
    force = result[f"floor_{up}"]
    across = [result[f"floor_{axis}"] for axis in "xyz"[:scene.d - 1]]
    scale = max(abs(force), 1e-12 * scene.E[1])

    def want(holds, text):
        if not holds:
            wrong.append(text)

    want(force >= -ROUND_OFF * scale, f"the base is pulled: force {force:.6g}")
    want(result["imbalance"] <= ROUND_OFF, f"momentum imbalance {result['imbalance']:.3g}")
    if not scene.sides_held:
        for i, axis in enumerate("xyz"[:scene.d]):
            want(abs(abs(result[f"f{axis}"]) - abs(result[f"floor_{axis}"])) <= ROUND_OFF * scale,
                 f"contact force {axis} {result[f'f{axis}']:.6g} is not what holds the base, {result[f'floor_{axis}']:.6g}")
    want(result["lowest"] >= -ROUND_OFF * max(result["peak"], 1e-12 * scene.E[1]), f"contact pulls: pressure {result['lowest']:.3g}")
    # Multipliers of hardly covered nodes are tied: gap / A = sigma (z - T z) / A, sigma = A h / E at most, |z - T z| twice the peak at most.
    yields = 2 * scene.facet() * result["peak"] / min(scene.E)
    want(result["gap"] >= -ROUND_OFF * scene.facet() - yields, f"penetration {-result['gap']:.3g}, facet {scene.facet():.3g}")
    want(result["largest"] <= 3 * (sum(scene.w) + sum(scene.W)), f"displacement {result['largest']:.3g}, far beyond the bodies")
    known = known_force(scene)
    if known is not None:
        want(abs(force - known) <= ROUND_OFF * abs(known), f"force {force:.8g}, known {known:.8g}")
    if scene.family in ("pressed", "over_the_edge") and way(scene) <= 0.05 * min(scene.w[-1], scene.W[-1]):
        low, high = bounds(scene)
        want(low <= force <= high, f"force {force:.6g}, bounds of elasticity {low:.6g} to {high:.6g}")
    if scene.family == "held_by_friction":
        pull = math.prod(scene.w[:-1]) * scene.pull
        want(abs(abs(across[0]) - pull) <= ROUND_OFF * scale, f"force aside {across[0]:.6g}, known {pull:.6g}")
    shear = math.hypot(*across)
    if scene.family == "dragged":
        want(abs(shear - scene.mu * force) <= (0.1 * scene.mu + LEAN) * force, f"shear {shear:.6g}, mu times force {scene.mu * force:.6g}")
    if scene.family == "corner":
        want(shear <= LEAN * force, f"a smooth plane is sheared by {shear / scale:.3g} of the force")
    if not scene.under_dead_load() and scene.family != "walls" and scene.mu == 0.0 and force > 0.0 and scene.at[-1] >= 0.0:
        # All that closes within one step works at most half of the force at its end over the step's way. Overlaps are work that nobody does.
        first = (1.0 / scene.steps / max(1e-12, way(scene) / scene.press)) ** 2
        want(abs(result["energy_error"]) <= 0.05 + min(1.0, 2 * first), f"energy error {result['energy_error']:.3g}, {scene.steps} steps")
    return wrong


def companions_of(scene, chance):
    """Companions with which a scene is run: two at most."""
    if scene.family == "walls" or scene.under_dead_load():
        return []
    kinds = ["mirrored"] if "Tet4" not in scene.elements else []
    if scene.family in ("pressed", "over_the_edge"):
        kinds.append(chance.choice(["exchanged", "finer" if scene.d == 2 else "exchanged"]))
        if scene.at[-1] < 0.0 and scene.mu == 0.0:
            kinds[0:1] = ["apart"]
    return kinds


def check_companion(kind, scene, main, other):
    """Differences of values that ought to be equal."""
    up = "xyz"[scene.d - 1]
    a, b = main[f"floor_{up}"], other[f"floor_{up}"]
    wrong = []
    if kind in ("mirrored", "apart"):
        # Friction of equal states need not be the same to round-off, as slip has a history of steps.
        same = ROUND_OFF if scene.mu == 0.0 else 10 * ROUND_OFF
        if abs(a - b) > same * abs(a):
            wrong.append(f"force {b:.8g}, of the scene itself {a:.8g}")
        sign = -1 if kind == "mirrored" else 1
        if abs(main["floor_x"] - sign * other["floor_x"]) > same * abs(a):
            wrong.append(f"force x {other['floor_x']:.8g}, of the scene itself {main['floor_x']:.8g}")
    else:
        allowed = 0.03 + edge(scene)
        if abs(a - b) > allowed * max(abs(a), abs(b)):
            wrong.append(f"force {b:.6g}, of the scene itself {a:.6g}, allowed {allowed:.2g} of it")
        ratio = peaks(scene) * (1 + max(told_excess(main), told_excess(other)))
        if kind == "exchanged" and max(main["peak"], other["peak"]) > ratio * min(main["peak"], other["peak"]):
            wrong.append(f"peak {other['peak']:.6g}, of the scene itself {main['peak']:.6g}, allowed ratio {ratio:.2g}")
    return wrong


def false_reason(scene, result):
    """True if a run says that nothing holds a block that has an equilibrium under its dead loads."""
    # "Newton's method found no equilibrium" says that there is one, and that the run did not find it.
    said = result.said.replace("Newton's method found no equilibrium", "")
    told = any(text in said for text in ("free to move", "bear no more", "no equilibrium"))
    return told and scene.under_dead_load() and not scene.has_no_answer()


def stop_is_told(result):
    """True if a run that did not come to its end says why."""
    return result.code in (2, 3) and len(result.reason) > 20
