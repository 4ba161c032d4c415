"""The SKU document: the one JSON shape of a camera variant, in a file, in a request and in the database.

Here: its fields, their checks and the way into the core's values. Not here: revisions and their states
(`skus`).
"""

from dataclasses import dataclass
from typing import Annotated, Any, Self

from pydantic import (
    AfterValidator,
    BaseModel,
    ConfigDict,
    Field,
    JsonValue,
    field_validator,
    model_validator,
)

from service.core.errors import ServiceError
from service.core.planning.bootstrap import nominal_of_data_sheet
from service.core.planning.fixture import Box
from service.core.planning.pose_space import PoseSpace
from service.core.quality.limits import LIMIT_NAMES, Limits, limits_for
from service.core.vision.camera import LENSES, Intrinsics, parameter_names
from service.core.vision.target import Target, parse_target
from service.core.vision.tolerance import Tolerance
from service.core.vision.uncertainty import Region
from service.usecases.text import Code, Label

Pixels = Annotated[int, Field(ge=64, le=16384)]
Degrees = Annotated[float, Field(ge=-180, le=180)]
Metres = Annotated[float, Field(gt=0, le=100)]
Finite = Annotated[float, Field(ge=-1e9, le=1e9)]


def check_ordered(bounds: tuple[float, float]) -> tuple[float, float]:
    """Return the bounds, or raise ValueError unless the first is the smaller one."""
    if bounds[0] > bounds[1]:
        raise ValueError(f"must be [smallest, largest], not [{bounds[0]:g}, {bounds[1]:g}]")
    return bounds


def bounds_field() -> Any:
    """Return the field of an optional pair.

    JSON has no tuples, so that a list must do even in strict mode.
    """
    return Field(default=None, strict=False)


def check_lens(name: str) -> str:
    """Return the name of a lens model, or raise ValueError unless the camera knows it."""
    if name not in LENSES:
        raise ValueError(f"is not a lens model; choose one of: {', '.join(LENSES)}")
    return name


LensName = Annotated[str, AfterValidator(check_lens), Field(json_schema_extra={"enum": list(LENSES)})]
Coordinate = Annotated[float, Field(ge=-100, le=100)]
Corner = Annotated[tuple[Coordinate, Coordinate, Coordinate], Field(strict=False)]
DegreeRange = Annotated[tuple[Degrees, Degrees], AfterValidator(check_ordered)]
MetreRange = Annotated[tuple[Metres, Metres], AfterValidator(check_ordered)]


class Document(BaseModel):
    """A part of the document: strict types, finite numbers, no unknown fields."""

    model_config = ConfigDict(extra="forbid", strict=True, frozen=True, allow_inf_nan=False)


class BoxDocument(Document):
    """Room that a fixture takes: two opposite corners in the camera frame (x right, y down, z away), m."""

    low_m: Corner
    high_m: Corner

    @model_validator(mode="after")
    def _is_ordered(self) -> Self:
        if any(low > high for low, high in zip(self.low_m, self.high_m, strict=True)):
            raise ValueError("every coordinate of low_m must be at most that of high_m")
        return self


class PoseSpaceDocument(Document):
    """The poses that a person can hold the target in.

    A field that is not given takes the service's default.
    """

    distance_m: MetreRange | None = bounds_field()
    yaw_deg: DegreeRange | None = bounds_field()
    pitch_deg: DegreeRange | None = bounds_field()
    roll_deg: DegreeRange | None = bounds_field()
    image_margin_px: Annotated[float, Field(ge=0, le=1000)] | None = None
    smallest_square_px: Annotated[float, Field(ge=1, le=1000)] | None = None
    largest_incidence_deg: Annotated[float, Field(gt=0, lt=90)] | None = None
    separation_px: Annotated[float, Field(ge=0, le=10000)] | None = None
    depth_of_field_m: MetreRange | None = bounds_field()
    excluded_boxes: Annotated[tuple[BoxDocument, ...], Field(max_length=20, strict=False)] = ()

    def to_pose_space(self) -> PoseSpace:
        """Return the core's pose space."""
        given = self.model_dump(exclude_none=True, exclude={"excluded_boxes"})
        boxes = tuple(Box(box.low_m, box.high_m) for box in self.excluded_boxes)
        return PoseSpace(**given, excluded_boxes=boxes)


