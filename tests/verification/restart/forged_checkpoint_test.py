"""Checkpoints whose checksum is right and whose numbers are not: each is refused by the name of the dataset, and no file of results changes.

Arguments: the program, a scene, a directory for results. Exit code 69 without h5py.
"""
import os
import shutil
import subprocess
import sys
import zlib

try:
    import h5py
except ImportError:
    sys.exit(69)

program, scene, scratch = sys.argv[1:4]
LAST_LINE = 64
# Quantities may have no value at a step.
MAY_BE_NONE = "values/record.quantities"


# Three steps, before all of the block slips.
SHORT = ("stepping/end time=0.05", "stepping/output times=", "checks/on the cone/low=0", "output/checkpoints/every step=1")


def run(results, *more):
    settings = [word for setting in SHORT for word in ("--set", setting)]
    return subprocess.run([program, "run", scene, "-o", results, *settings, *more], capture_output=True, text=True, timeout=300, check=False)


def sign(path):
    """Puts the line with length and checksum behind what HDF5 has written."""
    with open(path, "rb") as file:
        data = file.read()
    with open(path, "ab") as file:
        file.write(f"\nmortise checkpoint 1 bytes {len(data)} crc32 {zlib.crc32(data):08x}".ljust(LAST_LINE - 1).encode() + b"\n")


def forge(path, name, value):
    size = os.path.getsize(path)
    os.truncate(path, size - LAST_LINE)
    with h5py.File(path, "r+") as file:
        numbers = file[name][...]
        numbers.flat[numbers.size // 2] = value
        file[name][...] = numbers
    sign(path)


def contents(results):
    """Of all files but the log, which tells what happened."""
    content = {}
    for folder, _, names in os.walk(results):
        for name in names:
            if name != "log.txt":
                with open(os.path.join(folder, name), "rb") as file:
                    content[os.path.join(folder, name)] = file.read()
    return content


def finite_datasets(path):
    """Those with numbers that all have to be finite."""
    names = []
    with h5py.File(path, "r") as file:
        for group in ("rows", "values"):
            for name, dataset in file[group].items():
                if dataset.size > 0 and f"{group}/{name}" != MAY_BE_NONE:
                    names.append(f"{group}/{name}")
    return names


straight, forged = os.path.join(scratch, "straight"), os.path.join(scratch, "forged")
shutil.rmtree(scratch, ignore_errors=True)
os.makedirs(scratch)
ending = run(straight)
if ending.returncode != 0:
    sys.exit(ending.stdout + ending.stderr)
checkpoint = os.path.join("checkpoints", "step-000002.h5")
wrong = []

# A file that is put together again as it was is taken: it is the number that is refused.
shutil.copytree(straight, forged)
with h5py.File(os.path.join(straight, checkpoint), "r") as whole:
    same = whole["rows/x"][...].flat[whole["rows/x"].size // 2]
forge(os.path.join(forged, checkpoint), "rows/x", same)
ending = run(forged, "--restart", "2")
if ending.returncode != 0:
    wrong.append(f"a checkpoint that holds what it held: {ending.returncode}, {ending.stdout}{ending.stderr}")

names = finite_datasets(os.path.join(straight, checkpoint))
for name in names:
    for value in (float("nan"), float("inf")) if name == "rows/x" else (float("nan"),):
        shutil.rmtree(forged)
        shutil.copytree(straight, forged)
        forge(os.path.join(forged, checkpoint), name, value)
        before = contents(forged)
        ending = run(forged, "--restart", "2")
        said = ending.stdout + ending.stderr
        if ending.returncode != 5 or f'"{name.split("/", 1)[1]}" holds {value}' not in said:
            wrong.append(f"{value} in {name}: {ending.returncode}, {said[-300:]}")
        after = contents(forged)
        if after != before:
            wrong.append(f"{value} in {name}: changed are {[one for one in after if after[one] != before.get(one)]}")

print(f"{len(names)} datasets: {len(wrong)} wrong", *wrong, sep="\n")
sys.exit(1 if wrong or "rows/x" not in names else 0)
