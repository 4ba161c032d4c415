"""Databases for tests: each is built by the migrations once per session; every test gets it empty."""

import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from uuid import uuid4

import psycopg
import pytest
from sqlalchemy import URL, make_url

from service.storage.database import Database
from service.storage.migration import upgrade
from service.storage.models import Row

SERVER = "postgresql+psycopg://postgres@127.0.0.1:5432/postgres"
KINDS = ("sqlite", pytest.param("postgresql", marks=pytest.mark.postgresql))


def migrated_file(directory: Path) -> Path:
    """Return a SQLite file with all tables and no rows."""
    path = directory / "migrated.db"
    database = Database.open(f"sqlite:///{path}")
    upgrade(database)
    database.close()
    return path


def sqlite_copy(template: Path, directory: Path) -> str:
    """Return the address of a copy of a SQLite file in `directory`."""
    return f"sqlite:///{shutil.copy(template, directory / 'dmscal.db')}"


@contextmanager
def empty_postgresql() -> Iterator[str]:
    """Yield the address of a new, empty PostgreSQL database; skip the test where no server is reachable."""
    server = make_url(os.environ.get("DMSCAL_TEST_DATABASE_URL", SERVER))
    name = f"dmscal_test_{uuid4().hex[:12]}"
    _execute(server, f"CREATE DATABASE {name}")
    try:
        yield server.set(database=name).render_as_string(hide_password=False)
    finally:
        _execute(server, f"DROP DATABASE {name} WITH (FORCE)")


def delete_rows(database: Database) -> None:
    """Empty all tables."""
    with database.write() as session:
        for table in reversed(Row.metadata.sorted_tables):
            session.execute(table.delete())


def _execute(server: URL, command: str) -> None:
    address = server.set(drivername="postgresql").render_as_string(hide_password=False)
    try:
        with psycopg.connect(address, autocommit=True, connect_timeout=3) as connection:
            connection.execute(command.encode())
    except psycopg.OperationalError as error:
        pytest.skip(f"NO POSTGRESQL REACHABLE, ITS TESTS DID NOT RUN (set DMSCAL_TEST_DATABASE_URL): {error}")
