"""Results: what a finished run says about its camera, gate by gate."""

from datetime import datetime
from typing import Annotated
from uuid import UUID

from fastapi import APIRouter
from pydantic import ConfigDict, Field, JsonValue

from service.api.auth import Viewer
from service.api.dependencies import ReadDb
from service.api.shapes import Answer, Id
from service.core.quality.gates import Verdict
from service.usecases import result_maps, results
from service.usecases.fixture_document import FixtureDocument

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
    reason: str | None = Field(
        description="Code of what `advice` says, for other languages; null for results of before."
    )
    facts: dict[str, JsonValue] | None = Field(description="What `advice` names besides value and limit.")


class BoardPose(Answer):
    """Pose of the board in the camera's frame (`T_cam_board`): rotation vector, rad, and translation, m."""

    rvec: tuple[float, float, float]
    tvec: tuple[float, float, float]


class ViewResult(Answer):
    """What the solve says about one capture."""

    capture_id: UUID = Field(
        description="Of the capture; of extrinsics that were measured after the run, of the picture."
    )
    name: str
    rms_px: float
    max_px: float
    pose: BoardPose


class Start(Answer):
    """How the solve went from one start."""

    name: str
    rms_px: float | None
    iterations: int
    converged: bool


class Mapping(Answer):
    """Expected error of the mapping from rays to pixels, px, over the working zone and the valid region."""

    zone_mean_px: float | None
    zone_worst_px: float | None
    valid_mean_px: float | None
    valid_worst_px: float | None


class EarlyFinish(Answer):
    """How a run ended before its pose set was complete; 0.95 is the confidence of `proven_px`."""

    taken: int = Field(description="Poses that were taken.")
    not_needed: int = Field(description="Prescribed poses that were not.")
    proven_px: float = Field(description="Mean mapping error over the working zone that is not exceeded.")
    required_px: float = Field(description="The SKU's required_mapping_px.")


class WorstSd(Answer):
    """Standard deviations about and along the axes where they are largest."""

    rotation_sd_mdeg: float
    translation_sd_mm: float


class SdParts(Answer):
    """What each source alone would leave."""

    noise: WorstSd
    intrinsics: WorstSd
    fixture: WorstSd


class CameraPose(Answer):
    """A pose: rotation vector, rad, and translation, m."""

    rvec: tuple[float, float, float]
    tvec: tuple[float, float, float]


class Extrinsics(Answer):
    """Where the camera is in the vehicle, from pictures of the station's fixed target."""

    pose: CameraPose = Field(description="`T_vehicle_cam`: maps the camera frame into the vehicle frame.")
    covariance: list[list[float]] = Field(
        description="6x6: of a rotation exp(φ) from the left, φ in the vehicle frame, rad; then of the "
        "position, m."
    )
    rotation_sd_mdeg: tuple[float, float, float] = Field(description="About the vehicle frame's axes.")
    translation_sd_mm: tuple[float, float, float] = Field(description="Along the vehicle frame's axes.")
    parts: SdParts
    rms_px: float
    sigma_px: float
    ambiguity: float = Field(description="Rms over that of the target's other possible tilt; 0: none.")
    image_agreement_px: float | None = Field(description="Null for one picture.")
    fixture: FixtureDocument = Field(description="As it was when the pictures were taken.")
    views: list[ViewResult]


EXAMPLE: JsonValue = {
    "id": "019a2b3c-4d5e-7f60-8a1b-2c3d4e5f6071",
    "run_id": "019a2b3c-11aa-7bb2-9cc3-44dd55ee66ff",
    "verdict": "PASS",
    "lens": "pinhole5",
    "image_size": [1280, 800],
    "intrinsics": {"fx": 1350.3, "fy": 1352.2, "cx": 657.4, "cy": 383.9, "k1": -0.3771, "k2": 0.2412},
    "sd": {"fx": 0.21, "fy": 0.21, "cx": 0.41, "cy": 0.29, "k1": 0.0014, "k2": 0.0095},
    "rms_px": 0.117,
    "sigma_px": 0.085,
    "mapping": {"zone_mean_px": 0.04, "zone_worst_px": 0.09, "valid_mean_px": 0.06, "valid_worst_px": 0.21},
    "score": 1.62,
    "gates": [
        {
            "gate": "fit",
            "name": "rms_px",
            "value": 0.117,
            "unit": "px",
            "limit": 0.35,
            "comparison": "<=",
            "margin": 0.233,
            "verdict": "PASS",
            "advice": "The corners fit the camera model.",
            "reason": "rms_px",
            "facts": None,
        }
    ],
    "views": [],
    "starts": [{"name": "nominal", "rms_px": 0.117, "iterations": 6, "converged": True}],
    "agreement_px": 1e-9,
    "early_finish": None,
    "extrinsics": None,
    "board_shape": None,
    "versions": {"service": "0.1.0", "opencv": "5.0.0"},
    "created_at": "2026-11-22T07:32:33.574474Z",
}


class UsedShape(Answer):
    """The certified shape of a board with which a run was solved."""

    id: UUID
    target: str | None = Field(description="Serial of the board.")
    version: int


class Result(Answer):
    """The judged calibration of one run."""

    model_config = ConfigDict(json_schema_extra={"examples": [EXAMPLE]})

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
    starts: list[Start] = Field(description="Where the solver started from, and what it reached.")
    agreement_px: float | None = Field(
        description="Largest difference between the starts at the corners; null: one of them failed."
    )
    early_finish: EarlyFinish | None = Field(description="Null where every prescribed pose was taken.")
    extrinsics: Extrinsics | None = Field(description="Null without pictures of a fixed target.")
    board_shape: UsedShape | None = Field(
        description="Shape of the board that the solve took; null: the board was taken for flat."
    )
    versions: dict[str, str]
    created_at: datetime


Values = list[list[float | None]]


class Rectangle(Answer):
    """A part of the image, px."""

    left_px: float
    top_px: float
    right_px: float
    bottom_px: float


class ResultMaps(Answer):
    """The image cut into cells, values row by row from the top left.

    The residuals' cells are larger than those of the expected error: each needs corners of its own.
    """

    run_id: UUID
    image_size: tuple[int, int]
    sd_px: Values = Field(
        description="Expected error of the mapping, from the covariance; the best rotation for the working "
        "zone is taken out. Null where the lens does not reach."
    )
    sd_mdeg: Values = Field(description="The same as an angle of the ray, thousandths of a degree.")
    residual_rms_px: Values = Field(
        description="Rms of the residuals of the corners in the cell; null where there was none."
    )
    corners: list[list[int]] = Field(description="How many corners that rms rests on.")
    working_zone: Rectangle
    valid_region: Rectangle


@router.get("/runs/{run_id}/result", summary="Read the result of a run")
def read_result(run_id: Id, caller: Viewer, db: ReadDb) -> Result:
    """Read the result; a run that is not finished has none (404)."""
    return Result.model_validate(results.read_result(db, run_id))


@router.get("/runs/{run_id}/result/maps", summary="Read the error of a result over the image")
def read_maps(run_id: Id, caller: Viewer, db: ReadDb) -> ResultMaps:
    """Read where in the image the mapping is uncertain, and where the corners fit badly."""
    return ResultMaps.model_validate(result_maps.read_maps(db, run_id))
