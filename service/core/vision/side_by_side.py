"""Several solves side by side: what one of them needs, with a leading dimension for all.

So that a few of them take hardly longer than one. Not here: what a solve is.
"""

from collections.abc import Sequence
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from service.core.vision.normal_equations import Estimate, NormalEquations, Step
from service.core.vision.transforms import Array

Rows = TypeVar("Rows", Estimate, NormalEquations, Step)


def side_by_side(each: Sequence[Rows]) -> Rows:
    """Return one with a row for each."""
    return type(each[0])(*map(np.stack, zip(*map(_arrays, each), strict=True)))


def row(of: Rows, index: int) -> Rows:
    """Return one row by itself."""
    return type(of)(*(array[index] for array in _arrays(of)))


def rows(of: Rows, indices: Sequence[int]) -> Rows:
    """Return some of the rows."""
    return type(of)(*(array[list(indices)] for array in _arrays(of)))


def chosen(first: NDArray[np.bool_], a: Rows, b: Rows) -> Rows:
    """Return the rows of a where `first` (s,) says so, those of b elsewhere."""
    if first.all():
        return a
    pairs = zip(_arrays(a), _arrays(b), strict=True)
    return type(a)(*(np.where(first.reshape(-1, *(1,) * (x.ndim - 1)), x, y) for x, y in pairs))


def _arrays(of: Estimate | NormalEquations | Step) -> list[Array]:
    """Return the fields in their order; `dataclasses.fields` takes as long as a small product of matrices."""
    return list(vars(of).values())
