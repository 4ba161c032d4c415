"""What an operator is shown of a guidance session, as numbers and codes. Not here: words and messages."""

from dataclasses import dataclass

from service.core.guidance.auto_capture import Obstacle, dwell_share
from service.core.guidance.comparison import PoseDifference, match_share
from service.core.guidance.hints import Hint, ShownHint, show_hints
from service.core.guidance.observation import Observation
from service.core.guidance.session_state import GuidanceSettings, SessionState
from service.core.vision.camera import project
from service.core.vision.live_detection import BoardKind
from service.core.vision.transforms import Array

OBSTACLE_HINTS = {
    Obstacle.MOVING: Hint.HOLD_STILL,
    Obstacle.BLURRED: Hint.HOLD_STILL,
    Obstacle.TOO_DARK: Hint.MORE_LIGHT,
    Obstacle.TOO_BRIGHT: Hint.LESS_LIGHT,
    Obstacle.GLARE: Hint.LESS_LIGHT,
}
KIND_HINTS: dict[BoardKind, Hint] = {
    "absent": Hint.SHOW_BOARD,
    "partial": Hint.SHOW_WHOLE_BOARD,
    "wrong": Hint.WRONG_BOARD,
}
# A frame without a board whose mean grey level is beyond these shows why there is none.
DARKEST_FRAME, BRIGHTEST_FRAME = 15.0, 240.0


@dataclass(frozen=True)
class SessionView:
    """What is shown of a session.

    pose_index: the pose that is asked for, None when all are captured. board: what the latest frame showed.
    ghost: (n, 2) px, the expected board's corners in the target's order. match, dwell: 0…1; match is 1
    exactly where the pose matches. hints: of at most two steps, the first one now. is_storing: a capture is
    on its way to the disk. refused: the reason of the latest refusal, a code. instead_of, tried_s, absent_s:
    as in the state.
    """

    pose_index: int | None
    captured: int
    total: int
    automatic: bool
    board: BoardKind
    ghost: Array | None
    difference: PoseDifference | None
    hints: tuple[ShownHint, ...]
    match: float
    dwell: float
    is_storing: bool
    refused: str | None
    instead_of: int | None
    tried_s: float
    absent_s: float


def view(state: SessionState, settings: GuidanceSettings) -> SessionView:
    """Return what is shown of a session after its latest frame."""
    difference = state.difference
    return SessionView(
        pose_index=state.current,
        captured=len(state.captured),
        total=state.total,
        automatic=state.automatic,
        board="absent" if state.last is None else state.last.kind,
        ghost=_ghost(state, settings),
        difference=difference,
        hints=_hints(state, settings),
        match=0.0 if difference is None else match_share(difference, settings.tolerances),
        dwell=dwell_share(state.dwell, settings.limits),
        is_storing=state.pending is not None,
        refused=state.refused,
        instead_of=state.instead_of,
        tried_s=state.tried_s,
        absent_s=state.absent_s,
    )


def _ghost(state: SessionState, settings: GuidanceSettings) -> Array | None:
    if state.current is None:
        return None
    pose = state.expected[state.current]
    return project(settings.intrinsics, pose.rotation, pose.tvec, settings.target.object_points)


def _hints(state: SessionState, settings: GuidanceSettings) -> tuple[ShownHint, ...]:
    """Return what to do now: about the board, its pose, and what else keeps the frame from being taken."""
    if state.current is None or state.last is None:
        return ()
    if state.pending is not None:
        return (ShownHint(Hint.HOLD),)
    if state.difference is None:
        hint = _light_hint(state.last) or KIND_HINTS.get(state.last.kind)
        return () if hint is None else (ShownHint(hint),)
    if state.moves:
        return show_hints(state.moves, state.difference)
    return (ShownHint(Hint.HOLD if state.obstacle is None else OBSTACLE_HINTS[state.obstacle]),)


def _light_hint(last: Observation) -> Hint | None:
    """Return what the light wants where it alone may hide the board."""
    if last.kind != "absent" or last.brightness is None:
        return None
    if last.brightness < DARKEST_FRAME:
        return Hint.MORE_LIGHT
    return Hint.LESS_LIGHT if last.brightness > BRIGHTEST_FRAME else None
