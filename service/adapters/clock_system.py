"""The computer's clock."""

from datetime import UTC, datetime


class SystemClock:
    """Tells the time of the computer, which a plant keeps right by NTP."""

    def now(self) -> datetime:
        """Return the time now, aware and in UTC."""
        return datetime.now(UTC)  # noqa: TID251 - the one place that asks the computer
