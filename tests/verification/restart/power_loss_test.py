"""A loss of power: what was not brought to the disk is gone, and the run goes on from its last checkpoint all the same.

Arguments: the program, a scene, a directory for results. Exit code 69 without strace.

A run is killed at a write or a rename. The calls that it made, as strace saw them, say what a file system may keep that promises no more than POSIX:
the names of a directory as they were at its last fsync, and of a file nothing but what was written before its last fsync. All else is taken away.
"""
import os
import re
import shutil
import subprocess
import sys

if not shutil.which("strace"):
    sys.exit(69)

program, scene, scratch = sys.argv[1:4]
SHORT = ("stepping/end time=0.1", "stepping/output times=", "checks/on the cone/low=0", "output/checkpoints/every step=1", "output/fields=displacement")
STATES = 12
CALLS = "openat,mkdir,rename,link,unlink,rmdir,write,pwrite64,pwritev,ftruncate,fsync,fdatasync"
CALL = re.compile(r"^\d+\s+(\w+)\((.*)\)\s*=\s*(-?\d+)")
TEXT = re.compile(r'"((?:[^"\\]|\\.)*)"')
HANDLE = re.compile(r"^\d+<([^>]*)>")


class Disk:
    """Names and contents that a loss of power leaves."""

    def __init__(self, below):
        self.below, self.names, self.kept, self.size, self.synced, self.next = below, {}, {}, {}, {}, 0

    def new(self):
        self.next += 1
        self.size[self.next] = 0
        return self.next

    def moved(self, old, new):
        for path in [path for path in self.names if path == old or path.startswith(old + "/")]:
            self.names[new + path[len(old):]] = self.names.pop(path)

    def call(self, name, arguments, result):
        if result < 0:
            return
        paths = [os.path.normpath(os.path.join(os.getcwd(), text)) for text in TEXT.findall(arguments)]
        handle = HANDLE.match(arguments)
        if name == "openat" and paths and paths[0].startswith(self.below):
            if "O_CREAT" in arguments and paths[0] not in self.names:
                self.names[paths[0]] = self.new()
            if "O_TRUNC" in arguments and paths[0] in self.names:
                self.size[self.names[paths[0]]] = 0
        elif name == "mkdir":
            self.names.setdefault(paths[0], self.new())
        elif name == "rename":
            self.moved(*paths[:2])
        elif name == "link":
            self.names[paths[1]] = self.names[paths[0]]
        elif name in ("unlink", "rmdir"):
            self.names.pop(paths[0], None)
        elif handle and handle[1] in self.names and name in ("write", "pwrite64", "pwritev", "ftruncate"):
            one, numbers = self.names[handle[1]], re.findall(r", (\d+)", arguments)
            if name == "ftruncate":
                self.size[one] = int(numbers[-1])
            elif name == "write":
                self.size[one] += result
            else:
                self.size[one] = max(self.size[one], int(numbers[-1]) + result)
        elif handle and name in ("fsync", "fdatasync"):
            if os.path.isdir(handle[1]):
                inside = lambda entries: {path: one for path, one in entries.items() if os.path.dirname(path) == handle[1]}
                for path in inside(self.kept):
                    del self.kept[path]
                self.kept.update(inside(self.names))
            elif handle[1] in self.names:
                self.synced[self.names[handle[1]]] = self.size[self.names[handle[1]]]

    def lose_power(self):
        """Takes away what is not on the disk. A name whose former file was on the disk, and whose new one is not, has an empty file. What was written
        over counts as written."""
        for folder, folders, files in os.walk(self.below, topdown=False):
            for one in folders + files:
                path = os.path.join(folder, one)
                if path not in self.kept:
                    shutil.rmtree(path) if os.path.isdir(path) else os.remove(path)
                elif not os.path.isdir(path):
                    size = self.synced.get(self.kept[path], 0) if self.kept[path] == self.names.get(path) else 0
                    os.truncate(path, min(size, os.path.getsize(path)))


def command(results, *more):
    return [program, "run", scene, "-o", results, *[word for setting in SHORT for word in ("--set", setting)], *more]


def traced(results, *options):
    """The calls of a run, and its exit code."""
    log = os.path.join(scratch, "calls.txt")
    ending = subprocess.run(["strace", "-f", "-y", "-qq", "-s", "4096", "-o", log, "-e", f"trace={CALLS}", *options, *command(results)], capture_output=True,
                            text=True, timeout=300, check=False)
    if "ptrace" in ending.stderr:
        sys.exit(69)
    with open(log, encoding="utf-8", errors="replace") as file:
        return [match.groups() for match in map(CALL.match, file) if match], ending.returncode


def disk_after(calls, below):
    disk = Disk(below)
    for name, arguments, result in calls:
        disk.call(name, arguments, int(result))
    return disk


def history(results):
    """The numbers of all steps."""
    with open(os.path.join(results, "history.csv"), encoding="utf-8") as file:
        return [float(cell) for line in file.read().splitlines()[1:] for cell in line.split(",") if re.fullmatch(r"[-+.\deE]+", cell)]


def main():
    shutil.rmtree(scratch, ignore_errors=True)
    os.makedirs(scratch)
    whole = os.path.join(scratch, "whole", "results")
    calls, code = traced(whole)
    assert code == 0, code
    expected = history(whole)
    # From the first checkpoint on, which is on the disk when the second one begins.
    renames = [at for at, (name, arguments, _) in enumerate(calls) if name == "rename" and "checkpoints/step-" in arguments]
    assert len(renames) > 3, len(renames)
    lost = 0
    for state in range(STATES):
        until = renames[1] + 1 + (len(calls) - renames[1]) * state // STATES
        name = "pwrite64" if state % 2 else "rename"
        count = max(1, sum(call == name for call, _, _ in calls[:until]))
        top = os.path.join(scratch, f"state_{state}")
        results = os.path.join(top, "deep", "results")  # the run makes both
        os.makedirs(top)
        made, _ = traced(results, "-e", f"inject={name}:signal=KILL:when={count}")
        disk_after(made, top).lose_power()
        ending = subprocess.run(command(results, "--restart"), capture_output=True, text=True, timeout=300, check=False)
        good = ending.returncode == 0
        if good:
            found = history(results)
            good = len(found) == len(expected) and all(abs(a - b) <= 1e-9 * max(1, abs(b)) for a, b in zip(found, expected))
        lost += not good
        print(f"{'ok      ' if good else 'FAILED  '}power lost at {name} {count}: restart ends with {ending.returncode}"
              + ("" if good else ": " + (ending.stdout + ending.stderr).strip()[-300:]), flush=True)
    print(f"{lost} of {STATES} lost")
    sys.exit(1 if lost else 0)


main()
