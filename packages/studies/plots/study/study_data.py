# Results of a study. argument: the directory of `mortise study`
import json

directory = sys.argv[1]
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
