"""What a guidance session tells its listeners, as plain values; the socket makes messages of them.

Not here: when each is told (`guide`), and their form on the wire (`service.api.ws.protocol`).
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any
from uuid import UUID

import numpy as np

from service.core.errors import ServiceError
from service.core.guidance.actions import AddedFor
from service.core.guidance.hints import ShownHint
from service.core.guidance.session_state import GuidanceSettings, SessionState
from service.core.guidance.session_view import view
from service.core.quality.gates import Verdict
from service.core.run import Purpose
from service.core.vision.target import Target
from service.core.vision.target_circles import Circles
from service.core.vision.transforms import Array, Pose
from service.storage.models import MeasurementRow
from service.usecases.guide_estimate import Estimate
from service.usecases.guide_runs import GuidedRun
from service.usecases.observation import outer_corners
from service.usecases.results import ResultView

Points = list[tuple[float, float]]
WORST_FIRST = {Verdict.FAIL: 0, Verdict.MARGINAL: 1, Verdict.PASS: 2}


@dataclass(frozen=True)
class BoardView:
    """How many corners or dots a board has; dot_steps: a dot's diameter over the grid's step."""

    columns: int
    rows: int
    dot_steps: float | None


@dataclass(frozen=True)
class AnglesView:
    """How a board stands to the camera."""

    tilt_deg: float
    turn_deg: float
    roll_deg: float
    distance_m: float


@dataclass(frozen=True)
class WantedPoseView:
    """One pose of the run in the nominal camera's image; added_for: why, if it is not of the set."""

    pose_index: int
    outline: Points
    angles: AnglesView
    added_for: AddedFor | None = None
    replaces: int | None = None


@dataclass(frozen=True)
class AccuracyView:
    """Standard deviations of the camera, px."""

    fx_px: float
    fy_px: float
    cx_px: float
    cy_px: float


@dataclass(frozen=True)
class GuidedRunView:
    """The run as a whole, told when it is taken and after a capture was taken back."""

    run_id: UUID
    serial: str
    sku: str
    revision: int
    purpose: Purpose
    image_size: tuple[int, int]
    board: BoardView
    poses: list[WantedPoseView]
    captured: list[int]
    pose_index: int | None
    automatic: bool
    total: int
    promised: AccuracyView | None
    accuracy: AccuracyView | None
    estimate: Estimate | None


@dataclass(frozen=True)
class AcceptedView:
    """A capture was stored."""

    pose_index: int
    capture_id: UUID
    number: int
    captured: list[int]
    total: int
    match_error_px: float | None
    edge_width_px: float | None
    accuracy: AccuracyView | None
    estimate: Estimate | None


@dataclass(frozen=True)
class RefusedView:
    """A capture was not taken."""

    pose_index: int | None
    error: ServiceError


@dataclass(frozen=True)
class VerdictView:
    """The stored result of the run."""

    run_id: UUID
    serial: str
    verdict: Verdict
    gates: list[MeasurementRow]
    reasons: list[str]
    result: str


@dataclass(frozen=True)
class ClosedView:
    """The run has ended without a result, or was left."""

    run_id: UUID
    reason: str


@dataclass(frozen=True)
class WantedFrame:
    """The session asks for the full picture of a frame; answered by `keep` or `miss`."""

    sequence: int


@dataclass(frozen=True)
class GhostView:
    """The board of the pose that is asked for."""

    outline: Points
    corners: Points


@dataclass(frozen=True)
class SeenView:
    """The board in the picture."""

    outline: Points
    corners: Points
    angles: AnglesView | None


@dataclass(frozen=True)
class CameraView:
    """How a camera that the service reads keeps up."""

    name: str | None
    fps: float | None
    source_s: float | None
    waited_ms: float


@dataclass(frozen=True)
class StateView:
    """What the newest frame shows and what to do next."""

    sequence: int
    at_ms: float
    run_id: UUID
    board: str
    seen: SeenView | None
    ghost: GhostView | None
    difference: dict[str, Any] | None
    hints: tuple[ShownHint, ...]
    match: float
    dwell: float
    pose_index: int | None
    captured: int
    total: int
    automatic: bool
    is_capturing: bool
    accuracy: AccuracyView | None
    instead_of: int | None
    tried_s: float
    absent_s: float
    camera: CameraView | None = None
    round_trip_ms: float | None = None


Told = (
    GuidedRunView
    | AcceptedView
    | RefusedView
    | VerdictView
    | ClosedView
    | WantedFrame
    | StateView
    | ServiceError
)


