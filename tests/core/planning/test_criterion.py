import numpy as np
import pytest

from service.core.planning.criterion import PRESETS, Weights, make_criterion
from service.core.planning.scoring import expected_covariance
from service.core.vision.uncertainty import GRID, compensated_jacobian, mapping_error, whole_image
from tests.core.planning.cameras import LENS1
from tests.core.planning.test_scoring import boards

INFORMATION = boards([(30, 0), (0, 30), (-30, 10), (10, -30)], [0.3, 0.4, 0.5, 0.6])
COVARIANCE = expected_covariance(INFORMATION)
J = compensated_jacobian(LENS1, whole_image(LENS1.image_size).grid(*GRID))


@pytest.mark.parametrize(("objective", "aims"), [("balanced", 2.0), ("parameters", 1.0), ("mapping", 2.0)])
def test_each_aim_counts_one_for_an_average_set(objective: str, aims: float) -> None:
    criterion = make_criterion(PRESETS[objective], INFORMATION, J)
    assert criterion.value(COVARIANCE[None]) == pytest.approx(aims)


def test_without_the_worst_the_metric_is_the_value() -> None:
    criterion = make_criterion(Weights(parameters=0.3, mapping_mean=2.0), INFORMATION, J)
    assert np.trace(criterion.metric @ COVARIANCE) == pytest.approx(criterion.value(COVARIANCE[None]))


def test_the_pixels_variances_are_those_of_the_mapping_error() -> None:
    variances = make_criterion(PRESETS["worst"], INFORMATION, J).variances(COVARIANCE[None])[0]
    expected = mapping_error(LENS1, COVARIANCE, whole_image(LENS1.image_size))
    assert np.sqrt(variances.mean()) == pytest.approx(expected.mean_px)
    assert np.sqrt(variances.max()) == pytest.approx(expected.worst_px)


def test_weight_moves_to_the_pixels_with_most_error() -> None:
    criterion = make_criterion(PRESETS["worst"], INFORMATION, J)
    variances = criterion.variances(COVARIANCE[None])[0]
    moved = criterion.towards_the_worst(COVARIANCE[None])
    assert np.argmax(moved.shares) == np.argmax(variances)
    assert moved.shares.sum() == pytest.approx(1.0)
    assert moved.value(COVARIANCE[None]) == pytest.approx(criterion.value(COVARIANCE[None]))


def test_an_image_that_is_not_given_cannot_count() -> None:
    with pytest.raises(ValueError, match="Jacobians"):
        make_criterion(PRESETS["mapping"], INFORMATION)
