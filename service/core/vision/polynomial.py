"""Polynomials of lens models, as coefficients from the constant on. Not here: which of them a lens has."""

import math
from collections.abc import Sequence

import numpy as np


def is_positive_up_to(ascending: Sequence[float], end: float) -> bool:
    """Whether 1 + a t + b t² + … is positive from 0 to a finite end.

    Between its least and its largest Bernstein coefficient on an interval lie all values of a polynomial
    (Farouki, CAGD 2012); where they leave it open, the roots decide.
    """
    # Written so that NaN is not positive.
    return all(b > 0.0 for b in _bernstein(ascending, end)) or smallest_positive_root(ascending) > end


def _bernstein(ascending: Sequence[float], end: float) -> list[float]:
    """Return the Bernstein coefficients of a polynomial on 0…end: sums of binomials times scaled ones.

    Of so few numbers plain Python takes less than arrays, which would have to be made of them first.
    """
    degree = len(ascending) - 1
    b, power = [], 1.0
    for i, a in enumerate(ascending):
        b.append(a * power / math.comb(degree, i))
        power *= end
    for first in range(1, degree + 1):
        for i in range(degree, first - 1, -1):
            b[i] += b[i - 1]
    return b


def smallest_positive_root(ascending: Sequence[float]) -> float:
    """Return the smallest positive real root of 1 + a t + b t² + …, inf without one.

    In 1/t it is the largest root of a polynomial whose leading coefficient is one, which stays well defined
    where the highest coefficients vanish.
    """
    companion = np.diag(np.ones(len(ascending) - 2), -1)
    companion[0] = [-coefficient for coefficient in ascending[1:]]
    roots = np.linalg.eigvals(companion)
    size = max(1.0, *map(abs, ascending[1:]))
    # Rounding gives a double root an imaginary part; below the second bound a root is rounding alone.
    real = roots.real[(np.abs(roots.imag) < 1e-7 * size) & (roots.real > 1e-6 * size)]
    return 1.0 / float(real.max()) if len(real) else math.inf
