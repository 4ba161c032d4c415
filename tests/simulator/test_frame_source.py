"""A virtual camera: its hand sees the hints only, and a capture is the very pose that a frame showed."""

from functools import lru_cache

import numpy as np
import pytest

from service.core.guidance.actions import CaptureFrame, Frame
from service.core.guidance.comparison import default_tolerances
from service.core.guidance.hints import Hint, ShownHint
from service.core.guidance.observation import Observation
from service.core.guidance.problems import FrameForgotten
from service.core.guidance.session import step
from service.core.guidance.session_poses import start_session
from service.core.guidance.session_state import GuidanceSettings
from service.core.guidance.session_view import view
from service.core.vision.detection import detect_target
from service.core.vision.live_detection import detect_live
from service.core.vision.pose import estimate_pose
from service.core.vision.transforms import Pose, angle_between
from service.simulator.frame_source import LiveFrame, VirtualSource, make_virtual_source
from service.simulator.live_renderer import LiveRenderer
from service.simulator.operator import Habits, Hand
from service.simulator.renderer import PreparedScene, prepare
from service.simulator.scene import production_scene, true_corners
from tests.simulator.cameras import BOARD, LENS_1, centred_pose

SCENE = production_scene(LENS_1, BOARD, seed=5)


class Carousel:
    """Moves the board by 2 mm per step and remembers what it was told."""

    def __init__(self) -> None:
        self.told: list[tuple[tuple[ShownHint, ...], float]] = []

    def step(self, hints: tuple[ShownHint, ...], dt_s: float, rng: np.random.Generator) -> Pose:
        self.told.append((hints, dt_s))
        return centred_pose(BOARD, (10, -15, 5), (0.002 * len(self.told), 0.0, 0.5))


@lru_cache
def _ready() -> tuple[PreparedScene, LiveRenderer]:
    return prepare(SCENE), LiveRenderer(SCENE)


def _source(hand: Carousel | Hand | None = None, seed: int = 1) -> VirtualSource:
    return VirtualSource(*_ready(), hand or Carousel(), np.random.default_rng(seed))


def test_a_frame_shows_the_board_where_the_hand_holds_it() -> None:
    source = _source()
    for _ in range(3):
        frame = source.next_frame((), 0.05)
        detection = detect_live(frame.image, BOARD, scale=frame.scale)
        assert detection.image_points is not None
        truth = true_corners(SCENE, source.pose_of(frame.sequence))
        assert np.abs(detection.image_points - truth).max() < 0.5


def test_a_capture_is_the_exact_picture_of_the_pose_that_was_judged() -> None:
    source = _source()
    judged = source.next_frame((), 0.05).sequence
    for _ in range(20):
        source.next_frame((), 0.05)
    image = source.capture(judged)
    assert image.shape == (800, 1280)
    points = detect_target(image, BOARD).image_points
    assert np.abs(points - true_corners(SCENE, source.pose_of(judged))).max() < 0.1
    assert np.abs(points - true_corners(SCENE, source.pose_of(judged + 1))).mean() > 2.0


def test_frames_are_numbered_and_timed_and_the_hand_is_told_what_the_screen_shows() -> None:
    hand = Carousel()
    source = _source(hand)
    hints = (ShownHint(Hint.MOVE_LEFT, 0.5),)
    frames = [source.next_frame((), 0.05), source.next_frame(hints, 0.1)]
    assert [frame.sequence for frame in frames] == [1, 2]
    assert [frame.at_s for frame in frames] == pytest.approx([0.05, 0.15])
    assert hand.told == [((), 0.05), (hints, 0.1)]


def test_a_frame_is_forgotten_after_two_seconds_and_one_that_never_was_is_unknown() -> None:
    source = _source()
    for _ in range(6):
        source.next_frame((), 0.5)
    assert source.capture(2).shape == (800, 1280)
    for sequence in (1, 0, 7):
        with pytest.raises(FrameForgotten):
            source.capture(sequence)
    source.next_frame((), 60.0)
    with pytest.raises(FrameForgotten):
        source.capture(6)
    assert source.capture(7).shape == (800, 1280)


def test_a_capture_does_not_change_the_frames_that_follow() -> None:
    sources = [_source(Hand(BOARD)), _source(Hand(BOARD))]
    firsts = [source.next_frame((), 0.05) for source in sources]
    sources[0].capture(firsts[0].sequence)
    later = [source.next_frame((), 0.05) for source in sources]
    np.testing.assert_array_equal(later[0].image, later[1].image)


def test_a_source_made_from_a_scene_shows_that_scene() -> None:
    source = make_virtual_source(SCENE, Carousel(), np.random.default_rng(1))
    np.testing.assert_array_equal(source.next_frame((), 0.05).image, _source().next_frame((), 0.05).image)


def test_a_hand_that_obeys_the_hints_of_live_frames_brings_the_board_into_the_pose() -> None:
    source = _source(Hand(BOARD, habits=Habits(lapses_per_s=0.0)))
    settings = GuidanceSettings(LENS_1, BOARD, default_tolerances(LENS_1.image_size))
    wanted = centred_pose(BOARD, (15, -20, 10), (0.06, -0.02, 0.45))
    state = start_session([wanted])
    captured = None
    for _ in range(400):
        frame = source.next_frame(view(state, settings).hints, 0.05)
        state, effects = step(state, Frame(_observe(frame)), settings)
        captured = next((effect.sequence for effect in effects if isinstance(effect, CaptureFrame)), None)
        if captured is not None:
            break
    assert captured is not None
    held = source.pose_of(captured)
    assert np.degrees(angle_between(held.rotation, wanted.rotation)) < 12.0
    outer = list(BOARD.outer_corners)
    apart = true_corners(SCENE, held)[outer] - true_corners(SCENE, wanted)[outer]
    assert np.linalg.norm(apart, axis=1).mean() < 0.03 * 1280


def _observe(frame: LiveFrame) -> Observation:
    found = detect_live(frame.image, BOARD, scale=frame.scale)
    pose = None
    if found.image_points is not None:
        pose = estimate_pose(LENS_1, BOARD.object_points, found.image_points).pose
    return Observation(
        frame.at_s,
        found.kind,
        found.corners_seen,
        pose,
        found.image_points,
        found.edge_width_px,
        found.brightness,
        frame.sequence,
    )
