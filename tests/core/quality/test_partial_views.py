"""Views that show parts of a coded board: solved, judged and cross-checked like whole ones."""

import numpy as np
import pytest

from service.core.quality.evidence import Expectation, NamedDetection
from service.core.quality.gates import Verdict
from service.core.quality.verdict import calibrate_and_judge
from service.core.vision.calibration import View, calibrate_intrinsics
from service.core.vision.camera import project
from service.core.vision.detection import Detection
from service.core.vision.leave_one_out import leave_one_out
from service.core.vision.target import Target, parse_target
from service.core.vision.transforms import Pose, rotation_matrix, rotation_vector
from tests.core.quality.seen_views import CAMERA, NOMINAL, SHARP

SIZE = np.array(CAMERA.image_size)
FARTHEST = 0.7  # tan of the angle to the axis: far within the lens's reach


def some_of(target: Target, count: int, seed: int) -> list[NamedDetection]:
    """Return views whose boards stand out of the picture more often than not."""
    rng = np.random.default_rng(seed)
    views: list[NamedDetection] = []
    while len(views) < count:
        pitch, yaw, roll = (
            rotation_matrix(np.deg2rad(angle) * axis)
            for angle, axis in zip(rng.uniform((-45, -45, -180), (45, 45, 180)), np.eye(3), strict=True)
        )
        R, depth = yaw @ pitch @ roll, rng.uniform(0.25, 0.6)
        centre = depth * np.array([rng.uniform(-0.45, 0.45), rng.uniform(-0.28, 0.28), 1.0])
        pose = Pose(rotation_vector(R), centre - R @ target.centre)
        pixels = project(CAMERA, pose.rotation, pose.tvec, target.object_points)
        points = target.object_points @ R.T + pose.tvec
        near = np.hypot(points[:, 0], points[:, 1]) < FARTHEST * points[:, 2]
        ids = np.flatnonzero(np.all((pixels > 9.0) & (pixels < SIZE - 10.0), axis=1) & near)
        if len(ids) < 12 or min(len(set(ids // target.columns)), len(set(ids % target.columns))) < 3:
            continue
        seen = pixels[ids] + rng.normal(0.0, 0.1, (len(ids), 2))
        detection = Detection(seen, ids, CAMERA.image_size, SHARP, 0.9, 150.0)
        views.append(NamedDetection(f"{len(views):02d}.png", detection, sha256=f"{len(views)}"))
    return views


@pytest.mark.parametrize("spec", ["charuco:11x8:25mm:18mm:4x4_250", "aprilgrid:6x6:24mm:0.3"])
def test_parts_of_a_coded_board_make_a_good_run(spec: str) -> None:
    target = parse_target(spec)
    off = []
    for seed in range(3):
        views = some_of(target, 16, seed)
        judged = calibrate_and_judge(views, target, expectation=Expectation(NOMINAL))
        assert judged.verdict is Verdict.PASS, [m for m in judged.measurements if m.verdict != "PASS"]
        assert len({len(view.detection.corner_ids) for view in views}) > 5
        sd = np.sqrt(np.diagonal(judged.result.covariance))
        off.append((judged.result.intrinsics.vector - CAMERA.vector) / sd)
        assert judged.result.sigma_px == pytest.approx(0.1, rel=0.05)
    assert 0.5 < np.sqrt(np.mean(np.square(off))) < 1.6


def test_leaving_a_part_out_is_solving_without_it() -> None:
    target = parse_target("charuco:11x8:25mm:18mm:4x4_250")
    views = [
        View(target.object_points[one.detection.corner_ids], one.detection.image_points)
        for one in some_of(target, 12, seed=9)
    ]
    whole = calibrate_intrinsics(views, CAMERA.image_size, nominal=NOMINAL)
    sd = np.sqrt(np.diagonal(whole.covariance))
    for i in (0, 5):
        without = calibrate_intrinsics(views[:i] + views[i + 1 :], CAMERA.image_size, nominal=NOMINAL)
        told = leave_one_out(whole).vectors[i]
        assert np.abs((told - without.intrinsics.vector) / sd).max() < 0.05
