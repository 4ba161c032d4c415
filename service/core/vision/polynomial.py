"""Polynomials of lens models, as coefficients from the constant on. Not here: which of them a lens has."""

import math
from functools import cache

import numpy as np

from service.core.vision.transforms import Array


def is_positive_up_to(ascending: Array, end: float) -> bool:
    """Whether 1 + a t + b t² + … (n + 1,) is positive from 0 to a finite end.

    Between its least and its largest Bernstein coefficient on an interval lie all values of a polynomial
    (Farouki, CAGD 2012); where they leave it open, the roots decide.
    """
    powers, to_bernstein = _of_interval(len(ascending))
    least = (to_bernstein @ (ascending * end**powers)).min()
    return bool(least > 0.0) or smallest_positive_root(ascending) > end


def smallest_positive_root(ascending: Array) -> float:
    """Return the smallest positive real root of 1 + a t + b t² + …, inf without one.

    In 1/t it is the largest root of a polynomial whose leading coefficient is one, which stays well defined
    where the highest coefficients vanish.
    """
    companion = np.diag(np.ones(len(ascending) - 2), -1)
    companion[0] = -ascending[1:]
    roots = np.linalg.eigvals(companion)
    size = max(1.0, float(np.abs(ascending[1:]).max()))
    # Rounding gives a double root an imaginary part; below the second bound a root is rounding alone.
    real = roots.real[(np.abs(roots.imag) < 1e-7 * size) & (roots.real > 1e-6 * size)]
    return 1.0 / float(real.max()) if len(real) else math.inf


@cache
def _of_interval(count: int) -> tuple[Array, Array]:
    """Return the powers (count,), and the matrix (count, count) from their coefficients to Bernstein's."""
    degree = count - 1
    rows = [[math.comb(i, j) / math.comb(degree, j) for j in range(count)] for i in range(count)]
    return np.arange(float(count)), np.array(rows)
