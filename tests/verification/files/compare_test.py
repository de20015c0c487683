"""`mortise compare` beside the differences of the same files, read here.

usage: compare_test.py MPIRUN MORTISE DIRECTORY
"""
import csv
import json
import os
import re
import shutil
import subprocess
import sys

import h5py
import numpy

SCENE = """<ParameterList name="block">
  <Parameter name="kinematics" type="string" value="plane strain"/>
  <ParameterList name="variables"><Parameter name="n" type="int" value="4"/><Parameter name="push" type="double" value="0.1"/></ParameterList>
  <ParameterList name="materials"><ParameterList name="soft"><Parameter name="type" type="string" value="neo hooke"/>
    <Parameter name="young's modulus" type="double" value="1"/><Parameter name="poisson's ratio" type="double" value="0.3"/></ParameterList></ParameterList>
  <ParameterList name="bodies"><ParameterList name="block"><Parameter name="material" type="string" value="soft"/><ParameterList name="mesh">
    <Parameter name="type" type="string" value="block"/><Parameter name="cells x" type="string" value="n"/><Parameter name="cells y" type="string" value="n"/>
  </ParameterList></ParameterList></ParameterList>
  <ParameterList name="boundary conditions">
    <ParameterList name="floor"><Parameter name="set" type="string" value="block/bottom"/><Parameter name="x" type="double" value="0"/>
      <Parameter name="y" type="double" value="0"/></ParameterList>
    <ParameterList name="hand"><Parameter name="set" type="string" value="block/top"/><Parameter name="y" type="string" value="-push*t"/></ParameterList>
  </ParameterList>
  <ParameterList name="stepping"><Parameter name="step" type="double" value="0.25"/><Parameter name="maximum step" type="double" value="0.25"/></ParameterList>
  <ParameterList name="output"><Parameter name="fields" type="string" value="displacement, von_mises"/></ParameterList>
  <ParameterList name="quantities">
    <ParameterList name="force"><Parameter name="type" type="string" value="reaction"/><Parameter name="set" type="string" value="block/top"/>
      <Parameter name="component" type="string" value="y"/></ParameterList>
    <ParameterList name="depth"><Parameter name="type" type="string" value="formula"/><Parameter name="value" type="string" value="push*t"/></ParameterList>
  </ParameterList>
</ParameterList>
"""


class Runs:
    def __init__(self, mpirun, program, directory):
        self.mpirun, self.program, self.directory = mpirun, program, directory
        shutil.rmtree(directory, ignore_errors=True)
        os.makedirs(directory)
        with open(os.path.join(directory, "block.xml"), "w") as file:
            file.write(SCENE)

    def path(self, name):
        return os.path.join(self.directory, name)

    def run(self, name, *settings, ranks=1):
        command = [self.mpirun, "-n", str(ranks), self.program, "run", self.path("block.xml"), "-o", self.path(name)]
        for setting in settings:
            command += ["--set", setting]
        subprocess.run(command, check=True, capture_output=True, timeout=120)

    def compare(self, a, b, *options):
        result = subprocess.run([self.program, "compare", self.path(a), self.path(b), *options], capture_output=True, text=True, timeout=60)
        return result.returncode, result.stdout + result.stderr

    def quantity(self, name, of):
        with open(os.path.join(self.path(name), "summary.json")) as file:
            return json.load(file)["quantities"][of]

    def field(self, name, of):
        """[times][nodes or elements][components]"""
        folder = os.path.join(self.path(name), "fields")
        return [numpy.array(h5py.File(os.path.join(folder, step))[of]) for step in sorted(os.listdir(folder)) if step.startswith("step")]


def require(condition, what):
    if not condition:
        print("WRONG:", what)
        sys.exit(1)


def row_of(text, name):
    return next(line for line in text.splitlines() if re.match(name + r"\s", line)).split()


