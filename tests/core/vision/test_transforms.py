"""Rotations and poses against their definitions and against OpenCV."""

import cv2
import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from service.core.vision.transforms import (
    Pose,
    angle_between,
    compose,
    invert,
    pose_from_matrix,
    rotation_matrix,
    rotation_vector,
    skew,
    stack_poses,
)

components = st.floats(-1.8, 1.8, allow_subnormal=False)
vectors = st.tuples(components, components, components).map(np.array)
poses = st.builds(Pose, vectors, vectors)


def test_a_rotation_matrix_is_opencvs_rodrigues() -> None:
    for rvec in np.random.default_rng(1).normal(size=(20, 3)):
        np.testing.assert_allclose(rotation_matrix(rvec), cv2.Rodrigues(rvec)[0], atol=1e-14)


@given(vectors)
def test_a_rotation_vector_below_half_a_turn_comes_back(rvec: np.ndarray) -> None:
    length = float(np.linalg.norm(rvec))
    rvec = rvec if length < 3.1 else rvec * (3.1 / length)
    np.testing.assert_allclose(rotation_vector(rotation_matrix(rvec)), rvec, atol=1e-12)


def test_half_a_turn_about_any_axis_comes_back_up_to_its_sign() -> None:
    for axis in np.vstack([np.eye(3), np.random.default_rng(2).normal(size=(10, 3))]):
        rvec = np.pi * axis / np.linalg.norm(axis)
        back = rotation_vector(rotation_matrix(rvec))
        assert min(np.abs(back - rvec).max(), np.abs(back + rvec).max()) < 1e-7


@given(poses, poses)
def test_composing_poses_multiplies_their_matrices(a: Pose, b: Pose) -> None:
    np.testing.assert_allclose(compose(a, b).matrix, a.matrix @ b.matrix, atol=1e-12)


@given(poses)
def test_a_pose_and_its_inverse_cancel(pose: Pose) -> None:
    np.testing.assert_allclose(compose(pose, invert(pose)).matrix, np.eye(4), atol=1e-12)
    np.testing.assert_allclose(pose_from_matrix(pose.matrix).matrix, pose.matrix, atol=1e-12)


def test_a_skew_matrix_is_the_cross_product() -> None:
    a, b = np.random.default_rng(3).normal(size=(2, 5, 3))
    np.testing.assert_allclose((skew(a) @ b[..., None])[..., 0], np.cross(a, b), atol=1e-15)


def test_the_angle_between_rotations_is_that_of_the_turn_between_them() -> None:
    R = rotation_matrix(np.array([0.3, -1.0, 0.2]))
    turned = R @ rotation_matrix(np.array([0.0, 0.25, 0.0]))
    assert abs(float(angle_between(R, turned)) - 0.25) < 1e-12


def test_stacked_poses_keep_their_order() -> None:
    a, b = (
        Pose(np.array([0.1, 0, 0]), np.array([1.0, 2, 3])),
        Pose(np.array([0, 0.2, 0]), np.array([4.0, 5, 6])),
    )
    rotations, translations = stack_poses([a, b])
    np.testing.assert_array_equal(rotations, [a.rotation, b.rotation])
    np.testing.assert_array_equal(translations, [a.tvec, b.tvec])
