# The fields that a run leaves.
import glob
import os
import sys

import numpy as np

POLYLINE, NODES = 2, {4: 3, 5: 4}  # XDMF's numbers: a polyline, whose number of nodes follows; triangle and quadrilateral
TENSOR = ("xx", "xy", "xz", "yy", "yz", "zz")


def last_step_file(path):
    """None if no step has been written."""
    files = glob.glob(os.path.join(glob.escape(path), "fields", "step-*.h5"))
    return max(files, key=lambda file: (len(file), file), default=None)  # numbers beyond six digits are longer


class Fields:
    """The last written step of a run's directory."""

    def __init__(self, path):
        last = last_step_file(path)
        if last is None:
            sys.exit(f"{path} holds no fields of any step; please run its scene again")
        with h5py.File(last) as file:
            self.values = {name: data[:] for name, data in file.items()}
        with h5py.File(os.path.join(path, "fields", "mesh.h5")) as file:
            self.reference = file["coordinates"][:, :2]
            self.body = file["body"][:]
            topology = file["topology"][:]
        self.cells, at = [], 0
        while at < len(topology):
            kind = int(topology[at])
            at += 2 if kind == POLYLINE else 1
            count = int(topology[at - 1]) if kind == POLYLINE else NODES[kind]
            self.cells.append(topology[at : at + count])
            at += count
        # Profiles of rigid bodies are lines; all others have an inside.
        self.inside = np.array([len(cell) > 2 for cell in self.cells])
        self.displacement = self.values["displacement"][:, :2]
        self.position = self.reference + self.displacement

    def von_mises(self):
        s = dict(zip(TENSOR, self.values["cauchy_stress"].T))
        pairs = (s["xx"] - s["yy"]) ** 2 + (s["yy"] - s["zz"]) ** 2 + (s["zz"] - s["xx"]) ** 2
        return np.sqrt(0.5 * pairs + 3 * (s["xy"] ** 2 + s["xz"] ** 2 + s["yz"] ** 2))

    def nodes_of(self, body):
        return np.unique(np.concatenate([self.cells[e] for e in np.flatnonzero(self.body == body)]))

    def contact(self):
        """x, pressure and shear of the slave nodes by their current x: all others have neither a pressure nor a gap."""
        pressure, gap = self.values["contact_pressure"].ravel(), self.values["gap"].ravel()
        slave = np.flatnonzero((pressure != 0) | (gap != 0))
        slave = slave[np.argsort(self.position[slave, 0], kind="stable")]
        return self.position[slave, 0], pressure[slave], self.values["contact_shear"].ravel()[slave]
