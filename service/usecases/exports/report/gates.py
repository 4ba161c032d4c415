"""The second page: every measurement with its limit, its margin, and how much of the limit it uses."""

from service.storage.models import MeasurementRow
from service.usecases.exports.report import figures
from service.usecases.exports.report.paper import (
    BOLD,
    BOTTOM,
    GROUND,
    INK,
    INNER,
    LINE,
    MARGIN,
    MUTED,
    SMALL,
    VERDICTS,
    Anchor,
    Paper,
    Style,
    cut,
)
from service.usecases.finished_run import FinishedRun

TOP = 92.0
TALLEST = 16.0
BAR_X, BAR_WIDTH = 380.0, 70.0
# So much of a bar is the way to the limit; what is beyond it is cut off at the bar's end.
LIMIT_SHARE = 0.75
HEADS: tuple[tuple[str, float, Anchor], ...] = (
    ("Gate", 0, "left"),
    ("Measurement", 62, "left"),
    ("Value", 244, "right"),
    ("Limit", 308, "right"),
    ("Margin", 368, "right"),
    ("Used of the limit", BAR_X, "left"),
    ("Verdict", INNER, "right"),
)


def draw_gates(paper: Paper, run: FinishedRun) -> None:
    """Draw the page from below its head; rows are as high as the page lets them be."""
    y = paper.heading(TOP, "Gates")
    for text, x, anchor in HEADS:
        paper.text(MARGIN + x, y, text, Style(7.5, colour=MUTED, anchor=anchor))
    rows = run.facts.measurements
    height = min(TALLEST, (BOTTOM - y - 20) / max(len(rows), 1))
    gate = ""
    for place, row in enumerate(rows):
        y += height
        if place % 2 == 0:
            paper.box(MARGIN - 4, y - 0.7 * height, INNER + 8, height, GROUND)
        if row.gate != gate:
            gate = row.gate
            paper.text(MARGIN, y, gate.replace("_", " "), Style(_size(height), BOLD))
        _row(paper, row, y, height)
    paper.text(MARGIN, y + height + 2, "The line across the bars is the limit.", SMALL)


def _row(paper: Paper, row: MeasurementRow, y: float, height: float) -> None:
    style = Style(_size(height))
    right = Style(style.size, anchor="right")
    paper.text(MARGIN + 62, y, cut(figures.name(row), 112, style), style)
    paper.text(MARGIN + 244, y, f"{figures.number(row.value)} {row.unit}".rstrip(), right)
    paper.text(MARGIN + 308, y, figures.limit(row), right)
    paper.text(MARGIN + 368, y, figures.number(row.margin, 3), right)
    _bar(paper, row, y, height)
    ink = VERDICTS[row.verdict][0] if row.limit is not None else MUTED
    said = row.verdict.value if row.limit is not None else "reported"
    paper.text(MARGIN + INNER, y, said, Style(style.size, BOLD, ink, "right"))


def _bar(paper: Paper, row: MeasurementRow, y: float, height: float) -> None:
    share = figures.used_share(row)
    if share is None:
        return
    x, top, thick = MARGIN + BAR_X, y - 0.48 * height, 0.4 * height
    length = min(share * LIMIT_SHARE, 1.0) * BAR_WIDTH
    paper.box(x, top, BAR_WIDTH, thick, LINE)
    paper.box(x, top, length, thick, VERDICTS[row.verdict][0])
    at = x + LIMIT_SHARE * BAR_WIDTH
    paper.line(at, top - 1.5, at, top + thick + 1.5, INK, width=0.9)


def _size(height: float) -> float:
    return min(8.5, 0.62 * height)
