"""Where the four outermost features of a target are in an image, in the picture or not.

A part of a coded board may lack some of them; the pose of the rest says where they would be.
"""

import numpy as np
from numpy.typing import NDArray

from service.core.errors import PoseUndetermined
from service.core.vision.camera import Intrinsics, project
from service.core.vision.pose import estimate_pose
from service.core.vision.target import Target
from service.core.vision.transforms import Array


def outer_places(
    image_points: Array, corner_ids: NDArray[np.int64], target: Target, nominal: Intrinsics
) -> Array:
    """Return the outermost features (4, 2), px: as seen, else where the nominal camera has them.

    NaN where they are neither seen nor told by a pose.
    """
    outer = np.array(target.outer_corners)
    places = np.full((len(target.object_points), 2), np.nan)
    places[corner_ids] = image_points
    seen: Array = places[outer]
    missing = np.isnan(seen[:, 0])
    if not missing.any():
        return seen
    try:
        pose = estimate_pose(nominal, target.object_points[corner_ids], image_points).pose
    except PoseUndetermined:
        return seen
    told = project(nominal, pose.rotation, pose.tvec, target.object_points[outer])
    return np.where(missing[:, None], told, seen)
