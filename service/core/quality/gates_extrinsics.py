"""The extrinsics gate: is the camera's place in the vehicle well determined, and is it where it belongs?

Only where a run has pictures of the fixed target. Not here: the estimate (`core.vision.extrinsics`).
"""

import numpy as np

from service.core.quality.gates import Measurement, check_limit
from service.core.quality.limits import Limits
from service.core.vision.extrinsics import Extrinsics
from service.core.vision.transforms import Pose, angle_between

GATE = "extrinsics"
NEARER = "Use a larger fixed target, or one nearer to the camera and tilted against it"


def measure_extrinsics(found: Extrinsics, limits: Limits, mounting: Pose | None) -> tuple[Measurement, ...]:
    """Return the gate's measurements; mounting: the nominal T_vehicle_cam, if the SKU has one."""
    return (
        *_certainty(found, limits),
        *(() if mounting is None else _mounting(found.T_vehicle_cam, limits, mounting)),
        _fit(found, limits),
        *(() if found.image_agreement_px is None else (_agreement(found.image_agreement_px, limits),)),
        _tilt(found, limits),
    )


def _certainty(found: Extrinsics, limits: Limits) -> tuple[Measurement, Measurement]:
    return (
        check_limit(
            GATE,
            "translation_sd_mm",
            1000.0 * found.translation_sd_m,
            "<=",
            limits,
            unit="mm",
            good="The camera's position in the vehicle is well determined.",
            bad="The camera's position in the vehicle is uncertain.",
            remedy=f"{NEARER}, and measure the target's place again.",
        ),
        check_limit(
            GATE,
            "rotation_sd_mdeg",
            1000.0 * float(np.degrees(found.rotation_sd_rad)),
            "<=",
            limits,
            unit="mdeg",
            good="The camera's direction in the vehicle is well determined.",
            bad="The camera's direction in the vehicle is uncertain.",
            remedy=f"{NEARER}, and measure the target's place again.",
        ),
    )


def _mounting(found: Pose, limits: Limits, nominal: Pose) -> tuple[Measurement, Measurement]:
    off_mm = 1000.0 * float(np.linalg.norm(found.tvec - nominal.tvec))
    off_mdeg = 1000.0 * float(np.degrees(angle_between(nominal.rotation, found.rotation)))
    remedy = "Check how the camera is mounted, and that the station's fixture is the one that stands there."
    return (
        check_limit(
            GATE,
            "mounting_off_mm",
            off_mm,
            "<=",
            limits,
            unit="mm",
            good="The camera is where it belongs.",
            bad="The camera is not where it belongs.",
            remedy=remedy,
        ),
        check_limit(
            GATE,
            "mounting_off_mdeg",
            off_mdeg,
            "<=",
            limits,
            unit="mdeg",
            good="The camera looks where it should.",
            bad="The camera does not look where it should.",
            remedy=remedy,
        ),
    )


def _fit(found: Extrinsics, limits: Limits) -> Measurement:
    return check_limit(
        GATE,
        "extrinsics_rms_px",
        found.rms_px,
        "<=",
        limits,
        unit="px",
        good="The corners of the fixed target fit its pose.",
        bad="The corners of the fixed target do not fit its pose.",
        remedy="Check that the fixed target is the declared one and flat, and that nothing covers it.",
    )


def _agreement(agreement_px: float, limits: Limits) -> Measurement:
    return check_limit(
        GATE,
        "image_agreement_px",
        agreement_px,
        "<=",
        limits,
        unit="px",
        good="All pictures of the fixed target show it in the same place.",
        bad="The camera or the fixed target moved between the pictures.",
        remedy="Let the vehicle stand still, then take the pictures of the fixed target again.",
    )


def _tilt(found: Extrinsics, limits: Limits) -> Measurement:
    return check_limit(
        GATE,
        "tilt_ambiguity",
        found.ambiguity,
        "<=",
        limits,
        good="Only one tilt of the fixed target explains its corners.",
        bad="Two tilts of the fixed target explain its corners almost equally.",
        remedy=f"{NEARER}.",
    )
