"""Closed sets of words that rows hold; those with rules, such as a run's states, are in `service.core`."""

from enum import StrEnum


class Publication(StrEnum):
    """Life of a SKU revision or a pose set; once published it never changes."""

    DRAFT = "draft"
    PUBLISHED = "published"
    RETIRED = "retired"


class ShapeState(StrEnum):
    """Life of a board's shape: learnt, used by the solves of its stations, replaced."""

    DRAFT = "draft"
    CERTIFIED = "certified"
    RETIRED = "retired"


class JobState(StrEnum):
    """Life of a job."""

    QUEUED = "queued"
    RUNNING = "running"
    DONE = "done"
    FAILED = "failed"
    CANCELLED = "cancelled"


class Role(StrEnum):
    """What an API key may do; operator < engineer < admin, the others stand beside them."""

    VIEWER = "viewer"
    MES = "mes"
    OPERATOR = "operator"
    ENGINEER = "engineer"
    ADMIN = "admin"


class Language(StrEnum):
    """What the pages speak, by ISO 639-1; their words are in `web/src/words`."""

    EN = "en"
    DE = "de"
    ZH = "zh"


class CaptureRole(StrEnum):
    """What a capture is for: the calibration of the camera, or its place in the vehicle."""

    INTRINSICS = "intrinsics"
    EXTRINSICS = "extrinsics"


class FrameOrigin(StrEnum):
    """Where live frames come from: the kiosk's own camera, the simulator, a camera that the service reads."""

    BROWSER = "browser"
    VIRTUAL = "virtual"
    RTSP = "rtsp"
    MJPEG = "mjpeg"
    V4L2 = "v4l2"
    FILE = "file"
