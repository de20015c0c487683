"""Launchers, processes that MPI does not join, jobs of Slurm and predictions, with small programs in the place of a cluster's.

Arguments: mpirun, the program, inputs, a directory for results. Exit code 69 without matplotlib and h5py.
"""
import json
import os
import pathlib
import shlex
import shutil
import subprocess
import sys
import unittest

try:
    import h5py  # noqa: F401
    import matplotlib  # noqa: F401
except ImportError:
    sys.exit(69)

mpirun, mortise, inputs, scratch = (sys.argv.pop(1) for _ in range(4))
SCENE = os.path.join(inputs, "paper", "patch_test.xml")
BLOCKS = os.path.join(inputs, "scaling", "pressed_blocks.xml")
SMALL = ["--set", "variables/n=4", "--set", "linear solver/type=iterative"]

# Each writes down its arguments. The first takes "-n N" and starts the rest as mpirun does.
PROGRAMS = {
    "srun": f"""while [ $# -gt 0 ]; do
  case $1 in
    -n) ranks=$2; shift 2 ;;
    --*) shift ;;
    *) break ;;
  esac
done
exec {shlex.quote(mpirun)} -n "$ranks" "$@"
""",
    "flux": f"shift\nshift\nranks=$1\nshift\nexec {shlex.quote(mpirun)} -n \"$ranks\" \"$@\"\n",
    "starter": f"ranks=${{1#--count=}}\nshift\nexec {shlex.quote(mpirun)} -n \"$ranks\" \"$@\"\n",
    "broken": "echo 'broken: error: Unable to create step for job 7'\nexit 1\n",
    # A batch system of one job at a time. The file "held" keeps jobs in the queue.
    "sbatch": """for script; do :; done
number=$(( $(cat "$FAKE/number" 2>/dev/null || echo 100) + 1 ))
echo $number > "$FAKE/number"
echo "$number;cluster"
if [ -e "$FAKE/held" ]; then echo PENDING > "$FAKE/job_$number"; else bash "$script" > "$FAKE/out_$number" 2>&1; fi
exit 0
""",
    "squeue": """while [ "$1" != --jobs ]; do shift; done
cat "$FAKE/job_$2" 2>/dev/null || { echo 'slurm_load_jobs error: Invalid job id specified' >&2; exit 1; }
""",
}


class Cluster(unittest.TestCase):
    def setUp(self):
        self.directory = os.path.join(scratch, self.id().rsplit(".", 1)[-1])
        shutil.rmtree(self.directory, ignore_errors=True)
        programs = os.path.join(self.directory, "bin")
        os.makedirs(programs)
        for name, text in PROGRAMS.items():
            path = pathlib.Path(programs, name)
            path.write_text(f'#!/bin/bash\nprintf "%s\\n" "$*" >> "$FAKE/{name}"\n' + text, encoding="utf-8")
            path.chmod(0o755)
        self.environment = {**os.environ, "PATH": programs + ":" + os.environ["PATH"], "FAKE": self.directory}

    def path(self, name):
        return os.path.join(self.directory, name)

    def text(self, name):
        with open(self.path(name), encoding="utf-8") as file:
            return file.read()

    def calls(self, program):
        return self.text(program).splitlines() if os.path.exists(self.path(program)) else []

    def run_words(self, *words, **variables):
        return subprocess.run(words, env={**self.environment, **variables}, cwd=self.directory, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              text=True, check=False, timeout=300)

    def mortise(self, *words, **variables):
        return self.run_words(mortise, *words, **variables)

    def write(self, name, text):
        with open(self.path(name), "w", encoding="utf-8") as file:
            file.write(text)
        return self.path(name)

    def study(self):
        return self.write("study.xml", f"""<ParameterList name="ranks">
  <Parameter name="scene" type="string" value="{SCENE}"/>
  <ParameterList name="axes">
    <ParameterList name="ranks">
      <Parameter name="setting" type="string" value="ranks"/>
      <Parameter name="values" type="string" value="1, 2"/>
    </ParameterList>
  </ParameterList>
  <ParameterList name="quantities">
    <ParameterList name="momentum_imbalance"><Parameter name="measure" type="string" value="itself"/></ParameterList>
  </ParameterList>
</ParameterList>
""")


