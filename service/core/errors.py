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


class MethodNotAllowed(ServiceError):
    """The address exists, but not with this HTTP method."""

    code = "method-not-allowed"
    title = "The address does not take this method"


class InternalError(ServiceError):
    """The service itself went wrong; the request may be all right."""

    code = "internal-error"
    title = "The service went wrong"


class MediaTypeUnsupported(ServiceError):
    """The body has a media type that this address does not read."""

    code = "media-type-unsupported"
    title = "The media type cannot be read here"


class CursorInvalid(BadRequest):
    """A cursor did not come from the list that it is used for."""

    code = "cursor-invalid"
    title = "The cursor cannot be used"


class ValidationFailed(Unprocessable):
    """Fields of the request are missing, unknown or out of their bounds."""

    code = "validation-failed"
    title = "The request has invalid fields"


class SerialInvalid(Unprocessable):
    """A serial holds characters that labels, filters or systems behind cannot carry."""

    code = "serial-invalid"
    title = "The serial cannot be used"


class PoseIndexUnknown(Unprocessable):
    """The pose set of a run has no pose of this index."""

    code = "pose-index-unknown"
    title = "No such pose in the pose set"


class IdempotencyKeyReused(Unprocessable):
    """One Idempotency-Key came with two different requests."""

    code = "idempotency-key-reused"
    title = "The Idempotency-Key belongs to another request"


class AlreadyExists(Conflict):
    """A thing of this name or serial is there already."""

    code = "already-exists"
    title = "It exists already"


class StateForbids(Conflict):
    """The life cycle has no such step from the present state."""

    code = "state-forbids"
    title = "The life cycle has no such step"


class RevisionNotPublished(Conflict):
    """Runs need a published revision of the SKU."""

    code = "revision-not-published"
    title = "The SKU has no published revision"


class PoseSetNotPublished(Conflict):
    """Production runs need a published pose set."""

    code = "pose-set-not-published"
    title = "No pose set is published"


class RunAlreadyFinished(Conflict):
    """The run is finished; its result stands."""

    code = "run-already-finished"
    title = "The run is finished already"


class RunAborted(Conflict):
    """The run was aborted and takes nothing more."""

    code = "run-aborted"
    title = "The run was aborted"


class DuplicateImage(Conflict):
    """The same image is in the run already."""

    code = "duplicate-image"
    title = "The same image is in the run already"


class PoseTaken(Conflict):
    """The run has a capture for this pose already."""

    code = "pose-taken"
    title = "The pose has a capture already"


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


class SceneInvalid(Unprocessable):
    """A virtual scene has values that no picture can have."""

    code = "scene-invalid"
    title = "The virtual scene cannot be drawn"


class PoseUndetermined(Unprocessable):
    """The corners of one view do not give a pose."""

    code = "pose-undetermined"
    title = "The corners do not give a pose"


class PoseSpaceEmpty(Unprocessable):
    """The bounds of a pose space leave (almost) no pose."""

    code = "pose-space-empty"
    title = "The pose space holds too few poses"


class PoseSetInfeasible(Unprocessable):
    """No pose set meets the constraints."""

    code = "pose-set-infeasible"
    title = "No pose set meets the constraints"


class PoseSetInvalid(Unprocessable):
    """A stored or imported pose set lacks fields or has values of the wrong kind."""

    code = "pose-set-invalid"
    title = "The pose set cannot be read"


class PoseSetMismatch(Unprocessable):
    """A pose set was made for another camera, image size or target than the one it is sent to."""

    code = "pose-set-mismatch"
    title = "The pose set is made for another camera"


class LimitsInvalid(Unprocessable):
    """A limit has an unknown name or an impossible value."""

    code = "limits-invalid"
    title = "The limits cannot be used"


class ImageUnreadable(Unprocessable):
    """Bytes that are no image, or an image that is cut off or damaged."""

    code = "image-unreadable"
    title = "The image cannot be read"


class ImageFormatUnsupported(Unprocessable):
    """An image of a format or depth that is not accepted."""

    code = "image-format-unsupported"
    title = "The image format is not accepted"


class ImageTooLarge(TooLarge):
    """An image with more bytes or pixels than is accepted."""

    code = "image-too-large"
    title = "The image is too large"


class WrongImageSize(Unprocessable):
    """An image whose width and height are not those of the camera."""

    code = "wrong-image-size"
    title = "Not the image size of this camera"


class FolderUnusable(NotFound):
    """A folder that is not there, is no folder, or holds no images."""

    code = "folder-unusable"
    title = "The folder holds no images"


class SkuFileUnreadable(Unprocessable):
    """A SKU file that is not there or is no SKU document."""

    code = "sku-file-unreadable"
    title = "The SKU file cannot be read"


class JobAlreadyEnded(Conflict):
    """The job has ended, so it cannot be cancelled."""

    code = "job-already-ended"
    title = "The job has already ended"


class DatabaseBusy(Unavailable):
    """Another writer held the database for too long."""

    code = "database-busy"
    title = "The database is busy"


class SourceRefused(Unprocessable):
    """The address of a station's source is not one that the service reads frames from."""

    code = "source-refused"
    title = "The source cannot be used"


class DatabaseUnreachable(Unavailable):
    """The database cannot be opened or does not answer."""

    code = "database-unreachable"
    title = "The database cannot be reached"


class DatabaseOutdated(Unavailable):
    """The tables are not of the version that this service needs."""

    code = "database-outdated"
    title = "The database has another version"


class DiskFull(Unavailable):
    """There is no room left to store anything."""

    code = "disk-full"
    title = "The disk is full"


class BlobStoreUnavailable(Unavailable):
    """Images cannot be stored or read at the moment."""

    code = "blob-store-unavailable"
    title = "The image store is not available"


class BlobMissing(NotFound):
    """The image store does not hold this content."""

    code = "blob-missing"
    title = "The stored image is missing"


class BlobDamaged(Unavailable):
    """What the image store holds is not what was stored."""

    code = "blob-damaged"
    title = "The stored image is damaged"
