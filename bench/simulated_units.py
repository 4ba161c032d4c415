"""Simulated cameras of four SKUs and the corners a free hand would give of them: random poses, exact noise.

Two have the paper's lens model, two a model for wide lenses. The wide design's polynomial was chosen so that
it keeps growing beyond the image corner, and a drawn unit that does not is drawn again: a lens whose model
folds inside the image cannot exist, and five coefficients do not describe every lens of 120 degrees (then the
model gate fails it). Poses are random, not planned, so that many sets are poor: too poor for the last
coefficient of the rational model, which is zero and held. Not here: rendered images.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from service.core.planning.pose_space import Poses, PoseSpace, sample_poses
from service.core.vision.camera import Intrinsics, project, reach_share, unproject
from service.core.vision.target_chessboard import Chessboard
from service.core.vision.tolerance import Tolerance, draw_camera
from service.core.vision.transforms import Array
from service.core.vision.uncertainty import whole_image
from service.core.vision.view_stack import View

BOARD = Chessboard(9, 6, 0.025)
SIGMA_PX = 0.1
POOL = 1000
NOMINAL_OFF = 0.05
MARGIN_PX = 8.0
FOLD_SHARE = 0.95


@dataclass(frozen=True)
class Design:
    """A camera SKU: its intrinsics, how far units differ, and the distances at which boards are held.

    fixed: parameters that are not estimated.
    """

    name: str
    intrinsics: Intrinsics
    tolerance: Tolerance
    distance_m: tuple[float, float]
    fixed: tuple[str, ...] = ()


@dataclass(frozen=True)
class Unit:
    """One camera of a design, what its data sheet says, and the corners seen of boards."""

    true: Intrinsics
    nominal: Intrinsics
    views: list[View]


def _design(
    name: str, intrinsics: Intrinsics, distance_m: tuple[float, float], fixed: tuple[str, ...] = ()
) -> Design:
    spread = {"k1": 0.01, "k2": 0.002, "p1": 0.0003, "p2": 0.0003, "k3": 0.0003}
    tolerance = Tolerance(focal_share=0.01, aspect_share=0.001, centre_px=12.0, coefficients=spread)
    return Design(name, intrinsics, tolerance, distance_m, fixed)


def _camera(lens: str, size: tuple[int, int], *values: float) -> Intrinsics:
    return Intrinsics.from_vector(lens, np.array(values), size)


_NARROW, _WIDE = (1280, 800), (1920, 1208)

HFOV80 = _design(
    "hfov80",
    _camera("pinhole5", _NARROW, 920.55, 920.55, 639.5, 399.5, -0.31, 0.105, 4e-4, -3e-4, -0.015),
    (0.2, 0.9),
)
HFOV120 = _design(
    "hfov120",
    _camera("pinhole5", _WIDE, 915.7, 915.7, 959.5, 603.5, -0.1954, 0.0246, 3e-4, -2e-4, -0.0011),
    (0.12, 0.6),
)
RATIONAL120 = _design(
    "rational8",
    _camera(
        "rational8",
        _WIDE,
        *(917.0, 917.0, 959.5, 603.5),
        *(0.5186, 0.024, 3e-4, -2e-4, -0.0002, 0.8503, 0.1136, 0.0),
    ),
    (0.12, 0.6),
    fixed=("k6",),
)
FISHEYE120 = _design(
    "kannala_brandt4",
    _camera("kannala_brandt4", _WIDE, 917.0, 917.0, 959.5, 603.5, -0.021, 0.0072, -0.0041, 0.0008),
    (0.12, 0.6),
)


def draw_units(design: Design, count: int, views: tuple[int, int], seed: int) -> Iterator[Unit]:
    """Yield units with a random number of views between two bounds; unit i is the same for any count."""
    space = replace(PoseSpace(), distance_m=design.distance_m)
    pool = sample_poses(space, design.intrinsics, BOARD, POOL, seed)
    for i in range(count):
        rng = np.random.default_rng([seed, i])
        true = _draw_camera(design, rng)
        number = int(rng.integers(views[0], views[1] + 1))
        yield Unit(true, _data_sheet(design, rng), draw_views(true, pool, number, rng))


def draw_views(true: Intrinsics, pool: Poses, count: int, rng: np.random.Generator) -> list[View]:
    """Return noisy views of boards at random poses of a pool, those only that the camera shows whole."""
    order = rng.permutation(len(pool))
    pixels = project(true, pool.rotations[order], pool.translations[order], BOARD.object_points)
    seen = np.flatnonzero(_is_shown(true, pool[order], pixels))[:count]
    noisy = pixels[seen] + SIGMA_PX * rng.standard_normal((len(seen), *pixels.shape[1:]))
    return [View(BOARD.object_points, corners) for corners in noisy]


def _is_shown(true: Intrinsics, poses: Poses, pixels: Array) -> Array:
    """Whether all corners of each pose are inside the image and before the fold of the lens."""
    points = BOARD.object_points @ np.swapaxes(poses.rotations, -1, -2) + poses.translations[:, None]
    share = reach_share(true, points).max(axis=1)
    last = np.array(true.image_size) - 1.0
    inside = np.all((pixels > MARGIN_PX) & (pixels < last - MARGIN_PX), axis=(1, 2))
    return np.asarray(inside & (share < FOLD_SHARE))


def _draw_camera(design: Design, rng: np.random.Generator) -> Intrinsics:
    """Return a unit whose lens reaches the image's corners before it folds."""
    while True:
        true = draw_camera(design.intrinsics, design.tolerance, rng)
        reached = unproject(true, whole_image(true.image_size).grid(2, 2))
        if float(reach_share(true, reached).max()) < FOLD_SHARE:
            return true


def _data_sheet(design: Design, rng: np.random.Generator) -> Intrinsics:
    """Return the design with focal lengths and coefficients off by five per cent, each its own way."""
    vector = design.intrinsics.vector
    off = 1.0 + NOMINAL_OFF * rng.choice([-1.0, 1.0], size=len(vector))
    off[1] = off[0]
    off[2:4] = 1.0
    return Intrinsics.from_vector(design.intrinsics.lens, vector * off, design.intrinsics.image_size)
