"""A pose set as the plain dictionary that files, requests and the database share, and back.

Not here: reading or writing files.
"""

from collections.abc import Mapping
from typing import Any

import numpy as np

from service.core.errors import PoseSetInvalid
from service.core.planning.diversity import Diversity
from service.core.planning.plan import PoseSet
from service.core.planning.scoring import OBJECTIVES
from service.core.vision.transforms import Array, Pose
from service.core.vision.uncertainty import MappingError

REMEDY = "export it again with `dmscal plan`."


def pose_set_to_dict(pose_set: PoseSet) -> dict[str, Any]:
    """Return {"poses", "prediction", "provenance"} of plain values; `pose_set_from_dict` reads it."""
    mapping, diversity = pose_set.expected_mapping, pose_set.diversity
    return {
        "poses": [pose_to_dict(pose) for pose in pose_set.poses],
        "prediction": {
            "norm_px": pose_set.expected_norm_px,
            "sd": dict(pose_set.expected_sd),
            "mapping": {"mean_px": _finite(mapping.mean_px), "worst_px": _finite(mapping.worst_px)},
            "condition": pose_set.condition,
            "diversity": {
                "pitch_spread_deg": diversity.pitch_spread_deg,
                "yaw_spread_deg": diversity.yaw_spread_deg,
                "distance_ratio": diversity.distance_ratio,
                "coverage": diversity.coverage,
            },
        },
        "provenance": {
            "seed": pose_set.seed,
            "candidates": pose_set.candidates,
            "sigma_px": pose_set.sigma_px,
            "objective": pose_set.objective,
            "planner": pose_set.planner,
        },
    }


def pose_set_from_dict(document: Mapping[str, Any]) -> PoseSet:
    """Return the pose set of a dictionary; PoseSetInvalid says what is missing or of the wrong kind."""
    try:
        prediction, provenance = document["prediction"], document["provenance"]
        if provenance["objective"] not in OBJECTIVES:
            raise PoseSetInvalid(f"provenance.objective must be one of {', '.join(OBJECTIVES)}.")
        return PoseSet(
            poses=tuple(pose_from_dict(pose) for pose in document["poses"]),
            expected_norm_px=float(prediction["norm_px"]),
            expected_sd={str(name): float(value) for name, value in prediction["sd"].items()},
            expected_mapping=MappingError(
                _number(prediction["mapping"]["mean_px"]), _number(prediction["mapping"]["worst_px"])
            ),
            condition=float(prediction["condition"]),
            diversity=Diversity(**{k: float(v) for k, v in prediction["diversity"].items()}),
            seed=int(provenance["seed"]),
            candidates=int(provenance["candidates"]),
            sigma_px=float(provenance["sigma_px"]),
            objective=provenance["objective"],
            planner=str(provenance["planner"]),
        )
    except KeyError as error:
        raise PoseSetInvalid(
            f"The pose set has no {error.args[0]!r}; export it again with `dmscal plan`."
        ) from error
    except (TypeError, ValueError, AttributeError) as error:
        raise PoseSetInvalid(f"The pose set cannot be read ({error}); {REMEDY}") from error


def pose_to_dict(pose: Pose) -> dict[str, list[float]]:
    """Return {"rvec": [3] rad, "tvec": [3] m}."""
    return {"rvec": [float(v) for v in pose.rvec], "tvec": [float(v) for v in pose.tvec]}


def pose_from_dict(document: Mapping[str, Any]) -> Pose:
    """Return the pose of {"rvec", "tvec"}. Raises PoseSetInvalid unless both are three finite numbers."""
    return Pose(_vector(document, "rvec"), _vector(document, "tvec"))


def _vector(document: Mapping[str, Any], name: str) -> Array:
    try:
        vector = np.asarray(document[name], dtype=np.float64)
    except (KeyError, TypeError, ValueError) as error:
        raise PoseSetInvalid(f"A pose has no {name} of three numbers.") from error
    if vector.shape != (3,) or not np.all(np.isfinite(vector)):
        raise PoseSetInvalid(f"{name} of a pose must be three finite numbers.")
    return vector


def _finite(value: float) -> float | None:
    """Return a number that JSON can carry: None for inf, where the lens does not reach the zone."""
    return value if np.isfinite(value) else None


def _number(value: float | None) -> float:
    return float("inf") if value is None else float(value)
