import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pytest

from bench import __main__ as command


class Counting:
    """A bench that counts its runs."""

    def __init__(self) -> None:
        self.runs: list[bool] = []

    def run(self, quick: bool) -> dict[str, Any]:
        self.runs.append(quick)
        return {"seeds": [5], "ratio": 2.0, "by_n": {"20": 1.0}}

    def table(self, result: Mapping[str, Any]) -> str:
        return f"ratio {result['ratio']}"


@pytest.fixture
def counting(monkeypatch: pytest.MonkeyPatch) -> Counting:
    counting = Counting()
    monkeypatch.setattr(command, "find_benches", lambda: {"counting": counting})
    return counting


def test_an_unknown_name_lists_the_benches_and_exits_with_2(capsys: pytest.CaptureFixture[str]) -> None:
    assert command.main(["no-such-bench"]) == 2
    complaint = capsys.readouterr().err
    assert "no-such-bench" in complaint
    assert "planning" in complaint


def test_the_table_is_printed_and_nothing_is_written_without_being_asked(
    counting: Counting, capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    assert command.main(["counting"]) == 0
    assert capsys.readouterr().out == "ratio 2.0\n"
    assert counting.runs == [False]
    assert list(tmp_path.iterdir()) == []


def test_json_holds_what_was_measured_first_then_what_it_was_made_with(
    counting: Counting, tmp_path: Path
) -> None:
    out = tmp_path / "out.json"
    out.write_text("old")
    assert command.main(["counting", "--quick", "--json", str(out)]) == 0
    found = json.loads(out.read_text())
    assert list(found) == ["ratio", "by_n", "quick", "versions", "cores", "seeds"]
    assert found["seeds"] == [5]
    assert found["quick"] is True
    assert {"python", "numpy", "scipy"} <= set(found["versions"])
    assert counting.runs == [True]
    assert list(tmp_path.iterdir()) == [out]


def test_a_failing_bench_leaves_the_old_file(counting: Counting, tmp_path: Path) -> None:
    out = tmp_path / "out.json"
    out.write_text("old")

    def fail(quick: bool) -> dict[str, Any]:
        raise RuntimeError("measured nothing")

    counting.run = fail  # type: ignore[method-assign]
    with pytest.raises(RuntimeError):
        command.main(["counting", "--json", str(out)])
    assert out.read_text() == "old"
    assert list(tmp_path.iterdir()) == [out]
