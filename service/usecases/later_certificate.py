"""The certificate of extrinsics measured after their run: signed in the transaction that stores them.

Stored and never made again, like a run's; measurements that are older than such certificates get theirs when
it is first asked for. Not here: the certificate of a run (`certificate`), how either is checked.
"""

from datetime import datetime
from typing import Any
from uuid import UUID

from sqlalchemy import select
from sqlalchemy.orm import Session

from service.core.quality.gates import Verdict
from service.storage.database import Database
from service.storage.placed import LaterCertificateRow, LaterExtrinsicsRow
from service.usecases.certificate import (
    EXTRINSICS_KIND,
    JUDGED,
    VERSION,
    Certificate,
    camera_content,
    place_content,
    run_content,
    seal,
    time_text,
)
from service.usecases.file_names import result_file_name
from service.usecases.finished_run import FinishedRun, load_finished_run
from service.usecases.later_extrinsics_views import LaterExtrinsicsView, get_later, view_later
from service.usecases.runs import get_run
from service.usecases.signing import KeyRing

JsonObject = dict[str, Any]


def issue_later(session: Session, keys: KeyRing, row: LaterExtrinsicsRow, who: str, now: datetime) -> str:
    """Sign what is stored of a measurement, store it and return it; once for each."""
    measured = view_later(session, [row])[0]
    content = later_content(load_finished_run(session, row.run_id), measured, now)
    token = seal(session, keys, content, f"extrinsics:{row.id}", who=who, now=now)
    session.add(
        LaterCertificateRow(later_extrinsics_id=row.id, key_id=keys.key_id, token=token, created_at=now)
    )
    session.flush()
    return token


def read_later_certificate(
    database: Database, keys: KeyRing, later_id: UUID, who: str, now: datetime
) -> Certificate:
    """Return the certificate of a measurement; raises NotFound."""
    with database.read() as session:
        row = get_later(session, later_id)
        facts, failed = load_finished_run(session, row.run_id).facts, row.verdict is Verdict.FAIL
        token = _find(session, later_id)
    if token is None:
        with database.write() as session:
            # Of two who ask at the same moment, the second waits for the first and gets the same.
            get_run(session, facts.run_id, lock=True)
            token = _find(session, later_id) or issue_later(
                session, keys, get_later(session, later_id), who, now
            )
    what = f"extrinsics-{later_id}{'-FAIL' if failed else ''}"
    return Certificate(token, result_file_name(facts, what, "jws"))


def later_content(run: FinishedRun, measured: LaterExtrinsicsView, now: datetime) -> JsonObject:
    """Return what is signed: where the camera is, whose it is, and the intrinsics that were used."""
    return {
        "format": EXTRINSICS_KIND,
        "format_version": VERSION,
        "issued_at": time_text(now),
        "verdict": measured.verdict.value,
        "run": run_content(run.facts),
        "result": camera_content(run),
        "extrinsics": {
            "id": str(measured.id),
            "station": measured.station,
            "measured_at": time_text(measured.created_at),
            **place_content(measured.extrinsics),
        },
        "measurements": [{name: gate[name] for name in JUDGED} for gate in measured.gates],
        "images": [{"number": image.number, "sha256": image.sha256} for image in measured.pictures],
        "versions": measured.versions,
    }


def _find(session: Session, later_id: UUID) -> str | None:
    query = select(LaterCertificateRow.token).where(LaterCertificateRow.later_extrinsics_id == later_id)
    return session.scalar(query)
