"""What earlier tests of an axis say of its noise and of the sizes of effects, and how it is learned.

Of each source of shared scatter: how probable each ratio φ of its variance to that of a single reading is. Of
each effect: how large it was. A comparison weighs its φ by the one, and expects effects by the other; without
earlier tests every φ that is tried is as likely as any, and an effect as large as the scatter.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from zlmreport.job.evaluation_keys import NoiseKeys, PriorsKeys, SizeKeys, SourceName
from zlmreport.measurement.axis import Axis
from zlmreport.model.contrasts import contrasts_of
from zlmreport.model.fit import Fit
from zlmreport.model.noise import NoisePart, NoiseSource, noise_parts, ratio_grid
from zlmreport.quantities.arrays import FloatArray

#: What a handful of tests never excludes.
_LEAST_PROBABILITY = 1e-3
#: Square of an effect over σ², below which it is not expected: it would be invisible.
_LEAST_SQUARE = 0.1
#: Tests imagined before the first, in which every ratio was as likely as any; and rounds of learning.
_IMAGINED, _ROUNDS = 1.0, 50


#: What files call the sources.
_NAMES: Mapping[NoiseSource, SourceName] = {
    NoiseSource.POSITION: "position",
    NoiseSource.DIRECTION: "position_and_direction",
    NoiseSource.RUN: "run",
    NoiseSource.TIME: "time",
}


@dataclass(frozen=True, slots=True)
class Expected:
    """What is expected of a test before its readings are looked at.

    Attributes
    ----------
    ratios
        Of a source of shared scatter, ratios φ and their probabilities, shape (2, k).
    sizes
        Root mean square size of an effect, by its identifier, m or rad.
    """

    ratios: Mapping[NoiseSource, FloatArray] = field(default_factory=dict)
    sizes: Mapping[str, float] = field(default_factory=dict)

    @classmethod
    def of(cls, keys: PriorsKeys, axis: Axis) -> Expected:
        """Return what a file of priors says of an axis."""
        ratios = {
            source: np.array([stated.ratios, stated.probabilities])
            for source in NoiseSource
            if (stated := keys.noise.get(_NAMES[source])) is not None
        }
        to_si = axis.deviation_unit.to_si
        return cls(ratios, {name: to_si(each.rms) for name, each in keys.effects.items()})

    def probabilities(self, parts: Sequence[NoisePart], grid: FloatArray) -> FloatArray:
        """Return the probability of each φ of a grid, shape (f,), the sources independent of each other."""
        found = np.ones(len(grid))
        for column, part in zip(grid.T, parts, strict=True):
            if part.source in self.ratios:
                levels = np.array(part.ratios)
                known, stated = self.ratios[part.source]
                nearest = np.argmin(np.abs(levels[:, np.newaxis] - known), axis=0)
                weights = np.bincount(nearest, stated, len(levels)) / stated.sum()
                found *= np.maximum(weights, _LEAST_PROBABILITY)[np.searchsorted(levels, column)]
        return np.asarray(found / found.sum(), dtype=np.float64)

    def in_units_of(self, sigma: float) -> Expected:
        """Return the same with sizes over σ."""
        return replace(self, sizes={name: size / (sigma or 1.0) for name, size in self.sizes.items()})

    def square(self, effect: str) -> float:
        """Return the mean square of an effect, sizes being in units of σ; 1 where no earlier test had it."""
        return max(self.sizes.get(effect, 1.0) ** 2, _LEAST_SQUARE)


def learned(fits: Sequence[Fit]) -> PriorsKeys:
    """Return what tests teach whose models describe their readings.

    The ratios of each test are known within its own likelihood only. So the probabilities are those of the
    population from which the tests come, by the maximum of their common likelihood, beside one imagined test
    that knows nothing.

    Parameters
    ----------
    fits
        The models, of axes of one kind; at least one.
    """
    sizes: dict[str, list[float]] = defaultdict(list)
    for fitted in fits:
        for name, size in _sizes(fitted):
            sizes[name].append(size)
    axis = fits[0].design.axis
    rms = {
        name: axis.deviation_unit.from_si(float(np.sqrt(np.mean(np.square(each)))))
        for name, each in sizes.items()
    }
    return PriorsKeys(
        schema="zlmreport/priors/1",
        kind=axis.kind,
        tests=len(fits),
        noise={
            _NAMES[source]: NoiseKeys(ratios=levels.tolist(), probabilities=weights.tolist())
            for source, (levels, weights) in _population(fits).items()
        },
        effects={name: SizeKeys(rms=rms[name], tests=len(each)) for name, each in sizes.items()},
    )


def _population(fits: Iterable[Fit]) -> dict[NoiseSource, FloatArray]:
    """Return the ratios of each source and their probabilities, shape (2, k)."""
    known = []
    found: dict[NoiseSource, FloatArray] = {}
    for fitted in fits:
        parts = noise_parts(fitted.design)
        space, grid = contrasts_of(fitted.base(), parts, fitted.noise.weights), ratio_grid(parts)
        contrast = space.of(fitted.open_deviation)
        criteria = np.array([space.restricted(contrast, ratios)[0] for ratios in grid])
        known.append((parts, grid, np.exp(-0.5 * (criteria - criteria.min()))))
        for part in parts:
            levels = np.array(part.ratios)
            found[part.source] = np.array([levels, np.full(len(levels), 1.0 / len(levels))])
    for _ in range(_ROUNDS):
        expected = Expected(found)
        counts = {source: np.full(len(each[0]), _IMAGINED / len(each[0])) for source, each in found.items()}
        for parts, grid, likelihoods in known:
            posterior = likelihoods * expected.probabilities(parts, grid)
            posterior /= posterior.sum()
            for column, part in zip(grid.T, parts, strict=True):
                places = np.searchsorted(part.ratios, column)
                counts[part.source] += np.bincount(places, posterior, len(part.ratios))
        found = {
            source: np.array([each[0], counts[source] / counts[source].sum()])
            for source, each in found.items()
        }
    return found


def _sizes(fitted: Fit) -> Iterable[tuple[str, float]]:
    """Yield of each effect the root mean square of what the rest of the model cannot imitate, m or rad."""
    model, solution = fitted.model, fitted.solution
    triples = list(zip(model.terms, solution.thetas, solution.coefficients, strict=True))
    for term, theta, gamma in triples:
        own = term.effect.columns(fitted.design, theta) @ gamma
        others = [
            other.effect.columns(fitted.design, values) for other, values, _ in triples if other is not term
        ]
        rest = np.concatenate([np.zeros((len(own), 1)), *others], axis=1)
        lengths = np.linalg.norm(rest, axis=0)
        scaled = rest / np.where(lengths > 0, lengths, 1.0)
        left = own - scaled @ np.linalg.lstsq(scaled, own, rcond=None)[0]
        yield term.effect.identifier, float(np.sqrt(np.mean(left**2)))
