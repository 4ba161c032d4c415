"""A plant that has worked for a month: two camera variants, three stations, many runs, one of them open."""

from dataclasses import dataclass
from datetime import datetime, timedelta
from typing import Any

import cv2
import numpy as np

from service.adapters.clock_system import SystemClock
from service.app import open_database
from service.core.run import Purpose
from service.demo.customer import Customer
from service.demo.skus import PAPER_SKUS
from service.demo.virtual_vehicle import draw_vehicle, photograph
from tests.browser.serving import Serving
from tests.line import FAIL, MARGINAL, PASS, Line

SKU = PAPER_SKUS[0]
STATIONS = ("cal1", "cal2", "cal10")
CAUSES = (("edge_width_px",), ("edge_width_px", "rms_px"), ("coverage",), ("zone_mapping_px", "coverage"))


@dataclass(frozen=True)
class Month:
    """What was made: the planned pose set, and the id of the run that is open at cal1."""

    pose_set: dict[str, Any]
    open_id: str


def make_month(serving: Serving, customer: Customer) -> Month:
    """Describe two SKUs, plan one, add 30 days of runs, and open a run at a station with one capture."""
    for sku in PAPER_SKUS:
        customer.describe_sku(sku)
    pose_set = customer.plan_poses(SKU["code"], lambda _: None)
    _add_days(serving)
    order = {"sku": SKU["code"], "serial": "VIN-NOW-0001", "station": "cal1", "purpose": "simulated"}
    opened = customer.ask("POST", "/runs", json=order)
    vehicle = draw_vehicle(SKU, np.random.default_rng(7))
    image = next(iter(photograph(vehicle, SKU, pose_set["poses"][:1], seed=7)))
    png = cv2.imencode(".png", image)[1].tobytes()
    customer.ask(
        "POST",
        f"/runs/{opened['id']}/captures",
        params={"pose_index": 0},
        files={"image": ("pose-01.png", png, "image/png")},
    )
    return Month(pose_set, opened["id"])


def _add_days(serving: Serving) -> None:
    rng = np.random.default_rng(11)
    now = SystemClock().now()
    database = open_database(serving.settings)
    with database.write() as session:
        line = Line(session)
        for day in range(29, -1, -1):
            # Nobody works on Sundays.
            if (now - timedelta(days=day)).isoweekday() < 7:
                _add_day(line, rng, now - timedelta(days=day, minutes=30), day)
        line.station(STATIONS[2])
    database.close()


def _add_day(line: Line, rng: np.random.Generator, end: datetime, day: int) -> None:
    for i in range(int(rng.integers(3, 9))):
        verdict = rng.choice([PASS, PASS, PASS, PASS, PASS, PASS, MARGINAL, FAIL])
        at, serial = end - timedelta(minutes=3 * i), f"VIN-{day:02d}-{i:02d}"
        place = {"sku": PAPER_SKUS[i % 3 // 2]["code"], "station": (*STATIONS[:2], None)[i % 7 // 3]}
        causes = CAUSES[int(rng.integers(4))] if verdict == FAIL else ()
        line.run(serial, verdict, at=at, failed=causes, **place)
        if verdict == FAIL:
            line.run(serial, PASS, at=at + timedelta(minutes=2), purpose=Purpose.RETEST, **place)