class DataSheetDocument(Document):
    """What is known of a camera before one was calibrated: its field of view."""

    hfov_deg: Annotated[float, Field(gt=0, lt=360)]
    vfov_deg: Annotated[float, Field(gt=0, lt=360)] | None = None


class ToleranceDocument(Document):
    """How far cameras differ from the nominal: half widths. What is not given takes the service's default."""

    focal_share: Annotated[float, Field(ge=0, le=0.5)] | None = None
    aspect_share: Annotated[float, Field(ge=0, le=0.5)] | None = None
    centre_px: Annotated[float, Field(ge=0, le=1000)] | None = None
    coefficients: dict[str, Annotated[float, Field(ge=0, le=10)]] | None = None

    def to_tolerance(self) -> Tolerance:
        """Return the core's tolerance."""
        return Tolerance(**self.model_dump(exclude_none=True))


class RegionDocument(Document):
    """A rectangle of the image, px."""

    left_px: Finite
    top_px: Finite
    right_px: Finite
    bottom_px: Finite

    @model_validator(mode="after")
    def _is_not_empty(self) -> Self:
        if self.left_px >= self.right_px or self.top_px >= self.bottom_px:
            raise ValueError("left_px must be smaller than right_px, and top_px smaller than bottom_px")
        return self

    def to_region(self) -> Region:
        """Return the core's region."""
        return Region(self.left_px, self.top_px, self.right_px, self.bottom_px)


@dataclass(frozen=True)
class Revision:
    """One revision of a SKU as the core's values; zones are None where the default by image size holds."""

    code: str
    name: str
    intrinsics: Intrinsics
    target: Target
    pose_count: int
    pose_space: PoseSpace
    corner_noise_px: float
    tolerance: Tolerance
    required_mapping_px: float
    fixed: tuple[str, ...]
    working_zone: Region | None
    valid_region: Region | None
    limits: Limits


EXAMPLE: JsonValue = {
    "code": "lens1",
    "name": "DMS IR, 80 degrees",
    "lens": "pinhole5",
    "image_size": [1280, 800],
    "nominal": {"fx": 1350.1, "fy": 1352.1, "cx": 657.6, "cy": 383.8, "k1": -0.3774, "k2": 0.2425},
    "target": "chessboard:9x6:25mm",
    "pose_count": 12,
    "pose_space": {"distance_m": [0.25, 1.0], "yaw_deg": [-45, 45], "pitch_deg": [-45, 45]},
    "corner_noise_px": 0.1,
}


