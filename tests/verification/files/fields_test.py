"""Fields that a run leaves: against closed forms, on several ranks, after a kill and on a full disk.

Arguments: mpirun, the program, a directory for results. Exit code 69 without numpy and h5py.
"""
import csv
import glob
import math
import os
import shutil
import signal
import subprocess
import sys
import time
import unittest
import xml.dom.minidom

try:
    import h5py
    import numpy as np
except ImportError:
    sys.exit(69)

mpirun, mortise, scratch = (sys.argv.pop(1) for _ in range(3))
XX, XY, XZ, YY, YZ, ZZ = range(6)


def entries(value):
    """Nested dictionaries as lists of a scene."""
    text = ""
    for name, one in value.items():
        if isinstance(one, dict):
            text += f'<ParameterList name="{name}">{entries(one)}</ParameterList>'
        else:
            text += f'<Parameter name="{name}" type="string" value="{one}"/>'
    return text


def material(law, youngs_modulus, poissons_ratio):
    return {"type": law, "young's modulus": youngs_modulus, "poisson's ratio": poissons_ratio}


FIELDS = ["displacement", "cauchy_stress", "logarithmic_strain", "nodal_cauchy_stress", "nodal_logarithmic_strain", "reaction_force"]


def blocks(fields=FIELDS, every_step=1):
    """A block on another one of another law and mesh; both are held at their sides and pressed from above: the state of each is uniform."""
    block = lambda y, cells: {"type": "block", "corners": f"0, {y}, 2, {y}, 2, {y + 1}, 0, {y + 1}", "cells x": cells, "cells y": 3}
    return {
        "kinematics": "plane strain", "thickness": "0.5", "variables": {"steps": 4},
        "materials": {"lower": material("hencky", 1000, 0.3), "upper": material("hencky", 2000, 0.1)},
        "bodies": {
            "lower": {"material": "lower", "element": "Q4", "mesh": block(0, 3)},
            "upper": {"material": "upper", "element": "T3", "mesh": block(1, 4)}},
        "boundary conditions": {
            "floor": {"set": "lower/bottom", "y": 0},
            **{f"{body} {side}": {"set": f"{body}/{side}", "x": 0} for body in ("lower", "upper") for side in ("left", "right")}},
        "loads": {"press": {"type": "follower pressure", "set": "upper/top", "pressure": "100*t"}},
        "contact": {"joint": {"slave": "upper/bottom", "master": "lower/top"}},
        "stepping": {"step": "1/steps"},
        "output": {"fields": ", ".join(fields), "every step": every_step},
        "quantities": {
            "floor": {"type": "reaction", "set": "lower/bottom", "component": "y"},
            "side": {"type": "reaction", "set": "upper/right", "component": "x"}},
    }


def ring(element, cells):
    """A quarter of a thick ring under inner pressure: Lame's solution."""
    return {
        "kinematics": "plane strain", "thickness": 1,
        "materials": {"steel": material("small strain linear", 1000, 0.3)},
        "bodies": {"ring": {"material": "steel", "element": element, "mesh": {
            "type": "ring sector", "inner radius": 1, "outer radius": 2, "start angle": 0, "end angle": 90, "cells across": cells, "cells around": 2 * cells}}},
        "boundary conditions": {"start": {"set": "ring/start", "y": 0}, "end": {"set": "ring/end", "x": 0}},
        "loads": {"press": {"type": "dead traction", "set": "ring/inner", "x": "x", "y": "y"}},
        "stepping": {"step": 1},
        "output": {"fields": "nodal_cauchy_stress"},
    }


def write_scene(name, scene):
    os.makedirs(scratch, exist_ok=True)
    path = os.path.join(scratch, name + ".xml")
    with open(path, "w", encoding="utf-8") as file:
        file.write(f'<ParameterList name="{name}">{entries(scene)}</ParameterList>\n')
    return path


def command(scene, results, ranks):
    return [*([mpirun, "-n", str(ranks)] if ranks > 1 else []), mortise, "run", scene, "-o", results]


