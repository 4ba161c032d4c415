"""Finish a run: calibrate, judge, store, sign and announce in one transaction; and compute a result again.

The solve runs before the transaction, so that it holds no lock; what it was made from is checked again
inside.
"""

from collections.abc import Iterable
from datetime import datetime
from typing import Any
from uuid import UUID

from sqlalchemy import select
from sqlalchemy.orm import Session

from service.core.errors import StateForbids
from service.core.quality.gates import Measurement
from service.core.quality.verdict import Judged
from service.core.run import Outcome, RunState, check_open
from service.storage import outbox
from service.storage.database import Database
from service.storage.models import CalibrationRow, CaptureRow, MeasurementRow, RunRow, SkuRevisionRow, SkuRow
from service.usecases.audit import record
from service.usecases.board_learning import watch_board
from service.usecases.calibration_input import CalibrationInput, calibrate, load_input
from service.usecases.captures import lock_open_run
from service.usecases.certificate import issue_certificate
from service.usecases.population import admit_unit
from service.usecases.result_document import result_document, versions
from service.usecases.results import ResultView, read_result
from service.usecases.runs import get_run
from service.usecases.signing import KeyRing

JsonObject = dict[str, Any]


def finish_run(database: Database, keys: KeyRing, run_id: UUID, who: str, now: datetime) -> ResultView:
    """Return the stored result of a run that was open; its certificate is signed and stored with it.

    Raises NotFound, RunAlreadyFinished, RunAborted; TooFewViews, DegenerateViews, PoseUndetermined of the
    fixed target (the run stays open);
    StateForbids when captures came or went while it was calibrated.
    """
    with database.read() as session:
        run = get_run(session, run_id)
        check_open(run.state, str(run_id))
        source = load_input(session, run)
    judged = calibrate(source)
    with database.write() as session:
        run = lock_open_run(session, run_id)
        _check_unchanged(session, source)
        row = _store(session, run, source, judged, now)
        early = row.document["early_finish"]
        facts = {"serial": run.serial, "verdict": judged.verdict.value}
        record(session, now, who, "run.finish", f"run:{run_id}", **facts, **(early or {}))
        issue_certificate(session, keys, run_id, who, now)
        return read_result(session, run_id)


def recompute(session: Session, run_id: UUID) -> JsonObject:
    """Return the document of a run's calibration computed again from its stored corners; raises NotFound."""
    source = load_input(session, get_run(session, run_id))
    return _document(source, calibrate(source))


def _check_unchanged(session: Session, source: CalibrationInput) -> None:
    query = select(CaptureRow.id).where(CaptureRow.run_id == source.run_id).order_by(CaptureRow.number)
    if set(session.scalars(query)) != set(source.capture_ids):
        raise StateForbids(
            "Captures were added or withdrawn while the run was finished. Finish it again.",
            run=f"/api/v1/runs/{source.run_id}",
        )


def _store(
    session: Session, run: RunRow, source: CalibrationInput, judged: Judged, now: datetime
) -> CalibrationRow:
    """Store the result, and write down that it is to be announced."""
    result = judged.result
    row = CalibrationRow(
        run_id=run.id,
        verdict=judged.verdict,
        lens=result.intrinsics.lens,
        intrinsics=result.intrinsics.parameters,
        covariance=result.covariance.tolist(),
        rms_px=result.rms_px,
        sigma_px=result.sigma_px,
        document=_document(source, judged),
        versions=versions(),
        created_at=now,
    )
    session.add(row)
    session.add_all(_measurements(row.id, judged.measurements))
    run.state, run.verdict, run.outcome, run.finished_at = (
        RunState.FINISHED,
        judged.verdict,
        Outcome.COMPLETED,
        now,
    )
    session.flush()
    admit_unit(session, run, row, now)
    watch_board(session, run, now)
    outbox.append(session, "run.finished", f"vehicle:{run.serial}", _announcement(session, run, row), now)
    return row


def _document(source: CalibrationInput, judged: Judged) -> JsonObject:
    fixed = () if source.fixed_target is None else source.fixed_target.views
    names = [detection.name for detection in (*source.detections, *fixed)]
    document = result_document(judged, dict(zip(names, source.capture_ids, strict=True)), source.fixture)
    if source.identity is not None:
        document["identity"] = source.identity
    if source.board is not None:
        document["board_shape"] = source.board.reference
    return document


def _measurements(calibration_id: UUID, measurements: Iterable[Measurement]) -> list[MeasurementRow]:
    return [
        MeasurementRow(
            calibration_id=calibration_id,
            gate=one.gate,
            name=one.name,
            value=one.value,
            unit=one.unit,
            limit=one.limit,
            comparison=one.comparison,
            margin=one.margin,
            verdict=one.verdict,
            advice=one.advice,
            reason=one.reason,
            facts=dict(one.facts) or None,
        )
        for one in measurements
    ]


def _announcement(session: Session, run: RunRow, row: CalibrationRow) -> JsonObject:
    revision = session.get_one(SkuRevisionRow, run.sku_revision_id)
    return {
        "run_id": str(run.id),
        "serial": run.serial,
        "purpose": run.purpose.value,
        "sku": session.get_one(SkuRow, revision.sku_id).code,
        "revision": revision.number,
        "verdict": row.verdict.value,
        "result": f"/api/v1/runs/{run.id}/result",
    }
