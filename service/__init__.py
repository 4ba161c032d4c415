"""dmscal: calibration of driver-monitoring cameras with pose guidance. ARCHITECTURE.md says where new code goes."""

__version__ = "0.1.0"
