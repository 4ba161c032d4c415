"""Drawings of the third page: residuals over the image and as a cloud, by image, and the expected error."""

import math

import numpy as np

from service.core.quality.coverage import default_valid_region, default_working_zone
from service.core.vision.transforms import Array
from service.core.vision.uncertainty import Region, compensated_jacobian
from service.usecases.exports.report.figures import number
from service.usecases.exports.report.paper import (
    CHOSEN,
    HEIGHT,
    INK,
    LINE,
    MUTED,
    POINT,
    SMALL,
    Paper,
    Style,
    heat_colour,
)
from service.usecases.finished_run import FinishedRun

HEAT_COLUMNS = 48
ARROW_SHARE = 0.025
GAINS = (1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000)
MIDDLE, RIGHT = Style(7, colour=MUTED, anchor="middle"), Style(7, colour=MUTED, anchor="right")


def draw_vectors(paper: Paper, run: FinishedRun, x: float, y: float, width: float) -> float:
    """Draw every residual at its place in the image, longer than it is; return the y below."""
    image_width, image_height = run.facts.intrinsics.image_size
    scale = width / image_width
    height = image_height * scale
    gain = max((g for g in GAINS if g * run.facts.rms_px <= ARROW_SHARE * image_width), default=1)
    paper.box(x, y, width, height, None, line=LINE)
    paper.canvas.saveState()
    _clip(paper, x, y, width, height)
    for view in run.views:
        starts = (view.corners - view.residuals + 0.5) * scale
        ends = starts + gain * scale * view.residuals
        for (u, v), (to_u, to_v) in zip(starts, ends, strict=True):
            paper.line(x + u, y + v, x + to_u, y + to_v, POINT, width=0.5)
            paper.circle(x + to_u, y + to_v, 0.7, POINT, fill=True)
    paper.canvas.restoreState()
    paper.text(x, y + height + 11, f"all images, {gain} times as long; the dot is the detected corner", SMALL)
    return y + height + 14


def draw_heat(paper: Paper, run: FinishedRun, x: float, y: float, width: float) -> float:
    """Draw the expected mapping error over the image with its scale; return the y below."""
    image_width, image_height = run.facts.intrinsics.image_size
    scale = width / image_width
    rows = max(1, round(HEAT_COLUMNS * image_height / image_width))
    errors = expected_errors(run, HEAT_COLUMNS, rows)
    worst = _scale_end(run, errors)
    cell_x, cell_y = width / HEAT_COLUMNS, image_height * scale / rows
    for row, column in np.ndindex(errors.shape):
        if np.isfinite(errors[row, column]):
            colour = heat_colour(float(errors[row, column]) / worst)
            # Cells that only touch would show the paper between them.
            paper.box(x + column * cell_x, y + row * cell_y, cell_x + 0.3, cell_y + 0.3, colour)
    paper.box(x, y, width, image_height * scale, None, line=LINE)
    for region, dashes in ((_valid_region(run), (1.0, 2.0)), (_working_zone(run), (4.0, 2.5))):
        paper.dashes(*dashes)
        _outline(paper, region, x, y, scale)
    paper.dashes()
    below = y + image_height * scale
    _scale_bar(paper, x, below + 6, width, worst)
    paper.text(x, below + 33, "dashed: working zone; dotted: valid region", SMALL)
    return below + 36


def draw_cloud(paper: Paper, run: FinishedRun, x: float, y: float, size: float) -> None:
    """Draw all residuals about the middle, with circles at one, two and three sigma."""
    residuals = np.concatenate([view.residuals for view in run.views])
    sigma = run.facts.sigma_px
    largest = float(np.abs(residuals).max(initial=0.0))
    reach = 1.08 * min(max(largest, 4 * sigma), 12 * sigma) or 1.0
    scale, middle_x, middle_y = 0.5 * size / reach, x + size / 2, y + size / 2
    paper.box(x, y, size, size, None, line=LINE)
    paper.line(x, middle_y, x + size, middle_y)
    paper.line(middle_x, y, middle_x, y + size)
    within = residuals[np.abs(residuals).max(axis=1) <= reach]
    for du, dv in within:
        paper.circle(middle_x + du * scale, middle_y + dv * scale, 0.8, POINT, fill=True)
    for times in (1, 2, 3):
        if times * sigma < reach:
            paper.circle(middle_x, middle_y, times * sigma * scale, CHOSEN, fill=False)
    outside = len(residuals) - len(within)
    told = f"+/- {reach:.2g} px; circles at 1, 2, 3 sigma" + (f"; {outside} outside" if outside else "")
    paper.text(x, y + size + 11, told, SMALL)


