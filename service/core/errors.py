"""Every error that the service tells its callers about, as domain classes with a stable code.

    ServiceError
    ├─ BadRequest       the request cannot be understood
    ├─ NotAuthenticated nobody is known to have asked
    ├─ NotAllowed       the caller's role may not do this
    ├─ NotFound         no such thing
    ├─ Conflict         the thing is in a state that forbids this
    ├─ Unprocessable    understood, but the content cannot be used
    ├─ TooLarge         more than is accepted
    └─ Unavailable      something the service needs is not there now

The detail says what is wrong and what to do. Facts are values a program can use. HTTP numbers live in
`service.api.problems`; a failed calibration is a verdict and not an error.
"""

from typing import ClassVar

Fact = str | int | float | bool | None | list[str] | list[int] | list[float]


class ServiceError(Exception):
    """An error with a stable `code`, a `title` for its kind and a `detail` for this one."""

    code: ClassVar[str] = "service-error"
    title: ClassVar[str] = "The service could not do this"

    def __init__(self, detail: str, **facts: Fact) -> None:
        super().__init__(detail)
        self.detail = detail
        self.facts = facts


class BadRequest(ServiceError):
    """The request cannot be understood."""

    code = "bad-request"
    title = "The request cannot be understood"


class NotAuthenticated(ServiceError):
    """No valid API key came with the request."""

    code = "not-authenticated"
    title = "No valid API key"


class NotAllowed(ServiceError):
    """The caller's role may not do this."""

    code = "role-missing"
    title = "Your role does not allow this"


class NotFound(ServiceError):
    """There is no such thing."""

    code = "not-found"
    title = "Not found"


class Conflict(ServiceError):
    """The thing is in a state that forbids this."""

    code = "conflict"
    title = "The present state does not allow this"


class Unprocessable(ServiceError):
    """The request was understood, but its content cannot be used."""

    code = "unprocessable"
    title = "The content cannot be used"


class TooLarge(ServiceError):
    """More was sent than is accepted."""

    code = "too-large"
    title = "Too large"


class Unavailable(ServiceError):
    """Something the service needs is not there at the moment."""

    code = "unavailable"
    title = "Not available at the moment"


class TargetSpecInvalid(Unprocessable):
    """A target description does not follow its pattern."""

    code = "target-spec-invalid"
    title = "The target description cannot be read"


class IntrinsicsInvalid(Unprocessable):
    """Intrinsics have a wrong shape, an unknown lens or impossible values."""

    code = "intrinsics-invalid"
    title = "The intrinsics cannot be used"


class TargetNotVisible(Unprocessable):
    """No target, or only a part of it, was found in an image."""

    code = "target-not-visible"
    title = "The target is not visible"


class WrongTarget(Unprocessable):
    """The target in the image is not the declared one."""

    code = "wrong-target"
    title = "Not the declared target"


class TooFewViews(Unprocessable):
    """Fewer usable views than a calibration needs."""

    code = "too-few-views"
    title = "Too few usable views"


class DegenerateViews(Unprocessable):
    """The views do not determine the parameters."""

    code = "degenerate-views"
    title = "The views do not determine the camera"


class PoseSpaceEmpty(Unprocessable):
    """The bounds of a pose space leave (almost) no pose."""

    code = "pose-space-empty"
    title = "The pose space holds too few poses"


class PoseSetInfeasible(Unprocessable):
    """No pose set meets the constraints."""

    code = "pose-set-infeasible"
    title = "No pose set meets the constraints"
