"""The moves of a virtual board that a person makes on a screen, summed until the next frame is drawn.

So the newest frame always shows all of them, however many came between two frames. Not here: what a move does
to the board (the simulator), and messages.
"""

import threading

from service.ports import BoardMove


class BoardMoves:
    """Moves that wait for the next frame; put and taken by different threads."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._sum: BoardMove | None = None

    def put(self, move: BoardMove) -> None:
        """Add a move to those that wait."""
        with self._lock:
            self._sum = move if self._sum is None else _joined(self._sum, move)

    def take(self) -> BoardMove | None:
        """Return the sum of the moves since it was last asked for; None without any."""
        with self._lock:
            taken, self._sum = self._sum, None
        return taken


def _joined(first: BoardMove, second: BoardMove) -> BoardMove:
    return BoardMove(
        right_px=first.right_px + second.right_px,
        down_px=first.down_px + second.down_px,
        closer_share=(1.0 + first.closer_share) * (1.0 + second.closer_share) - 1.0,
        tilt_rad=first.tilt_rad + second.tilt_rad,
        turn_rad=first.turn_rad + second.turn_rad,
        roll_rad=first.roll_rad + second.roll_rad,
    )
