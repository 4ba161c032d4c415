"""How far the board that is seen is from the pose that is expected, in directions that a hand can move.

All directions are those of the raw image and of the camera frame (x right, y down, z away from the camera),
never those of the board: "up" is up in the picture however the board is turned. A shift is one parallel to
the image, closer is along the line of sight, and turns are about the board's centre; so none of the six
changes another one. Not here: words for them (`hints`) and when to capture (`auto_capture`).
"""

from dataclasses import dataclass
from itertools import combinations
from typing import Final

import numpy as np
from numpy.typing import NDArray

from service.core.vision.camera import Intrinsics, project, project_camera_points
from service.core.vision.pose import fit_pose
from service.core.vision.target import Target
from service.core.vision.transforms import Array, Pose, rotation_matrix, rotation_vector

# A board whose x axis points elsewhere by more than this is better turned round than rotated.
UPSIDE_DOWN_RAD: Final = float(np.deg2rad(120.0))
WIDTH_OF_TOLERANCES: Final = 1280
BAR_REACH: Final = 4.0  # an error of so many tolerances beyond the first halves the match bar
BORDER_PX: Final = 4.0  # corners nearer to the border cannot be found
UNSEEN_PX: Final = 1e4
PAIRS: Final = tuple(combinations(range(6), 2))
# What may be mended together: any two errors, and both shifts with any third.
TOGETHER: Final[tuple[tuple[int, ...], ...]] = (*PAIRS, *((0, 1, k) for k in range(2, 6)))
# Which of the six errors are mended, and by how much of each: alone, half alone, together.
MENDINGS: Final = np.concatenate(
    [np.eye(6), 0.5 * np.eye(6), [np.eye(6)[list(axes)].sum(axis=0) for axes in TOGETHER]]
)

Six = tuple[bool, bool, bool, bool, bool, bool]
NONE: Final[Six] = (False, False, False, False, False, False)


@dataclass(frozen=True)
class Tolerances:
    """How far off a pose may be.

    corner_px: of the four outer corners, mean. offset_px: of the board's centre in the image. distance_share:
    of the depth. tilt_rad, turn_rad, roll_rad: about the image's x, y and z axes.
    Corners and angles decide the match; offset and distance only scale hints, as corners cover them.
    """

    corner_px: float
    offset_px: float = 30.0
    distance_share: float = 0.05
    tilt_rad: float = float(np.deg2rad(7.0))
    turn_rad: float = float(np.deg2rad(7.0))
    roll_rad: float = float(np.deg2rad(5.0))


@dataclass(frozen=True)
class PoseDifference:
    """How the board must move to reach the expected pose.

    right_px, down_px: of the board's centre in the raw image. closer_share: seen depth over expected depth
    minus 1, so > 0 means closer. The angles are the rotation vector, in camera axes, that turns the seen
    board into the expected one:

        tilt_rad > 0, about x (right):  the TOP edge comes to the camera, the bottom edge goes away from it
        turn_rad > 0, about y (down):   the LEFT edge goes away from the camera, the right edge comes to it
        roll_rad > 0, about z (away):   CLOCKWISE in the raw image: the right edge goes down

    Seen from the side, the camera left:     Seen from above, the camera below:

        tilt > 0   top /                         turn > 0   left \\
              (o)     /                                          \\  right
                     / bottom                             (o)

    corner_px: mean distance of the four outer corners, the paper's rule. effects_px: by how much each of the
    six errors alone moves those corners, in the order of the fields. ways: how far a hand must move the board
    for each, m and rad. leads_out, half_leads_out: whether to mend that error alone, or half of it, would
    take a corner of the seen board out of the picture; together_lead_out: the fields (i, j, …), ascending, of
    TOGETHER that would do so when all of them are mended. is_upside_down: turned by about 180°.
    """

    right_px: float
    down_px: float
    closer_share: float
    tilt_rad: float
    turn_rad: float
    roll_rad: float
    corner_px: float
    is_upside_down: bool
    effects_px: tuple[float, float, float, float, float, float]
    ways: tuple[float, float, float, float, float, float]
    leads_out: Six = NONE
    half_leads_out: Six = NONE
    together_lead_out: frozenset[tuple[int, ...]] = frozenset()


def default_tolerances(image_size: tuple[int, int]) -> Tolerances:
    """Return the tolerances for an image (width, height) px: corners within 2 % of its width."""
    scale = image_size[0] / WIDTH_OF_TOLERANCES
    return Tolerances(corner_px=0.02 * image_size[0], offset_px=30.0 * scale)


