"""Where a pose set is in the image, against cv2's polygons."""

import cv2
import numpy as np

from service.core.planning.image_maps import measure_coverage
from service.core.planning.pose_space import PoseSpace, sample_poses
from service.core.planning.review import review_poses
from service.core.vision.image_grid import ImageGrid
from tests.core.planning.cameras import BOARD, LENS1

POSES = sample_poses(PoseSpace(), LENS1, BOARD, 10, seed=5)
CELLS = ImageGrid(LENS1.image_size)


def test_coverage_counts_every_corner_and_the_boards_that_enclose_a_cell() -> None:
    found = measure_coverage(LENS1, BOARD, POSES, CELLS)

    assert found.corners.sum() == 10 * 54
    outlines = [pose.outline_px.astype(np.float32) for pose in review_poses(LENS1, BOARD, POSES)]
    distances = np.array(
        [
            [cv2.pointPolygonTest(one, (float(u), float(v)), True) for one in outlines]
            for u, v in CELLS.centres
        ]
    )
    # Between its points the polygon is straight and the board is not: a pixel decides nothing.
    clear = np.all(np.abs(distances) > 1.0, axis=1)
    by_polygon = np.sum(distances > 0, axis=1)
    assert clear.mean() > 0.9
    np.testing.assert_array_equal(found.boards.ravel()[clear], by_polygon[clear])
    assert found.boards.max() > 1
