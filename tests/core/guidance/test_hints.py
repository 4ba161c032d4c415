from dataclasses import replace

import numpy as np
import pytest

from service.core.guidance.comparison import PoseDifference, default_tolerances
from service.core.guidance.hints import (
    AMOUNTS,
    DIRECTIONS,
    FAR_RAD,
    Hint,
    ShownHint,
    choose_hints,
    coarse_amount,
    mirror_hint,
    show_hints,
)

TOLERANCES = default_tolerances((1280, 800))
M_PER_PX = 0.6 / 1350.0
FIELDS = ("right_px", "down_px", "closer_share", "tilt_rad", "turn_rad", "roll_rad")


def difference(**errors: float) -> PoseDifference:
    right, down, closer, tilt, turn, roll = (errors.get(name, 0.0) for name in FIELDS)
    none = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    corner_px = errors.get("corner_px", 100.0)
    ways = (abs(right * M_PER_PX), abs(down * M_PER_PX), abs(0.6 * closer), abs(tilt), abs(turn), abs(roll))
    return PoseDifference(right, down, closer, tilt, turn, roll, corner_px, False, none, ways=ways)


@pytest.mark.parametrize(
    ("error", "hint"),
    [
        ({"right_px": 90.0}, Hint.MOVE_RIGHT),
        ({"right_px": -90.0}, Hint.MOVE_LEFT),
        ({"down_px": 90.0}, Hint.MOVE_DOWN),
        ({"down_px": -90.0}, Hint.MOVE_UP),
        ({"closer_share": 0.3}, Hint.MOVE_CLOSER),
        ({"closer_share": -0.3}, Hint.MOVE_AWAY),
        ({"tilt_rad": 0.5}, Hint.TILT_TOP_FORWARD),
        ({"tilt_rad": -0.5}, Hint.TILT_TOP_BACK),
        ({"turn_rad": 0.5}, Hint.TURN_LEFT_BACK),
        ({"turn_rad": -0.5}, Hint.TURN_RIGHT_BACK),
        ({"roll_rad": 0.5}, Hint.ROTATE_CLOCKWISE),
        ({"roll_rad": -0.5}, Hint.ROTATE_COUNTERCLOCKWISE),
    ],
)
def test_each_error_has_its_hint(error: dict[str, float], hint: Hint) -> None:
    assert choose_hints(difference(**error), TOLERANCES, ()) == (hint,)


def test_the_longest_way_comes_first_and_two_are_named() -> None:
    many = difference(right_px=60.0, tilt_rad=np.deg2rad(35.0), closer_share=0.2)
    assert choose_hints(many, TOLERANCES, ()) == (Hint.MOVE_CLOSER, Hint.TILT_TOP_FORWARD)


def test_a_slanting_shift_is_one_instruction_of_two_hints() -> None:
    slanting = difference(right_px=300.0, down_px=-60.0, tilt_rad=0.3, roll_rad=0.2)
    shifts = (Hint.MOVE_RIGHT, Hint.MOVE_UP)
    assert choose_hints(slanting, TOLERANCES, ()) == (*shifts, Hint.TILT_TOP_FORWARD)
    turned = difference(right_px=50.0, down_px=-60.0, tilt_rad=0.9, roll_rad=0.2)
    assert choose_hints(turned, TOLERANCES, ()) == (Hint.TILT_TOP_FORWARD, Hint.ROTATE_CLOCKWISE)
    previous = (Hint.TILT_TOP_FORWARD, Hint.MOVE_RIGHT)
    assert choose_hints(turned, TOLERANCES, previous) == (*previous, Hint.MOVE_UP)


def test_a_shift_that_would_lead_out_is_not_added_to_the_other() -> None:
    slanting = difference(right_px=300.0, down_px=-60.0, tilt_rad=0.3)
    no_way_up = replace(slanting, together_lead_out=frozenset({(0, 1), (0, 1, 3), (1, 3)}))
    assert choose_hints(no_way_up, TOLERANCES, ()) == (Hint.MOVE_RIGHT, Hint.TILT_TOP_FORWARD)
    not_all = replace(slanting, together_lead_out=frozenset({(0, 1, 3)}))
    assert choose_hints(not_all, TOLERANCES, ()) == (Hint.MOVE_RIGHT, Hint.TILT_TOP_FORWARD)