class SkuDocument(Document):
    """A camera variant: lens and nominal intrinsics, target, poses to plan and limits to meet."""

    model_config = ConfigDict(json_schema_extra={"examples": [EXAMPLE]})

    code: Code = Field(description="Short name in addresses: lower-case letters, digits, '.', '_' and '-'.")
    name: Label
    lens: LensName = Field(description="Lens model.")
    image_size: tuple[Pixels, Pixels] = Field(strict=False, description="Width and height, px.")
    nominal: dict[str, Finite] = Field(
        default_factory=dict,
        description="Nominal intrinsics: fx fy cx cy, and coefficients; without it, give a data_sheet.",
    )
    data_sheet: DataSheetDocument | None = Field(
        default=None, description="Field of view of a camera whose intrinsics are not known yet."
    )
    tolerance: ToleranceDocument = ToleranceDocument()
    target: str = Field(
        max_length=60,
        description="Pattern: chessboard:9x6:25mm or charuco:11x8:25mm:18mm:4x4_250 (inner corners), "
        "aprilgrid:6x6:24mm:0.3 (tags), circles:4x11:20mm:10mm (dots in a row x rows).",
    )
    pose_count: Annotated[int, Field(ge=3, le=100)] = 12
    pose_space: PoseSpaceDocument = PoseSpaceDocument()
    corner_noise_px: Annotated[float, Field(gt=0, le=10)] = Field(
        default=0.1,
        description="Expected sd of a detected corner of a frontal board, px; the planner scales it by pose.",
    )
    required_mapping_px: Annotated[float, Field(gt=0, le=100)] | None = Field(
        default=None,
        description="Mean mapping error that a set must promise; null: where the gate still gives PASS.",
    )
    fixed: tuple[str, ...] = Field(
        default=(), strict=False, description="Parameters that stay at their nominal value."
    )
    working_zone: RegionDocument | None = Field(
        default=None, description="Where the camera works; null: default."
    )
    valid_region: RegionDocument | None = Field(
        default=None, description="Where its map is used; null: default."
    )
    limits: dict[str, Any] = Field(
        default_factory=dict,
        description="Limits of the gates that differ from the defaults by image size; any of: "
        f"{', '.join(LIMIT_NAMES)}; and `marginal`, by name the share of a limit from which on a value is "
        "MARGINAL.",
    )

    @field_validator("target")
    @classmethod
    def _target_is_readable(cls, spec: str) -> str:
        target: Target = parse_or_complain(parse_target, spec)
        return target.spec

    @field_validator("limits")
    @classmethod
    def _limits_are_known(cls, limits: dict[str, Any]) -> dict[str, Any]:
        parse_or_complain(limits_for, (64, 64), limits)
        return limits

    @model_validator(mode="before")
    @classmethod
    def _nominal_of_the_data_sheet(cls, given: Any) -> Any:
        """Let a data sheet stand in for a nominal that is not given."""
        if not isinstance(given, dict) or given.get("nominal") or given.get("data_sheet") is None:
            return given
        sheet = DataSheetDocument.model_validate(given["data_sheet"])
        lens, size = given.get("lens"), given.get("image_size")
        if lens not in LENSES or not isinstance(size, list | tuple) or len(size) != 2:
            return given
        nominal = parse_or_complain(nominal_of_data_sheet, lens, tuple(size), sheet.hfov_deg, sheet.vfov_deg)
        return {**given, "nominal": nominal.parameters}

    @model_validator(mode="after")
    def _nominal_fits_the_lens(self) -> Self:
        parse_or_complain(Intrinsics.from_parameters, self.lens, self.nominal, self.image_size)
        unknown = sorted(set(self.fixed) - set(parameter_names(self.lens)))
        if unknown:
            raise ValueError(
                f"fixed has no {', '.join(unknown)}; choose from: {', '.join(parameter_names(self.lens))}"
            )
        return self

    def to_revision(self) -> Revision:
        """Return the core's values."""
        limits = limits_for(self.image_size, self.limits)
        passing_px = limits.zone_mapping_px * limits.share("zone_mapping_px")
        return Revision(
            code=self.code,
            name=self.name,
            intrinsics=Intrinsics.from_parameters(self.lens, self.nominal, self.image_size),
            target=parse_target(self.target),
            pose_count=self.pose_count,
            pose_space=self.pose_space.to_pose_space(),
            corner_noise_px=self.corner_noise_px,
            tolerance=self.tolerance.to_tolerance(),
            required_mapping_px=self.required_mapping_px or passing_px,
            fixed=self.fixed,
            working_zone=None if self.working_zone is None else self.working_zone.to_region(),
            valid_region=None if self.valid_region is None else self.valid_region.to_region(),
            limits=limits,
        )


def parse_or_complain(parse: Any, *arguments: Any) -> Any:
    """Return what the core's parser returns.

    Its domain error becomes the ValueError that pydantic reports by field.
    """
    try:
        return parse(*arguments)
    except ServiceError as error:
        raise ValueError(error.detail) from error
