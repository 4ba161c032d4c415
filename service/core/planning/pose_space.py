"""The poses that a person can hold a target in: their bounds, and sampling of the feasible ones.

Not here: which of the poses are worth taking (`scoring`, `optimiser`).
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray
from scipy.stats import qmc

from service.core.errors import PoseSpaceEmpty
from service.core.planning.fixture import Box, touches_a_box
from service.core.planning.visibility import (
    FARTHEST_ASIDE_RAD,
    LENS_SHARE,
    Visibility,
    measure_visibility,
    place_targets,
)
from service.core.vision.camera import Intrinsics
from service.core.vision.target import Target
from service.core.vision.transforms import Array, Pose, rotation_matrix, rotation_vector

Mask = NDArray[np.bool_]
Indices = NDArray[np.int64]

SMALLEST_SHARE: Final = 0.02
SMALLEST_BATCH: Final = 512
FINEST_PX: Final = 3.0  # of a marker's cell, for it to be read

REMEDIES: Mapping[str, str] = {
    "image_margin_px": "boards do not fit into the image: allow a larger distance_m, less tilt, a smaller "
    "image_margin_px, or take a smaller board",
    "smallest_square_px": "squares get too small in the image: allow a shorter distance_m, less tilt, a "
    "lower smallest_square_px, or take larger squares",
    "largest_incidence_deg": "boards are seen too obliquely: allow less yaw and pitch, or a larger "
    "largest_incidence_deg",
    "depth_of_field_m": "boards leave the depth of field: bring distance_m within it, allow less tilt, or "
    "widen depth_of_field_m if the lens is sharp there",
    "excluded_boxes": "plates touch the fixture: move or shrink the boxes (camera frame, m), or take a "
    "smaller board",
    "lens": "boards reach beyond where the lens model is monotone, or farther aside than a hand can be led: "
    "check its coefficients, or keep boards off the image corners with a larger image_margin_px",
}


@dataclass(frozen=True)
class PoseSpace:
    """Bounds of the poses of a target in front of a camera.

    distance_m: of the target's centre from the camera. yaw_deg, pitch_deg, roll_deg: turn about the
    camera's y axis, then the board's x axis, then the board's normal; all zero is a board that faces along
    the optical axis. image_margin_px: least distance of every corner from the image border.
    smallest_square_px: shortest side of a square in the image; of a coded board at least so long that a cell
    of its markers has 3 px. largest_incidence_deg: between the board's normal and the line of sight to any
    corner. separation_px: least mean corner distance between two poses of a set. depth_of_field_m: nearest
    and farthest depth of any corner at which the picture is sharp; None: everywhere. excluded_boxes: room
    that the fixture takes.
    """

    distance_m: tuple[float, float] = (0.25, 1.0)
    yaw_deg: tuple[float, float] = (-45.0, 45.0)
    pitch_deg: tuple[float, float] = (-45.0, 45.0)
    roll_deg: tuple[float, float] = (-45.0, 45.0)
    image_margin_px: float = 12.0
    smallest_square_px: float = 12.0
    largest_incidence_deg: float = 60.0
    separation_px: float = 80.0
    depth_of_field_m: tuple[float, float] | None = None
    excluded_boxes: tuple[Box, ...] = ()


@dataclass(frozen=True)
class Poses:
    """Many poses `T_cam_board`: rotations (m, 3, 3), translations (m, 3) m."""

    rotations: Array
    translations: Array

    def __len__(self) -> int:
        return len(self.translations)

    def __getitem__(self, index: slice | Mask | Indices | list[int]) -> "Poses":
        return Poses(self.rotations[index], self.translations[index])

    def pose(self, i: int) -> Pose:
        """Return the i-th pose."""
        return Pose(rotation_vector(self.rotations[i]), np.array(self.translations[i]))

    def centres(self, target: Target) -> Array:
        """Return the positions (m, 3), m, of the target's centre in the camera frame."""
        return self.rotations @ target.centre + self.translations

    def turns(self) -> Array:
        """Return the angles (m,), rad, by which boards are turned from upright and facing the camera."""
        angles: Array = np.linalg.norm(rotation_vector(self.rotations), axis=-1)
        return angles


def sample_poses(space: PoseSpace, intrinsics: Intrinsics, target: Target, count: int, seed: int) -> Poses:
    """Return `count` feasible poses of a scrambled Halton sequence; the same seed gives the same poses.

    Distance and angles are spread evenly over their bounds, and boards over all places of the image where one
    of their size fits, border included: even sampling in space would leave the image corners almost empty.
    Raises PoseSpaceEmpty, naming the bound, when less than SMALLEST_SHARE of the poses is feasible.
    """
    return sample_visible(space, intrinsics, target, count, seed)[0]


