from dataclasses import replace

import numpy as np
import pytest

from service.core.guidance.actions import (
    CaptureAccepted,
    CaptureFrame,
    CaptureRefused,
    CapturesJudged,
    DiscardCapture,
    Effect,
    Frame,
    ManualCapture,
    Retake,
    RunComplete,
    SetAutomatic,
    Undo,
)
from service.core.guidance.comparison import default_tolerances, reseat
from service.core.guidance.hints import Hint
from service.core.guidance.observation import Observation
from service.core.guidance.session import step
from service.core.guidance.session_poses import start_session
from service.core.guidance.session_state import GuidanceSettings, SessionState
from service.core.guidance.session_view import view
from service.core.vision.camera import Intrinsics, project
from service.core.vision.pose import estimate_pose
from service.core.vision.target_chessboard import Chessboard
from service.core.vision.transforms import Pose, rotation_matrix, rotation_vector
from tests.core.vision.cameras import WIDE

TARGET = Chessboard(9, 6, 0.025)
CAMERA = Intrinsics.from_parameters(
    "pinhole5", {"fx": 1350.0, "fy": 1352.0, "cx": 650.0, "cy": 390.0}, (1280, 800)
)
SETTINGS = GuidanceSettings(CAMERA, TARGET, default_tolerances((1280, 800)))
POSES = tuple(Pose(np.zeros(3), np.array([x, 0.0, 0.6]) - TARGET.centre) for x in (-0.1, 0.0, 0.1))


def frame(pose: Pose, at_s: float, *, edge_px: float = 1.5, brightness: float = 180.0) -> Observation:
    points = project(CAMERA, pose.rotation, pose.tvec, TARGET.object_points)
    number = round(at_s * 100)
    return Observation(at_s, "present", len(points), pose, points, edge_px, brightness, number)


def play(state: SessionState, frames: list[Observation]) -> tuple[SessionState, list[Effect]]:
    effects: list[Effect] = []
    for observation in frames:
        state, new = step(state, Frame(observation), SETTINGS)
        effects += new
    return state, effects


def held(pose: Pose, since_s: float, count: int = 15, **looks: float) -> list[Observation]:
    return [frame(pose, since_s + 0.05 * i, **looks) for i in range(count)]


def hints(state: SessionState) -> tuple[Hint, ...]:
    return tuple(hint.code for hint in view(state, SETTINGS).hints)


def test_a_board_that_is_held_in_the_pose_is_captured_once() -> None:
    state, effects = play(start_session(POSES), held(POSES[0], 0.0, 40))
    assert len(effects) == 1
    assert isinstance(effects[0], CaptureFrame)
    assert effects[0].pose_index == 0
    assert state.pending == 0
    assert hints(state) == (Hint.HOLD,)


def test_nothing_is_captured_before_the_dwell_is_over() -> None:
    state, effects = play(start_session(POSES), held(POSES[0], 0.0, 10))
    assert effects == []
    assert 0.5 < view(state, SETTINGS).dwell < 1.0


def test_the_sharpest_frame_of_the_dwell_is_captured() -> None:
    frames = held(POSES[0], 0.0)
    frames[6] = replace(frames[6], edge_width_px=1.1)
    _, effects = play(start_session(POSES), frames)
    assert effects == [CaptureFrame(0, frames[6].sequence)]


@pytest.mark.parametrize(
    ("looks", "hint"),
    [
        ({"edge_px": 9.0}, Hint.HOLD_STILL),
        ({"brightness": 20.0}, Hint.MORE_LIGHT),
        ({"brightness": 254.0}, Hint.LESS_LIGHT),
    ],
)
def test_a_frame_that_is_blurred_or_badly_lit_is_not_captured(looks: dict[str, float], hint: Hint) -> None:
    state, effects = play(start_session(POSES), held(POSES[0], 0.0, 40, **looks))
    assert effects == []
    assert hints(state) == (hint,)


def test_a_moving_board_is_not_captured_although_every_frame_matches() -> None:
    shifts = 0.004 * np.sin(np.arange(40))
    frames = [
        frame(Pose(POSES[0].rvec, POSES[0].tvec + np.array([shift, 0.0, 0.0])), 0.05 * i)
        for i, shift in enumerate(shifts)
    ]
    state, effects = play(start_session(POSES), frames)
    assert effects == []
    assert view(state, SETTINGS).match == 1.0
    assert hints(state) == (Hint.HOLD_STILL,)


def test_one_bad_frame_starts_the_dwell_anew() -> None:
    frames = held(POSES[0], 0.0, 20)
    frames[9] = Observation(frames[9].at_s, "partial", 30)
    assert play(start_session(POSES), frames)[1] == []


def test_two_frames_in_a_second_are_enough_for_a_capture() -> None:
    effects = play(start_session(POSES), [frame(POSES[0], 0.5 * i) for i in range(3)])[1]
    assert [type(effect) for effect in effects] == [CaptureFrame]


def test_frames_that_come_too_rarely_prove_no_stillness() -> None:
    assert play(start_session(POSES), [frame(POSES[0], 1.5 * i) for i in range(10)])[1] == []


def test_another_pose_is_not_captured_and_the_way_is_told() -> None:
    state, effects = play(start_session(POSES), held(POSES[1], 0.0, 30))
    assert effects == []
    assert hints(state) == (Hint.MOVE_LEFT,)
    assert view(state, SETTINGS).match < 1.0


