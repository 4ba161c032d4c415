"""The verdict: good views pass, each fault fails for its own reason, and the worst measurement decides."""

from dataclasses import replace

import numpy as np
import pytest

from service.core.errors import TooFewViews
from service.core.quality.evidence import Expectation, NamedDetection, Refusal
from service.core.quality.gates import Verdict
from service.core.quality.gates_poses import nearest_views
from service.core.quality.limits import Limits
from service.core.quality.reasons import Reason
from service.core.quality.verdict import calibrate_and_judge
from service.core.vision.sharpness import Sharpness
from tests.core.quality.seen_views import (
    BOARD,
    CAMERA,
    NOMINAL,
    POSES,
    judge,
    measured,
    moved,
    see,
    see_poses,
    with_sharpness,
)
from tests.core.vision.cameras import ALL_ROUND, views_of

EVERY_POSE = Expectation(NOMINAL, poses=POSES)


def test_good_views_of_every_prescribed_pose_pass() -> None:
    judged = judge(see_poses(), EVERY_POSE)
    assert [one.name for one in judged.measurements if one.verdict is not Verdict.PASS] == []
    assert judged.verdict is Verdict.PASS


def test_each_gate_speaks() -> None:
    with_sku = {one.gate for one in judge(see_poses(), EVERY_POSE).measurements}
    without = {one.name for one in judge(see_poses()).measurements}
    fitting = {"frame", "sharpness", "poses", "fit", "certainty", "bias", "cross_check", "model", "score"}
    assert with_sku == fitting | {"identity"}
    assert {"missing_poses", "match_px", "coverage", "paper_score"}.isdisjoint(without)
    assert "image_coverage" in without


def test_the_worst_measurement_decides() -> None:
    marginal = Expectation(NOMINAL, Limits(rms_px=0.15))
    failing = Expectation(NOMINAL, Limits(rms_px=0.10))
    assert judge(see_poses(), marginal).verdict is Verdict.MARGINAL
    assert judge(see_poses(), failing).verdict is Verdict.FAIL


def test_the_score_is_the_papers() -> None:
    judged = judge(see_poses(), EVERY_POSE)
    errors = np.linalg.norm(np.concatenate(judged.result.residuals), axis=1)
    norm = np.linalg.norm(judged.result.intrinsics.vector - NOMINAL.vector)
    assert judged.score == pytest.approx(1.0 / (errors.mean() + norm))
    assert judged.score_difference_px is not None
    assert 0.5 < judged.score_difference_px < 10.0


def test_one_view_given_again_and_again_fails_as_such() -> None:
    views = see_poses()
    copies = [replace(views[0], name=f"copy{i}") for i in range(3)]
    found = measured(judge([*views, *copies]), "view_separation_px")
    assert (found.value, found.verdict) == (0.0, Verdict.FAIL)
    assert "copy0" in found.advice


def test_many_views_are_compared_in_reasonable_time() -> None:
    far = see_poses()[0]
    spread = np.random.default_rng(3).uniform(0, 1e6, (400, 1, 2))
    views = [see(far.detection.image_points + shift, str(i)) for i, shift in enumerate(spread)]
    distance, first, second = nearest_views(views, len(BOARD.object_points))
    all_pairs = np.linalg.norm(spread[:, None, 0] - spread[None, :, 0], axis=-1) + 1e9 * np.eye(400)
    assert distance == pytest.approx(all_pairs.min())
    assert {int(first), int(second)} == set(np.argwhere(all_pairs == all_pairs.min())[0].tolist())


def test_the_same_place_with_other_noise_is_the_same_view() -> None:
    views = see_poses()
    again = replace(see_poses(seed=2)[3], name="again", sha256="other")
    assert measured(judge([*views, again]), "view_separation_px").verdict is Verdict.FAIL


def test_a_bent_board_fails_and_is_called_bent() -> None:
    x = np.linspace(-1, 1, BOARD.columns)
    heights = np.tile(0.003 * (1 - x**2), BOARD.rows)
    found = measured(judge(see_poses(heights=heights)), "rms_px")
    assert found.verdict is Verdict.FAIL
    assert "not flat" in found.advice
    assert (found.reason, list(found.facts)) == (Reason.RMS_BENT_BOARD, ["bend"])


def test_a_lens_that_the_model_does_not_describe_is_called_so() -> None:
    centre = CAMERA.vector[2:4]
    views = []
    for view in see_poses():
        offset = view.detection.image_points - centre
        radius = np.linalg.norm(offset, axis=1, keepdims=True) / 600.0
        waves = 1.0 + 0.004 * np.sin(14.0 * radius)
        points = centre + offset * waves
        views.append(replace(view, detection=replace(view.detection, image_points=points)))
    found = measured(judge(views), "rms_px")
    assert found.verdict is Verdict.FAIL
    assert "lens model pinhole5" in found.advice
    assert (found.reason, found.facts) == (Reason.RMS_OTHER_LENS, {"lens": "pinhole5"})


