"""Files of a run in its directory, for tests of runs that are cut, killed and restarted."""
import csv
import glob
import math
import os
import re

RELATIVE = ("error", "imbalance", "spread", "oscillation", "penetration")  # quantities whose scale is at least 1
ROUND_OFF = 1e-8  # quantities that are never larger are sums that cancel: their scale is 1, that of the numbers in the scenes


def table(path):
    """Rows of a table, its names first; none if there is no such file."""
    try:
        with open(path, encoding="utf-8", newline="") as file:
            return list(csv.reader(file))
    except OSError:
        return []


def rows(results):
    """Rows of history.csv, without its names."""
    return table(os.path.join(results, "history.csv"))[1:]


def checkpoints(results):
    """Steps of the checkpoints, ascending."""
    files = glob.glob(os.path.join(results, "checkpoints", "step-*.h5"))
    return sorted(int(re.search(r"step-(\d+)\.h5", file).group(1)) for file in files)


def worst_difference(one, other):
    """The largest difference of two runs' quantities, over the scale of each, and which it is. The scale is its largest value, or 1 as said above.
    Infinite if rows are missing or Newton iterations differ."""
    left, right = table(os.path.join(one, "history.csv")), table(os.path.join(other, "history.csv"))
    if len(left) != len(right) or left[:1] != right[:1]:
        return math.inf, f"{len(left)} and {len(right)} rows"
    worst, where = 0.0, ""
    for name, first, second in zip(left[0], zip(*left[1:]), zip(*right[1:])):
        first, second = [float(value) for value in first], [float(value) for value in second]
        if name == "newton_iterations" and first != second:
            return math.inf, name
        finite = [abs(value) for value in first if math.isfinite(value)]
        scale = max(finite, default=0.0)
        if scale <= ROUND_OFF or any(word in name for word in RELATIVE):
            scale = max(scale, 1.0)
        for a, b in zip(first, second):
            difference = 0.0 if a == b or (math.isnan(a) and math.isnan(b)) else abs(a - b) / scale
            if not difference <= worst:
                worst, where = difference, name
    return worst, where


def same(one, other):
    """True if two runs agree to 1e-9, iterations included."""
    return worst_difference(one, other)[0] <= 1e-9
