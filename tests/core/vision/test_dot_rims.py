from dataclasses import replace

import numpy as np
import pytest

from service.core.vision.circle_cells import read_dots
from service.core.vision.circle_centres import refine_centres
from service.core.vision.circle_grid import find_grid
from service.core.vision.dot_rims import refine_by_rims
from service.core.vision.light import even_out, fit_light
from service.core.vision.sampling import middle_of, smooth
from service.core.vision.target_circles import parse_circles
from service.core.vision.transforms import Array
from service.simulator.renderer import prepare
from service.simulator.scene import Scene, clean_scene, production_scene, true_corners
from tests.simulator.cameras import LENS_1, centred_pose

DOTS = parse_circles("circles:4x7:30mm:15mm")
POSE = centred_pose(DOTS, (30.0, -25.0, 20.0), (0.0, 0.0, 0.48))


def errors(scene: Scene) -> tuple[Array, Array]:
    """Distances (n,), px, from the truth: of rims, and of centroids."""
    image = prepare(scene).render(POSE, np.random.default_rng(4))
    first = find_grid(image, DOTS).centres
    assert first is not None
    light = fit_light(read_dots(smooth(image, 1.0), first, DOTS))
    rough = refine_centres(image.astype(np.float32), light, first, DOTS)
    even, origin = even_out(smooth(image, 0.7), light, rough, margin_px=80)
    points, proven = refine_by_rims(even, rough - origin, DOTS, 1.1, middle_of(image) - origin)
    assert proven.all()
    truth = true_corners(scene, POSE)
    by_rims, by_centroids = (np.linalg.norm(found - truth, axis=1) for found in (points + origin, rough))
    return by_rims, by_centroids


@pytest.mark.parametrize("seed", [1, 2])
def test_a_lamp_beside_the_lens_does_not_move_them_as_it_moves_centroids(seed: int) -> None:
    by_rims, by_centroids = errors(production_scene(LENS_1, DOTS, seed))
    assert np.sqrt(np.mean(by_rims**2)) < 0.012
    assert by_rims.max() < 0.04
    assert np.sqrt(np.mean(by_rims**2)) < 0.6 * np.sqrt(np.mean(by_centroids**2))


def test_in_even_light_large_slanting_dots_have_no_bias() -> None:
    by_rims, _ = errors(replace(clean_scene(LENS_1, DOTS), noise_grey=0.0))
    assert by_rims.max() < 0.02


def test_dots_that_grew_in_print_have_the_same_centres() -> None:
    declared = replace(DOTS, diameter_m=DOTS.diameter_m - 0.0006)
    scene = clean_scene(LENS_1, DOTS)
    image = prepare(scene).render(POSE, np.random.default_rng(4))
    first = find_grid(image, declared).centres
    assert first is not None
    grown = smooth(image, 0.7) / np.float32(255.0)
    points, proven = refine_by_rims(grown, first, declared, 1.0, middle_of(image))
    assert proven.all()
    assert np.linalg.norm(points - true_corners(scene, POSE), axis=1).max() < 0.05


def test_where_there_is_no_rim_the_start_comes_back() -> None:
    noise = np.random.default_rng(1).normal(0.5, 0.01, (800, 1280)).astype(np.float32)
    start = true_corners(clean_scene(LENS_1, DOTS), POSE)
    points, proven = refine_by_rims(noise, start, DOTS, 1.0, middle_of(noise))
    assert points[~proven].tolist() == start[~proven].tolist()
    assert not proven.all()
