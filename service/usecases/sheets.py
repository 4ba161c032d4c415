"""Sheets: a target's pattern as data, and as a file to print. Not here: layout, and how a format is made."""

import re
from dataclasses import dataclass
from typing import Literal

from service.core.vision.pattern import Pattern, pattern_of
from service.core.vision.sheet import LARGEST_SIDE_MM, PAPERS, Paper, PaperUnusable, lay_out_sheet
from service.core.vision.target import parse_target
from service.usecases.sheet_pdf import sheet_pdf
from service.usecases.sheet_svg import sheet_svg

SheetFormat = Literal["svg", "pdf"]
SMALLEST_THAT_FITS = "auto"
OWN_SIZE = re.compile(r"(\d{2,4})x(\d{2,4})mm")


@dataclass(frozen=True)
class SheetFile:
    """A file to print: its name, what it is, and its content; `paper` says on what."""

    name: str
    media_type: str
    content: bytes
    paper: Paper


@dataclass(frozen=True)
class PatternView:
    """A target's pattern with the words and the measure that it is scaled by."""

    spec: str
    name: str
    square_m: float
    pattern: Pattern


def read_pattern(spec: str) -> PatternView:
    """Return the pattern of a target; raises TargetSpecInvalid."""
    target = parse_target(spec)
    return PatternView(target.spec, target.name, target.square_m, pattern_of(target))


def make_sheet(spec: str, file_format: SheetFormat, paper: str = SMALLEST_THAT_FITS) -> SheetFile:
    """Return a target's sheet; paper: auto, a name such as A3, or WIDTHxHEIGHTmm.

    Raises TargetSpecInvalid, and PaperUnusable for a paper that is none, or on which the target does not fit.
    """
    target = parse_target(spec)
    sheet = lay_out_sheet(target, _paper_of(paper))
    media_type, write = {"svg": ("image/svg+xml", sheet_svg), "pdf": ("application/pdf", sheet_pdf)}[
        file_format
    ]
    name = re.sub(r"[^\w.-]+", "-", f"{target.spec}-{sheet.paper.name}.{file_format}")
    return SheetFile(name, media_type, write(sheet), sheet.paper)


def _paper_of(words: str) -> Paper | None:
    wanted = words.strip()
    if wanted.lower() == SMALLEST_THAT_FITS:
        return None
    named = next((paper for paper in PAPERS if paper.name == wanted.upper()), None)
    if named is not None:
        return named
    own = OWN_SIZE.fullmatch(wanted.lower())
    if own is None or max(int(side) for side in own.groups()) > LARGEST_SIDE_MM:
        raise PaperUnusable(
            f"'{words}' is no paper; write auto, {', '.join(paper.name for paper in PAPERS)}, or a size such "
            f"as 700x500mm with sides of 10 to {LARGEST_SIDE_MM:.0f} mm.",
            paper=words,
        )
    return Paper(own[0], float(own[1]), float(own[2]))
