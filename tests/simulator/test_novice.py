from dataclasses import replace

import numpy as np

from service.core.vision.transforms import angle_between
from service.simulator.novice import (
    Choice,
    FreeHand,
    choose_view,
    draw_novice,
    is_shown_whole,
    pose_of_choice,
    think_of_view,
)
from service.simulator.operator import Habits, Hand
from tests.simulator.cameras import BOARD, LENS_1, LENS_2, centred_pose

CALM = Habits(tremor_m=0.0, tremor_rad=0.0, lapses_per_s=0.0)


def test_the_same_seed_is_the_same_person_and_another_is_somebody_else() -> None:
    first, again, other = (draw_novice(np.random.default_rng(seed)) for seed in (1, 1, 2))
    assert first == again
    assert first.habits != other.habits
    assert first.style != other.style


def test_a_choice_is_shown_where_and_as_large_as_it_was_thought_of() -> None:
    choice = Choice(np.array([0.2, -0.1]), 0.3, np.zeros(3))
    pose = pose_of_choice(choice, LENS_1, BOARD)
    assert is_shown_whole(LENS_1, BOARD, pose)
    centre = pose.rotation @ BOARD.centre + pose.tvec
    assert abs(8 * BOARD.square_m * LENS_1.vector[0] / np.linalg.norm(centre) / 1280 - 0.3) < 1e-9
    assert centre[0] > 0 > centre[1]


def test_a_board_that_leaves_the_picture_is_not_shown_whole() -> None:
    assert not is_shown_whole(LENS_1, BOARD, centred_pose(BOARD, (0.0, 0.0, 0.0), (0.2, 0.0, 0.5)))


def test_every_view_that_comes_to_mind_is_shown_whole() -> None:
    for camera in (LENS_1, LENS_2):
        rng = np.random.default_rng(4)
        style, last = draw_novice(rng).style, None
        for _ in range(30):
            last = think_of_view(style, last, camera, BOARD, rng)
            assert is_shown_whole(camera, BOARD, pose_of_choice(last, camera, BOARD))


def test_who_repeats_always_hardly_changes_the_view_and_who_never_does_changes_it() -> None:
    style = draw_novice(np.random.default_rng(5)).style
    changes = {}
    for repeats in (0.0, 1.0):
        rng = np.random.default_rng(6)
        last = choose_view(style, None, rng)
        views = [choose_view(replace(style, repeats=repeats), last, rng) for _ in range(100)]
        changes[repeats] = np.mean([np.linalg.norm(view.turns - last.turns) for view in views])
    assert changes[1.0] < 0.3 * changes[0.0]


def test_a_free_hand_takes_the_board_where_its_owner_wants_it() -> None:
    hand, rng = FreeHand(BOARD, None, CALM), np.random.default_rng(7)
    wish = centred_pose(BOARD, (25.0, -30.0, 10.0), (0.08, -0.05, 0.4))
    hand.aim_at(wish)
    arrived = [hand.has_arrived]
    for _ in range(60):
        hand.step((), 1.0 / 15.0, rng)
        arrived.append(hand.has_arrived)
    assert (arrived[0], arrived[-1]) == (False, True)
    reached = hand.pose
    assert angle_between(reached.rotation, wish.rotation) < 0.005
    np.testing.assert_allclose(reached.tvec, wish.tvec, atol=0.002)


def test_a_free_hand_trembles_as_the_guided_one() -> None:
    habits = replace(CALM, tremor_m=0.001, tremor_rad=0.004)
    still = []
    for hand in (Hand(BOARD, None, habits), FreeHand(BOARD, None, habits)):
        rng = np.random.default_rng(8)
        still.append(np.array([hand.step((), 1.0 / 15.0, rng).tvec for _ in range(3000)]))
    np.testing.assert_allclose(still[1].std(axis=0), still[0].std(axis=0), rtol=0.15)
