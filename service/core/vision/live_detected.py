"""What a live frame shows of a target. Not here: how it is found (`live_detection`, `live_coded`)."""

from dataclasses import dataclass
from typing import Literal

from service.core.vision.transforms import Array

LIVE_SCALE = 2  # full-size pixels per pixel in which a live frame is looked at

BoardKind = Literal["present", "partial", "absent", "wrong"]


@dataclass(frozen=True)
class LiveDetection:
    """What a live frame shows.

    kind: "present" (the whole target, or as much of a coded one as a capture needs), "partial" (a part of a
    board, or one that is covered), "wrong" (a larger board, or one of other markers) or "absent".
    image_points: (n, 2) in full-size px and the target's order, NaN where a coded board's corner is not seen;
    None unless present.
    corners_seen: on the board or on the part of it.
    edge_width_px: 10–90 %, full-size px, a cheap estimate; None unless present.
    brightness: grey level of the bright squares of the board; without one, mean of the frame.
    glare_share: saturated share of the bright squares; None unless present.
    """

    kind: BoardKind
    image_points: Array | None
    corners_seen: int
    edge_width_px: float | None
    brightness: float
    glare_share: float | None = None
