"""Events: part of the transaction that wrote them, claimed once, in order."""

import pytest

from service.storage import outbox
from service.storage.database import Database
from tests.fakes import START, FakeClock


def append(database: Database, *subjects: str) -> None:
    with database.write() as session:
        for subject in subjects:
            outbox.append(session, "run.finished", subject, {"subject": subject}, START)


def claim(database: Database, most: int) -> list[str]:
    with database.write() as session:
        return [row.subject for row in outbox.claim(session, most, START)]


def test_events_are_claimed_once_and_in_order(database: Database) -> None:
    append(database, "a", "b", "c")

    assert claim(database, 2) == ["a", "b"]
    assert claim(database, 2) == ["c"]
    assert claim(database, 2) == []


def test_an_event_of_a_transaction_that_was_undone_never_was(database: Database, clock: FakeClock) -> None:
    with pytest.raises(ZeroDivisionError):
        append_and_fail(database, clock)

    assert claim(database, 1) == []


def append_and_fail(database: Database, clock: FakeClock) -> None:
    with database.write() as session:
        outbox.append(session, "run.finished", "a", {}, clock.now())
        session.flush()
        raise ZeroDivisionError
