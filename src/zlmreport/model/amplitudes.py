"""Waves of a fitted model as people read them: amplitude and phase instead of sine and cosine."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from zlmreport.model.estimate import Estimate
from zlmreport.model.fit import Fit
from zlmreport.model.harmonic import Harmonic, harmonics


@dataclass(frozen=True, slots=True)
class Wave:
    """A harmonic of a periodic effect.

    Attributes
    ----------
    effect
        Identifier of the effect.
    harmonic
        Its amplitude and phase with standard uncertainties, SI.
    coverage_factor
        k for 95 %, of both.
    """

    effect: str
    harmonic: Harmonic
    coverage_factor: float


def waves(fitted: Fit) -> tuple[Wave, ...]:
    """Return the harmonics of all periodic effects of a model; one with a given parameter is left out."""
    return tuple(_waves(fitted))


def _waves(fitted: Fit) -> Iterator[Wave]:
    known = fitted.uncertainties
    covariance = known.sigma**2 * known.inverse + known.systematic @ known.systematic.T
    first = 0
    for term in fitted.model.terms:
        solved = int(np.count_nonzero(term.is_solved))
        columns = slice(first, first + solved)
        first += solved
        if solved < len(term.effect.linear):
            continue
        own: list[Estimate] = [
            each
            for each in fitted.estimates
            if each.effect == term.effect.identifier and each.parameter in term.effect.linear
        ]
        values = np.array([each.value for each in own])
        for harmonic in harmonics(term.effect.linear, values, covariance[columns, columns]):
            yield Wave(term.effect.identifier, harmonic, own[0].coverage_factor)
