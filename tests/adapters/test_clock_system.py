"""The computer's clock."""

from datetime import UTC

from service.adapters.clock_system import SystemClock


def test_time_is_in_utc_and_does_not_go_back() -> None:
    clock = SystemClock()

    first, second = clock.now(), clock.now()

    assert first.tzinfo is UTC
    assert first <= second
