"""What can be wrong with a station's fixture and pictures of it, as errors. All others: `core.errors`."""

from service.core.errors import Conflict, Unprocessable


class FixtureMissing(Conflict):
    """Pictures of a fixed target need a station that says where it stands."""

    code = "fixture-missing"
    title = "The run's station has no fixture"


class FixtureChanged(Conflict):
    """The station's fixture is another one than in the run's earlier pictures of it."""

    code = "fixture-changed"
    title = "The station's fixture was changed during the run"


class PictureOfAnother(Conflict):
    """A picture shows where one camera is, and cannot be another one's too."""

    code = "picture-of-another"
    title = "The picture was used for another serial"


class ResultNotUsable(Conflict):
    """Only the newest result of a serial, and only an accepted one, says what its camera is now."""

    code = "result-not-usable"
    title = "The run's intrinsics cannot be used"


class FixtureFileUnreadable(Unprocessable):
    """A fixture's file that is not there or is no fixture."""

    code = "fixture-file-unreadable"
    title = "The fixture's file cannot be read"
