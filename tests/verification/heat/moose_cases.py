"""Thermal contact of MOOSE's tests as scenes of Mortise, beside the numbers that MOOSE has as right.

usage: moose_cases.py MORTISE DIRECTORY [PAGE]

The numbers are those of the folders `gold` in https://github.com/idaholab/moose, modules/heat_conduction/test/tests/gap_heat_transfer_mortar and
modules/combined/test/tests/gap_heat_transfer_mortar/{small-2d, finite-2d}, which name the case; units m, N, s, K. PAGE takes the table of them.
"""
import sys

from heat_scenes import Runs, block, put

STEEL, ALUMINIUM = (1.93e11, 0.29, 8e3, 16.2, 0.5, 17.3e-6), (6.8e10, 0.36, 2.7e3, 210, 0.9, 24e-6)


def harmonic(a, b):
    return 2 * a * b / (a + b)


def metal(properties, law, expands, acts="reference"):
    modulus, ratio, density, conductivity, capacity, expansion = properties
    result = {"type": law, "young's modulus": modulus, "poisson's ratio": ratio, "density": density,
              "heat": {"conductivity": conductivity, "conductivity acts in": acts, "specific heat": capacity}}
    if expands:
        result["thermomechanics"] = {"reference temperature": 300, "expansion coefficient": expansion}
    return result


def two_blocks(length, cells, law, expands, hardnesses, initial, left, right, analysis="transient"):
    """Steel on the left, aluminium on the right, both 0.5 high; a conductance in proportion to the pressure, of harmonic means."""
    return {
        "kinematics": "plane strain",
        "materials": {"steel": metal(STEEL, law, expands), "aluminium": metal(ALUMINIUM, law, expands)},
        "bodies": {"steel": {"material": "steel", "mesh": block(length, 0.5, *cells[0])},
                   "aluminium": {"material": "aluminium", "mesh": block(length, 0.5, *cells[1], x=length)}},
        "boundary conditions": {"foot of steel": {"set": "steel/bottom", "y": 0}, "foot of aluminium": {"set": "aluminium/bottom", "y": 0},
                                "wall": {"set": "aluminium/right", "x": 0}},
        "contact": {"joint": {"slave": "aluminium/left", "master": "steel/right", "search reach": 0.05, "heat": {"conductance": {
            "type": "power", "factor": harmonic(STEEL[3], ALUMINIUM[3]), "hardness": harmonic(*hardnesses), "exponent": 1}}}},
        "heat": {"analysis": analysis, "initial temperature": initial, "temperatures": {
            "left": {"set": "steel/left", "temperature": left}, "right": {"set": "aluminium/right", "temperature": right}}},
        "output": {"fields": ""},
    }


def of_faces():
    """What MOOSE's cases have of cells of 0.025: temperatures of nodes 245 and 657 (at y = 0.25), and k grad theta of the first cells."""
    point = lambda x, body: {"type": "temperature", "x": x, "y": 0.25, "body": body}
    return {"steel": point(1.0, "steel"), "before": point(0.975, "steel"), "face": point(1.0, "aluminium"), "aluminium": point(1.025, "aluminium"),
            "flux_of_steel": {"type": "formula", "value": "-16.2*(steel - before)/0.025"},
            "flux_of_aluminium": {"type": "formula", "value": "210*(aluminium - face)/0.025"}, "balance": {"type": "heat balance"}}


# Node 657 is one cell within the aluminium where contact adds no cells of its own to the mesh, on its face elsewhere.
OF_FACES = {"flux of the aluminium's face": "flux_of_aluminium", "flux of the steel's face": "flux_of_steel", "temperature in the aluminium": "aluminium",
            "temperature of the steel's face": "steel"}
AT_FACES = {**OF_FACES, "temperature in the aluminium": "face"}


def prescribed_pressure():
    scene = two_blocks(1, ((40, 10), (40, 10)), "small strain linear", False, (129, 15), 525, 800, 250, "steady")
    put(scene, "loads/press", {"type": "dead traction", "set": "steel/left", "x": 100})
    scene["quantities"] = of_faces()
    return scene


def small_strain(first_step_open):
    """Blocks that touch are pressed on each other by 1.8e-11 in the first step. Here this and the hardness, 1, are 1e5 times as large: 1.8e-11 is round-off."""
    scene = two_blocks(1, ((40, 10), (40, 10)), "small strain linear", False, (1e5, 1e5), 525, 800, 250)
    put(scene, "boundary conditions/push", {"set": "steel/left", "x": 1.8e-6})
    if first_step_open:
        put(scene, "contact/joint/clearance", "1e-4*max(2 - t/60, 0)")
    scene["stepping"] = {"step": 60, "end time": 240, "predictor": "none"}
    scene["quantities"] = of_faces()
    return scene


