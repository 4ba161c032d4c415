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
    assert "paper table1" in complaint


@pytest.mark.parametrize("name", ["paper", "paper table9", "table1", "paper table1 more"])
def test_half_a_name_or_one_word_too_many_is_no_bench(name: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert command.main(name.split()) == 2
    assert f"'{name}'" in capsys.readouterr().err


def test_the_papers_experiments_have_names_of_two_words() -> None:
    assert {"paper table1", "paper table2", "paper figure4", "guided"} <= set(command.find_benches())


def test_a_name_of_two_words_runs_its_bench(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    inner = Counting()
    monkeypatch.setattr(command, "find_benches", lambda: {"outer inner": inner})
    assert command.main(["outer", "inner", "--quick"]) == 0
    assert inner.runs == [True]
    assert capsys.readouterr().out == "ratio 2.0\n"


@pytest.mark.parametrize("option", ["--plot", "--reuse"])
def test_what_a_bench_cannot_do_is_refused_before_it_runs(
    counting: Counting, option: str, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    assert command.main(["counting", option, str(tmp_path / "file")]) == 2
    assert option in capsys.readouterr().err
    assert counting.runs == []


def test_a_file_that_holds_no_trials_is_refused(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    for content in ("{}", "not JSON"):
        (tmp_path / "other.json").write_text(content)
        assert command.main(["paper", "figure4", "--reuse", str(tmp_path / "other.json")]) == 2
        assert "cannot use" in capsys.readouterr().err
    assert command.main(["paper", "figure4", "--reuse", str(tmp_path / "none.json")]) == 2


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
