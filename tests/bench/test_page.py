import json
from pathlib import Path

import pytest

from bench.page import fill, main

PAGE = "words\n<!-- bench paper figure4: begin -->\nold\n<!-- bench paper figure4: end -->\nmore words\n"
SPREAD = {"mean": 0.02, "std": 0.001, "min": 0.01, "median": 0.02, "max": 0.03}
ARMS = ("freehand", "guided", "guided_10", "guided_6", "freehand_ours", "guided_opencv")


def test_a_table_takes_the_place_of_the_old_one_and_can_be_replaced_again() -> None:
    once = fill(PAGE, "paper figure4", "a \\1 table")
    assert once.startswith("words\n")
    assert "old" not in once
    assert "```\na \\1 table\n```" in once
    assert fill(once, "paper figure4", "another") == fill(PAGE, "paper figure4", "another")


def test_a_page_is_filled_from_a_stored_result(tmp_path: Path) -> None:
    page, stored = tmp_path / "page.md", tmp_path / "figure4.json"
    page.write_text(PAGE)
    stored.write_text(json.dumps({lens: dict.fromkeys(ARMS, SPREAD) for lens in ("lens1", "lens2")}))
    assert main([str(page), f"paper figure4={stored}"]) == 0
    assert "lens2 guided_opencv" in page.read_text()
    assert page.read_text().endswith("more words\n")


@pytest.mark.parametrize("name", ["solve", "no-such-bench"])
def test_a_name_without_a_place_or_bench_changes_nothing(tmp_path: Path, name: str) -> None:
    page = tmp_path / "page.md"
    page.write_text(PAGE)
    assert main([str(page), f"{name}=none.json"]) == 2
    assert page.read_text() == PAGE


def test_the_page_of_experiments_has_a_place_for_each() -> None:
    page = (Path(__file__).resolve().parents[2] / "docs" / "experiments.md").read_text()
    for name in ("paper table1", "paper table2", "paper figure4", "guided"):
        assert fill(page, name, "a new table").count("a new table") == 1
