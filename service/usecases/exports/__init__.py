"""A finished result as files for others: one file per format, and the list of them in `formats`."""
