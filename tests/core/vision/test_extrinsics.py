"""Where a camera is in the vehicle: exact from exact corners, and off by no more than it says."""

import numpy as np
import pytest
from numpy.typing import NDArray

from service.core.errors import PoseUndetermined
from service.core.planning.plan import plan_pose_set
from service.core.planning.pose_space import Poses, PoseSpace
from service.core.planning.prediction import predict_accuracy
from service.core.vision.camera import Intrinsics, project
from service.core.vision.detection import detect_target
from service.core.vision.extrinsics import Extrinsics, FixedTarget, estimate_extrinsics
from service.core.vision.target_chessboard import Chessboard
from service.core.vision.transforms import (
    Array,
    Pose,
    compose,
    invert,
    rotation_matrix,
    rotation_vector,
    stack_poses,
)
from service.core.vision.uncertainty import whole_image
from service.core.vision.view_stack import View
from service.simulator.renderer import prepare
from service.simulator.scene import Scene
from tests.core.vision.cameras import LENS1

BOARD = Chessboard(9, 6, 0.025)
SD_M, SD_RAD = 2e-4, np.radians(0.02)
T_VEHICLE_BOARD = Pose(np.array([0.2, -1.9, 0.4]), np.array([1.6, 0.3, 1.1]))
TILT = rotation_matrix(np.array([0.35, 0.25, 0.1]))
T_CAM_BOARD = Pose(rotation_vector(TILT), np.array([0.03, -0.02, 0.55]) - TILT @ BOARD.centre)
TRUTH = compose(T_VEHICLE_BOARD, invert(T_CAM_BOARD))
PLACE = FixedTarget(T_VEHICLE_BOARD, SD_M, SD_RAD)
NOISE_PX = 0.05


def intrinsics_covariance(sigma_px: float = NOISE_PX) -> Array:
    """That of a calibration from ten planned poses."""
    space = PoseSpace()
    planned = plan_pose_set(LENS1, BOARD, space, 10, 3, candidates=300, sigma_px=sigma_px)
    poses = Poses(*stack_poses(list(planned.poses)))
    return predict_accuracy(LENS1, BOARD, poses, sigma_px, whole_image(LENS1.image_size)).covariance


COVARIANCE = intrinsics_covariance()


def seen(camera: Intrinsics, rng: np.random.Generator, images: int, pose: Pose = T_CAM_BOARD) -> list[View]:
    pixels = project(camera, pose.rotation, pose.tvec, BOARD.object_points)
    return [View(BOARD.object_points, pixels + rng.normal(0, NOISE_PX, pixels.shape)) for _ in range(images)]


def error(found: Pose, truth: Pose = TRUTH) -> Array:
    """The rotation's left increment and the translation between truth and estimate (6,)."""
    turn = rotation_vector(found.rotation @ truth.rotation.T)
    return np.concatenate([turn, found.tvec - truth.tvec])


def drawn_camera(rng: np.random.Generator) -> Intrinsics:
    """What a calibration would have found for the camera."""
    vector = rng.multivariate_normal(LENS1.vector, COVARIANCE, method="cholesky")
    return Intrinsics.from_vector(LENS1.lens, vector, LENS1.image_size)


def drawn_place(rng: np.random.Generator) -> Pose:
    """Where somebody who measured the target believes it to be."""
    turned = rotation_matrix(rng.normal(0, SD_RAD, 3)) @ T_VEHICLE_BOARD.rotation
    return Pose(rotation_vector(turned), T_VEHICLE_BOARD.tvec + rng.normal(0, SD_M, 3))


def estimate_once(rng: np.random.Generator, images: int) -> Extrinsics:
    views = seen(LENS1, rng, images)
    place = FixedTarget(drawn_place(rng), SD_M, SD_RAD)
    return estimate_extrinsics(views, drawn_camera(rng), COVARIANCE, place)


def test_exact_corners_give_the_exact_place() -> None:
    pixels = project(LENS1, T_CAM_BOARD.rotation, T_CAM_BOARD.tvec, BOARD.object_points)
    found = estimate_extrinsics([View(BOARD.object_points, pixels)], LENS1, COVARIANCE, PLACE)
    assert np.abs(error(found.T_vehicle_cam)).max() < 1e-8
    assert found.rms_px < 1e-6
    assert found.image_agreement_px is None


def test_the_covariance_is_that_of_many_repetitions() -> None:
    rng = np.random.default_rng(5)
    repeated = [estimate_once(rng, images=1) for _ in range(300)]
    errors = np.array([error(one.T_vehicle_cam) for one in repeated])
    said = np.mean([one.covariance for one in repeated], axis=0)

    assert errors.std(axis=0) == pytest.approx(np.sqrt(np.diagonal(said)), rel=0.15)
    scale = np.sqrt(np.diagonal(said))
    between = np.cov(errors.T) / np.outer(scale, scale) - said / np.outer(scale, scale)
    assert np.abs(between).max() < 0.25