class Launchers(Cluster):
    def test_srun_starts_each_run_of_a_study(self):
        ending = self.mortise("study", self.study(), "-o", "out", "--launcher", "srun --mpi=pmix")
        self.assertEqual(ending.returncode, 0, ending.stdout)
        calls = self.calls("srun")
        self.assertEqual([call.split(" run ")[0].rsplit("/", 1)[0].split(" /")[0] for call in calls], ["--mpi=pmix -n 1", "--mpi=pmix -n 2"])
        study = json.loads(self.text("out/study.json"))
        self.assertEqual(study["launcher"], ["srun", "--mpi=pmix", "-n", "{ranks}"])
        self.assertIn("srun --mpi=pmix -n 2 mortise run scene.xml", self.text("out/report.html"))

    def test_the_environment_names_a_launcher_and_the_option_another(self):
        words = ["scale", SCENE, "--ranks", "2", "-o"]
        ending = self.mortise(*words, "one", MORTISE_LAUNCHER="starter '--count={ranks}'")
        self.assertEqual(ending.returncode, 0, ending.stdout)
        self.assertEqual([call.split()[0] for call in self.calls("starter")], ["--count=1", "--count=2"])
        self.assertNotIn("memory bandwidth of", ending.stdout)  # runs may be on other nodes
        ending = self.mortise(*words, "two", "--launcher", "flux", MORTISE_LAUNCHER="starter {ranks}")
        self.assertEqual(ending.returncode, 0, ending.stdout)
        self.assertEqual([call.split()[:3] for call in self.calls("flux")], [["run", "-n", "1"], ["run", "-n", "2"]])
        self.assertEqual(len(self.calls("starter")), 2)

    def test_hard_cases_are_started_by_it(self):
        ending = self.mortise("hard", os.path.join(inputs, "hard", "ledger.xml"), "--only", "^aligned_base$", "--ranks", "2", "-o", "out", "--launcher",
                              "srun")
        self.assertIn(ending.returncode, (0, 4), ending.stdout)
        self.assertTrue(self.calls("srun") and all(call.startswith("-n 2 ") for call in self.calls("srun")))

    def test_wrong_launchers_are_told_before_anything_is_written(self):
        for launcher, code, said in [("starter --fast", 1, "please write {ranks} there"), ("srun 'x", 1, "a quote without its end"),
                                     ("  ", 1, "the launcher is empty"), ("/nowhere/srun", 5, "there is no such program"),
                                     ("nosuchprogram {ranks}", 5, "no such program on the PATH")]:
            for words in (["study", self.study()], ["scale", SCENE]):
                with self.subTest(launcher=launcher, command=words[0]):
                    ending = self.mortise(*words, "-o", "out", "--launcher", launcher)
                    self.assertEqual(ending.returncode, code, ending.stdout)
                    self.assertIn(said, ending.stdout)
                    self.assertFalse(os.path.exists(self.path("out")))

    def test_a_launcher_that_fails_is_quoted_with_what_it_printed(self):
        ending = self.mortise("study", self.study(), "-o", "out", "--launcher", "broken -x {ranks}")
        self.assertEqual(ending.returncode, 3, ending.stdout)
        said = json.loads(self.text("out/study.json"))["points"][1]["said"]
        self.assertTrue(said.startswith("broken -x 2 "), said)
        self.assertIn("ended with code 1:\nbroken: error: Unable to create step for job 7", said)