class Results:
    """Results of a run."""

    def __init__(self, directory):
        self.directory = directory

    def files(self):
        return sorted(glob.glob(os.path.join(self.directory, "fields", "step-*.h5")))

    def step(self, file):
        with h5py.File(file, "r") as step:
            return dict(step.attrs), {name: values[:] for name, values in step.items()}

    def last(self):
        return self.step(self.files()[-1])[1]

    def mesh(self):
        with h5py.File(os.path.join(self.directory, "fields", "mesh.h5"), "r") as mesh:
            return {name: values[:] for name, values in mesh.items()}

    def index(self):
        """Step files that the index names, once for each grid."""
        document = xml.dom.minidom.parse(os.path.join(self.directory, "fields.xdmf"))
        grids = [grid for grid in document.getElementsByTagName("Grid") if grid.getAttribute("GridType") == "Uniform"]
        named = []
        for grid in grids:
            items = {item.firstChild.data.split(":")[0] for item in grid.getElementsByTagName("DataItem")} - {"fields/mesh.h5"}
            assert len(items) == 1, items
            named.append(os.path.join(self.directory, items.pop()))
        return named

    def history(self):
        with open(os.path.join(self.directory, "history.csv"), encoding="utf-8", newline="") as file:
            return list(csv.DictReader(file))


def run(name, scene, ranks=1):
    results = os.path.join(scratch, f"{name}_np{ranks}")
    ending = subprocess.run(command(write_scene(name, scene), results, ranks), capture_output=True, text=True, timeout=120, check=False)
    assert ending.returncode == 0, ending.stdout + ending.stderr
    return Results(results)


