#!/usr/bin/python3
"""Draws the pictures of docs/tutorial.md from the runs that the page describes.

usage: plot_tutorial.py RESULTS IMAGES      needs python3-h5py and python3-matplotlib

RESULTS holds press_2_contact, press_3_friction and press_4_plasticity, as `mortise run` leaves them; IMAGES is docs/images.
"""
import csv
import glob
import os
import sys

import h5py
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import PolyCollection

QUADRILATERAL = 5  # XDMF's number
plt.rcParams.update({"font.size": 13})


def last_step(directory):
    last = max(glob.glob(os.path.join(glob.escape(directory), "fields", "step-*.h5")))
    with h5py.File(os.path.join(directory, "fields", "mesh.h5")) as mesh, h5py.File(last) as step:
        topology = mesh["topology"][:].reshape(-1, 5)
        assert (topology[:, 0] == QUADRILATERAL).all()
        position = mesh["coordinates"][:, :2] + step["displacement"][:, :2]
        return position, topology[:, 1:], {name: step[name][:] for name in ("von_mises", "contact_pressure")}


def deformed_mesh(directory, image):
    position, cells, field = last_step(directory)
    figure, axes = plt.subplots(figsize=(8.0, 5.0))
    drawn = PolyCollection(position[cells], array=np.ravel(field["von_mises"]), cmap="cividis", edgecolors="black", linewidths=0.3)
    axes.add_collection(drawn)
    axes.set_aspect("equal")
    axes.autoscale()
    axes.set_xlabel("x / mm")
    axes.set_ylabel("y / mm")
    figure.colorbar(drawn, label="von Mises stress / MPa", orientation="horizontal", pad=0.17, aspect=35)
    figure.tight_layout()
    figure.savefig(image, dpi=150)


def pressures(directories, image):
    figure, axes = plt.subplots(figsize=(8.0, 4.6))
    for (label, directory), marker in zip(directories, "os^"):
        position, _, field = last_step(directory)
        pressure = np.ravel(field["contact_pressure"])
        closed = np.flatnonzero(pressure > 0)
        closed = closed[np.argsort(position[closed, 0])]
        axes.plot(position[closed, 0], pressure[closed], marker=marker, label=label)
    axes.set_xlabel("x / mm")
    axes.set_ylabel("contact pressure / MPa")
    axes.set_ylim(0, 1.45 * axes.get_ylim()[1])
    axes.grid(alpha=0.3)
    axes.legend(loc="upper right")
    figure.tight_layout()
    figure.savefig(image, dpi=150)


def forces(directory, image):
    with open(os.path.join(directory, "history.csv"), encoding="utf-8") as table:
        rows = list(csv.DictReader(table))
    time = [float(row["time"]) for row in rows]
    figure, axes = plt.subplots(figsize=(8.0, 4.6))
    axes.plot(time, [-float(row["normal_force"]) for row in rows], marker="o", label="normal force")
    axes.plot(time, [float(row["friction_force"]) for row in rows], marker="s", label="friction force")
    axes.axvline(0.4, color="grey", linestyle="--")
    axes.text(0.42, 500, "drawn aside from here", color="grey")
    axes.set_xlabel("pseudo-time t")
    axes.set_ylabel("force per thickness / (N/mm)")
    axes.grid(alpha=0.3)
    axes.legend(loc="upper right")
    figure.tight_layout()
    figure.savefig(image, dpi=150)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    runs = {name: os.path.join(sys.argv[1], f"press_{name}") for name in ("2_contact", "3_friction", "4_plasticity")}
    target = lambda name: os.path.join(sys.argv[2], f"tutorial_{name}.png")
    deformed_mesh(runs["2_contact"], target("contact"))
    deformed_mesh(runs["4_plasticity"], target("plasticity"))
    pressures([("elastic, no friction", runs["2_contact"]), ("elastic, drawn aside", runs["3_friction"]),
               ("plastic, drawn aside", runs["4_plasticity"])], target("pressure"))
    forces(runs["4_plasticity"], target("forces"))
