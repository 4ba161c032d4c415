import json
from pathlib import Path
from typing import Any

import cv2
import pytest

from bench.paper import figure4, table1, table2
from bench.paper.novice_trials import ARMS, Effort, nominal_camera, true_camera

TINY = table1.Effort(repetitions=2, candidates=200, sets=6, trials=6, poses=8, processes=1)


def test_table1_stands_beside_the_published_one_and_its_picks_are_the_extremes(tmp_path: Path) -> None:
    result = table1.measure(TINY)
    assert list(result)[:5] == ["min_mre", "max_mre", "min_score", "max_score", "planned"]
    for row in table1.ROWS:
        assert {"mre_px", "score", "norm", "fresh_mean", "fresh_sd", "published"} <= set(result[row])
    for mre, score in zip(
        result["min_mre"]["mre_px"]["each"], result["max_mre"]["mre_px"]["each"], strict=True
    ):
        assert mre < score
    worst, best = (result[row]["score"]["each"] for row in ("min_score", "max_score"))
    assert all(low < high for low, high in zip(worst, best, strict=True))
    for row in table1.ROWS:
        for mre, norm, score in zip(
            *(result[row][name]["each"] for name in ("mre_px", "norm", "score")), strict=True
        ):
            assert score == pytest.approx(1.0 / (mre + norm))
    assert result["planned"]["fresh_mean"]["mean"] < result["min_score"]["fresh_mean"]["mean"]
    assert "4.82" in table1.table(result)
    json.dumps(result, allow_nan=False)
    table1.plot(result, tmp_path / "table1.png")
    assert cv2.imread(str(tmp_path / "table1.png")) is not None


def trial(lens: str, novice: int, arm: str) -> dict[str, object]:
    """A trial whose fx is off by the person's number, ten times as much freehand."""
    off = novice * (1.0 if arm == "freehand" else 0.1)
    parameters = {name: value + off * (name == "fx") for name, value in true_camera(lens).parameters.items()}
    return {
        "lens": lens,
        "novice": novice,
        "arm": arm,
        "parameters": parameters,
        "mre_px": 0.02 + 0.001 * novice,
        "elapsed_s": 10.0,
    }


@pytest.fixture
def told() -> dict[str, Any]:
    trials = [trial(lens, i, arm) for lens in ("lens1", "lens2") for arm in ARMS for i in range(3)]
    trials.append({**trial("lens1", 3, "freehand"), "parameters": None, "mre_px": None})
    return table2.measure(trials, Effort())


def test_table2_is_mean_sd_bias_and_ratio_of_the_people(
    told: dict[str, Any],
) -> None:
    freehand, guided = told["lens1"]["freehand"], told["lens1"]["guided"]
    assert freehand["fx"]["std"] == pytest.approx(1.0)
    assert guided["fx"]["std"] == pytest.approx(0.1)
    assert guided["fx"]["bias"] == pytest.approx(0.1)
    assert told["lens1"]["ratio"]["fx"] == pytest.approx(10.0)
    assert (freehand["solved"], freehand["people"]) == (3, 4)
    assert told["lens1"]["requirements_missed"] == []
    json.dumps(told, allow_nan=False)


def test_table2_and_figure4_are_told_and_drawn(told: dict[str, Any], tmp_path: Path) -> None:
    assert "paper, OpenCV" in table2.table(told)
    stored = json.loads(json.dumps({**told, "quick": True, "versions": {}, "cores": 2}))
    assert table2.reuse(stored)["lens1"] == told["lens1"]
    assert table2.table(table2.reuse(stored)) == table2.table(told)
    again = figure4.reuse(stored)
    assert again["lens1"]["freehand"]["mean"] == pytest.approx(0.021)
    assert (again["quick"], again["seeds"]) == (True, told["seeds"])
    assert "lens2 guided" in figure4.table(again)
    for drawn, result in ((table2, told), (figure4, again)):
        path = tmp_path / f"{drawn.__name__}.png"
        drawn.plot(result, path)
        assert 5_000 < path.stat().st_size < 200_000


def test_a_table1_has_no_trials_for_figure4() -> None:
    with pytest.raises(KeyError):
        figure4.reuse({"min_mre": {}})


def test_the_nominal_is_off_within_the_tolerance() -> None:
    for lens in ("lens1", "lens2"):
        off = abs(nominal_camera(lens).parameters["fx"] / true_camera(lens).parameters["fx"] - 1.0)
        assert 0.0 < off < 0.006
