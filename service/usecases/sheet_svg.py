"""A sheet as SVG at true scale: one unit of the drawing is one millimetre. Not here: what is on the sheet."""

from html import escape

from service.core.vision.sheet import Sheet, Text
from service.core.vision.transforms import Array

LINE_WIDTH_MM = 0.12
FONT = "Helvetica, Arial, 'Liberation Sans', sans-serif"


def sheet_svg(sheet: Sheet) -> bytes:
    """Return the drawing, UTF-8."""
    width, height = _number(sheet.paper.width_mm), _number(sheet.paper.height_mm)
    size = f'width="{width}mm" height="{height}mm" viewBox="0 0 {width} {height}"'
    parts = [
        '<?xml version="1.0" encoding="UTF-8"?>',
        f'<svg xmlns="http://www.w3.org/2000/svg" {size}>',
        f"<title>{escape(sheet.title)}</title>",
        f'<rect width="{width}" height="{height}" fill="#fff"/>',
        # One path: shapes that touch would show a seam if each were drawn for itself.
        f'<path id="pattern" d="{_outlines(sheet)}" fill="#000" fill-rule="evenodd"/>',
        f'<path id="rulers" d="{_strokes(sheet.lines)}" stroke="#000" stroke-width="{LINE_WIDTH_MM}"/>',
        f'<g id="words" font-family="{FONT}" fill="#000">',
        *(_text(text) for text in sheet.texts),
        "</g>",
        "</svg>",
    ]
    return "\n".join(parts).encode()


def _outlines(sheet: Sheet) -> str:
    loops = ("M" + "L".join(f"{_number(x)} {_number(y)}" for x, y in loop) + "Z" for loop in sheet.loops)
    return "".join((*loops, *(_disc(*disc) for disc in sheet.discs)))


def _disc(x: float, y: float, radius: float) -> str:
    arc, across = f"a{_number(radius)} {_number(radius)} 0 1 1", _number(2 * radius)
    return f"M{_number(x - radius)} {_number(y)}{arc} {across} 0{arc} -{across} 0Z"


def _strokes(lines: Array) -> str:
    return "".join(f"M{_number(a)} {_number(b)}L{_number(c)} {_number(d)}" for a, b, c, d in lines)


def _text(text: Text) -> str:
    return (
        f'<text x="{_number(text.x_mm)}" y="{_number(text.y_mm)}" font-size="{_number(text.height_mm)}" '
        f'text-anchor="{text.anchor}">{escape(text.words)}</text>'
    )


def _number(value: float) -> str:
    """Return a length in mm to a tenth of a micrometre, without what says nothing."""
    return f"{value:.4f}".rstrip("0").rstrip(".")
