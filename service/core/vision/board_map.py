"""How the plane of a board is mapped into one image, known from where its features are in it.

Of two forms the one that fits: lenses that fold are met by `radial_map` alone, and fisheyes by
`division_map`. Not here: intrinsics and poses (`calibration`).
"""

import numpy as np

from service.core.vision.division_map import fit_division_map
from service.core.vision.map_form import BoardMap
from service.core.vision.radial_map import fit_radial_map
from service.core.vision.transforms import Array

POINTS_FOR_THREE = 16  # fewer, and there is one radial term


def fit_board_map(board: Array, points: Array, middle: Array) -> BoardMap:
    """Return the map that takes board points (n, 2) m nearest to points (n, 2) px.

    middle: (2,) px, of the image, near which a lens has its centre.
    """
    terms = 3 if len(board) >= POINTS_FOR_THREE else 1
    found: list[BoardMap] = [fit(board, points, middle, terms) for fit in (fit_radial_map, fit_division_map)]
    # NaN is worse than anything.
    misfits = [misfit if np.isfinite(misfit := misfit_px(one, board, points)) else np.inf for one in found]
    return found[int(np.argmin(misfits))]


def misfit_px(board_map: BoardMap, board: Array, points: Array) -> float:
    """Return the rms distance of a map's places of board points (n, 2) m from points (n, 2) px."""
    return float(np.sqrt(np.mean(np.sum((board_map.image_of(board) - points) ** 2, axis=1))))
