"""Guidance: from what a frame shows to what the operator is told, and to the frame that is captured."""
