"""Results: what a finished run says about its camera, gate by gate."""

from datetime import datetime
from typing import Annotated, Any
from uuid import UUID

from fastapi import APIRouter
from pydantic import Field

from service.api.auth import Viewer
from service.api.dependencies import ReadDb
from service.api.shapes import Answer, Id
from service.core.quality.gates import Verdict
from service.usecases import results

router = APIRouter(tags=["Results"])


class Measurement(Answer):
    """A measured value against its limit; `advice` says what to do when it is not PASS."""

    gate: str
    name: str
    value: float | None
    unit: str
    limit: float | None
    comparison: str = Field(description="How the value must stand to the limit: <=, >= or ==.")
    margin: float | None = Field(
        description="How far the value keeps away from its limit; negative beyond it."
    )
    verdict: Verdict
    advice: str


class BoardPose(Answer):
    """Pose of the board in the camera's frame (`T_cam_board`): rotation vector, rad, and translation, m."""

    rvec: tuple[float, float, float]
    tvec: tuple[float, float, float]


class ViewResult(Answer):
    """What the solve says about one capture."""

    capture_id: UUID
    name: str
    rms_px: float
    max_px: float
    pose: BoardPose


class Mapping(Answer):
    """Expected error of the mapping from rays to pixels, px, over the working zone and the valid region."""

    zone_mean_px: float | None
    zone_worst_px: float | None
    valid_mean_px: float | None
    valid_worst_px: float | None


class Result(Answer):
    """The judged calibration of one run."""

    id: UUID
    run_id: UUID
    verdict: Verdict
    lens: str
    image_size: tuple[int, int]
    intrinsics: dict[str, float] = Field(description="fx fy cx cy in px, then the lens's coefficients.")
    sd: dict[str, float | None] = Field(description="Standard deviation of each parameter; 0 for fixed ones.")
    rms_px: float
    sigma_px: float = Field(description="Estimated noise of one corner coordinate, px.")
    mapping: Mapping
    score: Annotated[float | None, Field(description="The paper's score S against the SKU's nominal camera.")]
    gates: list[Measurement]
    views: list[ViewResult]
    starts: list[dict[str, Any]] = Field(description="Where the solver started from, and what it reached.")
    agreement_px: float | None = Field(
        description="Largest difference between the starts; null: one of them failed."
    )
    versions: dict[str, str]
    created_at: datetime


@router.get("/runs/{run_id}/result", summary="Read the result of a run")
def read_result(run_id: Id, caller: Viewer, db: ReadDb) -> Result:
    """Read the result; a run that is not finished has none (404)."""
    return Result.model_validate(results.read_result(db, run_id))
