"""The guidance socket: its messages, and the endpoint that carries them. Not here: what guidance decides."""
