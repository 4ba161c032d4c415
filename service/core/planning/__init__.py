"""Offline design of pose sets: which board poses tell most about a camera."""
