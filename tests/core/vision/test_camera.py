"""The camera against OpenCV, its Jacobians against finite differences, and its inverse."""

import cv2
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from service.core.errors import IntrinsicsInvalid
from service.core.vision import lens_pinhole5
from service.core.vision.camera import (
    Intrinsics,
    parameter_names,
    project,
    project_camera_points,
    project_with_jacobians,
    reach_share,
    unproject,
)
from service.core.vision.transforms import rotation_matrix, rotation_vector
from service.core.vision.uncertainty import whole_image
from tests.core.vision.cameras import ALL_ROUND, BOARD, FISHEYE, LENS1, RATIONAL, WIDE, board_poses

CAMERAS = [LENS1, WIDE, RATIONAL, FISHEYE, ALL_ROUND]
PERSPECTIVE = [LENS1, WIDE, RATIONAL]


@pytest.mark.parametrize("camera", PERSPECTIVE)
def test_projection_is_opencvs(camera: Intrinsics) -> None:
    rotations, translations = board_poses(camera, 5, seed=1)
    for R, t in zip(rotations, translations, strict=True):
        expected, _ = cv2.projectPoints(BOARD.object_points, R, t, camera.camera_matrix, camera.dist_coeffs)
        np.testing.assert_allclose(project(camera, R, t, BOARD.object_points), expected[:, 0], atol=1e-9)


@pytest.mark.parametrize("camera", [FISHEYE, ALL_ROUND])
def test_fisheye_projection_is_opencvs(camera: Intrinsics) -> None:
    rotations, translations = board_poses(camera, 5, seed=1)
    for R, t in zip(rotations, translations, strict=True):
        before = (BOARD.object_points @ R.T + t)[:, 2] > 0.001  # OpenCV's stops at 90 degrees
        assert np.any(before)
        points = BOARD.object_points[before][:, None]
        expected, _ = cv2.fisheye.projectPoints(
            points, rotation_vector(R), t, camera.camera_matrix, camera.dist_coeffs
        )
        np.testing.assert_allclose(project(camera, R, t, points[:, 0]), expected[:, 0], atol=1e-9)


@pytest.mark.parametrize("camera", CAMERAS)
def test_projection_with_jacobians_gives_the_same_pixels(camera: Intrinsics) -> None:
    R, t = board_poses(camera, 4, seed=2)
    pixels, _, _ = project_with_jacobians(camera.lens, camera.vector, R, t, BOARD.object_points)
    np.testing.assert_allclose(pixels, project(camera, R, t, BOARD.object_points), atol=1e-10)


@pytest.mark.parametrize("camera", CAMERAS)
def test_the_derivatives_by_the_parameters_are_the_finite_differences(camera: Intrinsics) -> None:
    R, t = board_poses(camera, 3, seed=3)
    _, analytic, _ = project_with_jacobians(camera.lens, camera.vector, R, t, BOARD.object_points)
    for i, step in enumerate([1e-2] * 4 + [1e-5] * len(camera.dist_coeffs)):
        delta = np.zeros(len(camera.vector))
        delta[i] = step
        ahead, behind = (
            project(Intrinsics.from_vector(camera.lens, v, camera.image_size), R, t, BOARD.object_points)
            for v in (camera.vector + delta, camera.vector - delta)
        )
        np.testing.assert_allclose(analytic[..., i], (ahead - behind) / (2 * step), rtol=1e-5, atol=1e-5)


@pytest.mark.parametrize("camera", CAMERAS)
def test_the_derivatives_by_the_pose_are_the_finite_differences(camera: Intrinsics) -> None:
    R, t = board_poses(camera, 3, seed=4)
    _, _, analytic = project_with_jacobians(camera.lens, camera.vector, R, t, BOARD.object_points)
    step = 1e-6
    for i in range(6):
        delta = np.zeros(6)
        delta[i] = step
        ahead, behind = (
            project(camera, rotation_matrix(s * delta[:3]) @ R, t + s * delta[3:], BOARD.object_points)
            for s in (1.0, -1.0)
        )
        np.testing.assert_allclose(analytic[..., i], (ahead - behind) / (2 * step), rtol=1e-6, atol=1e-3)


@pytest.mark.parametrize("camera", CAMERAS)
def test_unproject_inverts_the_projection_all_over_the_image(camera: Intrinsics) -> None:
    pixels = whole_image(camera.image_size).grid(33, 21)
    rays = unproject(camera, pixels)
    assert np.abs(project_camera_points(camera, rays) - pixels).max() < 1e-8
    assert np.all(reach_share(camera, rays) < 1.0)


