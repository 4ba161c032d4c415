from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import astuple, replace
from datetime import UTC, date, datetime, timedelta

from sqlalchemy.orm import Session

from service.core.run import Purpose, RunState
from service.storage.database import Database
from service.usecases.paging import PageRequest
from service.usecases.run_filter import RunFilter
from service.usecases.runs import list_runs
from service.usecases.statistics import YieldView, list_station_standings, read_yield
from tests.fakes import START
from tests.line import FAIL, MARGINAL, PASS, Line

DAY = timedelta(days=1)
TODAY = START.date()


@contextmanager
def line_of(database: Database) -> Iterator[Line]:
    """A line whose rows are written when the block ends."""
    with database.write() as session:
        yield Line(session)


def yield_of(database: Database, days: int = 30, **only: str) -> YieldView:
    """The figures as of the day the tests play on."""
    with database.read() as session:
        return read_yield(session, START, days, **only)


def listed(session: Session, wanted: RunFilter) -> list[str]:
    """The serials of the runs that a list shows."""
    return [run.serial for run in list_runs(session, PageRequest(), wanted).items]


def test_verdicts_are_counted_by_sku_station_and_day(database: Database) -> None:
    with line_of(database) as line:
        line.run("V1")
        line.run("V2", MARGINAL)
        line.run("V3", FAIL)
        line.run("V4", sku="lens2", station=None)
        line.run("V5", at=START - DAY)

    rows = [astuple(count) for count in yield_of(database).counts]

    assert rows == [
        ("lens1", "cal1", TODAY - DAY, 1, 0, 0, 1, 1),
        ("lens1", "cal1", TODAY, 1, 1, 1, 3, 2),
        ("lens2", None, TODAY, 1, 0, 0, 1, 1),
    ]


def test_only_the_first_run_of_a_serial_makes_first_pass_yield(database: Database) -> None:
    with line_of(database) as line:
        line.run("V1", FAIL)
        line.run("V1", PASS, purpose=Purpose.RETEST, at=START + timedelta(minutes=5))
        line.run("V2", PASS)

    (count,) = yield_of(database).counts

    assert (count.passed, count.failed) == (2, 1)
    assert (count.first_runs, count.first_passed) == (2, 1)


def test_a_first_run_before_the_days_on_show_stays_the_first(database: Database) -> None:
    with line_of(database) as line:
        line.run("V1", FAIL, at=START - 60 * DAY)
        line.run("V1", PASS, purpose=Purpose.RETEST)

    (count,) = yield_of(database).counts

    assert (count.passed, count.first_runs) == (1, 0)


def test_of_two_runs_of_the_same_moment_one_is_the_first(database: Database) -> None:
    with line_of(database) as line:
        line.run("V1", FAIL)
        line.run("V1", PASS)

    assert yield_of(database).counts[0].first_runs == 1


def test_one_serial_with_cameras_of_two_skus_has_a_first_run_of_each(database: Database) -> None:
    with line_of(database) as line:
        line.run("V1")
        line.run("V1", sku="lens2", at=START + timedelta(minutes=5))

    assert [count.first_runs for count in yield_of(database).counts] == [1, 1]


def test_trials_open_and_aborted_runs_do_not_count_and_are_no_first_runs(database: Database) -> None:
    with line_of(database) as line:
        line.run("V1", FAIL, purpose=Purpose.TRIAL, at=START - timedelta(hours=3))
        line.run("V1", None, state=RunState.ABORTED, at=START - timedelta(hours=2))
        line.run("V1", None, at=START - timedelta(hours=1))
        line.run("V2", FAIL, purpose=Purpose.SIMULATED)
        line.run("V1")

    (count,) = yield_of(database).counts

    assert (count.passed, count.marginal, count.failed) == (1, 0, 0)
    assert (count.first_runs, count.first_passed) == (1, 1)


