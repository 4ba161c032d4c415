"""Parts of the server's messages that say what a run asks for and what it has reached.

Not here: the messages themselves (`protocol`).
"""

from typing import Annotated

from pydantic import ConfigDict, Field

from service.api.shapes import Answer
from service.core.guidance.actions import AddedFor

Point = tuple[float, float]
Share = Annotated[float, Field(ge=0, le=1)]


class Told(Answer):
    """A message or a part of one; what is always sent is not marked as optional in the schema."""

    model_config = ConfigDict(json_schema_serialization_defaults_required=True)


class PoseAngles(Told):
    """How a board stands to the camera, deg, and how far its centre is."""

    tilt_deg: float = Field(description="About the image's x axis.")
    turn_deg: float = Field(description="About the image's y axis.")
    roll_deg: float = Field(description="In the image, clockwise.")
    distance_m: float


class WantedPose(Told):
    """One pose of the run: where its board appears in the nominal camera's image."""

    pose_index: int
    outline: list[Point] = Field(description="The four outer corners, in order round the board.")
    angles: PoseAngles
    added_for: AddedFor | None = Field(description="Why it is asked for, where it is not of the pose set.")
    replaces: int | None = Field(description="The pose that it stands in for, which is not needed any more.")


class Accuracy(Told):
    """Standard deviations, px, of the camera as the captures so far determine it."""

    fx_px: float
    fy_px: float
    cx_px: float
    cy_px: float


class Estimate(Told):
    """The camera as the captures so far determine it: fast, on the way; the verdict has its own solve."""

    captures: int
    parameters: dict[str, float] = Field(description="fx fy cx cy in px, then the lens's coefficients.")
    sd: dict[str, float] = Field(description="Standard deviation of each parameter; 0 for fixed ones.")
    mapping_mean_px: float | None = Field(description="Expected mapping error over the working zone.")
    mapping_worst_px: float | None = Field(description="Its largest value there.")
    required_mapping_px: float = Field(description="What the SKU asks of the mean.")
    reached: Share = Field(description="Required over present mean; 1: the accuracy is reached.")


class BoardSize(Told):
    """Corners of the board, or dots of a grid of circles; they come row by row, `columns` in a row."""

    columns: int
    rows: int
    dot_steps: float | None = Field(
        description="Diameter of a dot in steps of a grid of circles; every other row is shifted by a step. "
        "Null for a board of squares."
    )
