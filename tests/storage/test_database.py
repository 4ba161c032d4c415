"""Sessions: writers take turns, readers cannot write, refusals are errors of the domain."""

import threading
from concurrent.futures import ThreadPoolExecutor
from contextlib import closing
from pathlib import Path

import pytest
from sqlalchemy import func, select, text
from sqlalchemy.exc import DBAPIError, IntegrityError

from service.core.errors import DatabaseBusy, DatabaseUnreachable, DiskFull
from service.storage.database import Database
from service.storage.models import SkuRevisionRow, SkuRow
from tests.fakes import START


def sku(code: str = "lens1") -> SkuRow:
    return SkuRow(code=code, name="Lens", created_at=START)


def count(database: Database, row: type[SkuRow]) -> int:
    with database.read() as session:
        return session.scalar(select(func.count()).select_from(row)) or 0


def test_a_write_is_seen_by_the_next_reader(database: Database) -> None:
    with database.write() as session:
        session.add(sku())

    assert count(database, SkuRow) == 1


def test_an_error_undoes_the_whole_transaction(database: Database) -> None:
    with pytest.raises(ZeroDivisionError):
        add_sku_and_fail(database)

    assert count(database, SkuRow) == 0


def add_sku_and_fail(database: Database) -> None:
    with database.write() as session:
        session.add(sku())
        session.flush()
        raise ZeroDivisionError


def test_readers_cannot_write(database: Database) -> None:
    with pytest.raises(DBAPIError), database.read() as session:
        session.add(sku())

    assert count(database, SkuRow) == 0


def test_a_reader_sees_one_state_while_others_write(database: Database) -> None:
    with database.read() as reader:
        before = reader.scalar(select(func.count()).select_from(SkuRow))
        with database.write() as session:
            session.add(sku())
        after = reader.scalar(select(func.count()).select_from(SkuRow))

    assert (before, after) == (0, 0)


def test_a_hundred_writers_at_once_all_succeed_and_lose_nothing(database: Database) -> None:
    with database.write() as session:
        session.add(SkuRow(code="counter", name="0", created_at=START))

    def add_one(_: int) -> None:
        with database.write() as session:
            row = session.scalars(select(SkuRow).with_for_update()).one()
            row.name = str(int(row.name) + 1)

    with ThreadPoolExecutor(16) as threads:
        list(threads.map(add_one, range(100)))

    with database.read() as session:
        assert session.scalars(select(SkuRow.name)).one() == "100"


def test_two_sqlite_databases_on_one_file_take_turns_in_writing(sqlite_address: str) -> None:
    most, inside, guard = 0, 0, threading.Lock()

    def write(database: Database, number: int) -> None:
        nonlocal most, inside
        with database.write() as session:
            session.add(sku(f"lens{number}"))
            session.flush()
            with guard:
                inside += 1
                most = max(most, inside)
            session.execute(select(SkuRow))
            with guard:
                inside -= 1

    with closing(Database.open(sqlite_address)) as one, closing(Database.open(sqlite_address)) as other:
        with ThreadPoolExecutor(8) as threads:
            list(threads.map(write, [one, other] * 20, range(40)))
        assert (most, count(one, SkuRow)) == (1, 40)


@pytest.mark.parametrize(
    ("pragma", "value"), [("journal_mode", "wal"), ("synchronous", 2), ("foreign_keys", 1), ("query_only", 0)]
)
def test_the_sqlite_writer_is_durable(sqlite_database: Database, pragma: str, value: object) -> None:
    with sqlite_database.write() as session:
        assert session.scalar(text(f"PRAGMA {pragma}")) == value


@pytest.mark.parametrize(
    ("pragma", "value"), [("journal_mode", "wal"), ("query_only", 1), ("wal_autocheckpoint", 0)]
)
def test_sqlite_readers_neither_write_nor_checkpoint(
    sqlite_database: Database, pragma: str, value: object
) -> None:
    with sqlite_database.read() as session:
        assert session.scalar(text(f"PRAGMA {pragma}")) == value


def test_rows_may_be_added_in_any_order(database: Database) -> None:
    parent = sku()
    with database.write() as session:
        session.add(SkuRevisionRow(sku_id=parent.id, number=1, document={}, created_at=START))
        session.flush()
        session.add(parent)

    assert count(database, SkuRow) == 1


def test_a_row_that_refers_to_nothing_is_refused(database: Database) -> None:
    with pytest.raises(IntegrityError), database.write() as session:
        session.add(SkuRevisionRow(sku_id=sku().id, number=1, document={}, created_at=START))


def test_a_sqlite_file_in_a_directory_that_cannot_be_made_is_unreachable(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("in the way")

    with pytest.raises(DatabaseUnreachable):
        Database.open(f"sqlite:///{tmp_path / 'file' / 'dmscal.db'}")


def test_a_lock_that_cannot_be_opened_is_unreachable(tmp_path: Path) -> None:
    (tmp_path / "dmscal.db.writer").mkdir()

    with pytest.raises(DatabaseUnreachable):
        Database.open(f"sqlite:///{tmp_path / 'dmscal.db'}")


def test_a_file_that_is_no_database_is_unreachable(tmp_path: Path) -> None:
    (tmp_path / "dmscal.db").write_bytes(b"no database at all" * 100)

    with (
        closing(Database.open(f"sqlite:///{tmp_path / 'dmscal.db'}")) as bad,
        pytest.raises(DatabaseUnreachable),
    ):
        bad.check()


def test_a_postgresql_that_does_not_answer_is_unreachable() -> None:
    address = "postgresql+psycopg://nobody@127.0.0.1:1/none"

    with closing(Database.open(address)) as away, pytest.raises(DatabaseUnreachable):
        away.check()


def test_a_full_disk_is_said_and_nothing_is_lost(sqlite_database: Database) -> None:
    with sqlite_database.write() as session:
        session.add(sku())

    with pytest.raises(DiskFull):
        fill_up(sqlite_database)

    assert count(sqlite_database, SkuRow) == 1


def fill_up(database: Database) -> None:
    with database.write() as session:
        pages = session.scalar(text("PRAGMA page_count"))
        session.execute(text(f"PRAGMA max_page_count = {pages}"))
        session.add_all(sku(f"lens{number}") for number in range(2, 2000))
        session.flush()


@pytest.mark.parametrize("same", [True, False], ids=["in one process", "in two"])
def test_a_writer_that_waits_too_long_is_told_so(sqlite_address: str, same: bool) -> None:
    with (
        closing(Database.open(sqlite_address, 0.05)) as one,
        closing(Database.open(sqlite_address, 0.05)) as other,
    ):
        with one.write() as holder:
            holder.add(sku())
            holder.flush()
            with pytest.raises(DatabaseBusy):
                add_sku(one if same else other, "lens2")
        add_sku(other, "lens3")
        assert count(one, SkuRow) == 2


def add_sku(database: Database, code: str) -> None:
    with database.write() as session:
        session.add(sku(code))
