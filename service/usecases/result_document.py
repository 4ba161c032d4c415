"""A judged calibration as JSON: everything that is reported and stored.

NaN and infinity, which JSON has not, are null.
"""

import platform
from collections.abc import Mapping
from typing import Any
from uuid import UUID

import cv2
import numpy as np
import scipy

import service
from service.core.quality.reasons import Reason
from service.core.quality.verdict import Judged
from service.core.vision.calibration import StartReport
from service.usecases.extrinsics_document import extrinsics_document, view_document
from service.usecases.observation import number_or_null, pose_to_json

JsonObject = dict[str, Any]


def result_document(
    judged: Judged, capture_ids: Mapping[str, UUID], fixture: JsonObject | None = None
) -> JsonObject:
    """Return all of a calibration but its gates; `capture_ids` are by the names of the views.

    fixture: the place of the fixed target, as it is stored.
    """
    result = judged.result
    return {
        "lens": result.intrinsics.lens,
        "image_size": list(result.intrinsics.image_size),
        "intrinsics": result.intrinsics.parameters,
        "covariance": result.covariance.tolist(),
        "fixed": list(result.fixed),
        "sd": {name: number_or_null(value) for name, value in result.sd.items()},
        "rms_px": result.rms_px,
        "sigma_px": result.sigma_px,
        "mapping": {
            "zone_mean_px": number_or_null(judged.zone_mapping.mean_px),
            "zone_worst_px": number_or_null(judged.zone_mapping.worst_px),
            "valid_mean_px": number_or_null(judged.valid_mapping.mean_px),
            "valid_worst_px": number_or_null(judged.valid_mapping.worst_px),
        },
        "score": None if judged.score is None else number_or_null(judged.score),
        "views": [
            view_document(named.name, str(capture_ids[named.name]), residuals, pose_to_json(pose))
            for named, residuals, pose in zip(judged.views, result.residuals, result.poses, strict=True)
        ],
        "starts": [_start(start) for start in result.starts],
        "agreement_px": number_or_null(result.agreement_px),
        "converged": result.converged,
        "early_finish": _early_finish(judged),
        "extrinsics": None
        if judged.extrinsics is None
        else extrinsics_document(judged.extrinsics, judged.fixed_views, capture_ids, fixture),
        "verdict": judged.verdict.value,
    }


def versions() -> dict[str, str]:
    """Return the versions that a result depends on."""
    return {
        "service": service.__version__,
        "python": platform.python_version(),
        "numpy": np.__version__,
        "opencv": cv2.__version__,
        "scipy": scipy.__version__,
    }


def _early_finish(judged: Judged) -> JsonObject | None:
    """Return how many poses proved the required accuracy; None for a run with all its poses."""
    early = (one for one in judged.measurements if one.reason is Reason.EARLY_FINISH)
    return next((dict(one.facts) for one in early), None)


def _start(start: StartReport) -> JsonObject:
    return {
        "name": start.name,
        "rms_px": number_or_null(start.rms_px),
        "iterations": start.iterations,
        "converged": start.converged,
    }
