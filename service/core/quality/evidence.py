"""What the gates look at: the detections of a calibration, what was refused, and what the SKU expects.

Not here: how any of it is judged (gates_*.py, verdict.py).
"""

from collections.abc import Mapping
from dataclasses import dataclass, field

from service.core.quality.early_finish import EarlyFinish
from service.core.quality.limits import Limits
from service.core.quality.population import Population
from service.core.vision.calibration import CalibrationResult
from service.core.vision.camera import Intrinsics
from service.core.vision.detection import Detection
from service.core.vision.extrinsics import FixedTarget
from service.core.vision.target import Target
from service.core.vision.transforms import Array, Pose
from service.core.vision.uncertainty import Region


@dataclass(frozen=True)
class NamedDetection:
    """A detection with the name and the content hash (hex; empty where unknown) of its image."""

    name: str
    detection: Detection
    sha256: str = ""


@dataclass(frozen=True)
class Refusal:
    """An image that gave no view: its name, the code of the reason (as of the error class) and what to do."""

    name: str
    code: str
    detail: str


@dataclass(frozen=True)
class AddedPose:
    """A pose that a run asked for beyond the prescribed ones, and the one that it stands in for, if any."""

    pose: Pose
    replaces: int | None = None


@dataclass(frozen=True)
class Expectation:
    """What a SKU says about the camera: its nominal intrinsics, limits, zones and prescribed poses.

    Zones are by default those of `coverage.py`, limits those of the image size. pose_of_view: for each
    detection in the order given, the index of the prescribed pose that it answers, or None; without it views
    are matched to their nearest poses. other_skus: nominals by code. used_for: by the content hash of an
    image, another serial that it was used for. population_units: how many cameras of the SKU revision are
    known, None where nobody counts them; population: what they have in common, once they are enough;
    other_populations: those of other SKUs with this lens and image size, by code. added: poses whose indices
    follow those of `poses`. early_finish: when prescribed poses need not be taken; None: never. mounting: the
    nominal T_vehicle_cam.
    """

    nominal: Intrinsics
    limits: Limits | None = None
    working_zone: Region | None = None
    valid_region: Region | None = None
    poses: tuple[Pose, ...] | None = None
    pose_of_view: tuple[int | None, ...] | None = None
    other_skus: Mapping[str, Intrinsics] = field(default_factory=dict)
    used_for: Mapping[str, str] = field(default_factory=dict)
    population_units: int | None = None
    population: Population | None = None
    other_populations: Mapping[str, Population] = field(default_factory=dict)
    added: tuple[AddedPose, ...] = ()
    early_finish: EarlyFinish | None = None
    mounting: Pose | None = None


@dataclass(frozen=True)
class FixedTargetViews:
    """Pictures of a target at a known place in the vehicle: its pattern, its place, what was detected."""

    target: Target
    place: FixedTarget
    views: tuple[NamedDetection, ...]


@dataclass(frozen=True)
class Evidence:
    """All that the gates need: the views used, the images refused, the solve, the limits and the zones.

    board: (n, 3) m, where the corners of the plate itself are: the target's, or those of its learnt shape.
    working_grid, valid_grid: (m, 2) px, points of the zones over which mapping errors are taken.
    """

    target: Target
    board: Array
    views: tuple[NamedDetection, ...]
    refused: tuple[Refusal, ...]
    result: CalibrationResult
    limits: Limits
    expectation: Expectation | None
    pose_of_view: tuple[int | None, ...] | None
    working_grid: Array
    valid_grid: Array
    fixed_target: FixedTargetViews | None = None

    @property
    def image_size(self) -> tuple[int, int]:
        """Width and height, px."""
        return self.result.intrinsics.image_size

    @property
    def names(self) -> tuple[str, ...]:
        """The names of the views, in the order of the result's poses and residuals."""
        return tuple(view.name for view in self.views)