def view_run(
    run: GuidedRun, state: SessionState, settings: GuidanceSettings, estimate: Estimate | None
) -> GuidedRunView:
    """Return the run as a whole."""
    added = [None] * len(run.poses) + list(state.added)
    wanted = [
        WantedPoseView(
            index,
            _points(outer_corners(settings.intrinsics, settings.target, pose)),
            view_angles(pose, settings.target),
            None if more is None else more.reason,
            None if more is None else more.replaces,
        )
        for index, (pose, more) in enumerate(zip(state.expected, added, strict=True))
    ]
    return GuidedRunView(
        run_id=run.id,
        serial=run.serial,
        sku=run.sku,
        revision=run.number,
        purpose=run.purpose,
        image_size=settings.intrinsics.image_size,
        board=_view_board(settings.target),
        poses=wanted,
        captured=sorted(state.captured),
        pose_index=state.current,
        automatic=state.automatic,
        total=state.total,
        promised=view_accuracy(run.promised),
        accuracy=view_accuracy(None if estimate is None else estimate.sd),
        estimate=estimate,
    )


def view_state(
    run_id: UUID, state: SessionState, settings: GuidanceSettings, estimate: Estimate | None
) -> StateView:
    """Return what the newest frame shows; the session must have seen one."""
    shown, last, target = view(state, settings), state.last, settings.target
    seen = None
    if last is not None and last.image_points is not None:
        outline = _points(last.image_points[list(target.outer_corners)])
        angles = None if last.pose is None else view_angles(last.pose, target)
        seen = SeenView(outline, _points(last.image_points), angles)
    ghost = None
    if shown.ghost is not None:
        ghost = GhostView(_points(shown.ghost[list(target.outer_corners)]), _points(shown.ghost))
    return StateView(
        sequence=0 if last is None else last.sequence,
        at_ms=0.0 if last is None else 1000.0 * last.at_s,
        run_id=run_id,
        board=shown.board,
        seen=seen,
        ghost=ghost,
        difference=_difference(state),
        hints=shown.hints,
        match=shown.match,
        dwell=shown.dwell,
        pose_index=shown.pose_index,
        captured=shown.captured,
        total=shown.total,
        automatic=shown.automatic,
        is_capturing=shown.is_storing,
        accuracy=view_accuracy(None if estimate is None else estimate.sd),
        instead_of=shown.instead_of,
        tried_s=round(shown.tried_s, 1),
        absent_s=round(shown.absent_s, 1),
    )


def view_verdict(serial: str, result: ResultView) -> VerdictView:
    """Return a result as the kiosk shows it, what went wrong first."""
    gates = sorted(result.gates, key=lambda gate: WORST_FIRST[gate.verdict])
    advice = [gate.advice for gate in gates if gate.verdict is not Verdict.PASS]
    return VerdictView(
        run_id=result.run_id,
        serial=serial,
        verdict=result.verdict,
        gates=gates,
        reasons=list(dict.fromkeys(advice)),
        result=f"/api/v1/runs/{result.run_id}/result",
    )


def view_accuracy(sd: Mapping[str, float] | None) -> AccuracyView | None:
    """Return standard deviations by parameter as they are shown; None where one is not known."""
    values = [] if sd is None else [float(sd.get(name, np.nan)) for name in ("fx", "fy", "cx", "cy")]
    return AccuracyView(*values) if values and np.all(np.isfinite(values)) else None


def view_angles(pose: Pose, target: Target) -> AnglesView:
    """Return how a board stands: signs as those of `core.guidance.comparison`, all 0 for a frontal one."""
    R = pose.rotation
    normal, along = R[:, 2], R[:, 0]
    return AnglesView(
        tilt_deg=float(np.degrees(np.arctan2(-normal[1], normal[2]))),
        turn_deg=float(np.degrees(np.arctan2(normal[0], normal[2]))),
        roll_deg=float(np.degrees(np.arctan2(along[1], along[0]))),
        distance_m=float(np.linalg.norm(R @ target.centre + pose.tvec)),
    )


def _view_board(target: Target) -> BoardView:
    dot_steps = target.diameter_m / target.step_m if isinstance(target, Circles) else None
    return BoardView(target.columns, target.rows, dot_steps)


def _difference(state: SessionState) -> dict[str, Any] | None:
    found = state.difference
    if found is None:
        return None
    return {
        "right_px": found.right_px,
        "down_px": found.down_px,
        "closer_share": found.closer_share,
        "tilt_deg": float(np.degrees(found.tilt_rad)),
        "turn_deg": float(np.degrees(found.turn_rad)),
        "roll_deg": float(np.degrees(found.roll_rad)),
        "corner_px": found.corner_px,
        "is_upside_down": found.is_upside_down,
    }


def _points(points: Array) -> Points:
    # A hundredth of a pixel is more than a screen shows, and keeps messages short.
    return [(round(float(u), 2), round(float(v), 2)) for u, v in np.nan_to_num(points)]
