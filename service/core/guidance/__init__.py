"""From a frame to a hint: pure parts of the live guidance."""
