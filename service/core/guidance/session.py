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
    PoseNotReached,
    Retake,
    RunComplete,
    SetAutomatic,
    TakeAnother,
    Undo,
)
from service.core.guidance.auto_capture import (
    CaptureLimits,
    Dwell,
    Obstacle,
    dwell_share,
    extend_dwell,
    find_obstacles,
)
from service.core.guidance.comparison import PoseDifference, Tolerances, compare_pose, is_match
from service.core.guidance.hints import Hint, choose_hints
from service.core.guidance.observation import Observation
from service.core.vision.camera import Intrinsics
from service.core.vision.target import Target
from service.core.vision.transforms import Pose

NOT_SEEN: Final = "not-seen"
LONGEST_GAP_S: Final = 1.0  # between two frames; what is longer is no time of guidance

Step = tuple["SessionState", tuple[Effect, ...]]


@dataclass(frozen=True)
class GuidanceSettings:
    """What a session is judged by: the SKU's nominal camera and target, tolerances, limits of a capture.

    patience_s: how long a pose is tried before another one is offered.
    """

    intrinsics: Intrinsics
    target: Target
    tolerances: Tolerances
    limits: CaptureLimits = field(default_factory=CaptureLimits)
    patience_s: float = 20.0


@dataclass(frozen=True)
class SessionState:
    """Where a session stands.

    captured: indices of the poses that have a capture; order: the same as they were taken. current: the pose
    that is asked for, None when all are captured. pending: the pose whose capture is being stored. last: the
    latest observation; difference, obstacles: what was made of it, nothing without a whole board or a pose to
    compare with. moves: the movements that are shown. refused: why the latest capture was refused, until the
    next one is asked for. postponed: open poses that come after all others. instead_of: the one that was
    postponed for the current one. tried_s: how long the current pose has been asked for with a board, or a
    part of one, in the picture; absent_s: for how long there has been none.
    """

    expected: tuple[Pose, ...]
    captured: frozenset[int] = frozenset()
    order: tuple[int, ...] = ()
    current: int | None = 0
    automatic: bool = True
    pending: int | None = None
    last: Observation | None = None
    difference: PoseDifference | None = None
    obstacles: tuple[Obstacle, ...] = ()
    moves: tuple[Hint, ...] = ()
    dwell: Dwell | None = None
    refused: str | None = None
    postponed: tuple[int, ...] = ()
    instead_of: int | None = None
    tried_s: float = 0.0
    absent_s: float = 0.0

    @property
    def obstacle(self) -> Obstacle | None:
        """What keeps the latest frame from being captured, the first thing to mend."""
        return self.obstacles[0] if self.obstacles else None

    @property
    def open(self) -> tuple[int, ...]:
        """The poses without a capture, the postponed ones last."""
        rest = [i for i in range(len(self.expected)) if i not in self.captured and i not in self.postponed]
        return (*rest, *(i for i in self.postponed if i not in self.captured))


def start_session(
    expected: Iterable[Pose],
    captured: Iterable[int] = (),
    automatic: bool = True,
    postponed: Iterable[int] = (),
) -> SessionState:
    """Return the state of a run, new or resumed; captured: pose indices in the order they were taken."""
    poses, order = tuple(expected), tuple(dict.fromkeys(captured))
    done = frozenset(order)
    later = tuple(i for i in postponed if i not in done)
    fresh = SessionState(poses, done, order, None, automatic, postponed=later)
    return replace(fresh, current=_next_pose(fresh, 0))


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
        case TakeAnother(pose_index):
            result = _postpone(state, pose_index), ()
    return result


def _see(state: SessionState, now: Observation, settings: GuidanceSettings) -> Step:
    """Judge a frame, and ask for a capture once the dwell is over."""
    judged = _judge(_timed(state, now), now, settings)
    if judged.pending is not None or judged.current is None:
        return judged, ()
    if judged.dwell is None:
        return _despair(judged, judged.current, settings.patience_s)
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


def _despair(state: SessionState, pose_index: int, patience_s: float) -> Step:
    """Say that a pose is not reached, once in a patience, where there is another one to take."""
    if state.tried_s <= patience_s or len(state.open) < 2:
        return state, ()
    return replace(state, tried_s=0.0), (PoseNotReached(pose_index, state.tried_s),)


def _judge(state: SessionState, now: Observation, settings: GuidanceSettings) -> SessionState:
    """Return the state after a frame, without asking for anything."""
    bare = replace(state, last=now, difference=None, obstacles=(), moves=(), dwell=None)
    if now.kind != "present" or now.pose is None or state.current is None:
        return bare
    expected = state.expected[state.current]
    difference = compare_pose(expected, now.pose, settings.intrinsics, settings.target)
    moves = choose_hints(difference, settings.tolerances, state.moves)
    matched = is_match(difference, settings.tolerances)
    obstacles = find_obstacles(matched, state.last, now, settings.limits)
    waits = bool(obstacles) or state.pending is not None
    dwell = None if waits else extend_dwell(state.dwell, now, settings.limits)
    return replace(bare, difference=difference, obstacles=obstacles, moves=moves, dwell=dwell)


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


def _postpone(state: SessionState, pose_index: int) -> SessionState:
    """Ask for another open pose; the current one comes after all others. Not while a capture is stored."""
    current = state.current
    if current is None or pose_index == current or pose_index not in state.open or state.pending is not None:
        return state
    later = tuple(i for i in state.postponed if i not in {current, pose_index})
    return replace(
        _afresh(state), current=pose_index, postponed=(*later, current), instead_of=current, refused=None
    )


def _accept(state: SessionState, pose_index: int) -> Step:
    """Go on to the next pose; the same acceptance twice changes nothing."""
    if not 0 <= pose_index < len(state.expected) or pose_index in state.captured:
        return state, ()
    captured, order = state.captured | {pose_index}, (*state.order, pose_index)
    pending = None if state.pending == pose_index else state.pending
    postponed = tuple(i for i in state.postponed if i != pose_index)
    accepted = replace(
        _afresh(state),
        captured=captured,
        order=order,
        pending=pending,
        postponed=postponed,
        instead_of=None,
        refused=None,
    )
    following = _next_pose(accepted, pose_index)
    return replace(accepted, current=following), ((RunComplete(),) if following is None else ())


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
        _afresh(state),
        captured=state.captured - {pose_index},
        order=order,
        current=pose_index,
        instead_of=None,
        refused=None,
    )
    return taken, (DiscardCapture(pose_index),)


def _afresh(state: SessionState) -> SessionState:
    """Return the state without what was made of the latest frame, for another try."""
    return replace(state, difference=None, obstacles=(), moves=(), dwell=None, tried_s=0.0)


def _next_pose(state: SessionState, after: int) -> int | None:
    """Return the first open pose from `after` on, else the first of all, else a postponed one, else None."""
    waiting = [i for i in state.open if i not in state.postponed]
    return next((i for i in waiting if i >= after), next(iter(state.open), None))
