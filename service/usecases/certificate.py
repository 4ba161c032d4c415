"""The certificate of a finished run: what came out, signed in the transaction that makes it true.

It is stored and never made again, so that it stays the same bytes whatever happens to keys and versions. What
it holds is enough to judge a camera without the service; the whole result is named by its hash. Results that
are older than certificates get theirs when it is first asked for; `issued_at` says so. Decision 0015.
"""

import hashlib
import json
from collections.abc import Mapping
from dataclasses import dataclass
from datetime import UTC, datetime
from typing import Any
from uuid import UUID

from cryptography.hazmat.primitives.asymmetric.ed25519 import Ed25519PublicKey
from sqlalchemy import select
from sqlalchemy.orm import Session

from service.storage.database import Database
from service.storage.models import CertificateRow
from service.usecases.audit import record
from service.usecases.canonical_json import canonical_json
from service.usecases.file_names import result_file_name
from service.usecases.finished_run import FinishedRun, RunFacts, load_finished_run
from service.usecases.result_problems import CertificateRefused
from service.usecases.runs import get_run
from service.usecases.signing import KeyRing, sign, verify

JsonObject = dict[str, Any]

KIND = "dmscal-certificate+json"
EXTRINSICS_KIND = "dmscal-extrinsics+json"
KINDS = (KIND, EXTRINSICS_KIND)
VERSION = 1
JUDGED = ("gate", "name", "value", "unit", "comparison", "limit", "margin", "verdict")
MEDIA_TYPE = "application/jose"


@dataclass(frozen=True)
class Certificate:
    """A signed certificate and the name of its file."""

    token: str
    file_name: str


@dataclass(frozen=True)
class Genuine:
    """What a genuine certificate says, and the id of the key that signed it."""

    content: JsonObject
    key_id: str


def issue_certificate(session: Session, keys: KeyRing, run_id: UUID, who: str, now: datetime) -> str:
    """Sign what is stored of a finished run, store it and return it; once for each run."""
    content = certificate_content(load_finished_run(session, run_id), now)
    token = seal(session, keys, content, f"run:{run_id}", who=who, now=now)
    session.add(CertificateRow(run_id=run_id, key_id=keys.key_id, token=token, created_at=now))
    session.flush()
    return token


def seal(
    session: Session, keys: KeyRing, content: JsonObject, subject: str, *, who: str, now: datetime
) -> str:
    """Return a content signed as the kind that its format names, and note that in the audit trail."""
    record(session, now, who, "certificate.issue", subject, key_id=keys.key_id)
    return sign(canonical_json(content), content["format"], keys)


def read_certificate(database: Database, keys: KeyRing, run_id: UUID, who: str, now: datetime) -> Certificate:
    """Return the certificate of a finished run; raises NotFound for a run that has no result."""
    with database.read() as session:
        found = find_certificate(session, run_id)
        facts = load_finished_run(session, run_id).facts
    token = _issue_once(database, keys, run_id, who, now) if found is None else found.token
    return Certificate(token, result_file_name(facts, "certificate", "jws"))


def find_certificate(session: Session, run_id: UUID) -> CertificateRow | None:
    """Return the stored certificate of a run, or None."""
    return session.scalar(select(CertificateRow).where(CertificateRow.run_id == run_id))


def _issue_once(database: Database, keys: KeyRing, run_id: UUID, who: str, now: datetime) -> str:
    with database.write() as session:
        # Of two who ask at the same moment, the second waits for the first and gets the same.
        get_run(session, run_id, lock=True)
        found = find_certificate(session, run_id)
        return issue_certificate(session, keys, run_id, who, now) if found is None else found.token


def check_certificate(token: bytes, keys: Mapping[str, Ed25519PublicKey]) -> Genuine:
    """Return what a certificate says if one of the keys has signed exactly this; else CertificateRefused."""
    payload, key_id = verify(token, KINDS, keys)
    content = json.loads(payload)
    if content.get("format_version") != VERSION:
        raise CertificateRefused(
            f"Its content has format version {content.get('format_version')}; this program reads {VERSION}. "
            "Check it with a newer one.",
            reason="version",
        )
    return Genuine(content, key_id)


def result_hash(document: JsonObject) -> str:
    """Return the SHA-256, hex, of a stored result: of its canonical JSON, as the export `json` gives it."""
    return hashlib.sha256(canonical_json(document)).hexdigest()


def certificate_content(run: FinishedRun, now: datetime) -> JsonObject:
    """Return what is signed."""
    extrinsics = run.document.get("extrinsics")
    return {
        "format": KIND,
        "format_version": VERSION,
        "issued_at": time_text(now),
        "verdict": run.facts.verdict.value,
        "run": run_content(run.facts),
        "result": {
            **camera_content(run),
            "rms_px": run.facts.rms_px,
            "sigma_px": run.facts.sigma_px,
            "mapping": run.document["mapping"],
            "extrinsics": None if extrinsics is None else place_content(extrinsics),
        },
        "measurements": [
            {name: getattr(row, name) for name in JUDGED} | {"verdict": row.verdict.value}
            for row in run.facts.measurements
        ],
        "images": [{"number": image.number, "sha256": image.sha256} for image in run.images],
        "versions": run.facts.versions,
    }


def run_content(facts: RunFacts) -> JsonObject:
    """Return who was calibrated, when and where."""
    return {
        "id": str(facts.run_id),
        "serial": facts.serial,
        "sku": facts.sku,
        "revision": facts.revision,
        "station": facts.station,
        "purpose": facts.purpose.value,
        "opened_at": time_text(facts.opened_at),
        "finished_at": time_text(facts.finished_at),
    }


def camera_content(run: FinishedRun) -> JsonObject:
    """Return the intrinsics with their covariance, and the result that they are from."""
    facts = run.facts
    return {
        "id": str(facts.result_id),
        "sha256": result_hash(run.document),
        "lens": facts.intrinsics.lens,
        "image_size": list(facts.intrinsics.image_size),
        "intrinsics": facts.intrinsics.parameters,
        "sd": facts.sd,
        "covariance": facts.covariance.tolist(),
    }


def place_content(extrinsics: JsonObject) -> JsonObject:
    """Return `T_vehicle_cam` of stored extrinsics, its covariance, and where the target stood."""
    return {name: extrinsics[name] for name in ("pose", "covariance", "fixture")}


def time_text(moment: datetime) -> str:
    """Return a moment as certificates write it: in UTC, to the microsecond."""
    return moment.astimezone(UTC).isoformat(timespec="microseconds").replace("+00:00", "Z")