class Singletons(Cluster):
    def run_scene(self, **variables):
        return self.mortise("run", SCENE, "-o", "out", "--quiet", **variables)

    def test_processes_that_mpi_does_not_join_are_refused(self):
        for processes, rank in [("SLURM_STEP_NUM_TASKS", "SLURM_PROCID"), ("FLUX_JOB_SIZE", "FLUX_TASK_RANK"), ("PALS_LOCAL_SIZE", "PALS_RANKID"),
                                ("PMI_SIZE", "PMI_RANK")]:
            for number in (0, 2):
                with self.subTest(variable=processes, rank=number):
                    ending = self.run_scene(**{processes: "4", rank: str(number)})
                    self.assertEqual(ending.returncode, 0 if number else 2, ending.stdout)
                    if number:
                        self.assertEqual(ending.stdout, "")
                    else:
                        self.assertIn(f"started 4 processes or more ({processes}), but MPI does not join them", ending.stdout)
                    self.assertFalse(os.path.exists(self.path("out")))

    def test_a_rank_on_another_node_is_not_alone(self):
        self.assertEqual(self.run_scene(PALS_LOCAL_SIZE="1", PALS_RANKID="3").stdout, "")
        self.assertFalse(os.path.exists(self.path("out")))

    def test_one_of_four_answers(self):
        self.write("four.sh", f"""for rank in 0 1 2 3; do
  SLURM_STEP_NUM_TASKS=4 SLURM_PROCID=$rank {shlex.quote(mortise)} "$@" &
done
wait
""")
        ending = self.run_words("bash", "four.sh", "run", SCENE, "-o", "out")
        self.assertEqual(ending.stdout.count("MPI does not join them"), 1)
        self.assertFalse(os.path.exists(self.path("out")))
        ending = self.run_words("bash", "four.sh", "scale", SCENE, "-o", "out")
        self.assertEqual(ending.stdout.count("please call it without mpirun or srun"), 1)
        ending = self.run_words("bash", "four.sh", "run", SCENE, "--no-such-option")
        self.assertEqual(ending.stdout.count("--no-such-option"), 1, ending.stdout)

    def test_job_scripts_and_processes_that_are_meant_to_be_alone_run(self):
        for variables in ({"SLURM_NTASKS": "4", "SLURM_PROCID": "0"}, {"SLURM_STEP_NUM_TASKS": "1", "SLURM_PROCID": "0"}, {"FLUX_JOB_SIZE": "1"}):
            with self.subTest(variables=variables):
                ending = self.run_scene(**variables)
                self.assertEqual(ending.returncode, 0, ending.stdout)

    def test_mpirun_within_srun_joins_its_processes(self):
        for ranks in (1, 2):
            ending = self.run_words(mpirun, "-n", str(ranks), mortise, "run", SCENE, "-o", "out", "--quiet", SLURM_STEP_NUM_TASKS="4", SLURM_PROCID="0")
            self.assertEqual(ending.returncode, 0, ending.stdout)
            self.assertEqual(json.loads(self.text("out/summary.json"))["ranks"], ranks)


MACHINE = """<ParameterList name="toy">
  <Parameter name="cores per node" type="int" value="2"/>
  <Parameter name="memory per node" type="double" value="{memory}"/>
  <ParameterList name="network"><Parameter name="latency" type="double" value="0"/></ParameterList>
  <ParameterList name="measured">
    <Parameter name="newton iterations" type="int" value="3"/>
    <Parameter name="linear iterations" type="int" value="20"/>
  </ParameterList>
  <ParameterList name="rates">
    <ParameterList name="mesh"><Parameter name="whole" type="double" value="0.001"/></ParameterList>
    <ParameterList name="bulk"><Parameter name="rank" type="double" value="0.01"/></ParameterList>
  </ParameterList>
</ParameterList>
"""


class Plans(Cluster):
    def plan(self, *more, memory=4000, ranks=8):
        machine = self.write("machine.xml", MACHINE.format(memory=memory))
        return self.mortise("scale", BLOCKS, *SMALL, "--plan", str(ranks), "--machine", machine, "-o", "plan", *more)

    def test_times_are_those_of_the_rates(self):
        ending = self.plan()
        self.assertEqual(ending.returncode, 0, ending.stdout)
        plan = json.loads(self.text("plan/plan.json"))
        points = {point["ranks"]: point for point in plan["prediction"]["points"]}
        self.assertEqual(list(points), [1, 2, 4, 8])
        self.assertEqual([point["nodes"] for point in points.values()], [1, 1, 2, 4])
        elements = plan["per_rank"]["elements"]["total"]
        self.assertAlmostEqual(points[1]["seconds"], 0.001 * elements + 3 * 0.01 * elements)
        self.assertAlmostEqual(points[8]["phases"]["bulk"], 3 * 0.01 * plan["work"]["bulk"]["most"])
        self.assertLess(elements / 8, plan["work"]["bulk"]["most"])  # elements of other ranks that touch its nodes are its work too
        for point in points.values():
            self.assertAlmostEqual(point["core_seconds"], point["seconds"] * 2 * point["nodes"])
        self.assertEqual(plan["prediction"]["cheapest"], min(points.values(), key=lambda point: point["core_seconds"])["ranks"])
        self.assertIn("cheapest: 2 rank(s) on 1 node(s)", ending.stdout)

    def test_memory_decides_what_fits(self):
        need = json.loads(self.text("plan/plan.json"))["prediction"]["points"] if self.plan().returncode == 0 else []
        self.assertGreater(need[1]["memory_per_node_mib"], need[0]["memory_per_node_mib"])
        ending = self.plan(memory=0.5 * (need[0]["memory_per_node_mib"] + need[1]["memory_per_node_mib"]))
        self.assertIn("cheapest: 1 rank(s)", ending.stdout)
        self.assertIn("does not fit", ending.stdout)
        self.assertIn("no number of ranks up to 8 fits into nodes of 10 MiB", self.plan(memory=10).stdout)

    def test_bad_machines_are_told(self):
        machine = self.write("bad.xml", """<ParameterList name="bad">
  <Parameter name="cores per node" type="int" value="0"/>
  <Parameter name="cores" type="int" value="4"/>
  <Parameter name="bandwidth of a core" type="double" value="10"/>
</ParameterList>
""")
        ending = self.mortise("scale", BLOCKS, "--plan", "4", "--machine", machine, "-o", "plan")
        self.assertEqual(ending.returncode, 2, ending.stdout)
        for said in ("cores per node", 'unknown parameter "cores"', "memory per node", "go together"):
            self.assertIn(said, ending.stdout)
        self.assertEqual(self.mortise("scale", BLOCKS, "--plan", "4", "--machine", "none.xml").returncode, 5)
        self.assertEqual(self.mortise("scale", BLOCKS, "--machine", machine).returncode, 1)
        self.assertEqual(self.mortise("scale", "--plan", "4").returncode, 1)

    def test_a_measured_machine_predicts_the_runs_that_it_is_of(self):
        ending = self.mortise("scale", BLOCKS, *SMALL, "--set", "variables/n=8", "--ranks", "2", "-o", "measured")
        self.assertEqual(ending.returncode, 0, ending.stdout)
        measured = json.loads(self.text("measured/scale.json"))["points"]
        ending = self.mortise("scale", BLOCKS, *SMALL, "--set", "variables/n=8", "--plan", "2", "--machine", "measured/machine.xml", "-o", "plan")
        self.assertEqual(ending.returncode, 0, ending.stdout)
        prediction = json.loads(self.text("plan/plan.json"))["prediction"]
        for point, predicted in zip(measured, prediction["points"]):
            # Times depend on what else this machine does: arithmetic with given rates is another test.
            if point["ranks"] == 1:
                self.assertGreater(predicted["seconds"], 0.0)
                self.assertEqual(set(predicted["phases"]), set(point["phases"]))


