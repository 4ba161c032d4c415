"""A planned pose set as text for people. Plain ASCII; not here: its JSON (core.planning.document)."""

from collections.abc import Iterator

import numpy as np

from service.core.planning.plan import PoseSet
from service.core.vision.transforms import Pose


def plan_text(code: str, pose_set: PoseSet) -> str:
    """Return the poses of a set and the accuracy that it promises."""
    return "\n".join(_lines(code, pose_set))


def _lines(code: str, pose_set: PoseSet) -> Iterator[str]:
    yield f"{len(pose_set.poses)} poses for {code}, in the order to be taken"
    yield f"{'pose':>6}{'x mm':>9}{'y mm':>9}{'z mm':>9}{'rotation deg (x y z)':>28}"
    for number, pose in enumerate(pose_set.poses, start=1):
        yield _pose(number, pose)
    mapping = pose_set.expected_mapping
    yield f"Expected for a corner noise of {pose_set.sigma_px:g} px:"
    yield f"  sd  {', '.join(f'{name} {value:.4g}' for name, value in pose_set.expected_sd.items())}"
    yield f"  mapping error {mapping.mean_px:.3f} px, at most {mapping.worst_px:.3f} px"
    yield f"  norm of the error of all parameters {pose_set.expected_norm_px:.3f} px"


def _pose(number: int, pose: Pose) -> str:
    position = "".join(f"{1000 * value:>9.1f}" for value in pose.tvec)
    rotation = "".join(f"{value:>8.1f}" for value in np.degrees(pose.rvec))
    return f"{number:>6}{position}{rotation:>28}"
