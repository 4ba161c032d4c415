"""How grey levels change around features, by smooth surfaces through what is measured at all of them.

Around one feature alone a slope of the light looks much like a shift of it. Not here: how light falls across
a board's squares (`light`).
"""

import numpy as np

from service.core.vision.transforms import Array

LARGEST_ORDER = 4
FEATURES_PER_TERM = 3


def light_slopes(points: Array, levels: Array, signs: Array) -> Array:
    """Return the slopes (n, 2, m), per px along x and y, at points (n, 2) px of levels (n, m) there.

    signs: (n,) 1 or -1, which way round dark and bright are at each feature. Of polynomials of the highest
    order, up to the fourth, that have three features for each of their terms; what changes its sign with the
    features, as errors of a model do and light does not, is kept out of them.
    """
    about = points - points.mean(axis=0) if len(points) else points
    scale = float(np.abs(about).max(initial=1.0))
    x, y = (about / scale).T
    order = _order(len(points))
    powers = _powers(order)
    A = np.stack([x**i * y**j for i, j in powers], axis=1)
    alternating = signs[:, None] * A[:, [sum(power) <= order // 2 for power in powers]]
    c = np.linalg.lstsq(np.hstack([A, alternating]), levels, rcond=None)[0][: len(powers)]
    by_x = np.stack([i * x ** max(i - 1, 0) * y**j for i, j in powers], axis=1)
    by_y = np.stack([j * x**i * y ** max(j - 1, 0) for i, j in powers], axis=1)
    return np.stack([by_x @ c, by_y @ c], axis=1) / scale


def _order(features: int) -> int:
    fitting = [n for n in range(LARGEST_ORDER + 1) if len(_powers(n)) * FEATURES_PER_TERM <= features]
    return max(fitting, default=0)


def _powers(order: int) -> list[tuple[int, int]]:
    return [(i, j) for i in range(order + 1) for j in range(order + 1 - i)]
