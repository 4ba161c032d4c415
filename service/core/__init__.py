"""The pure heart: numpy, cv2 and scipy on plain values. No I/O, clock, settings, logging or global randomness."""