def test_a_hint_is_kept_until_its_error_is_within_the_tolerance() -> None:
    previous = (Hint.MOVE_RIGHT,)
    many = difference(right_px=40.0, tilt_rad=np.deg2rad(35.0))
    assert choose_hints(many, TOLERANCES, previous)[0] == Hint.MOVE_RIGHT
    assert choose_hints(replace(many, right_px=25.0), TOLERANCES, previous)[0] == Hint.MOVE_RIGHT
    assert choose_hints(replace(many, right_px=20.0), TOLERANCES, previous) == (Hint.TILT_TOP_FORWARD,)
    assert choose_hints(replace(many, right_px=25.0), TOLERANCES, ()) == (Hint.TILT_TOP_FORWARD,)


def test_a_hint_that_went_too_far_is_not_kept_but_turned_round() -> None:
    assert choose_hints(difference(right_px=-40.0), TOLERANCES, (Hint.MOVE_RIGHT,)) == (Hint.MOVE_LEFT,)


def test_a_match_needs_no_movement_and_an_upside_down_board_only_one() -> None:
    assert choose_hints(difference(corner_px=5.0), TOLERANCES, (Hint.MOVE_LEFT,)) == ()
    upside_down = replace(difference(right_px=200.0, roll_rad=3.1), is_upside_down=True)
    assert choose_hints(upside_down, TOLERANCES, (Hint.MOVE_RIGHT,)) == (Hint.TURN_UPSIDE_DOWN,)


def test_small_errors_that_add_up_are_still_named() -> None:
    small = difference(right_px=20.0, down_px=-22.0, corner_px=30.0)
    assert choose_hints(small, TOLERANCES, ()) == (Hint.MOVE_UP,)


def test_an_error_counts_by_what_it_does_to_the_corners_where_that_is_more() -> None:
    near = replace(
        difference(roll_rad=np.deg2rad(3.0), right_px=35.0), effects_px=(0.0, 0.0, 0.0, 0.0, 0.0, 40.0)
    )
    assert choose_hints(near, TOLERANCES, ()) == (Hint.MOVE_RIGHT, Hint.ROTATE_CLOCKWISE)
    far = replace(near, effects_px=(0.0,) * 6)
    assert choose_hints(far, TOLERANCES, ()) == (Hint.MOVE_RIGHT,)


def test_what_would_take_the_board_out_of_the_picture_waits() -> None:
    far = difference(right_px=-500.0, roll_rad=0.3)
    blocked = replace(far, leads_out=(True, False, False, False, False, False))
    assert choose_hints(far, TOLERANCES, ()) == (Hint.MOVE_LEFT, Hint.ROTATE_CLOCKWISE)
    assert choose_hints(blocked, TOLERANCES, ()) == (Hint.ROTATE_CLOCKWISE, Hint.MOVE_LEFT)
    apart = replace(blocked, together_lead_out=frozenset({(0, 5)}))
    assert choose_hints(apart, TOLERANCES, ()) == (Hint.ROTATE_CLOCKWISE,)
    stuck = replace(difference(right_px=-500.0), leads_out=blocked.leads_out)
    assert choose_hints(stuck, TOLERANCES, ()) == (Hint.MOVE_LEFT,)


def test_two_are_named_together_only_if_the_board_stays_in_the_picture_then() -> None:
    far = replace(
        difference(right_px=-500.0, roll_rad=0.6, tilt_rad=0.3), together_lead_out=frozenset({(0, 5)})
    )
    assert choose_hints(far, TOLERANCES, ()) == (Hint.MOVE_LEFT, Hint.TILT_TOP_FORWARD)
    alone = replace(far, together_lead_out=frozenset({(0, 5), (0, 3)}))
    assert choose_hints(alone, TOLERANCES, ()) == (Hint.MOVE_LEFT,)


