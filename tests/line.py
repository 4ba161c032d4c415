"""A line that has made runs: SKUs, stations, and finished runs with the gates that failed, without images."""

from datetime import datetime, timedelta
from uuid import UUID

from sqlalchemy import select
from sqlalchemy.orm import Session

from service.core.quality.gates import Verdict
from service.core.run import Outcome, Purpose, RunState
from service.storage.models import (
    CalibrationRow,
    MeasurementRow,
    RunRow,
    SkuRevisionRow,
    SkuRow,
    StationRow,
)
from tests.fakes import START

PASS, MARGINAL, FAIL = Verdict.PASS, Verdict.MARGINAL, Verdict.FAIL


class Line:
    """Adds rows to a session. SKUs that are not there and stations are made when they are first named."""

    def __init__(self, session: Session) -> None:
        self._session = session
        self._revisions: dict[str, UUID] = {}
        self._stations: dict[str, UUID] = {}

    def run(
        self,
        serial: str,
        verdict: Verdict | None = PASS,
        *,
        sku: str = "lens1",
        station: str | None = "cal1",
        purpose: Purpose = Purpose.PRODUCTION,
        at: datetime = START,
        failed: tuple[str, ...] = (),
        state: RunState | None = None,
    ) -> RunRow:
        """Add a run: finished with a verdict, open without one, or of another state."""
        state = state or (RunState.OPEN if verdict is None else RunState.FINISHED)
        run = RunRow(
            sku_revision_id=self._revision(sku),
            station_id=None if station is None else self.station(station),
            serial=serial,
            purpose=purpose,
            state=state,
            verdict=verdict,
            outcome=None if verdict is None else Outcome.COMPLETED,
            created_by="test",
            created_at=at,
            finished_at=None if state is RunState.OPEN else at + timedelta(minutes=1),
        )
        self._session.add(run)
        if verdict is not None:
            self._judge(run, verdict, failed)
        return run

    def station(self, code: str) -> UUID:
        """Return the id of a station, registered when it is first named."""
        if code not in self._stations:
            row = StationRow(code=code, name=f"Station {code}", created_at=START)
            self._session.add(row)
            self._stations[code] = row.id
        return self._stations[code]

    def _revision(self, code: str) -> UUID:
        if code not in self._revisions:
            self._revisions[code] = self._known_revision(code) or self._new_revision(code)
        return self._revisions[code]

    def _known_revision(self, code: str) -> UUID | None:
        query = select(SkuRevisionRow.id).join(SkuRow, SkuRow.id == SkuRevisionRow.sku_id)
        return self._session.scalar(query.where(SkuRow.code == code))

    def _new_revision(self, code: str) -> UUID:
        sku = SkuRow(code=code, name=code, created_at=START)
        row = SkuRevisionRow(sku_id=sku.id, number=1, document={}, created_at=START)
        self._session.add_all([sku, row])
        return row.id

    def _judge(self, run: RunRow, verdict: Verdict, failed: tuple[str, ...]) -> None:
        calibration = CalibrationRow(
            run_id=run.id,
            verdict=verdict,
            lens="pinhole5",
            intrinsics={},
            covariance=[],
            rms_px=0.1,
            sigma_px=0.07,
            document={},
            versions={},
            created_at=run.created_at,
        )
        self._session.add(calibration)
        for name in {"rms_px", *failed}:
            self._session.add(
                MeasurementRow(
                    calibration_id=calibration.id,
                    gate="fit",
                    name=name,
                    value=0.4,
                    unit="px",
                    limit=0.35,
                    comparison="<=",
                    margin=-0.05,
                    verdict=FAIL if name in failed else PASS,
                    advice="Look.",
                )
            )
