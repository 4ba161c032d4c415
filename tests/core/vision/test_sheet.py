"""A target on paper: all of it inside the page, at true scale, on the smallest paper that holds it."""

import cv2
import numpy as np
import pytest

from service.core.vision.sheet import PAPERS, Paper, PaperUnusable, Sheet, lay_out_sheet
from service.core.vision.target import parse_target

KINDS = (
    "chessboard:9x6:25mm",
    "charuco:11x8:20mm:15mm:4x4_100",
    "aprilgrid:5x4:24mm:0.3",
    "circles:4x11:20mm:10mm",
)
A4 = PAPERS[0]


def extent(sheet: Sheet) -> tuple[np.ndarray, np.ndarray]:
    """Least and most x and y of all that is dark, mm."""
    discs = [sheet.discs[:, :2] - sheet.discs[:, 2:], sheet.discs[:, :2] + sheet.discs[:, 2:]]
    points = np.concatenate([*sheet.loops, *discs])
    return points.min(axis=0), points.max(axis=0)


@pytest.mark.parametrize("spec", KINDS)
def test_a_pattern_is_on_the_page_as_large_as_its_target(spec: str) -> None:
    target = parse_target(spec)
    sheet = lay_out_sheet(target)
    least, most = extent(sheet)

    assert most - least == pytest.approx(1000 * np.ptp(target.outline[:, :2], axis=0))
    assert least.min() > 8.99
    assert most[0] < sheet.paper.width_mm - 8.99
    assert most[1] < sheet.lines[:, 1::2].max()


def test_the_common_board_fits_on_the_smallest_paper_turned() -> None:
    paper = lay_out_sheet(parse_target("chessboard:9x6:25mm")).paper

    assert (paper.name, paper.width_mm, paper.height_mm) == ("A4", 297, 210)


@pytest.mark.parametrize(("spec", "name"), [("chessboard:9x6:30mm", "A3"), ("chessboard:9x6:100mm", "A0")])
def test_a_larger_board_takes_the_next_paper(spec: str, name: str) -> None:
    assert lay_out_sheet(parse_target(spec)).paper.name == name


def test_a_board_that_fits_on_no_paper_is_told_what_it_needs_and_takes_that() -> None:
    target = parse_target("chessboard:9x6:200mm")
    with pytest.raises(PaperUnusable, match="needs a sheet of 2078x1487mm") as told:
        lay_out_sheet(target)
    assert told.value.facts["needed_mm"] == [2078.0, 1487.0]

    assert lay_out_sheet(target, Paper("own", 2078, 1487)).paper.width_mm == 2078
    with pytest.raises(PaperUnusable, match="more than A4"):
        lay_out_sheet(target, A4)


def test_rulers_are_as_long_as_their_words_say() -> None:
    sheet = lay_out_sheet(parse_target("chessboard:9x6:25mm"))
    across, down = sheet.lines[0], sheet.lines[1]
    words = " ".join(text.words for text in sheet.texts)

    assert f"{across[2] - across[0]:.0f} mm across, {down[1] - down[3]:.0f} mm down" in words
    assert (across[2] - across[0], down[1] - down[3]) == (270, 180)
    assert "250 x 175 mm over all" in words
    ticks = sheet.lines[2:]
    level = ticks[ticks[:, 0] == ticks[:, 2]]
    assert np.diff(level[:, 0]) == pytest.approx(5)


def test_nothing_is_written_on_the_pattern_or_beyond_the_page() -> None:
    for spec in KINDS:
        sheet = lay_out_sheet(parse_target(spec))
        least, most = extent(sheet)
        for text in sheet.texts:
            width = cv2.getTextSize(text.words, cv2.FONT_HERSHEY_SIMPLEX, 1, 1)[0][0] * text.height_mm / 30
            left = text.x_mm - {"start": 0, "middle": width / 2, "end": width}[text.anchor]
            assert 0 < left < left + width < sheet.paper.width_mm
            assert 0 < text.y_mm < sheet.paper.height_mm - 4.9
            assert text.y_mm - text.height_mm > most[1] or left + width < least[0]
