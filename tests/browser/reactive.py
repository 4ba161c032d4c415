"""Stations whose kiosk has a reactive camera in its page, and the truth behind that camera."""

import json
from pathlib import Path
from typing import Any

import numpy as np
from playwright.sync_api import Browser, Page

from service.core.vision.target import parse_target
from service.core.vision.transforms import Array, rotation_matrix
from service.demo.customer import Customer
from tests.browser.serving import Serving
from tests.plant import SKU

SCRIPT = (Path(__file__).parent / "reactive_camera.js").read_text()
# Few poses on short ways, so that nobody waits; a line would not be content with what they cover.
# Of its board there is only one way up, unlike that of the tiny camera.
FEW: dict[str, Any] = {
    **SKU,
    "code": "few",
    "target": "chessboard:7x4:30mm",
    "limits": {**SKU["limits"], "coverage": 0.4},
}
# Centre of the board, m, and its rotation vector, deg: each asks for several hints, and all together for all.
POSES = (
    ((0.05, -0.03, 0.42), (30.0, 0.0, 0.0)),
    ((-0.03, 0.02, 0.34), (0.0, 32.0, 12.0)),
    ((0.02, 0.0, 0.38), (-32.0, -12.0, 0.0)),
)
START = (0.03, 0.0, 0.38)
# The camera at the station, which nobody but the page knows: as far from its data sheet as cameras are.
TRUTH = {
    **SKU["nominal"],
    "fx": 677.7,
    "fy": 678.7,
    "cx": 330.3,
    "cy": 190.9,
    "p1": 0.0,
    "p2": 0.0,
    "k3": 0.0,
}


def prepare_reactive(serving: Serving, *stations: str) -> None:
    """Publish the camera with few poses, and register stations whose kiosk brings it."""
    customer = Customer.of(serving.url, serving.key)
    with customer.http:
        prepare_sku(customer)
        for code in stations:
            customer.ask("POST", "/stations", json={"code": code, "name": code, "source": "browser"})


def prepare_sku(customer: Customer, code: str = FEW["code"]) -> None:
    """Publish the camera with few poses under a code."""
    centre = parse_target(FEW["target"]).centre
    poses = [_pose(np.array(at), np.deg2rad(turned), centre) for at, turned in POSES]
    customer.describe_sku({**FEW, "code": code})
    asked = customer.ask("POST", f"/skus/{code}/revisions/1/pose-sets", json={"poses": poses})
    customer.ask("POST", f"/pose-sets/{asked['pose_set']['id']}/publish")


def reactive_page(
    browser: Browser, board: str = FEW["target"], upside_down: bool = False, **options: Any
) -> Page:
    """A page in which an operator holds a board before the camera; options as in reactive_camera.js."""
    width, height = SKU["image_size"]
    target = parse_target(board)
    told = {
        "camera": {"width": width, "height": height, **TRUTH},
        "board": {"columns": target.columns, "rows": target.rows, "square_m": target.square_m},
        "start": {"centre": START, "upside_down": upside_down},
        **options,
    }
    context = browser.new_context(viewport={"width": 1024, "height": 640}, locale="en-GB")
    page = context.new_page()
    page.set_default_timeout(20_000)
    page.add_init_script(f"window.reactive = {json.dumps(told)};\n{SCRIPT}")
    return page


def _pose(at: Array, rvec: Array, centre: Array) -> dict[str, list[float]]:
    return {"rvec": rvec.tolist(), "tvec": (at - rotation_matrix(rvec) @ centre).tolist()}
