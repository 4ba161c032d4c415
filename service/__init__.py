"""dmscal: calibration of driver-monitoring cameras with pose guidance. See ARCHITECTURE.md."""

import os

__version__ = "0.1.0"

# Read by NumPy when it is first imported. Matrices here are small and requests run side by side: where other
# threads are busy, one product on two threads takes 20 ms instead of 0.1 ms, as each waits for the other.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
