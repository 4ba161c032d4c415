"""A hand that reads only hints reaches the poses, and would not if one hint pointed the wrong way.

A subset of `bench guidance_hand`, which takes every pose from fifty starts, whole runs and every flip.
"""

import functools

import numpy as np
import pytest

from bench.geometric_kiosk import OPPOSITE, Display, GuidedRun, as_told, guide_hand
from bench.guided_trials import Station, attempt, plan_station, random_starts, reaching, upside_down
from service.core.guidance.hints import Hint, ShownHint, mirror_hint
from service.core.vision.transforms import Pose, rotation_matrix, rotation_vector
from service.demo.skus import PAPER_SKUS
from service.simulator.operator import Habits, Hand

CALM = Habits(lapses_per_s=0.0)
HOME = np.array(CALM.home_m)
SHORTLY_S = 7.0


@functools.cache
def station(index: int) -> Station:
    return plan_station(PAPER_SKUS[index], 300, 12)


@functools.cache
def fisheye_station() -> Station:
    """Return a station whose camera sees 200 degrees from corner to corner, with its poses."""
    nominal = {"fx": 431.0, "fy": 431.0, "cx": 639.5, "cy": 399.5, "k1": 0.01}
    return plan_station({**PAPER_SKUS[0], "lens": "kannala_brandt4", "nominal": nominal}, 300, 12)


def board_at(centre: tuple[float, float, float], degrees: tuple[float, float, float] = (0, 0, 0)) -> Pose:
    R = rotation_matrix(np.deg2rad(np.array(degrees)))
    return Pose(rotation_vector(R), np.array(centre) - R @ station(0).settings.target.centre)


# For each hint a pose that is reached from home by it, so that going home does not help a hint that is wrong.
WAYS = {
    Hint.MOVE_LEFT: board_at((-0.1, 0.0, 0.5)),
    Hint.MOVE_RIGHT: board_at((0.1, 0.0, 0.5)),
    Hint.MOVE_UP: board_at((0.0, -0.06, 0.5)),
    Hint.MOVE_DOWN: board_at((0.0, 0.06, 0.5)),
    Hint.MOVE_CLOSER: board_at((0.0, 0.0, 0.35)),
    Hint.MOVE_AWAY: board_at((0.0, 0.0, 0.7)),
    Hint.TILT_TOP_FORWARD: board_at((0.0, 0.0, 0.5), (30.0, 0.0, 0.0)),
    Hint.TILT_TOP_BACK: board_at((0.0, 0.0, 0.5), (-30.0, 0.0, 0.0)),
    Hint.TURN_LEFT_BACK: board_at((0.0, 0.0, 0.5), (0.0, 30.0, 0.0)),
    Hint.TURN_RIGHT_BACK: board_at((0.0, 0.0, 0.5), (0.0, -30.0, 0.0)),
    Hint.ROTATE_CLOCKWISE: board_at((0.0, 0.0, 0.5), (0.0, 0.0, 30.0)),
    Hint.ROTATE_COUNTERCLOCKWISE: board_at((0.0, 0.0, 0.5), (0.0, 0.0, -30.0)),
}


def guide(
    pose: Pose,
    display: Display = as_told,
    habits: Habits = CALM,
    start: Pose | None = None,
    longest_s: float = SHORTLY_S,
) -> GuidedRun:
    settings = station(0).settings
    hand = Hand(settings.target, start, habits)
    rng = np.random.default_rng(1)
    return guide_hand((pose,), hand, settings, rng, longest_s=longest_s, frames_per_s=15.0, display=display)


@pytest.mark.parametrize("index", [0, 1])
@pytest.mark.parametrize("pose", [0, 11])
def test_the_hand_reaches_planned_poses_from_random_starts(index: int, pose: int) -> None:
    start = random_starts(station(index), 12, seed=5)[pose]
    assert attempt(reaching(station(index), station(index).poses[pose], start, seed=pose)).complete


@pytest.mark.parametrize("pose", [0, 5, 11])
def test_the_hand_reaches_what_is_planned_for_an_all_round_fisheye(pose: int) -> None:
    fisheye = fisheye_station()
    start = random_starts(station(1), 12, seed=6)[pose]
    assert attempt(reaching(fisheye, fisheye.poses[pose], start, seed=pose)).complete


@pytest.mark.parametrize("hint", WAYS)
def test_each_hint_leads_to_its_pose_and_turned_round_it_does_not(hint: Hint) -> None:
    right = guide(WAYS[hint])
    assert right.complete
    assert hint in right.told
    wrong = guide(WAYS[hint], lambda told: OPPOSITE[hint] if told == hint else told)
    # A board that is rotated the wrong way long enough gets round; that it had to is the failure.
    assert not wrong.complete or Hint.TURN_UPSIDE_DOWN in wrong.told


@pytest.mark.parametrize("hint", [Hint.MOVE_LEFT, Hint.TURN_RIGHT_BACK])
def test_before_a_mirroring_display_the_hand_gets_there_just_as_well(hint: Hint) -> None:
    before_mirror = Habits(lapses_per_s=0.0, mirrored=True)
    mirrored = guide(WAYS[hint], mirror_hint, before_mirror)
    assert mirrored.complete
    assert mirrored.captured_at_s[0] == pytest.approx(guide(WAYS[hint]).captured_at_s[0], abs=0.5)
    words_only = guide(WAYS[hint], mirror_hint)
    assert not words_only.complete or Hint.TURN_UPSIDE_DOWN in words_only.told


def test_an_upside_down_board_is_turned_round_and_would_stay_so_without_the_hint() -> None:
    pose = WAYS[Hint.MOVE_RIGHT]
    start = upside_down(pose, station(0).settings.target)
    assert guide(pose, start=start).complete
    hidden = guide(pose, lambda told: Hint.HOLD if told == Hint.TURN_UPSIDE_DOWN else told, start=start)
    assert not hidden.complete


def test_a_board_outside_the_picture_is_shown_again() -> None:
    lost = guide(WAYS[Hint.MOVE_UP], start=board_at((0.6, 0.4, 0.5)), longest_s=20.0)
    assert lost.complete
    assert Hint.SHOW_BOARD in lost.told


def test_the_hand_reacts_late_and_overshoots() -> None:
    hand, rng = (
        Hand(station(0).settings.target, habits=Habits(lapses_per_s=0.0, tremor_m=0.0, tremor_rad=0.0)),
        np.random.default_rng(0),
    )
    right = (ShownHint(Hint.MOVE_RIGHT, 1.0),)
    start = hand.pose.tvec[0]
    places = [hand.step(right, 0.05, rng).tvec[0] - start for _ in range(10)]
    assert max(places[:4]) == pytest.approx(0.0, abs=1e-12)
    assert places[-1] > 0.01
    stopped = [hand.step((), 0.05, rng).tvec[0] - start for _ in range(20)]
    assert stopped[-1] > places[-1] + 0.02
    assert stopped[-1] == pytest.approx(stopped[-5], abs=1e-3)


def test_a_hand_that_trembles_stays_where_it_is_within_a_few_millimetres() -> None:
    hand, rng = Hand(station(0).settings.target, habits=CALM), np.random.default_rng(0)
    places = np.array([hand.step((), 0.05, rng).tvec for _ in range(200)])
    assert 0.0001 < places.std(axis=0).max() < 0.002


def test_a_hand_lapses_now_and_then() -> None:
    hand = Hand(station(0).settings.target, habits=Habits(lapses_per_s=5.0))
    rng = np.random.default_rng(0)
    depths = [hand.step((), 0.05, rng).tvec[1] for _ in range(40)]
    assert max(depths) > 0.3
