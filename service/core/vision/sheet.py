"""A target on paper: where its pattern, two rulers and the words that belong to it lie on a sheet, in mm.

Page coordinates: origin at the top left, x to the right, y down, so that the pattern lies as the board's
frame has it. Not here: what a pattern looks like (`target`) and the formats a sheet is written in.
"""

from dataclasses import dataclass

import numpy as np

from service.core.errors import Unprocessable
from service.core.vision.pattern import Pattern, pattern_of
from service.core.vision.target import Target
from service.core.vision.transforms import Array

MM = 1000.0  # per metre
EDGE_MM = 5.0  # what printers leave white
RULER_MM = 8.0  # height of a ruler with its numbers
LINE_MM = 3.0  # from one line of words to the next
TEXT_MM, NUMBER_MM = 2.5, 2.2  # heights of letters
TICK_MM, LONG_TICK_MM = 1.5, 3.0
TICK_EVERY_MM, LONG_TICK_EVERY_MM, NUMBER_EVERY_MM = 5, 10, 50
WORDS_MM = 130.0  # width that the longest line of words takes
EXACT_MM = 1e-6
LARGEST_SIDE_MM = 5000.0  # the largest page of a PDF


class PaperUnusable(Unprocessable):
    """A target does not fit on the paper, or the paper is none."""

    code = "paper-unusable"
    title = "The target cannot be printed on this paper"


@dataclass(frozen=True)
class Paper:
    """A size of paper, mm."""

    name: str
    width_mm: float
    height_mm: float

    @property
    def turned(self) -> "Paper":
        """The same paper on its side."""
        return Paper(self.name, self.height_mm, self.width_mm)


PAPERS = (
    Paper("A4", 210, 297),
    Paper("A3", 297, 420),
    Paper("A2", 420, 594),
    Paper("A1", 594, 841),
    Paper("A0", 841, 1189),
)


@dataclass(frozen=True)
class Text:
    """Words whose baseline begins, or has its middle or its end, at a point, mm."""

    x_mm: float
    y_mm: float
    words: str
    height_mm: float
    anchor: str = "start"


@dataclass(frozen=True)
class Sheet:
    """A page with everything on it, mm.

    loops (k, 2) bound the dark areas, by the even-odd rule; discs (n, 3) are dark, by centre and radius;
    lines (m, 4) are those of the rulers, from point to point.
    """

    paper: Paper
    title: str
    loops: tuple[Array, ...]
    discs: Array
    lines: Array
    texts: tuple[Text, ...]


def lay_out_sheet(target: Target, paper: Paper | None = None) -> Sheet:
    """Return a target's sheet on a paper, turned as the target is; None: the smallest of A4 to A0 that fits.

    Raises PaperUnusable when the target, with its rulers and words, is larger than the paper.
    """
    pattern = pattern_of(target)
    width_mm, height_mm = MM * (pattern.size + 2 * pattern.quiet_m)
    needed = (
        max(width_mm + RULER_MM, WORDS_MM) + 2 * EDGE_MM,
        height_mm + RULER_MM + 3 * LINE_MM + 2 * EDGE_MM,
    )
    return _draw(target.spec, pattern, _choose_paper(needed, paper))


def _choose_paper(needed: tuple[float, float], wanted: Paper | None) -> Paper:
    for paper in PAPERS if wanted is None else (wanted,):
        is_turned = (needed[0] > needed[1]) != (paper.width_mm > paper.height_mm)
        for way in (paper.turned, paper) if is_turned else (paper, paper.turned):
            if needed[0] <= way.width_mm + EXACT_MM and needed[1] <= way.height_mm + EXACT_MM:
                return way
    name = "A0" if wanted is None else wanted.name
    sides = [float(np.ceil(side - EXACT_MM)) for side in needed]
    least = f"{sides[0]:.0f}x{sides[1]:.0f}mm"
    raise PaperUnusable(
        f"The target needs a sheet of {least} with its rulers and words, which is more than {name}. "
        f"Choose a larger paper (paper={least} for a print shop), or a target with smaller squares.",
        needed_mm=sides,
        paper=name,
    )


def _draw(spec: str, pattern: Pattern, paper: Paper) -> Sheet:
    """Put rulers and words on a large enough paper, and the pattern in the middle of what is left."""
    left, foot = EDGE_MM + RULER_MM, paper.height_mm - EDGE_MM - RULER_MM - 3 * LINE_MM
    room = np.array([paper.width_mm - EDGE_MM - left, foot - EDGE_MM])
    size = MM * pattern.size
    moved = np.array([left, EDGE_MM]) + (room - size) / 2 - MM * pattern.corner
    rulers = _longest_ruler(room[0]), _longest_ruler(room[1])
    lines, numbers = _rulers(*rulers, left, foot)
    return Sheet(
        paper=paper,
        title=spec,
        loops=tuple(MM * loop + moved for loop in pattern.loops),
        discs=MM * pattern.discs + np.array([*moved, 0.0]),
        lines=lines,
        texts=(*numbers, *_words(spec, size, rulers, left, foot + RULER_MM)),
    )


def _longest_ruler(room_mm: float) -> int:
    """Return the longest whole number of 10 mm, with space for the number at its end."""
    return int((room_mm - NUMBER_MM) // 10) * 10


def _rulers(across: int, down: int, left: float, foot: float) -> tuple[Array, tuple[Text, ...]]:
    """Return lines and numbers of a ruler below the pattern and one at its left, from the same corner."""
    lines = [(left, foot, left + across, foot), (left, foot, left, foot - down)]
    texts = []
    for at in range(0, across + 1, TICK_EVERY_MM):
        lines.append((left + at, foot, left + at, foot + _tick(at)))
        if _has_number(at, across):
            texts.append(_number(left + at, foot + LONG_TICK_MM + NUMBER_MM, at, "middle"))
    for at in range(0, down + 1, TICK_EVERY_MM):
        lines.append((left, foot - at, left - _tick(at), foot - at))
        if at > 0 and _has_number(at, down):
            texts.append(_number(left - LONG_TICK_MM - 0.3, foot - at + NUMBER_MM / 3, at, "end"))
    return np.array(lines), tuple(texts)


def _tick(at_mm: int) -> float:
    return TICK_MM if at_mm % LONG_TICK_EVERY_MM else LONG_TICK_MM


def _has_number(at_mm: int, length_mm: int) -> bool:
    return at_mm == length_mm or (at_mm % NUMBER_EVERY_MM == 0 and length_mm - at_mm > NUMBER_EVERY_MM / 4)


def _number(x_mm: float, y_mm: float, number: int, anchor: str) -> Text:
    return Text(x_mm, y_mm, f"{number}", NUMBER_MM, anchor)


def _words(
    spec: str, size: Array, rulers: tuple[int, int], left: float, top: float
) -> tuple[Text, Text, Text]:
    width, height = (f"{side:.2f}".rstrip("0").rstrip(".") for side in size)
    words = (
        f"dmscal target  {spec}  -  dark pattern {width} x {height} mm over all",
        "Print at 100 % (actual size), no fit to page. Mount it flat on a stiff plate.",
        f"Measure both rulers: {rulers[0]} mm across, {rulers[1]} mm down. Declare what you measure.",
    )
    first, second, third = (
        Text(left, top + LINE_MM * (row + 1) - 0.5, line, TEXT_MM) for row, line in enumerate(words)
    )
    return first, second, third
