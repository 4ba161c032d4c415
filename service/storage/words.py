"""Closed sets of words that rows hold; those with rules, such as a run's states, are in `service.core`."""

from enum import StrEnum


class Publication(StrEnum):
    """Life of a SKU revision or a pose set; once published it never changes."""

    DRAFT = "draft"
    PUBLISHED = "published"
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


class FrameOrigin(StrEnum):
    """Where a station's live frames come from: the kiosk's own camera, or the simulator in the service."""

    BROWSER = "browser"
    VIRTUAL = "virtual"
