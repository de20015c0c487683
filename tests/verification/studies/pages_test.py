"""Decisions and texts of the scripts of the pages, on data that are known. Arguments: the directory of the scripts. Exit code 69 without matplotlib."""
import pathlib
import shlex
import sys
import unittest

scripts = pathlib.Path(sys.argv.pop(1))


def load(*names):
    """The scripts one after the other, as the program runs them."""
    space = {}
    for name in names:
        exec(compile(next(scripts.rglob(f"{name}.py")).read_text(encoding="utf-8"), f"{name}.py", "exec"), space)
    return space


style = load("style")
page = load("style", "page")
study = load("style", "page", "study_answer")
scale = load("style", "page", "scale_answer")
paper = load("style", "page", "paper_claims")


class Page(unittest.TestCase):
    def test_commands_are_what_a_shell_reads(self):
        settings = ["contact/first/formulation/type=node to segment", "variables/a=$HOME `x` \"y\" 'z'", "stepping/step=1/200"]
        words = shlex.split(page["command"]([], "scenes/my scene.xml", settings, 2, "again/x;y"))
        given = [word for setting in settings for word in ("--set", setting)]
        self.assertEqual(words, ["mpirun", "-n", "2", "mortise", "run", "scenes/my scene.xml", *given, "-o", "again/x;y"])
        words = shlex.split(page["command"](["srun", "--mpi=pmix", "-n", "{ranks}"], "scene.xml", [], 1, "again"))
        self.assertEqual(words[:5], ["srun", "--mpi=pmix", "-n", "1", "mortise"])
        words = shlex.split(page["command"](["srun", "-n", "{ranks}"], "scene.xml", [], 1, "again", "calculix node to surface", "10"))
        self.assertEqual(words, ["mortise", "peer", "scene.xml", "--by", "calculix node to surface", "--penalty", "10", "-o", "again"])

    def test_no_column_says_the_same_twice(self):
        columns = [("formulation", ["dual", "penalty"]), ("type", ["Dual", "penalty"]), ("steps", ["4", "4"]), ("wall / s", ["1", "2"]), ("CPU / s", ["1", "2"])]
        shown, same = page["told_once"](columns)
        self.assertEqual([head for head, _ in shown], ["formulation", "wall / s", "CPU / s"])
        self.assertEqual(same, [("steps", "4")])
        self.assertEqual(len(page["told_once"]([("run", ["a"]), ("steps", ["4"])])[0]), 2)

    def test_names_from_scenes_break_neither_html_nor_figures(self):
        name = "_a$b_{c}$ <script>&"
        self.assertEqual(page["escaped"](name), "_a$b_{c}$ &lt;script&gt;&amp;")
        figure, axes = page["one_panel"](name)
        axes.plot([1, 2], label=page["plain"](name))
        page["legend_below"](axes)
        self.assertEqual(len(figure.legends[0].get_texts()), 1)  # _ at the beginning does not hide it
        self.assertIn("&lt;script", page["html_figure"](figure, name, name))
        self.assertFalse(page["plt"].get_fignums())

    def test_numbers_have_the_digits_that_mean_something(self):
        for value, text in ((3.1204735e-13, "3.1e-13"), (1403.572733, "1403.6"), (0.0, "0"), (None, "–"), (float("nan"), "–")):
            self.assertEqual(page["number"](value), text)

    def test_phases_and_formulations_are_told_apart(self):
        for table, at in ((style["FORMULATIONS"], 0), (style["PHASES"], 1)):
            colours = [entry[at] for entry in table.values()]
            self.assertEqual(len(set(colours)), len(colours))
        markers = [marker for _, marker in style["FORMULATIONS"].values()]
        self.assertEqual(len(set(markers)), len(markers))


