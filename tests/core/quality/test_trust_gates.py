"""Bias, cross-check and identity: what fits well and is wrong all the same."""

from dataclasses import replace

import numpy as np

from service.core.quality.evidence import Expectation
from service.core.quality.gates import Verdict
from service.core.vision.camera import Intrinsics
from service.core.vision.transforms import Array
from tests.core.quality.seen_views import BOARD, CAMERA, NOMINAL, POSES, judge, measured, see_poses

OTHER = Intrinsics.from_vector("pinhole5", CAMERA.vector * np.r_[1.004, 1.004, np.ones(7)], CAMERA.image_size)
SKU = Expectation(NOMINAL, poses=POSES)


def bent(share: float) -> Array:
    """Heights, m, of a board that is bent by a share of a square."""
    x = BOARD.object_points[:, 0] / BOARD.object_points[:, 0].max() - 0.5
    heights: Array = share * BOARD.square_m * 4.0 * x**2
    return heights


def test_a_bent_board_fails_with_a_sku_and_warns_without_one() -> None:
    views = see_poses(heights=bent(0.05))
    assert measured(judge(views, SKU), "bias_ratio").verdict is Verdict.FAIL
    assert measured(judge(views), "bias_ratio").verdict is Verdict.MARGINAL
    assert measured(judge(see_poses(), SKU), "bias_ratio").verdict is Verdict.PASS


def test_two_cameras_that_take_turns_or_follow_each_other_are_told_apart() -> None:
    one, two = see_poses(), see_poses(camera=OTHER, seed=2)
    turns = [two[i] if i % 2 else one[i] for i in range(len(one))]
    after = [*one[:6], *two[6:]]
    for views in (turns, after):
        found = measured(judge(views, SKU), "half_difference")
        assert found.verdict is Verdict.FAIL
        assert found.value is not None
        assert found.value > 3.0


def test_few_views_are_not_cut_in_halves() -> None:
    names = {one.name for one in judge(see_poses(POSES[:7]), Expectation(NOMINAL)).measurements}
    assert "half_difference" not in names


def test_a_view_that_alone_decides_is_named() -> None:
    views = see_poses(noise_px=0.02)
    off = views[3].detection.image_points + np.array([0.0, 2.5]) * np.sin(np.arange(54.0))[:, None]
    views[3] = replace(views[3], detection=replace(views[3].detection, image_points=off))
    found = measured(judge(views, SKU), "worst_view_ratio")
    assert found.verdict is Verdict.FAIL
    assert "03.png" in found.advice


def test_a_camera_far_from_its_nominal_is_not_of_the_sku() -> None:
    for name, vector in (
        ("focal_off_share", NOMINAL.vector * np.r_[1.05, 1.05, np.ones(7)]),
        ("centre_off_px", NOMINAL.vector + np.r_[0, 0, 40, 0, np.zeros(5)]),
    ):
        camera = Intrinsics.from_vector("pinhole5", vector, NOMINAL.image_size)
        found = measured(judge(see_poses(camera=camera), Expectation(NOMINAL)), name)
        assert found.verdict is Verdict.FAIL


def test_a_camera_that_is_nearer_to_another_sku_is_said_to_be_of_that_one() -> None:
    near = Intrinsics.from_vector(
        "pinhole5", NOMINAL.vector * np.r_[1.012, 1.012, np.ones(7)], NOMINAL.image_size
    )
    told = Expectation(NOMINAL, other_skus={"near": near, "twin": NOMINAL})
    found = measured(judge(see_poses(camera=near), told), "other_sku")
    assert found.verdict is Verdict.FAIL
    assert "'near'" in found.advice
    assert measured(judge(see_poses(), told), "other_sku").verdict is Verdict.PASS


def test_pictures_that_were_used_for_another_serial_fail() -> None:
    views = see_poses()
    told = Expectation(NOMINAL, used_for={views[2].sha256: "VIN-OTHER"})
    found = measured(judge(views, told), "used_elsewhere")
    assert found.verdict is Verdict.FAIL
    assert "VIN-OTHER" in found.advice
