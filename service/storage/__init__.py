"""What the service remembers: tables, sessions, named reads and the queues that are tables."""
