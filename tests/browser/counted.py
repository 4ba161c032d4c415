"""What sets of other sizes would promise, as a planner tells it in its prediction."""

from typing import Any

from service.core.planning.plan import plan_pose_set
from service.usecases.sku_document import SkuDocument

COUNTS = range(3, 31)


def curve_of(document: dict[str, Any]) -> list[dict[str, Any]]:
    """The curve of a SKU, planned from few candidates."""
    sku = SkuDocument.model_validate(document).to_revision()
    planned = [
        (n, plan_pose_set(sku.intrinsics, sku.target, sku.pose_space, n, 1, candidates=300)) for n in COUNTS
    ]
    return [
        {
            "poses": n,
            "norm_px": one.expected_norm_px,
            "mapping_mean_px": one.expected_mapping.mean_px,
            "mapping_worst_px": one.expected_mapping.worst_px,
        }
        for n, one in planned
    ]