def test_two_that_are_safe_only_together_are_named_together() -> None:
    far = difference(right_px=-500.0, roll_rad=0.6, tilt_rad=0.3)
    none_alone = replace(far, leads_out=(True,) * 6, half_leads_out=(True, False, True, True, True, False))
    others = replace(none_alone, together_lead_out=frozenset({(0, 3), (0, 5)}))
    assert choose_hints(others, TOLERANCES, ()) == (Hint.ROTATE_CLOCKWISE, Hint.TILT_TOP_FORWARD)
    none_together = replace(none_alone, together_lead_out=frozenset({(0, 3), (0, 5), (3, 5)}))
    assert choose_hints(none_together, TOLERANCES, ()) == (Hint.ROTATE_CLOCKWISE,)


def test_an_error_within_its_tolerance_is_mended_where_it_takes_the_room_of_a_wanted_one() -> None:
    up = difference(down_px=-60.0, turn_rad=0.9 * TOLERANCES.turn_rad, tilt_rad=-0.2 * TOLERANCES.tilt_rad)
    assert choose_hints(up, TOLERANCES, ()) == (Hint.MOVE_UP,)
    at_the_border = replace(up, leads_out=(False, True, False, False, False, False))
    assert choose_hints(at_the_border, TOLERANCES, ()) == (Hint.TURN_LEFT_BACK, Hint.MOVE_UP)
    not_together = replace(at_the_border, together_lead_out=frozenset({(1, 4)}))
    assert choose_hints(not_together, TOLERANCES, ()) == (Hint.TURN_LEFT_BACK,)
    nothing_helps = replace(not_together, leads_out=(False, True, False, False, True, False))
    assert choose_hints(nothing_helps, TOLERANCES, ()) == (Hint.MOVE_UP,)


def test_a_lone_movement_that_leads_out_has_half_its_way_before_it() -> None:
    out = replace(difference(), ways=(0.25, 0.0, 0.0, 0.0, 0.0, FAR_RAD), leads_out=(True,) * 6)
    assert show_hints((Hint.MOVE_RIGHT,), out) == (ShownHint(Hint.MOVE_RIGHT, 0.6),)
    both = show_hints((Hint.MOVE_RIGHT, Hint.ROTATE_CLOCKWISE), out)
    assert [hint.amount for hint in both] == [1.0, 1.0]
    inside = replace(out, leads_out=(False,) * 6)
    assert show_hints((Hint.MOVE_RIGHT,), inside)[0].amount == 1.0


def test_the_amount_is_coarse_and_falls_on_the_way() -> None:
    ways = (0.5, 0.1, 0.03, 0.001)
    amounts = [
        coarse_amount(Hint.MOVE_RIGHT, replace(difference(), ways=(way, 0, 0, 0, 0, 0))) for way in ways
    ]
    assert amounts == [1.0, 0.4, 0.1, 0.02]
    assert set(amounts) <= set(AMOUNTS)
    assert coarse_amount(Hint.HOLD, difference()) == 1.0


def test_a_turn_is_measured_against_what_is_far_for_a_turn() -> None:
    half = replace(difference(), ways=(0.0, 0.0, 0.0, 0.0, 0.0, 0.6 * FAR_RAD))
    assert coarse_amount(Hint.ROTATE_CLOCKWISE, half) == 0.6
    assert coarse_amount(Hint.MOVE_DOWN, half) == AMOUNTS[0]


def test_a_mirror_swaps_left_and_right_and_the_sense_of_rotation_and_nothing_else() -> None:
    swapped = {hint for hint in Hint if mirror_hint(hint) != hint}
    assert swapped == {*DIRECTIONS[0], *DIRECTIONS[4], *DIRECTIONS[5]}
    assert all(mirror_hint(mirror_hint(hint)) == hint for hint in Hint)
