"""What earlier tests of an axis say of its noise and of the sizes of effects, and how it is learned.

Of each source of shared scatter: how probable each ratio φ of its variance to that of a single reading is. Of
each effect: how large it was. A comparison weighs its φ by the one, and expects effects by the other; without
earlier tests every φ that is tried is as likely as any, and an effect as large as the scatter.
"""

from __future__ import annotations

import json
from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, Self

import numpy as np

from zlmreport.errors import count_in_words
from zlmreport.job.evaluation_keys import NoiseKeys, PriorsKeys, SizeKeys, SourceName
from zlmreport.job.yaml_text import write_in_a_line
from zlmreport.measurement.arrays import FloatArray, compute_left_beside
from zlmreport.measurement.axis import Axis, AxisKind
from zlmreport.measurement.measurand import ANGLE, POSITIONING
from zlmreport.model.fitting.contrasts import make_contrasts_of
from zlmreport.model.fitting.fit import Fit
from zlmreport.model.fitting.noise import NoiseSource, combine_levels, list_noise_parts

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
class PriorExpectation:
    """What is expected of a test before its readings are looked at."""

    #: Of a source of shared scatter, ratios φ and their probabilities, shape (2, k).
    ratios: Mapping[NoiseSource, FloatArray] = field(default_factory=dict)
    #: Root mean square size of an effect, by its identifier, m or rad.
    sizes: Mapping[str, float] = field(default_factory=dict)

    @classmethod
    def of(cls, keys: PriorsKeys, axis: Axis) -> PriorExpectation:
        """Return what a file of priors says of an axis."""
        ratios = {
            source: np.array([stated.ratios, stated.probabilities])
            for source in NoiseSource
            if (stated := keys.noise.get(_NAMES[source])) is not None
        }
        to_si = axis.deviation_unit.to_si
        return cls(ratios, {name: to_si(each.rms) for name, each in keys.effects.items()})

    def compute_probabilities(self, sources: Iterable[NoiseSource], grid: FloatArray) -> FloatArray:
        """Return the probability of each φ of a grid, shape (f,), the sources independent of each other."""
        found = np.ones(len(grid))
        for column, source in zip(grid.T, sources, strict=True):
            levels = np.unique(column)
            found *= self._compute_weights(source, levels)[np.searchsorted(levels, column)]
        return np.asarray(found / found.sum(), dtype=np.float64)

    def compute_costs(self, source: NoiseSource, levels: Sequence[float]) -> tuple[float, ...]:
        """Return −2·ln of the probability of each ratio of a source against one of them all as likely."""
        weights = self._compute_weights(source, np.array(levels))
        return tuple((-2.0 * np.log(weights * len(levels) / weights.sum())).tolist())

    def _compute_weights(self, source: NoiseSource, levels: FloatArray) -> FloatArray:
        """Return how probable each ratio of a source is, up to a factor; (k,)."""
        if source not in self.ratios:
            return np.ones(len(levels))
        known, stated = self.ratios[source]
        nearest = np.argmin(np.abs(levels[:, np.newaxis] - known), axis=0)
        shares = np.bincount(nearest, stated, len(levels)) / stated.sum()
        return np.asarray(np.maximum(shares, _LEAST_PROBABILITY))

    def in_units_of(self, sigma: float) -> PriorExpectation:
        """Return the same with sizes over σ."""
        return replace(self, sizes={name: size / (sigma or 1.0) for name, size in self.sizes.items()})

    def find_square(self, effect: str) -> float:
        """Return the mean square of an effect, sizes being in units of σ; 1 where no earlier test had it."""
        return max(self.sizes.get(effect, 1.0) ** 2, _LEAST_SQUARE)


@dataclass(frozen=True, slots=True)
class Lesson:
    """What one test teaches whose model describes its readings."""

    kind: AxisKind  #: Of its axis.
    measurand: str  #: What it measured, by its identifier.
    #: Root mean square size of each effect that the rest of the model cannot imitate, micrometres or arc
    #: seconds.
    sizes: Mapping[str, float]
    #: The ratios φ that are tried of each source that the test can tell, rising.
    levels: Mapping[NoiseSource, Sequence[float]]
    likelihoods: FloatArray  #: Of every combination of them, shape (f,), the largest 1.

    @classmethod
    def of(cls, fitted: Fit) -> Self:
        """Return what a fitted model teaches."""
        parts, axis = list_noise_parts(fitted.design), fitted.design.axis
        levels = {part.source: part.ratios for part in parts}
        space = make_contrasts_of(fitted.compute_base(), parts, fitted.noise.weights)
        contrast = space.of(fitted.open_deviation)
        criterion = space.make_criterion(contrast)
        criteria = np.array([criterion(ratios)[0] for ratios in combine_levels([*levels.values()])])
        sizes = {name: float(axis.deviation_unit.from_si(size)) for name, size in _list_sizes(fitted)}
        return cls(
            axis.kind, axis.measurand.identifier, sizes, levels, np.exp(-0.5 * (criteria - criteria.min()))
        )

    def as_json(self) -> dict[str, Any]:
        """Return it with as many digits as matter, so that no rounding of a processor shows."""
        return {
            "kind": self.kind,
            "measurand": self.measurand,
            "sizes": {name: _write_short(size) for name, size in self.sizes.items()},
            "levels": {_NAMES[source]: list(levels) for source, levels in self.levels.items()},
            "likelihoods": [_write_short(each) for each in self.likelihoods],
        }

    @classmethod
    def from_json(cls, kept: Mapping[str, Any]) -> Self:
        """Return what `as_json` gave."""
        levels = {source: kept["levels"][name] for source, name in _NAMES.items() if name in kept["levels"]}
        measurand = kept.get("measurand", POSITIONING.identifier)  # what older ledgers do not say
        return cls(kept["kind"], measurand, kept["sizes"], levels, np.array(kept["likelihoods"]))


