import numpy as np
import pytest

from service.core.planning.information import CHUNK, pose_information
from service.core.planning.pose_space import Poses, PoseSpace, sample_poses
from service.core.vision.camera import Intrinsics, project
from service.core.vision.transforms import Array, rotation_matrix
from tests.core.planning.cameras import BOARD, LENS1, LENS2


def numeric_information(intrinsics: Intrinsics, poses: Poses, sigma_px: float) -> Array:
    """Return Λ of one pose from central differences and the full 15 x 15 normal matrix."""
    R, t = poses.rotations[0], poses.translations[0]

    def image(delta: Array) -> Array:
        turned = rotation_matrix(delta[9:12]) @ R
        moved = Intrinsics.from_vector(intrinsics.lens, intrinsics.vector + delta[:9], intrinsics.image_size)
        return project(moved, turned, t + delta[12:], BOARD.object_points).ravel()

    steps = np.array([1e-3] * 4 + [1e-5] * 5 + [1e-6] * 6)
    J = np.stack(
        [(image(e) - image(-e)) / (2 * h) for e, h in zip(np.diag(steps), steps, strict=True)], axis=1
    )
    full = J.T @ J / sigma_px**2
    schur: Array = full[:9, :9] - full[:9, 9:] @ np.linalg.inv(full[9:, 9:]) @ full[9:, :9]
    return schur


@pytest.mark.parametrize("intrinsics", [LENS1, LENS2], ids=["lens1", "lens2"])
def test_information_is_the_schur_complement_of_the_numeric_normal_equations(intrinsics: Intrinsics) -> None:
    poses = sample_poses(PoseSpace(), intrinsics, BOARD, 1, seed=5)
    ours, numeric = (
        pose_information(intrinsics, BOARD, poses, 0.1)[0],
        numeric_information(intrinsics, poses, 0.1),
    )
    scale = np.sqrt(np.diagonal(numeric))
    np.testing.assert_allclose(ours / np.outer(scale, scale), numeric / np.outer(scale, scale), atol=1e-5)


def test_information_is_symmetric_and_never_negative() -> None:
    information = pose_information(LENS1, BOARD, sample_poses(PoseSpace(), LENS1, BOARD, 100, seed=2))
    np.testing.assert_array_equal(information, np.swapaxes(information, 1, 2))
    scale = 1.0 / np.sqrt(np.diagonal(information.mean(axis=0)))
    assert np.linalg.eigvalsh(information * np.outer(scale, scale)).min() > -1e-9


def test_twice_the_noise_is_a_quarter_of_the_information_pose_by_pose() -> None:
    poses = sample_poses(PoseSpace(), LENS1, BOARD, 3, seed=2)
    one, mixed = (pose_information(LENS1, BOARD, poses, sigma) for sigma in (0.1, np.array([0.1, 0.2, 0.1])))
    np.testing.assert_allclose(mixed, one / np.array([1.0, 4.0, 1.0])[:, None, None])


def test_chunks_do_not_show() -> None:
    poses = sample_poses(PoseSpace(), LENS1, BOARD, CHUNK + 3, seed=2)
    whole = pose_information(LENS1, BOARD, poses)
    np.testing.assert_allclose(whole[CHUNK:], pose_information(LENS1, BOARD, poses[CHUNK:]), rtol=1e-12)


def test_a_single_frontal_pose_cannot_tell_focal_length_from_distance() -> None:
    frontal = Poses(np.eye(3)[None], np.array([[0.0, 0.0, 0.4]]) - BOARD.centre)
    information = pose_information(LENS1, BOARD, frontal)[0]
    scale = 1.0 / np.sqrt(np.diagonal(information))
    assert np.linalg.cond(information * np.outer(scale, scale)) > 1e10