class Jobs(Cluster):
    def batch(self, *more):
        machine = self.write("machine.xml", MACHINE.format(memory=4000))
        return self.mortise("scale", BLOCKS, *SMALL, "--ranks", "2", "--batch", "slurm", "--machine", machine, "-o", "jobs", *more)

    def submit(self, *words):
        return self.run_words("bash", "jobs/submit.sh", *words)

    def states(self):
        return [point["state"] for point in json.loads(self.text("jobs/scale.json"))["points"]]

    def test_jobs_give_what_a_direct_run_gives(self):
        ending = self.batch("--weak", "n:4", "--repeats", "2")
        self.assertEqual(ending.returncode, 0, ending.stdout)
        self.assertEqual(self.calls("srun") + self.calls("sbatch"), [])
        script = self.text("jobs/jobs/strong_2.sh")
        for line in ("--nodes=1", "--ntasks=2", "--ntasks-per-node=2", "--mem=", "--time=0-00:"):
            self.assertIn("#SBATCH " + line, script)
        index = json.loads(self.text("jobs/scale-jobs.json"))
        self.assertEqual([(point["series"], point["ranks"]) for point in index["points"]], [("strong", 1), ("strong", 2), ("weak", 1), ("weak", 2)])
        ending = self.mortise("scale", "--harvest", "jobs")
        self.assertEqual(ending.returncode, 3, ending.stdout)
        self.assertEqual(self.states(), ["missing"] * 4)

        ending = self.submit("--partition=short")
        self.assertEqual(ending.returncode, 0, ending.stdout)
        self.assertEqual(len(self.calls("sbatch")), 4)
        self.assertIn("--partition=short", self.calls("sbatch")[0])
        self.assertEqual(len(self.calls("srun")), 8)
        ending = self.mortise("scale", "--harvest", "jobs")
        self.assertEqual(ending.returncode, 0, ending.stdout)
        self.assertIn("4 finished, 0 failed, 0 running, 0 waiting, 0 missing", ending.stdout)
        harvested = json.loads(self.text("jobs/scale.json"))
        ending = self.mortise("scale", BLOCKS, *SMALL, "--ranks", "2", "--weak", "n:4", "--repeats", "2", "-o", "direct")
        self.assertEqual(ending.returncode, 0, ending.stdout)
        direct = json.loads(self.text("direct/scale.json"))
        self.assertEqual(list(harvested), list(direct))
        for one, other in zip(harvested["points"], direct["points"]):
            self.assertEqual(list(one), list(other))
            for name in ("series", "ranks", "settings", "dofs", "newton_iterations", "linear_iterations"):
                self.assertEqual(one[name], other[name])
            self.assertEqual(len(one["repeats"]), 2)
        for name in ("scale.csv", "scale.svg", "report.html", "machine.xml"):
            self.assertTrue(os.path.exists(self.path("jobs/" + name)), name)

        ending = self.batch("--weak", "n:4", "--repeats", "2")
        self.assertIn("4 of 4 runs have finished", ending.stdout)
        self.assertEqual(self.submit().stdout.count("has finished"), 4)
        self.assertEqual(len(self.calls("sbatch")), 4)
        ending = self.batch("--set", "variables/mu=0.1")
        self.assertEqual(ending.returncode, 2, ending.stdout)
        self.assertIn("holds jobs of another scene", ending.stdout)

    def test_waiting_running_failed_and_lost_jobs_are_told(self):
        self.assertEqual(self.batch().returncode, 0)
        self.write("held", "")
        self.assertEqual(self.submit().returncode, 0)
        self.assertIn("in the queue as job", self.submit().stdout)
        self.assertEqual(len(self.calls("sbatch")), 2)
        self.mortise("scale", "--harvest", "jobs")
        self.assertEqual(self.states(), ["waiting", "waiting"])
        self.write("jobs/jobs/strong_1.1.started", "now\n")
        self.write("job_101", "RUNNING\n")
        os.remove(self.path("job_102"))
        self.write("jobs/jobs/strong_2.log", "slurmstepd: error: Detected 1 oom_kill event\n")
        ending = self.mortise("scale", "--harvest", "jobs")
        self.assertEqual(ending.returncode, 3)
        self.assertEqual(self.states(), ["running", "failed"])
        self.assertIn("oom_kill", self.text("jobs/report.html"))
        # The next call starts what was lost, and its failure is told with what it printed.
        os.remove(self.path("held"))
        shutil.copy(self.path("bin/broken"), self.path("bin/srun"))
        self.assertIn("strong_2: job 103", self.submit().stdout)
        ending = self.mortise("scale", "--harvest", "jobs")
        self.assertEqual(self.states(), ["running", "failed"])
        self.assertIn("Unable to create step", ending.stdout)

    def test_a_run_without_results_is_run_again(self):
        self.assertEqual(self.batch().returncode, 0)
        self.submit()
        for left in (None, "{ cut"):
            summary = self.path("jobs/runs/strong_2/repeat_1/summary.json")
            if left is None:
                os.remove(summary)
            else:
                self.write("jobs/runs/strong_2/repeat_1/summary.json", left)
            ending = self.mortise("scale", "--harvest", "jobs")
            self.assertEqual(self.states(), ["finished", "failed"])
            self.assertIn("summary.json is not there or cannot be read", ending.stdout)
            self.submit()
            self.mortise("scale", "--harvest", "jobs")
            self.assertEqual(self.states(), ["finished", "finished"])
        self.write("jobs/jobs/strong_1.1.exit", "")
        self.mortise("scale", "--harvest", "jobs")
        self.assertEqual(self.states(), ["failed", "finished"])

    def test_a_scene_that_was_edited_meanwhile_is_not_run(self):
        text = pathlib.Path(BLOCKS).read_text()
        self.write("own.xml", text)
        machine = self.write("machine.xml", MACHINE.format(memory=4000))
        words = ["scale", "own.xml", *SMALL, "--ranks", "2", "--batch", "slurm", "--machine", machine, "-o", "jobs"]
        self.assertEqual(self.mortise(*words).returncode, 0)
        self.write("own.xml", text + "<!-- edited -->\n")
        self.submit()
        ending = self.mortise("scale", "--harvest", "jobs")
        self.assertEqual(self.states(), ["failed", "failed"])
        self.assertIn("is another one than when the jobs were written", ending.stdout)
        self.write("own.xml", text)
        self.submit()
        self.mortise("scale", "--harvest", "jobs")
        self.assertEqual(self.states(), ["finished", "finished"])

    def test_jobs_that_do_not_fit_are_refused(self):
        machine = self.write("small.xml", MACHINE.format(memory=20))
        ending = self.mortise("scale", BLOCKS, *SMALL, "--batch", "slurm", "--machine", machine, "-o", "jobs")
        self.assertEqual(ending.returncode, 2, ending.stdout)
        self.assertIn("MiB on a node", ending.stdout)
        self.assertFalse(os.path.exists(self.path("jobs")))
        self.assertEqual(self.mortise("scale", BLOCKS, "--batch", "slurm").returncode, 1)
        self.assertEqual(self.mortise("scale", "--harvest", "nowhere").returncode, 5)


if __name__ == "__main__":
    unittest.main()
