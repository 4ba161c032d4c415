"""What a set of poses is worth: covariance, expected norm, the paper's score, degeneracy.

Not here: what one pose contributes (`information`), which of these a plan makes small (`criterion`).
"""

from typing import Final

import numpy as np

from service.core.errors import PoseSetInfeasible
from service.core.vision.transforms import Array

# Sets of tilted boards lie between 1e2 and 1e6; parallel boards, which leave focal length and depth tied,
# above 1e12.
LARGEST_CONDITION: Final = 1e9


def condition_number(information: Array) -> float:
    """Return the condition of information (p, p) scaled to a unit diagonal; inf where singular."""
    diagonal = np.diagonal(information)
    if not np.all(np.isfinite(information)) or np.any(diagonal <= 0):
        return float("inf")
    scale = 1.0 / np.sqrt(diagonal)
    values = np.linalg.eigvalsh(information * scale * scale[:, None])
    return float(values[-1] / values[0]) if values[0] > 0 else float("inf")


def expected_covariance(information: Array) -> Array:
    """Return the covariance (p, p) that the summed information ΣΛ (p, p) of a set promises.

    Raises PoseSetInfeasible when the set does not determine every parameter.
    """
    condition = condition_number(information)
    if condition > LARGEST_CONDITION:
        raise PoseSetInfeasible(
            "These poses do not determine the camera: boards that are parallel to each other leave "
            "focal length and distance tied. Allow tilt (yaw_deg, pitch_deg) or ask for more poses.",
            condition=min(condition, 1e300),
        )
    scale = 1.0 / np.sqrt(np.diagonal(information))
    covariance: Array = np.linalg.inv(information * scale * scale[:, None]) * scale * scale[:, None]
    return (covariance + covariance.T) / 2.0


def expected_norm(information: Array) -> float:
    """Return √tr (ΣΛ)⁻¹ = √E‖Ĉ − C‖² of a set's information (p, p); PoseSetInfeasible if degenerate."""
    return float(np.sqrt(np.trace(expected_covariance(information))))


def paper_score(mre_px: float, norm: float, alpha: float = 1.0, beta: float = 1.0) -> float:
    """Return the paper's S = 1 / (α·MRE + β·‖Ĉ − C‖); α = β = 1 reproduces its Table 1."""
    return 1.0 / (alpha * mre_px + beta * norm)