def expanding():
    scene = two_blocks(1, ((40, 10), (40, 10)), "hencky", True, (129, 15), 300, 300, 800)
    for name, properties in (("steel", STEEL), ("aluminium", ALUMINIUM)):
        scene["materials"][name] = metal(properties, "hencky", True, "current")
    put(scene, "boundary conditions/push", {"set": "steel/left", "x": "2e-7*t"})
    scene["stepping"] = {"step": 2, "end time": 10}
    scene["quantities"] = of_faces()
    return scene


def varied_pressure():
    scene = two_blocks(0.25, ((20, 10), (20, 13)), "hencky", False, (129, 15), 300, 300, 800)
    put(scene, "loads/press", {"type": "dead traction", "set": "steel/left", "x": "1e4*t*y"})
    scene["stepping"] = {"step": 0.125, "end time": 1}
    pressure = lambda which: {"type": "extremum", "field": "contact pressure", "which": which}
    temperature = lambda which: {"type": "extremum", "field": "temperature", "on": "aluminium/left", "which": which}
    # Nodes at the ends, which have the largest and the smallest pressure, stand for half a facet: the mean of the 14 nodes follows from the force 1250 t.
    scene["quantities"] = {"largest": pressure("maximum"), "smallest": pressure("minimum"),
                           "mean": {"type": "formula", "value": "(26*1250*t + (largest + smallest)/2)/14"},
                           "hottest": temperature("maximum"), "coldest": temperature("minimum"),
                           "mean temperature": {"type": "mean", "field": "temperature", "on": "aluminium/left"}, "balance": {"type": "heat balance"}}
    return scene


def sliding_block(gap_conductivity, closest, left=-0.3):
    """A block beside a plank goes to and fro, and along it; steady, with a medium in the gap, in the current places. MOOSE's least gap is 1e-6."""
    law = lambda k: {"type": "small strain linear", "young's modulus": 1e7, "poisson's ratio": 0.3, "heat": {"conductivity": k}}
    mean = lambda on: {"type": "mean", "field": "temperature", "on": on}
    columns = [round(left + 0.61 + 0.2 * i, 12) for i in range(4)]
    radii = [1, 2, 2, 1] if left < 0 else [(2 * columns[0] + columns[1]) / 3, 2 * columns[1], 2 * columns[2], (columns[2] + 2 * columns[3]) / 3]
    near = lambda x: f"0.01 - abs(x - {x})"
    return {
        "kinematics": "plane strain", "materials": {"plank": law(2), "block": law(1)},
        "bodies": {"plank": {"material": "plank", "mesh": block(0.6, 20, 2, 67, left, -10)}, "block": {"material": "block", "mesh": block(0.6, 0.8, 3, 4, columns[0], 7.7)}},
        "sets": {**{f"column {i}": {"of": "block", "where": near(x)} for i, x in enumerate(columns)},
                 **{f"ends {i}": {"of": "block/bottom, block/top", "where": near(x)} for i, x in enumerate(columns)}},
        "boundary conditions": {"wall": {"set": "plank/left", "x": 0}, "foot": {"set": "plank/bottom", "y": 0},
                                "drive": {"set": "block/right", "x": "-0.04*sin(4*(t + 1.5)) + 0.02", "y": "-t"}},
        "contact": {"joint": {"slave": "block/left", "master": "plank/right", "search reach": 0.2, "heat": {
            "conductance": {"type": "constant", "value": gap_conductivity / closest},
            "gap conductance": {"type": "medium", "conductivity": gap_conductivity, "distance": closest}}}},
        "heat": {"analysis": "steady", "initial temperature": 0, "temperatures": {
            "hot": {"set": "plank/left", "temperature": 400}, "cold": {"set": "block/right", "temperature": 300}}},
        "stepping": {"step": 0.1, "end time": 4, "output times": ", ".join(f"{0.1 * i:.1f}" for i in range(1, 40))}, "output": {"fields": ""},
        # The mean over the block of 3 times 4 equal cells, from those over its columns of 5 nodes and their ends.
        "quantities": {**{f"column_{i}": mean(f"column {i}") for i in range(4)}, **{f"ends_{i}": mean(f"ends {i}") for i in range(4)},
                       "mean": {"type": "formula", "value": "(" + " + ".join(f"{radii[i]!r}*(5*column_{i} - ends_{i})/4" for i in range(4)) + f")/{sum(radii)!r}"},
                       "closed": {"type": "active count"}},
    }


def around(scene):
    """The same about an axis of revolution, which is the plank's left side."""
    put(scene, "kinematics", "axisymmetric")
    return scene


