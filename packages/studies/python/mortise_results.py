"""Reads what `mortise run` left in a directory.

    import mortise_results

    run = mortise_results.open("results/hertz_elastic")
    run.summary["quantities"]["peak_pressure"]
    run.history["time"], run.history["peak_pressure"]
    run.mesh.nodes + run.field("displacement")          # where the nodes are at the last step
    run.field("cauchy_stress.xx", step=12)              # xx of each element at step 12
    run.field("von_mises", step=12)

Needs numpy and h5py. Tables are pandas' data frames where pandas is installed, else dictionaries of numpy arrays: `run.history["time"]` is the column
in both. Values have the units of the scene. Files are read when they are asked for, one step at a time; a run that goes on may be read.
"""
import csv as _csv
import difflib as _difflib
import json as _json
import os as _os
import re as _re
import xml.etree.ElementTree as _xml
from builtins import open as _open_file
from dataclasses import dataclass

import h5py as _h5py
import numpy as np

__all__ = ["open", "Run", "Mesh", "Shape", "SHAPES", "TENSOR", "ResultsError", "FileProblem", "UnknownName", "von_mises"]


class ResultsError(Exception):
    """Results of a run that cannot be had. The text says where, what and what there is."""


class FileProblem(ResultsError):
    """A directory or file that is missing or damaged."""


class UnknownName(ResultsError):
    """A step, a field or a part of a field that the run does not have."""


@dataclass(frozen=True)
class Shape:
    """A shape of cells. Corners come first, then mid-side nodes."""

    name: str
    nodes: int
    dimension: int


#: XDMF's number of a shape, as it stands in mesh.h5, -> Shape
SHAPES = {2: Shape("line2", 2, 1), 4: Shape("triangle3", 3, 2), 5: Shape("quadrilateral4", 4, 2), 6: Shape("tetrahedron4", 4, 3),
          7: Shape("pyramid5", 5, 3), 8: Shape("wedge6", 6, 3), 40: Shape("wedge15", 15, 3), 9: Shape("hexahedron8", 8, 3), 36: Shape("triangle6", 6, 2), 37: Shape("quadrilateral8", 8, 2), 38: Shape("tetrahedron10", 10, 3),
          48: Shape("hexahedron20", 20, 3)}
_POLYLINE = 2  # its number of nodes follows the number of the shape
# XDMF's wedges begin with the triangle that Mortise has at the top
_OURS = {8: [3, 4, 5, 0, 1, 2], 40: [3, 4, 5, 0, 1, 2, 9, 10, 11, 6, 7, 8, 12, 13, 14]}

#: order of the components of symmetric tensors
TENSOR = ("xx", "xy", "xz", "yy", "yz", "zz")
_VECTOR = ("x", "y", "z")


@dataclass(frozen=True)
class Mesh:
    """The mesh of a run in its reference configuration.

    nodes   positions [nodes x 3]
    cells   name of a shape -> nodes of its cells [cells x nodes of the shape]
    ids     name of a shape -> ids of these cells [cells]: rows of fields on elements
    body    index of the body of each cell, by id [all cells]
    bodies  names of the bodies
    """

    nodes: np.ndarray
    cells: dict
    ids: dict
    body: np.ndarray
    bodies: list

    @property
    def dimension(self):
        """3 if there are solids, else 2."""
        return max((shape.dimension for shape in SHAPES.values() if shape.name in self.cells and shape.dimension > 1), default=2)

    def is_rigid(self, shape):
        """True if cells of the shape of this name are surfaces of rigid bodies: they have a dimension less than the bodies that deform.
        Throws UnknownName."""
        found = [one for one in SHAPES.values() if one.name == shape]
        if not found:
            raise UnknownName(f'there is no shape "{shape}"; there are {", ".join(one.name for one in SHAPES.values())}')
        return found[0].dimension < self.dimension

    def body_index(self, name):
        """Index of the body of this name. Throws UnknownName."""
        if name not in self.bodies:
            raise UnknownName(_unknown("body", name, self.bodies))
        return self.bodies.index(name)


