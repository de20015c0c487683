#!/usr/bin/env python3
"""Runs hosts without Trilinos, and the same model with it. Their d and z have to agree to 1e-12 of the largest.

usage: check_hosts.py MPIEXEC TPETRA_HOST C_HOST FORTRAN_HOST PYTHON NUMPY_HOST LIBRARY
"" for the Fortran host: there is no compiler; "" for Python: there is no numpy."""

import os
import pathlib
import subprocess
import sys
import tempfile

mpiexec, tpetra_host, c_host, fortran_host, python, numpy_host, library = sys.argv[1:]


def printed(command):
    run = subprocess.run([part for part in command if part], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if run.returncode != 0:
        sys.exit(f"{' '.join(command)} ends with {run.returncode}:\n{run.stdout}")
    return run.stdout


def values_in(text):
    """Values by kind and place, from lines "d ROW VALUE" and "z COMPONENT VALUE"."""
    lines = [line.split() for line in text.splitlines()]
    return {(kind, int(place)): float(value) for kind, place, value in lines}


def output(*command):
    return values_in(printed(command))


def on_ranks(ranks, *command):
    """Each rank prints to a file of its own: mpirun joins what they print anywhere within lines."""
    if ranks == 1:
        return output(*command)
    with tempfile.TemporaryDirectory() as directory:
        to_file = 'exec "$@" > "$0.${OMPI_COMM_WORLD_RANK:-$PMI_RANK}"'
        printed([mpiexec, "-n", str(ranks), "sh", "-c", to_file, os.path.join(directory, "rank"), *command])
        return values_in("".join(path.read_text() for path in sorted(pathlib.Path(directory).iterdir())))


def off_by(values, reference):
    if values.keys() != reference.keys():
        sys.exit("there are other rows, or other multipliers")
    off = {}
    for kind in "dz":
        largest = max(abs(value) for (its, _), value in reference.items() if its == kind)
        off[kind] = max(abs(values[key] - value) for key, value in reference.items() if key[0] == kind) / largest
    return off


failed = False
for dimension in (2, 3):
    reference = on_ranks(1, tpetra_host, str(dimension))
    hosts = {"Tpetra, 2 ranks": on_ranks(2, tpetra_host, str(dimension))}
    for ranks in (1, 2):
        hosts[f"C, {ranks} ranks"] = on_ranks(ranks, c_host, str(dimension))
    if dimension == 2 and fortran_host:
        hosts["Fortran"] = output(fortran_host)
    if dimension == 2 and python:
        hosts["numpy"] = output(python, numpy_host, library)
    for name, values in hosts.items():
        off = off_by(values, reference)
        print(f"{dimension}D, {name}: d differs by {off['d']:.1e} of the largest, z by {off['z']:.1e}")
        failed |= not max(off.values()) <= 1e-12
sys.exit(failed)
