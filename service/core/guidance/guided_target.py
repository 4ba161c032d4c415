"""Which targets can be guided: those that are found in live frames. Not here: how (`live_detection`)."""

from service.core.guidance.problems import TargetNotGuided
from service.core.vision.target import Target
from service.core.vision.target_chessboard import Chessboard


def check_guided(target: Target) -> Chessboard:
    """Return a target that can be found in live frames; raises TargetNotGuided."""
    if not isinstance(target, Chessboard):
        raise TargetNotGuided(
            f"Live guidance knows chessboards only, not a {target.name}. Upload the captures of this run "
            "over REST, or give the SKU a chessboard.",
            target=target.spec,
        )
    return target
