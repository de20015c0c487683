# What a study gave. argument: the directory of `mortise study`
import json

directory = sys.argv[1]
os.makedirs(os.path.join(directory, "plots"), exist_ok=True)
with open(os.path.join(directory, "study.json"), encoding="utf-8") as file:
    study = json.load(file)
points, curves, errors = study["points"], study["curves"], study["errors"]


def array(values):
    """null is not a number."""
    return np.array([np.nan if value is None else value for value in values], dtype=float)


def column(name):
    return array([point[name] for point in points])


wall, h = column("wall_s"), column("h")
finished = [i for i, point in enumerate(points) if point["finished"]]


def percent(error):
    return f"{100 * error:g} %"


# Where the wall time of a run goes: title, timers of the summary, and a timer that is a part of them but stands elsewhere.
EFFECTS = [
    ("meshes and output", ["mesh", "output"], None), ("bodies and loads", ["bulk", "loads"], None), ("contact search", ["search"], None),
    ("contact", ["contact"], "search"), ("condensation", ["condensation"], None), ("factorisation", ["linear_setup"], None),
    ("linear solves", ["linear_solve"], None)]
REST, PROCESS = "other", "start and end of the process"


def split(point):
    """Seconds by effect; what no timer of these has counted, and what the process took besides, come last."""
    time = point["time"]
    shares = {title: max(0.0, sum(time.get(one, 0.0) for one in timers) - time.get(elsewhere, 0.0)) for title, timers, elsewhere in EFFECTS}
    shares[REST] = max(0.0, time.get("total", 0.0) - sum(shares.values()))
    shares[PROCESS] = max(0.0, point["wall_s"] - time.get("total", 0.0))
    return shares
