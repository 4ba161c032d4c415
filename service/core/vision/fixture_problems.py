"""What can be wrong with a station's fixture, as errors for a caller. All others: `core.errors`."""

from service.core.errors import Conflict


class FixtureMissing(Conflict):
    """Pictures of a fixed target need a station that says where it stands."""

    code = "fixture-missing"
    title = "The run's station has no fixture"


class FixtureChanged(Conflict):
    """The station's fixture is another one than in the run's earlier pictures of it."""

    code = "fixture-changed"
    title = "The station's fixture was changed during the run"
