"""dmscal: calibration of driver-monitoring cameras with pose guidance. See ARCHITECTURE.md."""

__version__ = "0.1.0"
