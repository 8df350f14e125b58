"""Tail probabilities and quantiles of the distributions that the tests of the error model need.

Written out, because they are three short functions and a statistics library takes longer to load than a
diagnosis to run. Continued fractions after W. J. Lentz, Applied Optics 15 (1976) 668.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from itertools import count

_CONVERGED = 1e-15
_TINY = 1e-300
_MOST_TERMS = 100_000


def gamma_tail(shape: float, x: float) -> float:
    """Return Q(a, x) = Γ(a, x)/Γ(a): the chance that a standard gamma variable exceeds x.

    `shape`: a > 0.
    `x`: In units of the scale.
    """
    if x <= 0:
        return 1.0
    scale = math.exp(shape * math.log(x) - x - math.lgamma(shape))
    if x < shape + 1:
        term = total = 1.0 / shape
        for k in range(1, _MOST_TERMS):
            term *= x / (shape + k)
            total += term
            if term < total * _CONVERGED:
                break
        return max(0.0, 1.0 - scale * total)

    def fraction() -> Iterator[tuple[float, float]]:
        yield 1.0, x + 1 - shape
        for k in count(1):
            yield -k * (k - shape), x + 2 * k + 1 - shape

    return scale * _compute_continued_fraction(fraction())


def chi_square_tail(x: float, degrees: float) -> float:
    """Return the chance that χ² with so many degrees of freedom exceeds x."""
    return gamma_tail(degrees / 2, x / 2)


def normal_tail(z: float) -> float:
    """Return the chance that a standard normal variable exceeds z."""
    return 0.5 * math.erfc(z / math.sqrt(2))


def f_tail(ratio: float, numerator: float, denominator: float) -> float:
    """Return the chance that F with so many degrees of freedom exceeds a ratio of variances."""
    if ratio <= 0:
        return 1.0
    product = numerator * ratio
    return _compute_beta(denominator / 2, numerator / 2, denominator / (denominator + product))


def t_quantile(probability: float, degrees: float) -> float:
    """Return Student's t that is not exceeded, either way, with this probability (two-sided).

    >>> round(t_quantile(0.95, 10), 3)
    2.228
    """
    return _find_root(
        lambda t: 1 - probability - _compute_beta(degrees / 2, 0.5, degrees / (degrees + t * t))
    )


def _find_root(rising: Callable[[float], float]) -> float:
    """Return where a function that rises from below zero at 0 crosses zero."""
    low, high = 0.0, 1.0
    while rising(high) < 0:
        low, high = high, 2 * high
    for _ in range(200):
        middle = 0.5 * (low + high)
        if middle in (low, high):
            break
        low, high = (middle, high) if rising(middle) < 0 else (low, middle)
    return 0.5 * (low + high)


def _compute_beta(a: float, b: float, x: float) -> float:
    """Return the regularized incomplete beta function I_x(a, b)."""
    if x <= 0:
        return 0.0
    if x >= 1:
        return 1.0
    front = math.exp(
        math.lgamma(a + b) - math.lgamma(a) - math.lgamma(b) + a * math.log(x) + b * math.log1p(-x)
    )
    if x > (a + 1) / (a + b + 2):
        return 1.0 - front * _compute_continued_fraction(_list_beta_terms(b, a, 1 - x)) / b
    return front * _compute_continued_fraction(_list_beta_terms(a, b, x)) / a


def _list_beta_terms(a: float, b: float, x: float) -> Iterator[tuple[float, float]]:
    yield 1.0, 1.0
    for k in count():
        yield -(a + k) * (a + b + k) * x / ((a + 2 * k) * (a + 2 * k + 1)), 1.0
        yield (k + 1) * (b - k - 1) * x / ((a + 2 * k + 1) * (a + 2 * k + 2)), 1.0


def _compute_continued_fraction(terms: Iterator[tuple[float, float]]) -> float:
    """Return a₁/(b₁ + a₂/(b₂ + …)) for the terms (a, b)."""
    numerator, start = next(terms)
    value = upper = start or _TINY
    lower = 0.0
    for _, (a, b) in zip(range(_MOST_TERMS), terms, strict=False):
        lower = 1 / ((b + a * lower) or _TINY)
        upper = (b + a / upper) or _TINY
        change = upper * lower
        value *= change
        if abs(change - 1) < _CONVERGED:
            break
    return numerator / value
