"""Faults that a line can have, each injected into the pictures or corners of a good run of Lens 1.

A fault is a function of a seed that returns the judged run, or the error that refused it. Which of the gates
ought to speak is said beside it. Not here: how often they do (`gates`).
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cache

import cv2
import numpy as np
from numpy.typing import NDArray

from service.core.errors import ServiceError
from service.core.planning.plan import plan_pose_set
from service.core.planning.pose_space import PoseSpace, sample_poses
from service.core.quality.evidence import Expectation, NamedDetection, Refusal
from service.core.quality.verdict import Judged, calibrate_and_judge
from service.core.vision.camera import Intrinsics, project
from service.core.vision.detection import detect_target
from service.core.vision.target import Target, parse_target
from service.core.vision.target_chessboard import Chessboard
from service.core.vision.tolerance import Tolerance, draw_camera
from service.core.vision.transforms import Array, Pose
from service.demo.skus import PAPER_SKUS
from service.demo.virtual_vehicle import HAND, nominal_camera
from service.simulator.renderer import prepare
from service.simulator.scene import production_scene
from service.simulator.vehicle import take_captures

Image = NDArray[np.uint8]
Outcome = Judged | ServiceError
Fault = Callable[[int], Outcome]

NOMINAL = nominal_camera(PAPER_SKUS[0])
BOARD = Chessboard(9, 6, 0.025)
CODED = parse_target("charuco:8x5:25mm:18mm:4x4_250")
SPACE = PoseSpace()
FISHEYE = Intrinsics.from_parameters(
    "kannala_brandt4", {"fx": 400.0, "fy": 400.0, "cx": 639.5, "cy": 399.5, "k1": -0.02}, (1280, 800)
)
COUNT, SEED = 12, 1
FEW = 4  # pictures of a coded board, each of which is refused by itself
UNITS = 5  # cameras whose pictures are rendered; a seed takes one of them
OTHER_FOCAL = 1.015  # of a SKU that is easily taken for this one


@cache
def poses() -> tuple[Pose, ...]:
    """The poses that every run is asked for."""
    return plan_pose_set(NOMINAL, BOARD, SPACE, COUNT, SEED).poses


def expectation(names: Sequence[str] = (), *, other: bool = False, used: bool = False) -> Expectation:
    """What the SKU says; other: that there is one much like it; used: that the pictures were used before."""
    near = Intrinsics.from_vector(
        NOMINAL.lens, NOMINAL.vector * np.r_[OTHER_FOCAL, OTHER_FOCAL, np.ones(7)], NOMINAL.image_size
    )
    return Expectation(
        NOMINAL,
        poses=poses(),
        pose_of_view=tuple(range(COUNT)),
        other_skus={"near": near} if other else {},
        used_for=dict.fromkeys(names, "ANOTHER") if used else {},
    )


@cache
def pictures(unit: int) -> tuple[Image, ...]:
    """The pictures of a good run of one of the SKU's cameras."""
    rng = np.random.default_rng((SEED, unit))
    return tuple(_photograph(draw_camera(NOMINAL, Tolerance(), rng), rng))


def good_run(seed: tuple[int, ...]) -> Outcome:
    """A run without a fault, of a camera of its own."""
    rng = np.random.default_rng(seed)
    return judge_pictures(_photograph(draw_camera(NOMINAL, Tolerance(), rng), rng))


def _photograph(camera: Intrinsics, rng: np.random.Generator, gain: float = 1.0) -> list[Image]:
    scene = production_scene(camera, BOARD, SEED)
    prepared = prepare(replace(scene, exposure=gain * scene.exposure))
    return [capture.image for capture in take_captures(prepared, poses(), HAND, rng)]


def judge_pictures(images: Sequence[Image], target: Target = BOARD) -> Outcome:
    """Detect and judge as the service does."""
    views, refused, answers = [], [], []
    for i, image in enumerate(images):
        try:
            views.append(NamedDetection(f"{i:02d}.png", detect_target(image, target), f"{i}"))
            answers.append(i)
        except ServiceError as error:
            refused.append(Refusal(f"{i:02d}.png", error.code, error.detail))
    told = replace(expectation(), pose_of_view=tuple(answers))
    try:
        return calibrate_and_judge(views, target, NOMINAL.lens, told, refused=refused)
    except ServiceError as error:
        return error


def judge_views(views: Sequence[NamedDetection], told: Expectation | None = None) -> Outcome:
    """Judge detections as the service does."""
    try:
        return calibrate_and_judge(views, BOARD, NOMINAL.lens, told or expectation())
    except ServiceError as error:
        return error


@cache
def detections(unit: int) -> tuple[NamedDetection, ...]:
    """What is detected in the pictures of a good run."""
    found = [detect_target(image, BOARD) for image in pictures(unit)]
    return tuple(NamedDetection(f"{i:02d}.png", one, f"{unit}-{i}") for i, one in enumerate(found))