def open(directory):
    """The run that left its results in the directory. Throws FileProblem if no run did."""
    return Run(directory)


class Run:
    """Results of one run. Members that read a file throw FileProblem if it is missing or damaged."""

    def __init__(self, directory):
        self.directory = _os.fspath(directory)
        self._cached = {}
        if not _os.path.isdir(self.directory):
            raise FileProblem(f"{self.directory}: there is no such directory; please give the directory of the results of a run")
        if not any(_os.path.exists(self.path(name)) for name in ("history.csv", "summary.json", "fields")):
            raise FileProblem(f"{self.directory} holds no results of a run: neither history.csv nor summary.json nor fields; "
                              "please give the directory that `mortise run` wrote to")

    def path(self, name):
        """Path of a file of the run."""
        return _os.path.join(self.directory, name)

    def _once(self, name, read):
        if name not in self._cached:
            self._cached[name] = read()
        return self._cached[name]

    @property
    def summary(self):
        """summary.json as a dictionary. It is written at the end of a run."""

        def read():
            try:
                with _open_file(self.path("summary.json"), encoding="utf-8") as file:
                    return _json.load(file)
            except OSError as error:
                raise FileProblem(f"{error.filename}: {error.strerror}; a run writes it at its end") from None
            except ValueError as error:
                raise FileProblem(f"{self.path('summary.json')} is damaged: {error}") from None

        return self._once("summary", read)

    @property
    def history(self):
        """Quantities after every step: columns step, time, newton_iterations and one of each quantity."""
        return self._once("history", lambda: _table(self.path("history.csv")))

    @property
    def newton(self):
        """Newton's iterations, also of steps that were undone."""
        return self._once("newton", lambda: _table(self.path("newton.csv")))

    @property
    def profiles(self):
        """Contact along slave surfaces in 2D. The run writes it if its scene has `contact profiles` in the list `output`."""
        if not _os.path.exists(self.path("profiles.csv")):
            raise FileProblem(f"{self.path('profiles.csv')}: there is no such file; a run in 2D writes it if its scene says "
                              '"contact profiles" = true in the list "output"')
        return self._once("profiles", lambda: _table(self.path("profiles.csv")))

    @property
    def title(self):
        """Name of the scene, or of the directory if effective.xml does not say it."""
        return self._scene.get("name") or _os.path.basename(_os.path.abspath(self.directory))

    @property
    def kinematics(self):
        """"plane strain", "plane stress", "axisymmetric" or "three dimensional"; "" if effective.xml does not say it."""
        return next((one.get("value", "") for one in self._scene.findall("Parameter") if one.get("name") == "kinematics"), "")

    @property
    def _scene(self):
        def read():
            try:
                return _xml.parse(self.path("effective.xml")).getroot()
            except (OSError, _xml.ParseError):
                return _xml.Element("ParameterList")

        return self._once("scene", read)

    @property
    def mesh(self):
        """The mesh, in its reference configuration."""
        return self._once("mesh", lambda: _read_mesh(self.path("fields/mesh.h5"), self.path("fields.xdmf")))

    @property
    def steps(self):
        """Numbers of the steps with fields, ascending."""
        try:
            names = _os.listdir(self.path("fields"))
        except OSError:
            names = []
        return sorted(int(found[1]) for found in map(_re.compile(r"step-(\d{6,})\.h5").fullmatch, names) if found)

    def time(self, step=None):
        """Pseudo-time of a step, by default of the last one that has fields."""
        with self._step(step) as file:
            return float(file.attrs["time"])

    def fields(self, step=None):
        """Names of the fields of a step -> "node" or "cell"."""
        with self._step(step) as file:
            return {name: _text(file[name].attrs["center"]) for name in file}

    def field(self, name, step=None):
        """Values of a field at a step, by default the last one that has fields: a row for each node or element, in the order of their ids.

        Scalars and integers are one-dimensional, vectors [rows x 3], symmetric tensors [rows x 6] in the order of TENSOR. "displacement.y" and
        "cauchy_stress.xy" are components, "displacement.magnitude" is a length. "cauchy_stress.von_mises" is von Mises' stress of a row;
        "von_mises" without such a field is that of the elements. Throws UnknownName with what there is.
        """
        return self.center_and_values(name, step)[1]

    def center_and_values(self, name, step=None):
        """("node" or "cell", values of field())."""
        with self._step(step) as file:
            whole, _, part = name.partition(".")
            if whole == "von_mises" and whole not in file and "cauchy_stress" in file:
                whole, part = "cauchy_stress", part or "von_mises"
            if whole not in file:
                raise UnknownName(f"step {int(file.attrs['step'])}: " + _unknown("field", whole, list(file)))
            kind, center = _text(file[whole].attrs["kind"]), _text(file[whole].attrs["center"])
            values = file[whole][:]
        rows = len(self.mesh.nodes if center == "node" else self.mesh.body)
        if len(values) != rows:
            raise FileProblem(f"{self.path('fields')}: the field \"{whole}\" has {len(values)} rows, but the mesh has {rows} of its {center}s; "
                              "please run the scene again")
        return center, _part(whole, kind, values, part)

    def _step(self, step):
        steps = self.steps
        if not steps:
            raise FileProblem(f"{self.path('fields')} holds no fields of any step: either no step has been written yet, or \"fields\" in the list "
                              '"output" of the scene is empty')
        step = steps[-1] if step is None else step
        if step not in steps:
            raise UnknownName(f"{self.directory} has no fields of step {step!r}; there are steps {_ranges(steps)}")
        return _StepFile(self.path(f"fields/step-{step:06}.h5"))


