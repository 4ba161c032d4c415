"""Poses beyond the set: for more accuracy, or in place of one out of reach; and when a run may end."""

from dataclasses import replace

import pytest

from service.core.guidance.actions import (
    Action,
    AddedFor,
    AddedPose,
    AddPose,
    CaptureAccepted,
    CapturesJudged,
    Effect,
    NoPoseToAdd,
    PoseNotReached,
    PoseWanted,
    RunComplete,
    TakeAnother,
)
from service.core.guidance.session import step
from service.core.guidance.session_poses import start_session
from service.core.guidance.session_state import SessionState
from service.core.guidance.session_view import view
from tests.core.guidance.test_session import POSES, SETTINGS, play
from tests.core.guidance.test_session_help import elsewhere

ALL = range(len(POSES))
MORE = AddedPose(POSES[1], AddedFor.ACCURACY)
LACKING = CapturesJudged(lacks=AddedFor.ACCURACY)


def apply(state: SessionState, *actions: Action) -> tuple[SessionState, tuple[Effect, ...]]:
    """The state after some actions, and what the last of them asks for."""
    effects: tuple[Effect, ...] = ()
    for action in actions:
        state, effects = step(state, action, SETTINGS)
    return state, effects


def in_place_of(pose_index: int, reason: AddedFor = AddedFor.OUT_OF_REACH) -> AddPose:
    return AddPose(AddedPose(POSES[1], reason, pose_index))


def despaired(state: SessionState) -> tuple[Effect, ...]:
    """What 21 s of trying lead to."""
    return tuple(play(state, elsewhere(0.0, 21.0))[1])


def test_a_run_that_lacks_accuracy_gets_poses_up_to_its_number_and_then_ends() -> None:
    state = start_session(POSES, ALL)
    for added in range(SETTINGS.most_added):
        state, effects = apply(state, LACKING)
        assert effects == (PoseWanted(AddedFor.ACCURACY),)
        state, _ = apply(state, AddPose(MORE))
        assert state.current == len(POSES) + added
        state, _ = apply(state, CaptureAccepted(len(POSES) + added))

    state, effects = apply(state, LACKING)

    assert (state.current, effects) == (None, (RunComplete(),))
    assert (view(state, SETTINGS).captured, view(state, SETTINGS).total) == (5, 5)


def test_a_run_without_extra_poses_ends_whatever_it_lacks() -> None:
    strict = replace(SETTINGS, most_added=0)
    assert step(start_session(POSES, ALL), LACKING, strict)[1] == (RunComplete(),)


def test_where_no_pose_can_be_added_the_run_ends() -> None:
    assert apply(start_session(POSES, ALL), LACKING, NoPoseToAdd())[1] == (RunComplete(),)
    open_run = start_session(POSES, (0,))
    assert apply(open_run, NoPoseToAdd()) == (open_run, ())


def test_a_weak_capture_gives_way_to_a_pose_in_its_place() -> None:
    state, effects = apply(start_session(POSES, ALL), CapturesJudged(lacks=AddedFor.WEAK_CAPTURE, weak=1))
    assert effects == (PoseWanted(AddedFor.WEAK_CAPTURE, 1),)

    state, _ = apply(state, in_place_of(1, AddedFor.WEAK_CAPTURE))

    assert (state.current, state.instead_of, state.order, state.open) == (3, 1, (0, 2), (3,))
    assert (len(state.captured), state.total) == (2, 3)
    assert apply(state, CaptureAccepted(3), CapturesJudged())[1] == (RunComplete(),)


def test_a_run_may_end_early_only_where_that_is_enough() -> None:
    state = start_session(POSES, (0,))
    assert apply(state, CapturesJudged()) == (state, ())
    assert apply(state, LACKING) == (state, ())

    ended, effects = apply(state, CapturesJudged(is_enough=True))

    assert (ended.current, effects) == (None, (RunComplete(),))


def test_the_last_open_pose_is_replaced_when_it_is_not_reached() -> None:
    state = start_session(POSES, (1, 2))
    (wanted,) = despaired(state)
    assert isinstance(wanted, PoseWanted)
    assert (wanted.reason, wanted.replaces) == (AddedFor.OUT_OF_REACH, 0)
    assert wanted.tried_s == pytest.approx(20.0, abs=0.2)


def test_a_pose_that_is_tried_again_in_vain_is_replaced_and_a_fresh_one_only_put_off() -> None:
    fresh = start_session(POSES)
    again, _ = apply(fresh, TakeAnother(1), TakeAnother(0))
    assert [type(effect) for effect in despaired(fresh)] == [PoseNotReached]
    assert [type(effect) for effect in despaired(again)] == [PoseWanted]


def test_a_replaced_pose_is_not_asked_for_any_more() -> None:
    state, _ = apply(start_session(POSES, (1, 2)), in_place_of(0))
    assert (state.current, state.open, state.instead_of, state.total) == (3, (3,), 0, 3)
    assert apply(state, CaptureAccepted(3), CapturesJudged())[1] == (RunComplete(),)


def test_poses_are_replaced_up_to_their_number_and_then_tried_on() -> None:
    state, _ = apply(start_session(POSES, (1, 2)), in_place_of(0), in_place_of(3))
    assert (state.current, state.open) == (4, (4,))
    assert despaired(state) == ()


def test_an_extra_pose_out_of_reach_does_not_hold_the_run_up() -> None:
    state, _ = apply(start_session(POSES, ALL), LACKING, AddPose(MORE), in_place_of(3), in_place_of(4))
    assert state.is_optional(5)
    assert not state.is_optional(0)
    assert despaired(state) == (RunComplete(),)


def test_a_resumed_session_asks_for_the_added_pose_first() -> None:
    added = [MORE, AddedPose(POSES[2], AddedFor.OUT_OF_REACH, 0)]
    state = start_session(POSES, (1,), added=added)
    assert (state.current, state.open, state.total) == (4, (2, 3, 4), 4)
    assert start_session(POSES, (1, 3, 4), added=added).current == 2
