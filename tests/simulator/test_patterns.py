"""Patterns of every kind: shares that are exact against many samples, and live frames close to exact ones."""

import cv2
import numpy as np
import pytest

from service.core.errors import SceneInvalid
from service.core.vision.printed import Area
from service.core.vision.target import parse_target
from service.simulator.board import make_plate
from service.simulator.live_renderer import LiveRenderer
from service.simulator.pattern_cells import make_cells
from service.simulator.renderer import prepare
from service.simulator.scene import production_scene
from tests.simulator.cameras import LENS_1, centred_pose

SPECS = (
    "chessboard:9x6:25mm",
    "charuco:5x4:25mm:18mm:4x4_250",
    "aprilgrid:3x3:40mm:0.3",
    "circles:4x7:20mm:11mm",
)
SAMPLES = 96


@pytest.mark.parametrize("spec", SPECS)
def test_the_dark_share_of_a_pixel_is_that_of_many_samples(spec: str) -> None:
    rng = np.random.default_rng(2)
    target = parse_target(spec)
    plate = make_plate(target, 0.6)
    low, high = (target.outline[i, :2] / target.square_m for i in (0, 2))
    uv = rng.uniform(low - 0.3, high + 0.3, (400, 2))
    jacobian = 0.6 * plate.pattern.finest * rng.uniform(-1.0, 1.0, (400, 2, 2))
    _, dark = plate.shares(uv, jacobian)

    ticks = (np.arange(SAMPLES) + 0.5) / SAMPLES - 0.5
    pixel = np.stack(np.meshgrid(ticks, ticks), axis=-1).reshape(-1, 2)
    sampled = [plate.pattern.sample(at + pixel @ J.T).mean() for at, J in zip(uv, jacobian, strict=True)]
    assert np.count_nonzero((dark > 0.01) & (dark < 0.99)) > 5
    np.testing.assert_allclose(dark, sampled, atol=0.02)


@pytest.mark.parametrize("spec", SPECS)
def test_a_live_frame_is_the_exact_picture_at_half_size(spec: str) -> None:
    target = parse_target(spec)
    scene = production_scene(LENS_1, target)
    pose = centred_pose(target, (15.0, -20.0, 30.0), (0.0, 0.0, 0.5))
    exact = prepare(scene).render(pose, np.random.default_rng(1))
    live = LiveRenderer(scene).frame(pose, np.random.default_rng(1))
    half = cv2.resize(exact, (live.shape[1], live.shape[0]), interpolation=cv2.INTER_AREA)
    assert np.abs(half.astype(float) - live).mean() < 3.0


def test_a_pattern_with_slanted_sides_cannot_be_drawn() -> None:
    with pytest.raises(SceneInvalid, match="upright"):
        make_cells([Area((np.array([[0.0, 0.0], [1.0, 0.5], [0.0, 1.0]]),))], 1.0)