def test_unproject_converges_in_the_image_corner_where_opencvs_default_does_not() -> None:
    corner = np.array([[WIDE.image_size[0] - 1.0, WIDE.image_size[1] - 1.0]])
    opencv = cv2.undistortPoints(corner, WIDE.camera_matrix, WIDE.dist_coeffs)[:, 0]

    def miss(ray: np.ndarray) -> float:
        return float(np.linalg.norm(project_camera_points(WIDE, ray) - corner[0]))

    assert miss(np.array([*opencv[0], 1.0])) > 0.5
    assert miss(unproject(WIDE, corner)[0]) < 1e-8


@pytest.mark.parametrize("lens", ["pinhole5", "rational8", "kannala_brandt4"])
def test_unproject_says_where_the_lens_does_not_reach(lens: str) -> None:
    folding = Intrinsics.from_parameters(
        lens, {"fx": 600, "fy": 600, "cx": 640, "cy": 400, "k1": -0.3}, (1280, 800)
    )
    rays = unproject(folding, np.array([[640.0, 400.0], [0.0, 0.0]]))
    assert np.all(np.isfinite(rays[0]))
    assert np.all(np.isnan(rays[1]))


def test_a_fisheye_looks_behind_itself() -> None:
    rays = unproject(ALL_ROUND, np.array([[0.0, 0.0], [645.1, 395.7]]))
    assert np.degrees(np.arccos(rays[0, 2])) > 100.0
    np.testing.assert_allclose(rays[1], [0.0, 0.0, 1.0], atol=1e-15)


@settings(max_examples=60, deadline=None)
@given(
    k1=st.floats(-0.4, 0.3),
    k2=st.floats(-0.2, 0.3),
    k3=st.floats(-0.05, 0.1),
    p=st.tuples(st.floats(-0.002, 0.002), st.floats(-0.002, 0.002)),
    angle=st.floats(0, 6.28),
    share=st.floats(0.0, 0.9),
)
def test_a_direction_before_the_fold_comes_back_from_its_pixel(
    k1: float, k2: float, k3: float, p: tuple[float, float], angle: float, share: float
) -> None:
    k = np.array([k1, k2, *p, k3])
    camera = Intrinsics.from_vector("pinhole5", np.r_[900.0, 905.0, 640.0, 400.0, k], (1280, 800))
    radius = share * min(lens_pinhole5.monotone_radius(k), 1.5)
    ray = np.array([radius * np.cos(angle), radius * np.sin(angle), 1.0])
    pixel = project_camera_points(camera, ray)
    np.testing.assert_allclose(unproject(camera, pixel), ray, atol=1e-6)


@settings(max_examples=80, deadline=None)
@given(k1=st.floats(-0.5, 0.5), k2=st.floats(-0.3, 0.3), k3=st.floats(-0.1, 0.1))
def test_the_distorted_radius_grows_up_to_the_monotone_radius_and_not_beyond(
    k1: float, k2: float, k3: float
) -> None:
    k = np.array([k1, k2, 0.0, 0.0, k3])
    limit = lens_pinhole5.monotone_radius(k)
    r = np.linspace(0.0, min(limit, 10.0) * 0.999, 400)
    assert np.all(np.diff(r * (1 + k1 * r**2 + k2 * r**4 + k3 * r**6)) > 0)
    if limit < 10.0:
        slope = 1 + 3 * k1 * limit**2 + 5 * k2 * limit**4 + 7 * k3 * limit**6
        assert abs(slope) < 1e-5 * (1 + limit**6)


def test_points_behind_the_camera_have_no_pixel() -> None:
    assert np.all(np.isnan(project_camera_points(LENS1, np.array([0.1, 0.1, -1.0]))))
    assert np.isinf(reach_share(LENS1, np.array([0.1, 0.1, -1.0])))


def test_parameters_come_back_from_their_names_and_their_vector() -> None:
    assert (
        Intrinsics.from_parameters("pinhole5", WIDE.parameters, WIDE.image_size).parameters == WIDE.parameters
    )
    np.testing.assert_array_equal(
        Intrinsics.from_vector("pinhole5", WIDE.vector, WIDE.image_size).camera_matrix, WIDE.camera_matrix
    )
    assert parameter_names("pinhole5") == ("fx", "fy", "cx", "cy", "k1", "k2", "p1", "p2", "k3")


@pytest.mark.parametrize(
    ("lens", "parameters"),
    [
        ("fisheye99", {"fx": 900, "fy": 900, "cx": 640, "cy": 400}),
        ("pinhole5", {"fx": 900, "fy": 900, "cx": 640}),
        ("pinhole5", {"fx": 900, "fy": 900, "cx": 640, "cy": 400, "k9": 0.1}),
        ("pinhole5", {"fx": -900, "fy": 900, "cx": 640, "cy": 400}),
        ("pinhole5", {"fx": float("nan"), "fy": 900, "cx": 640, "cy": 400}),
    ],
)
def test_impossible_intrinsics_are_refused(lens: str, parameters: dict[str, float]) -> None:
    with pytest.raises(IntrinsicsInvalid):
        Intrinsics.from_parameters(lens, parameters, (1280, 800))