class Study(unittest.TestCase):
    points = [{"label": f"<{i}>", "wall_s": seconds} for i, seconds in enumerate((1.0, 2.0, 4.0))]

    def error(self, errors, *cheapest):
        targets = [{"error": bound, "cheapest": found} for bound, found in cheapest]
        return {"name": "e", "error": errors, "exact": None, "targets": targets, "orders": [None], "no_order": ["errors do not fall"]}

    def test_the_cheapest_is_told_with_what_confirms_it(self):
        error = self.error([0.02, 0.004, 0.0008], (0.01, {"point": 1, "confirmed": True}), (0.001, {"point": 2, "confirmed": False}))
        words = study["cheapest_of"](error, self.points)
        self.assertEqual(words, "within 1 %: <b>&lt;1&gt;</b>, 2 s (error 0.4 %); "
                                "within 0.1 %: <b>&lt;2&gt;</b>, 4 s (error 0.08 %), <i>not confirmed by a finer run</i>.")

    def test_a_zero_crossing_is_called_one(self):
        words = study["cheapest_of"](self.error([0.02, 0.0001, 0.03], (0.01, None), (1e-5, None)), self.points)
        self.assertIn("within 1 % or 0.001 %: none; the smallest error is 0.01 % (&lt;1&gt;, 2 s, but finer runs of its family are not as good)", words)

    def test_the_fastest_of_exact_runs_meets_every_bound(self):
        error = dict(self.error([1e-12, None, 0.0], (0.01, {"point": 0, "confirmed": True})), exact=0)
        self.assertFalse(study["has_errors"](error))
        self.assertIn("all runs are exact but for round-off; the fastest is <b>&lt;0&gt;</b>", study["cheapest_of"](error, self.points))
        curves = [{"name": "one", "points": [0, 1, 2]}]
        self.assertEqual(study["winners"]([error], self.points, curves), (["one"], 1, 1))
        summary = study["summary_of"]({"errors": [error], "points": self.points, "curves": curves})
        self.assertEqual(summary, "<b>one</b> is the cheapest within every bound that a run is confirmed to meet (1).")
        self.assertEqual(study["cheapest_of"](self.error([None] * 3, (0.01, None)), self.points), "no errors are known.")

    def test_what_has_no_order_says_why(self):
        self.assertEqual(study["order_words"](self.error([1.0]), 0), "no order: errors do not fall")

    def test_only_confirmed_runs_win(self):
        curves = [{"name": "one", "points": [0, 1]}, {"name": "two", "points": [2]}]
        error = self.error([0.02, 0.004, 0.0008], (0.01, {"point": 1, "confirmed": True}), (0.001, {"point": 2, "confirmed": False}))
        self.assertEqual(study["winners"]([error], self.points, curves), (["one"], 1, 1))


