"""What a calibration is worth: coverage, gates and verdicts."""
