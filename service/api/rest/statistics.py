"""Statistics: first-pass yield, verdicts and failing gates of the last days, and what stations do now."""

from datetime import date
from typing import Annotated

from fastapi import APIRouter, Query
from pydantic import Field

from service.api.auth import Viewer
from service.api.dependencies import Now, PageOf, ReadDb
from service.api.rest.board_shapes import Drift
from service.api.rest.runs import RunSummary
from service.api.rest.targets import TargetDetail
from service.api.shapes import Answer, Page, ShownSource
from service.storage.words import Language
from service.usecases import statistics
from service.usecases.fixture_document import FixtureDocument
from service.usecases.text import Code

router = APIRouter(prefix="/statistics", tags=["Statistics"])


class YieldCount(Answer):
    """Finished runs of production and retest of one SKU at one station that were opened on one day (UTC)."""

    sku: str
    station: str | None = Field(description="Code of the station; null: runs that named none.")
    day: date
    passed: int
    marginal: int
    failed: int
    first_runs: int = Field(description="Of these, the first ones of their serial and SKU.")
    first_passed: int = Field(description="Of the first ones, those with the verdict PASS or MARGINAL.")


class FailedGate(Answer):
    """A measurement that failed, and in how many of the runs."""

    gate: str
    name: str
    runs: int


class Yield(Answer):
    """What came out of the line from `since` to `until`, both included.

    First-pass yield is `first_passed` / `first_runs`, summed over whatever is of interest.
    """

    since: date
    until: date
    counts: list[YieldCount]
    gates: list[FailedGate] = Field(description="Most failed runs first.")


class StationStanding(Answer):
    """A station with its newest open run, its newest finished one, its board and how that has drifted."""

    code: str
    name: str
    source: ShownSource
    language: Language | None
    fixture: FixtureDocument | None = Field(description="Its fixed target in the vehicle frame, if any.")
    board: TargetDetail | None = Field(description="The board that stands there, with its certified shape.")
    open_run: RunSummary | None
    last_run: RunSummary | None
    board_drift: Drift | None = Field(
        description="Of the board's newest shape from the certified one; null: none was learnt since."
    )


@router.get("/yield", summary="Read the first-pass yield")
def read_yield(
    *,
    caller: Viewer,
    db: ReadDb,
    now: Now,
    days: Annotated[int, Query(ge=1, le=statistics.LONGEST_DAYS, description="How many, with today.")] = 30,
    sku: Annotated[Code | None, Query(description="Only runs of this SKU.")] = None,
    station: Annotated[Code | None, Query(description="Only runs at this station.")] = None,
) -> Yield:
    """Count the verdicts of the last days by SKU, station and day, and the gates that failed.

    Only finished runs with the purpose production or retest count. For first-pass yield counts the first
    such run of each serial and SKU, and PASS and MARGINAL have passed. Days are those on which a run was
    opened, UTC. `GET /runs` with `counted` or `first` and the same filters lists the runs behind a number.
    """
    return Yield.model_validate(statistics.read_yield(db, now, days, sku, station))


@router.get("/stations", summary="List what the stations do")
def list_station_standings(caller: Viewer, db: ReadDb, page: PageOf) -> Page[StationStanding]:
    """List the stations, newest first, each with its open run and its last verdict."""
    return Page[StationStanding].model_validate(statistics.list_station_standings(db, page))