def test_days_begin_and_end_at_midnight_utc(database: Database) -> None:
    midnight = datetime(2026, 3, 1, tzinfo=UTC)
    with line_of(database) as line:
        line.run("V1", at=midnight - timedelta(microseconds=1))
        line.run("V2", at=midnight)
        line.run("V3", at=midnight - DAY - timedelta(microseconds=1))

    view = yield_of(database, days=2)

    assert (view.since, view.until) == (date(2026, 2, 28), date(2026, 3, 1))
    assert [(count.day, count.passed) for count in view.counts] == [(view.since, 1), (view.until, 1)]


def test_gates_stand_by_how_many_runs_they_failed(database: Database) -> None:
    with line_of(database) as line:
        line.run("V1", FAIL, failed=("coverage",))
        line.run("V2", FAIL, failed=("coverage", "edge_width_px"))
        line.run("V3", FAIL, failed=("edge_width_px", "coverage"), sku="lens2")
        line.run("V4", FAIL, failed=("rms_px",), purpose=Purpose.STUDY)
        line.run("V5", FAIL, failed=("rms_px",), at=START - 40 * DAY)

    assert [astuple(gate) for gate in yield_of(database).gates] == [
        ("fit", "coverage", 3),
        ("fit", "edge_width_px", 2),
    ]
    assert [gate.runs for gate in yield_of(database, sku="lens2").gates] == [1, 1]


def test_one_sku_or_station_can_be_asked_for(database: Database) -> None:
    with line_of(database) as line:
        line.run("V1")
        line.run("V2", FAIL, station="cal2")
        line.run("V3", sku="lens2")

    assert [count.failed for count in yield_of(database, station="cal2").counts] == [1]
    assert [count.sku for count in yield_of(database, sku="lens2").counts] == ["lens2"]
    assert yield_of(database, sku="nothing").counts == []


def test_every_number_leads_to_a_list_of_as_many_runs(database: Database) -> None:
    with line_of(database) as line:
        for i in range(24):
            verdict = (PASS, FAIL, MARGINAL, PASS)[i % 4]
            line.run(
                f"V{i % 9}",
                verdict,
                sku=f"lens{i % 2}",
                station=f"cal{i % 3}" if i % 3 else None,
                at=START - (i % 5) * DAY + timedelta(minutes=i),
                purpose=(Purpose.PRODUCTION, Purpose.RETEST, Purpose.TRIAL)[i % 7 % 3],
                failed=("coverage",) if verdict is FAIL and i % 3 else (),
            )
    view = yield_of(database)

    with database.read() as session:
        for count in view.counts:
            cell = RunFilter(
                sku=count.sku,
                station=count.station,
                without_station=count.station is None,
                since=count.day,
                until=count.day,
            )
            for verdict, number in ((PASS, count.passed), (MARGINAL, count.marginal), (FAIL, count.failed)):
                wanted = replace(cell, verdict=verdict, counted=True)
                assert len(listed(session, wanted)) == number
            assert len(listed(session, replace(cell, first=True))) == count.first_runs
        for gate in view.gates:
            wanted = RunFilter(since=view.since, until=view.until, failed=gate.name, counted=True)
            assert len(listed(session, wanted)) == gate.runs
    assert len(view.counts) > 5
    assert len(view.gates) == 1


def test_a_station_shows_its_newest_open_run_and_its_newest_verdict(database: Database) -> None:
    with line_of(database) as line:
        line.run("V1", PASS, at=START - timedelta(hours=3))
        line.run("V2", FAIL, at=START - timedelta(hours=2))
        line.run("V3", None, at=START - timedelta(hours=1))
        line.run("V4", None)
        line.run("V5", None, station="cal2", at=START - 400 * DAY)
        line.run("V6", None, station=None)
        line.station("cal3")

    with database.read() as session:
        part = list_station_standings(session, PageRequest())

    shown = {
        one.code: (one.open_run and one.open_run.serial, one.last_run and one.last_run.serial)
        for one in part.items
    }
    assert shown == {"cal1": ("V4", "V2"), "cal2": ("V5", None), "cal3": (None, None)}
