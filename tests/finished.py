"""A finished run of any lens and verdict, without a database: for what is made of results."""

from datetime import timedelta
from uuid import UUID

import numpy as np

from service.core.quality.gates import Verdict
from service.core.run import Purpose
from service.core.vision.camera import Intrinsics, parameter_names
from service.core.vision.transforms import Pose
from service.storage.models import MeasurementRow
from service.usecases.finished_run import FinishedRun, ImageOfRun, RunFacts, ViewOfRun
from service.usecases.sku_document import SkuDocument
from service.usecases.vehicle_place import VehiclePlace
from tests.fakes import START

COEFFICIENTS = {
    "pinhole5": {"k1": -0.3774, "k2": 0.2425, "p1": 1e-5, "p2": -2.3e-5, "k3": 0.01},
    "rational8": {
        "k1": 0.31,
        "k2": -0.02,
        "p1": 1e-5,
        "p2": 3e-5,
        "k3": 1e-4,
        "k4": 0.6,
        "k5": 1e-3,
        "k6": 1e-6,
    },
    "kannala_brandt4": {"k1": 0.03, "k2": -0.01, "k3": 1.5e-05, "k4": -2e-22},
}
PINHOLE = {"fx": 1350.1234567890123, "fy": 1352.1, "cx": 657.6, "cy": 383.79999999999995}
SIZE = (1280, 800)


def finished_run(
    lens: str = "pinhole5",
    verdict: Verdict = Verdict.PASS,
    *,
    serial: str = "VIN-0001",
    images: int = 6,
    sku_name: str = "Cabin camera",
    place: VehiclePlace | None = None,
    **parameters: float,
) -> FinishedRun:
    """A finished run; `parameters` replace some of the lens's."""
    values = PINHOLE | COEFFICIENTS[lens] | parameters
    facts = RunFacts(
        run_id=UUID("01900000-0000-7000-8000-000000000001"),
        result_id=UUID("01900000-0000-7000-8000-000000000002"),
        serial=serial,
        sku="lens1",
        sku_name=sku_name,
        revision=3,
        station="line1-cal2",
        purpose=Purpose.PRODUCTION,
        opened_at=START,
        finished_at=START + timedelta(minutes=1, microseconds=5),
        verdict=verdict,
        intrinsics=Intrinsics.from_parameters(lens, values, SIZE),
        covariance=_covariance(lens),
        rms_px=0.117,
        sigma_px=0.0825,
        measurements=_measurements(verdict),
        versions={"service": "0.1.0", "opencv": "5.0.0"},
    )
    return FinishedRun(
        facts=facts,
        document={"verdict": verdict.value, "rms_px": 0.117, "mapping": MAPPING, "views": []},
        views=_views(images),
        images=tuple(ImageOfRun(number, f"{number:064x}") for number in range(1, images + 1)),
        sku=SkuDocument.model_validate(
            {
                "code": "lens1",
                "name": "Cabin camera",
                "lens": lens,
                "image_size": list(SIZE),
                "nominal": values,
                "target": "chessboard:9x6:25mm",
            }
        ),
        signed_by="kPrK_qmxVWaYVA9wwBF6Iuo3vVzz7TxHCTwXBygrS4k",
        place=place,
    )


PLACE = VehiclePlace(
    Pose(np.array([0.1, -2.2, 0.3]), np.array([1.42, -0.36, 0.98])),
    np.diag(np.array([1e-4, 2e-4, 1e-4, 3e-4, 4e-4, 2e-4]) ** 2),
    later_id=None,
)
MAPPING = {
    "zone_mean_px": 0.0412,
    "zone_worst_px": 0.0903,
    "valid_mean_px": 0.0611,
    "valid_worst_px": 0.2104,
}


def _covariance(lens: str) -> np.ndarray:
    sd = np.array([0.21, 0.21, 0.4, 0.3, *[1e-3] * (len(parameter_names(lens)) - 4)])
    sd[-1] = 0.0
    return np.diag(sd**2)


def _measurements(verdict: Verdict) -> tuple[MeasurementRow, ...]:
    rows = [
        ("fit", "rms_px", 0.117, "px", 0.35, "<=", 0.233),
        ("poses", "coverage", 0.91, "", 0.85, ">=", 0.06),
    ]
    rows += [("model", "converged", 1.0, "", 1.0, "==", 0.0)]
    made = [
        MeasurementRow(
            calibration_id=UUID(int=2),
            gate=gate,
            name=name,
            value=value,
            unit=unit,
            limit=limit,
            comparison=comparison,
            margin=margin,
            verdict=verdict if name == "rms_px" else Verdict.PASS,
            advice="Take the images again with a sharp lens.",
        )
        for gate, name, value, unit, limit, comparison, margin in rows
    ]
    reported = MeasurementRow(
        calibration_id=UUID(int=2),
        gate="score",
        name="paper_score",
        value=None,
        unit="1/px",
        limit=None,
        comparison="<=",
        margin=None,
        verdict=Verdict.PASS,
        advice="",
    )
    return (*made, reported)


def _views(count: int) -> tuple[ViewOfRun, ...]:
    rng = np.random.default_rng(3)
    return tuple(
        ViewOfRun(number, rng.uniform((0, 0), SIZE, (54, 2)), rng.normal(0, 0.0825, (54, 2)))
        for number in range(1, count + 1)
    )
