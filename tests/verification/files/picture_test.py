"""Pictures of runs: what scripts find and draw, and the command `mortise picture` from outside.

Arguments: mpirun, the program, directory of the scripts, directory of the python module, inputs, a directory for results. Exit code 69 without numpy,
h5py, matplotlib and Pillow.
"""
import os
import pathlib
import shutil
import subprocess
import sys
import unittest

try:
    import h5py
    import matplotlib
    import numpy as np
    from PIL import Image
except ImportError:
    sys.exit(69)

mpirun, mortise, scripts, module, inputs, scratch = (sys.argv.pop(1) for _ in range(6))
sys.path.insert(0, module)
import mortise_results

SCRIPTS = ["style", "page_needs", "picture_colours", "picture_faces", "picture_raster", "picture_view", "picture_shade", "picture_field", "picture_model",
           "picture_figure", "picture_profile", "picture"]


def load():
    """The scripts one after the other, as the program runs them."""
    space = {"mortise_results": mortise_results}
    for name in SCRIPTS:
        exec(compile(next(pathlib.Path(scripts).rglob(f"{name}.py")).read_text(encoding="utf-8"), f"{name}.py", "exec"), space)
    return space


picture = load()
FLAT = "paper/hertz_elastic.xml", ["variables/n=2", "variables/steps=4", "variables/mu=0.2", "stepping/output times=0.5"]
SOLID = "verification/3d/punch.xml", ["stepping/end time=0.25"]


def call(*words, ranks=1, **more):
    start = [mpirun, "-n", str(ranks)] if ranks > 1 else []
    ending = subprocess.run([*start, mortise, *map(str, words)], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False, timeout=300, **more)
    return ending.returncode, ending.stdout


def run_of(scene, name, ranks=1, settings=(), more=()):
    """Results of a scene, which is run once."""
    directory = os.path.join(scratch, name)
    if not os.path.exists(os.path.join(directory, "summary.json")):
        words = ["run", os.path.join(inputs, scene[0]), "-o", directory, "--quiet", *more]
        for setting in [*scene[1], *settings]:
            words += ["--set", setting]
        code, said = call(*words, ranks=ranks)
        if code not in (0, 4):  # checks are of finer meshes
            raise AssertionError(said)
    return directory


def copy_of(directory, name):
    copy = os.path.join(scratch, name)
    shutil.rmtree(copy, ignore_errors=True)
    shutil.copytree(directory, copy)
    return copy


class Raster(unittest.TestCase):
    def test_each_pixel_has_the_nearest_triangle(self):
        random = np.random.default_rng(7)
        width, height = 40, 30
        xy = random.uniform([-5, -5], [45, 35], (60, 3, 2))
        depth = random.uniform(0, 10, (60, 3))
        winner, z = picture["nearest"](xy, depth, width, height)
        for row in range(height):
            for column in range(width):
                at = np.tile([column + 0.5, row + 0.5], (60, 1))
                weights = picture["barycentric"](xy, at[:, 0], at[:, 1])
                here = np.where(weights.min(axis=1) >= 0, (weights * depth).sum(axis=1), -np.inf)
                self.assertEqual(winner[row, column], here.argmax() if np.isfinite(here.max()) else -1, (row, column))
                if np.isfinite(here.max()):
                    self.assertAlmostEqual(z[row, column], here.max(), 9)

    def test_boxes_of_any_size_are_filled_to_their_edges(self):
        for size in (1, 2, 3, 7, 8, 9, 64, 100):
            xy = np.array([[[0, 0], [size, 0], [size, size]], [[0, 0], [size, size], [0, size]]], dtype=float)
            winner, _ = picture["nearest"](xy, np.zeros((2, 3)), 110, 110)
            self.assertEqual((winner >= 0).sum(), size * size)
            self.assertTrue((winner[:size, :size] >= 0).all())

    def test_triangles_without_area_and_outside_the_image_have_no_pixels(self):
        xy = np.array([[[1, 1], [5, 5], [9, 9]], [[-9, -9], [-2, -9], [-2, -3]], [[50, 1], [60, 1], [60, 9]]], dtype=float)
        winner, _ = picture["nearest"](xy, np.zeros((3, 3)), 20, 20)
        self.assertTrue((winner == -1).all())