def test_the_parts_are_what_a_deviation_of_each_source_does() -> None:
    pixels = project(LENS1, T_CAM_BOARD.rotation, T_CAM_BOARD.tvec, BOARD.object_points)
    views = [View(BOARD.object_points, pixels)]
    said = estimate_extrinsics(views, LENS1, COVARIANCE, PLACE)
    by_camera = []
    for deviation in np.linalg.cholesky(COVARIANCE).T:
        camera = Intrinsics.from_vector(LENS1.lens, LENS1.vector + deviation, LENS1.image_size)
        by_camera.append(error(estimate_extrinsics(views, camera, COVARIANCE, PLACE).T_vehicle_cam))
    by_place = []
    for axis in np.eye(3):
        turned = rotation_vector(rotation_matrix(SD_RAD * axis) @ T_VEHICLE_BOARD.rotation)
        for pose in (
            Pose(turned, T_VEHICLE_BOARD.tvec),
            Pose(T_VEHICLE_BOARD.rvec, T_VEHICLE_BOARD.tvec + SD_M * axis),
        ):
            place = FixedTarget(pose, SD_M, SD_RAD)
            by_place.append(error(estimate_extrinsics(views, LENS1, COVARIANCE, place).T_vehicle_cam))
    for part, deviations in ((said.of_intrinsics, by_camera), (said.of_fixture, by_place)):
        assert part == pytest.approx(np.transpose(deviations) @ deviations, rel=0.05, abs=1e-3 * part.max())


def test_more_pictures_lessen_the_noise_and_nothing_else() -> None:
    rng = np.random.default_rng(7)
    one, many = (estimate_extrinsics(seen(LENS1, rng, n), LENS1, COVARIANCE, PLACE) for n in (1, 25))
    assert many.of_noise == pytest.approx(one.of_noise / 25, rel=0.6, abs=1e-12)
    assert many.of_fixture == pytest.approx(one.of_fixture, rel=1e-3, abs=1e-12)
    assert many.translation_sd_m < one.translation_sd_m


def test_rendered_pictures_are_within_three_predicted_deviations_of_the_truth() -> None:
    scene = prepare(Scene(LENS1, BOARD, noise_grey=2.0, blur_px=0.7))
    normalised = []
    for seed in range(6, 11):
        rng = np.random.default_rng(seed)
        turn = rotation_matrix(rng.normal(0, 0.25, 3))
        pose = Pose(rotation_vector(turn), np.array([0.0, 0.0, rng.uniform(0.4, 0.7)]) - turn @ BOARD.centre)
        views = [detected(scene.render(pose, rng)) for _ in range(2)]
        place = FixedTarget(drawn_place(rng), SD_M, SD_RAD)
        found = estimate_extrinsics(views, drawn_camera(rng), COVARIANCE, place)
        off = error(found.T_vehicle_cam, compose(T_VEHICLE_BOARD, invert(pose)))
        normalised.append(off / np.sqrt(np.diagonal(found.covariance)))
    assert np.abs(normalised).max() < 3.0
    assert np.std(normalised) > 0.5


def detected(image: NDArray[np.uint8]) -> View:
    detection = detect_target(image, BOARD)
    return View(BOARD.object_points[detection.corner_ids], detection.image_points)


def test_errors_that_repeat_are_not_averaged_away() -> None:
    rng = np.random.default_rng(10)
    printed = rng.normal(0, NOISE_PX, (len(BOARD.object_points), 2))
    pixels = project(LENS1, T_CAM_BOARD.rotation, T_CAM_BOARD.tvec, BOARD.object_points) + printed
    one, many = (
        estimate_extrinsics([View(BOARD.object_points, pixels)] * n, LENS1, COVARIANCE, PLACE) for n in (1, 9)
    )
    assert many.of_noise == pytest.approx(one.of_noise, rel=1e-6)


def test_a_camera_that_moved_between_the_pictures_shows() -> None:
    rng = np.random.default_rng(8)
    moved = Pose(T_CAM_BOARD.rvec, T_CAM_BOARD.tvec + np.array([0.001, 0.0, 0.0]))
    still = estimate_extrinsics(seen(LENS1, rng, 4), LENS1, COVARIANCE, PLACE)
    other = estimate_extrinsics([*seen(LENS1, rng, 2), *seen(LENS1, rng, 2, moved)], LENS1, COVARIANCE, PLACE)
    assert still.image_agreement_px is not None
    assert still.image_agreement_px < 0.05
    assert other.image_agreement_px is not None
    assert other.image_agreement_px > 0.5


def test_a_small_far_target_has_two_tilts_and_says_so() -> None:
    rng = np.random.default_rng(9)
    turn = rotation_matrix(np.array([0.0, 0.25, 0.0]))
    far = Pose(rotation_vector(turn), np.array([0.0, 0.0, 6.0]) - turn @ BOARD.centre)
    assert estimate_extrinsics(seen(LENS1, rng, 1, far), LENS1, COVARIANCE, PLACE).ambiguity > 0.5
    assert estimate_extrinsics(seen(LENS1, rng, 1), LENS1, COVARIANCE, PLACE).ambiguity < 0.1


def test_without_a_picture_there_is_no_place() -> None:
    with pytest.raises(PoseUndetermined, match="fixed target"):
        estimate_extrinsics([], LENS1, COVARIANCE, PLACE)
