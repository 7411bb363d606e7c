"""Design spectra, motions that are compatible with one, and the check of a set against it."""