class Faces(unittest.TestCase):
    @staticmethod
    def brick(n):
        """n^3 hexahedra of edge 1."""
        node = lambda i, j, k: i + (n + 1) * (j + (n + 1) * k)
        nodes = np.array([(i, j, k) for k in range(n + 1) for j in range(n + 1) for i in range(n + 1)], dtype=float)
        cells = np.array([[node(i, j, k), node(i + 1, j, k), node(i + 1, j + 1, k), node(i, j + 1, k), node(i, j, k + 1), node(i + 1, j, k + 1),
                           node(i + 1, j + 1, k + 1), node(i, j + 1, k + 1)] for k in range(n) for j in range(n) for i in range(n)])
        return mortise_results.Mesh(nodes, {"hexahedron8": cells}, {"hexahedron8": np.arange(n**3)}, np.zeros(n**3, dtype=int), ["brick"])

    def test_of_a_brick_only_its_skin_is_drawn(self):
        for n in (1, 2, 3):
            mesh = self.brick(n)
            faces, = picture["faces_of"](mesh)
            self.assertEqual(len(faces.nodes), 6 * n * n)
            normals = picture["face_normals"](faces, mesh.nodes)
            outward = mesh.nodes[faces.nodes].mean(axis=1) - n / 2
            self.assertTrue(((normals * outward).sum(axis=1) > 0).all())
            self.assertEqual(faces.outline.sum(), 2 * 12 * n)  # each edge of the brick from both of its faces

    def test_sides_are_those_of_the_shapes(self):
        """Mid-side nodes of a side are in the middle of its corners, for cells whose mid-side nodes are in the middle of their edges."""
        corners = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], dtype=float)
        tetrahedron = np.concatenate([corners, [(corners[a] + corners[b]) / 2 for a, b in ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3))]])
        corners = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)], dtype=float)
        edges = (0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)
        hexahedron = np.concatenate([corners, [(corners[a] + corners[b]) / 2 for a, b in edges]])
        for name, nodes in (("tetrahedron10", tetrahedron), ("hexahedron20", hexahedron)):
            for side in picture["SIDES"][name]:
                count = len(side) // 2
                for k in range(count):
                    np.testing.assert_allclose(nodes[side[count + k]], (nodes[side[k]] + nodes[side[(k + 1) % count]]) / 2)

    def test_cuts_cover_their_faces_and_follow_quadratic_functions(self):
        corners = {3: [(0, 0), (1, 0), (0, 1)], 4: [(-1, -1), (1, -1), (1, 1), (-1, 1)]}
        for name, cut in picture["CUT"].items():
            x = np.array(corners[picture["CORNERS"][name]], dtype=float)
            if cut.N.shape[1] > len(x):
                x = np.concatenate([x, (x + np.roll(x, -1, axis=0)) / 2])
            points = cut.N @ x
            area = picture["signed_area"](points[cut.triangles]) / 2
            self.assertTrue((area > 0).all())
            self.assertAlmostEqual(area.sum(), 0.5 if picture["CORNERS"][name] == 3 else 4.0)
            np.testing.assert_allclose(cut.N.sum(axis=1), 1)
            if cut.N.shape[1] > 4:
                of = lambda p: 1 + p[:, 0] - 2 * p[:, 1] + p[:, 0] ** 2 + 3 * p[:, 0] * p[:, 1] - p[:, 1] ** 2
                np.testing.assert_allclose(cut.N @ of(x), of(points), atol=1e-14)
            # The points along a side go from one corner to the next on the line between them.
            count = picture["CORNERS"][name]
            for side, rim in enumerate(cut.rims):
                a, b = x[side], x[(side + 1) % count]
                np.testing.assert_allclose(points[rim], a + np.linspace(0, 1, len(rim))[:, None] * (b - a), atol=1e-14)


class Lines(unittest.TestCase):
    def test_pixels_beside_a_side_are_dark_along_all_of_it(self):
        """A flat quadrilateral of 400 x 40 pixels of the raster: its lines have no gaps at its corners."""
        nodes = np.array([[20, 20, 0], [420, 20, 0], [420, 60, 0], [20, 60, 0]], dtype=float)
        faces = picture["Faces"]("quadrilateral4", np.array([[0, 1, 2, 3]]), np.array([0]), np.array([0]), False)
        triangles = picture["Triangles"]([faces], nodes, "cell", np.array([1.0]), False)
        image = picture["shaded"](triangles, picture["Triangles"]([], nodes, "cell", np.array([1.0]), False), picture["Colours"](0, 1), 220, 40, True)
        inside = image[10:30, 10:210, :3].sum(axis=2)
        for line in (inside[0, 1:-1], inside[-1, 1:-1], inside[1:-1, 0], inside[1:-1, -1]):
            self.assertLess(np.ptp(line), 1e-12)
            self.assertLess(line.max(), 0.8 * inside[10, 100])
        self.assertLess(np.ptp(inside[3:-3, 3:-3]), 1e-12)


