"""The place of a camera in the vehicle as JSON, and a view of a solve. Not here: the rest of a result."""

from collections.abc import Mapping, Sequence
from typing import Any
from uuid import UUID

import numpy as np

from service.core.vision.extrinsics import Extrinsics
from service.core.vision.transforms import Array
from service.usecases.observation import number_or_null, pose_to_json

JsonObject = dict[str, Any]


def extrinsics_document(
    found: Extrinsics, names: Sequence[str], capture_ids: Mapping[str, UUID | str], fixture: JsonObject | None
) -> JsonObject:
    """Return where the camera is; names: of the pictures, by which `capture_ids` are.

    Covariances are of a left increment of the rotation in the vehicle frame, rad, then of the position, m.
    """
    sd = np.sqrt(np.diagonal(found.covariance))
    board = pose_to_json(found.T_cam_board)
    return {
        "pose": pose_to_json(found.T_vehicle_cam),
        "covariance": found.covariance.tolist(),
        "rotation_sd_mdeg": (1000.0 * np.degrees(sd[:3])).tolist(),
        "translation_sd_mm": (1000.0 * sd[3:]).tolist(),
        "parts": {
            name: _worst_sd(part)
            for name, part in (
                ("noise", found.of_noise),
                ("intrinsics", found.of_intrinsics),
                ("fixture", found.of_fixture),
            )
        },
        "rms_px": found.rms_px,
        "sigma_px": found.sigma_px,
        "ambiguity": found.ambiguity,
        "image_agreement_px": number_or_null(found.image_agreement_px),
        "fixture": fixture,
        "views": [
            view_document(name, str(capture_ids[name]), residuals, board)
            for name, residuals in zip(names, found.residuals, strict=True)
        ],
    }


def _worst_sd(covariance: Array) -> JsonObject:
    """Return the sd about and along the axes where they are largest."""
    rotation = np.linalg.eigvalsh(covariance[:3, :3])[-1]
    translation = np.linalg.eigvalsh(covariance[3:, 3:])[-1]
    return {
        "rotation_sd_mdeg": float(1000.0 * np.degrees(np.sqrt(max(rotation, 0.0)))),
        "translation_sd_mm": float(1000.0 * np.sqrt(max(translation, 0.0))),
    }


def view_document(name: str, capture_id: str, residuals: Array, pose: JsonObject) -> JsonObject:
    """Return what a solve says of one view."""
    lengths = np.linalg.norm(residuals, axis=1)
    return {
        "capture_id": capture_id,
        "name": name,
        "rms_px": float(np.sqrt(np.mean(lengths**2))),
        "max_px": float(lengths.max()),
        "pose": pose,
        "residuals": residuals.tolist(),
    }
