"""A board that looks the same turned by half is led to every pose, also to one that lies the other way."""

from dataclasses import replace

import numpy as np
import pytest

from service.core.guidance.actions import CaptureFrame, Frame
from service.core.guidance.comparison import default_tolerances
from service.core.guidance.feature_order import in_order_of
from service.core.guidance.observation import Observation
from service.core.guidance.session import step
from service.core.guidance.session_poses import start_session
from service.core.guidance.session_state import GuidanceSettings
from service.core.guidance.session_view import view
from service.core.vision.camera import project
from service.core.vision.half_turn import turn_by_half
from service.core.vision.target import Target, parse_target
from service.core.vision.transforms import Pose, rotation_matrix, rotation_vector
from tests.simulator.cameras import LENS_1, centred_pose

DOTS = parse_target("circles:4x8:20mm:10mm")
BOARDS = pytest.mark.parametrize("spec", ["circles:4x8:20mm:10mm", "chessboard:8x6:25mm"])


def rolled(target: Target, degrees: float) -> Pose:
    return centred_pose(target, (12.0, -8.0, degrees), (0.02, 0.01, 0.6))


def seen_by_detector(target: Target, pose: Pose, at_s: float = 0.0) -> Observation:
    """What a frame shows of a board at a pose: its x axis points to the right, however it is held."""
    points = project(LENS_1, pose.rotation, pose.tvec, target.object_points)
    if points[target.columns - 1, 0] < points[0, 0]:
        pose, points = turn_by_half(pose, target), points[::-1]
    return Observation(at_s, "present", len(points), pose, points, 1.5, 180.0, round(at_s * 100))


def roll_off(expected: Pose, seen: Pose) -> float:
    """How far a seen board must be rolled, degrees."""
    return float(np.degrees(rotation_vector(expected.rotation @ seen.rotation.T)[2]))


@BOARDS
@pytest.mark.parametrize("roll", [0.0, 60.0, 89.0, 91.0, 120.0, 180.0, -95.0, -150.0])
def test_a_pose_at_any_roll_is_captured_when_the_board_lies_there_either_way_up(
    spec: str, roll: float
) -> None:
    target = parse_target(spec)
    wanted = rolled(target, roll)
    settings = GuidanceSettings(LENS_1, target, default_tolerances(LENS_1.image_size))
    for held in (wanted, turn_by_half(wanted, target)):
        state, asked = start_session((wanted,)), list[object]()
        for number in range(15):
            state, effects = step(state, Frame(seen_by_detector(target, held, 0.05 * number)), settings)
            asked += effects
            assert view(state, settings).match == 1.0
        assert [type(one) for one in asked] == [CaptureFrame]


def test_hints_lead_the_shorter_way_round() -> None:
    wanted = rolled(DOTS, 150.0)
    for roll, off in ((130.0, 20.0), (170.0, -20.0), (-10.0, -20.0), (-50.0, 20.0)):
        seen = in_order_of(wanted, seen_by_detector(DOTS, rolled(DOTS, roll)), None, DOTS)
        assert seen.pose is not None
        assert roll_off(wanted, seen.pose) == pytest.approx(off, abs=6.0)
        assert seen.image_points is not None
        told = project(LENS_1, seen.pose.rotation, seen.pose.tvec, DOTS.object_points)
        assert seen.image_points == pytest.approx(told, abs=1e-6)


def test_a_board_that_lies_across_keeps_the_order_of_the_frame_before() -> None:
    """Or each frame would call for the other way round."""
    wanted = rolled(DOTS, 0.0)
    before: Observation | None = None
    offs = []
    for roll in (88.0, 91.0, 89.0, 92.0, 94.0, 96.0, 90.0, 70.0):
        before = in_order_of(wanted, seen_by_detector(DOTS, rolled(DOTS, roll)), before, DOTS)
        assert before.pose is not None
        offs.append(roll_off(wanted, before.pose))
    assert np.all(np.array(offs) < 0.0)

    far = in_order_of(wanted, seen_by_detector(DOTS, rolled(DOTS, 125.0)), before, DOTS)
    assert far.pose is not None
    assert roll_off(wanted, far.pose) > 0.0


def test_a_board_that_tells_its_ends_apart_is_left_as_it_is_seen() -> None:
    grid = parse_target("circles:4x11:20mm:10mm")
    upside = Pose(rotation_vector(rotation_matrix(np.array([0.0, 0.0, np.pi]))), np.array([0.0, 0.0, 0.6]))
    points = project(LENS_1, upside.rotation, upside.tvec, grid.object_points)
    seen = Observation(0.0, "present", len(points), upside, points)

    assert in_order_of(rolled(grid, 0.0), seen, None, grid) is seen
    nothing = replace(seen, kind="partial", pose=None, image_points=None)
    assert in_order_of(rolled(DOTS, 0.0), nothing, None, DOTS) is nothing
