"""Compares results of apps/embed_host with those of `mortise run` on the same mesh: displacements and multipliers at nodes.

    compare_embed_host.py <directory of mortise_results.py> <directory of the run> <file of each rank>...
"""
import sys

import numpy as np

sys.path.insert(0, sys.argv[1])
import mortise_results  # noqa: E402

run = mortise_results.open(sys.argv[2])
host = np.vstack([np.loadtxt(file, ndmin=2) for file in sys.argv[3:]])
mesh = run.mesh.nodes
values = np.hstack([run.field("displacement"), run.field("contact_traction")])
assert len(mesh) == len(host), f"{len(mesh)} nodes, the host has {len(host)}"
worst = np.zeros(2)
largest = np.array([np.abs(values[:, :3]).max(), np.abs(values[:, 3:]).max()])
taken = np.zeros(len(mesh), dtype=bool)
for row in host:
    # Two nodes are in one place where the boxes meet at a corner: the nearer one in displacement is meant.
    there = np.flatnonzero((np.abs(mesh - row[:3]).max(axis=1) < 1e-9) & ~taken)
    apart = np.abs(values[there] - row[3:])
    best = np.argmin(apart[:, :3].max(axis=1))
    taken[there[best]] = True
    worst = np.maximum(worst, [apart[best, :3].max(), apart[best, 3:].max()])
worst /= largest
print(f"d to {worst[0]:.1e}, z to {worst[1]:.1e}, of the largest")
sys.exit(0 if np.all(worst <= 1e-10) and np.all(largest > 0.0) else 1)