def sample_visible(
    space: PoseSpace, intrinsics: Intrinsics, target: Target, count: int, seed: int
) -> tuple[Poses, Visibility]:
    """Return the poses of `sample_poses` with what they look like."""
    check_pose_space(space)
    engine = qmc.Halton(d=6, rng=np.random.default_rng(seed))
    found: list[Poses] = []
    looks: list[Visibility] = []
    have = drawn = 0
    while have < count:
        # What is still missing, by the share that was feasible so far, and a little more.
        share = have / drawn if have else 0.5
        batch = min(max(int(1.1 * (count - have) / share), SMALLEST_BATCH), max(count, SMALLEST_BATCH))
        poses = _poses_of_unit_cube(space, intrinsics, target, engine.random(batch))
        seen = measure_visibility(intrinsics, target, poses.rotations, poses.translations)
        failures = _failures(space, target, poses, seen)
        good = ~np.any(list(failures.values()), axis=0)
        found.append(poses[good])
        looks.append(seen.part(good))
        have, drawn = have + len(found[-1]), drawn + batch
        if have < SMALLEST_SHARE * drawn:
            raise _empty_space(failures, have, drawn)
    rotations = np.concatenate([poses.rotations for poses in found])
    translations = np.concatenate([poses.translations for poses in found])
    return Poses(rotations[:count], translations[:count]), Visibility.join(looks).part(slice(count))


def infeasibilities(
    space: PoseSpace, intrinsics: Intrinsics, target: Target, poses: Poses
) -> dict[str, Mask]:
    """Return, for each bound by name, which of the m poses break it: masks (m,)."""
    seen = measure_visibility(intrinsics, target, poses.rotations, poses.translations)
    return _failures(space, target, poses, seen)


def _failures(space: PoseSpace, target: Target, poses: Poses, seen: Visibility) -> dict[str, Mask]:
    near, far = space.depth_of_field_m or (0.0, np.inf)
    # Written as "not within", so that NaN (behind the camera, does not fit) breaks the bound.
    return {
        "image_margin_px": ~(seen.clearance_px >= space.image_margin_px),
        "smallest_square_px": seen.smallest_square_px < _least_square_px(space, target),
        "largest_incidence_deg": seen.incidence_rad > np.deg2rad(space.largest_incidence_deg),
        "depth_of_field_m": ~((seen.nearest_m >= near) & (seen.farthest_m <= far)),
        "excluded_boxes": touches_a_box(space.excluded_boxes, target, poses.rotations, poses.translations),
        "lens": (seen.lens_share > LENS_SHARE) | (seen.aside_rad > FARTHEST_ASIDE_RAD),
    }


def _least_square_px(space: PoseSpace, target: Target) -> float:
    """Return the shortest side of a square that is allowed: as the space says, and what a marker needs."""
    return max(space.smallest_square_px, FINEST_PX * target.square_m / target.finest_m)


def check_pose_space(space: PoseSpace) -> PoseSpace:
    """Return the space, or raise PoseSpaceEmpty naming the bounds that cross or cannot be met."""
    ranges = {name: getattr(space, name) for name in ("distance_m", "yaw_deg", "pitch_deg", "roll_deg")}
    if space.depth_of_field_m is not None:
        ranges["depth_of_field_m"] = space.depth_of_field_m
    for name, (low, high) in ranges.items():
        if not low <= high:
            raise PoseSpaceEmpty(
                f"{name} runs from {low:g} to {high:g}; give the smaller bound first.", bound=name
            )
        if name.endswith("_m") and not low > 0:
            raise PoseSpaceEmpty(f"{name} must be positive: the board is in front of the camera.", bound=name)
    if not 0 < space.largest_incidence_deg < 90:
        raise PoseSpaceEmpty(
            "largest_incidence_deg must lie between 0 and 90.", bound="largest_incidence_deg"
        )
    return space


def _poses_of_unit_cube(space: PoseSpace, intrinsics: Intrinsics, target: Target, cube: Array) -> Poses:
    """Return the poses of points (m, 6) in 0…1: place in the image (2), distance, pitch, yaw, roll."""
    bounds = np.array([space.distance_m, space.pitch_deg, space.yaw_deg, space.roll_deg])
    values = bounds[:, 0] + cube[:, 2:] * (bounds[:, 1] - bounds[:, 0])
    axes = np.eye(3)
    pitch, yaw, roll = (rotation_matrix(np.deg2rad(values[:, 1 + i, None]) * axes[i]) for i in range(3))
    rotations = yaw @ pitch @ roll
    translations = place_targets(
        intrinsics, target, rotations, values[:, 0], places=cube[:, :2], margin_px=space.image_margin_px
    )
    return Poses(rotations, translations)


def _empty_space(failures: Mapping[str, Mask], feasible: int, drawn: int) -> PoseSpaceEmpty:
    """Return the error that names the bound without which most poses would be feasible."""

    def gain(name: str) -> tuple[float, float]:
        others = [mask for other, mask in failures.items() if other != name]
        return float(np.mean(~np.any(others, axis=0))), float(np.mean(failures[name]))

    bound = max(failures, key=gain)
    refused = int(failures[bound].sum())
    return PoseSpaceEmpty(
        f"Only {feasible} of {drawn} sampled poses are feasible; {bound} alone refuses {refused} of the last "
        f"{len(failures[bound])}: {REMEDIES[bound]}.",
        bound=bound,
        feasible=feasible,
        drawn=drawn,
    )
