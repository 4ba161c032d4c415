"""The experiments of the paper (Ren and Hu, Camera Calibration with Pose Guidance), one module each."""