class _StepFile:
    """An open file of a step; what is wrong with it is a FileProblem."""

    def __init__(self, path):
        self._path = path

    def __enter__(self):
        self._file = _h5(self._path)
        return self._file

    def __exit__(self, kind, error, trace):
        self._file.close()
        if kind is not None and issubclass(kind, (OSError, KeyError, RuntimeError)):
            raise FileProblem(f"{self._path} is damaged: {error}; please run the scene again") from None


def _h5(path):
    try:
        return _h5py.File(path, "r")
    except OSError as error:
        raise FileProblem(f"{path} cannot be read: {error}; please run the scene again") from None


def _text(value):
    return value.decode() if isinstance(value, bytes) else str(value)


def _part(name, kind, values, part):
    """A component, the magnitude or von Mises' stress of a field; all of it if no part is named."""
    if not part:
        return values
    parts = {}
    if kind == "vector":
        parts = {one: lambda i=i: values[:, i] for i, one in enumerate(_VECTOR)}
        parts["magnitude"] = lambda: np.linalg.norm(values, axis=1)
    elif kind == "symmetric tensor":
        parts = {one: lambda i=i: values[:, i] for i, one in enumerate(TENSOR)}
        if name.endswith("stress"):
            parts["von_mises"] = lambda: von_mises(values)
    if part not in parts:
        raise UnknownName(_unknown(f'part of the {kind} field "{name}" named', part, list(parts)))
    return parts[part]()


