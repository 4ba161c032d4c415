"""The poses that a plan chooses from, with what the choice must know of each. Not here: the choice."""

from dataclasses import dataclass

from service.core.planning.noise import CornerNoise, noise_at
from service.core.planning.pose_space import Poses, PoseSpace, sample_visible
from service.core.vision.camera import Intrinsics
from service.core.vision.target import Target
from service.core.vision.transforms import Array


@dataclass(frozen=True)
class Candidates:
    """Poses to choose from, their corners (m, n, 2) px and the noise of these (m,), px."""

    poses: Poses
    image_points: Array
    sigma_px: Array


def sample_candidates(
    intrinsics: Intrinsics,
    target: Target,
    space: PoseSpace,
    count: int,
    seed: int,
    *,
    sigma_px: float | CornerNoise,
) -> Candidates:
    """Return `count` feasible poses with their corners and noise; raises PoseSpaceEmpty."""
    poses, seen = sample_visible(space, intrinsics, target, count, seed)
    return Candidates(poses, seen.image_points, noise_at(sigma_px, seen, space.depth_of_field_m))
