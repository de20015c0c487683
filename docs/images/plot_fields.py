#!/usr/bin/python3
"""Draws the von Mises stress of the last step of a run on the deformed mesh.

usage: plot_fields.py RUN_DIRECTORY IMAGE.png [x_min x_max y_min y_max]      needs python3-h5py and python3-matplotlib
"""
import glob
import os
import sys

import h5py
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import PolyCollection

NODES = {4: 3, 5: 4}  # XDMF's numbers of triangle and quadrilateral


def main(directory, image, limits):
    last_step = max(glob.glob(os.path.join(glob.escape(directory), "fields", "step-*.h5")))
    with h5py.File(os.path.join(directory, "fields", "mesh.h5")) as mesh, h5py.File(last_step) as step:
        position = mesh["coordinates"][:, :2] + step["displacement"][:, :2]
        topology = mesh["topology"][:]
        xx, xy, xz, yy, yz, zz = step["cauchy_stress"][:].T
    von_mises = np.sqrt(0.5 * ((xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2) + 3 * (xy**2 + xz**2 + yz**2))
    cells, at = [], 0
    while at < len(topology):
        count = NODES[topology[at]]
        cells.append(position[topology[at + 1 : at + 1 + count]])
        at += 1 + count
    figure, axes = plt.subplots(figsize=(6.4, 4.6))
    drawn = PolyCollection(cells, array=von_mises, cmap="cividis", edgecolors="black", linewidths=0.2)
    axes.add_collection(drawn)
    axes.set_aspect("equal")
    axes.autoscale()
    if limits:
        axes.axis(limits)
    axes.set_xlabel("x / mm")
    axes.set_ylabel("y / mm")
    figure.colorbar(drawn, label="von Mises stress / MPa")
    figure.tight_layout()
    figure.savefig(image, dpi=110)


if __name__ == "__main__":
    if len(sys.argv) not in (3, 7):
        sys.exit(__doc__)
    main(sys.argv[1], sys.argv[2], [float(one) for one in sys.argv[3:]])