class Scales(unittest.TestCase):
    def test_the_bar_ends_at_the_extremes(self):
        for low, high in ((0, 3.7), (-2, 5), (-1e-12, 4), (-9, -3), (1e-9, 2e-9), (5, 5), (0, 0), (-3, 0)):
            colours = picture["Colours"](low, high)
            values, texts = colours.ticks()
            self.assertEqual((values[0], values[-1]), (low, high))
            self.assertEqual(len(values), len(texts))
            self.assertEqual(values, sorted(values))
            self.assertTrue(np.isfinite(colours(np.array([low, high]))).all())

    def test_zero_between_signs_is_grey_and_equal_sizes_are_equally_strong(self):
        colours = picture["Colours"](-1.0, 4.0)
        zero, = colours(np.array([0.0]))
        self.assertLess(np.ptp(zero), 0.02)
        whole = picture["Colours"](-4.0, 4.0)
        np.testing.assert_allclose(colours(np.array([-1.0, 2.0, 4.0])), whole(np.array([-1.0, 2.0, 4.0])), atol=0.02)

    def test_small_displacements_are_enlarged_and_large_ones_are_not(self):
        warp = picture["warp_for"]
        self.assertEqual(warp(0.02, 1.0), 1.0)
        self.assertEqual(warp(0.5, 1.0), 1.0)
        self.assertEqual(warp(0.0, 1.0), 1.0)
        for size in (1e-3, 1.0, 1e4):
            for largest in (0.019, 0.01, 1e-3, 3e-5, 1e-8):
                factor = warp(largest * size, size)
                self.assertIn(round(factor / 10 ** np.floor(np.log10(factor) + 1e-9)), (1, 2, 5))
                self.assertLessEqual(factor * largest, 0.05 * (1 + 1e-9))
                self.assertGreater(factor * largest, 0.4 * 0.05)

    def test_views_look_from_where_they_say(self):
        for view, eye in (("x", [1, 0, 0]), ("-y", [0, -1, 0]), ("z", [0, 0, 1]), ("1,-2,3", np.array([1, -2, 3]) / np.sqrt(14))):
            camera = picture["Camera"](picture["eye_of"](view))
            np.testing.assert_allclose(camera.eye, eye, atol=1e-12)
            np.testing.assert_allclose(camera.axes.T @ camera.axes, np.eye(3), atol=1e-12)
            self.assertGreater(np.linalg.det(camera.axes), 0)  # no mirror
        np.testing.assert_allclose(picture["Camera"](picture["PLANE"]).axes, np.eye(3), atol=1e-12)


