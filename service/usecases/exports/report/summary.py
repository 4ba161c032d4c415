"""The first page: the verdict, who and when, the camera's parameters with their sd, and what is not PASS."""

from service.core.quality.gates import Verdict
from service.core.vision.camera import PINHOLE
from service.usecases.exports.report import figures
from service.usecases.exports.report.paper import (
    BOLD,
    BOTTOM,
    GROUND,
    INNER,
    MARGIN,
    MUTED,
    SANS,
    SMALL,
    STRONG,
    VERDICTS,
    Anchor,
    Paper,
    Style,
    cut,
    lines_of,
)
from service.usecases.exports.report.vehicle import WIDTH, draw_place
from service.usecases.finished_run import FinishedRun

SAID = {
    Verdict.PASS: "Every measurement is within its limit.",
    Verdict.MARGINAL: "Every measurement is within its limit, some with little margin.",
    Verdict.FAIL: "This calibration did not pass. Do not use it.",
}
HALF = INNER / 2


def draw_summary(paper: Paper, run: FinishedRun) -> None:
    """Draw the page from below its head."""
    y = _verdict(paper, run, 84.0)
    y = _facts(paper, run, y + 26)
    y = _parameters(paper, run, y + 22)
    y = _key_figures(paper, run, y + 12)
    _reasons(paper, run, y + 28)


def _verdict(paper: Paper, run: FinishedRun, y: float) -> float:
    verdict = run.facts.verdict
    ink, tint = VERDICTS[verdict]
    paper.box(MARGIN, y, INNER, 66, tint)
    paper.box(MARGIN, y, 7, 66, ink)
    paper.text(MARGIN + 24, y + 44, verdict.value, Style(32, BOLD, ink))
    right = Style(10, colour=ink, anchor="right")
    paper.text(MARGIN + INNER - 16, y + 29, SAID[verdict], Style(10, BOLD, ink, "right"))
    judged = run.facts.measurements
    counts = {one: sum(row.verdict is one for row in judged) for one in (Verdict.FAIL, Verdict.MARGINAL)}
    told = ", ".join(f"{count} {one.value}" for one, count in counts.items() if count) or "all PASS"
    paper.text(MARGIN + INNER - 16, y + 45, f"{len(judged)} measurements: {told}", right)
    return y + 66


def _facts(paper: Paper, run: FinishedRun, y: float) -> float:
    facts = run.facts
    width, height = facts.intrinsics.image_size
    pairs = [
        ("Serial", facts.serial),
        ("SKU", f"{facts.sku}, revision {facts.revision}"),
        ("Name", facts.sku_name),
        ("Station", facts.station or "none named"),
        ("Purpose", facts.purpose.value),
        ("Opened", f"{facts.opened_at:%Y-%m-%d %H:%M:%S} UTC"),
        ("Finished", f"{facts.finished_at:%Y-%m-%d %H:%M:%S} UTC"),
        ("Lens model", facts.intrinsics.lens),
        ("Image", f"{width} x {height} px"),
        ("Target", run.sku.target),
        ("Images used", f"{len(run.views)} of {len(run.images)}"),
        ("Corners", str(sum(len(view.corners) for view in run.views))),
    ]
    rows = (len(pairs) + 1) // 2
    for place, (name, value) in enumerate(pairs):
        x = MARGIN + HALF * (place // rows)
        row = y + 15 * (place % rows)
        paper.text(x, row, name, Style(9, colour=MUTED))
        paper.text(x + 70, row, cut(value, HALF - 80, STRONG), STRONG)
    return y + 15 * (rows - 1)


def _parameters(paper: Paper, run: FinishedRun, y: float) -> float:
    y = paper.heading(y, "Parameters")
    heads: tuple[tuple[str, float, Anchor], ...] = (
        ("Parameter", 0, "left"),
        ("Value", 190, "right"),
        ("sd", 290, "right"),
        ("Unit", 306, "left"),
    )
    for text, x, anchor in heads:
        paper.text(MARGIN + x, y, text, Style(7.5, colour=MUTED, anchor=anchor))
    if run.place is not None:
        draw_place(paper, run.place, MARGIN + INNER - WIDTH, y)
    sd = run.facts.sd
    for place, (name, value) in enumerate(run.facts.intrinsics.parameters.items()):
        y += 14
        if place % 2 == 0:
            paper.box(MARGIN - 4, y - 10, 356, 14, GROUND)
        shown, spread = figures.with_sd(value, sd[name])
        paper.text(MARGIN, y, name, STRONG)
        paper.text(MARGIN + 190, y, shown, Style(9, anchor="right"))
        paper.text(MARGIN + 290, y, spread, Style(9, anchor="right"))
        paper.text(MARGIN + 306, y, "px" if name in PINHOLE else "", SMALL)
    return y


def _key_figures(paper: Paper, run: FinishedRun, y: float) -> float:
    mapping = run.document["mapping"]
    tiles = (
        ("RMS error", run.facts.rms_px, "of all corners"),
        ("Corner noise", run.facts.sigma_px, "sd of one coordinate"),
        ("Mapping error, mean", mapping["zone_mean_px"], "expected, working zone"),
        ("Mapping error, worst", mapping["valid_worst_px"], "expected, valid region"),
    )
    gap = 10.0
    width = (INNER - 3 * gap) / 4
    for place, (title, value, note) in enumerate(tiles):
        x = MARGIN + place * (width + gap)
        paper.box(x, y, width, 52, GROUND)
        paper.text(x + 9, y + 14, title, SMALL)
        paper.text(x + 9, y + 32, f"{figures.number(value, 3)} px", Style(15, BOLD))
        paper.text(x + 9, y + 45, note, SMALL)
    return y + 52


def _reasons(paper: Paper, run: FinishedRun, y: float) -> None:
    """Say what is not PASS, the failures first, as far as there is room."""
    found = [row for row in run.facts.measurements if row.verdict is not Verdict.PASS]
    if not found:
        return
    found.sort(key=lambda row: row.verdict is not Verdict.FAIL)
    y = paper.heading(y, "What is not PASS")
    style = Style(8.5, SANS)
    for place, row in enumerate(found):
        lines = lines_of(row.advice, INNER - 62, style)
        if y + 12 * (len(lines) + 1) > BOTTOM - 12:
            paper.text(MARGIN, y, f"And {len(found) - place} more on the next page.", SMALL)
            return
        paper.text(MARGIN, y, row.verdict.value, Style(8, BOLD, VERDICTS[row.verdict][0]))
        value = f"{figures.name(row)}: {figures.number(row.value)} {row.unit}".rstrip()
        paper.text(MARGIN + 62, y, f"{value} ({figures.limit(row)})", Style(8.5, BOLD))
        y = paper.paragraph(MARGIN + 62, y + 11.5, INNER - 62, row.advice, style) + 4
