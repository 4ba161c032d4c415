"""The guidance of one run as a reducer: (state, action) -> (state, effects). No clock, socket or image.

A session is resumed from what is stored: the expected poses and which of them are captured
(`start_session`). Not here: what the state looks like to an operator (`session_view`).
"""

from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from typing import Final

from service.core.guidance.actions import (
    Action,
    CaptureAccepted,
    CaptureFrame,
    CaptureRefused,
    DiscardCapture,
    Effect,
    Frame,
    ManualCapture,
    Retake,
    RunComplete,
    SetAutomatic,
    Undo,
)
from service.core.guidance.auto_capture import (
    CaptureLimits,
    Dwell,
    Obstacle,
    dwell_share,
    extend_dwell,
    find_obstacle,
)
from service.core.guidance.comparison import PoseDifference, Tolerances, compare_pose, is_match
from service.core.guidance.hints import Hint, choose_hints
from service.core.guidance.observation import Observation
from service.core.vision.camera import Intrinsics
from service.core.vision.target import Chessboard
from service.core.vision.transforms import Pose

NOT_MATCHED: Final = "not-matched"

Step = tuple["SessionState", tuple[Effect, ...]]


@dataclass(frozen=True)
class GuidanceSettings:
    """What a session is judged by: the SKU's nominal camera and target, tolerances, limits of a capture."""

    intrinsics: Intrinsics
    target: Chessboard
    tolerances: Tolerances
    limits: CaptureLimits = field(default_factory=CaptureLimits)


@dataclass(frozen=True)
class SessionState:
    """Where a session stands.

    captured: indices of the poses that have a capture; order: the same as they were taken. current: the pose
    that is asked for, None when all are captured. pending: the pose whose capture is being stored. last: the
    latest observation; difference, obstacle: what was made of it, None without a whole board or a pose to
    compare with. moves: the movements that are shown. refused: why the latest capture was refused, until the
    next one is asked for.
    """

    expected: tuple[Pose, ...]
    captured: frozenset[int] = frozenset()
    order: tuple[int, ...] = ()
    current: int | None = 0
    automatic: bool = True
    pending: int | None = None
    last: Observation | None = None
    difference: PoseDifference | None = None
    obstacle: Obstacle | None = None
    moves: tuple[Hint, ...] = ()
    dwell: Dwell | None = None
    refused: str | None = None


def start_session(
    expected: Iterable[Pose], captured: Iterable[int] = (), automatic: bool = True
) -> SessionState:
    """Return the state of a run, new or resumed; captured: pose indices in the order they were taken."""
    poses, order = tuple(expected), tuple(dict.fromkeys(captured))
    done = frozenset(order)
    return SessionState(poses, done, order, _next_pose(len(poses), done, 0), automatic)


def step(state: SessionState, action: Action, settings: GuidanceSettings) -> Step:
    """Return the state after an action and what is to be done about it."""
    result: Step = (state, ())
    match action:
        case Frame(observation):
            result = _see(state, observation, settings)
        case ManualCapture():
            result = _capture_by_hand(state)
        case CaptureAccepted(pose_index):
            result = _accept(state, pose_index)
        case CaptureRefused(pose_index, reason):
            result = _refuse(state, pose_index, reason)
        case Undo() if state.order:
            result = _take_back(state, state.order[-1])
        case Retake(pose_index):
            result = _take_back(state, pose_index)
        case SetAutomatic(automatic):
            result = replace(state, automatic=automatic, dwell=None), ()
    return result


def _see(state: SessionState, now: Observation, settings: GuidanceSettings) -> Step:
    """Judge a frame, and ask for a capture once the dwell is over."""
    judged = _judge(state, now, settings)
    if judged.dwell is None or judged.pending is not None or judged.current is None:
        return judged, ()
    if dwell_share(judged.dwell, settings.limits) < 1.0 or not judged.automatic:
        return judged, ()
    return _ask(judged, judged.current, judged.dwell.sequence)


def _judge(state: SessionState, now: Observation, settings: GuidanceSettings) -> SessionState:
    """Return the state after a frame, without asking for anything."""
    bare = replace(state, last=now, difference=None, obstacle=None, moves=(), dwell=None)
    if now.kind != "present" or now.pose is None or state.current is None:
        return bare
    expected = state.expected[state.current]
    difference = compare_pose(expected, now.pose, settings.intrinsics, settings.target)
    moves = choose_hints(difference, settings.tolerances, state.moves)
    matched = is_match(difference, settings.tolerances)
    obstacle = find_obstacle(matched, state.last, now, settings.limits)
    waits = obstacle is not None or state.pending is not None
    dwell = None if waits else extend_dwell(state.dwell, now)
    return replace(bare, difference=difference, obstacle=obstacle, moves=moves, dwell=dwell)


def _capture_by_hand(state: SessionState) -> Step:
    """Ask for the frame that is on the screen, if the board in it matches the expected pose."""
    if state.current is None or state.pending is not None:
        return state, ()
    if state.last is None or state.obstacle == Obstacle.NOT_MATCHED or state.difference is None:
        return replace(state, refused=NOT_MATCHED), ()
    return _ask(state, state.current, state.last.sequence)


def _ask(state: SessionState, pose_index: int, sequence: int) -> Step:
    asked = replace(state, pending=pose_index, dwell=None, refused=None)
    return asked, (CaptureFrame(pose_index, sequence),)


def _accept(state: SessionState, pose_index: int) -> Step:
    """Go on to the next pose; the same acceptance twice changes nothing."""
    if not 0 <= pose_index < len(state.expected) or pose_index in state.captured:
        return state, ()
    captured, order = state.captured | {pose_index}, (*state.order, pose_index)
    following = _next_pose(len(state.expected), captured, pose_index)
    pending = None if state.pending == pose_index else state.pending
    accepted = replace(
        _afresh(state), captured=captured, order=order, current=following, pending=pending, refused=None
    )
    return accepted, ((RunComplete(),) if following is None else ())


def _refuse(state: SessionState, pose_index: int, reason: str) -> Step:
    """Ask for the same pose again; a refusal of what was not asked for changes nothing."""
    if state.pending != pose_index:
        return state, ()
    return replace(_afresh(state), pending=None, refused=reason), ()


def _take_back(state: SessionState, pose_index: int) -> Step:
    """Forget a capture and ask for its pose; nothing while another capture is being stored."""
    if pose_index not in state.captured or state.pending is not None:
        return state, ()
    order = tuple(i for i in state.order if i != pose_index)
    taken = replace(
        _afresh(state), captured=state.captured - {pose_index}, order=order, current=pose_index, refused=None
    )
    return taken, (DiscardCapture(pose_index),)


def _afresh(state: SessionState) -> SessionState:
    """Return the state without what was made of the latest frame."""
    return replace(state, difference=None, obstacle=None, moves=(), dwell=None)


def _next_pose(count: int, captured: frozenset[int], after: int) -> int | None:
    """Return the first open pose from `after` on, else the first of all; None when all are captured."""
    order = [*range(after, count), *range(after)]
    return next((i for i in order if i not in captured), None)
