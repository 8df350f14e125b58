"""The contest on many sets of deviations at once, for simulated tests."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from zlmreport.measurement.arrays import FloatArray, IntArray
from zlmreport.model.diagnosis.blocks import average_likelihoods
from zlmreport.model.diagnosis.columns import HeldContrasts
from zlmreport.model.diagnosis.contest import Contest, Group
from zlmreport.model.diagnosis.likelihood import NOTHING, Amplitudes, Reduced


@dataclass(frozen=True, eq=False)
class Trials:
    """What families and parts without a name would add on B sets of deviations; reckoned as it is asked for.

    `amplitudes`, `members`: What stands beside: parts without a name, and the columns of a set.
    `deviations`: (N, B), m or rad.
    `known`: Standard deviation of a noise of known size, m or rad.
    """

    contest: Contest
    amplitudes: Amplitudes
    members: Sequence[IntArray]
    deviations: FloatArray
    known: float = 0.0

    @cached_property
    def ratios(self) -> FloatArray:
        """LR of each installed effect, its best value and coefficients taken, shape (effects, B)."""
        return self.compute_ratios_of(self.contest.identifiers)

    def compute_ratios_of(self, effects: Sequence[str]) -> FloatArray:
        """Return the same of some effects, by their identifiers."""
        forms = dict(zip(self.contest.identifiers, self.contest.by_effect, strict=True))
        found = self._compute_best([number for name in effects for number in forms[name]])
        best = [np.min([found[number] for number in forms[name]], axis=0) for name in effects]
        return -np.array(best).reshape(-1, self._sets)

    @cached_property
    def evidence(self) -> FloatArray:
        """2·ln of the Bayes factor of each, averaged over its values, shape (effects, B)."""
        forms = self.contest.by_effect
        found = self._average([number for each in forms for number in each])
        averages = [
            average_likelihoods(np.array([found[number] for number in each]) + 2.0 * np.log(len(each)), 0)
            for each in forms
        ]
        return -np.array(averages).reshape(-1, self._sets)

    @cached_property
    def nameless(self) -> FloatArray:
        """The evidence of all that has no name, shape (forms and parts, B)."""
        unnamed = [number for number, each in enumerate(self.contest.families) if not each.is_named]
        found = self._average(unnamed)
        shapes = [*(-found[number] for number in unnamed), *self._list_evidence_of_parts()]
        return np.array(shapes).reshape(-1, self._sets)

    @cached_property
    def criterion(self) -> FloatArray:
        """−2·ln of the restricted likelihood of nothing of this, shape (B,)."""
        return np.asarray(self.contest.compute_logarithm(self._squares) + self._reduced.log_determinant)

    @property
    def _sets(self) -> int:
        return int(self.deviations.shape[1])

    @cached_property
    def _reduced(self) -> Reduced:
        return self.contest.reduce_set(self.amplitudes, self.members)

    @cached_property
    def _held(self) -> HeldContrasts:
        return self.contest.columns.hold(self.contest.space.of(self.deviations))

    @cached_property
    def _taken(self) -> FloatArray:
        return self.contest.compute_coordinates_of(self._reduced, self._held)

    @cached_property
    def _squares(self) -> FloatArray:
        return self._compute_squares(self._reduced)

    def _compute_squares(self, reduced: Reduced) -> FloatArray:
        beside = self.contest.compute_squares_beside(reduced, self._held)
        return beside + self.contest.space.degrees * self.known**2

    def _compute_best(self, numbers: Sequence[int]) -> dict[int, FloatArray]:
        """Return for families, by their numbers, how far their best values lower −2·ln of the likelihood."""
        contest, best = self.contest, dict[int, FloatArray]()
        for group in contest.group_by_width(tuple(numbers)):
            left = np.maximum(self._squares - self._explain(group)[0], NOTHING)
            least = np.minimum.reduceat(left, group.starts, axis=0)
            fitted = contest.compute_logarithm(least) - contest.compute_logarithm(self._squares)
            best.update(zip(group.families.tolist(), fitted, strict=True))
        return best

    def _average(self, numbers: Sequence[int]) -> dict[int, FloatArray]:
        """Return −2·ln of the Bayes factors of families, by their numbers, averaged over their values."""
        contest, averages = self.contest, dict[int, FloatArray]()
        for group in contest.group_by_width(tuple(numbers)):
            explained, ranks = self._explain(group)
            added = contest.compute_criterion_of_blocks(
                self._squares, explained, ranks[:, np.newaxis], group.squares[:, np.newaxis]
            )
            added -= 2.0 * group.log_weights[:, np.newaxis]
            own = np.split(added, group.starts[1:])
            averages.update(
                (number, average_likelihoods(each, 0))
                for number, each in zip(group.families.tolist(), own, strict=True)
            )
        return averages

    def _explain(self, group: Group) -> tuple[FloatArray, FloatArray]:
        response = self.contest.columns.multiply_with(self._reduced.ratios, group.places.ravel(), self._held)
        return self.contest.explain_group(self._reduced, group, response, self._taken)

    def _list_evidence_of_parts(self) -> Iterator[FloatArray]:
        """Yield the evidence of each part without a name, its amplitude averaged over, shape (B,) each."""
        contest = self.contest
        before = contest.compute_logarithm(self._squares) + self._reduced.log_determinant
        for number, part in enumerate(contest.parts):
            levels = range(part.noise_levels, len(part.levels))
            if not levels:
                continue
            if part.irregular is None:
                tried = self._compute_by_level(number)[levels.start :]
            else:
                tried = np.array([self._compute_at(number, level) for level in levels])
            yield -average_likelihoods(tried - before, 0) - 2.0 * np.log(len(levels))

    def _compute_at(self, number: int, level: int) -> FloatArray:
        """Return `criterion` with a part at a level."""
        amplitudes = (*self.amplitudes[:number], level, *self.amplitudes[number + 1 :])
        reduced = self.contest.reduce_set(amplitudes, self.members)
        return np.asarray(
            self.contest.compute_logarithm(self._compute_squares(reduced)) + reduced.log_determinant
        )

    def _compute_by_level(self, number: int) -> FloatArray:
        """Return `criterion` at every level of a part that is not irregular, shape (levels, B)."""
        contest = self.contest
        amplitudes = (*self.amplitudes[:number], 0, *self.amplitudes[number + 1 :])
        reduced = contest.reduce_set(amplitudes, self.members)
        taken = contest.compute_coordinates_of(reduced, self._held)
        response = contest.columns.multiply_with(reduced.ratios, contest.parts[number].columns, self._held)
        away, spread = contest.take_parts(reduced, [number], response, taken)
        left = np.maximum(self._compute_squares(reduced) - away[0], NOTHING)
        return np.asarray(
            contest.compute_logarithm(left) + spread[0][:, np.newaxis] + reduced.log_determinant
        )


def average_evidence(trials: Sequence[Trials]) -> tuple[FloatArray, FloatArray]:
    """Return the evidence of effects and of what has no name, averaged over amplitudes all as likely."""
    criteria = np.array([each.criterion for each in trials])
    nothing = average_likelihoods(criteria, 0)
    return (
        nothing
        - average_likelihoods(criteria[:, np.newaxis] - np.array([each.evidence for each in trials]), 0),
        nothing
        - average_likelihoods(criteria[:, np.newaxis] - np.array([each.nameless for each in trials]), 0),
    )
