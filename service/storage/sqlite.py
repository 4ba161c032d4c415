"""SQLite as a durable store: write-ahead log, one writer at a time, readers that can only read.

SQLite before 3.51.3 may corrupt a write-ahead log when one connection writes while another checkpoints. So
one connection writes and checkpoints; where a second process writes too (`dmscal keys` beside a running
service), a lock on a file beside the database lets only one of them use its writing connection at a time.
"""

import fcntl
import logging
import os
import sqlite3
import time
from pathlib import Path

from sqlalchemy import URL, Connection, Engine, create_engine, event
from sqlalchemy.pool import ConnectionPoolEntry, PoolProxiedConnection

from service.core.errors import DatabaseBusy, DatabaseUnreachable
from service.storage.columns import to_json

READERS = 8
READER_QUEUE = 64
LARGEST_IDLE_LOG = 64 << 20

log = logging.getLogger(__name__)


class WriterLock:
    """A lock between processes, on a file that is never removed."""

    def __init__(self, path: Path) -> None:
        try:
            self._file: int | None = os.open(path, os.O_RDWR | os.O_CREAT | os.O_CLOEXEC, 0o600)
        except OSError as error:
            raise DatabaseUnreachable(f"The lock {path} cannot be opened: {error.strerror}.") from error

    def acquire(self, timeout_s: float) -> None:
        """Wait until no other process writes; raises DatabaseBusy."""
        end = time.monotonic() + timeout_s
        while not self._try():
            if time.monotonic() > end:
                raise DatabaseBusy("Another process keeps writing to the database. Try again.")
            time.sleep(0.002)

    def _try(self) -> bool:
        if self._file is None:
            raise DatabaseUnreachable("The database was closed: the service is stopping.")
        try:
            fcntl.flock(self._file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            return False
        return True

    def release(self) -> None:
        """Let the next process write."""
        if self._file is not None:
            fcntl.flock(self._file, fcntl.LOCK_UN)

    def close(self) -> None:
        """Forget the lock; it is released with its file."""
        if self._file is not None:
            os.close(self._file)
            self._file = None


def check_path(url: URL) -> Path:
    """Return the path of the database file, its directory made; raises DatabaseUnreachable."""
    path = Path(url.database or "").absolute()
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise DatabaseUnreachable(f"The directory {path.parent} cannot be made: {error.strerror}.") from error
    return path


def create_writer(url: URL, lock: WriterLock, busy_s: float) -> Engine:
    """Return the engine of the one writing connection; whoever wants it next waits for it."""
    engine = create_engine(
        url,
        json_serializer=to_json,
        hide_parameters=True,
        pool_size=1,
        max_overflow=0,
        pool_timeout=busy_s,
        connect_args={"check_same_thread": False, "timeout": busy_s},
    )

    @event.listens_for(engine, "connect")
    def configure(connection: sqlite3.Connection, _record: ConnectionPoolEntry) -> None:
        lock.acquire(busy_s)
        try:
            _set(
                connection,
                "journal_mode=WAL",
                "synchronous=FULL",
                "foreign_keys=ON",
                "journal_size_limit=67108864",
            )
        finally:
            lock.release()

    @event.listens_for(engine, "checkout")
    def take(
        _connection: sqlite3.Connection, _record: ConnectionPoolEntry, _proxy: PoolProxiedConnection
    ) -> None:
        lock.acquire(busy_s)

    @event.listens_for(engine, "checkin")
    def give_back(_connection: sqlite3.Connection | None, _record: ConnectionPoolEntry) -> None:
        lock.release()

    @event.listens_for(engine, "begin")
    def begin(connection: Connection) -> None:
        connection.exec_driver_sql("BEGIN IMMEDIATE")

    return engine


def create_reader(url: URL, busy_s: float) -> Engine:
    """Return the engine of the reading connections; each transaction sees one state of the database."""
    engine = create_engine(
        url,
        json_serializer=to_json,
        hide_parameters=True,
        pool_size=READERS,
        max_overflow=READER_QUEUE - READERS,
        pool_timeout=busy_s,
        connect_args={"check_same_thread": False, "timeout": busy_s},
    )

    @event.listens_for(engine, "connect")
    def configure(connection: sqlite3.Connection, _record: ConnectionPoolEntry) -> None:
        _set(connection, "query_only=ON", "wal_autocheckpoint=0")

    @event.listens_for(engine, "begin")
    def begin(connection: Connection) -> None:
        connection.exec_driver_sql("BEGIN")

    return engine


def _set(connection: sqlite3.Connection, *pragmas: str) -> None:
    # Without isolation_level=None the driver would begin transactions of its own, and late.
    connection.isolation_level = None
    for pragma in pragmas:
        connection.execute(f"PRAGMA {pragma}")
