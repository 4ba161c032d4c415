"""The guidance of one run as a reducer: (state, action) -> (state, effects). No clock, socket or image.

A session is resumed from what is stored: the expected poses and which of them are captured
(`session_poses`). Poses beyond the set are asked for where a pose stays out of reach and where the captures
of all poses would not do. Not here: what the state looks like to an operator (`session_view`).
"""

from dataclasses import replace
from typing import Final

from service.core.guidance.actions import (
    Action,
    AddPose,
    CaptureAccepted,
    CaptureFrame,
    CaptureRefused,
    CapturesJudged,
    DiscardCapture,
    Frame,
    ManualCapture,
    NoPoseToAdd,
    Retake,
    SetAutomatic,
    TakeAnother,
    Undo,
)
from service.core.guidance.auto_capture import Obstacle, dwell_share, extend_dwell, find_obstacles
from service.core.guidance.comparison import PoseDifference, compare_pose, is_match, reseat
from service.core.guidance.feature_order import in_order_of
from service.core.guidance.hints import choose_hints
from service.core.guidance.observation import Observation
from service.core.guidance.session_poses import add_pose, afresh, despair, give_up, next_pose, postpone, weigh
from service.core.guidance.session_state import GuidanceSettings, SessionState, Step
from service.core.vision.camera import Intrinsics
from service.core.vision.transforms import Pose

NOT_SEEN: Final = "not-seen"
LONGEST_GAP_S: Final = 1.0  # between two frames; what is longer is no time of guidance


def step(state: SessionState, action: Action, settings: GuidanceSettings) -> Step:
    """Return the state after an action and what is to be done about it."""
    result: Step = (state, ())
    match action:
        case Frame(observation):
            result = _see(state, observation, settings)
        case ManualCapture(_, is_forced):
            result = _capture_by_force(state) if is_forced else _capture_by_hand(state)
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
        case TakeAnother() | CapturesJudged() | AddPose() | NoPoseToAdd():
            result = _choose(state, action, settings)
    return result


def _choose(
    state: SessionState,
    action: TakeAnother | CapturesJudged | AddPose | NoPoseToAdd,
    settings: GuidanceSettings,
) -> Step:
    """Return the state after an action that says which pose is asked for, or that none is."""
    match action:
        case TakeAnother(pose_index):
            return postpone(state, pose_index), ()
        case CapturesJudged():
            return weigh(state, action, settings)
        case AddPose(added):
            return add_pose(state, added), ()
        case NoPoseToAdd():
            return give_up(state)


def _see(state: SessionState, now: Observation, settings: GuidanceSettings) -> Step:
    """Judge a frame, and ask for a capture once the dwell is over."""
    judged = _judge(_timed(state, now), now, settings)
    if judged.pending is not None or judged.current is None:
        return judged, ()
    if judged.dwell is None:
        return despair(judged, judged.current, settings)
    if dwell_share(judged.dwell, settings.limits) < 1.0 or not judged.automatic:
        return judged, ()
    return _ask(judged, judged.current, judged.dwell.sequence)


def _timed(state: SessionState, now: Observation) -> SessionState:
    """Return the state with the time that passed before a frame."""
    before_s = now.at_s if state.last is None else state.last.at_s
    passed_s = min(max(now.at_s - before_s, 0.0), LONGEST_GAP_S)
    is_trying = now.kind in {"present", "partial"} and state.pending is None
    return replace(
        state,
        tried_s=state.tried_s + passed_s if is_trying else state.tried_s,
        absent_s=state.absent_s + passed_s if now.kind == "absent" else 0.0,
    )


def _judge(state: SessionState, now: Observation, settings: GuidanceSettings) -> SessionState:
    """Return the state after a frame, without asking for anything."""
    expected = None if state.current is None else state.expected[state.current]
    if expected is not None:
        now = in_order_of(expected, now, state.last, settings.target)
    bare = replace(state, last=now, difference=None, obstacles=(), moves=(), dwell=None)
    if now.kind != "present" or now.pose is None or expected is None:
        return bare
    difference = _compare(expected, now.pose, now.camera, settings)
    moves = choose_hints(difference, settings.tolerances, state.moves)
    matched = is_match(difference, settings.tolerances)
    obstacles = find_obstacles(matched, state.last, now, settings.limits)
    waits = bool(obstacles) or state.pending is not None
    dwell = None if waits else extend_dwell(state.dwell, now, settings.limits)
    return replace(bare, difference=difference, obstacles=obstacles, moves=moves, dwell=dwell)


def _compare(
    expected: Pose, seen: Pose, camera: Intrinsics | None, settings: GuidanceSettings
) -> PoseDifference:
    """Return how a board must move that the nominal camera sees, or another one where that is wrong."""
    nominal, target = settings.intrinsics, settings.target
    if camera is None:
        return compare_pose(expected, seen, nominal, target)
    reseated, told = reseat(expected, nominal, camera, target)
    return compare_pose(reseated, seen, camera, target, told)


def _capture_by_hand(state: SessionState) -> Step:
    """Ask for the sharpest of the frames that met everything, if the frame that is on the screen does too."""
    if state.current is None or state.pending is not None:
        return state, ()
    if state.dwell is None:
        return replace(state, refused=state.obstacle or NOT_SEEN), ()
    return _ask(state, state.current, state.dwell.sequence, is_manual=True)


def _capture_by_force(state: SessionState) -> Step:
    """Ask for a frame whatever the checks say, if the whole target is in it: without one there is nothing."""
    if state.obstacle is None and state.dwell is not None:
        return _capture_by_hand(state)
    if state.current is None or state.pending is not None:
        return state, ()
    if state.last is None or state.last.kind != "present":
        return replace(state, refused=NOT_SEEN), ()
    overridden = state.obstacles or (Obstacle.NOT_MATCHED,)
    return _ask(state, state.current, state.last.sequence, is_manual=True, overridden=overridden)


def _ask(
    state: SessionState,
    pose_index: int,
    sequence: int,
    *,
    is_manual: bool = False,
    overridden: tuple[str, ...] = (),
) -> Step:
    asked = replace(state, pending=pose_index, dwell=None, refused=None)
    return asked, (CaptureFrame(pose_index, sequence, is_manual, overridden),)


def _accept(state: SessionState, pose_index: int) -> Step:
    """Go on to the next pose; the same acceptance twice changes nothing."""
    if not 0 <= pose_index < len(state.expected) or pose_index in state.captured:
        return state, ()
    captured, order = state.captured | {pose_index}, (*state.order, pose_index)
    pending = None if state.pending == pose_index else state.pending
    postponed = tuple(i for i in state.postponed if i != pose_index)
    accepted = replace(
        afresh(state),
        captured=captured,
        order=order,
        pending=pending,
        postponed=postponed,
        instead_of=None,
        refused=None,
    )
    return replace(accepted, current=next_pose(accepted, pose_index)), ()


def _refuse(state: SessionState, pose_index: int, reason: str) -> Step:
    """Ask for the same pose again; a refusal of what was not asked for changes nothing."""
    if state.pending != pose_index:
        return state, ()
    return replace(afresh(state), pending=None, refused=reason), ()


def _take_back(state: SessionState, pose_index: int) -> Step:
    """Forget a capture and ask for its pose; nothing while another capture is being stored."""
    if pose_index not in state.captured or state.pending is not None:
        return state, ()
    order = tuple(i for i in state.order if i != pose_index)
    taken = replace(
        afresh(state),
        captured=state.captured - {pose_index},
        order=order,
        current=pose_index,
        instead_of=None,
        refused=None,
    )
    return taken, (DiscardCapture(pose_index),)