@dataclass(frozen=True)
class Case:
    """A fault with the measurements, or codes of errors, any of which is the right reason."""

    fault: Fault
    reasons: frozenset[str]


def _with_points(view: NamedDetection, points: Array) -> NamedDetection:
    return replace(view, detection=replace(view.detection, image_points=points))


def _corners_of(
    camera: Intrinsics, at: Sequence[Pose], rng: np.random.Generator, board: Array | None = None
) -> list[NamedDetection]:
    """Return views of computed corners, as sharp and bright as the rendered ones."""
    points = BOARD.object_points if board is None else board
    sample = detections(0)
    return [
        _with_points(
            replace(sample[i % COUNT], name=f"{i:02d}.png", sha256=""),
            project(camera, pose.rotation, pose.tvec, points) + rng.normal(0.0, 0.05, (len(points), 2)),
        )
        for i, pose in enumerate(at)
    ]


def repeated_view(seed: int) -> Outcome:
    """One view is given three times instead of three others."""
    views = list(detections(seed % UNITS))
    for i in np.random.default_rng(seed).choice(np.arange(1, COUNT), 3, replace=False):
        views[i] = replace(views[0], name=views[i].name)
    return judge_views(views)


def wrong_board(seed: int) -> Outcome:
    """The board is a 9x6, declared is 8x6."""
    return judge_pictures(pictures(seed % UNITS), Chessboard(8, 6, 0.025))


def two_cameras(seed: int) -> Outcome:
    """Half of the views are of another camera of the same SKU: the last ones, or every second one."""
    one, two = detections(seed % UNITS), detections((seed + 1) % UNITS)
    order = np.arange(COUNT) % 2 if seed % 2 else 2 * np.arange(COUNT) // COUNT
    return judge_views([two[i] if order[i] else one[i] for i in range(COUNT)])


def _mirrored(image: Image) -> Image:
    return np.ascontiguousarray(image[:, ::-1])


def mirrored_view(seed: int) -> Outcome:
    """One picture is mirrored."""
    images = list(pictures(seed % UNITS))
    at = seed % COUNT
    images[at] = _mirrored(images[at])
    return judge_pictures(images)


def mirrored_all(seed: int) -> Outcome:
    """All pictures of a coded board are mirrored."""
    rng = np.random.default_rng(seed)
    some = sample_poses(SPACE, NOMINAL, CODED, FEW, seed)
    prepared = prepare(production_scene(draw_camera(NOMINAL, Tolerance(), rng), CODED, SEED))
    return judge_pictures([_mirrored(prepared.render(some.pose(i), rng)) for i in range(FEW)], CODED)


def mirrored_plain(seed: int) -> Outcome:
    """All pictures of a chessboard are mirrored."""
    return judge_pictures([_mirrored(image) for image in pictures(seed % UNITS)])


def blur(seed: int) -> Outcome:
    """The lens is out of focus."""
    return judge_pictures(
        [np.asarray(cv2.GaussianBlur(image, (0, 0), 3.0), dtype=np.uint8) for image in pictures(seed % UNITS)]
    )


def motion_blur(seed: int) -> Outcome:
    """The board moves by 5 px while the shutter is open, in another direction in each picture."""
    rng = np.random.default_rng(seed)
    return judge_pictures([_moved(image, rng.uniform(0.0, np.pi)) for image in pictures(seed % UNITS)])


def _moved(image: Image, angle_rad: float) -> Image:
    along = np.linspace(-2.5, 2.5, 11)
    shifts = np.stack([np.cos(angle_rad) * along, np.sin(angle_rad) * along], axis=1)
    size = (image.shape[1], image.shape[0])
    parts = [
        cv2.warpAffine(image, np.array([[1, 0, x], [0, 1, y]]), size, borderMode=cv2.BORDER_REFLECT)
        for x, y in shifts
    ]
    return np.asarray(np.rint(np.mean(parts, axis=0)), dtype=np.uint8)


def decentred(seed: int) -> Outcome:
    """The lens is 40 px beside the middle of the sensor."""
    shift = 40.0 * np.array([np.cos(seed), np.sin(seed)])
    views = [_with_points(v, v.detection.image_points + shift) for v in detections(seed % UNITS)]
    return judge_views(views)


def anisotropic(seed: int) -> Outcome:
    """The pictures are 2 % narrower than they were."""
    middle = (np.array(NOMINAL.image_size) - 1.0) / 2.0
    scale = np.array([0.98, 1.0]) if seed % 2 else np.array([1.0, 0.98])
    views = [
        _with_points(v, middle + (v.detection.image_points - middle) * scale)
        for v in detections(seed % UNITS)
    ]
    return judge_views(views)


def moved_corner(seed: int) -> Outcome:
    """One corner of one view is 3 px off."""
    rng = np.random.default_rng(seed)
    views = list(detections(seed % UNITS))
    at = int(rng.integers(COUNT))
    points = views[at].detection.image_points.copy()
    angle = rng.uniform(0.0, 2.0 * np.pi)
    points[rng.integers(len(points))] += 3.0 * np.array([np.cos(angle), np.sin(angle)])
    views[at] = _with_points(views[at], points)
    return judge_views(views)


