"""A virtual board that a person moves: where it goes, and where it does not."""

import numpy as np
import pytest

from service.core.guidance.comparison import compare_pose
from service.core.vision.camera import Intrinsics, project
from service.core.vision.target_chessboard import Chessboard
from service.core.vision.transforms import Array, Pose
from service.ports import BoardMove
from service.simulator.held_board import FARTHEST_M, HeldBoard
from service.usecases.guide_moves import BoardMoves

TARGET = Chessboard(9, 6, 0.025)
CAMERA = Intrinsics.from_parameters(
    "pinhole5", {"fx": 1350.0, "fy": 1352.0, "cx": 650.0, "cy": 390.0}, (1280, 800)
)
RNG = np.random.default_rng(0)


class Held:
    """A board with its moves."""

    def __init__(self) -> None:
        self.moves = BoardMoves()
        self.board = HeldBoard(CAMERA, TARGET, self.moves.take)

    def after(self, *moves: BoardMove) -> Pose:
        for move in moves:
            self.moves.put(move)
        return self.board.step((), 0.04, RNG)


def centre_px(pose: Pose) -> Array:
    return np.asarray(project(CAMERA, pose.rotation, pose.tvec, TARGET.centre[None])[0])


def test_the_board_follows_the_pointer_by_as_many_px() -> None:
    held = Held()
    before = centre_px(held.after())

    assert centre_px(held.after(BoardMove(right_px=60.0, down_px=-25.0))) - before == pytest.approx(
        [60.0, -25.0], abs=0.01
    )


def test_what_a_difference_says_brings_the_board_there() -> None:
    held = Held()
    wanted = Pose(np.array([0.3, -0.2, 0.1]), np.array([-0.05, -0.02, 0.5]))
    for _ in range(4):
        left = compare_pose(wanted, held.after(), CAMERA, TARGET)
        held.moves.put(
            BoardMove(
                left.right_px, left.down_px, left.closer_share, left.tilt_rad, left.turn_rad, left.roll_rad
            )
        )

    assert compare_pose(wanted, held.after(), CAMERA, TARGET).corner_px < 1.0


@pytest.mark.parametrize(
    "move",
    [
        BoardMove(right_px=5000.0),
        BoardMove(down_px=-5000.0),
        BoardMove(closer_share=1000.0),
        BoardMove(closer_share=-0.999),
        BoardMove(turn_rad=np.pi / 2),
        BoardMove(tilt_rad=np.pi),
    ],
)
def test_what_would_take_the_board_away_is_not_done(move: BoardMove) -> None:
    held = Held()
    before = held.after()
    after = held.after(move)

    assert after.tvec == pytest.approx(before.tvec)
    assert after.rvec == pytest.approx(before.rvec)


def test_moves_between_two_frames_add_up() -> None:
    near = BoardMove(closer_share=0.1, roll_rad=0.2, right_px=3.0)
    at_once, one_by_one = Held(), Held()
    together = at_once.after(near, near)
    one_by_one.after(near)

    assert together.rvec == pytest.approx(one_by_one.after(near).rvec)
    assert together.tvec[2] == pytest.approx(one_by_one.after().tvec[2], abs=1e-3)
    assert together.tvec[2] < FARTHEST_M
