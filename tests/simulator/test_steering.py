import numpy as np
import pytest

from service.core.guidance.hints import Hint, ShownHint
from service.simulator.steering import SLOWER, SOON_S, Steering

RIGHT, LEFT = (ShownHint(Hint.MOVE_RIGHT, 0.1),), (ShownHint(Hint.MOVE_LEFT, 0.1),)
DT_S = 0.05


def pace(steering: Steering) -> float:
    """How fast the hand goes for a hint to the left now, as a share of what the hint asks for."""
    return float(-steering.paces(LEFT, 1e-6)[0] / LEFT[0].amount)


def wait(steering: Steering, for_s: float) -> None:
    for _ in range(round(for_s / DT_S)):
        steering.paces((), DT_S)


def test_a_hint_that_soon_turns_round_means_too_far() -> None:
    steering = Steering()
    steering.paces(RIGHT, DT_S)
    wait(steering, 0.5 * SOON_S)
    assert pace(steering) == pytest.approx(SLOWER, rel=1e-3)


def test_a_hint_that_turns_round_much_later_belongs_to_another_movement() -> None:
    steering = Steering()
    steering.paces(RIGHT, DT_S)
    wait(steering, 2.0 * SOON_S)
    assert pace(steering) == pytest.approx(1.0)


def test_a_hand_that_lost_the_board_slows_down_what_it_moved_last_even_after_the_hint_has_ended() -> None:
    steering = Steering()
    steering.paces((ShownHint(Hint.TILT_TOP_BACK, 0.1),), DT_S)
    steering.paces(LEFT, DT_S)
    wait(steering, 0.3)
    steering.startle()
    assert pace(steering) == pytest.approx(SLOWER, rel=1e-3)
    assert np.abs(steering.paces((ShownHint(Hint.TILT_TOP_BACK, 0.1),), 1e-6)[3]) == pytest.approx(0.1)


def test_what_was_moved_long_before_the_board_was_lost_is_not_slowed_down() -> None:
    steering = Steering()
    steering.paces(LEFT, DT_S)
    wait(steering, 1.5)
    steering.startle()
    assert pace(steering) == pytest.approx(1.0)
