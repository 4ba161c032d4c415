"""Sheets as files, read back: true millimetres, the whole pattern, and a board that our detector finds."""

import re
import zlib
from base64 import a85decode
from xml.etree import ElementTree as ET

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray
from reportlab.pdfbase.pdfmetrics import stringWidth

from service.core.errors import TargetSpecInvalid
from service.core.vision.detection import detect_target
from service.core.vision.sheet import WORDS_MM, PaperUnusable, lay_out_sheet
from service.core.vision.target import parse_target
from service.usecases.sheets import make_sheet

KINDS = (
    "chessboard:9x6:25mm",
    "charuco:11x8:20mm:15mm:4x4_100",
    "aprilgrid:5x4:24mm:0.3",
    "circles:4x11:20mm:10mm",
)
SVG = "{http://www.w3.org/2000/svg}"
POINTS_PER_MM = 72 / 25.4
PX_PER_MM = 5
NUMBER = r"-?\d*\.?\d+"
Image = NDArray[np.uint8]
WHITE = 230  # a camera that shows paper as 255 is overexposed


def draw(loops: list[NDArray[np.float64]], width_mm: float, height_mm: float) -> Image:
    """Fill loops (k, 2), mm, by the even-odd rule, as a picture whose pixel edges lie at whole steps."""
    page = np.full((round(height_mm * PX_PER_MM), round(width_mm * PX_PER_MM)), WHITE, dtype=np.uint8)
    fine = [np.round((loop * PX_PER_MM - 0.5) * 256).astype(np.int32) for loop in loops]
    cv2.fillPoly(page, fine, 0, lineType=cv2.LINE_AA, shift=8)
    return np.asarray(cv2.GaussianBlur(page, (0, 0), 0.7), dtype=np.uint8)


def svg_loops(path: str) -> list[NDArray[np.float64]]:
    """The loops of a path of M, L, Z, and of discs drawn as two arcs."""
    loops = []
    for part in path.split("M")[1:]:
        if "a" in part:
            x, y, radius, *_ = (float(number) for number in re.findall(NUMBER, part))
            loops.append(ring(x + radius, y, radius))
        else:
            numbers = [float(number) for number in re.findall(NUMBER, part)]
            loops.append(np.array(numbers).reshape(-1, 2))
    return loops


def ring(x: float, y: float, radius: float) -> NDArray[np.float64]:
    turn = np.linspace(0, 2 * np.pi, 90, endpoint=False)
    return np.stack([x + radius * np.cos(turn), y + radius * np.sin(turn)], axis=-1)


def pdf_content(content: bytes) -> str:
    """The drawing operators of the only page."""
    (stream,) = re.findall(rb"stream\r?\n(.*?)endstream", content, re.DOTALL)
    return zlib.decompress(a85decode(stream.strip().removesuffix(b"~>"))).decode("latin-1")


def pdf_loops(content: bytes, height_mm: float) -> list[NDArray[np.float64]]:
    """The loops of the filled path in mm from the top left; curves by points on them."""
    operators = pdf_content(content)
    scales = re.findall(rf"({NUMBER}) 0 0 ({NUMBER}) 0 0 cm", operators)
    assert [float(number) for number in scales[-1]] == pytest.approx([POINTS_PER_MM] * 2, rel=1e-6)
    (filled,) = re.findall(r"\bn (.*?)\sf\*", operators, re.DOTALL)
    loops: list[list[tuple[float, float]]] = []
    for numbers, operator in re.findall(rf"((?:{NUMBER} )+)([mlc])", filled):
        points = np.array([float(number) for number in numbers.split()]).reshape(-1, 2)
        if operator == "m":
            loops.append([])
        if operator == "c":
            points = bezier(np.array([loops[-1][-1], *points]))
        loops[-1].extend((float(x), float(y)) for x, y in points)
    return [np.array(loop) * [1, -1] + [0, height_mm] for loop in loops]


