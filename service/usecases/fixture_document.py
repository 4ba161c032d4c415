"""A station's fixture as a document: which target stands where in the vehicle frame, and how well known.

Not here: who may change it (`stations`), and what is made of it (`core.vision.extrinsics`).
"""

from math import radians
from typing import Annotated, Any

from pydantic import ConfigDict, Field, JsonValue, field_validator

from service.core.vision.extrinsics import FixedTarget
from service.core.vision.target import Target, parse_target
from service.usecases.sku_document import Document, PoseDocument, parse_or_complain

EXAMPLE: JsonValue = {
    "target": "chessboard:9x6:40mm",
    "pose": {"rvec": [1.21, -1.21, 1.21], "tvec": [1.62, 0.31, 1.14]},
    "translation_sd_mm": 0.2,
    "rotation_sd_mdeg": 20.0,
}


class FixtureDocument(Document):
    """A target that stands at a known place in the vehicle frame when a vehicle is at the station."""

    model_config = ConfigDict(json_schema_extra={"examples": [EXAMPLE]})

    target: str = Field(max_length=60, description="Pattern of the fixed target.")
    pose: PoseDocument = Field(
        description="`T_vehicle_board`: maps the board's coordinates into the vehicle's."
    )
    translation_sd_mm: Annotated[float, Field(ge=0, le=1000)] = Field(
        description="Sd of the board's origin along each axis."
    )
    rotation_sd_mdeg: Annotated[float, Field(ge=0, le=90_000)] = Field(
        description="Sd of its rotation about each axis through its origin."
    )

    @field_validator("target")
    @classmethod
    def _target_is_readable(cls, spec: str) -> str:
        target: Target = parse_or_complain(parse_target, spec)
        return target.spec

    def to_fixed_target(self) -> FixedTarget:
        """Return the core's value."""
        sd_rad = radians(self.rotation_sd_mdeg / 1000.0)
        return FixedTarget(self.pose.to_pose(), self.translation_sd_mm / 1000.0, sd_rad)

    def to_json(self) -> dict[str, Any]:
        """Return the form in which it is stored."""
        return self.model_dump(mode="json")
