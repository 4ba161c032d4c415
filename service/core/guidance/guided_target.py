"""Which targets can be guided: those that are found in live frames. Not here: how (`live_detection`)."""

from service.core.guidance.problems import TargetNotGuided
from service.core.vision.live_detection import LiveTarget
from service.core.vision.target import Target
from service.core.vision.target_aprilgrid import AprilGrid
from service.core.vision.target_charuco import Charuco
from service.core.vision.target_chessboard import Chessboard


def check_guided(target: Target) -> LiveTarget:
    """Return a target that can be found in live frames; raises TargetNotGuided."""
    if not isinstance(target, Chessboard | Charuco | AprilGrid):
        raise TargetNotGuided(
            f"Live guidance knows chessboards, ChArUco boards and AprilGrids, not a {target.name}. Upload "
            "the captures of this run over REST, or give the SKU one of these boards.",
            target=target.spec,
        )
    return target