@pytest.mark.parametrize(
    ("kind", "hint"),
    [("absent", Hint.SHOW_BOARD), ("partial", Hint.SHOW_WHOLE_BOARD), ("wrong", Hint.WRONG_BOARD)],
)
def test_a_board_that_cannot_be_compared_has_its_hint(kind: str, hint: Hint) -> None:
    state, _ = play(start_session(POSES), [Observation(0.0, kind)])  # type: ignore[arg-type]
    assert hints(state) == (hint,)
    assert view(state, SETTINGS).difference is None


def test_accepted_captures_lead_to_the_next_pose_and_all_of_them_complete_the_run() -> None:
    state = start_session(POSES)
    completions: list[tuple[Effect, ...]] = []
    for index in range(3):
        assert state.current == index
        state, effects = play(state, held(POSES[index], 10.0 * index))
        assert len(effects) == 1
        state, none = step(state, CaptureAccepted(index), SETTINGS)
        assert none == ()
        state, then = step(state, CapturesJudged(), SETTINGS)
        completions.append(then)
    assert completions == [(), (), (RunComplete(),)]
    assert state.current is None
    assert view(state, SETTINGS).ghost is None
    assert view(state, SETTINGS).captured == 3


def test_an_acceptance_that_comes_twice_changes_nothing() -> None:
    state, _ = step(start_session(POSES), CaptureAccepted(0), SETTINGS)
    again, effects = step(state, CaptureAccepted(0), SETTINGS)
    assert (again, effects) == (state, ())


def test_a_refused_capture_is_asked_for_again_with_its_reason() -> None:
    state, _ = play(start_session(POSES), held(POSES[0], 0.0))
    state, _ = step(state, CaptureRefused(0, "too-blurred"), SETTINGS)
    assert (state.current, state.pending) == (0, None)
    assert view(state, SETTINGS).refused == "too-blurred"
    _, effects = play(state, held(POSES[0], 5.0))
    assert len(effects) == 1


def test_a_resumed_session_goes_on_with_the_first_open_pose() -> None:
    assert start_session(POSES, [0, 2]).current == 1
    assert start_session(POSES, [0, 1, 2]).current is None


def test_undo_takes_back_the_latest_and_retake_any_and_the_run_then_goes_on() -> None:
    state = start_session(POSES, [0, 1])
    undone, effects = step(state, Undo(), SETTINGS)
    assert (undone.current, effects) == (1, (DiscardCapture(1),))
    retaken, effects = step(state, Retake(0), SETTINGS)
    assert (retaken.current, effects) == (0, (DiscardCapture(0),))
    assert step(retaken, CaptureAccepted(0), SETTINGS)[0].current == 2
    assert step(start_session(POSES), Undo(), SETTINGS) == (start_session(POSES), ())


def test_by_hand_only_a_matching_frame_is_captured_without_a_dwell() -> None:
    state, _ = step(start_session(POSES), SetAutomatic(False), SETTINGS)
    state, effects = play(state, held(POSES[0], 0.0, 40))
    assert effects == []
    asked, now = step(state, ManualCapture(2.0), SETTINGS)
    assert now == (CaptureFrame(0, 195, is_manual=True),)
    assert step(asked, ManualCapture(2.1), SETTINGS)[1] == ()
    elsewhere, _ = play(state, held(POSES[2], 5.0, 2))
    refused, none = step(elsewhere, ManualCapture(5.2), SETTINGS)
    assert none == ()
    assert view(refused, SETTINGS).refused == "not-matched"


@pytest.mark.parametrize("growth", [0.8, 1.2])
def test_a_wrong_nominal_asks_for_the_pose_that_fills_the_planned_place(growth: float) -> None:
    vector = WIDE.vector
    vector[:2] *= growth
    nominal = Intrinsics.from_vector(WIDE.lens, vector, WIDE.image_size)
    settings = GuidanceSettings(nominal, TARGET, default_tolerances(WIDE.image_size))
    tilt = rotation_matrix(np.array([0.4, -0.3, 0.1]))
    planned = Pose(rotation_vector(tilt), np.array([-0.12, -0.06, 0.3]) - tilt @ TARGET.centre)
    held_so, told = reseat(planned, nominal, WIDE, TARGET)
    state, effects = start_session((planned,)), list[Effect]()
    pixels = project(WIDE, held_so.rotation, held_so.tvec, TARGET.object_points)
    for i in range(30):
        found = estimate_pose(nominal, TARGET.object_points, pixels)
        assert found.freed is not None
        seen, camera = found.freed
        now = Observation(0.05 * i, "present", 54, seen, pixels, 1.5, 180.0, i, camera=camera)
        state, new = step(state, Frame(now), settings)
        effects += new
    assert any(isinstance(effect, CaptureFrame) for effect in effects)
    assert state.difference is not None
    # What the paper asks of a capture is asked of the place in the picture, whatever camera it is.
    outer = pixels[list(TARGET.outer_corners)]
    assert state.difference.corner_px == pytest.approx(np.linalg.norm(outer - told, axis=1).mean(), abs=1.5)
    assert np.degrees(abs(state.difference.tilt_rad)) < 1.0
