"""Photographs that others took, calibrated over REST as a plant would."""

import os
from pathlib import Path

import pytest

from tests.plant import Plant

DATA = Path(__file__).resolve().parents[3] / "shared" / "data"
IMAGES = DATA / "opencv_left_right"
FISHEYE_IMAGES = DATA / "boofcv_fisheye_chess"

pytestmark = [
    pytest.mark.data,
    pytest.mark.skipif(
        not IMAGES.is_dir() and "CI" not in os.environ,
        reason="../shared/data is not here",
    ),
]
# A data sheet some per cent off; 25 mm stands in for the squares, whose size nobody has published.
SKU = {
    "code": "opencv",
    "name": "OpenCV's sample camera",
    "lens": "pinhole5",
    "image_size": [640, 480],
    "nominal": {"fx": 550.0, "fy": 550.0, "cx": 320.0, "cy": 240.0},
    "target": "chessboard:9x6:25mm",
}
FISHEYE_SKU = {
    "code": "fisheye",
    "name": "BoofCV's sample fisheye",
    "lens": "kannala_brandt4",
    "image_size": [640, 720],
    "nominal": {"fx": 200.0, "fy": 200.0, "cx": 320.0, "cy": 330.0},
    "target": "chessboard:6x4:30mm",
}


@pytest.mark.parametrize(
    ("side", "published"),
    [("left", (532.9, 533.0, 342.4, 233.9)), ("right", (537.4, 537.0, 327.3, 249.0))],
)
def test_the_opencv_pictures_give_the_published_camera(
    small_plant: Plant, side: str, published: tuple[float, ...]
) -> None:
    plant = small_plant
    plant.expect(201, plant.post("/skus", SKU))
    plant.expect(200, plant.post("/skus/opencv/revisions/1/publish"))
    run = plant.expect(201, plant.post("/runs", {"sku": "opencv", "serial": side, "purpose": "trial"}))

    for path in sorted(IMAGES.glob(f"{side}*.jpg")):
        plant.expect(201, plant.send(run["id"], path.read_bytes(), media_type="image/jpeg"))
    result = plant.expect(200, plant.finish(run["id"]))

    assert len(result["views"]) == 13
    assert result["rms_px"] <= 0.175
    for name, value in zip(("fx", "fy", "cx", "cy"), published, strict=True):
        assert abs(result["intrinsics"][name] - value) <= 1.5
    vehicle = plant.expect(200, plant.get(f"/vehicles/{side}"))
    assert vehicle["latest_result"]["id"] == result["id"]


def test_a_real_fisheye_is_calibrated_by_its_model(small_plant: Plant) -> None:
    plant = small_plant
    plant.expect(201, plant.post("/skus", FISHEYE_SKU))
    plant.expect(200, plant.post("/skus/fisheye/revisions/1/publish"))
    run = plant.expect(201, plant.post("/runs", {"sku": "fisheye", "serial": "boofcv", "purpose": "trial"}))

    for path in sorted(FISHEYE_IMAGES.glob("*.jpg")):
        plant.expect(201, plant.send(run["id"], path.read_bytes(), media_type="image/jpeg"))
    result = plant.expect(200, plant.finish(run["id"]))

    assert result["lens"] == "kannala_brandt4"
    assert set(result["intrinsics"]) == {"fx", "fy", "cx", "cy", "k1", "k2", "k3", "k4"}
    assert len(result["views"]) == 26
    assert result["rms_px"] <= 0.25
    assert abs(result["intrinsics"]["fx"] / result["intrinsics"]["fy"] - 1.0) < 0.002