def views_all_round() -> list[NamedDetection]:
    """Return what a fisheye sees of boards all about it, some of them beside it."""
    views = views_of(ALL_ROUND, 16, seed=11)
    return [see(view.image_points, f"{i}.png", ALL_ROUND.image_size) for i, view in enumerate(views)]


def test_boards_beside_a_fisheye_face_it_and_its_model_holds() -> None:
    judged = calibrate_and_judge(views_all_round(), BOARD, "kannala_brandt4")
    axis = [float(pose.rotation[2, 2]) for pose in judged.result.poses]
    assert min(axis) < -0.3  # along the axis one shows its back, along the line of sight none
    for name in ("facing", "nearest_corner", "converged", "monotone_ratio", "rms_px"):
        assert measured(judged, name).verdict is not Verdict.FAIL, name


def test_a_mirrored_picture_of_a_fisheye_shows_the_back_of_the_board() -> None:
    views = views_all_round()
    points = views[3].detection.image_points.reshape(BOARD.rows, BOARD.columns, 2)[:, ::-1].reshape(-1, 2)
    views[3] = see(points, "mirrored.png", ALL_ROUND.image_size)
    found = measured(calibrate_and_judge(views, BOARD, "kannala_brandt4"), "facing")
    assert found.verdict is Verdict.FAIL
    assert "mirrored.png" in found.advice


def test_a_fisheye_is_too_much_for_five_coefficients_and_the_advice_names_its_model() -> None:
    judged = calibrate_and_judge(views_all_round(), BOARD, "pinhole5")
    assert judged.verdict is Verdict.FAIL
    found = measured(judged, "monotone_ratio")
    assert found.verdict is Verdict.FAIL
    assert "kannala_brandt4" in found.advice


def test_a_blurred_view_is_named() -> None:
    views = see_poses()
    views[5] = with_sharpness(views[5], Sharpness(8.2, (8.2,) * 4, 8.2))
    found = measured(judge(views), "edge_width_px")
    assert (found.value, found.verdict) == (8.2, Verdict.FAIL)
    assert "05.png" in found.advice
    assert (found.reason, found.facts) == (Reason.EDGE_WIDTH, {"views": ["05.png"], "more": 0})


def test_a_lens_out_of_focus_is_told_from_one_blurred_view() -> None:
    views = [with_sharpness(v, Sharpness(8.2, (8.2,) * 4, 8.2)) for v in see_poses()]
    found = measured(judge(views), "edge_width_px")
    assert found.verdict is Verdict.FAIL
    assert f"{len(views)} of {len(views)} views are blurred. Focus the lens" in found.advice
    assert (found.reason, found.facts) == (Reason.BLURRED_LENS, {"count": len(views), "of": len(views)})


def test_edges_that_could_not_be_measured_are_not_sharp() -> None:
    views = see_poses()
    views[5] = with_sharpness(views[5], Sharpness(float("nan"), (float("nan"),) * 4, float("nan")))
    found = measured(judge(views), "edge_width_px")
    assert (found.value, found.verdict) == (None, Verdict.FAIL)


def test_a_lens_that_is_soft_in_one_quadrant_is_told_from_a_soft_one() -> None:
    views = [with_sharpness(v, Sharpness(2.2, (2.0, 2.0, 2.8, 2.0), 2.0)) for v in see_poses()]
    found = measured(judge(views), "quadrant_ratio")
    assert found.value == pytest.approx(1.4)
    assert found.verdict is Verdict.FAIL
    assert "bottom right" in found.advice
    assert found.facts == {"quadrant": "bottom-right"}


def test_one_soft_corner_of_one_view_is_no_tilted_lens() -> None:
    views = see_poses()
    views[0] = with_sharpness(views[0], Sharpness(2.2, (2.0, 2.0, 2.9, 2.0), 2.0))
    assert measured(judge(views), "quadrant_ratio").verdict is Verdict.PASS


def test_dark_and_unclear_boards_are_named() -> None:
    views = see_poses()
    views[2] = replace(views[2], detection=replace(views[2].detection, contrast=25.0))
    views[4] = replace(views[4], detection=replace(views[4].detection, parity_separation=0.3))
    judged = judge(views)
    assert "02.png" in measured(judged, "contrast").advice
    assert "04.png" in measured(judged, "parity_separation").advice
    assert judged.verdict is Verdict.FAIL


def test_a_saturated_view_is_named_and_one_of_before_says_nothing() -> None:
    unmeasured = see_poses()
    assert "saturated_share" not in {one.name for one in judge(unmeasured).measurements}
    for share, verdict in ((0.15, Verdict.PASS), (0.19, Verdict.MARGINAL), (0.21, Verdict.FAIL)):
        views = list(unmeasured)
        views[3] = replace(views[3], detection=replace(views[3].detection, saturated_share=share))
        views[4] = replace(views[4], detection=replace(views[4].detection, saturated_share=0.01))
        found = measured(judge(views), "saturated_share")
        assert (found.verdict, found.facts["views"]) == (verdict, ["03.png"])


def test_a_moved_corner_is_seen_though_the_rms_allows_it() -> None:
    views = see_poses()
    views[7] = moved(views[7], corner=20, by_px=4.0)
    judged = judge(views)
    assert measured(judged, "rms_px").verdict is Verdict.PASS
    found = measured(judged, "worst_view_ratio")
    assert found.verdict is Verdict.FAIL
    assert "07.png" in found.advice


