"""The bias gate: are the residuals noise, or does the model leave something behind?

A bent board and a wrong lens model fit well enough for any limit on the RMS and move the result by many
reported standard deviations. They show in residuals that neighbours share. Without a SKU the board is
somebody's paper, which is never flat: then the gate warns and does not fail.
"""

from service.core.quality.evidence import Evidence
from service.core.quality.gates import Measurement, Verdict, check_limit
from service.core.vision.local_noise import local_sigma, neighbour_correlation, residual_grid

GATE = "bias"
REMEDY = (
    "Check that the board is flat and rigid and that the lens model suits the lens; a certified board on a "
    "plate of glass or aluminium shows which of the two it is."
)


def measure_bias(evidence: Evidence) -> tuple[Measurement, ...]:
    """Return the measurements of the bias gate."""
    target, result = evidence.target, evidence.result
    ids = [view.detection.corner_ids for view in evidence.views]
    seen = [view.detection.image_points for view in evidence.views]
    residuals = [residual_grid(e, i, target) for e, i in zip(result.residuals, ids, strict=True)]
    pixels = [residual_grid(p, i, target) for p, i in zip(seen, ids, strict=True)]
    worst = Verdict.MARGINAL if evidence.expectation is None else Verdict.FAIL
    local = local_sigma(residuals, pixels)
    ratio = 1.0 - (local / result.sigma_px) ** 2 if result.sigma_px > 0 else 0.0
    return (
        check_limit(
            GATE,
            "bias_ratio",
            ratio,
            "<=",
            evidence.limits,
            good="The residuals are as small as the noise of the corners alone.",
            bad=f"{ratio:.0%} of the squared residuals are not noise: the model leaves something behind.",
            remedy=REMEDY,
            worst=worst,
        ),
        check_limit(
            GATE,
            "neighbour_correlation",
            neighbour_correlation(residuals),
            "<=",
            evidence.limits,
            good="The residuals of neighbouring corners have nothing in common.",
            bad="Neighbouring corners are off in the same direction, so it is no noise.",
            remedy=REMEDY,
            worst=worst,
        ),
    )
