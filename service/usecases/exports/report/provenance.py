"""The third page: what the residuals look like, and all by which the result can be traced and checked."""

from service.usecases.certificate import result_hash
from service.usecases.exports.report.paper import (
    BOTTOM,
    INNER,
    MARGIN,
    MONO,
    MUTED,
    SMALL,
    Paper,
    Style,
)
from service.usecases.exports.report.plots import draw_cloud, draw_heat, draw_vectors, draw_views
from service.usecases.finished_run import FinishedRun

GAP = 22.0
COLUMN = (INNER - GAP) / 2
RIGHT_X = MARGIN + COLUMN + GAP
HASH = Style(5.3, MONO)
CLOUD = 150.0


def draw_provenance(paper: Paper, run: FinishedRun) -> None:
    """Draw the page from below its head."""
    y = 92.0
    paper.heading(y, "Residuals over the image", MARGIN, COLUMN)
    paper.heading(y, "Expected mapping error", RIGHT_X, COLUMN)
    below = draw_heat(paper, run, RIGHT_X, y + 14, COLUMN)
    y = max(draw_vectors(paper, run, MARGIN, y + 14, COLUMN), below) + 24
    paper.heading(y, "Residuals of all corners", MARGIN, COLUMN)
    paper.heading(y, "RMS of each image", RIGHT_X, COLUMN)
    draw_cloud(paper, run, MARGIN, y + 14, CLOUD)
    draw_views(paper, run, RIGHT_X, y + 26, COLUMN, height=CLOUD - 22)
    _trace(paper, run, y + CLOUD + 50)


def _trace(paper: Paper, run: FinishedRun, y: float) -> None:
    y = paper.heading(y, "Traceability")
    versions = ", ".join(f"{name} {version}" for name, version in run.facts.versions.items())
    lines = [
        ("Result", f"{run.facts.result_id}, SHA-256 of the stored result:"),
        ("", result_hash(run.document)),
        ("Certificate", f"signed by key {run.signed_by}" if run.signed_by else "not issued yet"),
        ("Versions", versions),
    ]
    for name, text in lines:
        paper.text(MARGIN, y, name, Style(8, colour=MUTED))
        y = paper.paragraph(MARGIN + 62, y, INNER - 62, text, Style(8)) + 1.5
    paper.text(MARGIN, y, "Images", Style(8, colour=MUTED))
    _hashes(paper, run, y)


def _hashes(paper: Paper, run: FinishedRun, y: float) -> None:
    """List the images' SHA-256 in two columns, as far as there is room; the certificate has all of them."""
    x, column = MARGIN + 62, (INNER - 62) / 2
    room = max(int((BOTTOM - 10 - y) / 8.5), 1)
    shown = run.images[: 2 * room]
    rows = (len(shown) + 1) // 2
    for place, image in enumerate(shown):
        at = x + column * (place // rows)
        row = y + 8.5 * (place % rows)
        paper.text(at, row, f"{image.number:>3}", HASH)
        paper.text(at + 13, row, image.sha256, HASH)
    left = len(run.images) - len(shown)
    if left:
        paper.text(x, y + 8.5 * rows + 2, f"And {left} more, in the certificate.", SMALL)
