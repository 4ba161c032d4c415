"""What may happen to a guidance session, and what a session asks of the world in return. Plain values."""

from dataclasses import dataclass

from service.core.guidance.observation import Observation


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


Action = Frame | ManualCapture | CaptureAccepted | CaptureRefused | Undo | Retake | SetAutomatic | TakeAnother


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
    """Every pose has its capture."""


@dataclass(frozen=True)
class PoseNotReached:
    """The operator tries a pose for long; another one may be asked for first, by TakeAnother."""

    pose_index: int
    tried_s: float


Effect = CaptureFrame | DiscardCapture | RunComplete | PoseNotReached
