import numpy as np
import pytest

from service.core.errors import PoseSetInfeasible
from service.core.planning.information import pose_information
from service.core.planning.pose_space import Poses
from service.core.planning.scoring import (
    condition_number,
    expected_covariance,
    expected_norm,
    paper_score,
)
from service.core.vision.transforms import Array, rotation_matrix
from tests.core.planning.cameras import BOARD, LENS1


def boards(tilts_deg: list[tuple[float, float]], distances: list[float]) -> Array:
    """Return the summed information of boards in the middle of the image."""
    rotations = rotation_matrix(np.deg2rad([(pitch, yaw, 0.0) for pitch, yaw in tilts_deg]))
    centres = np.array([(0.0, 0.0, z) for z in distances])
    poses = Poses(rotations, centres - rotations @ BOARD.centre)
    total: Array = pose_information(LENS1, BOARD, poses).sum(axis=0)
    return total


def test_units_do_not_change_the_condition() -> None:
    information = boards([(30, 0), (0, 30), (-30, 10), (10, -30)], [0.3, 0.4, 0.5, 0.6])
    units = np.geomspace(1e-3, 1e3, 9)
    assert condition_number(information * np.outer(units, units)) == pytest.approx(
        condition_number(information), rel=1e-6
    )


def test_parallel_boards_are_refused_because_focal_length_and_distance_are_tied() -> None:
    with pytest.raises(PoseSetInfeasible, match="parallel"):
        expected_norm(boards([(0, 0)] * 5, [0.3, 0.4, 0.5, 0.6, 0.7]))


def test_tilted_boards_are_accepted() -> None:
    assert expected_norm(boards([(30, 0), (0, 30), (-30, 10), (10, -30)], [0.3] * 4)) < 10.0


def test_no_information_is_refused() -> None:
    assert condition_number(np.zeros((9, 9))) == np.inf
    with pytest.raises(PoseSetInfeasible):
        expected_covariance(np.zeros((9, 9)))


def test_covariance_is_the_inverse_of_the_information() -> None:
    information = boards([(30, 0), (0, 30), (-30, 10), (10, -30)], [0.3, 0.4, 0.5, 0.6])
    covariance = expected_covariance(information)
    np.testing.assert_allclose(covariance @ information, np.eye(9), atol=1e-6)
    assert expected_norm(information) == pytest.approx(np.sqrt(np.trace(covariance)))


@pytest.mark.parametrize(
    ("mre", "norm", "score"),
    [(0.0970, 0.6336, 1.3689), (0.1679, 0.7562, 1.0820), (0.1440, 4.729, 0.2052), (0.1186, 0.088, 4.8216)],
)
def test_the_papers_score_reproduces_its_first_table(mre: float, norm: float, score: float) -> None:
    assert paper_score(mre, norm) == pytest.approx(score, rel=5e-3)
