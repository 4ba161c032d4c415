import numpy as np
import pytest

from bench.detection import LENS1, SPACE, TARGET, cut_off, judge, table
from service.core.planning.pose_space import sample_poses
from service.simulator.scene import production_scene, true_corners


def test_a_cut_off_board_has_a_corner_outside_the_picture() -> None:
    scene = production_scene(LENS1, TARGET)
    poses = sample_poses(SPACE, LENS1, TARGET, 5, 1)
    for i in range(5):
        corners = true_corners(scene, cut_off(poses.pose(i)))
        assert np.nanmin(corners[:, 0]) < 0 or np.nanmax(corners[:, 0]) > LENS1.image_size[0] - 1


def test_a_finder_is_judged_by_what_it_finds_misses_and_reads_wrongly() -> None:
    truth = np.array([[1.0, 2.0], [30.0, 40.0]])
    answers = iter([truth + 0.1, truth[::-1], None, truth])
    row = judge(lambda _: next(answers), [np.zeros((2, 2), np.uint8)] * 4, [truth] * 4)
    assert (row["found"], row["wrong"]) == (0.5, 0.25)
    assert row["max_px"] == pytest.approx(0.1 * np.sqrt(2))


def test_the_table_names_every_finder() -> None:
    row = {"found": 1.0, "wrong": 0.0, "mean_px": 0.01, "max_px": 0.1, "p50_ms": 40.0, "p95_ms": 60.0}
    refusals = {"refused": 1.0, "p50_ms": 50.0, "max_ms": 70.0}
    text = table(
        {
            "ours": row,
            "opencv": row,
            "opencv_sb": row,
            "cut_off": refusals,
            "empty": refusals,
            "wrong_target_share": 1.0,
        }
    )
    for name in ("ours", "opencv_sb", "cut_off", "empty", "declared too small"):
        assert name in text
