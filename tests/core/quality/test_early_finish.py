"""A run that ended early passes only where its poses prove the accuracy; replaced poses are not missing."""

from dataclasses import replace

import pytest

from service.core.quality.early_finish import EarlyFinish, proven_mapping_px
from service.core.quality.evidence import AddedPose, Expectation
from service.core.quality.gates import Verdict
from service.core.quality.limits import Limits
from service.core.quality.reasons import Reason
from service.core.quality.shortfall import Shortfall, find_shortfall
from service.core.vision.sharpness import Sharpness
from tests.core.quality.seen_views import NOMINAL, POSES, judge, measured, see_poses, with_sharpness

TAKEN = 9
EARLY = Expectation(
    NOMINAL,
    poses=POSES,
    pose_of_view=tuple(range(TAKEN)),
    early_finish=EarlyFinish(smallest_poses=8, required_px=0.3),
)


def test_a_proven_accuracy_excuses_the_poses_that_were_not_needed() -> None:
    judged = judge(see_poses()[:TAKEN], EARLY)
    found = measured(judged, "missing_poses")
    assert (found.value, found.verdict, found.reason) == (0.0, Verdict.PASS, Reason.EARLY_FINISH)
    assert found.facts["taken"] == TAKEN
    assert found.facts["not_needed"] == len(POSES) - TAKEN
    assert found.facts["proven_px"] == proven_mapping_px(judged.result, judged.zone_mapping) <= 0.3


@pytest.mark.parametrize(
    "early",
    [None, EarlyFinish(TAKEN + 1, 0.3), EarlyFinish(8, 0.01)],
    ids=["not allowed", "too few poses", "not proven"],
)
def test_missing_poses_are_missing_where_nothing_excuses_them(early: EarlyFinish | None) -> None:
    found = measured(judge(see_poses()[:TAKEN], replace(EARLY, early_finish=early)), "missing_poses")
    assert (found.value, found.verdict, found.reason) == (3.0, Verdict.FAIL, Reason.MISSING_POSES)


def test_what_is_proven_is_a_little_more_than_what_is_likely() -> None:
    judged = judge(see_poses()[:TAKEN], EARLY)
    ratio = proven_mapping_px(judged.result, judged.zone_mapping) / judged.zone_mapping.mean_px
    assert 1.0 < ratio < 1.06


def test_a_pose_in_place_of_another_answers_for_it() -> None:
    # Pose 2 was out of reach, and so was the first one in its place.
    prescribed = tuple(pose for i, pose in enumerate(POSES) if i != 2)
    expectation = Expectation(
        NOMINAL,
        poses=(*prescribed[:2], POSES[3], *prescribed[2:]),
        added=(AddedPose(POSES[3], replaces=2), AddedPose(POSES[2], replaces=len(POSES))),
        pose_of_view=(0, 1, len(POSES) + 1, *range(3, len(POSES))),
    )
    assert measured(judge(see_poses(), expectation), "missing_poses").value == 0.0
    without = replace(expectation, added=(expectation.added[0], AddedPose(POSES[2])))
    missing = measured(judge(see_poses(), without), "missing_poses")
    assert missing.facts["poses"] == [3]


def test_an_extra_pose_must_match_but_need_not_be_taken() -> None:
    extra = AddedPose(POSES[0])
    expectation = Expectation(
        NOMINAL, poses=POSES[:-1], added=(extra,), pose_of_view=tuple(range(len(POSES) - 1))
    )
    assert measured(judge(see_poses()[:-1], expectation), "missing_poses").value == 0.0
    off = replace(expectation, pose_of_view=tuple(range(len(POSES))))
    assert measured(judge(see_poses(), off), "match_px").verdict is Verdict.FAIL


def test_a_shortfall_is_named_only_where_one_pose_more_may_mend_it() -> None:
    views = see_poses()
    good = judge(views, Expectation(NOMINAL, poses=POSES))
    soft = [with_sharpness(views[0], Sharpness(4.0, (4.0,) * 4, 4.0)), *views[1:]]
    assert find_shortfall(good, required_px=0.3) is None
    assert find_shortfall(good, required_px=0.01) == Shortfall()
    assert find_shortfall(judge(soft, Expectation(NOMINAL, poses=POSES)), 0.3) == Shortfall(views[0].name)
    noisy = judge(see_poses(noise_px=0.9), Expectation(NOMINAL, poses=POSES))
    assert noisy.verdict is Verdict.FAIL
    assert find_shortfall(noisy, 0.3) is None
    tight = judge(views, Expectation(NOMINAL, Limits(centre_sd_px=0.01), poses=POSES))
    assert find_shortfall(tight, 0.3) == Shortfall()
