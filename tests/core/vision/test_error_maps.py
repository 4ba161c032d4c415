"""Errors over the image, against figures of zones, against drawn parameters and against sums by hand."""

import numpy as np
import pytest

from service.core.planning.pose_space import PoseSpace, sample_poses
from service.core.planning.prediction import predict_accuracy
from service.core.vision.camera import Intrinsics, project, unproject
from service.core.vision.error_maps import measure_residuals, predict_map
from service.core.vision.image_grid import ImageGrid
from service.core.vision.transforms import Array, rotation_matrix
from service.core.vision.uncertainty import GRID, Region, mapping_error
from tests.core.planning.cameras import BOARD, LENS1, LENS2

POSES = sample_poses(PoseSpace(), LENS1, BOARD, 10, seed=5)
ZONE = Region(192.0, 120.0, 1087.0, 679.0)


def test_the_map_has_the_zones_own_figures_where_the_zone_is() -> None:
    covariance = predict_accuracy(LENS1, BOARD, POSES, 0.1, ZONE).covariance
    cells = ImageGrid(LENS1.image_size, columns=320)

    found = predict_map(LENS1, covariance, cells, ZONE)

    promised = mapping_error(LENS1, covariance, ZONE)
    at = np.argmin(np.linalg.norm(cells.centres[:, None] - ZONE.grid(*GRID), axis=-1), axis=0)
    values = found.sd_px.ravel()[at]
    assert np.sqrt(np.mean(values**2)) == pytest.approx(promised.mean_px, rel=0.01)
    assert values.max() == pytest.approx(promised.worst_px, rel=0.02)


def test_the_angle_is_the_one_between_the_rays_of_the_moved_pixels() -> None:
    rng = np.random.default_rng(7)
    covariance = np.diag(np.r_[np.full(4, 1e-2), np.full(5, 1e-6)])
    cells = ImageGrid(LENS1.image_size, columns=8)
    found = predict_map(LENS1, covariance, cells, ZONE)
    rays = unproject(LENS1, cells.centres)
    held = unproject(LENS1, ZONE.grid(*GRID))

    squares = []
    for delta in rng.multivariate_normal(np.zeros(9), covariance, size=400):
        other = Intrinsics.from_vector("pinhole5", LENS1.vector + delta, LENS1.image_size)
        R = _best_turn(LENS1, other, held)
        moved = project(other, R, np.zeros(3), rays)
        back = unproject(LENS1, moved)
        cosine = np.sum(rays * back, axis=1) / np.linalg.norm(rays, axis=1) / np.linalg.norm(back, axis=1)
        squares.append(np.rad2deg(np.arccos(np.minimum(cosine, 1.0))) ** 2)
    np.testing.assert_allclose(1e3 * np.sqrt(np.mean(squares, axis=0)), found.sd_mdeg.ravel(), rtol=0.15)


def _best_turn(camera: Intrinsics, other: Intrinsics, rays: Array) -> Array:
    """The small rotation after which the other camera sees rays nearest to where this one does."""
    wanted = project(camera, np.eye(3), np.zeros(3), rays)
    R: Array = np.eye(3)
    for _ in range(3):
        seen = project(other, R, np.zeros(3), rays)
        turned = [project(other, rotation_matrix(1e-6 * axis) @ R, np.zeros(3), rays) for axis in np.eye(3)]
        J = np.stack([(one - seen).ravel() / 1e-6 for one in turned], axis=-1)
        step: Array = np.asarray(np.linalg.lstsq(J, (wanted - seen).ravel(), rcond=None)[0], dtype=np.float64)
        R = rotation_matrix(step) @ R
    return R


def test_where_the_lens_does_not_reach_nothing_is_promised() -> None:
    folding = Intrinsics.from_vector(
        "pinhole5", LENS2.vector + np.r_[np.zeros(5), -0.1398, 0, 0, 0], LENS2.image_size
    )
    cells = ImageGrid(folding.image_size)

    found = predict_map(folding, np.eye(9) * 1e-8, cells, Region(500, 400, 1400, 900))

    assert np.isnan(found.sd_px[0, 0])
    assert np.isfinite(found.sd_px[12, 20])
    np.testing.assert_array_equal(np.isnan(found.sd_px), np.isnan(found.sd_mdeg))


def test_residuals_are_pooled_in_the_cell_of_their_corner() -> None:
    corners = np.array([[3.0, 3.0], [5.0, 4.0], [1279.0, 799.0]])
    residuals = np.array([[0.3, 0.4], [0.0, 0.1], [-0.2, 0.0]])

    found = measure_residuals(corners, residuals, ImageGrid((1280, 800), columns=8))

    assert found.rms_px[0, 0] == pytest.approx(np.sqrt((0.25 + 0.01) / 2))
    assert found.rms_px[-1, -1] == pytest.approx(0.2)
    assert (found.corners.sum(), np.isnan(found.rms_px).sum()) == (3, 8 * 5 - 2)