def draw_views(paper: Paper, run: FinishedRun, x: float, y: float, width: float, *, height: float) -> None:
    """Draw the rms of each image as a bar, with the rms of all as a line."""
    rms = [math.sqrt(float(np.mean(np.sum(view.residuals**2, axis=1)))) for view in run.views]
    top = 1.1 * max([*rms, run.facts.rms_px]) or 1.0
    step = width / max(len(rms), 1)
    paper.line(x, y + height, x + width, y + height)
    every = max(1, math.ceil(len(rms) / 24))
    for place, (view, value) in enumerate(zip(run.views, rms, strict=True)):
        bar = height * value / top
        paper.box(x + (place + 0.15) * step, y + height - bar, 0.7 * step, bar, POINT)
        if place % every == 0:
            paper.text(x + (place + 0.5) * step, y + height + 9, str(view.number), MIDDLE)
    line = y + height - height * run.facts.rms_px / top
    paper.line(x, line, x + width, line, CHOSEN, width=0.8)
    paper.text(x + width, y - 3, f"line: rms of all, {number(run.facts.rms_px, 3)} px", RIGHT)


def expected_errors(run: FinishedRun, columns: int, rows: int) -> Array:
    """Return the expected mapping error (rows, columns) px; NaN beyond the lens.

    The rotation that fits the working zone best is taken out.
    """
    width, height = run.facts.intrinsics.image_size
    u, v = width / columns, height / rows
    centres = Region(u / 2 - 0.5, v / 2 - 0.5, width - 0.5 - u / 2, height - 0.5 - v / 2).grid(columns, rows)
    J = compensated_jacobian(run.facts.intrinsics, centres, _working_zone(run))
    variances = np.einsum("mif,fg,mig->m", J, run.facts.covariance, J)
    errors: Array = np.sqrt(np.maximum(variances, 0.0)).reshape(rows, columns)
    return errors


def _scale_end(run: FinishedRun, errors: Array) -> float:
    """Return the error at the end of the scale: the corners beyond the valid region must not rule it."""
    worst = run.document["mapping"]["valid_worst_px"]
    if worst is not None and worst > 0:
        return float(worst)
    known = errors[np.isfinite(errors)]
    return float(known.max(initial=0.0)) or 1.0


def _scale_bar(paper: Paper, x: float, y: float, width: float, worst: float) -> None:
    steps = 60
    for step in range(steps):
        paper.box(x + width * step / steps, y, width / steps + 0.3, 7, heat_colour(step / (steps - 1)))
    for share, style in ((0.0, Style(7, colour=MUTED)), (0.5, MIDDLE), (1.0, RIGHT)):
        more = " px or more" if share == 1.0 else ""
        paper.text(x + share * width, y + 16, f"{number(share * worst, 3)}{more}", style)


def _working_zone(run: FinishedRun) -> Region:
    zone = run.sku.working_zone
    return default_working_zone(run.facts.intrinsics.image_size) if zone is None else zone.to_region()


def _valid_region(run: FinishedRun) -> Region:
    region = run.sku.valid_region
    return default_valid_region(run.facts.intrinsics.image_size) if region is None else region.to_region()


def _outline(paper: Paper, region: Region, x: float, y: float, scale: float) -> None:
    width = (region.right_px - region.left_px) * scale
    height = (region.bottom_px - region.top_px) * scale
    left, top = x + (region.left_px + 0.5) * scale, y + (region.top_px + 0.5) * scale
    paper.box(left, top, width, height, None, line=INK)


def _clip(paper: Paper, x: float, y: float, width: float, height: float) -> None:
    path = paper.canvas.beginPath()
    path.rect(x, HEIGHT - y - height, width, height)
    paper.canvas.clipPath(path, stroke=0, fill=0)
