"""What an uploaded image shows, measured against what its run prescribes. Pure: bytes in, values out."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from service.core.errors import ImageTooLarge, PoseUndetermined, WrongImageSize
from service.core.vision.camera import Intrinsics, project
from service.core.vision.detection import Detection, detect_target
from service.core.vision.half_turn import mean_distances
from service.core.vision.outer_features import outer_places
from service.core.vision.pose import estimate_pose
from service.core.vision.sharpness import Sharpness
from service.core.vision.target import Target
from service.core.vision.transforms import Array, Pose
from service.usecases.images import check_image, decode_image

JsonObject = dict[str, Any]


@dataclass(frozen=True)
class Picture:
    """An image file as it was sent, and the most pixels that are accepted."""

    content: bytes
    file_name: str | None
    largest_pixels: int

    @property
    def name(self) -> str:
        """How messages call the image."""
        return self.file_name or "The image"


@dataclass(frozen=True)
class Prescription:
    """What a run asks of an image: nominal camera, target and, for a given pose index, the pose."""

    nominal: Intrinsics
    target: Target
    pose: Pose | None


@dataclass(frozen=True)
class Observation:
    """What an image shows; pose and match error by the nominal camera, None where they cannot be told."""

    media_type: str
    detection: Detection
    pose: Pose | None
    match_error_px: float | None


def observe(picture: Picture, prescription: Prescription) -> Observation:
    """Return what a picture shows.

    Raises ImageTooLarge, ImageUnreadable, ImageFormatUnsupported, WrongImageSize, TargetNotVisible,
    TargetOverexposed, WrongTarget.
    """
    header = check_image(picture.content, picture.name)
    width, height = prescription.nominal.image_size
    if header.width * header.height > picture.largest_pixels:
        raise ImageTooLarge(
            f"{picture.name} has {header.width}x{header.height} px; at most {picture.largest_pixels} px "
            "are accepted.",
            largest_pixels=picture.largest_pixels,
        )
    if (header.width, header.height) != (width, height):
        raise WrongImageSize(
            f"{picture.name} has {header.width}x{header.height} px; this SKU's camera has "
            f"{width}x{height} px. "
            "Check that the camera is of this SKU and sends its full image.",
            found=[header.width, header.height],
            expected=[width, height],
        )
    detection = detect_target(decode_image(picture.content, picture.name), prescription.target)
    return Observation(
        header.media_type,
        detection,
        _pose(detection, prescription),
        None if prescription.pose is None else match_error(detection, prescription, prescription.pose),
    )


def match_error(detection: Detection, prescription: Prescription, pose: Pose) -> float | None:
    """Return the mean distance, px, of the four outer corners from where the prescribed pose puts them.

    Those that a part of a coded board lacks are where the pose of the rest puts them.
    """
    target = prescription.target
    wanted = outer_corners(prescription.nominal, target, pose)
    seen = outer_places(detection.image_points, detection.corner_ids, target, prescription.nominal)
    error = float(mean_distances(seen, wanted, target))
    return error if np.isfinite(error) else None


def outer_corners(intrinsics: Intrinsics, target: Target, pose: Pose) -> Array:
    """Return where a pose puts the four outer corners: (4, 2) px, NaN behind the camera."""
    points = target.object_points[list(target.outer_corners)]
    return project(intrinsics, pose.rotation, pose.tvec, points)


def pose_from_json(stored: JsonObject) -> Pose:
    """Return the pose of its stored form."""
    return Pose(np.array(stored["rvec"], dtype=np.float64), np.array(stored["tvec"], dtype=np.float64))


def pose_to_json(pose: Pose) -> JsonObject:
    """Return the form in which a pose is stored, exact to the last digit."""
    return {"rvec": [float(v) for v in pose.rvec], "tvec": [float(v) for v in pose.tvec]}


def sharpness_to_json(sharpness: Sharpness) -> JsonObject:
    """Return the form in which sharpness is stored: null where it could not be measured."""
    return {
        "edge_width_px": number_or_null(sharpness.edge_width_px),
        "quadrants_px": [number_or_null(value) for value in sharpness.quadrants_px],
        "centre_px": number_or_null(sharpness.centre_px),
    }


def sharpness_from_json(stored: JsonObject) -> Sharpness:
    """Return the sharpness of its stored form."""
    tl, tr, br, bl = (_number(value) for value in stored["quadrants_px"])
    return Sharpness(_number(stored["edge_width_px"]), (tl, tr, br, bl), _number(stored["centre_px"]))


def number_or_null(value: float | None) -> float | None:
    """Return the number, or None for NaN and infinity, which JSON cannot say."""
    return float(value) if value is not None and np.isfinite(value) else None


def _number(value: float | None) -> float:
    return float("nan") if value is None else value


def _pose(detection: Detection, prescription: Prescription) -> Pose | None:
    points = prescription.target.object_points[detection.corner_ids]
    try:
        return estimate_pose(prescription.nominal, points, detection.image_points).pose
    except PoseUndetermined:
        # The pose is reported for people; the calibration estimates its own, so that the image is not
        # refused for it.
        return None
