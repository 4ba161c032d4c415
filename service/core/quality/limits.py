"""The limits of the gates: data of a SKU revision, with defaults by image size.

Here: the numbers, their defaults and how overrides are checked. Not here: how a value is measured
(gates_*.py) or turned into a verdict (gates.py).
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, fields, replace
from typing import Any

from service.core.errors import LimitsInvalid

MARGINAL_SHARE = 0.8
LARGE_IMAGE_PX = (
    1_500_000  # between the two classes of the gate table: 1280x800 (1.0 M) and 1920x1208 (2.3 M)
)


def _default_shares() -> dict[str, float]:
    """Shares where 0.8 does not suit: nothing covers more than 100 %, no lens has edges of 0 px, a pose
    within its tolerance was taken as asked, views that agree have a ratio of one or more (by noise alone 1.02
    with eight of them, 1.25 where they are ill-chosen), halves that agree differ by 1.7 now and then, another
    SKU that is likelier is worth a look.
    """
    return {
        "coverage": 0.944,
        "match_share": 1.0,
        "edge_width_px": 0.9,
        "quadrant_ratio": 0.9,
        "half_difference": 0.9,
        "held_out_ratio": 0.95,
        "monotone_ratio": 0.95,
        "population_distance": 0.9,
        "other_population": 0.0,
    }


@dataclass(frozen=True)
class Limits:
    """Bounds of the gates; the field's name is the name of the measurement it bounds.

    `marginal` holds, by field name, the share of a limit from which on a value is MARGINAL (0.8 where not
    named).
    """

    parity_separation: float = 0.35  # true boards have 0.50 or more, false finds 0.22 and less
    contrast: float = 40.0  # grey levels
    saturated_share: float = 0.20  # of the bright squares; good light leaves less than 0.05, guidance 0.15
    edge_width_px: float = 3.0  # 10-90 %
    quadrant_ratio: float = 1.3
    match_share: float = 0.02  # of the image width, mean distance of the four outer corners
    view_separation_px: float = (
        4.0  # mean corner distance of the two nearest views; below it is the same view twice
    )
    coverage: float = 0.85  # share of the working zone within the hull of all corners
    rms_px: float = 0.35
    smallest_rms_px: float = 0.0015  # rounding to 8 bits alone leaves 0.002
    worst_view_ratio: float = 2.0
    outlier_share: float = 0.01
    focal_sd_share: float = 0.001
    centre_sd_px: float = 0.7
    zone_mapping_px: float = 0.30
    valid_mapping_px: float = 1.0
    agreement_px: float = (
        0.05  # of the two starts: far above rounding, far below the noise of any calibration
    )
    monotone_ratio: float = 1.02
    square_pixels: float = 0.002  # of fx/fy from the SKU's own ratio, without SKU from 1
    bias_ratio: float = 0.30  # of the squared residuals; flat boards leave less than 0.1
    neighbour_correlation: float = 0.15
    half_difference: float = 2.0  # of what noise alone would make it
    held_out_ratio: float = 1.3
    focal_off_share: float = 0.02  # from the nominal
    translation_sd_mm: float = 1.0  # of the camera in the vehicle, along its worst axis
    rotation_sd_mdeg: float = 100.0
    mounting_off_mm: float = 10.0  # from the SKU's nominal mounting
    mounting_off_mdeg: float = 2000.0
    extrinsics_rms_px: float = 0.35
    image_agreement_px: float = 0.15  # what a tenth of a millimetre at half a metre moves a corner by
    tilt_ambiguity: float = 0.7  # rms of the better over that of the other tilt
    centre_off_px: float = 25.0  # from the nominal; with pixels of 3 um the lens is 75 um off the sensor
    population_distance: float = 27.9  # squared, of nine degrees of freedom: 1 good camera of 1000 is beyond
    other_population: float = 10.0  # -2 ln of a likelihood ratio: e^5, or 150 to 1
    marginal: Mapping[str, float] = field(default_factory=_default_shares)

    def bound(self, name: str) -> float:
        """Return the limit `name`."""
        return float(getattr(self, name))

    def share(self, name: str) -> float:
        """Return the share of limit `name` from which on a value is MARGINAL."""
        return self.marginal.get(name, MARGINAL_SHARE)


LIMIT_NAMES = tuple(f.name for f in fields(Limits) if f.name != "marginal")


def default_limits(image_size: tuple[int, int]) -> Limits:
    """Return the default limits of an image size (width, height), px: larger sensors have finer pixels."""
    if image_size[0] * image_size[1] < LARGE_IMAGE_PX:
        return Limits()
    return Limits(centre_sd_px=0.8, zone_mapping_px=0.40, valid_mapping_px=1.3, centre_off_px=30.0)


def limits_for(image_size: tuple[int, int], overrides: Mapping[str, Any]) -> Limits:
    """Return the default limits of an image size with some of them replaced.

    overrides: numbers by field name (None: the default), and optionally `marginal`, a mapping of shares by
    field name. Raises LimitsInvalid for an unknown name or a value that is not a finite number of zero or
    more (shares: 0 to 1).
    """
    limits = default_limits(image_size)
    shares = overrides.get("marginal") or {}
    bounds = {name: value for name, value in overrides.items() if name != "marginal" and value is not None}
    if not isinstance(shares, Mapping):
        raise LimitsInvalid("'marginal' is a mapping of limit names to shares between 0 and 1.")
    _check_names([*bounds, *shares])
    for name, value in bounds.items():
        _check_number(name, value, math.inf)
    for name, value in shares.items():
        _check_number(f"marginal.{name}", value, 1.0)
    return replace(limits, **bounds, marginal={**limits.marginal, **shares})


def _check_names(names: list[str]) -> None:
    unknown = sorted(set(names) - set(LIMIT_NAMES))
    if unknown:
        raise LimitsInvalid(
            f"No such limit: {', '.join(unknown)}. Limits are: {', '.join(LIMIT_NAMES)}.", unknown=unknown
        )


def _check_number(name: str, value: object, largest: float) -> None:
    number = isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(value)
    if not number or not 0 <= float(str(value)) <= largest:
        raise LimitsInvalid(
            f"The limit '{name}' must be a number from 0 to {largest:g}, not {value!r}.", limit=name
        )
