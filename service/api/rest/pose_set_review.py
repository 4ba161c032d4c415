"""A pose set explained: why these poses, and what they promise where in the image."""

from uuid import UUID

from fastapi import APIRouter
from pydantic import Field

from service.api.auth import Viewer
from service.api.dependencies import ReadDb
from service.api.rest.pose_sets import PoseSetSku
from service.api.shapes import Answer, Id
from service.usecases import pose_set_review

router = APIRouter(tags=["Pose sets"])

Point2 = tuple[float, float]
Point3 = tuple[float, float, float]


class ReviewedPose(Answer):
    """A pose of the set, in the camera's frame: x right, y down, z forward."""

    index: int
    centre_m: Point3 = Field(description="Middle of the board's corners.")
    rotation: tuple[Point3, Point3, Point3] = Field(description="Rows of the rotation of `T_cam_board`.")
    distance_m: float = Field(description="Of the centre from the camera.")
    tilt_deg: float = Field(description="Between the board's normal and the optical axis.")
    pitch_deg: float
    yaw_deg: float
    roll_deg: float
    outline_px: list[Point2] = Field(
        description="Line around the outermost corners in the image, as the lens bends it, closed."
    )
    plate_corners_m: list[Point3] = Field(
        description="Corners of the printed pattern: tl, tr, br, bl in the board's own order."
    )
    smallest_square_px: float
    loss_share: float | None = Field(
        description="By how much the mapping error in the working zone grows without this pose (0.1: 10 %); "
        "null where the other poses do not determine the camera."
    )


class ReviewMaps(Answer):
    """The image cut into cells, values row by row from the top left; null where the lens does not reach."""

    columns: int
    rows: int
    sd_px: list[list[float | None]] = Field(
        description="Expected error of the mapping; the best rotation for the working zone is taken out."
    )
    sd_mdeg: list[list[float | None]] = Field(
        description="The same as an angle of the ray, thousandths of a degree."
    )
    boards: list[list[int]] = Field(description="How many boards cover the cell.")
    corners: list[list[int]] = Field(description="How many corners of all boards are in the cell.")


class ReviewZone(Answer):
    """A part of the image, the mapping error expected in it, and its share within the hull of all corners."""

    left_px: float
    top_px: float
    right_px: float
    bottom_px: float
    mean_px: float | None
    worst_px: float | None
    covered_share: float


class ReviewTarget(Answer):
    """The board: inner corners and the side of a square."""

    spec: str
    columns: int
    rows: int
    square_m: float


class PoseSetReview(Answer):
    """A pose set explained for the nominal camera of its SKU revision."""

    id: UUID
    sku: PoseSetSku
    image_size: tuple[int, int]
    target: ReviewTarget
    nominal: dict[str, float]
    corner_rays: list[Point3] | None = Field(
        description="Rays of the image's corners, tl, tr, br, bl, depth 1; null beyond the lens's reach."
    )
    sigma_px: list[float] = Field(description="Corner noise of each pose that all predictions here rest on.")
    sd: dict[str, float] = Field(description="Expected standard deviation by parameter; 0 for fixed ones.")
    poses: list[ReviewedPose]
    maps: ReviewMaps
    working_zone: ReviewZone
    valid_region: ReviewZone
    working_limit_px: float = Field(description="What a calibration's mean in the working zone may be.")
    valid_limit_px: float = Field(description="What a calibration's worst in the valid region may be.")


@router.get("/pose-sets/{pose_set_id}/review", summary="Explain a pose set")
def review_pose_set(pose_set_id: Id, caller: Viewer, db: ReadDb) -> PoseSetReview:
    """Explain a set: each of its poses, and coverage and expected mapping error over the image."""
    return PoseSetReview.model_validate(pose_set_review.review_pose_set(db, pose_set_id))