# Columns of MOOSE's files at each step, from the first on.
PRESCRIBED = {"flux of the aluminium's face": [-7292.0186846471], "flux of the steel's face": [7292.0186662386],
              "temperature in the aluminium": [283.85580189521], "temperature of the steel's face": [349.87541761867]}
SMALL = {"flux of the aluminium's face": [-126.79681410608, -6243.2152663844, -5797.7533879839, -5660.5366418375],
         "flux of the steel's face": [59.267668068393, 6153.4544400911, 5782.7164281867, 5655.8116806037],
         "temperature in the aluminium": [274.54218894081, 279.79845747129, 277.73745580107, 277.00159201603],
         "temperature of the steel's face": [596.09071419843, 482.1971190453, 465.58479574915, 460.42385174134]}
EXPANDING = {"flux of the aluminium's face": [12902.362108947, 21288.397134234, 24353.940520004, 24684.135994217, 23891.058441729],
             "flux of the steel's face": [-10434.772411365, -18367.450894321, -21957.819116342, -22920.92934221, -22633.939083134],
             "temperature in the aluminium": [366.22280528286, 445.3846323831, 511.73173928598, 562.28170628734, 600.11203087792],
             "temperature of the steel's face": [366.22260053339, 445.38380858833, 511.7302362449, 562.27971558882, 600.10976354801]}
VARIED = {"mean pressure of the nodes": [314.77765441935, 629.55530767074, 944.33296135454, 1259.1106143133, 1573.8882680433, 1888.6659238013, 2203.4435732458,
                                         2518.2212281017],
          "largest pressure": [533.80516426751, 1067.6102934879, 1601.4154382549, 2135.2204887576, 2669.0256550479, 3202.8307925739, 3736.635834464,
                               4270.4409346099],
          "smallest pressure": [154.96915800954, 309.93831543374, 464.90746648911, 619.87668857734, 774.84581354548, 929.81502113028, 1084.7841446435,
                                1239.7533584917],
          "mean temperature": [380.47553983879, 465.91457111718, 531.27911469388, 578.0950174142, 611.85834222333, 636.82533518149, 655.7892872253,
                               670.55149429082],
          "highest temperature": [383.1913082182, 472.22826925117, 538.7512730643, 584.78746745502, 617.07203866764, 640.57912906772, 658.35591194033,
                                  672.23368039913],
          "lowest temperature": [377.62591887742, 459.93811959793, 524.69270848156, 572.46262644862, 607.60332222702, 633.83543102025, 653.79797622438,
                                 669.29446357508]}
OF_VARIED = {"mean pressure of the nodes": "mean", "largest pressure": "largest", "smallest pressure": "smallest", "mean temperature": "mean temperature",
             "highest temperature": "hottest", "lowest temperature": "coldest"}
LOW = [337.21658, 337.83041, 338.56249, 338.53451, 338.47895, 338.57630, 338.12797, 337.31031, 336.70813, 336.00135, 335.43162, 335.28538, 335.25010, 335.44071,
       336.05591, 336.67692, 337.32918, 338.19804, 338.51470, 338.48990, 338.60416, 338.50461, 337.82198, 337.24574, 336.44660, 335.75974, 335.44992, 335.20985,
       335.23259, 335.68599, 336.17874, 336.81009, 337.70709, 338.29607, 338.48769, 338.61885, 338.51690, 338.27547, 337.78452, 336.94625]
HIGH = [338.45828, 338.33364, 338.56255, 338.53465, 338.47902, 338.57637, 338.46178, 338.32993, 338.49843, 338.43519, 338.30965, 338.48380, 338.42292, 338.31077,
        338.49513, 338.43638, 338.33317, 338.52066, 338.51480, 338.48998, 338.60423, 338.50467, 338.34083, 338.51423, 338.42392, 338.31948, 338.49515, 338.40604,
        338.31467, 338.49960, 338.41430, 338.33441, 338.52398, 338.43396, 338.48777, 338.61891, 338.51702, 338.35320, 338.52753, 338.41321]
ROUND = [320.06366, 320.44957, 321.00881, 320.98291, 320.94726, 321.02784, 320.69614, 320.10699, 319.74971, 319.27107, 318.87585, 318.81679, 318.78420, 318.88216,
         319.31985, 319.71440, 320.12179, 320.76332, 320.96797, 320.95603, 321.05891, 320.95846, 320.45696, 320.11365, 319.55966, 319.08862, 318.92514, 318.75499,
         318.75047, 319.07919, 319.38201, 319.77670, 320.42832, 320.80696, 320.95035, 321.07255, 320.97639, 320.77076, 320.48206, 319.88687]
