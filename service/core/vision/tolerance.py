"""How far the cameras of one variant differ from its nominal, and cameras drawn from that.

Not here: the covariance that a population really has (`quality`).
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType

import numpy as np

from service.core.vision.camera import Intrinsics


def _usual_coefficients() -> Mapping[str, float]:
    return MappingProxyType({"k1": 0.005, "k2": 0.01, "p1": 0.0003, "p2": 0.0003})


@dataclass(frozen=True)
class Tolerance:
    """How far a SKU's cameras differ from its nominal: half widths of uniform distributions.

    focal_share: common relative difference of fx and fy; aspect_share: their own; centre_px: of cx and cy;
    coefficients: by name, where absent the camera has the nominal's; names of other lenses are passed over.
    """

    focal_share: float = 0.005
    aspect_share: float = 0.0003
    centre_px: float = 4.0
    coefficients: Mapping[str, float] = field(default_factory=_usual_coefficients)


def draw_camera(nominal: Intrinsics, tolerance: Tolerance, rng: np.random.Generator) -> Intrinsics:
    """Return the true intrinsics of one camera of a SKU."""
    parameters = dict(nominal.parameters)
    common = rng.uniform(-1.0, 1.0) * tolerance.focal_share
    for name in ("fx", "fy"):
        parameters[name] *= 1.0 + common + rng.uniform(-0.5, 0.5) * tolerance.aspect_share
    for name in ("cx", "cy"):
        parameters[name] += rng.uniform(-1.0, 1.0) * tolerance.centre_px
    for name, half_width in tolerance.coefficients.items():
        if name in parameters:
            parameters[name] += rng.uniform(-1.0, 1.0) * half_width
    return Intrinsics.from_parameters(nominal.lens, parameters, nominal.image_size)
