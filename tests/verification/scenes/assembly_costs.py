"""Measures what docs/results/assemblies.md says: a million hexahedra from a file, and contact pairs that the program finds, in seconds and MiB.

usage: assembly_costs.py MPIRUN MORTISE DIRECTORY [CELLS [CELLS OF A BRICK ...]]

CELLS along an edge of the cube: 100. Gmsh makes its mesh. Nothing else should run beside; the cube needs 15 GiB.
"""
import os
import re
import resource
import subprocess
import sys

from scene_writer import Bench, named, parameter

bench = Bench(*sys.argv[1:4])
CELLS = int(sys.argv[4]) if len(sys.argv) > 4 else 100
BRICKS = [int(n) for n in sys.argv[5:]] or [12, 24]
SMALL = named("materials", named("m", type="small strain linear", **{"young's modulus": 1000.0, "poisson's ratio": 0.3}))
CUBE = """n = {n};
Point(1) = {{0, 0, 0}}; e[] = Extrude {{1, 0, 0}} {{ Point{{1}}; Layers{{n}}; Recombine; }};
f[] = Extrude {{0, 1, 0}} {{ Line{{e[1]}}; Layers{{n}}; Recombine; }};
v[] = Extrude {{0, 0, 1}} {{ Surface{{f[1]}}; Layers{{n}}; Recombine; }};
Physical Volume("cube") = {{v[1]}}; Physical Surface("bottom") = {{f[1]}}; Physical Surface("top") = {{v[0]}};
"""


def check_of_ranks(scene, ranks):
    """Peaks of the ranks [MiB], the largest first, while the model is made, and seconds."""
    launched = [bench.mpirun, "-n", str(ranks)] if ranks > 1 else []
    done = subprocess.run(launched + ["/usr/bin/time", "-f", "peak %M KiB %e s", bench.mortise, "check", scene], capture_output=True, text=True)
    found = re.findall(r"peak (\d+) KiB ([\d.]+) s", done.stderr)
    return sorted((int(peak) // 1024 for peak, _ in found), reverse=True), max(float(seconds) for _, seconds in found)


def cube():
    geometry, mesh = os.path.join(bench.directory, "cube.geo"), os.path.join(bench.directory, "cube.msh")
    with open(geometry, "w", encoding="utf-8") as file:
        file.write(CUBE.format(n=CELLS))
    subprocess.run(["gmsh", "-3", "-bin", "-format", "msh41", "-o", mesh, geometry], check=True, capture_output=True)
    content = [parameter("kinematics", "three dimensional"), SMALL, named("bodies", named("cube", named("mesh", type="file", file="cube.msh"), material="m", element="H8")),
               named("boundary conditions", named("floor", set="cube/bottom", x=0, y=0, z=0), named("lid", set="cube/top", x=0, y=0, z=-0.01)), named("stepping", step=1.0)]
    for ranks in (1, 2):
        code, said, _ = bench.call("cube", content, ranks, ["--verbose"])
        first = re.search(r"^ +1 .* ([\d.]+)$", said, re.M)
        print(f"{CELLS}^3 hexahedra on {ranks} rank(s): exit code {code}, first Newton iteration {first[1] if first else '-'} s, {said.strip().splitlines()[-1]}")
    for ranks in (1, 2, 4):
        peaks, seconds = check_of_ranks(os.path.join(bench.directory, "cube.xml"), ranks)
        print(f"  made on {ranks} rank(s): peaks {peaks} MiB, {seconds} s")


def processor_seconds(function):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    result = function()
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, result


def bricks(n):
    across = lambda i: n if i % 2 else n - 3
    body = lambda i: named(f"b{i}", named("mesh", type="brick", cells_x=across(i), cells_y=across(i), cells_z=n, translation=f"0, 0, {i}"), material="m")
    content = [parameter("kinematics", "three dimensional"), SMALL, named("bodies", *(body(i) for i in range(20))),
               named("boundary conditions", named("floor", set="b0/bottom", x=0, y=0, z=0), named("lid", set="b19/top", x=0, y=0, z=-0.02)),
               named("automatic contact", named("friction", type="coulomb", coefficient=0.3), pairs="automatic"), named("stepping", step=1.0), named("output", fields=""),
               named("quantities", named("force", type="reaction", set="b19/top", component="z"))]
    name = f"bricks {n}"
    whole, found = processor_seconds(lambda: bench.run(name, content))
    by_hand = os.path.join(bench.directory, name, "effective.xml")
    subprocess.run([bench.mortise, "run", by_hand, "--quiet", "-o", os.path.join(bench.directory, name + " by hand")], check=True)
    least = lambda scene: min(processor_seconds(lambda: subprocess.run([bench.mortise, "check", scene], check=True, capture_output=True))[0] for _ in range(3))
    print(f"20 bricks, n = {n}: force {found['force']!r}, whole run {whole:.1f} s, check with pairs by hand {least(by_hand):.2f} s, automatic "
          f"{least(os.path.join(bench.directory, name + '.xml')):.2f} s")


for cells in BRICKS:
    bricks(cells)
cube()
bench.end()