CLOSED = [5 if step in (3, 4, 5, 6, 19, 20, 21, 22, 35, 36, 37) else 0 for step in range(1, 41)]
OF_BLOCK = {"mean temperature of the block": "mean", "closed nodes": "closed"}

VOLUME = "MOOSE has the density in the volume that it is now, so that mass and capacity grow as bodies expand"
NODES = "the jump of temperatures and the pressure count node by node, in MOOSE point by point; cells a third as large change these numbers by as much"
PLANK = "discretisation: cells of the plank a third as large change the temperature by 3e-3 to 4e-3"
FIRST = "MOOSE's first step ends before contact has closed: forces of 1 N are below its tolerance, which heat sets"
# Name in MOOSE, what it is, the scene, MOOSE's numbers, the quantity of each, bounds of the largest differences over the largest number (of temperatures
# over the range between hot and cold), the cause of what is left.
CASES = [
    ("closed_gap_prescribed_pressure", "two blocks under a pressure of 100, steady", prescribed_pressure(), PRESCRIBED, OF_FACES, 550, [1e-7], ""),
    ("closed_gap_pressure_dependent_thermal_contact", "two blocks pressed by a displacement, transient; open in the first step",
     small_strain(True), SMALL, AT_FACES, 550, [5e-6], FIRST),
    ("closed_gap_thermomechanical_mortar_contact", "two blocks that expand, hypoelastic in MOOSE, Hencky here",
     expanding(), EXPANDING, AT_FACES, 500, [1e-2], VOLUME),
    ("varied_pressure_thermomechanical_mortar", "meshes that do not match, under a pressure that grows along the joint",
     varied_pressure(), VARIED, OF_VARIED, 500, [1e-6, 1e-6, 1e-6, 1e-4, 5e-4, 5e-4], NODES),
    ("small-2d, first_low_k", "a block that slides along a plank, with a gap of conductivity 1",
     sliding_block(1, 1e-6), {"mean temperature of the block": LOW, "closed nodes": CLOSED}, OF_BLOCK, 100, [4e-3, 0], PLANK),
    ("small-2d, first_high_k", "the same, of conductivity 100",
     sliding_block(100, 1e-4), {"mean temperature of the block": HIGH, "closed nodes": CLOSED}, OF_BLOCK, 100, [4e-3, 0], PLANK),
    ("small-2d-rz, first_low_k", "the same about an axis, of conductivity 1",
     around(sliding_block(1, 1e-6, 0)), {"mean temperature of the block": ROUND, "closed nodes": CLOSED}, OF_BLOCK, 100, [4e-3, 0], PLANK),
]


def differences(columns, step, gold, names, span):
    """Of each quantity: the last number of MOOSE and of Mortise, and the largest difference over all steps, over its scale. Steps may have been cut."""
    for text, numbers in gold.items():
        at = {round(time / step, 6): value for time, value in zip(columns["time"], columns[names[text]])}
        ours = [at[place] for place in range(1, len(numbers) + 1)]
        scale = span if "temperature" in text else max(map(abs, numbers))
        yield text, numbers[-1], ours[-1], max(abs(a - b) for a, b in zip(ours, numbers)) / scale


def compare(runs, check, cases):
    """Runs cases; rows of the table."""
    rows = []
    for name, what, scene, gold, names, span, bounds, cause in cases:
        code, said, _, columns = runs.run("moose_" + name.replace(" ", "_").replace(",", ""), scene)
        if code != 0:
            check(False, f"{name}: exit code {code}: {said.strip().splitlines()[-1]}")
            continue
        for place, (text, theirs, ours, apart) in enumerate(differences(columns, scene["stepping"]["step"] if "stepping" in scene else 1, gold, names, span)):
            bound = bounds[min(place, len(bounds) - 1)]
            check(apart <= bound, f"{name}: {text}: {ours:.9g}, MOOSE {theirs:.9g}, apart by {apart:.1e} over {len(gold[text])} steps")
            first = lambda words: words if place == 0 else ""
            rows.append(f"| {first(name)} | {first(what)} | {text} | {theirs:.8g} | {ours:.8g} | {apart:.1e} | {first(cause)} |")
    return rows


def main():
    runs, failures = Runs(*sys.argv[1:3]), 0

    def check(holds, text):
        nonlocal failures
        failures += not holds
        print(("ok      " if holds else "FAILED  ") + text, flush=True)

    rows = compare(runs, check, CASES)
    if len(sys.argv) > 3:
        with open(sys.argv[3], "w", encoding="utf-8") as file:
            file.write("\n".join(rows) + "\n")
    sys.exit(failures > 0)


if __name__ == "__main__":
    main()
