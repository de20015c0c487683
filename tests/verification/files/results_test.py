"""The python module mortise_results, on files that are known and on runs, against h5py and csv.

Arguments: the program, directory of the module, inputs, a directory for results. Exit code 69 without numpy and h5py.
"""
import csv
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

try:
    import h5py
    import numpy as np
except ImportError:
    sys.exit(69)

mortise, module, inputs, scratch = (sys.argv.pop(1) for _ in range(4))
sys.path.insert(0, module)
import mortise_results


def run_of(scene, name, *settings):
    """Results of a scene, which is run once."""
    directory = os.path.join(scratch, name)
    if not os.path.exists(os.path.join(directory, "summary.json")):
        words = [word for setting in settings for word in ("--set", setting)]
        ending = subprocess.run([mortise, "run", os.path.join(inputs, scene), "-o", directory, "--quiet", *words], stdout=subprocess.PIPE,
                                stderr=subprocess.STDOUT, text=True, check=False)
        if ending.returncode not in (0, 4):
            raise AssertionError(ending.stdout)
    return directory


def flat():
    return run_of("paper/hertz_elastic.xml", "flat", "variables/n=2", "variables/steps=4", "stepping/output times=0.5")


def solid():
    return run_of("verification/3d/patch_test_quadratic.xml", "solid")


class OfRuns(unittest.TestCase):
    def test_tables_are_those_of_the_files(self):
        directory = flat()
        run = mortise_results.open(directory)
        for name in ("history", "newton", "profiles"):
            with open(os.path.join(directory, name + ".csv"), encoding="utf-8", newline="") as file:
                rows = list(csv.DictReader(file))
            table = getattr(run, name)
            self.assertEqual(list(table), list(rows[0]))
            for column in rows[0]:
                values = list(table[column])
                self.assertEqual(len(values), len(rows))
                for value, row in zip(values, rows):
                    text = row[column]
                    if isinstance(value, str):
                        self.assertEqual(value, text)
                    elif text == "":
                        self.assertTrue(np.isnan(value))
                    else:
                        self.assertTrue(value == float(text) or np.isnan(value), (name, column, value, text))
        with open(os.path.join(directory, "summary.json"), encoding="utf-8") as file:
            self.assertEqual(run.summary, json.load(file))
        self.assertEqual(run.summary["quantities"]["peak_pressure"], list(run.history["peak_pressure"])[-1])
        self.assertEqual((run.title, run.kinematics), ("hertz, elastic", "plane strain"))

    def test_fields_are_those_of_the_files(self):
        for directory in (flat(), solid()):
            run = mortise_results.open(directory)
            files = sorted(pathlib.Path(directory, "fields").glob("step-*.h5"))
            self.assertEqual(run.steps, [int(file.stem[5:]) for file in files])
            for step, path in zip(run.steps, files):
                with h5py.File(path) as file:
                    self.assertEqual(run.time(step), file.attrs["time"])
                    self.assertEqual(set(run.fields(step)), set(file))
                    for name in file:
                        np.testing.assert_array_equal(run.field(name, step), file[name][:])
                    for i, part in enumerate(("x", "y", "z")):
                        np.testing.assert_array_equal(run.field(f"displacement.{part}", step), file["displacement"][:, i])
                    for i, part in enumerate(("xx", "xy", "xz", "yy", "yz", "zz")):
                        np.testing.assert_array_equal(run.field(f"cauchy_stress.{part}", step), file["cauchy_stress"][:, i])
                    np.testing.assert_allclose(run.field("displacement.magnitude", step), np.sqrt((file["displacement"][:] ** 2).sum(axis=1)))
            np.testing.assert_array_equal(run.field("displacement"), run.field("displacement", run.steps[-1]))

    def test_von_mises_is_that_of_the_program(self):
        run = mortise_results.open(flat())
        self.assertIn("von_mises", run.fields())
        np.testing.assert_allclose(run.field("cauchy_stress.von_mises"), run.field("von_mises"), rtol=1e-12)
        one = mortise_results.von_mises([[3, 0, 0, 0, 0, 0], [0, 0, 0, 0, 2, 0], [5, 0, 0, 5, 0, 5]])
        np.testing.assert_allclose(one, [3, 2 * np.sqrt(3), 0], atol=1e-15)

    def test_meshes_are_those_of_the_files(self):
        for directory, shapes in ((flat(), {"quadrilateral4": 4}), (solid(), {"hexahedron20": 20})):
            run = mortise_results.open(directory)
            with h5py.File(os.path.join(directory, "fields", "mesh.h5")) as file:
                np.testing.assert_array_equal(run.mesh.nodes, file["coordinates"][:])
                topology, body = file["topology"][:], file["body"][:]
            np.testing.assert_array_equal(run.mesh.body, body)
            self.assertEqual({name: cells.shape[1] for name, cells in run.mesh.cells.items()}, shapes)
            at = 0
            for element in range(len(body)):
                shape = mortise_results.SHAPES[topology[at]]
                row = np.flatnonzero(run.mesh.ids[shape.name] == element)[0]
                np.testing.assert_array_equal(run.mesh.cells[shape.name][row], topology[at + 1 : at + 1 + shape.nodes])
                at += 1 + shape.nodes
        self.assertEqual(mortise_results.open(flat()).mesh.bodies, ["cylinder", "block"])
        self.assertEqual([mortise_results.open(one()).mesh.dimension for one in (flat, solid)], [2, 3])
        self.assertEqual(mortise_results.open(flat()).mesh.body_index("block"), 1)
        with self.assertRaisesRegex(mortise_results.UnknownName, 'did you mean "block"'):
            mortise_results.open(flat()).mesh.body_index("blok")


