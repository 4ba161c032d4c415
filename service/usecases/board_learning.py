"""Learning a board's shape from the last runs that were taken with it, as a job; and when to look again.

A run teaches unless a gate failed that says that its corners are wrong; a bent plate itself makes some fail.
Not here: the mathematics (`core.vision.board_shape`), certifying (`board_shapes`).
"""

from dataclasses import asdict, dataclass
from datetime import datetime
from typing import Any
from uuid import UUID

import numpy as np
from sqlalchemy import ColumnElement, exists, func, select
from sqlalchemy.orm import Session

from service.core.errors import StateForbids
from service.core.quality.board_drift import Drift, ShapeCertainty, compare_shapes, measure_certainty
from service.core.quality.gates import Verdict
from service.core.run import Purpose, RunState
from service.core.vision.board_shape import BoardShape, ShapeRun, estimate_board_shape, solve_run
from service.core.vision.target import parse_target
from service.ports import JobCompletion, JobHandler, JobRun
from service.storage import jobs
from service.storage.database import Database
from service.storage.learnt import BoardShapeRow
from service.storage.models import (
    CalibrationRow,
    CaptureRow,
    JobRow,
    MeasurementRow,
    RunRow,
    SkuRevisionRow,
    TargetRow,
)
from service.storage.words import CaptureRole, JobState
from service.usecases.audit import record
from service.usecases.board_in_use import certified_shape
from service.usecases.sku_document import SkuDocument

LEARN_BOARD_SHAPE = "learn-board-shape"
USUAL_RUNS = 50
FEWEST_RUNS = 5
WATCH_EVERY = 200  # runs since the last shape, after which a certified board is looked at again
BY_ITSELF = "service"
# What a bent plate makes fail although every corner was found where it is.
FAILED_BY_A_BEND = frozenset(
    {
        "rms_px",
        "bias_ratio",
        "neighbour_correlation",
        "half_difference",
        "held_out_ratio",
        "population_distance",
        "other_population",
    }
)
JsonObject = dict[str, Any]


@dataclass(frozen=True)
class Learnt:
    """What a job has found: the shape, how certain it is, its drift from the certified one, and from what."""

    shape: BoardShape
    certainty: ShapeCertainty
    drift: Drift | None
    run_ids: list[UUID]


def check_teaching_runs(session: Session, target: TargetRow, wanted: int) -> list[UUID]:
    """Return the last runs, at most so many, that teach a board's shape; raises StateForbids for too few."""
    found = teaching_runs(session, target, wanted)
    if len(found) < FEWEST_RUNS:
        raise StateForbids(
            f"{len(found)} finished runs at stations with this board can teach its shape, and at least "
            f"{FEWEST_RUNS} are needed. Give its station this board, finish more runs, then ask again.",
            runs=len(found),
            needed=FEWEST_RUNS,
        )
    return found


def teaching_runs(session: Session, target: TargetRow, wanted: int) -> list[UUID]:
    """Return the ids of the last runs that teach a board's shape, newest first."""
    query = (
        select(RunRow.id, SkuRevisionRow.document)
        .join(SkuRevisionRow, SkuRevisionRow.id == RunRow.sku_revision_id)
        .where(
            RunRow.target_id == target.id,
            RunRow.state == RunState.FINISHED,
            RunRow.purpose != Purpose.SIMULATED,
            ~_failed_otherwise(),
        )
        .order_by(RunRow.created_at.desc(), RunRow.id.desc())
        .limit(wanted)
    )
    return [run_id for run_id, document in session.execute(query) if document["target"] == target.spec]


def learn_board_shape_job(database: Database) -> JobHandler:
    """Return the handler of the jobs that learn the shapes of boards."""

    def handle(run: JobRun) -> JobCompletion:
        target_id = UUID(run.arguments["target_id"])
        with database.read() as session:
            target = session.get_one(TargetRow, target_id)
            pattern, limit_mm = parse_target(target.spec), target.drift_limit_mm
            run_ids = check_teaching_runs(session, target, run.arguments["runs"])
            taught = [_shape_run(session, run_id) for run_id in run_ids]
            certified = certified_shape(session, target_id)
            before = None if certified is None else np.array(certified.deviations)
        points = pattern.object_points
        shape = estimate_board_shape(points, taught, run.report)
        latest, result = taught[0], solve_run(points + shape.deviations, taught[0])
        certainty = measure_certainty(points, shape, latest, result)
        drift = None
        if before is not None:
            drift = compare_shapes(points, before, shape.deviations, latest, result, limit_mm=limit_mm)

        def complete(session: Session) -> JsonObject:
            row = _store(session, target_id, Learnt(shape, certainty, drift, run_ids), run)
            return {"board_shape_id": str(row.id), "version": row.version, "drift": row.drift}

        return complete

    return handle


