"""The verbs of the command that `cli` puts together, and what they share: terminal and installation."""
