"""Rows that cannot be true are refused by the database itself."""

import pytest
from sqlalchemy import text
from sqlalchemy.exc import IntegrityError

from service.storage.database import Database
from tests.storage.make import make_capture, make_run


@pytest.mark.parametrize(
    "damage",
    [
        "UPDATE run SET state = 'finished', finished_at = created_at",
        "UPDATE run SET state = 'aborted'",
        "UPDATE run SET state = 'lost'",
        "UPDATE run SET purpose = 'fun'",
        "UPDATE run SET verdict = 'PASS'",
        "UPDATE sku_revision SET state = 'published', published_at = NULL",
        "UPDATE sku_revision SET number = 0",
        "UPDATE capture SET sha256 = 'short'",
        "UPDATE capture SET number = 0",
    ],
)
def test_impossible_rows_are_refused(database: Database, damage: str) -> None:
    with database.write() as session:
        session.add(make_capture(make_run(session), number=1, sha256="a" * 64))

    with pytest.raises(IntegrityError), database.write() as session:
        session.execute(text(damage))
