"""Fixtures for more than one folder."""

from collections.abc import Iterator
from contextlib import closing
from pathlib import Path

import pytest
from hypothesis import settings

from service.storage.database import Database
from service.storage.migration import upgrade
from tests.databases import KINDS, delete_rows, empty_postgresql, migrated_file, sqlite_copy
from tests.fakes import FakeClock
from tests.plant import Plant, running_plant

# The same examples in every run: what a change breaks is then not mixed with what chance finds. New ones are
# looked for with `pytest --hypothesis-profile default`.
settings.register_profile("repeatable", derandomize=True)
settings.load_profile("repeatable")

# --- databases ---


@pytest.fixture(scope="session")
def migrated_sqlite(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A SQLite file with all tables and no rows, to copy."""
    return migrated_file(tmp_path_factory.mktemp("migrated"))


@pytest.fixture(scope="session")
def migrated_postgresql() -> Iterator[str]:
    """The address of a PostgreSQL database with all tables; skips where no server is reachable."""
    with empty_postgresql() as address:
        with closing(Database.open(address)) as opened:
            upgrade(opened)
        yield address


@pytest.fixture
def sqlite_address(migrated_sqlite: Path, tmp_path: Path) -> str:
    """The address of a SQLite database with all tables and no rows."""
    return sqlite_copy(migrated_sqlite, tmp_path)


@pytest.fixture
def sqlite_database(sqlite_address: str) -> Iterator[Database]:
    """A SQLite database with all tables and no rows."""
    with closing(Database.open(sqlite_address)) as opened:
        yield opened


@pytest.fixture
def postgresql_address(migrated_postgresql: str) -> str:
    """The address of a PostgreSQL database with all tables and no rows."""
    with closing(Database.open(migrated_postgresql)) as opened:
        delete_rows(opened)
    return migrated_postgresql


@pytest.fixture
def postgresql_database(postgresql_address: str) -> Iterator[Database]:
    """A PostgreSQL database with all tables and no rows."""
    with closing(Database.open(postgresql_address)) as opened:
        yield opened


@pytest.fixture(params=KINDS)
def database_address(request: pytest.FixtureRequest) -> str:
    """The address of a database with all tables and no rows, on SQLite and then on PostgreSQL."""
    return str(request.getfixturevalue(f"{request.param}_address"))


@pytest.fixture
def database(database_address: str) -> Iterator[Database]:
    """A database with all tables and no rows, on SQLite and then on PostgreSQL."""
    with closing(Database.open(database_address)) as opened:
        yield opened


@pytest.fixture
def clock() -> FakeClock:
    """A clock that stands still until it is moved."""
    return FakeClock()


# --- the service ---


@pytest.fixture
def plant(database_address: str, tmp_path: Path) -> Iterator[Plant]:
    """The service with a key of each role, on SQLite and then on PostgreSQL."""
    with running_plant(database_address, tmp_path) as running:
        yield running


@pytest.fixture
def small_plant(sqlite_address: str, tmp_path: Path) -> Iterator[Plant]:
    """The service with a key of each role on SQLite, where the database makes no difference."""
    with running_plant(sqlite_address, tmp_path) as running:
        yield running
