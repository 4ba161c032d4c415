"""Where the guidance of a run stands, and what it is judged by. Not here: how it changes (`session`)."""

from dataclasses import dataclass, field

from service.core.guidance.actions import AddedFor, AddedPose, Effect
from service.core.guidance.auto_capture import CaptureLimits, Dwell, Obstacle
from service.core.guidance.comparison import PoseDifference, Tolerances
from service.core.guidance.hints import Hint
from service.core.guidance.observation import Observation
from service.core.vision.camera import Intrinsics
from service.core.vision.target import Target
from service.core.vision.transforms import Pose

Step = tuple["SessionState", tuple[Effect, ...]]


@dataclass(frozen=True)
class GuidanceSettings:
    """What a session is judged by: the SKU's nominal camera and target, tolerances, limits of a capture.

    patience_s: how long a pose is tried before another one is offered. most_added: how many poses beyond the
    set may be asked for to mend what the captures lack, and how many in place of poses out of reach.
    """

    intrinsics: Intrinsics
    target: Target
    tolerances: Tolerances
    limits: CaptureLimits = field(default_factory=CaptureLimits)
    patience_s: float = 20.0
    most_added: int = 2


@dataclass(frozen=True)
class SessionState:
    """Where a session stands.

    expected: the set's poses, then those that were added. captured: indices of the poses that have a capture;
    order: the same as they were taken. current: the pose that is asked for, None when no more is. pending:
    the pose whose capture is being stored. last: the latest observation; difference, obstacles: what was made
    of it, nothing without a whole board or a pose to compare with. moves: the movements that are shown.
    refused: why the latest capture was refused, until the next one is asked for. postponed: open poses that
    come after all others, also while they are tried again. instead_of: the one that was postponed or replaced
    for the current one. tried_s: how long the current pose has been asked for with a board, or a part of one,
    in the picture; absent_s: for how long there has been none. added: why there are poses beyond the set.
    """

    expected: tuple[Pose, ...]
    captured: frozenset[int] = frozenset()
    order: tuple[int, ...] = ()
    current: int | None = 0
    automatic: bool = True
    pending: int | None = None
    last: Observation | None = None
    difference: PoseDifference | None = None
    obstacles: tuple[Obstacle, ...] = ()
    moves: tuple[Hint, ...] = ()
    dwell: Dwell | None = None
    refused: str | None = None
    postponed: tuple[int, ...] = ()
    instead_of: int | None = None
    tried_s: float = 0.0
    absent_s: float = 0.0
    added: tuple[AddedPose, ...] = ()

    @property
    def replaced(self) -> frozenset[int]:
        """The poses that another one stands in for."""
        return frozenset(one.replaces for one in self.added if one.replaces is not None)

    @property
    def total(self) -> int:
        """How many captures the run is to have."""
        return len(self.expected) - len(self.replaced - self.captured)

    def count_added(self, *, out_of_reach: bool) -> int:
        """Return how many poses were added in place of some out of reach, or for what captures lacked."""
        return sum((one.reason is AddedFor.OUT_OF_REACH) is out_of_reach for one in self.added)

    @property
    def obstacle(self) -> Obstacle | None:
        """What keeps the latest frame from being captured, the first thing to mend."""
        return self.obstacles[0] if self.obstacles else None

    @property
    def open(self) -> tuple[int, ...]:
        """The poses that still need a capture, the postponed ones last."""
        done = self.captured | self.replaced
        rest = [i for i in range(len(self.expected)) if i not in done and i not in self.postponed]
        return (*rest, *(i for i in self.postponed if i not in done))

    def is_optional(self, pose_index: int) -> bool:
        """Whether a pose was only added for more accuracy: the run may end without it."""
        place = pose_index - (len(self.expected) - len(self.added))
        if place < 0:
            return False
        reason, replaces = self.added[place].reason, self.added[place].replaces
        return reason is AddedFor.ACCURACY or (replaces is not None and self.is_optional(replaces))
