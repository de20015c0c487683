try:
    import h5py
except ImportError:
    sys.exit(MISSING)
