"""What can be guided, and what is said of the rest."""

import pytest

from service.core.guidance.guided_target import check_guided
from service.core.guidance.problems import TargetNotGuided
from service.core.vision.target import parse_target


@pytest.mark.parametrize(
    "spec", ["chessboard:9x6:25mm", "charuco:11x8:25mm:18mm:4x4_250", "aprilgrid:6x6:24mm:0.3"]
)
def test_boards_of_squares_are_guided(spec: str) -> None:
    assert check_guided(parse_target(spec)).spec == spec


def test_dots_are_not_and_the_operator_is_told_what_to_do() -> None:
    with pytest.raises(TargetNotGuided, match="Upload the captures"):
        check_guided(parse_target("circles:4x11:20mm:10mm"))
