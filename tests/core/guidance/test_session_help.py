"""How a session helps on: another pose first, light that hides the board, nobody there, forced captures."""

from dataclasses import replace

import pytest

from service.core.guidance.actions import (
    CaptureAccepted,
    CaptureFrame,
    Effect,
    ManualCapture,
    PoseNotReached,
    Retake,
    SetAutomatic,
    TakeAnother,
)
from service.core.guidance.hints import Hint
from service.core.guidance.observation import Observation
from service.core.guidance.session import step
from service.core.guidance.session_poses import start_session
from service.core.guidance.session_state import SessionState
from service.core.guidance.session_view import view
from tests.core.guidance.test_session import POSES, SETTINGS, frame, held, hints, play


def away(since_s: float, seconds: float, brightness: float = 90.0) -> list[Observation]:
    """Frames without a board."""
    return [
        Observation(since_s + 0.1 * i, "absent", brightness=brightness) for i in range(round(10 * seconds))
    ]


def elsewhere(since_s: float, seconds: float) -> list[Observation]:
    """Frames of a board that is held beside the first pose."""
    return [frame(POSES[2], since_s + 0.1 * i) for i in range(round(10 * seconds))]


def not_reached(effects: list[Effect]) -> list[int]:
    return [effect.pose_index for effect in effects if isinstance(effect, PoseNotReached)]


def after_another(state: SessionState, pose_index: int) -> SessionState:
    return step(state, TakeAnother(pose_index), SETTINGS)[0]


def test_a_pose_that_is_tried_for_long_is_told_once_in_a_patience() -> None:
    state, early = play(start_session(POSES), elsewhere(0.0, 19.0))
    state, late = play(state, elsewhere(19.0, 3.0))
    _, later = play(state, elsewhere(22.0, 15.0))

    assert (early, not_reached(late), later) == ([], [0], [])


def test_time_without_a_board_is_no_trying_and_is_told() -> None:
    state, effects = play(start_session(POSES), away(0.0, 60.0))
    assert effects == []
    assert view(state, SETTINGS).absent_s == pytest.approx(59.9)
    back, _ = play(state, elsewhere(60.0, 1.0))
    assert view(back, SETTINGS).absent_s == 0.0
    assert view(back, SETTINGS).tried_s < 2.0


def test_the_last_open_pose_is_asked_for_however_long_it_takes() -> None:
    assert not_reached(play(start_session(POSES, (1, 2)), elsewhere(0.0, 60.0))[1]) == []


def test_a_board_in_the_pose_is_not_taken_from_it_while_it_is_held_by_hand() -> None:
    manual, _ = step(start_session(POSES), SetAutomatic(False), SETTINGS)
    assert not_reached(play(manual, held(POSES[0], 0.0, 700))[1]) == []


def test_another_pose_comes_first_and_the_postponed_one_after_all_others() -> None:
    state = after_another(start_session(POSES), 2)
    assert (state.current, state.instead_of, state.open) == (2, 0, (1, 2, 0))
    order = []
    while state.current is not None:
        order.append(state.current)
        state, _ = step(state, CaptureAccepted(state.current), SETTINGS)
    assert order == [2, 1, 0]
    assert (state.postponed, state.instead_of) == ((), None)


def test_two_postponed_poses_come_again_in_turn() -> None:
    state = after_another(after_another(start_session(POSES), 1), 2)
    assert (state.current, state.postponed) == (2, (0, 1))
    back = after_another(state, 0)
    assert (back.current, back.postponed) == (0, (0, 1, 2))


def test_a_retaken_pose_is_asked_for_at_once_though_others_wait() -> None:
    state = after_another(start_session(POSES), 2)
    state, _ = step(state, CaptureAccepted(2), SETTINGS)
    retaken, _ = step(state, Retake(2), SETTINGS)
    assert retaken.current == 2
    assert step(retaken, CaptureAccepted(2), SETTINGS)[0].current == 1


@pytest.mark.parametrize("pose_index", [0, 1, 7, -1])
def test_what_is_no_other_open_pose_changes_nothing(pose_index: int) -> None:
    state = start_session(POSES, (1,))
    assert after_another(state, pose_index) == state


def test_nothing_is_postponed_while_its_capture_is_stored() -> None:
    state, _ = play(start_session(POSES), held(POSES[0], 0.0))
    assert state.pending == 0
    assert after_another(state, 1) == state


def test_a_resumed_session_keeps_what_was_postponed() -> None:
    state = start_session(POSES, (1,), postponed=(0, 1))
    assert (state.current, state.postponed) == (2, (0,))


@pytest.mark.parametrize(("brightness", "hint"), [(4.0, Hint.MORE_LIGHT), (252.0, Hint.LESS_LIGHT)])
def test_light_that_hides_the_board_is_told(brightness: float, hint: Hint) -> None:
    assert hints(play(start_session(POSES), away(0.0, 1.0, brightness))[0]) == (hint,)
    assert hints(play(start_session(POSES), away(0.0, 1.0))[0]) == (Hint.SHOW_BOARD,)


def test_glare_is_told_and_not_captured() -> None:
    frames = [replace(one, glare_share=0.4) for one in held(POSES[0], 0.0, 40)]
    state, effects = play(start_session(POSES), frames)
    assert (effects, hints(state)) == ([], (Hint.LESS_LIGHT,))


@pytest.mark.parametrize(
    ("spoilt", "reason"),
    [
        ({"edge_width_px": 9.0}, "blurred"),
        ({"brightness": 20.0}, "too-dark"),
        ({"glare_share": 0.5}, "glare"),
        ({"kind": "wrong", "pose": None, "image_points": None}, "not-seen"),
    ],
)
def test_a_capture_by_hand_meets_the_same_checks_and_can_be_forced_where_there_is_a_board(
    spoilt: dict[str, object], reason: str
) -> None:
    frames = [replace(one, **spoilt) for one in held(POSES[0], 0.0, 5)]  # type: ignore[arg-type]
    state, _ = play(start_session(POSES), frames)

    refused, none = step(state, ManualCapture(1.0), SETTINGS)
    _, forced = step(state, ManualCapture(1.0, is_forced=True), SETTINGS)

    assert (none, refused.refused) == ((), reason)
    shown = frames[-1].sequence
    assert forced == (() if reason == "not-seen" else (CaptureFrame(0, shown, True, (reason,)),))


def test_all_checks_that_were_overridden_are_recorded() -> None:
    state, _ = play(start_session(POSES), [frame(POSES[2], 0.0, brightness=20.0)])
    _, forced = step(state, ManualCapture(1.0, is_forced=True), SETTINGS)
    assert forced == (CaptureFrame(0, 0, True, ("not-matched", "too-dark", "moving")),)


def test_what_meets_the_checks_is_not_recorded_as_forced() -> None:
    state, _ = play(start_session(POSES), held(POSES[0], 0.0, 5))
    _, forced = step(state, ManualCapture(1.0, is_forced=True), SETTINGS)
    assert [effect.overridden for effect in forced if isinstance(effect, CaptureFrame)] == [()]


def test_by_hand_the_sharpest_frame_of_the_last_dwell_time_is_captured() -> None:
    manual, _ = step(start_session(POSES), SetAutomatic(False), SETTINGS)
    frames = held(POSES[0], 0.0, 60)
    frames[4] = replace(frames[4], edge_width_px=1.0)
    frames[55] = replace(frames[55], edge_width_px=1.2)
    state, _ = play(manual, frames)
    assert step(state, ManualCapture(3.0), SETTINGS)[1] == (
        CaptureFrame(0, frames[55].sequence, is_manual=True),
    )