class Drawing(unittest.TestCase):
    def figure(self, run, name=None, step=None):
        run = mortise_results.open(run)
        step = step or run.steps[-1]
        field = picture["DrawnField"](run, name, [step])
        model = picture["Model"](run, field, [step], None, None)
        colours = field.colours([field.at(step)], model.deforming)
        layout = picture["Layout"](*model.bounds([step]), model.is_plane)
        return picture["picture_of"](model, step, layout, colours, ("x", "y"))

    def bar_texts(self, figure):
        axes, = [one for one in figure.axes if one.get_label() == "bar"]
        axis = axes.yaxis if len(axes.get_yticklabels()) > 0 and axes.get_yticklabels()[0].get_text() else axes.xaxis
        return [one.get_text().replace("−", "-") for one in axis.get_ticklabels()]

    def expect_extremes(self, run, name, values):
        figure = self.figure(run, name)
        texts = self.bar_texts(figure)
        picture["plt"].close(figure)
        self.assertEqual([float(texts[0]), float(texts[-1])], [float(f"{one:.4g}") for one in (values.min(), values.max())], name)

    def test_the_bar_has_the_extremes_of_the_field(self):
        flat = run_of(FLAT, "flat")
        last = sorted(pathlib.Path(flat, "fields").glob("step-*.h5"))[-1]
        with h5py.File(last) as file:
            stress, u = file["cauchy_stress"][:], file["displacement"][:]
        xx, xy, xz, yy, yz, zz = stress.T
        self.expect_extremes(flat, "cauchy_stress.yy", yy)
        self.expect_extremes(flat, "displacement.y", u[:, 1])
        self.expect_extremes(flat, "displacement", np.sqrt((u**2).sum(axis=1)))
        deviator = stress - (xx + yy + zz)[:, None] / 3 * np.array([1, 0, 0, 1, 0, 1])
        squared = (deviator**2 * np.array([1, 2, 2, 1, 2, 1])).sum(axis=1)
        self.expect_extremes(flat, None, np.sqrt(1.5 * squared))

    def test_slave_surfaces_have_the_colours_of_contact_fields(self):
        run = mortise_results.open(run_of(FLAT, "flat"))
        for name in ("contact_pressure", "contact_state"):
            figure = self.figure(run.directory, name)
            coloured, = [one for one in figure.axes[0].collections if one.get_zorder() == 6]
            shades = {tuple(one) for one in np.round(coloured.get_colors()[:, :3], 6)}
            values = run.field(name)
            if name == "contact_state":
                expected = {tuple(np.round(matplotlib.colors.to_rgb(picture["WHOLE"][int(one)]), 6)) for one in np.unique(values)}
                self.assertLessEqual(shades, expected)
            else:
                # Facets have the mean of their halves' ends, so no colour is beyond that of the largest pressure.
                colours = picture["Colours"](values.min(), values.max())
                self.assertGreater(len(shades), 3)
                halves = {tuple(np.round(one, 6)) for one in colours(np.linspace(values.min(), values.max(), 4097))}
                self.assertLessEqual(shades, halves)
            picture["plt"].close(figure)

    def test_rigid_bodies_do_not_set_the_range(self):
        solid = run_of(SOLID, "solid")
        run = mortise_results.open(solid)
        rigid = [name for name in run.mesh.cells if run.mesh.is_rigid(name)]
        self.assertEqual(rigid, ["quadrilateral4"])
        inside = np.setdiff1d(np.arange(len(run.mesh.body)), run.mesh.ids["quadrilateral4"])
        self.expect_extremes(solid, "cauchy_stress.zz", run.field("cauchy_stress.zz")[inside])

    def test_names_are_no_formulas(self):
        run = copy_of(run_of(FLAT, "flat"), "hostile")
        path = pathlib.Path(run, "effective.xml")
        text = path.read_text(encoding="utf-8")
        first = text.index('name="') + 6
        name = r"$\frac{1}{0}$ \\bad _{x} &lt;b&gt;"
        path.write_text(text[:first] + name + text[text.index('"', first) :], encoding="utf-8")
        figure = self.figure(run)
        figure.canvas.draw()
        shown = [one.get_text() for one in figure.texts]
        self.assertIn(r"\$\frac{1}{0}\$", shown[0])
        picture["plt"].close(figure)

    def test_profiles_are_those_of_the_table(self):
        run = mortise_results.open(run_of(FLAT, "flat"))
        figure, time = picture["profile_figure"](run, "interface", None)
        pressure, shear = figure.axes[0].get_lines()[:2]
        chosen = np.asarray(run.profiles["time"]) == time
        self.assertEqual(time, 1.0)
        np.testing.assert_array_equal(pressure.get_ydata(), np.asarray(run.profiles["pressure"])[chosen])
        np.testing.assert_array_equal(shear.get_ydata(), np.asarray(run.profiles["shear"])[chosen])
        picture["plt"].close(figure)


