"""Runs: one calibration of one camera of one vehicle, from opening to its verdict."""

from datetime import date, datetime
from typing import Annotated
from uuid import UUID

from fastapi import APIRouter, Depends, Query
from fastapi.responses import JSONResponse
from pydantic import ConfigDict, Field

from service.api.auth import Mes, Operator, Viewer
from service.api.dependencies import Db, Now, Of, PageOf, ReadDb
from service.api.idempotency import Once
from service.api.rest.captures import Capture
from service.api.rest.results import BoardPose, Result
from service.api.shapes import Answer, Id, Page, Request
from service.core.guidance.actions import AddedFor
from service.core.quality.gates import Verdict
from service.core.run import Outcome, Purpose, RunState
from service.usecases import finish, runs, shared_pictures
from service.usecases.run_filter import RunFilter
from service.usecases.text import Code

router = APIRouter(prefix="/runs", tags=["Runs"])

DayOfRuns = Annotated[date, Field(ge=date(2000, 1, 1), le=date(2999, 12, 31))]


class NewRun(Request):
    """A run to open."""

    sku: Code = Field(description="Code of the SKU; its published revision is used.")
    serial: str = Field(
        max_length=200, description="Serial of the vehicle or camera: 1 to 64 printable characters."
    )
    station: Code | None = Field(default=None, description="Code of the station.")
    purpose: Purpose = Field(default=Purpose.PRODUCTION, strict=False)

    model_config = ConfigDict(
        json_schema_extra={"examples": [{"sku": "lens1", "serial": "VIN-0001", "purpose": "production"}]}
    )


class RunSku(Answer):
    """Which revision of which SKU."""

    code: str
    revision: int


class RunSummary(Answer):
    """A run in a list."""

    model_config = ConfigDict(
        json_schema_extra={
            "examples": [
                {
                    "id": "019a2b3c-11aa-7bb2-9cc3-44dd55ee66ff",
                    "serial": "VIN-0001",
                    "sku": {"code": "lens1", "revision": 1},
                    "station": "line1-cal2",
                    "purpose": "production",
                    "state": "finished",
                    "verdict": "PASS",
                    "outcome": "COMPLETED",
                    "captures": 12,
                    "poses": 12,
                    "rms_px": 0.117,
                    "created_at": "2026-11-22T07:31:42.099340Z",
                    "finished_at": "2026-11-22T07:32:33.574474Z",
                }
            ]
        }
    )

    id: UUID
    serial: str
    sku: RunSku
    station: str | None = Field(description="Code of the station.")
    purpose: Purpose
    state: RunState
    verdict: Verdict | None = Field(description="Judgement on the camera; null until the run is finished.")
    outcome: Outcome | None = Field(description="How the run ended; null while it is open.")
    captures: int
    poses: int = Field(description="How many poses the run's pose set asks for; 0 without one.")
    rms_px: float | None
    created_at: datetime
    finished_at: datetime | None


class AddedPose(Answer):
    """A pose that the run asked for beyond its pose set."""

    pose_index: int = Field(description="Follows those of the set.")
    pose: BoardPose = Field(description="`T_cam_board`.")
    reason: AddedFor = Field(
        description="`accuracy`: the captures did not determine the camera well enough. `weak-capture`: one "
        "of them spoilt the result. `out-of-reach`: a pose was not reached."
    )
    replaces: int | None = Field(description="The pose that it stands in for.")
    created_at: datetime


class RunDetail(RunSummary):
    """A run with its images and, once finished, its result."""

    model_config = ConfigDict(json_schema_extra={"examples": []})

    pose_set_id: UUID | None
    capture_list: list[Capture]
    added_poses: list[AddedPose]
    result: Result | None


class SharedPicture(Answer):
    """A picture of the run that another run holds too: the same file, byte by byte."""

    capture_id: UUID
    number: int = Field(description="Of the capture within this run.")
    other_run_id: UUID
    other_serial: str
    other_number: int
    other_created_at: datetime


def run_filter(
    *,
    serial: Annotated[str | None, Query(max_length=64, description="Only of exactly this serial.")] = None,
    sku: Annotated[Code | None, Query(description="Only of this SKU.")] = None,
    station: Annotated[Code | None, Query(description="Only at this station.")] = None,
    without_station: Annotated[bool, Query(description="Only runs that named no station.")] = False,
    verdict: Annotated[Verdict | None, Query(description="Only with this verdict.")] = None,
    failed: Annotated[
        str | None, Query(max_length=64, description="Only where the measurement of this name failed.")
    ] = None,
    since: Annotated[DayOfRuns | None, Query(description="Only opened on this day or later, UTC.")] = None,
    until: Annotated[DayOfRuns | None, Query(description="Only opened on this day or before, UTC.")] = None,
    counted: Annotated[
        bool, Query(description="Only what counts for yield: finished, production or retest.")
    ] = False,
    first: Annotated[
        bool, Query(description="Only the first of each serial and SKU that counts for yield.")
    ] = False,
) -> RunFilter:
    """Return which runs are asked for."""
    return RunFilter(
        serial=serial,
        sku=sku,
        station=station,
        without_station=without_station,
        verdict=verdict,
        failed=failed,
        since=since,
        until=until,
        counted=counted,
        first=first,
    )


Wanted = Annotated[RunFilter, Depends(run_filter)]


@router.post("", status_code=201, summary="Open a run", response_model=RunDetail)
def create_run(body: NewRun, caller: Mes, db: Db, now: Now, once: Once) -> JSONResponse:
    """Open a run on the SKU's published revision and its published pose set.

    Send an `Idempotency-Key` (any unique text): when an answer was lost, the same request with the same key
    opens no second run and gets the first answer again, marked with `Idempotency-Replayed: true`.
    """
    order = runs.Order(body.sku, body.serial, body.station, body.purpose)
    return once.answer(
        caller, body, lambda: RunDetail.model_validate(runs.open_run(db, order, caller.name, now))
    )


@router.get("", summary="List runs")
def list_runs(caller: Viewer, db: ReadDb, page: PageOf, wanted: Wanted) -> Page[RunSummary]:
    """List the runs that meet all the filters, newest first."""
    return Page[RunSummary].model_validate(runs.list_runs(db, page, wanted))


@router.get("/{run_id}", summary="Read a run")
def read_run(run_id: Id, caller: Viewer, db: ReadDb) -> RunDetail:
    """Read a run with its captures and its result."""
    return RunDetail.model_validate(runs.read_run(db, run_id))


@router.post("/{run_id}/finish", summary="Finish a run")
def finish_run(run_id: Id, caller: Operator, of: Of, now: Now) -> Result:
    """Calibrate from the captures, judge by the SKU's gates and store the result, before it is answered.

    A camera that fails is a result with the verdict FAIL, not an error. With too few usable views the run
    stays open.
    """
    return Result.model_validate(finish.finish_run(of.database, of.signing_keys, run_id, caller.name, now))


@router.post("/{run_id}/abort", summary="Abort a run")
def abort_run(run_id: Id, caller: Operator, db: Db, now: Now) -> RunDetail:
    """End an open run without a result. Its images stay; a new run starts afresh."""
    return RunDetail.model_validate(runs.abort_run(db, run_id, caller.name, now))


@router.get("/{run_id}/shared-pictures", summary="List pictures that other runs hold too")
def list_shared(run_id: Id, caller: Viewer, db: ReadDb) -> list[SharedPicture]:
    """List where else the pictures of a run were used; a picture belongs to one camera."""
    return [SharedPicture.model_validate(shared) for shared in shared_pictures.list_shared(db, run_id)]
