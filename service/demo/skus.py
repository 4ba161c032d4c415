"""The two SKUs of the paper: its Lens 1 (IR) and Lens 2 (RGB), with the values of its Table 2."""

from typing import Any

TARGET = "chessboard:9x6:25mm"

PAPER_SKUS: tuple[dict[str, Any], ...] = (
    {
        "code": "lens1",
        "name": "Paper, Lens 1: IR 1280x800",
        "lens": "pinhole5",
        "image_size": [1280, 800],
        "nominal": {"fx": 1350.1, "fy": 1352.1, "cx": 657.6, "cy": 383.8, "k1": -0.3774, "k2": 0.2425},
        "target": TARGET,
        "pose_count": 12,
    },
    {
        "code": "lens2",
        "name": "Paper, Lens 2: RGB 1920x1208",
        "lens": "pinhole5",
        "image_size": [1920, 1208],
        "nominal": {"fx": 972.5, "fy": 974.4, "cx": 954.9, "cy": 644.4, "k1": -0.3454, "k2": 0.1398},
        "target": TARGET,
        "pose_count": 12,
    },
)
