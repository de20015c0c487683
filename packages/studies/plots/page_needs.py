import os

# Debian's h5py would start MPI in a process that looks like a rank.
os.environ.pop("OMPI_COMM_WORLD_SIZE", None)
try:
    import h5py
except ImportError:
    sys.exit(MISSING)