class ClosedForms(unittest.TestCase):
    def test_uniform_states_are_exact_at_nodes_and_bodies_do_not_mix(self):
        results = run("blocks", blocks())
        values, mesh = results.last(), results.mesh()
        y, body = mesh["coordinates"][:, 1], mesh["body"]
        nodes = [np.arange(16), np.arange(16, len(y))]  # 4 x 4 nodes of the lower block, then the upper one
        self.assertTrue((y[nodes[0]] <= 1).all() and (y[nodes[1]] >= 1).all())
        for number, (E, nu) in enumerate(((1000, 0.3), (2000, 0.1))):
            mu, lame = E / (2 + 2 * nu), E * nu / (1 + nu) / (1 - 2 * nu)
            stretch = 1.0  # (lame + 2 mu) ln stretch = -100 stretch
            for _ in range(100):
                stretch = math.exp(-100 * stretch / (lame + 2 * mu))
            stress, strain = np.zeros(6), np.zeros(6)
            strain[YY] = math.log(stretch)
            stress[[XX, YY, ZZ]] = np.array([lame, lame + 2 * mu, lame]) * strain[YY] / stretch
            self.assertAlmostEqual(stress[YY], -100)
            for field, rows in (("cauchy_stress", body == number), ("nodal_cauchy_stress", nodes[number])):
                np.testing.assert_allclose(values[field][rows], np.tile(stress, (len(values[field][rows]), 1)), atol=1e-6)
            for field, rows in (("logarithmic_strain", body == number), ("nodal_logarithmic_strain", nodes[number])):
                np.testing.assert_allclose(values[field][rows], np.tile(strain, (len(values[field][rows]), 1)), atol=1e-9)

    def test_principal_stresses_are_those_of_the_tensor(self):
        names = [f"{which}_principal_{kind}" for which in ("largest", "smallest") for kind in ("stress", "vector")]
        scene = blocks(["cauchy_stress", *names])
        scene["loads"]["press"]["pressure"] = "100*t*(1 + x)"
        values = run("principal", scene).last()
        sheared = 0
        for element, (xx, xy, xz, yy, yz, zz) in enumerate(values["cauchy_stress"]):
            tensor = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
            principal = np.linalg.eigvalsh(tensor)
            sheared += abs(xy) > 1e-3 * abs(yy)
            for which, expected in (("largest", principal[2]), ("smallest", principal[0])):
                self.assertAlmostEqual(values[f"{which}_principal_stress"][element], expected, delta=1e-9 * abs(yy))
                vector = values[f"{which}_principal_vector"][element]
                if np.linalg.norm(vector) < 1e-9 * abs(yy):  # along z
                    self.assertAlmostEqual(zz, expected, delta=1e-9 * abs(yy))
                    continue
                self.assertAlmostEqual(np.linalg.norm(vector), abs(expected), delta=1e-9 * abs(yy))
                np.testing.assert_allclose(tensor @ vector, expected * vector, atol=1e-9 * yy * yy)
        self.assertGreater(sheared, 10)

    def test_reactions_sum_up_to_those_of_quantities_and_hold_the_loads(self):
        results = run("blocks", blocks())
        values, mesh, history = results.last(), results.mesh(), results.history()[-1]
        X, reaction = mesh["coordinates"], values["reaction_force"]
        floor, right = X[:, 1] == 0, (X[:, 0] == 2) & (np.arange(len(X)) >= 16)
        self.assertAlmostEqual(reaction[floor, 1].sum(), float(history["floor"]), delta=1e-8)
        self.assertAlmostEqual(reaction[right, 0].sum(), float(history["side"]), delta=1e-8)
        self.assertAlmostEqual(reaction[floor, 1].sum(), 100 * 2 * 0.5, delta=1e-6)
        self.assertTrue((reaction[~floor, 1] == 0).all())
        self.assertTrue((reaction[(X[:, 0] != 0) & (X[:, 0] != 2), 0] == 0).all())
        self.assertLess(abs(reaction[:, 0].sum()), 1e-6)

    def test_nodal_stress_of_a_ring_converges_to_that_of_lame(self):
        """Q4 has second order inside and first order at the surface, whose nodes are a share of the order h: 3/2 over all. Q8 has second order."""
        for element, lowest_inside, lowest in (("Q4", 1.8, 1.3), ("Q8", 1.8, 1.8)):
            errors = []
            for cells in (8, 16, 32):
                results = run(f"ring_{element}_{cells}", ring(element, cells))
                X, stress = results.mesh()["coordinates"], results.last()["nodal_cauchy_stress"]
                r2, A, B = (X[:, :2] ** 2).sum(axis=1), 1 / 3, 4 / 3
                cosine, sine = (X[:, 0] ** 2 - X[:, 1] ** 2) / r2, 2 * X[:, 0] * X[:, 1] / r2
                exact = np.zeros_like(stress)
                exact[:, XX], exact[:, YY], exact[:, XY], exact[:, ZZ] = A - B / r2 * cosine, A + B / r2 * cosine, -B / r2 * sine, 0.6 * A
                inside = (abs(np.sqrt(r2) - 1.5) < 0.49) & (X[:, 0] > 0.01) & (X[:, 1] > 0.01)
                error = lambda nodes: np.sqrt(((stress - exact)[nodes] ** 2).mean() / (exact[nodes] ** 2).mean())
                errors.append([error(inside), error(np.full(len(X), True))])
            orders = [np.polyfit(np.log([1 / 8, 1 / 16, 1 / 32]), np.log(column), 1)[0] for column in np.transpose(errors)]
            print(f"nodal stress of a ring, {element}: errors inside and of all nodes {np.round(errors, 5).tolist()}, orders {np.round(orders, 2)}")
            self.assertGreater(orders[0], lowest_inside)
            self.assertGreater(orders[1], lowest)

    def test_any_number_of_ranks_gives_the_same(self):
        one = run("blocks", blocks())
        for ranks in (2, 3):
            other = run("blocks", blocks(), ranks)
            self.assertEqual([os.path.basename(file) for file in one.files()], [os.path.basename(file) for file in other.files()])
            for left, right in zip(one.files(), other.files()):
                (attributes, values), (other_attributes, other_values) = one.step(left), other.step(right)
                self.assertEqual(attributes, other_attributes)
                self.assertEqual(set(values), set(FIELDS))
                for name in FIELDS:
                    np.testing.assert_allclose(other_values[name], values[name], atol=1e-9 * max(1, np.abs(values[name]).max()), err_msg=name)


