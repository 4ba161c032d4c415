"""Where the camera is in its vehicle, beside the parameters of the first page."""

import numpy as np

from service.usecases.exports.report import figures
from service.usecases.exports.report.paper import BOLD, MUTED, SMALL, STRONG, Paper, Style
from service.usecases.vehicle_place import AXES, VehiclePlace

WIDTH = 136.0


def draw_place(paper: Paper, place: VehiclePlace, x: float, y: float) -> None:
    """Draw position and rotation vector in the vehicle frame with their sd."""
    paper.text(x, y, "Camera in the vehicle", Style(9, BOLD))
    sd = place.sd
    rows = [
        *(
            (axis, 1000.0 * v, 1000.0 * s, "mm")
            for axis, v, s in zip(AXES, place.pose.tvec, sd[3:], strict=True)
        ),
        *(
            (f"r{axis}", np.degrees(v), np.degrees(s), "deg")
            for axis, v, s in zip(AXES, place.pose.rvec, sd[:3], strict=True)
        ),
    ]
    for name, value, spread, unit in rows:
        y += 14
        shown, deviation = figures.with_sd(float(value), float(spread))
        paper.text(x, y, name, STRONG)
        paper.text(x + 66, y, shown, Style(9, anchor="right"))
        paper.text(x + 110, y, deviation, Style(9, anchor="right"))
        paper.text(x + 114, y, unit, SMALL)
    measured = "with the run" if place.later_id is None else "after the run"
    paper.text(x, y + 14, f"T_vehicle_cam, measured {measured}", Style(7.5, colour=MUTED))
