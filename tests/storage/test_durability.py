"""What was acknowledged is there after the process was killed, and the file is whole."""

import multiprocessing
import sqlite3
import time
from contextlib import closing
from multiprocessing.connection import Connection

import pytest
from sqlalchemy import make_url

from service.storage.database import Database
from service.storage.models import SkuRow
from tests.fakes import START


def write_for_ever(address: str, answer: Connection) -> None:
    database = Database.open(address)
    for number in range(100_000):
        with database.write() as session:
            session.add(SkuRow(code=f"lens{number}", name="x" * 2000, created_at=START))
        answer.send(f"lens{number}")


@pytest.mark.parametrize("delay_s", [0.1, 0.2, 0.35])
def test_a_kill_loses_no_acknowledged_row_and_damages_nothing(sqlite_address: str, delay_s: float) -> None:
    context = multiprocessing.get_context("fork")
    receiver, sender = context.Pipe(duplex=False)
    process = context.Process(target=write_for_ever, args=(sqlite_address, sender))
    process.start()
    acknowledged = {receiver.recv()}
    time.sleep(delay_s)
    process.kill()
    process.join()
    while receiver.poll():
        acknowledged.add(receiver.recv())

    with closing(sqlite3.connect(make_url(sqlite_address).database or "")) as connection:
        stored = {code for (code,) in connection.execute("SELECT code FROM sku")}
        assert connection.execute("PRAGMA integrity_check").fetchall() == [("ok",)]
    assert acknowledged <= stored
    assert len(stored - acknowledged) <= 1
