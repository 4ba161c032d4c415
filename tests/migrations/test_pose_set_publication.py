"""Who published and retired pose sets of before is filled in from what was written down then."""

from collections.abc import Iterator
from contextlib import closing
from datetime import datetime, timedelta
from pathlib import Path
from uuid import UUID

import pytest
from alembic import command
from sqlalchemy import text

from service.storage.columns import new_id
from service.storage.database import Database
from service.storage.migration import alembic_config, upgrade
from service.storage.models import PoseSetRow
from tests.databases import KINDS, empty_postgresql
from tests.fakes import START

BEFORE = "c41e97d2a6b8"
IDS = [new_id() for _ in range(3)]


@pytest.fixture(params=KINDS)
def old_database(request: pytest.FixtureRequest, tmp_path: Path) -> Iterator[Database]:
    """A database of before, with a set that was retired, the one that replaced it, and a draft."""
    if request.param == "sqlite":
        with closing(Database.open(f"sqlite:///{tmp_path / 'old.db'}")) as opened:
            fill(opened)
            yield opened
        return
    with empty_postgresql() as address, closing(Database.open(address)) as opened:
        fill(opened)
        yield opened


def fill(database: Database) -> None:
    with database.writer.connect() as connection:
        command.upgrade(alembic_config(connection), BEFORE)
    sku_id, revision_id = new_id(), new_id()
    with database.write() as session:
        is_sqlite = session.get_bind().dialect.name == "sqlite"

        def put(table: str, **values: object) -> None:
            """Insert a row in the form that the columns of before store it."""
            told = {name: _as_stored(value, is_sqlite) for name, value in values.items()}
            names = ", ".join(f'"{name}"' for name in told)
            marks = ", ".join(f":{name}" for name in told)
            session.execute(text(f"INSERT INTO {table} ({names}) VALUES ({marks})"), told)  # noqa: S608

        put("sku", id=sku_id, code="old", name="Old", created_at=START)
        common = {"document": "{}", "created_at": START}
        put("sku_revision", id=revision_id, sku_id=sku_id, number=1, state="draft", **common)
        sets = zip(IDS, ("retired", "published", "draft"), (1, 2, None), strict=True)
        for pose_set_id, state, day in sets:
            put(
                "pose_set",
                id=pose_set_id,
                sku_revision_id=revision_id,
                state=state,
                poses="[]",
                prediction="{}",
                provenance="{}",
                created_at=START,
                published_at=None if day is None else START + timedelta(days=day),
            )
        for pose_set_id, who in zip(IDS[:2], ("anna", "bert"), strict=True):
            subject = f"pose-set:{pose_set_id}"
            entry = {"id": new_id(), "at": START, "who": who, "action": "pose-set.publish"}
            put("audit_entry", **entry, subject=subject, facts="{}")


def _as_stored(value: object, is_sqlite: bool) -> object:
    if is_sqlite and isinstance(value, UUID):
        return value.hex
    if is_sqlite and isinstance(value, datetime):
        return value.strftime("%Y-%m-%d %H:%M:%S.%f")
    return value


def test_publishers_and_retirements_are_filled_in(old_database: Database) -> None:
    upgrade(old_database)

    with old_database.read() as session:
        first, second, draft = (session.get_one(PoseSetRow, one) for one in IDS)
        assert (first.published_by, first.retired_by) == ("anna", "bert")
        assert first.retired_at == second.published_at == START + timedelta(days=2)
        assert (second.published_by, second.retired_at, second.retired_by) == ("bert", None, None)
        assert (draft.published_by, draft.retired_at) == (None, None)
