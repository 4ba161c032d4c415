"""A pose set explained: its poses one by one, and what they promise over the image of the nominal camera.

Computed when it is asked for. Not here: the set's life (`pose_sets`).
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any
from uuid import UUID

import numpy as np
from sqlalchemy.orm import Session

from service.core.errors import StateForbids
from service.core.planning.document import pose_from_dict
from service.core.planning.image_maps import measure_coverage
from service.core.planning.information import pose_information
from service.core.planning.pose_space import Poses
from service.core.planning.prediction import free_parameters, predict_accuracy
from service.core.planning.review import PoseReview, losses_without, review_poses
from service.core.quality.coverage import covered_share, default_valid_region, default_working_zone
from service.core.vision.camera import Intrinsics, project, unproject
from service.core.vision.error_maps import predict_map
from service.core.vision.image_grid import ImageGrid
from service.core.vision.transforms import Array, stack_poses
from service.core.vision.uncertainty import Region, mapping_error, parameter_metric, whole_image
from service.storage.models import PoseSetRow, SkuRevisionRow, SkuRow
from service.usecases.image_zones import Rows, rows_of
from service.usecases.observation import number_or_null
from service.usecases.pose_sets import get_pose_set
from service.usecases.sku_document import Revision, SkuDocument
from service.usecases.skus import SkuReference

SMALLEST_DEPTH = 0.05  # of a ray's length; flatter ones leave a picture of the space


@dataclass(frozen=True)
class ReviewedPose:
    """A pose of the set; `loss_share`: by how much the mapping error in the working zone grows without it."""

    index: int
    centre_m: list[float]
    rotation: list[list[float]]
    distance_m: float
    tilt_deg: float
    pitch_deg: float
    yaw_deg: float
    roll_deg: float
    outline_px: list[list[float]]
    plate_corners_m: list[list[float]]
    smallest_square_px: float
    loss_share: float | None


@dataclass(frozen=True)
class MapsView:
    """Values by cell of the image, row by row; None where the lens does not reach."""

    columns: int
    rows: int
    sd_px: Rows
    sd_mdeg: Rows
    boards: list[list[int]]
    corners: list[list[int]]


@dataclass(frozen=True)
class ZoneView:
    """A zone of the image, what mapping error is promised in it, and which share the corners cover."""

    left_px: float
    top_px: float
    right_px: float
    bottom_px: float
    mean_px: float | None
    worst_px: float | None
    covered_share: float


@dataclass(frozen=True)
class BoardView:
    """The target: inner corners and the side of a square."""

    spec: str
    columns: int
    rows: int
    square_m: float


@dataclass(frozen=True)
class PoseSetReview:
    """What a page needs to explain a set; limits are those that the gates hold the mapping error to."""

    id: UUID
    sku: SkuReference
    image_size: tuple[int, int]
    target: BoardView
    nominal: dict[str, float]
    corner_rays: list[list[float]] | None
    sigma_px: list[float]
    sd: dict[str, float]
    poses: list[ReviewedPose]
    maps: MapsView
    working_zone: ZoneView
    valid_region: ZoneView
    working_limit_px: float
    valid_limit_px: float


@dataclass(frozen=True)
class _Promise:
    """A set's poses, the corner noise (m,) px of each, and the covariance (p, p) that they promise."""

    poses: Poses
    sigma_px: Array
    covariance: Array
    sd: dict[str, float]


def review_pose_set(session: Session, pose_set_id: UUID) -> PoseSetReview:
    """Return a set explained; raises NotFound, and StateForbids while it has no poses."""
    row = get_pose_set(session, pose_set_id)
    if not row.poses:
        raise StateForbids("The pose set has no poses yet to review. Wait until its job is done.")
    revision_row = session.get_one(SkuRevisionRow, row.sku_revision_id)
    sku = session.get_one(SkuRow, revision_row.sku_id)
    revision = SkuDocument.model_validate(revision_row.document).to_revision()
    size = revision.intrinsics.image_size
    working = revision.working_zone or default_working_zone(size)
    valid = revision.valid_region or default_valid_region(size)
    promise = _promise(row, revision, working)
    target = revision.target
    return PoseSetReview(
        id=row.id,
        sku=SkuReference(sku.code, revision_row.number),
        image_size=size,
        target=BoardView(target.spec, target.columns, target.rows, target.square_m),
        nominal=revision.intrinsics.parameters,
        corner_rays=_corner_rays(revision.intrinsics),
        sigma_px=promise.sigma_px.tolist(),
        sd=promise.sd,
        poses=_poses(revision, promise, working),
        maps=_maps(revision, promise, working),
        working_zone=_zone(revision, promise, working),
        valid_region=_zone(revision, promise, valid),
        working_limit_px=revision.limits.zone_mapping_px,
        valid_limit_px=revision.limits.valid_mapping_px,
    )