class OfFiles(unittest.TestCase):
    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory()
        self.directory = pathlib.Path(self.scratch.name)
        (self.directory / "fields").mkdir()
        (self.directory / "history.csv").write_text('step,"a, ""b""",word\n1,2.5,yes\n2,nan,no\n', encoding="utf-8")
        with h5py.File(self.directory / "fields/mesh.h5", "w") as file:
            file["coordinates"] = np.arange(30.0).reshape(10, 3)
            # many alike, then others between: a line has its number of nodes behind its own number, and nodes may have the numbers of shapes
            file["topology"] = np.array([5, 0, 1, 2, 3] * 200 + [4, 4, 5, 6] + [2, 2, 8, 9] + [5, 5, 5, 4, 4] + [4, 0, 1, 2] * 3)
            file["body"] = np.array([0] * 200 + [1, 2, 0, 1, 1, 1])

    def tearDown(self):
        self.scratch.cleanup()

    def test_shapes_one_after_the_other(self):
        mesh = mortise_results.open(self.directory).mesh
        self.assertEqual({name: len(cells) for name, cells in mesh.cells.items()}, {"quadrilateral4": 201, "triangle3": 4, "line2": 1})
        np.testing.assert_array_equal(mesh.ids["quadrilateral4"], [*range(200), 202])
        np.testing.assert_array_equal(mesh.cells["quadrilateral4"][-1], [5, 5, 4, 4])
        np.testing.assert_array_equal(mesh.ids["triangle3"], [200, 203, 204, 205])
        np.testing.assert_array_equal(mesh.cells["line2"], [[8, 9]])
        self.assertEqual(mesh.bodies, ["body 0", "body 1", "body 2"])
        self.assertTrue(mesh.is_rigid("line2"))
        self.assertFalse(mesh.is_rigid("triangle3"))

    def test_names_of_bodies_stand_in_an_index_that_may_be_torn(self):
        (self.directory / "fields.xdmf").write_text('<?xml version="1.0"?>\n<Xdmf><Domain><Information Name="body 0" Value="a &lt;b&gt;"/>\n'
                                                    '<Information Name="body 1" Value="c"/><Grid><Gri', encoding="utf-8")
        self.assertEqual(mortise_results.open(self.directory).mesh.bodies, ["a <b>", "c", "body 2"])

    def test_tables(self):
        table = mortise_results.open(self.directory).history
        self.assertEqual(list(table), ["step", 'a, "b"', "word"])
        self.assertEqual([list(table["step"]), list(table["word"]), table['a, "b"'][0]], [[1, 2], ["yes", "no"], 2.5])
        self.assertTrue(np.isnan(table['a, "b"'][1]))
        (self.directory / "newton.csv").write_text("a,b\n1,2\n3\n", encoding="utf-8")
        with self.assertRaisesRegex(mortise_results.FileProblem, r"newton.csv, row 3: 1 entries, but there are 2 columns"):
            mortise_results.open(self.directory).newton

    def test_what_is_damaged_is_said(self):
        def expect(text, **datasets):
            with h5py.File(self.directory / "fields/mesh.h5", "r+") as file:
                for name, values in datasets.items():
                    del file[name]
                    file[name] = values
            with self.assertRaisesRegex(mortise_results.FileProblem, text):
                mortise_results.open(self.directory).mesh

        expect("element 0 has the shape 77", topology=np.array([77, 1, 2]))
        expect("its topology ends within element 0", topology=np.array([5, 1, 2]))
        expect("nodes 1 to 10 in its topology, but there are 10 nodes", topology=np.array([4, 1, 2, 10]))
        expect("1 elements in its topology, but 2 have a body", topology=np.array([4, 1, 2, 3]), body=np.array([0, 0]))

    def test_what_is_not_there_is_said(self):
        run = mortise_results.open(self.directory)
        self.assertEqual(run.steps, [])
        for text, ask in (("holds no fields of any step", lambda: run.field("displacement")), ("summary.json", lambda: run.summary),
                          ("contact profiles", lambda: run.profiles), ("no such directory", lambda: mortise_results.open(self.directory / "x"))):
            with self.assertRaisesRegex(mortise_results.FileProblem, text):
                ask()
        with self.assertRaisesRegex(mortise_results.FileProblem, "holds no results of a run"):
            mortise_results.open(inputs)

    def test_fields_of_another_mesh_are_refused(self):
        with h5py.File(self.directory / "fields/step-000003.h5", "w") as file:
            file.attrs["step"], file.attrs["time"] = 3, 0.5
            file["u"] = np.zeros((9, 3))
            file["u"].attrs["kind"], file["u"].attrs["center"] = "vector", "node"
        run = mortise_results.open(self.directory)
        self.assertEqual(run.fields(), {"u": "node"})
        with self.assertRaisesRegex(mortise_results.FileProblem, '"u" has 9 rows, but the mesh has 10 of its nodes'):
            run.field("u")
        with self.assertRaisesRegex(mortise_results.UnknownName, "no fields of step 4; there are steps 3"):
            run.field("u", 4)


