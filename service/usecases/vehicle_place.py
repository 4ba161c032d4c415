"""Where the camera of a finished run is in its vehicle, as exports give it away.

The newest measurement that did not fail counts: one that was made after the run (`later_extrinsics`) before
the run's own. Not here: how it is measured, and the result, which keeps its own for ever.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Self
from uuid import UUID

import numpy as np
from sqlalchemy import select
from sqlalchemy.orm import Session

from service.core.quality.gates import Verdict
from service.core.vision.transforms import Array, Pose, rotation_quaternion
from service.storage.placed import LaterExtrinsicsRow
from service.usecases.observation import pose_from_json

AXES = ("x", "y", "z")


@dataclass(frozen=True)
class VehiclePlace:
    """`T_vehicle_cam`, its covariance (6, 6), and the measurement that it is from; None: the run's own.

    The covariance is of a left increment of the rotation in the vehicle frame, rad, then of the position, m.
    """

    pose: Pose
    covariance: Array
    later_id: UUID | None

    @classmethod
    def of(cls, extrinsics: Mapping[str, Any], later_id: UUID | None) -> Self:
        """Return the place that stored extrinsics say."""
        covariance = np.array(extrinsics["covariance"], dtype=np.float64)
        return cls(pose_from_json(extrinsics["pose"]), covariance, later_id)

    @property
    def sd(self) -> Array:
        """Standard deviations (6,) in the order of the covariance, rad and m."""
        return np.asarray(np.sqrt(np.maximum(np.diagonal(self.covariance), 0.0)))

    @property
    def values(self) -> dict[str, float]:
        """Position, m, rotation vector, rad, and the unit quaternion of the rotation, with their sd."""
        named = {f"{axis}_m": v for axis, v in zip(AXES, self.pose.tvec, strict=True)}
        named |= {f"r{axis}_rad": v for axis, v in zip(AXES, self.pose.rvec, strict=True)}
        quaternion = rotation_quaternion(self.pose.rotation)
        named |= {f"q{axis}": v for axis, v in zip(("w", *AXES), quaternion, strict=True)}
        named |= {f"sd_r{axis}_rad": v for axis, v in zip(AXES, self.sd[:3], strict=True)}
        named |= {f"sd_{axis}_m": v for axis, v in zip(AXES, self.sd[3:], strict=True)}
        return {name: float(value) for name, value in named.items()}


def find_place(session: Session, run_id: UUID, document: Mapping[str, Any]) -> VehiclePlace | None:
    """Return where the camera of a run with this stored result is, None where nobody measured it."""
    query = select(LaterExtrinsicsRow).where(
        LaterExtrinsicsRow.run_id == run_id, LaterExtrinsicsRow.verdict != Verdict.FAIL
    )
    newest_first = LaterExtrinsicsRow.created_at.desc(), LaterExtrinsicsRow.id.desc()
    later = session.scalar(query.order_by(*newest_first).limit(1))
    if later is not None:
        return VehiclePlace.of(later.document["extrinsics"], later.id)
    extrinsics = document.get("extrinsics")
    return None if extrinsics is None else VehiclePlace.of(extrinsics, None)
