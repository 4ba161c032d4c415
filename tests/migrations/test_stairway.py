"""The history: each revision goes up, down and up again, and its end is what the models say."""

import sqlite3
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path

import pytest
from alembic import command
from alembic.autogenerate import compare_metadata
from alembic.config import Config
from alembic.runtime.migration import MigrationContext
from alembic.script import ScriptDirectory
from sqlalchemy import CheckConstraint, inspect, text

from service.core.errors import DatabaseOutdated
from service.storage.database import Database
from service.storage.migration import alembic_config, check_at_head, revision_of, scripts_directory, upgrade
from service.storage.models import Row
from tests.databases import KINDS, empty_postgresql

SCRIPTS = ScriptDirectory.from_config(alembic_config())
REVISIONS = [script.revision for script in SCRIPTS.walk_revisions()][::-1]


@pytest.fixture(params=KINDS)
def empty_database(request: pytest.FixtureRequest, tmp_path: Path) -> Iterator[Database]:
    if request.param == "sqlite":
        with closing(Database.open(f"sqlite:///{tmp_path / 'new' / 'dmscal.db'}")) as opened:
            yield opened
        return
    with empty_postgresql() as address, closing(Database.open(address)) as opened:
        yield opened


def move(database: Database, direction: str, revision: str) -> None:
    with database.writer.connect() as connection:
        config: Config = alembic_config(connection)
        (command.upgrade if direction == "up" else command.downgrade)(config, revision)


def test_the_history_is_one_line() -> None:
    assert len(SCRIPTS.get_heads()) == 1
    assert len(SCRIPTS.get_bases()) == 1


def test_each_revision_goes_up_down_and_up_again(empty_database: Database) -> None:
    for revision in REVISIONS:
        move(empty_database, "up", revision)
        move(empty_database, "down", "-1")
        move(empty_database, "up", revision)
        assert revision_of(empty_database) == revision


def test_all_the_way_down_leaves_no_table(empty_database: Database) -> None:
    upgrade(empty_database)
    move(empty_database, "down", "base")

    assert set(inspect(empty_database.writer).get_table_names()) <= {"alembic_version"}


def test_the_newest_revision_is_what_the_models_say(empty_database: Database) -> None:
    upgrade(empty_database)

    with empty_database.writer.connect() as connection:
        context = MigrationContext.configure(connection, opts={"compare_type": True})
        assert compare_metadata(context, Row.metadata) == []


def test_the_newest_revision_has_every_check_of_the_models(empty_database: Database) -> None:
    upgrade(empty_database)

    inspector = inspect(empty_database.writer)
    for table in Row.metadata.sorted_tables:
        wanted = {str(check.name) for check in table.constraints if isinstance(check, CheckConstraint)}
        assert {check["name"] for check in inspector.get_check_constraints(table.name)} == wanted


def test_every_constraint_has_a_name() -> None:
    nameless = [
        f"{table}: {key}"
        for table in Row.metadata.tables.values()
        for key in table.constraints
        if not key.name
    ]

    assert nameless == []


def test_upgrading_twice_changes_nothing(empty_database: Database) -> None:
    upgrade(empty_database)
    upgrade(empty_database)

    check_at_head(empty_database)


def test_an_empty_database_is_outdated(empty_database: Database) -> None:
    with pytest.raises(DatabaseOutdated, match="dmscal migrate"):
        check_at_head(empty_database)


def test_a_database_from_the_future_is_outdated(empty_database: Database) -> None:
    upgrade(empty_database)
    with empty_database.write() as session:
        session.execute(text("UPDATE alembic_version SET version_num = 'ffffffffffff'"))

    with pytest.raises(DatabaseOutdated):
        check_at_head(empty_database)
    with pytest.raises(DatabaseOutdated):
        upgrade(empty_database)


def test_keys_are_enforced_again_after_a_migration_on_sqlite(tmp_path: Path) -> None:
    with closing(Database.open(f"sqlite:///{tmp_path / 'dmscal.db'}")) as database:
        upgrade(database)
        with database.write() as session:
            assert session.scalar(text("PRAGMA foreign_keys")) == 1


def test_a_migration_that_fails_changes_nothing(tmp_path: Path) -> None:
    path = tmp_path / "dmscal.db"
    with closing(sqlite3.connect(path)) as connection:
        connection.execute("CREATE TABLE run (in_the_way TEXT)")

    with (
        closing(Database.open(f"sqlite:///{path}")) as database,
        pytest.raises(Exception, match="already exists"),
    ):
        upgrade(database)

    with closing(sqlite3.connect(path)) as connection:
        assert connection.execute("SELECT name FROM sqlite_master").fetchall() == [("run",)]


def test_the_history_is_found_beside_the_package() -> None:
    assert (scripts_directory() / "env.py").is_file()
