"""Columns mean the same on both engines: times, numbers and words come back as they were."""

from datetime import UTC, datetime, timedelta, timezone

import pytest
from sqlalchemy import select
from sqlalchemy.exc import StatementError

from service.storage.columns import new_id
from service.storage.database import Database
from service.storage.models import SkuRevisionRow, SkuRow
from service.storage.words import Publication
from tests.fakes import START


def test_later_ids_sort_after_earlier_ones() -> None:
    ids = [new_id() for _ in range(10_000)]

    assert ids == sorted(ids)
    assert ids[0].version == 7


def test_times_come_back_in_utc_to_the_microsecond(database: Database) -> None:
    moment = datetime(2026, 3, 29, 2, 30, 0, 123456, tzinfo=timezone(timedelta(hours=-7)))
    with database.write() as session:
        session.add(SkuRow(code="lens1", name="Lens", created_at=moment))

    with database.read() as session:
        found = session.scalars(select(SkuRow.created_at)).one()
    assert (found, found.tzinfo) == (moment, UTC)


def test_a_time_without_a_zone_is_refused(database: Database) -> None:
    with pytest.raises(StatementError), database.write() as session:
        session.add(SkuRow(code="lens1", name="Lens", created_at=datetime(2026, 1, 1)))  # noqa: DTZ001


def test_floats_in_json_come_back_to_the_last_digit(database: Database) -> None:
    numbers = [0.1, -0.0, 1e-300, 1.7976931348623157e308, 2 / 3, 5e-324]
    write_document(database, {"numbers": numbers})

    with database.read() as session:
        found = session.scalars(select(SkuRevisionRow.document)).one()["numbers"]
    assert [number.hex() for number in found] == [number.hex() for number in numbers]


@pytest.mark.parametrize("number", [float("nan"), float("inf")])
def test_what_is_no_number_is_refused_in_json(database: Database, number: float) -> None:
    with pytest.raises((StatementError, ValueError), match="JSON"):
        write_document(database, {"number": number})


def write_document(database: Database, document: dict[str, object]) -> None:
    parent = SkuRow(code="lens1", name="Lens", created_at=START)
    revision = SkuRevisionRow(sku_id=parent.id, number=1, document=document, created_at=START)
    with database.write() as session:
        session.add_all([parent, revision])


def test_words_come_back_as_words(database: Database) -> None:
    write_document(database, {})

    with database.read() as session:
        assert session.scalars(select(SkuRevisionRow.state)).one() is Publication.DRAFT