def main():
    runs = Runs(*sys.argv[1:4])
    runs.run("one")
    runs.run("two_ranks", ranks=2)
    runs.run("deeper", "variables/push=0.12")
    runs.run("finer", "variables/n=5")
    runs.run("fewer", "stepping/step=0.5", "stepping/maximum step=0.5")

    code, text = runs.compare("one", "two_ranks", "--tolerance", "1e-10")
    require(code == 0 and "within the tolerance" in text and "ranks: 1, 2" in text, f"ranks: {code}\n{text}")
    code, text = runs.compare("one", "one", "--tolerance", "0")
    require(code == 0 and "largest difference over its scale: 0\n" in text, f"a run and itself: {code}\n{text}")

    code, text = runs.compare("one", "deeper")
    require(code == 0, f"without a tolerance: {code}\n{text}")
    a, b = runs.quantity("one", "force"), runs.quantity("deeper", "force")
    row = row_of(text, "force")
    require(abs(float(row[1]) - a) <= 1e-7 * abs(a) and abs(float(row[2]) - b) <= 1e-7 * abs(b), f"values: {row}")
    require(abs(float(row[4]) - abs(a - b) / max(abs(a), abs(b))) <= 0.06 * float(row[4]), f"of scale: {row}")
    for name in ("displacement", "von_mises"):
        one, other = runs.field("one", name), runs.field("deeper", name)
        difference = max(numpy.abs(x - y).max() for x, y in zip(one, other))
        scale = max(max(numpy.abs(x).max(), numpy.abs(y).max()) for x, y in zip(one, other))
        row = row_of(text, name)
        require(abs(float(row[1]) - difference) <= 1e-5 * difference, f"field {name}: {row}, {difference}")
        require(abs(float(row[2]) - difference / scale) <= 0.06 * float(row[2]), f"scale of field {name}: {row}, {scale}")
        require(row[3] == "1", f"the difference of {name} is largest at the end: {row}")
    code, text = runs.compare("one", "deeper", "--tolerance", "1e-3")
    require(code == 4 and "MISSED: the tolerance 0.001" in text, f"above the tolerance: {code}\n{text}")

    code, text = runs.compare("one", "finer", "--tolerance", "1")
    require(code == 4 and "fields are not compared: the meshes differ: 25 nodes and 16 elements, 36 and 25" in text, f"meshes: {code}\n{text}")
    # The depth is linear in the time, so that straight lines between other steps are exact.
    code, text = runs.compare("fewer", "one")
    row = row_of(text, "depth")
    require(code == 0 and "steps: 2, 4" in text and float(row[5]) <= 1e-15, f"steps: {code}\n{text}")

    code, text = runs.compare("one", "nothing")
    require(code == 5 and "nothing holds no results of a run" in text, f"a missing run: {code}\n{text}")
    shutil.copytree(runs.path("one"), runs.path("damaged"))
    with open(os.path.join(runs.path("damaged"), "summary.json"), "r+") as file:
        file.truncate(40)
    code, text = runs.compare("one", "damaged")
    require(code == 5 and "summary.json is damaged" in text, f"a damaged run: {code}\n{text}")
    shutil.copytree(runs.path("one"), runs.path("cut"))
    with open(os.path.join(runs.path("cut"), "history.csv"), "r+") as file:
        file.truncate(os.path.getsize(file.name) - 30)
    code, text = runs.compare("one", "cut")
    require(code == 5 and "history.csv: line 5 has" in text, f"a history that is cut: {code}\n{text}")
    # A value that one run alone has, in the middle of its history.
    shutil.copytree(runs.path("one"), runs.path("hole"))
    with open(os.path.join(runs.path("hole"), "history.csv"), newline="") as file:
        rows = list(csv.reader(file))
    rows[2][rows[0].index("force")] = ""
    with open(os.path.join(runs.path("hole"), "history.csv"), "w", newline="") as file:
        csv.writer(file).writerows(rows)
    code, text = runs.compare("one", "hole", "--tolerance", "1")
    require(code == 4 and row_of(text, "force")[5] == "inf", f"a value of one run alone: {code}\n{text}")
    print("compare: all as expected")


main()