def von_mises(stress):
    """sqrt(3/2 s : s) with s the deviator of tensors [rows x 6] in the order of TENSOR."""
    xx, xy, xz, yy, yz, zz = np.asarray(stress).T
    return np.sqrt(0.5 * ((xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2) + 3 * (xy**2 + xz**2 + yz**2))


def _unknown(what, name, known):
    close = _difflib.get_close_matches(name, known, 1)
    hint = f'; did you mean "{close[0]}"? There are: ' if close else "; there are: "
    return f'there is no {what} "{name}"' + (hint + ", ".join(f'"{one}"' for one in known) if known else "; there is none")


def _ranges(numbers):
    """1 to 4, 6, 8 to 10"""
    parts, begin = [], 0
    for i in range(1, len(numbers) + 1):
        if i == len(numbers) or numbers[i] != numbers[i - 1] + 1:
            parts.append(str(numbers[begin]) if i == begin + 1 else f"{numbers[begin]} to {numbers[i - 1]}")
            begin = i
    return ", ".join(parts)


def _column(texts):
    """Numbers if all are, whole ones if all are whole; an empty text is not a number; else texts."""
    for read in (int, lambda text: float(text) if text else np.nan):
        try:
            return np.array([read(text) for text in texts])
        except ValueError:
            pass
    return np.array(texts, dtype=object)


def _table(path):
    try:
        with _open_file(path, encoding="utf-8", newline="") as file:
            rows = list(_csv.reader(file))
    except OSError as error:
        raise FileProblem(f"{error.filename}: {error.strerror}") from None
    except (ValueError, _csv.Error) as error:
        raise FileProblem(f"{path} is damaged: {error}") from None
    if not rows:
        raise FileProblem(f"{path} is empty")
    for line, row in enumerate(rows[1:], 2):
        if len(row) != len(rows[0]):
            raise FileProblem(f"{path}, row {line}: {len(row)} entries, but there are {len(rows[0])} columns")
    columns = {name: _column(texts) for name, texts in zip(rows[0], zip(*rows[1:]) if len(rows) > 1 else [()] * len(rows[0]))}
    try:
        import pandas
    except ImportError:
        return columns
    return pandas.DataFrame(columns)


def _read_mesh(path, index):
    with _h5(path) as file:
        try:
            nodes, topology, body = (file[name][:] for name in ("coordinates", "topology", "body"))
        except (OSError, KeyError, RuntimeError) as error:
            raise FileProblem(f"{path} is damaged: {error}; please run the scene again") from None
    cells, ids = {}, {}
    at = element = 0
    while at < len(topology):
        number = int(topology[at])
        if number not in SHAPES:
            raise FileProblem(f"{path} is damaged: element {element} has the shape {number}, which is none of XDMF's numbers that a run writes")
        head, shape = (2 if number == _POLYLINE else 1), SHAPES[number]
        width = head + shape.nodes
        count = _run_length(topology, at, width, number)
        block = topology[at : at + count * width]
        if len(block) < count * width:
            raise FileProblem(f"{path} is damaged: its topology ends within element {element + count - 1}")
        block = block.reshape(count, width)[:, head:]
        if block.min() < 0 or block.max() >= len(nodes):
            raise FileProblem(f"{path} is damaged: nodes {block.min()} to {block.max()} in its topology, but there are {len(nodes)} nodes")
        cells.setdefault(shape.name, []).append(block[:, _OURS[number]] if number in _OURS else block)
        ids.setdefault(shape.name, []).append(np.arange(element, element + count))
        at, element = at + count * width, element + count
    if len(body) != element:
        raise FileProblem(f"{path} is damaged: {element} elements in its topology, but {len(body)} have a body")
    bodies = _body_names(index)
    bodies += [f"body {i}" for i in range(len(bodies), int(body.max(initial=-1)) + 1)]
    return Mesh(nodes, {name: np.concatenate(one) for name, one in cells.items()}, {name: np.concatenate(one) for name, one in ids.items()}, body, bodies)


def _run_length(topology, at, width, number):
    """Number of elements of this shape that follow one another from `at` on; elements of one body do."""
    found, window = 1, 64
    while True:
        heads = topology[at + found * width : at + (found + window) * width : width]
        other = np.flatnonzero(heads != number)
        if len(other) or len(heads) < window:
            return found + (int(other[0]) if len(other) else len(heads))
        found, window = found + window, 2 * window


def _body_names(index):
    """From the head of the index, which does not have to be whole."""
    names = []
    try:
        for _, element in _xml.iterparse(index, events=("start",)):
            if element.tag == "Information":
                names.append(element.get("Value", ""))
            elif element.tag == "Grid":
                break
    except (OSError, _xml.ParseError):
        pass
    return names