class Command(unittest.TestCase):
    def image(self, path, width=1200):
        """The pixels of a picture, which has to be one."""
        with Image.open(path) as file:
            self.assertEqual((file.format, file.width), ("PNG", width))
            pixels = np.asarray(file.convert("RGB")).astype(int)
        self.assertGreater(pixels.shape[0], 350)
        self.assertLess(pixels.shape[0], 1300)
        self.assertGreater((pixels.min(axis=2) < 250).mean(), 0.1, "next to nothing is drawn")
        return pixels

    def colourful(self, pixels):
        return ((pixels.max(axis=2) - pixels.min(axis=2)) > 40).mean()

    def test_plane_and_solid_models_are_drawn(self):
        for scene, name in ((FLAT, "flat"), (SOLID, "solid")):
            run = run_of(scene, name)
            code, said = call("picture", run)
            self.assertEqual(code, 0, said)
            self.assertIn("von_mises from ", said)
            self.assertGreater(self.colourful(self.image(os.path.join(run, "picture.png"))), 0.1)
            again = os.path.join(scratch, f"{name}_again.png")
            code, said = call("picture", run, "-o", again)
            self.assertEqual(code, 0, said)
            self.assertEqual(pathlib.Path(run, "picture.png").read_bytes(), pathlib.Path(again).read_bytes())
            self.assertEqual([one for one in os.listdir(run) if one.endswith(".part") or one == ".mortise.lock"], [])

    def test_fields_steps_factors_and_views(self):
        run = run_of(SOLID, "solid")
        seen = []
        for words in ([], ["--view", "-x"], ["--view", "1,1,-2"], ["--warp", "0"], ["--field", "displacement.z"], ["--field", "contact_pressure"],
                      ["--field", "body"], ["--step", "1"]):
            image = os.path.join(scratch, "one.png")
            code, said = call("picture", run, *words, "-o", image)
            self.assertEqual(code, 0, said)
            seen.append(self.image(image))
        for i, one in enumerate(seen):
            for other in seen[:i]:
                self.assertFalse(one.shape == other.shape and (one == other).all())

    def test_all_steps_as_an_animation_and_as_a_series(self):
        run = run_of(FLAT, "flat")
        steps = mortise_results.open(run).steps
        self.assertGreater(len(steps), 1)
        code, said = call("picture", run, "--steps")
        self.assertEqual(code, 0, said)
        with Image.open(os.path.join(run, "picture.gif")) as file:
            self.assertEqual((file.n_frames, file.width), (len(steps), 1200))
        series = os.path.join(scratch, "series")
        shutil.rmtree(series, ignore_errors=True)
        for _ in range(2):
            code, said = call("picture", run, "--steps", "-o", os.path.join(series, "at.png"))
            self.assertEqual(code, 0, said)
            self.assertEqual(sorted(one for one in os.listdir(series) if one[0] != "."), [f"at-{step:06}.png" for step in steps])
            os.rename(os.path.join(series, f"at-{steps[-1]:06}.png"), os.path.join(series, "at-000999.png"))  # as of a longer run

    def test_profiles(self):
        run = run_of(FLAT, "flat")
        for words in ([], ["--step", "2"]):
            code, said = call("picture", run, "--profile", "interface", *words)
            self.assertEqual(code, 0, said)
            with Image.open(os.path.join(run, "profile.png")) as file:
                self.assertEqual(file.size, (1200, 720))
        for words, reason in ((["--step", "1"], "no profile of step 1; it has those of t = 0.5, 1"), (["--step", "77"], "no profile of step 77")):
            code, said = call("picture", run, "--profile", "interface", *words)
            self.assertEqual((code, reason in said), (2, True), said)
        code, said = call("picture", run, "--profile", "interfase")
        self.assertEqual((code, 'did you mean "interface"' in said), (2, True), said)
        code, said = call("picture", run_of(SOLID, "solid"), "--profile", "face")
        self.assertEqual((code, "in 3D please draw a field of contact" in said), (2, True), said)

    def test_a_run_draws_itself_on_any_number_of_ranks(self):
        images = []
        for ranks in (1, 2):
            shutil.rmtree(os.path.join(scratch, f"drawn_np{ranks}"), ignore_errors=True)
            run = run_of(FLAT, f"drawn_np{ranks}", ranks, more=["--picture"])
            images.append(self.image(os.path.join(run, "picture.png")))
        # Round-off of the fields may exchange a colour for its neighbour in the map, and round that the other way.
        neighbours = np.abs(np.diff(matplotlib.colormaps["viridis"](np.arange(256))[:, :3], axis=0)).max()
        self.assertEqual(images[0].shape, images[1].shape)
        self.assertLessEqual(np.abs(images[0] - images[1]).max(), 255 * neighbours + 1)
        # A new run removes the picture of the old one with its results.
        code, said = call("run", os.path.join(inputs, FLAT[0]), "--set", "variables/n=2", "--set", "stepping/step=1", "-o", run, "--quiet")
        self.assertIn(code, (0, 4), said)
        self.assertFalse(os.path.exists(os.path.join(run, "picture.png")))

    def test_a_run_without_fields_ends_as_without_a_picture(self):
        directory = os.path.join(scratch, "bare_picture")
        shutil.rmtree(directory, ignore_errors=True)
        words = ["run", os.path.join(inputs, FLAT[0]), "--set", "variables/n=2", "--set", "output/fields=", "-o", directory, "--quiet"]
        plain, _ = call(*words)
        code, said = call(*words, "--picture")
        self.assertEqual(code, plain)
        self.assertIn("warning: no picture: ", said)
        self.assertIn("holds no fields of any step", said)


