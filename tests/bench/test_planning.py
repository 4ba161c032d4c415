import json

import pytest

from bench.planning import Effort, measure, table


def test_our_sets_are_better_than_the_papers_and_the_keys_are_the_agreed_ones() -> None:
    result = measure(Effort(candidates=300, sets=8, trials=12, counts=(8,)))
    assert list(result)[:5] == ["ours", "paper", "norm_ratio", "wall_ratio", "by_n"]
    assert set(result["by_n"]) == {"8"}
    for row in ("ours", "paper"):
        assert {"expected_px", "monte_carlo_px", "wall_s"} <= set(result[row])
        # 12 trials of 9 parameters: the root mean square is known to some 20 %.
        assert result[row]["monte_carlo_px"] == pytest.approx(result[row]["expected_px"], rel=0.7)
    assert result["ours"]["expected_px"] < 0.8 * result["paper"]["expected_px"]
    assert result["norm_ratio"] == result["paper"]["monte_carlo_px"] / result["ours"]["monte_carlo_px"]
    json.dumps(result, allow_nan=False)
    assert "ours" in table(result)
