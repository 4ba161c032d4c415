"""A pose set as the plain dictionary that files, requests and the database share, and back.

Not here: reading or writing files.
"""

from collections.abc import Mapping
from dataclasses import asdict
from typing import Any

import numpy as np

from service.core.errors import PoseSetInvalid
from service.core.planning.criterion import OBJECTIVES, PRESETS, Weights
from service.core.planning.curve import CurvePoint
from service.core.planning.diversity import Diversity
from service.core.planning.paper import PAPER_OBJECTIVE
from service.core.planning.plan import WEIGHTED, PoseSet
from service.core.vision.transforms import Array, Pose
from service.core.vision.uncertainty import MappingError

KNOWN_OBJECTIVES = (*OBJECTIVES, WEIGHTED, PAPER_OBJECTIVE)
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
            "pose_sigma_px": list(pose_set.pose_sigma_px),
            "curve": [{**asdict(p), **_finite_mapping(p)} for p in pose_set.curve],
        },
        "provenance": {
            "seed": pose_set.seed,
            "candidates": pose_set.candidates,
            "sigma_px": pose_set.sigma_px,
            "objective": pose_set.objective,
            "planner": pose_set.planner,
            "weights": asdict(pose_set.weights),
            "draws": pose_set.draws,
            "noise_source": pose_set.noise_source,
        },
    }


def pose_set_from_dict(document: Mapping[str, Any]) -> PoseSet:
    """Return the pose set of a dictionary; PoseSetInvalid says what is missing or of the wrong kind.

    What older planners did not know is read as they planned: one noise, one camera, no curve.
    """
    try:
        prediction, provenance = document["prediction"], document["provenance"]
        if provenance["objective"] not in KNOWN_OBJECTIVES:
            raise PoseSetInvalid(f"provenance.objective must be one of {', '.join(KNOWN_OBJECTIVES)}.")
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
            weights=_weights(provenance),
            draws=int(provenance.get("draws", 1)),
            noise_source=str(provenance.get("noise_source", "one for all poses")),
            pose_sigma_px=tuple(float(v) for v in prediction.get("pose_sigma_px", ())),
            curve=tuple(_curve_point(point) for point in prediction.get("curve", ())),
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


def _weights(provenance: Mapping[str, Any]) -> Weights:
    stored = provenance.get("weights")
    if stored is None:
        return PRESETS.get(provenance["objective"], PRESETS["parameters"])
    return Weights(**{name: float(value) for name, value in stored.items()})


def _curve_point(stored: Mapping[str, Any]) -> CurvePoint:
    return CurvePoint(
        int(stored["poses"]),
        float(stored["norm_px"]),
        _number(stored["mapping_mean_px"]),
        _number(stored["mapping_worst_px"]),
    )


def _finite_mapping(point: CurvePoint) -> dict[str, float | None]:
    return {
        "mapping_mean_px": _finite(point.mapping_mean_px),
        "mapping_worst_px": _finite(point.mapping_worst_px),
    }


def _finite(value: float) -> float | None:
    """Return a number that JSON can carry: None for inf, where the lens does not reach the zone."""
    return value if np.isfinite(value) else None


def _number(value: float | None) -> float:
    return float("inf") if value is None else float(value)