class Export(unittest.TestCase):
    """The content of the files is a unit test of the package io; this is the command."""

    def call(self, *words):
        ending = subprocess.run([mortise, "export", *map(str, words)], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
        return ending.returncode, ending.stdout

    def test_a_run_is_one_file(self):
        for directory in (flat(), solid()):
            run = mortise_results.open(directory)
            code, said = self.call(directory)
            self.assertEqual(code, 0, said)
            self.assertIn(f"{len(run.mesh.nodes)} nodes, {len(run.mesh.body)} elements in {len(run.mesh.bodies)} blocks", said)
            self.assertIn(f"{len(run.steps)} steps", said)
            content = pathlib.Path(directory, "fields.exo").read_bytes()
            self.assertEqual(content[:4], b"CDF\x02")  # netCDF with 64-bit offsets
            self.assertEqual(self.call(directory)[0], 0)  # its own file it may replace
            again = os.path.join(scratch, "again.e")
            self.assertEqual(self.call(directory, "-o", again)[0], 0)
            self.assertEqual(pathlib.Path(again).read_bytes(), content)

    def test_what_is_wrong_makes_nothing(self):
        new = os.path.join(scratch, "new", "x.exo")
        nowhere = os.path.join(scratch, "nowhere")
        for words, code, reason in (([nowhere, "-o", new], 5, "there is no such directory"), ([nowhere], 5, "there is no such directory"),
                                    ([inputs, "-o", new], 5, "holds no fields"), ([flat(), "-o", new + ".vtk"], 2, "ends in .exo or .e")):
            found, said = self.call(*words)
            self.assertEqual((found, reason in said), (code, True), said)
            self.assertFalse(os.path.exists(os.path.dirname(new)))
            self.assertFalse(os.path.exists(nowhere))

    def test_what_others_made_stays(self):
        theirs = pathlib.Path(scratch, "theirs.exo")
        theirs.write_text("mine", encoding="utf-8")
        code, said = self.call(flat(), "-o", theirs)
        self.assertEqual((code, "was not made by this program" in said), (5, True), said)
        self.assertEqual(theirs.read_text(encoding="utf-8"), "mine")


if __name__ == "__main__":
    os.makedirs(scratch, exist_ok=True)
    unittest.main()
