"""What accuracy a set of poses promises, before anybody lifts a board. Not here: how the set is found."""

from collections.abc import Collection
from dataclasses import dataclass

import numpy as np

from service.core.errors import IntrinsicsInvalid
from service.core.planning.information import pose_information
from service.core.planning.pose_space import Indices, Poses
from service.core.planning.scoring import condition_number, expected_covariance
from service.core.vision.camera import Intrinsics, parameter_names
from service.core.vision.target import Target
from service.core.vision.transforms import Array
from service.core.vision.uncertainty import MappingError, Region, mapping_error


@dataclass(frozen=True)
class Prediction:
    """norm_px: √E‖Ĉ − C‖². sd: by parameter name, zero where fixed. mapping: over a zone of the image.

    condition: of the information in units that make its diagonal one. covariance: (p, p), zero where fixed.
    """

    norm_px: float
    sd: dict[str, float]
    mapping: MappingError
    condition: float
    covariance: Array


def predict_accuracy(
    intrinsics: Intrinsics,
    target: Target,
    poses: Poses,
    sigma_px: float | Array,
    zone: Region,
    *,
    fixed: Collection[str] = (),
) -> Prediction:
    """Return the accuracy of a calibration from m poses with corner noise sigma_px, one for all or (m,).

    The solver weighs all corners alike, so that with Λ for unit noise, M = ΣΛ and S = Σσ²Λ, its covariance is
    M⁻¹ S M⁻¹. Raises PoseSetInfeasible where the poses do not determine the parameters that are not fixed.
    """
    names = parameter_names(intrinsics.lens)
    free = free_parameters(intrinsics.lens, fixed)
    by_pose = pose_information(intrinsics, target, poses, 1.0)[:, free[:, None], free]
    information = by_pose.sum(axis=0)
    unit = expected_covariance(information)
    noise = np.broadcast_to(np.asarray(sigma_px, dtype=np.float64), (len(poses),)) ** 2
    covariance = np.zeros((len(names), len(names)))
    covariance[np.ix_(free, free)] = unit @ np.einsum("m,mij->ij", noise, by_pose) @ unit
    sd = np.sqrt(np.diagonal(covariance))
    return Prediction(
        norm_px=float(np.sqrt(np.trace(covariance))),
        sd=dict(zip(names, map(float, sd), strict=True)),
        mapping=mapping_error(intrinsics, covariance, zone),
        condition=condition_number(information),
        covariance=covariance,
    )


def free_parameters(lens: str, fixed: Collection[str]) -> Indices:
    """Return the indices of the parameters that are not fixed; IntrinsicsInvalid for unknown names."""
    names = parameter_names(lens)
    unknown = sorted(set(fixed) - set(names))
    free = [i for i, name in enumerate(names) if name not in fixed]
    if unknown or not free:
        raise IntrinsicsInvalid(
            f"Cannot fix {', '.join(unknown) or 'every parameter'}; the lens has {', '.join(names)}."
        )
    return np.array(free, dtype=np.int64)


def zone_within(image_size: tuple[int, int], margin_px: float) -> Region:
    """Return the image (width, height) px without a margin: where the corners of a set can be."""
    width, height = image_size
    return Region(margin_px, margin_px, width - 1.0 - margin_px, height - 1.0 - margin_px)
