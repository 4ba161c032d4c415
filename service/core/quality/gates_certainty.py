"""The certainty gate: how far the result may be from the true camera, given the noise of the corners.

The residuals say how well the model fits the corners that were seen; only the covariance says how well these
corners determine the camera. Mapping errors are rotation-compensated (Hagemann et al., IJCV 2021): a camera
turned a little against its mount maps the world as well as before.
"""

from service.core.quality.evidence import Evidence
from service.core.quality.gates import Measurement, check_limit
from service.core.vision.uncertainty import MappingError

GATE = "certainty"
MORE = "Add views with the board tilted to both sides and close to the camera"


def measure_certainty(
    evidence: Evidence, zone_mapping: MappingError, valid_mapping: MappingError
) -> tuple[Measurement, ...]:
    """Return the measurements of the certainty gate, given the mapping errors over the two zones."""
    return (
        _focal(evidence),
        _centre(evidence),
        _zone(evidence, zone_mapping),
        _valid(evidence, valid_mapping),
    )


def _focal(evidence: Evidence) -> Measurement:
    sd, values = evidence.result.sd, evidence.result.intrinsics.parameters
    share = max(sd[name] / values[name] for name in ("fx", "fy"))
    return check_limit(
        GATE,
        "focal_sd_share",
        share,
        "<=",
        evidence.limits,
        good="The focal length is well determined.",
        bad=f"The focal length is uncertain by {share:.2%}.",
        remedy=f"{MORE}.",
    )


def _centre(evidence: Evidence) -> Measurement:
    sd = max(evidence.result.sd[name] for name in ("cx", "cy"))
    return check_limit(
        GATE,
        "centre_sd_px",
        sd,
        "<=",
        evidence.limits,
        unit="px",
        good="The principal point is well determined.",
        bad=f"The principal point is uncertain by {sd:.2f} px.",
        remedy=f"{MORE}, and with the board turned by about 90 degrees.",
    )


def _zone(evidence: Evidence, mapping: MappingError) -> Measurement:
    return check_limit(
        GATE,
        "zone_mapping_px",
        mapping.mean_px,
        "<=",
        evidence.limits,
        unit="px",
        good="The expected mapping error over the working zone is small.",
        bad="Points in the working zone would be mapped too inaccurately.",
        remedy="Add views, above all where the working zone was hardly covered.",
    )


def _valid(evidence: Evidence, mapping: MappingError) -> Measurement:
    return check_limit(
        GATE,
        "valid_mapping_px",
        mapping.worst_px,
        "<=",
        evidence.limits,
        unit="px",
        good="The expected mapping error is small everywhere in the valid region.",
        bad="At the border of the valid region the mapping is too uncertain.",
        remedy="Add views with the board in the corners of the image.",
    )
