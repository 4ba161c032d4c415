"""What can go wrong while a vehicle is guided, as errors for a caller. All others: `core.errors`."""

from service.core.errors import Conflict, NotFound, Unavailable, Unprocessable


class FrameForgotten(NotFound):
    """A live frame that is too old to be captured, or never was."""

    code = "frame-forgotten"
    title = "The live frame is no longer kept"


class FrameMoved(Unprocessable):
    """The full frame shows the board elsewhere than the live frame that was judged."""

    code = "frame-moved"
    title = "The board moved while the picture was taken"


class FrameMissing(Unavailable):
    """The full frame that was asked for did not come from the kiosk's camera."""

    code = "frame-missing"
    title = "The full picture did not arrive"


class PoseNotMatched(Unprocessable):
    """A capture was asked for while the board is not where the pose wants it."""

    code = "pose-not-matched"
    title = "The board is not in the wanted pose"


class PictureUnfit(Unprocessable):
    """A capture was asked for of a picture that would not do: moving, blurred, badly lit, no whole board."""

    code = "picture-unfit"
    title = "The picture cannot be taken like this"


class SourceStalled(Unavailable):
    """No frame has come from a station's camera for a while."""

    code = "source-stalled"
    title = "No picture comes from the camera"


class SourceUnreachable(Unavailable):
    """A station's camera, stream or file cannot be opened, or went away."""

    code = "source-unreachable"
    title = "The camera cannot be reached"


class SourceUnreadable(Unprocessable):
    """A station's camera is there, but sends what cannot be read as pictures."""

    code = "source-unreadable"
    title = "The camera sends no pictures that can be read"


class StationHeld(Conflict):
    """Another kiosk works at the station."""

    code = "station-held"
    title = "Another kiosk holds the station"


class KioskLeft(Unavailable):
    """The kiosk of a station that is watched is no longer connected."""

    code = "kiosk-left"
    title = "The kiosk is not connected"


class OtherSkuOpen(Conflict):
    """The serial that was scanned has an open run for another SKU than the one that was chosen."""

    code = "other-sku-open"
    title = "The serial has an open run for another SKU"


class RevisionRetired(Conflict):
    """The SKU revision of an open run was retired since the run was opened."""

    code = "revision-retired"
    title = "The SKU was revised since the run was opened"
