"""What one live frame showed: the only thing that guidance knows of the world. Not here: how it was found."""

from dataclasses import dataclass

from service.core.vision.camera import Intrinsics
from service.core.vision.live_detection import BoardKind
from service.core.vision.transforms import Array, Pose


@dataclass(frozen=True)
class Observation:
    """What a frame showed, and when.

    at_s: when the frame was taken, on a clock that only goes forward. kind: the whole declared board, a part
    of it, none, or another one. pose: `T_cam_board`; image_points: (n, 2) full-size px in the target's order,
    those of a coded board that are not seen where its pose puts them; both None unless present.
    edge_width_px: 10–90 % width of its edges, full-size px; brightness: mean grey level of its bright
    squares, 0…255, without a board of the frame; glare_share: saturated share of the bright squares; None
    where not measured. sequence: the frame's number; a capture asks for it by that.
    camera: the one that the pose is of, where the nominal one does not explain the corners.
    """

    at_s: float
    kind: BoardKind
    corners_seen: int = 0
    pose: Pose | None = None
    image_points: Array | None = None
    edge_width_px: float | None = None
    brightness: float | None = None
    sequence: int = 0
    glare_share: float | None = None
    camera: Intrinsics | None = None
