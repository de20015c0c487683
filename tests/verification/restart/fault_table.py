"""Effects of faults on a run: a table for docs/results/faults.md.

python3 fault_table.py MPIRUN PROGRAM SCENE SCRATCH   (as root: full disks are small file systems in memory)

Each fault is injected into a run with a checkpoint after each step. Then its cause is taken away and the run goes on. It has survived if the end is
that of a run in one piece. Lost are steps that were in history.csv when the run ended and had to be computed again.
"""
import os
import re
import resource
import shutil
import signal
import subprocess
import sys
import time

from run_files import checkpoints, rows, same

mpirun, program, scene, scratch = sys.argv[1:5]
shutil.rmtree(scratch, ignore_errors=True)
os.makedirs(scratch)


def command(results, ranks=1, *more):
    return [*([mpirun, "-n", str(ranks)] if ranks > 1 else []), program, "run", scene, "-o", results, "--set", "output/checkpoints/every step=1", *more]


def message(output):
    lines = [line for line in output.splitlines() if re.search(r"cannot|no space|memory|too large|written by|signal|stopped|sign|failed|denied|Read-only", line, re.I)]
    return (lines[0] if lines else (output.strip().splitlines() or [""])[-1]).replace("|", "/").replace(scratch, "DIR")[:160]


straight = os.path.join(scratch, "straight")
subprocess.run(command(straight), check=True, stdout=subprocess.DEVNULL, timeout=300)
lines, failed = [], 0


def go_on(results, ranks):
    """Goes on with the run. True if it comes to its end, the number of steps that were computed again, and the output."""
    done = len(rows(results))
    left = checkpoints(results)
    step = left[-1] if left else 0
    ending = subprocess.run(command(results, ranks, *(["--restart"] if left else [])), capture_output=True, text=True, timeout=300, check=False)
    good = ending.returncode == 0 and same(straight, results)
    return good, max(0, done - step), ending.stdout + ending.stderr


def add(fault, results, seconds, code, output, ranks=1, again=None):
    global failed
    good, lost, said = go_on(again or results, ranks)
    if not good:
        failed += 1
        print(fault, said[-400:], sep="\n")
    lines.append(f"| {fault} | {'yes' if good else 'NO'} | {lost} | {seconds:.1f} | {code} | {message(output)} |")
    print(lines[-1], flush=True)


def limited(what, value):
    return lambda: resource.setrlimit(what, (value, value))


def timed(words, **options):
    begin = time.monotonic()
    try:
        ending = subprocess.run(words, capture_output=True, text=True, timeout=120, check=False, **options)
        return time.monotonic() - begin, ending.returncode, ending.stdout + ending.stderr
    except subprocess.TimeoutExpired:
        return time.monotonic() - begin, "hang", ""


# A full disk: the directory is on a file system of that size. What was written is then copied to where there is room.
for size in (64, 96, 128, 192, 256, 320, 384, 448, 512, 640, 768, 896, 1024, 1280, 1536, 1792):
    ranks = 2 if size % 128 else 1
    disk, results = os.path.join(scratch, "disk"), os.path.join(scratch, "disk", "run")
    os.makedirs(disk, exist_ok=True)
    subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={size}k", "tmpfs", disk], check=True)
    try:
        seconds, code, output = timed(command(results, ranks))
        copy = os.path.join(scratch, "copy")
        shutil.rmtree(copy, ignore_errors=True)
        shutil.copytree(results, copy) if os.path.isdir(results) else os.makedirs(copy)
    finally:
        subprocess.run(["umount", disk], check=True)
    add(f"disk of {size} KiB, {ranks} rank(s)", results, seconds, code, output, 1, copy)

for size in (4, 16, 32, 64):
    results = os.path.join(scratch, "file_limit")
    shutil.rmtree(results, ignore_errors=True)
    seconds, code, output = timed(command(results), preexec_fn=limited(resource.RLIMIT_FSIZE, size * 1024))
    add(f"files of at most {size} KiB", results, seconds, code, output)

for size in (200, 250, 300, 400):
    results = os.path.join(scratch, "memory")
    shutil.rmtree(results, ignore_errors=True)
    seconds, code, output = timed(command(results), preexec_fn=limited(resource.RLIMIT_AS, size << 20))
    add(f"address space of {size} MiB", results, seconds, code, output)


def wait_for(results, count):
    while len(rows(results)) < count:
        time.sleep(0.01)


def with_signal(fault, ranks, to_rank, number):
    results = os.path.join(scratch, "signal")
    shutil.rmtree(results, ignore_errors=True)
    process = subprocess.Popen(command(results, ranks), stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                               preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL))  # jobs in the background ignore it
    wait_for(results, 5)
    target = process.pid
    if ranks > 1:
        children = subprocess.run(["pgrep", "-P", str(process.pid)], capture_output=True, text=True, check=True).stdout.split()
        target = int(children[to_rank])
    begin = time.monotonic()
    os.kill(target, number)
    if number == signal.SIGSTOP:
        time.sleep(20)
        os.kill(target, signal.SIGCONT)
    output = process.communicate(timeout=120)[0]
    add(fault, results, time.monotonic() - begin, process.returncode, output, ranks)


with_signal("SIGTERM", 1, 0, signal.SIGTERM)
with_signal("SIGINT", 1, 0, signal.SIGINT)
with_signal("SIGKILL", 1, 0, signal.SIGKILL)
with_signal("SIGUSR1 to one of 3 ranks", 3, 2, signal.SIGUSR1)
with_signal("SIGKILL to one of 3 ranks", 3, 1, signal.SIGKILL)
with_signal("one of 3 ranks stopped for 20 s", 3, 1, signal.SIGSTOP)
with_signal("the first of 3 ranks stopped for 20 s", 3, 0, signal.SIGSTOP)

results = os.path.join(scratch, "concurrent")
first = subprocess.Popen(command(results), stdout=subprocess.DEVNULL)
wait_for(results, 3)
seconds, code, output = timed(command(results))
first.wait()
lines.append(f"| a second run into the same directory | {'yes' if same(straight, results) and code == 5 else 'NO'} | 0 | {seconds:.1f} | {code} | {message(output)} |")
failed += not same(straight, results) or code != 5

for name, make in (("a file instead of the directory", lambda path: open(path, "w", encoding="utf-8").close()),
                   ("a directory that is read only (mounted)", None)):
    results = os.path.join(scratch, "place")
    shutil.rmtree(results, ignore_errors=True)
    if make:
        make(results)
    else:
        os.remove(results) if os.path.isfile(results) else None
        os.makedirs(results)
        subprocess.run(["mount", "-t", "tmpfs", "-o", "ro", "tmpfs", results], check=True)
    seconds, code, output = timed(command(results))
    if not make:
        subprocess.run(["umount", results], check=True)
    lines.append(f"| {name} | {'yes' if code == 5 else 'NO'} | 0 | {seconds:.1f} | {code} | {message(output)} |")
    failed += code != 5
    if make:
        os.remove(results)

with open(os.path.join(scratch, "table.md"), "w", encoding="utf-8") as file:
    file.write("| fault | survived | steps lost | seconds | exit code | message |\n|---|---|---|---|---|---|\n" + "\n".join(lines) + "\n")
sys.exit(1 if failed else 0)