def bezier(control: NDArray[np.float64]) -> NDArray[np.float64]:
    """Points (16, 2) on a cubic curve, without its start."""
    t = np.linspace(0, 1, 17)[1:, None]
    a, b, c, d = control
    return np.asarray((1 - t) ** 3 * a + 3 * t * (1 - t) ** 2 * b + 3 * t**2 * (1 - t) * c + t**3 * d)


def assert_is_found(page: Image, spec: str) -> None:
    """The detector finds the target in a drawn page, each feature where true scale has it."""
    target = parse_target(spec)
    found = detect_target(page, target)
    assert len(found.corner_ids) == len(target.object_points)
    moved = found.image_points - target.object_points[found.corner_ids, :2] * 1000 * PX_PER_MM
    assert np.abs(moved - moved.mean(axis=0)).max() < 0.1


@pytest.mark.parametrize("spec", KINDS)
def test_an_svg_is_in_true_millimetres_and_holds_the_target(spec: str) -> None:
    made = make_sheet(spec, "svg")
    root = ET.fromstring(made.content)  # noqa: S314 - our own file
    width, height = (float(root.attrib[side].removesuffix("mm")) for side in ("width", "height"))

    assert root.attrib["viewBox"] == f"0 0 {width:g} {height:g}"
    assert (made.media_type, made.paper.width_mm, made.paper.height_mm) == ("image/svg+xml", width, height)
    paths = {path.attrib["id"]: path.attrib["d"] for path in root.iter(f"{SVG}path")}
    assert_is_found(draw(svg_loops(paths["pattern"]), width, height), spec)
    assert root.findtext(f"{SVG}title") == spec
    words = " ".join(text.text or "" for text in root.iter(f"{SVG}text"))
    assert spec in words
    assert "100 %" in words


@pytest.mark.parametrize("spec", KINDS)
def test_a_pdf_is_a_page_of_the_papers_size_and_holds_the_target(spec: str) -> None:
    made = make_sheet(spec, "pdf")
    box = re.search(rb"/MediaBox \[ 0 0 ([\d.]+) ([\d.]+) \]", made.content)
    assert box is not None
    size_mm = [float(side) / POINTS_PER_MM for side in box.groups()]

    assert size_mm == pytest.approx([made.paper.width_mm, made.paper.height_mm], abs=0.01)
    assert b"/PrintScaling /None" in made.content
    assert made.content.count(b"/Type /Page\n") == 1
    assert_is_found(draw(pdf_loops(made.content, size_mm[1]), *size_mm), spec)
    operators = pdf_content(made.content)
    assert f"({spec}" in operators or f"  {spec}  " in operators
    assert "100 %" in operators
    assert made.content == make_sheet(spec, "pdf").content


def test_the_longest_words_are_as_wide_as_the_sheet_allows_for() -> None:
    sheet = lay_out_sheet(parse_target("charuco:99x6:5.125mm:3.875mm:4x4_1000"))

    widest = max(stringWidth(text.words, "Helvetica", text.height_mm) for text in sheet.texts)
    assert widest < WORDS_MM


def test_a_paper_is_chosen_by_name_or_size() -> None:
    assert make_sheet("chessboard:9x6:25mm", "pdf").name == "chessboard-9x6-25mm-A4.pdf"
    assert make_sheet("chessboard:9x6:25mm", "svg", "a2").name == "chessboard-9x6-25mm-A2.svg"
    own = make_sheet("chessboard:9x6:25mm", "pdf", "700x500mm")
    assert (own.paper.width_mm, own.paper.height_mm) == (700, 500)


@pytest.mark.parametrize("paper", ["", "A5", "letter", "0x0mm", "9000x500mm", "700x500"])
def test_what_is_no_paper_is_refused(paper: str) -> None:
    with pytest.raises(PaperUnusable, match="is no paper"):
        make_sheet("chessboard:9x6:25mm", "pdf", paper)


def test_what_is_no_target_has_no_sheet() -> None:
    with pytest.raises(TargetSpecInvalid):
        make_sheet("paper", "svg")