class Surviving(unittest.TestCase):
    STEPS = 4

    def scene(self, steps=STEPS):
        scene = blocks(["displacement", "cauchy_stress"])
        scene["variables"]["steps"] = steps
        return write_scene(f"surviving_{steps}", scene)

    def expect_whole_steps(self, results, complete, at_least=0):
        """Every step file is that of the run that came to its end; the index names all of them, or all but the one that was being added."""
        files = results.files()
        self.assertGreaterEqual(len(files), at_least)
        for file in files:
            (attributes, values), (whole_attributes, whole_values) = results.step(file), complete.step(os.path.join(complete.directory, "fields", os.path.basename(file)))
            self.assertEqual(attributes, whole_attributes)
            self.assertEqual(set(values), set(whole_values))
            for name, value in whole_values.items():
                np.testing.assert_allclose(values[name], value, atol=1e-9 * max(1, np.abs(value).max()))
        if os.path.exists(os.path.join(results.directory, "fields.xdmf")):
            named = results.index()
            self.assertIn(named, (files, files[:-1]))
        else:
            self.assertEqual(files, [])
        parts = glob.glob(os.path.join(results.directory, "**", "*.part"), recursive=True)
        self.assertLessEqual(len(parts), 1, parts)
        history = os.path.join(results.directory, "history.csv")
        if os.path.exists(history):
            with open(history, encoding="utf-8") as file:
                text = file.read()
            self.assertTrue(text == "" or text.endswith("\n"), text)
        return len(files)

    @unittest.skipUnless(shutil.which("strace"), "no strace here")
    def test_a_kill_at_any_write_leaves_whole_steps(self):
        scene, directory = self.scene(), os.path.join(scratch, "killed")
        complete = Results(os.path.join(scratch, "complete"))
        shutil.rmtree(complete.directory, ignore_errors=True)  # a directory that is replaced takes more calls
        log = os.path.join(scratch, "writes.txt")
        traced = lambda *options: ["strace", "-f", "-qq", "-o", log, *options]
        ending = subprocess.run([*traced("-e", "trace=pwrite64,rename"), *command(scene, complete.directory, 1)], capture_output=True, text=True, check=False)
        if "ptrace" in ending.stderr:
            self.skipTest(ending.stderr)
        self.assertEqual(ending.returncode, 0, ending.stderr)
        self.assertEqual(len(complete.files()), self.STEPS)
        with open(log, encoding="utf-8", errors="replace") as file:
            calls = file.read()
        counts = set()
        for call, most in (("pwrite64", calls.count("pwrite64(")), ("rename", calls.count("rename("))):
            self.assertGreater(most, self.STEPS)
            for when in range(1, most + 1):
                shutil.rmtree(directory, ignore_errors=True)
                ending = subprocess.run([*traced("-e", f"inject={call}:signal=KILL:when={when}"), *command(scene, directory, 1)], capture_output=True, check=False)
                self.assertIn(ending.returncode, (-signal.SIGKILL, 128 + signal.SIGKILL), f"{call} {when}")
                counts.add(self.expect_whole_steps(Results(directory), complete))
        self.assertEqual(counts, set(range(self.STEPS + 1)))

    def test_a_kill_at_any_time_leaves_whole_steps(self):
        steps = 1000
        for ranks in (1, 2):
            scene = self.scene(steps)
            complete = Results(os.path.join(scratch, f"long_np{ranks}"))
            whole = subprocess.run(command(scene, complete.directory, ranks), capture_output=True, check=False)
            self.assertEqual(whole.returncode, 0)
            for waiting in (3, 10, 40):
                directory = os.path.join(scratch, "killed_in_time")
                shutil.rmtree(directory, ignore_errors=True)
                with subprocess.Popen(command(scene, directory, ranks), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as process:
                    end = time.monotonic() + 60
                    while len(Results(directory).files()) < waiting and process.poll() is None:
                        self.assertLess(time.monotonic(), end)
                        time.sleep(0.002)
                    os.kill(self.rank_of(process, ranks), signal.SIGKILL)
                    self.assertNotEqual(process.wait(60), 0)
                found = self.expect_whole_steps(Results(directory), complete, waiting)
                self.assertLess(found, steps)

    @staticmethod
    def rank_of(process, ranks):
        """The process of the last rank."""
        if ranks == 1:
            return process.pid
        with open(f"/proc/{process.pid}/task/{process.pid}/children", encoding="utf-8") as file:
            return int(file.read().split()[-1])

    def expect_file_error(self, shell, results, complete, reason, at_least):
        begin = time.monotonic()
        environment = {**os.environ, "OMPI_MCA_btl": "tcp,self"}  # shared memory is a file, too
        ending = subprocess.run(["bash", "-c", shell], capture_output=True, text=True, timeout=30, env=environment, check=False)
        said = ending.stdout + ending.stderr
        self.assertEqual(ending.returncode, 5, said)
        self.assertLess(time.monotonic() - begin, 10)
        self.assertIn(reason, said)
        self.assertIn("cannot write", said)
        self.expect_whole_steps(results, complete, at_least)
        self.assertEqual(glob.glob(os.path.join(results.directory, "fields", "*.part")), [])

    @staticmethod
    def kilobytes_of_scene(results):
        """Size of effective.xml in pages of 4 KiB. It is the largest file before the first step."""
        return 4 * -(-os.path.getsize(os.path.join(results.directory, "effective.xml")) // 4096)

    def test_files_that_must_not_grow_end_the_run(self):
        scene = self.scene(50)
        for ranks in (1, 2):
            complete = Results(os.path.join(scratch, f"fifty_np{ranks}"))
            self.assertEqual(subprocess.run(command(scene, complete.directory, ranks), capture_output=True, check=False).returncode, 0)
            # Beyond 3 KiB nothing is written: no step. Where the scene just fits, the index of some steps does not.
            for limit, at_least in ((3, 0), (self.kilobytes_of_scene(complete) + 1, 2)):
                directory = os.path.join(scratch, f"limited_np{ranks}")
                shutil.rmtree(directory, ignore_errors=True)
                limited = f"""bash -c 'trap "" XFSZ; ulimit -f {limit}; exec "$@"' _ {mortise} run {scene} -o {directory}"""
                self.expect_file_error(f"{mpirun} -n {ranks} {limited}", Results(directory), complete, "File too large", at_least)

    @unittest.skipUnless(os.geteuid() == 0 and shutil.which("unshare"), "only root can mount")
    def test_full_disks_end_the_run(self):
        scene = self.scene(50)
        disk, copy = os.path.join(scratch, "disk"), os.path.join(scratch, "copy")
        os.makedirs(disk, exist_ok=True)
        if subprocess.run(["unshare", "-m", "mount", "-t", "tmpfs", "none", disk], capture_output=True, check=False).returncode != 0:
            self.skipTest("no file system can be mounted here")
        for ranks in (1, 2):
            complete = Results(os.path.join(scratch, f"fifty_np{ranks}"))
            self.assertEqual(subprocess.run(command(scene, complete.directory, ranks), capture_output=True, check=False).returncode, 0)
            scene_kilobytes = self.kilobytes_of_scene(complete)
            for kilobytes in (scene_kilobytes + others for others in (48, 52, 60, 84, 184)):
                shutil.rmtree(copy, ignore_errors=True)
                inside = f"""mount -t tmpfs -o size={kilobytes}k none {disk}; {" ".join(command(scene, disk, ranks))}; code=$?; cp -r {disk} {copy}; exit $code"""
                self.expect_file_error(f"unshare -m bash -c '{inside}'", Results(copy), complete, "No space left on device", 1)


if __name__ == "__main__":
    unittest.main()