def _promise(row: PoseSetRow, revision: Revision, zone: Region) -> _Promise:
    poses = Poses(*stack_poses([pose_from_dict(pose) for pose in row.poses]))
    sigma = np.broadcast_to(np.array(_noise(row, revision), dtype=np.float64), (len(poses),))
    prediction = predict_accuracy(
        revision.intrinsics, revision.target, poses, sigma, zone, fixed=revision.fixed
    )
    return _Promise(poses, sigma, prediction.covariance, prediction.sd)


def _corner_rays(intrinsics: Intrinsics) -> list[list[float]] | None:
    """Return the rays (x, y, 1) of the image's corners from top left clockwise.

    None where the lens does not reach a corner, or reaches it beside or behind the camera.
    """
    rays = unproject(intrinsics, whole_image(intrinsics.image_size).grid(2, 2))[[0, 1, 3, 2]]
    if not np.all(rays[:, 2] > SMALLEST_DEPTH * np.linalg.norm(rays, axis=1)):
        return None
    return [[float(x / z), float(y / z), 1.0] for x, y, z in rays]


def _noise(row: PoseSetRow, revision: Revision) -> float | Sequence[float]:
    """Return the noise that the planner reckoned with: of each pose, else one for all, else the SKU's."""
    told: Any = row.prediction.get("pose_sigma_px")
    if isinstance(told, list) and len(told) == len(row.poses):
        return [float(value) for value in told]
    return float(row.provenance.get("sigma_px", revision.corner_noise_px))


def _poses(revision: Revision, promise: _Promise, zone: Region) -> list[ReviewedPose]:
    intrinsics, target = revision.intrinsics, revision.target
    losses = losses_without(
        pose_information(intrinsics, target, promise.poses, promise.sigma_px),
        parameter_metric(intrinsics, zone),
        free_parameters(intrinsics.lens, revision.fixed),
    )
    found = review_poses(intrinsics, target, promise.poses)
    return [_pose(i, pose, loss) for i, (pose, loss) in enumerate(zip(found, losses, strict=True))]


def _pose(index: int, pose: PoseReview, loss: float | None) -> ReviewedPose:
    return ReviewedPose(
        index=index,
        centre_m=pose.centre_m.tolist(),
        rotation=pose.rotation.tolist(),
        distance_m=pose.distance_m,
        tilt_deg=pose.tilt_deg,
        pitch_deg=pose.pitch_deg,
        yaw_deg=pose.yaw_deg,
        roll_deg=pose.roll_deg,
        outline_px=pose.outline_px.tolist(),
        plate_corners_m=pose.plate_corners_m.tolist(),
        smallest_square_px=pose.smallest_square_px,
        loss_share=loss,
    )


def _maps(revision: Revision, promise: _Promise, zone: Region) -> MapsView:
    grid = ImageGrid(revision.intrinsics.image_size)
    covered = measure_coverage(revision.intrinsics, revision.target, promise.poses, grid)
    predicted = predict_map(revision.intrinsics, promise.covariance, grid, zone)
    return MapsView(
        columns=grid.columns,
        rows=grid.rows,
        sd_px=rows_of(predicted.sd_px),
        sd_mdeg=rows_of(predicted.sd_mdeg),
        boards=covered.boards.tolist(),
        corners=covered.corners.tolist(),
    )


def _zone(revision: Revision, promise: _Promise, zone: Region) -> ZoneView:
    promised = mapping_error(revision.intrinsics, promise.covariance, zone)
    pixels = project(
        revision.intrinsics,
        promise.poses.rotations,
        promise.poses.translations,
        revision.target.object_points,
    )
    return ZoneView(
        left_px=zone.left_px,
        top_px=zone.top_px,
        right_px=zone.right_px,
        bottom_px=zone.bottom_px,
        mean_px=number_or_null(promised.mean_px),
        worst_px=number_or_null(promised.worst_px),
        covered_share=covered_share(pixels.reshape(-1, 2), zone),
    )
