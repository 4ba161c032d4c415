"""What may happen to a guidance session, and what a session asks of the world in return. Plain values."""

from dataclasses import dataclass

from service.core.guidance.observation import Observation


@dataclass(frozen=True)
class Frame:
    """A live frame was looked at."""

    observation: Observation


@dataclass(frozen=True)
class ManualCapture:
    """The operator asked for a capture."""

    at_s: float


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


Action = Frame | ManualCapture | CaptureAccepted | CaptureRefused | Undo | Retake | SetAutomatic


@dataclass(frozen=True)
class CaptureFrame:
    """Store the frame of this number, the very one that was judged, as the capture of a pose.

    Answer with CaptureAccepted or CaptureRefused: until then nothing else is captured.
    """

    pose_index: int
    sequence: int


@dataclass(frozen=True)
class DiscardCapture:
    """Take the stored capture of a pose back."""

    pose_index: int


@dataclass(frozen=True)
class RunComplete:
    """Every pose has its capture."""


Effect = CaptureFrame | DiscardCapture | RunComplete
