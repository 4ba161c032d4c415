"""Why a capture by hand is refused, as errors that say what to do. Not here: what is checked (`session`)."""

from service.core.errors import ServiceError
from service.core.guidance.auto_capture import Obstacle
from service.core.guidance.hints import Hint
from service.core.guidance.problems import PictureUnfit, PoseNotMatched
from service.core.guidance.session_state import SessionState
from service.core.guidance.session_view import KIND_HINTS, OBSTACLE_HINTS
from service.core.vision.live_detection import BoardKind

REMEDIES = {
    Obstacle.MOVING: "The board moves. Hold it still until the ring is full, then capture again.",
    Obstacle.BLURRED: "The board is blurred. Hold it still, in the camera's focus, then capture again.",
    Obstacle.TOO_DARK: "The board is too dark. Switch a lamp on, or take away what stands in the light.",
    Obstacle.TOO_BRIGHT: "The board is too bright. Dim the lamp, or shade the window.",
    Obstacle.GLARE: "Light shines back from the board. Shade the lamp or the window.",
}
UNSEEN: dict[BoardKind, str] = {
    "absent": "There is no board in the picture. Hold it before the camera.",
    "partial": "Only a part of the board is in the picture. Show all of it.",
    "wrong": "This is another board. Take the one that belongs to this station.",
}


def refusal_of(state: SessionState) -> ServiceError:
    """Return the error of a state whose capture by hand was refused."""
    if state.obstacle is not None and state.obstacle is not Obstacle.NOT_MATCHED:
        hint = OBSTACLE_HINTS[state.obstacle]
        return PictureUnfit(REMEDIES[state.obstacle], reason=state.obstacle.value, hint=hint.value)
    kind: BoardKind = "absent" if state.last is None else state.last.kind
    if kind != "present":
        return PictureUnfit(UNSEEN[kind], reason=kind, hint=KIND_HINTS.get(kind, Hint.SHOW_BOARD).value)
    return PoseNotMatched(
        "The board is not where the yellow outline wants it. Follow the instruction, then capture again.",
        reason=Obstacle.NOT_MATCHED.value,
    )
