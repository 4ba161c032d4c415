"""What may happen to a guidance session, and what a session asks of the world in return. Plain values."""

from dataclasses import dataclass
from enum import StrEnum

from service.core.guidance.observation import Observation
from service.core.vision.transforms import Pose


class AddedFor(StrEnum):
    """Why a pose that is not of the set is asked for."""

    ACCURACY = "accuracy"
    WEAK_CAPTURE = "weak-capture"
    OUT_OF_REACH = "out-of-reach"


@dataclass(frozen=True)
class AddedPose:
    """A pose beyond the set; replaces: the pose that it stands in for, which is not asked for any more."""

    pose: Pose
    reason: AddedFor
    replaces: int | None = None


@dataclass(frozen=True)
class Frame:
    """A live frame was looked at."""

    observation: Observation


@dataclass(frozen=True)
class ManualCapture:
    """The operator asked for a capture; is_forced: whatever the checks say, by somebody who may."""

    at_s: float
    is_forced: bool = False


@dataclass(frozen=True)
class CaptureAccepted:
    """The capture for a pose is stored for good. Sent only after the commit."""

    pose_index: int


@dataclass(frozen=True)
class CaptureRefused:
    """The capture for a pose could not be used or did not arrive; reason: a code for the operator."""

    pose_index: int
    reason: str


@dataclass(frozen=True)
class Undo:
    """The operator takes back the latest capture."""


@dataclass(frozen=True)
class Retake:
    """The operator takes back the capture of one pose, to take it again."""

    pose_index: int


@dataclass(frozen=True)
class SetAutomatic:
    """Capture by itself, or only when asked."""

    automatic: bool


@dataclass(frozen=True)
class TakeAnother:
    """Ask for another open pose first; the present one comes again after all others."""

    pose_index: int


@dataclass(frozen=True)
class CapturesJudged:
    """What the captures so far are worth, told after each change of them.

    is_enough: the run may end though poses are open. lacks: why the captures of all poses would not do, where
    one pose more may mend it; weak: the pose whose capture spoils the result.
    """

    is_enough: bool = False
    lacks: AddedFor | None = None
    weak: int | None = None


@dataclass(frozen=True)
class AddPose:
    """Ask for a pose beyond the set now."""

    added: AddedPose


@dataclass(frozen=True)
class NoPoseToAdd:
    """There is no pose that could be added: the run ends with what it has."""


Action = (
    Frame
    | ManualCapture
    | CaptureAccepted
    | CaptureRefused
    | Undo
    | Retake
    | SetAutomatic
    | TakeAnother
    | CapturesJudged
    | AddPose
    | NoPoseToAdd
)


@dataclass(frozen=True)
class CaptureFrame:
    """Store the frame of this number, the very one that was judged, as the capture of a pose.

    Answer with CaptureAccepted or CaptureRefused: until then nothing else is captured. is_manual: asked for
    by hand; overridden: the checks that it did not meet, which was forced.
    """

    pose_index: int
    sequence: int
    is_manual: bool = False
    overridden: tuple[str, ...] = ()


@dataclass(frozen=True)
class DiscardCapture:
    """Take the stored capture of a pose back."""

    pose_index: int


@dataclass(frozen=True)
class RunComplete:
    """Every pose has its capture, or what there is proves enough: the run can be finished."""


@dataclass(frozen=True)
class PoseNotReached:
    """The operator tries a pose for long; another one may be asked for first, by TakeAnother."""

    pose_index: int
    tried_s: float


@dataclass(frozen=True)
class PoseWanted:
    """A pose beyond the set is wanted; answer with AddPose or, where there is none, with NoPoseToAdd.

    replaces: the pose that it would stand in for. tried_s: how long that one was tried, where it is out of
    reach.
    """

    reason: AddedFor
    replaces: int | None = None
    tried_s: float = 0.0


Effect = CaptureFrame | DiscardCapture | RunComplete | PoseNotReached | PoseWanted
