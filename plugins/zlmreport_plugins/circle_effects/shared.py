"""Differences between axes, for effects that two axes share; estimates in sentences."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise

import numpy as np

from zlmreport.plugin import MINUS_SIGN, FloatArray, Words, same_in_all_languages
from zlmreport.plugin.circle_effect import AXES, CircleDesign, Estimate, pair_words


def find_differences(design: CircleDesign) -> Iterator[tuple[str, FloatArray]]:
    """Yield differences of neighbouring axes with the share that each axis has in one unit of them.

    The mean of all axes is nobody's difference: it is the radius'.
    """
    axes = design.axes
    count = len(axes)
    for place, (one, other) in enumerate(pairwise(axes)):
        share = np.zeros(3)
        share[list(axes[: place + 1])] = (count - place - 1) / count
        share[list(axes[place + 1 :])] = -(place + 1) / count
        yield f"{AXES[one]}-{AXES[other]}", share


def title_difference(name: str) -> Words:
    """Return how pages write the name of a difference between axes."""
    return same_in_all_languages(name.replace("-", f" {MINUS_SIGN} "))


def write_pair(estimate: Estimate, value: float) -> tuple[Words, Words]:
    """Return a value of an estimate, SI, and its U, in its unit and rounded together."""
    unit = estimate.unit
    return pair_words(unit.from_si(value), unit.from_si(estimate.expanded_uncertainty))


def is_within_u(estimate: Estimate) -> bool:
    """Return whether it may be nothing: its amount is no more than its U."""
    return abs(estimate.value) <= estimate.expanded_uncertainty