def test_a_stretched_image_fails_on_the_pixels_ratio() -> None:
    views = see_poses()
    stretched = [
        replace(v, detection=replace(v.detection, image_points=v.detection.image_points * [0.98, 1.0]))
        for v in views
    ]
    found = measured(judge(stretched, EVERY_POSE), "square_pixels")
    assert found.value == pytest.approx(0.02, abs=0.001)
    assert found.verdict is Verdict.FAIL


def test_computed_corners_are_implausible() -> None:
    assert measured(judge(see_poses(noise_px=0.0)), "smallest_rms_px").verdict is Verdict.FAIL


def test_views_of_the_middle_only_leave_the_working_zone_uncovered() -> None:
    views = [v for v in see_poses() if np.ptp(v.detection.image_points[:, 0]) < 900][:4]
    middle = [see(640 + (v.detection.image_points - 640) * 0.2, v.name) for v in views]
    found = measured(judge(middle, Expectation(NOMINAL)), "coverage")
    assert found.verdict is Verdict.FAIL


def test_few_views_are_not_certain_enough() -> None:
    judged = judge(see_poses(noise_px=0.25)[:3])
    assert judged.verdict is Verdict.FAIL
    failed = {one.gate for one in judged.measurements if one.verdict is Verdict.FAIL}
    assert "certainty" in failed


def test_a_pose_that_was_not_taken_is_numbered() -> None:
    found = measured(judge(see_poses(POSES[:-1]), EVERY_POSE), "missing_poses")
    assert (found.value, found.verdict) == (1.0, Verdict.FAIL)
    assert f"pose {len(POSES)}" in found.advice
    assert found.facts == {"poses": [len(POSES)], "more": 0}


def test_views_in_any_order_find_their_poses() -> None:
    judged = judge(list(reversed(see_poses())), EVERY_POSE)
    assert measured(judged, "missing_poses").verdict is Verdict.PASS


def test_a_view_answers_the_pose_that_it_was_taken_for_and_no_other() -> None:
    swapped = (1, 0, *range(2, len(POSES)))
    judged = judge(see_poses(), Expectation(NOMINAL, poses=POSES, pose_of_view=swapped))
    assert measured(judged, "missing_poses").value == 2.0
    assert measured(judged, "match_px").verdict is Verdict.FAIL


def test_an_image_of_another_size_is_refused_by_name_and_the_rest_goes_on() -> None:
    odd = see(see_poses()[0].detection.image_points, "odd.png", image_size=(1281, 801))
    judged = judge([odd, *see_poses()])
    assert [refusal.name for refusal in judged.refused] == ["odd.png"]
    assert judged.result.intrinsics.image_size == (1280, 800)
    assert measured(judged, "refused_images").verdict is Verdict.MARGINAL
    assert judged.verdict is Verdict.MARGINAL


def test_the_skus_size_counts_and_not_the_majoritys() -> None:
    views = [see(v.detection.image_points, v.name, image_size=(640, 400)) for v in see_poses()]
    with pytest.raises(TooFewViews, match=r"00\.png: The image has 640x400 px"):
        judge(views, EVERY_POSE)


def test_refused_poses_keep_the_others_assigned() -> None:
    views = see_poses()
    views[0] = see(views[0].detection.image_points, "odd.png", image_size=(640, 400))
    order = tuple(range(len(POSES)))
    judged = judge(views, Expectation(NOMINAL, poses=POSES, pose_of_view=order))
    assert "pose 1" in measured(judged, "missing_poses").advice
    assert measured(judged, "match_px").verdict is Verdict.PASS


def test_an_image_without_a_board_costs_the_pass_and_one_with_another_board_fails() -> None:
    blank = Refusal("road.jpg", "target-not-visible", "No board.")
    other = Refusal("other.jpg", "wrong-target", "Another board.")
    assert calibrate_and_judge(see_poses(), BOARD, refused=[blank]).verdict is Verdict.MARGINAL
    judged = calibrate_and_judge(see_poses(), BOARD, refused=[blank, other])
    assert measured(judged, "wrong_target").verdict is Verdict.FAIL
    assert judged.verdict is Verdict.FAIL


def test_too_few_views_name_every_refused_image_with_its_reason() -> None:
    refused = [Refusal(f"road{i}.jpg", "target-not-visible", "No board.") for i in range(5)]
    with pytest.raises(TooFewViews) as caught:
        calibrate_and_judge(see_poses()[:2], BOARD, refused=refused)
    assert caught.value.facts["views_found"] == 2
    assert caught.value.facts["refused"] == [refusal.name for refusal in refused]
    assert "road4.jpg: No board." in caught.value.detail


def test_no_views_at_all_are_too_few() -> None:
    with pytest.raises(TooFewViews):
        judge([])


def test_the_same_views_are_judged_alike_again() -> None:
    assert judge(see_poses(), EVERY_POSE).measurements == judge(see_poses(), EVERY_POSE).measurements
