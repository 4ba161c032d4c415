"""Do the squares alternate between dark and bright as a chessboard's must?

Not here: where the corners are, and the fall of light (`light`).
"""

from dataclasses import dataclass

import numpy as np

from service.core.vision.light import Cells, LightFall


@dataclass(frozen=True)
class Parity:
    """How well dark and bright squares separate.

    separation: (min bright − max dark) / (mean bright − mean dark) of the cells once the fall of light across
    the board has been taken out; at most 1, below 0 when the squares do not alternate.
    contrast: mean bright − mean dark, grey levels; negative when dark and bright have changed places.
    """

    separation: float
    contrast: float


def measure_parity(cells: Cells, light: LightFall) -> Parity:
    """Return the parity of a board's cells under the light that was fitted to them."""
    contrast = float(cells.levels[cells.bright].mean() - cells.levels[~cells.bright].mean())
    bright, dark = light.levels(cells.centres[:, 0], cells.centres[:, 1])
    gap = bright - dark
    if np.any(gap <= 0.0):
        return Parity(-1.0, contrast)
    level = (cells.levels - dark) / gap
    over, under = level[cells.bright], level[~cells.bright]
    return Parity(float((over.min() - under.max()) / (over.mean() - under.mean())), contrast)