def compare_pose(
    expected: Pose, seen: Pose, intrinsics: Intrinsics, target: Target, told: Array | None = None
) -> PoseDifference:
    """Return how the seen board must move to reach the expected pose; both poses before the camera.

    told: where the expected outer corners (4, 2) px are to be, if not where these intrinsics put them.
    """
    R, R_seen = expected.rotation, seen.rotation
    wanted, found = R @ target.centre + expected.tvec, R_seen @ target.centre + seen.tvec
    pixels = project_camera_points(intrinsics, np.array([wanted, found]))
    right, down = (float(way) for way in pixels[0] - pixels[1])
    closer = float(found[2] / wanted[2] - 1.0)
    turns = rotation_vector(R @ R_seen.T)
    tilt, turn, roll = (float(angle) for angle in turns)
    shift = found[2] * np.array([right, down]) / np.diag(intrinsics.camera_matrix)[:2]
    rotations, centres = _variants((R, wanted), (R_seen, found), turns, closer, shift)
    outer = target.object_points[list(target.outer_corners)] - target.centre
    corners = project(intrinsics, rotations, centres, outer)
    distances = np.nan_to_num(np.linalg.norm(corners[1:6] - corners[0], axis=-1), nan=UNSEEN_PX).mean(axis=-1)
    across, down_m, along = abs(shift[0]), abs(shift[1]), np.linalg.norm(found) * abs(closer) / (1.0 + closer)
    if told is not None:
        distances[0] = np.linalg.norm(corners[1] - told, axis=-1).mean()
    corner_px, closer_px, tilt_px, turn_px, roll_px = (float(distance) for distance in distances)
    out = [bool(leads) for leads in ~_are_inside(corners[6:], intrinsics.image_size)]
    alone, half, together = out[:6], out[6:12], out[12:]
    return PoseDifference(
        right_px=right,
        down_px=down,
        closer_share=closer,
        tilt_rad=tilt,
        turn_rad=turn,
        roll_rad=roll,
        corner_px=corner_px,
        is_upside_down=_axis_angle(R, R_seen) > UPSIDE_DOWN_RAD,
        effects_px=(abs(right), abs(down), closer_px, tilt_px, turn_px, roll_px),
        ways=(float(across), float(down_m), float(along), abs(tilt), abs(turn), abs(roll)),
        leads_out=_six(alone),
        half_leads_out=_six(half),
        together_lead_out=frozenset(axes for axes, leads in zip(TOGETHER, together, strict=True) if leads),
    )


def reseat(expected: Pose, nominal: Intrinsics, camera: Intrinsics, target: Target) -> tuple[Pose, Array]:
    """Return the pose that fills in another camera the place in the picture that a pose fills in the nominal.

    And where its outer corners (4, 2) px are to be: that place needs not be one of the other camera's.
    """
    outer = target.object_points[list(target.outer_corners)]
    told = project(nominal, expected.rotation, expected.tvec, outer)
    nearer = camera.camera_matrix[0, 0] / nominal.camera_matrix[0, 0]
    centre = expected.rotation @ target.centre + expected.tvec
    start = Pose(expected.rvec, expected.tvec + centre * (nearer - 1.0))
    return fit_pose(camera, start, outer, told), told


def is_match(difference: PoseDifference, tolerances: Tolerances) -> bool:
    """Whether the board is where it should be: outer corners and each angle within their tolerances."""
    return not difference.is_upside_down and max(_match_errors(difference, tolerances)) <= 1.0


def match_share(difference: PoseDifference, tolerances: Tolerances) -> float:
    """Return how good the match is: 1 exactly where `is_match` holds, 0 for a board turned by 180°.

    From errors in units of their tolerances and not from pixels: a tilt of 28° hardly moves a corner.
    """
    if difference.is_upside_down:
        return 0.0
    excess = [max(0.0, error - 1.0) for error in _match_errors(difference, tolerances)]
    return float(1.0 / (1.0 + np.linalg.norm(excess) / BAR_REACH))


def _match_errors(difference: PoseDifference, tolerances: Tolerances) -> tuple[float, float, float, float]:
    """Return what decides the match, in units of its tolerance: corners, tilt, turn, roll."""
    return (
        difference.corner_px / tolerances.corner_px,
        abs(difference.tilt_rad) / tolerances.tilt_rad,
        abs(difference.turn_rad) / tolerances.turn_rad,
        abs(difference.roll_rad) / tolerances.roll_rad,
    )


def _variants(
    wanted: tuple[Array, Array], found: tuple[Array, Array], turns: Array, closer: float, shift: Array
) -> tuple[Array, Array]:
    """Return rotations (6 + k, 3, 3) and centres (6 + k, 3) m of the boards whose corners tell something.

    The expected board and the seen one; the expected one spoilt by one error each: closer, tilt, turn, roll;
    the seen one mended by each of MENDINGS (k). shift: (2,) m, nearly.
    """
    (R, centre), (R_seen, centre_seen) = wanted, found
    spoilt = np.swapaxes(rotation_matrix(np.diag(turns)), -1, -2) @ R
    mended = rotation_matrix(MENDINGS[:, 3:] * turns) @ R_seen
    rotations = np.concatenate([[R, R_seen, R], spoilt, mended])
    shifted = centre_seen + np.pad(MENDINGS[:, :2] * shift, ((0, 0), (0, 1)))
    nearer = shifted / (1.0 + MENDINGS[:, 2:3] * closer)
    centres = np.concatenate(
        [[centre, centre_seen, centre * (1.0 + closer)], np.tile(centre, (3, 1)), nearer]
    )
    return rotations, centres


def _six(flags: list[bool]) -> Six:
    return flags[0], flags[1], flags[2], flags[3], flags[4], flags[5]


def _are_inside(corners: Array, image_size: tuple[int, int]) -> NDArray[np.bool_]:
    """Return which boards' corners (m, n, 2) px all lie in the picture, not too near to its border."""
    last = np.array(image_size) - 1.0 - BORDER_PX
    return np.asarray(np.all((corners >= BORDER_PX) & (corners <= last), axis=(1, 2)))


def _axis_angle(R: Array, R_seen: Array) -> float:
    """Return the angle, rad, between the boards' x axes as they lie in the image."""
    a, b = R[:2, 0], R_seen[:2, 0]
    return float(abs(np.arctan2(a[0] * b[1] - a[1] * b[0], a @ b)))
