"""Fixtures for more than one folder."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from service.storage.database import Database
from service.storage.migration import upgrade
from tests.databases import KINDS, delete_rows, migrated_file, postgresql_address, sqlite_copy
from tests.fakes import FakeClock

# --- databases ---


@pytest.fixture(scope="session")
def migrated_sqlite(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A SQLite file with all tables and no rows, to copy."""
    return migrated_file(tmp_path_factory.mktemp("migrated"))


@pytest.fixture(scope="session")
def migrated_postgresql() -> Iterator[str]:
    """The address of a PostgreSQL database with all tables; skips where no server is reachable."""
    with postgresql_address() as address:
        database = Database.open(address)
        upgrade(database)
        database.close()
        yield address


@pytest.fixture
def sqlite_address(migrated_sqlite: Path, tmp_path: Path) -> str:
    """The address of a SQLite database with all tables and no rows."""
    return sqlite_copy(migrated_sqlite, tmp_path)


@pytest.fixture
def sqlite_database(sqlite_address: str) -> Iterator[Database]:
    """A SQLite database with all tables and no rows."""
    opened = Database.open(sqlite_address)
    yield opened
    opened.close()


@pytest.fixture(params=KINDS)
def database_address(request: pytest.FixtureRequest) -> str:
    """The address of a database with all tables and no rows, on SQLite and then on PostgreSQL."""
    if request.param == "sqlite":
        return str(request.getfixturevalue("sqlite_address"))
    address = str(request.getfixturevalue("migrated_postgresql"))
    opened = Database.open(address)
    delete_rows(opened)
    opened.close()
    return address


@pytest.fixture
def database(database_address: str) -> Iterator[Database]:
    """A database with all tables and no rows, on SQLite and then on PostgreSQL."""
    opened = Database.open(database_address)
    yield opened
    opened.close()


@pytest.fixture
def clock() -> FakeClock:
    """A clock that stands still until it is moved."""
    return FakeClock()