def curled_board(seed: int) -> Outcome:
    """The board is bent by a tenth of a square."""
    rng = np.random.default_rng(seed)
    board = BOARD.object_points.copy()
    x = board[:, 0] / board[:, 0].max() - 0.5
    y = board[:, 1] / board[:, 1].max() - 0.5
    bend = rng.uniform(-1.0, 1.0) * x**2 + rng.uniform(-1.0, 1.0) * y**2
    board[:, 2] = bend / np.ptp(bend) * 0.1 * BOARD.square_m
    return judge_views(_corners_of(draw_camera(NOMINAL, Tolerance(), rng), poses(), rng, board))


def saturated(seed: int) -> Outcome:
    """The lamp is turned up, or the shutter stays open for longer: a third more light to three times as much.

    Below that hardly a view has a fifth of its bright squares saturated, and its corners are as good as ever.
    """
    rng = np.random.default_rng((SEED, seed))
    gain = float(np.exp(rng.uniform(np.log(1.33), np.log(3.0))))
    return judge_pictures(_photograph(draw_camera(NOMINAL, Tolerance(), rng), rng, gain))


def swapped_sku(seed: int) -> Outcome:
    """The camera is of another SKU, whose focal length is 1.5 % longer."""
    rng = np.random.default_rng(seed)
    near = expectation(other=True).other_skus["near"]
    camera = draw_camera(near, replace(Tolerance(), focal_share=0.003), rng)
    return judge_views(_corners_of(camera, poses(), rng), expectation(other=True))


def swapped_serial(seed: int) -> Outcome:
    """The pictures were used for another serial."""
    views = detections(seed % UNITS)
    return judge_views(views, expectation([view.sha256 for view in views], used=True))


def few_tilts(seed: int) -> Outcome:
    """All boards nearly face the camera."""
    flat = replace(SPACE, yaw_deg=(-3.0, 3.0), pitch_deg=(-3.0, 3.0))
    rng = np.random.default_rng(seed)
    some = sample_poses(flat, NOMINAL, BOARD, COUNT, seed)
    held = [some.pose(i) for i in range(COUNT)]
    told = Expectation(NOMINAL)
    return judge_views(_corners_of(draw_camera(NOMINAL, Tolerance(), rng), held, rng), told)


def wrong_model(seed: int) -> Outcome:
    """Five coefficients for a fisheye."""
    rng = np.random.default_rng(seed)
    some = sample_poses(replace(SPACE, distance_m=(0.12, 0.5)), FISHEYE, BOARD, COUNT, seed)
    camera = draw_camera(FISHEYE, replace(Tolerance(), coefficients={}), rng)
    return judge_views(
        _corners_of(camera, [some.pose(i) for i in range(COUNT)], rng),
        Expectation(Intrinsics.from_vector("pinhole5", np.r_[FISHEYE.vector[:4], np.zeros(5)], (1280, 800))),
    )


CERTAINTY = frozenset({"focal_sd_share", "centre_sd_px", "zone_mapping_px", "valid_mapping_px"})
CASES = {
    "repeated_view": Case(repeated_view, frozenset({"view_separation_px"})),
    "wrong_board": Case(wrong_board, frozenset({"wrong-target", "wrong_target"})),
    "two_cameras": Case(two_cameras, frozenset({"half_difference", "bias_ratio", "neighbour_correlation"})),
    "mirrored_view": Case(
        mirrored_view, frozenset({"match_px", "missing_poses", "worst_view_ratio", "facing"})
    ),
    "mirrored_all": Case(mirrored_all, frozenset({"wrong-target"})),
    "mirrored_plain": Case(
        mirrored_plain, frozenset({"match_px", "missing_poses", "facing", "centre_off_px"})
    ),
    "blur": Case(blur, frozenset({"edge_width_px"})),
    "motion_blur": Case(motion_blur, frozenset({"edge_width_px"})),
    "decentred": Case(decentred, frozenset({"centre_off_px"})),
    "anisotropic": Case(anisotropic, frozenset({"square_pixels"})),
    "moved_corner": Case(moved_corner, frozenset({"worst_view_ratio", "outlier_share"})),
    "curled_board": Case(curled_board, frozenset({"bias_ratio", "neighbour_correlation"})),
    "saturated": Case(saturated, frozenset({"saturated_share", "target-overexposed"})),
    "swapped_sku": Case(swapped_sku, frozenset({"other_sku"})),
    "swapped_serial": Case(swapped_serial, frozenset({"used_elsewhere"})),
    "few_tilts": Case(few_tilts, CERTAINTY | {"degenerate-views"}),
    "wrong_model": Case(
        wrong_model,
        frozenset(
            {"rms_px", "monotone_ratio", "converged", "agreement_px", "bias_ratio", "degenerate-views"}
        ),
    ),
}
