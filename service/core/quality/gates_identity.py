"""The identity gate: is this the camera that it is said to be?

Its intrinsics lie near the SKU's, nearer than to any other SKU's, and none of its pictures was used for
another serial. Two cameras of one SKU can be twins, whom no picture tells apart: the serial has to come from
the device. Not here: the population, which is far closer than these limits (`gates_population`).
"""

import numpy as np

from service.core.quality.evidence import Evidence, Expectation
from service.core.quality.gates import Measurement, check_limit
from service.core.quality.gates_frame import name_some
from service.core.quality.limits import Limits
from service.core.vision.camera import Intrinsics

GATE = "identity"
# By how much, in limits, another SKU must be nearer: nominals may lie close together.
CLEARLY_NEARER = 0.2


def measure_identity(evidence: Evidence) -> tuple[Measurement, ...]:
    """Return the measurements of the identity gate; none without a SKU."""
    expectation = evidence.expectation
    if expectation is None:
        return ()
    return (
        _focal(evidence, expectation),
        _centre(evidence, expectation),
        _other_sku(evidence, expectation),
        _other_serial(evidence, expectation),
    )


def distance_in_limits(found: Intrinsics, nominal: Intrinsics, limits: Limits) -> float:
    """Return how far intrinsics are from a SKU's nominal, as the largest share of the start limits."""
    return max(
        focal_off_share(found, nominal) / limits.focal_off_share,
        centre_off_px(found, nominal) / limits.centre_off_px,
    )


def focal_off_share(found: Intrinsics, nominal: Intrinsics) -> float:
    """Return the larger relative difference of fx and fy."""
    return float(np.abs(found.vector[:2] / nominal.vector[:2] - 1.0).max())


def centre_off_px(found: Intrinsics, nominal: Intrinsics) -> float:
    """Return the larger difference of cx and cy, px."""
    return float(np.abs(found.vector[2:4] - nominal.vector[2:4]).max())


def _focal(evidence: Evidence, expectation: Expectation) -> Measurement:
    off = focal_off_share(evidence.result.intrinsics, expectation.nominal)
    return check_limit(
        GATE,
        "focal_off_share",
        off,
        "<=",
        evidence.limits,
        good="The focal length is that of the SKU.",
        bad=f"The focal length is {off:.1%} off the SKU's.",
        remedy="Check that the camera is of this SKU, its images are not scaled, and the nominal is right.",
    )


def _centre(evidence: Evidence, expectation: Expectation) -> Measurement:
    off = centre_off_px(evidence.result.intrinsics, expectation.nominal)
    return check_limit(
        GATE,
        "centre_off_px",
        off,
        "<=",
        evidence.limits,
        unit="px",
        good="The principal point is where the SKU has it.",
        bad=f"The principal point is {off:.0f} px off the SKU's.",
        remedy="Check that the lens is not decentred, the images are not cropped, and the nominal is right.",
    )


def _other_sku(evidence: Evidence, expectation: Expectation) -> Measurement:
    """Compare with other SKUs of the same image size and lens; value: by how many limits one is nearer."""
    found, limits = evidence.result.intrinsics, evidence.limits
    own = distance_in_limits(found, expectation.nominal, limits)
    others = {
        code: own - distance_in_limits(found, nominal, limits)
        for code, nominal in expectation.other_skus.items()
        if (nominal.lens, nominal.image_size) == (found.lens, found.image_size)
    }
    nearest = max(others, key=lambda code: others[code], default="")
    return check_limit(
        GATE,
        "other_sku",
        max(others.get(nearest, 0.0), 0.0),
        "<=",
        CLEARLY_NEARER,
        good="No other SKU is nearer to this camera.",
        bad=f"This camera looks like one of SKU '{nearest}'.",
        remedy="Check which camera is built in, and open the run for its SKU.",
        facts={"sku": nearest},
    )


def _other_serial(evidence: Evidence, expectation: Expectation) -> Measurement:
    taken = [
        (view.name, expectation.used_for[view.sha256])
        for view in evidence.views
        if view.sha256 in expectation.used_for
    ]
    serials = sorted({serial for _, serial in taken})
    return check_limit(
        GATE,
        "used_elsewhere",
        float(len(taken)),
        "==",
        0.0,
        good="No picture was used for another serial.",
        bad=f"{name_some([name for name, _ in taken])}: already used for {name_some(serials)}.",
        remedy="Check which camera the station read, and take the pictures of this vehicle's camera.",
        facts={"views": [name for name, _ in taken], "serials": serials},
    )
