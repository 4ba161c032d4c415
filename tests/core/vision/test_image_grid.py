"""Cells of the image, against counting by hand."""

import numpy as np

from service.core.vision.image_grid import ImageGrid

CELLS = ImageGrid((1280, 800))


def test_cells_are_square_and_fill_the_image() -> None:
    assert (CELLS.columns, CELLS.rows) == (40, 25)
    assert ImageGrid((1920, 1208)).rows == 25
    np.testing.assert_allclose(
        CELLS.centres[[0, 1, 40, -1]], [[15.5, 15.5], [47.5, 15.5], [15.5, 47.5], [1263.5, 783.5]]
    )


def test_points_are_counted_in_the_cell_that_holds_them() -> None:
    counts = CELLS.count(np.array([[-0.5, -0.5], [31.4, 0.0], [31.6, 0.0], [1279.0, 799.0], [2000.0, 5.0]]))

    assert (counts[0, 0], counts[0, 1], counts[24, 39], counts.sum()) == (2, 1, 1, 4)
