"""The report on paper (PDF, A4, three pages): verdict and parameters, gates, residuals and traces.

For people. It is not signed: what proves a result is its certificate, whose key the report names. The same
result gives the same bytes.
"""

from collections.abc import Callable
from io import BytesIO

from reportlab.lib.pagesizes import A4
from reportlab.pdfgen.canvas import Canvas

from service.core.quality.gates import Verdict
from service.usecases.exports.format import Format, headline
from service.usecases.exports.report.gates import draw_gates
from service.usecases.exports.report.paper import (
    BOLD,
    HEIGHT,
    INK,
    INNER,
    MARGIN,
    MUTED,
    SMALL,
    VERDICTS,
    Paper,
    Style,
    cut,
)
from service.usecases.exports.report.provenance import draw_provenance
from service.usecases.exports.report.summary import draw_summary
from service.usecases.finished_run import FinishedRun

PAGES: tuple[Callable[[Paper, FinishedRun], None], ...] = (draw_summary, draw_gates, draw_provenance)


def write(run: FinishedRun) -> bytes:
    """Return the document."""
    out = BytesIO()
    canvas = Canvas(out, pagesize=A4, invariant=True)
    canvas.setTitle(f"Calibration {run.facts.serial}: {run.facts.verdict.value}")
    canvas.setSubject(headline(run.facts))
    canvas.setCreator("dmscal")
    paper = Paper(canvas)
    for number, draw in enumerate(PAGES, 1):
        _head(paper, run)
        draw(paper, run)
        _foot(paper, run, number)
        canvas.showPage()
    canvas.save()
    return out.getvalue()


def _head(paper: Paper, run: FinishedRun) -> None:
    """Write what stands on every page, so that none can be taken for another camera's or verdict's."""
    verdict = run.facts.verdict
    paper.text(MARGIN, 50, "Calibration report", Style(16, BOLD))
    right = MARGIN + INNER
    serial = Style(12, BOLD, INK, "right")
    paper.text(right, 46, cut(run.facts.serial, 260, serial), serial)
    said = "FAIL - do not use" if verdict is Verdict.FAIL else verdict.value
    paper.text(right, 60, said, Style(9, BOLD, VERDICTS[verdict][0], "right"))
    paper.line(MARGIN, 68, right, 68, MUTED, width=0.8)


def _foot(paper: Paper, run: FinishedRun, number: int) -> None:
    paper.line(MARGIN, HEIGHT - 42, MARGIN + INNER, HEIGHT - 42)
    paper.text(MARGIN, HEIGHT - 30, f"dmscal  -  run {run.facts.run_id}", SMALL)
    page = f"Page {number} of {len(PAGES)}"
    paper.text(MARGIN + INNER, HEIGHT - 30, page, Style(7.5, colour=MUTED, anchor="right"))


FORMAT = Format("pdf", "PDF report", "application/pdf", "pdf", write)