def watch_board(session: Session, run: RunRow, now: datetime) -> None:
    """Queue a look at the board of a finished run once enough runs came since its shape was learnt."""
    if run.target_id is None or certified_shape(session, run.target_id) is None:
        return
    learnt_at = session.scalar(
        select(func.max(BoardShapeRow.created_at)).where(BoardShapeRow.target_id == run.target_id)
    )
    since = (
        select(RunRow.id)
        .where(
            RunRow.target_id == run.target_id,
            RunRow.state == RunState.FINISHED,
            RunRow.created_at > learnt_at,
        )
        .limit(WATCH_EVERY)
    )
    if (session.scalar(select(func.count()).select_from(since.subquery())) or 0) < WATCH_EVERY:
        return
    if not _is_waiting(session, run.target_id):
        arguments = {"target_id": str(run.target_id), "runs": USUAL_RUNS, "who": BY_ITSELF}
        jobs.enqueue(session, LEARN_BOARD_SHAPE, arguments, now)


def _is_waiting(session: Session, target_id: UUID) -> bool:
    """Whether a look at a board is queued or under way."""
    query = select(JobRow.arguments).where(
        JobRow.state.in_([JobState.QUEUED, JobState.RUNNING]), JobRow.kind == LEARN_BOARD_SHAPE
    )
    return any(arguments["target_id"] == str(target_id) for arguments in session.scalars(query))


def _failed_otherwise() -> ColumnElement[bool]:
    """Whether a run failed at something that a bent plate does not explain."""
    return exists(
        select(MeasurementRow.id)
        .join(CalibrationRow, CalibrationRow.id == MeasurementRow.calibration_id)
        .where(
            CalibrationRow.run_id == RunRow.id,
            MeasurementRow.verdict == Verdict.FAIL,
            MeasurementRow.name.not_in(FAILED_BY_A_BEND),
        )
        .correlate(RunRow)
    )


def _shape_run(session: Session, run_id: UUID) -> ShapeRun:
    """Return what a run tells: its stored corners, and its camera to start from."""
    revision_id = session.get_one(RunRow, run_id).sku_revision_id
    revision = SkuDocument.model_validate(session.get_one(SkuRevisionRow, revision_id).document).to_revision()
    # Pictures of the station's fixed target show another plate.
    query = (
        select(CaptureRow)
        .where(CaptureRow.run_id == run_id, CaptureRow.role == CaptureRole.INTRINSICS)
        .order_by(CaptureRow.number)
    )
    captures = list(session.scalars(query))
    return ShapeRun(
        tuple(np.array(capture.corner_ids, dtype=np.int64) for capture in captures),
        tuple(np.array(capture.corners, dtype=np.float64).reshape(-1, 2) for capture in captures),
        revision.intrinsics,
        revision.fixed,
    )


def _store(session: Session, target_id: UUID, learnt: Learnt, run: JobRun) -> BoardShapeRow:
    shape, drift = learnt.shape, learnt.drift
    last = session.scalar(select(func.max(BoardShapeRow.version)).where(BoardShapeRow.target_id == target_id))
    job = session.get_one(JobRow, run.job_id)
    row = BoardShapeRow(
        target_id=target_id,
        version=(last or 0) + 1,
        deviations=shape.deviations.tolist(),
        sd=shape.sd.tolist(),
        run_ids=[str(run_id) for run_id in learnt.run_ids],
        bend_mm=1e3 * shape.bend_m,
        in_plane_mm=1e3 * shape.in_plane_m,
        sigma_flat_px=shape.sigma_flat_px,
        sigma_px=shape.sigma_px,
        certainty=asdict(learnt.certainty),
        drift=None if drift is None else {**asdict(drift), "state": drift.state.value},
        job_id=job.id,
        created_at=job.started_at or job.created_at,
        created_by=run.arguments["who"],
    )
    session.add(row)
    session.flush()
    record(
        session,
        row.created_at,
        row.created_by,
        "board-shape.learn",
        f"target:{target_id}",
        version=row.version,
        bend_mm=round(row.bend_mm, 4),
        drift=None if drift is None else drift.state.value,
    )
    return row
