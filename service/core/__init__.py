"""The pure heart: numpy, cv2 and scipy on values. No I/O, clock, settings, logging, global randomness."""
