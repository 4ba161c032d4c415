"""A sheet as PDF at true scale, by reportlab; viewers are asked not to scale it. Not here: what it holds."""

from io import BytesIO

from reportlab.lib.units import mm
from reportlab.pdfgen.canvas import Canvas

from service.core.vision.sheet import Sheet, Text
from service.core.vision.transforms import Array

LINE_WIDTH_MM = 0.12
FONT = "Helvetica"
EVEN_ODD = 0


def sheet_pdf(sheet: Sheet) -> bytes:
    """Return the document: one page as large as the paper; the same sheet gives the same bytes."""
    out = BytesIO()
    size = (sheet.paper.width_mm * mm, sheet.paper.height_mm * mm)
    canvas = Canvas(out, pagesize=size, invariant=True)
    canvas.setTitle(sheet.title)
    canvas.setCreator("dmscal")
    canvas.setViewerPreference("PrintScaling", "None")
    # From now on a unit is a millimetre; y grows upwards in a PDF.
    canvas.scale(mm, mm)
    _fill_pattern(canvas, sheet)
    canvas.setLineWidth(LINE_WIDTH_MM)
    canvas.lines(_upwards(sheet.lines, sheet).tolist())
    for text in sheet.texts:
        _write(canvas, text, sheet.paper.height_mm)
    canvas.showPage()
    canvas.save()
    return out.getvalue()


def _fill_pattern(canvas: Canvas, sheet: Sheet) -> None:
    """Fill all shapes as one path: those that touch would show a seam if each were filled for itself."""
    path = canvas.beginPath()
    for loop in sheet.loops:
        (x, y), *rest = _upwards(loop, sheet).tolist()
        path.moveTo(x, y)
        for x, y in rest:
            path.lineTo(x, y)
        path.close()
    for x, y, radius in sheet.discs.tolist():
        path.circle(x, sheet.paper.height_mm - y, radius)
    canvas.drawPath(path, stroke=0, fill=1, fillMode=EVEN_ODD)


def _upwards(points: Array, sheet: Sheet) -> Array:
    turned = points.copy()
    turned[:, 1::2] = sheet.paper.height_mm - turned[:, 1::2]
    return turned


def _write(canvas: Canvas, text: Text, height_mm: float) -> None:
    canvas.setFont(FONT, text.height_mm)
    x, y = text.x_mm, height_mm - text.y_mm
    draw = {
        "start": canvas.drawString,
        "middle": canvas.drawCentredString,
        "end": canvas.drawRightString,
    }
    draw[text.anchor](x, y, text.words)
