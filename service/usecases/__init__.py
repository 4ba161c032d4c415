"""What people want from the service, one module per goal: functions of a session, ports and plain values."""
