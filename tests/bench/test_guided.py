import json

import numpy as np
import pytest

from bench.guided import Effort, measure, table
from bench.guided_run import Guidance, guide_vehicle, judge_run, make_vehicle
from bench.paper.lenses import paper_lens
from service.core.guidance.comparison import compare_pose
from service.core.vision.camera import PINHOLE
from service.core.vision.pose import estimate_pose
from service.simulator.operator import Habits, Hand
from service.simulator.scene import production_scene
from tests.simulator.cameras import centred_pose

CALM = Habits(lapses_per_s=0.0)


def test_a_hand_that_reads_only_hints_is_photographed_where_it_was_wanted() -> None:
    lens = paper_lens("lens1")
    wanted = centred_pose(lens.target, (10.0, -15.0, 5.0), (0.04, 0.0, 0.45))
    guidance = Guidance(lens.intrinsics, lens.target, (wanted,))
    vehicle = make_vehicle(production_scene(lens.intrinsics, lens.target), exposure_s=0.005)
    run = guide_vehicle(vehicle, guidance, Hand(lens.target, None, CALM), np.random.default_rng(1))
    assert run.complete
    assert run.answered == [0]
    assert 0.5 < run.elapsed_s < 60.0
    points = run.detections[0].detection.image_points
    seen = estimate_pose(lens.intrinsics, lens.target.object_points, points).pose
    difference = compare_pose(wanted, seen, lens.intrinsics, lens.target)
    assert difference.corner_px < guidance.settings.tolerances.corner_px + 2.0
    assert judge_run(run, guidance) is None  # one view makes no calibration


def test_a_hand_that_never_comes_ends_without_a_capture(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("bench.guided_run.LONGEST_POSE_S", 1.0)
    lens = paper_lens("lens1")
    away = centred_pose(lens.target, (0.0, 0.0, 0.0), (5.0, 0.0, 0.5))
    guidance = Guidance(lens.intrinsics, lens.target, (away,))
    vehicle = make_vehicle(production_scene(lens.intrinsics, lens.target))
    run = guide_vehicle(vehicle, guidance, Hand(lens.target, None, CALM), np.random.default_rng(1))
    assert not run.complete
    assert run.images == []


def test_the_bench_has_its_keys_and_counts_what_passed() -> None:
    result = measure(Effort(seeds=1, poses=3, candidates=300, processes=1, lenses=("lens1",)))
    part = result["lens1"]
    assert list(part)[:3] == ["passed", "runs", "share_pass"]
    assert part["runs"] == 1
    assert part["passed"] == sum(row["verdict"] == "PASS" for row in part["by_seed"])
    assert set(part["worst_error_px"]) == set(part["worst_error_sd"]) == set(PINHOLE)
    assert part["complete"] == 1
    assert part["worst_error_px"]["fx"] < 2.0
    assert "lens1" in table(result)
    assert result["seeds"] == [0]
    json.dumps(result, allow_nan=False)
