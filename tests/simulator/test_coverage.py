import numpy as np
import pytest

from service.simulator.coverage import Steps, half_plane_area, integrate_product, quarter_plane_area


def test_a_line_through_the_centre_halves_the_pixel_whatever_its_direction() -> None:
    angles = np.linspace(0.0, 2.0 * np.pi, 73)
    normals = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    np.testing.assert_allclose(half_plane_area(np.zeros(73), normals), 0.5, atol=1e-9)


def test_an_upright_edge_covers_as_much_as_it_has_moved_in() -> None:
    offsets = np.array([-0.6, -0.5, -0.2, 0.0, 0.3, 0.5, 0.6])
    areas = half_plane_area(offsets, np.tile([1.0, 0.0], (7, 1)))
    np.testing.assert_allclose(areas, [0.0, 0.0, 0.3, 0.5, 0.8, 1.0, 1.0], atol=1e-6)


def test_a_corner_cut_off_diagonally_is_a_triangle() -> None:
    area = half_plane_area(np.array([-0.7]), np.array([[1.0, 1.0]]))
    np.testing.assert_allclose(area, 0.5 * 0.3**2, atol=1e-12)


def test_a_quarter_plane_with_its_tip_in_the_pixel_has_the_area_of_its_rectangle() -> None:
    area = quarter_plane_area(np.array([[-0.1, 0.2]]), np.array([[[1.0, 0.0], [0.0, 1.0]]]))
    np.testing.assert_allclose(area, 0.4 * 0.7, atol=1e-12)


def test_quarter_planes_agree_with_counting_points() -> None:
    rng = np.random.default_rng(7)
    offsets, gradients = rng.uniform(-0.7, 0.7, (200, 2)), rng.normal(size=(200, 2, 2))
    points = rng.uniform(-0.5, 0.5, (4000, 2))
    levels = offsets[:, None] + np.einsum("kj,nij->nki", points, gradients)
    counted = np.mean(np.all(levels > 0, axis=2), axis=1)
    np.testing.assert_allclose(quarter_plane_area(offsets, gradients), counted, atol=0.04)


def test_a_quarter_plane_and_its_neighbour_make_a_half_plane() -> None:
    rng = np.random.default_rng(8)
    offsets, gradients = rng.uniform(-0.7, 0.7, (500, 2)), rng.normal(size=(500, 2, 2))
    mirrored = np.array([1.0, -1.0])
    both = quarter_plane_area(offsets, gradients)
    beside = quarter_plane_area(offsets * mirrored, gradients * mirrored[:, None])
    np.testing.assert_allclose(both + beside, half_plane_area(offsets[:, 0], gradients[:, 0]), atol=1e-6)


@pytest.mark.parametrize("shift", [0.0, 0.013, 0.4])
def test_a_product_of_steps_is_the_product_of_its_means_when_edges_lie_along_the_axes(shift: float) -> None:
    wave = Steps(np.array([-1.0, 0.0, 1.0]), np.array([0.0, 1.0, -1.0, 0.0]))
    box = Steps(np.array([-1.0, 1.0]), np.array([0.0, 1.0, 0.0]))
    uv, jacobian = np.array([[shift * 0.5, 0.9 + shift]]), np.array([[[0.5, 0.0], [0.0, 0.8]]])
    mean_wave = -np.clip(2.0 * shift, -1.0, 1.0)
    mean_box = np.clip((1.0 - (0.9 + shift - 0.4)) / 0.8, 0.0, 1.0)
    mean = integrate_product(wave, box, uv, jacobian)
    np.testing.assert_allclose(mean, mean_wave * mean_box, atol=1e-5)