class Errors(unittest.TestCase):
    def expect(self, code, *reasons, words):
        before = sorted(os.listdir(scratch))
        found, said = call("picture", *words, "-o", os.path.join(scratch, "new", "error.png"))
        self.assertEqual(found, code, said)
        for reason in reasons:
            self.assertIn(reason, said)
        self.assertNotIn("Traceback", said)
        self.assertEqual(sorted(os.listdir(scratch)), before, "something was made")

    def test_what_the_run_does_not_have(self):
        run = run_of(FLAT, "flat")
        self.expect(2, 'there is no field "displacment"; did you mean "displacement"? There are: ', words=[run, "--field", "displacment"])
        self.expect(2, '"x", "y", "z", "magnitude"', words=[run, "--field", "displacement.q"])
        self.expect(2, "no fields of step 77; there are steps ", words=[run, "--step", "77"])
        self.expect(2, "cauchy_stress", "there are: ", words=[run, "--field", "cauchy_stress.zx"])
        self.expect(2, "there is no field", words=[run, "--field", "$x$\n__import__('os')"])

    def test_results_that_are_not_there(self):
        run = run_of(FLAT, "flat")
        self.expect(5, "nowhere: there is no such directory", words=[os.path.join(scratch, "nowhere")])
        self.expect(5, "holds no results of a run", words=[inputs])
        bare = copy_of(run, "bare")
        for file in pathlib.Path(bare, "fields").glob("step-*.h5"):
            file.unlink()
        self.expect(5, "holds no fields of any step", words=[bare])
        pathlib.Path(bare, "profiles.csv").unlink()
        self.expect(5, "profiles.csv: there is no such file", words=[bare, "--profile", "interface"])

    def test_damaged_files(self):
        run = run_of(FLAT, "flat")
        last = sorted(pathlib.Path(run, "fields").glob("step-*.h5"))[-1].name
        for name in ("mesh.h5", last):
            for share in (0, 0.3, 0.9):
                damaged = copy_of(run, "damaged")
                path = pathlib.Path(damaged, "fields", name)
                content = path.read_bytes()
                path.write_bytes(content[: int(share * len(content))])
                self.expect(5, name, words=[damaged])
        damaged = copy_of(run, "damaged")
        with h5py.File(os.path.join(damaged, "fields", "mesh.h5"), "r+") as file:
            file["topology"][1] = 10**9
        self.expect(5, "mesh.h5 is damaged: nodes ", words=[damaged])
        damaged = copy_of(run, "damaged")
        with h5py.File(os.path.join(damaged, "fields", last), "r+") as file:
            file["displacement"][3, 1] = np.nan
        self.expect(5, "displacement of step 4 is no number at 1 nodes; the first is node 3", words=[damaged])

    def test_what_others_made_stays(self):
        run = run_of(FLAT, "flat")
        theirs = pathlib.Path(scratch, "theirs.png")
        theirs.write_text("mine", encoding="utf-8")
        for words in ([run, "-o", theirs], [run, "-o", os.path.join(scratch, "theirs.jpg")]):
            code, said = call("picture", *words)
            self.assertEqual(code, 5 if words[-1] == theirs else 2, said)
        self.assertEqual(theirs.read_text(encoding="utf-8"), "mine")
        code, said = call("picture", run, "-o", os.path.join(scratch, "a*.png"))
        self.assertEqual((code, "cannot be the name of a file" in said), (2, True), said)

    def test_usage(self):
        run = run_of(FLAT, "flat")
        for words in (["--view", "up"], ["--view", "0,0,0"], ["--warp", "-1"], ["--warp", "inf"], ["--step", "x"], ["--steps", "--step", "1"],
                      ["--profile", "interface", "--field", "body"], ["-o", ""]):
            self.assertEqual(call("picture", run, *words)[0], 1, words)

    def test_without_python_it_says_what_to_install(self):
        code, said = call("picture", run_of(FLAT, "flat"), env={**os.environ, "MORTISE_PYTHON": "/nowhere/python3"})
        self.assertEqual((code, "python3-matplotlib" in said), (5, True), said)


if __name__ == "__main__":
    os.makedirs(scratch, exist_ok=True)
    unittest.main()
