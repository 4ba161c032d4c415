"""From what a session tells to the messages on the wire. Not here: to whom they go (`desk`)."""

from service.api.problems import problem_body
from service.api.ws.protocol import (
    CaptureAccepted,
    CaptureRefused,
    ProblemTold,
    Run,
    RunClosed,
    RunVerdict,
    State,
    WantFullFrame,
)
from service.api.ws.run_parts import Told
from service.core.errors import ServiceError
from service.usecases import guide_views as views

SHAPES: dict[type, type[Told]] = {
    views.GuidedRunView: Run,
    views.AcceptedView: CaptureAccepted,
    views.VerdictView: RunVerdict,
    views.ClosedView: RunClosed,
    views.WantedFrame: WantFullFrame,
}


def message_of(told: views.Told) -> Told:
    """Return the message that tells it."""
    if isinstance(told, ServiceError):
        return ProblemTold(**problem_body(told))
    if isinstance(told, views.RefusedView):
        return CaptureRefused(pose_index=told.pose_index, **problem_body(told.error))
    return SHAPES[type(told)].model_validate(told)


def state_message(state: views.StateView) -> State:
    """Return the message of what a frame shows."""
    return State.model_validate(state)
