"""Runs made over HTTP as a station makes them: one that passes, one that fails, one that is still open."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from service.demo.customer import Customer
from service.demo.skus import PAPER_SKUS
from service.demo.virtual_vehicle import draw_vehicle, photograph

SKU = PAPER_SKUS[0]
Images = Iterable[NDArray[np.uint8]]


@dataclass(frozen=True)
class Runs:
    """Ids and answers of the runs; `passing` and `failing` are results."""

    passing: dict[str, Any]
    failing: dict[str, Any]
    open_id: str


def make_runs(customer: Customer) -> Runs:
    """Describe and plan a SKU, then calibrate two vehicles with rendered captures and begin a third."""
    customer.describe_sku(SKU)
    pose_set = customer.plan_poses(SKU["code"], lambda _: None)
    images = list(photograph(draw_vehicle(SKU, np.random.default_rng(7)), SKU, pose_set["poses"], seed=7))
    passing = customer.calibrate(_order("VIN-PASS-0001"), images)
    failing = customer.calibrate(_order("VIN-FAIL-0002"), _defocused(images))
    opened = customer.ask("POST", "/runs", json=_order("VIN-OPEN-0003"))
    png = cv2.imencode(".png", images[0])[1].tobytes()
    customer.ask(
        "POST",
        f"/runs/{opened['id']}/captures",
        params={"pose_index": 0},
        files={"image": ("pose-01.png", png, "image/png")},
    )
    return Runs(passing, failing, opened["id"])


def _order(serial: str) -> dict[str, Any]:
    return {"sku": SKU["code"], "serial": serial, "purpose": "simulated"}


def _defocused(images: Images) -> Iterator[NDArray[np.uint8]]:
    for image in images:
        yield np.asarray(cv2.GaussianBlur(image, (0, 0), 3.0), dtype=np.uint8)
