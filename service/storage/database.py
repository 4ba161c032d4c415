"""One database with its writing and reading sessions, on SQLite or PostgreSQL by the scheme of its address.

Whoever writes takes `write()`: one transaction, committed at the end of the block and before anything is
answered. Whoever only reads takes `read()`, which sees one state of the database and cannot write.
"""

import logging
import sqlite3
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Self

from sqlalchemy import URL, Engine, create_engine, make_url, text
from sqlalchemy.exc import TimeoutError as PoolExhausted
from sqlalchemy.orm import Session

from service.core.errors import DatabaseBusy
from service.storage.columns import to_json
from service.storage.failures import raise_domain_errors
from service.storage.sqlite import WriterLock, check_path, create_reader, create_writer

log = logging.getLogger(__name__)

# A lock that is not had in time is a busy database and not a request that hangs.
POSTGRESQL_OPTIONS = "-c timezone=utc -c idle_in_transaction_session_timeout=120s -c lock_timeout={lock_ms}"


class Database:
    """The engines of one database. On SQLite one transaction writes at a time, others wait."""

    def __init__(self, writer: Engine, reader: Engine, lock: WriterLock | None = None) -> None:
        self.writer = writer
        self.reader = reader
        self._lock = lock

    @classmethod
    def open(cls, address: str, busy_s: float = 30.0) -> Self:
        """Return the database at `address`; connects at first use. Raises DatabaseUnreachable.

        busy_s: how long to wait for other writers before DatabaseBusy.
        """
        url = make_url(address)
        is_sqlite = url.get_backend_name() == "sqlite"
        database = cls._open_sqlite(url, busy_s) if is_sqlite else cls._open_postgresql(url, busy_s)
        raise_domain_errors(database.writer)
        if database.reader is not database.writer:
            raise_domain_errors(database.reader)
        return database

    @classmethod
    def _open_sqlite(cls, url: URL, busy_s: float) -> Self:
        path = check_path(url)
        log.info("SQLite %s at %s", sqlite3.sqlite_version, path)
        lock = WriterLock(path.with_name(f"{path.name}.writer"))
        return cls(create_writer(url, lock, busy_s), create_reader(url, busy_s), lock)

    @classmethod
    def _open_postgresql(cls, url: URL, busy_s: float) -> Self:
        options = POSTGRESQL_OPTIONS.format(lock_ms=round(busy_s * 1000))
        writer = create_engine(
            url,
            json_serializer=to_json,
            hide_parameters=True,
            pool_pre_ping=True,
            pool_size=10,
            max_overflow=30,
            pool_timeout=busy_s,
            connect_args={"connect_timeout": 5, "application_name": "dmscal", "options": options},
        )
        reader = writer.execution_options(isolation_level="REPEATABLE READ", postgresql_readonly=True)
        return cls(writer, reader)

    @property
    def is_sqlite(self) -> bool:
        """Whether this is the embedded database, which only one process serves."""
        return self._lock is not None

    @contextmanager
    def write(self) -> Iterator[Session]:
        """Yield the session of one transaction, committed when the block ends and undone when it raises.

        On SQLite the first statement waits for the one writing connection: keep slow work out of the block.
        """
        with _one_transaction(self.writer) as session:
            yield session

    @contextmanager
    def read(self) -> Iterator[Session]:
        """Yield a session that sees one state of the database and cannot write."""
        with _one_transaction(self.reader) as session:
            yield session

    def check(self) -> None:
        """Raise Unavailable unless the database answers."""
        with self.read() as session:
            # SQLite answers SELECT 1 without looking at its file.
            session.execute(text("PRAGMA schema_version" if self.is_sqlite else "SELECT 1"))

    def close(self) -> None:
        """Close all connections, the writing one last: it merges the write-ahead log."""
        self.reader.dispose()
        self.writer.dispose()
        if self._lock is not None:
            self._lock.close()


@contextmanager
def _one_transaction(engine: Engine) -> Iterator[Session]:
    try:
        with Session(engine, expire_on_commit=False) as session, session.begin():
            yield session
    except PoolExhausted as error:
        raise DatabaseBusy(
            "All connections to the database are busy. Nothing was stored; try again."
        ) from error
