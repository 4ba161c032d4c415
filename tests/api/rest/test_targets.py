"""A target's pattern and its sheet over HTTP, for whoever may read."""

import numpy as np
import pytest

from service.core.vision.target import parse_target
from service.storage.words import Role
from tests.plant import Plant, problem

SPEC = "chessboard:9x6:25.0mm"


def test_a_pattern_can_be_drawn_from_what_is_answered(plant: Plant) -> None:
    pattern = plant.expect(200, plant.get("/targets/pattern", params={"spec": SPEC}))

    assert (pattern["spec"], pattern["square_m"], pattern["step_m"]) == ("chessboard:9x6:25mm", 0.025, 0.025)
    assert pattern["size_m"] == pytest.approx([0.25, 0.175])
    assert pattern["corner_m"] == pytest.approx([-0.025, -0.025])
    assert len(pattern["loops"]) == 35
    assert pattern["discs"] == []


@pytest.mark.parametrize(
    ("spec", "step_m"),
    [
        ("charuco:11x8:20mm:15mm:4x4_100", 0.02),
        ("aprilgrid:5x4:24mm:0.3", 0.0024),
        ("aprilgrid:5x4:24mm:0.2873", None),
        ("circles:4x11:20mm:10mm", 0.02),
    ],
)
def test_features_lie_at_whole_steps_where_there_are_steps(
    plant: Plant, spec: str, step_m: float | None
) -> None:
    pattern = plant.expect(200, plant.get("/targets/pattern", params={"spec": spec}))

    assert pattern["step_m"] == (None if step_m is None else pytest.approx(step_m))
    outline = parse_target(spec).outline[:, :2]
    dark = np.concatenate(
        [*(np.array(loop) for loop in pattern["loops"]), *(np.array([disc[:2]]) for disc in pattern["discs"])]
    )
    assert (dark >= outline.min(axis=0) - 1e-9).all()
    assert (dark <= outline.max(axis=0) + 1e-9).all()


def test_a_sheet_is_a_file_with_a_name(plant: Plant) -> None:
    answer = plant.get("/targets/sheet", params={"spec": SPEC})
    assert (answer.status_code, answer.headers["content-type"]) == (200, "application/pdf")
    assert answer.headers["content-disposition"] == 'attachment; filename="chessboard-9x6-25mm-A4.pdf"'
    assert answer.content.startswith(b"%PDF-")

    answer = plant.get("/targets/sheet", params={"spec": SPEC, "format": "svg", "paper": "A3"})
    assert (answer.status_code, answer.headers["content-type"]) == (200, "image/svg+xml")
    assert b'width="420mm" height="297mm"' in answer.content


def test_what_cannot_be_printed_is_a_problem_that_says_what_to_do(plant: Plant) -> None:
    told = problem(
        plant.get("/targets/sheet", params={"spec": "chessboard:9x6:200mm"}), 422, "paper-unusable"
    )
    assert told["facts"]["needed_mm"] == [2078, 1487]
    assert "paper=2078x1487mm" in told["detail"]
    for path in ("sheet", "pattern"):
        problem(plant.get(f"/targets/{path}", params={"spec": "paper"}), 422, "target-spec-invalid")
        problem(plant.get(f"/targets/{path}"), 422, "validation-failed")
        assert plant.get(f"/targets/{path}", params={"spec": SPEC}, role=Role.OPERATOR).status_code == 200
    problem(plant.get("/targets/sheet", params={"spec": SPEC, "format": "dwg"}), 422, "validation-failed")
    problem(plant.get("/targets/sheet", params={"spec": SPEC, "paper": "B5"}), 422, "paper-unusable")