def _write_short(number: float) -> float:
    return float(f"{number:.7g}")


def learn_priors(lessons: Sequence[Lesson]) -> PriorsKeys:
    """Return what tests teach whose models describe their readings.

    The ratios of each test are known within its own likelihood only. So the probabilities are those of the
    population from which the tests come, by the maximum of their common likelihood, beside one imagined test
    that knows nothing.

    `lessons`: Of one measurand of axes of one kind; at least one.
    """
    sizes: dict[str, list[float]] = defaultdict(list)
    for lesson in lessons:
        for name, size in lesson.sizes.items():
            sizes[name].append(size)
    return PriorsKeys(
        schema="zlmreport/priors/1",
        kind=lessons[0].kind,
        measurand=lessons[0].measurand,
        tests=len(lessons),
        noise={
            _NAMES[source]: NoiseKeys(ratios=levels.tolist(), probabilities=weights.tolist())
            for source, (levels, weights) in _learn_population(lessons).items()
        },
        effects={
            name: SizeKeys(rms=float(np.sqrt(np.mean(np.square(each)))), tests=len(each))
            for name, each in sizes.items()
        },
    )


def _learn_population(lessons: Iterable[Lesson]) -> dict[NoiseSource, FloatArray]:
    """Return the ratios of each source and their probabilities, shape (2, k)."""
    known = [(each.levels, combine_levels([*each.levels.values()]), each.likelihoods) for each in lessons]
    found = {
        source: np.array([tried, np.full(len(tried), 1.0 / len(tried))])
        for levels, _, _ in known
        for source, tried in levels.items()
    }
    for _ in range(_ROUNDS):
        expected = PriorExpectation(found)
        counts = {source: np.full(len(each[0]), _IMAGINED / len(each[0])) for source, each in found.items()}
        for levels, grid, likelihoods in known:
            posterior = likelihoods * expected.compute_probabilities(levels, grid)
            posterior /= posterior.sum()
            for column, source in zip(grid.T, levels, strict=True):
                places = np.searchsorted(found[source][0], column)
                counts[source] += np.bincount(places, posterior, len(found[source][0]))
        found = {
            source: np.array([each[0], counts[source] / counts[source].sum()])
            for source, each in found.items()
        }
    return found


def write_priors(found: PriorsKeys, origin: str) -> str:
    """Return the file of priors, with what it says beside it; `origin` is where its tests are."""
    return "".join(f"{line}\n" for line in _write_lines(found, origin))


def _write_lines(found: PriorsKeys, origin: str) -> Iterator[str]:
    is_angle = found.kind == "rotary" or found.measurand == ANGLE.identifier
    unit = "″" if is_angle else "µm"
    tests, say = count_in_words(found.tests, "test"), "says" if found.tests == 1 else "say"
    # A folder may have any name, and a line that ends in a comment ends the comment.
    named = origin if origin.isprintable() else json.dumps(origin)
    yield f"# What {tests} in {named} {say} of noise and sizes of effects: model.priors of a job."
    yield f"schema: {found.schema_}"
    yield f"kind: {found.kind}"
    if found.measurand != POSITIONING.identifier:
        yield f"measurand: {found.measurand}"
    yield f"tests: {found.tests}"
    yield "noise: # how probable each ratio of a shared variance to that of a single reading is"
    for source, keys in found.noise.items():
        probabilities = [round(each, 3) for each in keys.probabilities]
        yield f"  {source}: {write_in_a_line({'ratios': keys.ratios, 'probabilities': probabilities})}"
    yield f"effects: # what the rest of the model cannot imitate of each, root mean square, {unit}"
    for name, size in found.effects.items():
        yield f"  {name}: {write_in_a_line({'rms': float(f'{size.rms:.4g}'), 'tests': size.tests})}"


def _list_sizes(fitted: Fit) -> Iterable[tuple[str, float]]:
    """Yield of each effect the root mean square of what the rest of the model cannot imitate, m or rad."""
    model, solution = fitted.model, fitted.solution
    triples = list(zip(model.terms, solution.thetas, solution.coefficients, strict=True))
    for term, theta, gamma in triples:
        own = term.effect.columns(fitted.design, theta) @ gamma
        others = [
            other.effect.columns(fitted.design, values) for other, values, _ in triples if other is not term
        ]
        rest = np.concatenate([np.zeros((len(own), 1)), *others], axis=1)
        left = compute_left_beside(rest, own)
        yield term.effect.identifier, float(np.sqrt(np.mean(left**2)))