class Scale(unittest.TestCase):
    def point(self, ranks, seconds, phases, memory=0.5, linear=10, imbalance=1.0, repeats=()):
        first = {"solution": 6.0, "integrals": 4.0}
        of = {name: {"seconds": one, "efficiency": first[name] / (ranks * one)} for name, one in phases.items()}
        return {"series": "strong", "ranks": ranks, "finished": True, "seconds": seconds, "efficiency": 10.0 / (ranks * seconds), "phases": of,
                "bandwidth_efficiency": memory, "linear_iterations": linear, "contact_imbalance": imbalance, "dofs": 100, "repeats": [seconds, *repeats]}

    def words(self, **more):
        first = self.point(1, 10.0, {"solution": 6.0, "integrals": 4.0}, 1.0)
        return " ".join(scale["series_words"]([first, self.point(2, 8.0, {"solution": 5.9, "integrals": 2.1}, **more)]))

    def test_the_limit_is_the_phase_that_loses_most(self):
        # Full efficiency would be 3 and 2 s: 2.9 and 0.1 s are lost.
        name, seconds, total = scale["limit_of"](self.point(2, 8.0, {"solution": 5.9, "integrals": 2.1}))
        self.assertEqual(name, "solution")
        self.assertAlmostEqual(seconds, 2.9)
        self.assertAlmostEqual(total, 3.0)
        self.assertIsNone(scale["limit_of"](self.point(2, 5.0, {"solution": 3.0, "integrals": 2.0})))

    def test_the_cause_is_what_was_measured(self):
        self.assertIn("an efficiency of 0.62", self.words())
        self.assertIn("the solution, with 2.9 s of the 3 s that the run loses (97 %)", self.words())
        self.assertIn("is what the memory serves so many ranks with (0.5)", self.words())
        self.assertIn("is below that of the memory (0.9), which is not the cause", self.words(memory=0.9))
        self.assertIn("takes 20 iterations instead of 10", self.words(linear=20))

    def test_what_other_phases_gain_is_told(self):
        # Full efficiency would be 3 and 2 s: 4 s are lost and 1 s gained.
        gaining = [self.point(1, 10.0, {"solution": 6.0, "integrals": 4.0}, 1.0), self.point(2, 8.0, {"solution": 7.0, "integrals": 1.0})]
        self.assertIn("the solution, with 4 s; the run loses 3 s, as other phases gain: ", " ".join(scale["series_words"](gaining)))

    def test_times_have_the_digits_that_repeats_agree_in(self):
        def words(one, two):
            points = [self.point(1, 10.0, {"solution": 6.0, "integrals": 4.0}, 1.0, repeats=[one]),
                      self.point(2, 8.0, {"solution": 5.9, "integrals": 2.1}, repeats=[two])]
            return " ".join(scale["series_words"](points))

        self.assertIn("1.25 times as fast", words(10.01, 8.01))
        self.assertIn("1.2 times as fast", words(10.01, 8.5))
        self.assertIn("within the noise of the machine: the middle repeat takes up to 3.5 s more than the fastest", words(10.01, 11.5))
        self.assertNotIn("What limits it", words(10.01, 11.5))
        self.assertNotIn("noise", words(10.01, 8.5))

    def test_short_runs_name_no_limit(self):
        phases = {"solution": 6.0, "integrals": 4.0}
        short = " ".join(scale["series_words"]([self.point(1, 0.1, phases), dict(self.point(2, 0.08, phases), efficiency=0.625)]))
        self.assertIn("within the noise of the machine. Measure with a larger <code>--repeats</code>", short)
        self.assertNotIn("What limits it", short)

    def test_what_does_not_grow_is_no_weak_scaling(self):
        first = dict(self.point(1, 10.0, {"solution": 6.0, "integrals": 4.0}), series="weak", efficiency=1.0)
        flat = dict(first, ranks=2, efficiency=None)
        self.assertEqual(scale["series_words"]([first, flat]), [
            "<b>Weak scaling:</b> the number of unknowns did not grow with the ranks: it is 100 on 2 ranks, not more than on one. This is no weak scaling, "
            "and no efficiency is given."])
        grown = dict(first, ranks=4, dofs=400, efficiency=0.8)
        words = scale["series_words"]([first, flat, grown])
        self.assertIn("an efficiency of 0.8", words[0])
        self.assertIn("did not grow with the ranks: it is 100 on 2 ranks, not", words[-1])

    def test_one_rank_is_compared_with_nothing(self):
        first = self.point(1, 10.0, {"solution": 6.0, "integrals": 4.0})
        self.assertIn("nothing to compare", scale["series_words"]([first])[0])
        failed = dict(first, finished=False, efficiency=None)
        self.assertIn("nothing to compare", scale["series_words"]([failed])[0])


class Paper(unittest.TestCase):
    def test_a_miss_is_expected_only_for_a_reason(self):
        for ours, reason, verdict in ((103.0, "", "met"), (106.0, "", "missed"), (106.0, "because", "expected"), (96.0, "because", "met")):
            self.assertEqual(paper["printed"]("run", "what", "name", 100.0, reason).verdict(ours), verdict)
        self.assertEqual(paper["vanishes"]("run", "what", "name", "nothing").verdict(-1e-3), "missed")
        self.assertEqual(paper["at_least"]("run", "what", "name", 0.1, "much").verdict(0.05), "missed")

    def test_misses_are_counted(self):
        words = paper["count_of"](["met", "met", "expected", "missed", "unknown"])
        self.assertTrue(words.startswith("2 of 5 results of the paper are met, 1 are missed for a known reason, <b>1 without one</b>, <b>1 have no result"))
        self.assertEqual(paper["count_of"](["met"]), "1 of 1 results of the paper are met, 0 are missed for a known reason.")


unittest.main()
