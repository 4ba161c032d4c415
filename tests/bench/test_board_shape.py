from typing import Any

import pytest

from bench.board_shape import run, table


@pytest.fixture(scope="module")
def result() -> dict[str, Any]:
    return run(quick=True)


@pytest.mark.parametrize("plate", ["bow", "twist"])
def test_a_bent_plate_is_learnt_and_no_longer_moves_the_focal_length(
    result: dict[str, Any], plate: str
) -> None:
    row = result["plates"][plate]["5"]
    assert row["error_mm"] < 0.03
    for name in ("fx", "fy"):
        assert abs(row["bias_px"][name]) < row["sd_px"][name]
        assert abs(row["bias_flat_px"][name]) > abs(row["bias_px"][name])


def test_the_table_has_a_line_for_each_plate(result: dict[str, Any]) -> None:
    lines = table(result).splitlines()
    assert [line.split()[0] for line in lines] == ["plate", "bow", "twist"]
