import pytest
from hypothesis import given
from hypothesis import strategies as st

from service.core.errors import RunAborted, RunAlreadyFinished, SerialInvalid
from service.core.run import Purpose, RunState, check_open, check_serial


@pytest.mark.parametrize("serial", ["A", "VIN-0001", "W0L 000-051+T2123456", "x" * 64, "Ü1", "a.b/c:d#e"])
def test_a_serial_of_a_label_is_kept_as_it_is(serial: str) -> None:
    assert check_serial(serial) == serial


def test_blanks_around_a_serial_are_the_scanners() -> None:
    assert check_serial("  A 1 ") == "A 1"


@pytest.mark.parametrize(
    ("serial", "named"),
    [("A*", "'*'"), ("100%", "'%'"), ("A?", "'?'"), ("A_1", "'_'"), ("[A]", "'['"), ("A!", "'!'")],
)
def test_a_wildcard_is_refused_by_name(serial: str, named: str) -> None:
    with pytest.raises(SerialInvalid) as refusal:
        check_serial(serial)

    assert named in refusal.value.detail


@pytest.mark.parametrize("serial", ["A\nB", "A\x00", "\x1bA", "A\u200eB", "A\ud800", "A\u2028B", "A\u00a0B"])
def test_a_character_that_no_label_holds_is_refused_by_its_number(serial: str) -> None:
    with pytest.raises(SerialInvalid, match=r"U\+[0-9A-F]{4}"):
        check_serial(serial)


@given(st.text(max_size=80))
def test_any_text_is_a_serial_or_is_refused(text: str) -> None:
    try:
        serial = check_serial(text)
    except SerialInvalid:
        return
    assert 1 <= len(serial) <= 64
    assert serial.isprintable()
    assert check_serial(serial) == serial


def test_only_an_open_run_goes_on() -> None:
    check_open(RunState.OPEN, "id")
    with pytest.raises(RunAlreadyFinished) as refusal:
        check_open(RunState.FINISHED, "id")
    with pytest.raises(RunAborted):
        check_open(RunState.ABORTED, "id")

    assert refusal.value.facts["result"] == "/api/v1/runs/id/result"


def test_runs_that_count_for_yield_need_a_pose_set() -> None:
    assert {purpose for purpose in Purpose if purpose.needs_pose_set} == {Purpose.PRODUCTION, Purpose.RETEST}
