"""The pose set as a document: what `dmscal plan --out` writes, the service exports, and an import reads.

Here: for which camera a set was made, and whether that is the camera it is sent to. Not here: poses,
prediction and provenance themselves (`service.core.planning.document`).
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from service.core.errors import PoseSetInfeasible, PoseSetMismatch
from service.core.planning.visibility import LENS_SHARE, measure_visibility
from service.core.vision.transforms import Pose, stack_poses
from service.usecases.sku_document import Revision

JsonObject = dict[str, Any]
# What is kept of the provenance of a set that comes from elsewhere.
ORIGIN = ("planner", "seed", "candidates", "objective")


@dataclass(frozen=True)
class Claim:
    """For which camera a document says that its set was made; None where it does not say.

    origin: what becomes part of the provenance.
    """

    sku: str | None = None
    revision: int | None = None
    image_size: tuple[int, int] | None = None
    target: str | None = None
    provenance: Mapping[str, Any] = field(default_factory=dict)

    @property
    def origin(self) -> JsonObject:
        """What the provenance of the imported set says of where it comes from."""
        made = {name: self.provenance[name] for name in ORIGIN if name in self.provenance}
        told = {**({} if self.revision is None else {"revision": self.revision}), **made}
        return {"origin": told} if told else {}


NO_CLAIM = Claim()


def pose_set_document(revision: Revision, number: int | None, content: Mapping[str, Any]) -> JsonObject:
    """Return the document of a set made for a revision (of this number, None where it has none).

    content: poses, prediction and provenance as `pose_set_to_dict` gives them.
    """
    return {
        "sku": revision.code,
        "revision": number,
        "image_size": list(revision.intrinsics.image_size),
        "target": revision.target.spec,
        "poses": content["poses"],
        "prediction": content["prediction"],
        "provenance": content["provenance"],
    }


def check_claim(claim: Claim, revision: Revision) -> Claim:
    """Return the claim, or raise PoseSetMismatch naming every field that belongs to another camera.

    Another revision of the same SKU will do: what the set promises is worked out for the one it is sent to.
    """
    size = revision.intrinsics.image_size
    compared = (
        ("sku", claim.sku, revision.code),
        ("image_size", _size(claim.image_size), _size(size)),
        ("target", claim.target, revision.target.spec),
    )
    wrong = [(name, said, own) for name, said, own in compared if said is not None and said != own]
    if wrong:
        raise PoseSetMismatch(
            f"{'; '.join(f'{name} is {said}, here it is {own}' for name, said, own in wrong)}. "
            "Import the set into the SKU that it was planned for, or plan one for this SKU.",
            pointer=f"/{wrong[0][0]}",
            fields=[name for name, _, _ in wrong],
        )
    return claim


def check_in_image(revision: Revision, poses: Sequence[Pose]) -> None:
    """Raise PoseSetInfeasible naming the poses at which a corner is not in the image, or beyond the lens."""
    seen = measure_visibility(revision.intrinsics, revision.target, *stack_poses(list(poses)))
    # Written so that NaN (behind the camera) is outside.
    inside = (seen.clearance_px >= 0) & (seen.lens_share <= LENS_SHARE)
    hidden = [int(i) for i in np.flatnonzero(~inside)]
    if hidden:
        width, height = revision.intrinsics.image_size
        raise PoseSetInfeasible(
            f"The board is not wholly in the image of {width}x{height} px at "
            f"{', '.join(f'poses[{i}]' for i in hidden)} (counted from 0). Poses are T_cam_board: "
            "rvec in rad, tvec of the board's first corner in m. Correct them, or plan a set for this SKU.",
            pointer=f"/poses/{hidden[0]}",
            poses=hidden,
        )


def _size(size: tuple[int, int] | None) -> str | None:
    return None if size is None else f"{size[0]}x{size[1]} px"
