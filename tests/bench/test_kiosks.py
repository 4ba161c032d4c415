import math

import pytest

from bench import kiosks
from bench.kiosk_clients import Heard
from bench.kiosks import run, summarise, table


def test_kiosks_are_held_while_nearly_all_states_come_in_time() -> None:
    row = summarise([Heard(100, [20.0] * 98), Heard(100, [40.0] * 99)], cpu_s=1.97)
    assert (row["held"], row["answered"]) == (True, 0.985)
    assert row["cpu_ms_per_frame"] == pytest.approx(10.0)


@pytest.mark.parametrize("heard", [Heard(100, [150.0] * 100), Heard(100, [20.0] * 90), Heard(100, [])])
def test_kiosks_are_not_held_when_states_are_late_or_missing(heard: Heard) -> None:
    assert not summarise([heard], cpu_s=0.1)["held"]


def test_a_real_service_answers_real_kiosks(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(kiosks, "QUICK_COUNTS", (2,))
    monkeypatch.setattr(kiosks, "QUICK_S", 0.7)
    monkeypatch.setattr(kiosks, "FRAMES", 5)
    result = run(quick=True)
    (tried,) = result["tried"]
    assert {"kiosks", "p95_ms"} <= set(result)
    assert tried["answered"] > 0
    assert math.isfinite(tried["p95_ms"])
    assert tried["problems"] == []
    assert "kiosks at 15 frames/s" in table(result)
