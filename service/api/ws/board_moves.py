"""The message by which a person moves a virtual board, and how far one message may move it.

Not here: what waits between two frames (`service.usecases.guide_moves`), and what a move does to the board.
"""

from math import radians
from typing import Literal

from pydantic import Field

from service.api.shapes import Request
from service.ports import BoardMove


class MoveBoard(Request):
    """Move the virtual board of a station with the source `virtual:mouse`; moves add up until the next frame.

    Directions and angles are those of the raw image, as in `Difference`. What would take the board's centre
    out of the picture, or its face away from the camera, is not done.
    """

    type: Literal["move_board"]
    right_px: float = Field(default=0.0, ge=-10_000, le=10_000, allow_inf_nan=False)
    down_px: float = Field(default=0.0, ge=-10_000, le=10_000, allow_inf_nan=False)
    closer_share: float = Field(
        default=0.0, ge=-0.5, le=1.0, description="Its distance is divided by 1 + this.", allow_inf_nan=False
    )
    tilt_deg: float = Field(default=0.0, ge=-90, le=90, allow_inf_nan=False)
    turn_deg: float = Field(default=0.0, ge=-90, le=90, allow_inf_nan=False)
    roll_deg: float = Field(default=0.0, ge=-180, le=180, allow_inf_nan=False)

    def to_move(self) -> BoardMove:
        """Return the move in the simulator's units."""
        return BoardMove(
            right_px=self.right_px,
            down_px=self.down_px,
            closer_share=self.closer_share,
            tilt_rad=radians(self.tilt_deg),
            turn_rad=radians(self.turn_deg),
            roll_rad=radians(self.roll_deg),
        )
