"""The paper of the report: page, margins, colours, fonts and the text and lines that all pages are made of.

Places are in points from the left and from the top. Not here: what stands on a page.
"""

from dataclasses import dataclass
from typing import Final, Literal

from reportlab.lib.colors import Color, HexColor
from reportlab.lib.pagesizes import A4
from reportlab.lib.utils import simpleSplit
from reportlab.pdfbase import pdfmetrics
from reportlab.pdfbase.cidfonts import UnicodeCIDFont
from reportlab.pdfgen.canvas import Canvas

from service.core.quality.gates import Verdict

WIDTH, HEIGHT = A4
MARGIN: Final = 46.0
INNER: Final = WIDTH - 2 * MARGIN
BOTTOM: Final = HEIGHT - 52.0

# As in the pages of the service: Okabe and Ito's colours, in shades that are read on white.
INK, MUTED, LINE, GROUND = HexColor("#14181b"), HexColor("#58626a"), HexColor("#d3d8db"), HexColor("#f5f6f6")
POINT, CHOSEN = HexColor("#0072b2"), HexColor("#b84300")
VERDICTS: Final = {
    Verdict.PASS: (HexColor("#007558"), HexColor("#e5f3ee")),
    Verdict.MARGINAL: (HexColor("#8a5a00"), HexColor("#fdf3dc")),
    Verdict.FAIL: (HexColor("#b03f00"), HexColor("#fcebe2")),
}
CIVIDIS: Final = tuple(
    HexColor(f"#{code}")
    for code in (
        "00224e", "123570", "3b496c", "575d6d", "707173", "8a8678", "a59c74", "c3b369", "e1cc55", "fee838",
    )
)  # fmt: skip

SANS, BOLD, MONO = "Helvetica", "Helvetica-Bold", "Courier"
# Of Adobe's fonts for Chinese, which viewers bring along; for what the western ones cannot show.
WIDE = "STSong-Light"

Anchor = Literal["left", "middle", "right"]


@dataclass(frozen=True)
class Style:
    """How text is written."""

    size: float = 9.0
    font: str = SANS
    colour: Color = INK
    anchor: Anchor = "left"


SMALL = Style(7.5, colour=MUTED)
PLAIN = Style()
STRONG = Style(font=BOLD)


class Paper:
    """A canvas whose y goes down from the top of the page."""

    def __init__(self, canvas: Canvas) -> None:
        self.canvas = canvas

    def text(self, x: float, y: float, text: str, style: Style = PLAIN) -> None:
        """Write one line of text with its baseline at y."""
        font = font_for(text, style.font)
        self.canvas.setFont(font, style.size)
        self.canvas.setFillColor(style.colour)
        draw = {
            "left": self.canvas.drawString,
            "middle": self.canvas.drawCentredString,
            "right": self.canvas.drawRightString,
        }[style.anchor]
        draw(x, HEIGHT - y, text)

    def paragraph(self, x: float, y: float, width: float, text: str, style: Style = PLAIN) -> float:
        """Write text in lines of at most `width` from the baseline y on; return the baseline that follows."""
        for line in lines_of(text, width, style):
            self.text(x, y, line, style)
            y += 1.35 * style.size
        return y

    def box(
        self,
        x: float,
        y: float,
        width: float,
        height: float,
        fill: Color | None,
        *,
        line: Color | None = None,
    ) -> None:
        """Draw a rectangle with its top left corner at x, y."""
        if fill is not None:
            self.canvas.setFillColor(fill)
        if line is not None:
            self.canvas.setStrokeColor(line)
            self.canvas.setLineWidth(0.6)
        self.canvas.rect(
            x, HEIGHT - y - height, width, height, stroke=line is not None, fill=fill is not None
        )

    def line(
        self, x0: float, y0: float, x1: float, y1: float, colour: Color = LINE, *, width: float = 0.6
    ) -> None:
        """Draw a straight line."""
        self.canvas.setStrokeColor(colour)
        self.canvas.setLineWidth(width)
        self.canvas.line(x0, HEIGHT - y0, x1, HEIGHT - y1)

    def circle(self, x: float, y: float, radius: float, colour: Color, *, fill: bool) -> None:
        """Draw a circle, filled or as a thin line."""
        self.canvas.setFillColor(colour)
        self.canvas.setStrokeColor(colour)
        self.canvas.setLineWidth(0.5)
        self.canvas.circle(x, HEIGHT - y, radius, stroke=not fill, fill=fill)

    def dashes(self, *lengths: float) -> None:
        """Draw lines dashed from now on; without lengths, whole."""
        self.canvas.setDash(*([list(lengths)] if lengths else []))

    def heading(self, y: float, text: str, x: float = MARGIN, width: float = INNER) -> float:
        """Write a heading with a line below; return the baseline of what follows."""
        self.text(x, y, text, Style(11, BOLD))
        self.line(x, y + 5, x + width, y + 5)
        return y + 19


def lines_of(text: str, width: float, style: Style) -> list[str]:
    """Return a text as lines of at most `width`."""
    found: list[str] = simpleSplit(text, font_for(text, style.font), style.size, width)
    return found


def cut(text: str, width: float, style: Style) -> str:
    """Return a text, cut with an ellipsis where it is longer than `width`."""
    font = font_for(text, style.font)
    if pdfmetrics.stringWidth(text, font, style.size) <= width:
        return text
    while text and pdfmetrics.stringWidth(f"{text}...", font, style.size) > width:
        text = text[:-1]
    return f"{text}..."


def font_for(text: str, font: str) -> str:
    """Return a font that has all of the text's letters."""
    try:
        text.encode("cp1252")
    except UnicodeEncodeError:
        pdfmetrics.registerFont(UnicodeCIDFont(WIDE))
        return WIDE
    return font


def heat_colour(share: float) -> Color:
    """Return the colour at a share 0 to 1 of the scale, from little to much."""
    at = min(max(share, 0.0), 1.0) * (len(CIVIDIS) - 1)
    low, high = CIVIDIS[int(at)], CIVIDIS[min(int(at) + 1, len(CIVIDIS) - 1)]
    part = at - int(at)
    mixed = [a + (b - a) * part for a, b in zip(low.rgb(), high.rgb(), strict=True)]
    return Color(*mixed)
