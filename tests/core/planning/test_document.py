import json
from copy import deepcopy
from dataclasses import replace
from typing import Any

import pytest

from service.core.errors import PoseSetInvalid
from service.core.planning.document import pose_from_dict, pose_set_from_dict, pose_set_to_dict
from service.core.planning.noise import FITTED_NOISE
from service.core.planning.plan import PLANNER, plan_pose_set
from service.core.planning.pose_space import PoseSpace
from service.core.vision.uncertainty import MappingError
from tests.core.planning.cameras import BOARD, LENS1

PLANNED = plan_pose_set(LENS1, BOARD, PoseSpace(), 4, seed=1, candidates=300)


def document() -> dict[str, Any]:
    return deepcopy(pose_set_to_dict(PLANNED))


def test_a_pose_set_survives_json_to_the_last_digit() -> None:
    again = pose_set_from_dict(json.loads(json.dumps(document(), allow_nan=False)))
    assert pose_set_to_dict(again) == document()


def test_the_document_has_the_agreed_shape() -> None:
    found = document()
    assert list(found) == ["poses", "prediction", "provenance"]
    assert [list(pose) for pose in found["poses"]] == [["rvec", "tvec"]] * 4
    assert found["prediction"]["norm_px"] == PLANNED.expected_norm_px
    assert list(found["prediction"]["sd"]) == ["fx", "fy", "cx", "cy", "k1", "k2", "p1", "p2", "k3"]
    assert set(found["prediction"]["mapping"]) == {"mean_px", "worst_px"}
    assert found["provenance"] == {
        "seed": 1,
        "candidates": 300,
        "sigma_px": 0.1,
        "objective": "balanced",
        "planner": PLANNER,
        "weights": {"parameters": 1.0, "mapping_mean": 1.0, "mapping_worst": 0.0},
        "draws": 1,
        "noise_source": "one for all poses",
    }


def test_what_older_planners_did_not_know_is_read_as_they_planned() -> None:
    old = document()
    for name in ("weights", "draws", "noise_source"):
        del old["provenance"][name]
    for name in ("curve", "pose_sigma_px"):
        del old["prediction"][name]
    assert pose_set_to_dict(pose_set_from_dict(old)) == document()


def test_a_curve_and_noise_by_pose_come_back_as_they_were() -> None:
    full = plan_pose_set(
        LENS1, BOARD, PoseSpace(), 4, 1, candidates=100, sigma_px=FITTED_NOISE, with_curve=True
    )
    found = pose_set_from_dict(json.loads(json.dumps(pose_set_to_dict(full), allow_nan=False)))
    assert found.curve == full.curve
    assert len(found.curve) > 3
    assert found.pose_sigma_px == full.pose_sigma_px
    assert found.noise_source == full.noise_source


def test_a_zone_that_the_lens_does_not_reach_is_null_and_comes_back_as_infinite() -> None:
    unreached = replace(PLANNED, expected_mapping=MappingError(float("inf"), float("inf")))
    found = json.loads(json.dumps(pose_set_to_dict(unreached), allow_nan=False))
    assert found["prediction"]["mapping"] == {"mean_px": None, "worst_px": None}
    assert pose_set_from_dict(found).expected_mapping == unreached.expected_mapping


@pytest.mark.parametrize(
    ("path", "value"),
    [
        (("prediction", "norm_px"), "much"),
        (("prediction", "sd"), [1, 2]),
        (("prediction", "mapping"), 3),
        (("provenance", "objective"), "luck"),
        (("poses",), 7),
        (("poses",), [{"rvec": [0, 0, 0], "tvec": [0, 0]}]),
        (("poses",), [{"rvec": [0, 0, float("nan")], "tvec": [0, 0, 1]}]),
        (("poses",), [{"rvec": [0, 0, 0]}]),
    ],
)
def test_a_broken_document_is_refused(path: tuple[str, ...], value: object) -> None:
    broken = document()
    inner = broken
    for key in path[:-1]:
        inner = inner[key]
    inner[path[-1]] = value
    with pytest.raises(PoseSetInvalid):
        pose_set_from_dict(broken)


@pytest.mark.parametrize("part", ["poses", "prediction", "provenance"])
def test_a_missing_part_is_named(part: str) -> None:
    broken = document()
    del broken[part]
    with pytest.raises(PoseSetInvalid, match=part):
        pose_set_from_dict(broken)


def test_a_pose_that_is_no_object_is_refused() -> None:
    with pytest.raises(PoseSetInvalid):
        pose_from_dict([1, 2])  # type: ignore[arg-type]
