"""How many numbers of a set are fixed to position, and how many the targets can tell.

The mean of both directions at m targets is m numbers, their difference as many again. A model with as many
in one of the two describes any readings, whatever made them: its terms grow without bounds and cancel. A
search passes through sets with just as many on its way to smaller ones; none with more is looked at.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeAlias

import numpy as np

from zlmreport.measurement.arrays import BoolArray, FloatArray
from zlmreport.model.diagnosis.effect_set import SetMember
from zlmreport.model.diagnosis.families import Family, count_searched
from zlmreport.model.effects.design import Design

#: Of the largest value of a column, what is as small is rounding.
_ROUNDING = 1e-9
#: Of fewer targets a constant and a slope are all that is asked, and both of them are.
_FEWEST_TARGETS = 4
#: Numbers in the mean of both directions, and in their difference.
Counted: TypeAlias = tuple[int, int]


class FixedNumbers:
    """The numbers that the job's model and sets beside it have at the targets of a design."""

    def __init__(self, design: Design, base: FloatArray) -> None:
        """Count those of the job's model.

        `base`, (N, q): Its columns, tangents of its searched parameters included.
        """
        self._design = design
        place = design.target + design.session * (design.target.max() + 1)
        _, target = np.unique(place, return_inverse=True)
        self._cell = 2 * target + (design.direction > 0)
        self._readings = np.bincount(self._cell, minlength=2 * (int(target.max()) + 1)).reshape(-1, 2)
        self._both: BoolArray = np.min(self._readings, axis=1) > 0
        self._targets: Counted = len(self._both), int(self._both.sum())
        self._base = self._count_ranks(base)
        self._known: dict[int, Counted] = {}  # of families

    def are_too_many(self, members: Sequence[SetMember]) -> bool:
        """Return whether the numbers of a set and of the model are more than the targets."""
        own = [self._count_numbers(each.family) for each in members]
        sums = zip(zip(*own, strict=True), self._base, self._targets, strict=True)
        return any(
            targets >= _FEWEST_TARGETS and 0 < sum(numbers) > targets - before
            for numbers, before, targets in sums
        )

    def is_model_too_rich(self) -> bool:
        """Return whether the model alone has as many numbers as there are targets, or more."""
        pairs = zip(self._base, self._targets, strict=True)
        return any(own >= targets >= _FEWEST_TARGETS for own, targets in pairs)

    def _count_numbers(self, family: Family) -> Counted:
        """Return the numbers of a family: those that the model does not imitate, and what is searched."""
        if id(family) not in self._known:
            middle, searched = len(family.thetas) // 2, count_searched(family.thetas)
            ranks = self._count_ranks(family.effect.columns(self._design, family.thetas[middle]))
            mean, difference = (min(each, int(family.ranks[middle])) for each in ranks)
            self._known[id(family)] = mean + searched * (mean > 0), difference + searched * (difference > 0)
        return self._known[id(family)]

    def _count_ranks(self, columns: FloatArray) -> Counted:
        """Return how many columns that are fixed to position, (N, k), differ in mean and in difference."""
        shape = (*self._readings.shape, columns.shape[1])
        sums = np.zeros((shape[0] * shape[1], shape[2]))
        np.add.at(sums, self._cell, columns)
        means = sums / np.maximum(self._readings.ravel(), 1)[:, np.newaxis]
        largest = np.abs(columns).max(axis=0, initial=0.0)
        is_fixed = np.abs(columns - means[self._cell]).max(axis=0, initial=0.0) <= _ROUNDING * largest
        fixed = (means / np.where(largest > 0, largest, 1.0))[:, is_fixed & (largest > 0)]
        down, up = fixed.reshape(*shape[:2], -1).transpose(1, 0, 2)
        there = (self._readings > 0).T[:, :, np.newaxis]
        mean = (down + up) / np.maximum(there.sum(axis=0), 1)
        difference = (up - down)[self._both]
        return _count_independent(mean), _count_independent(difference)


def _count_independent(columns: FloatArray) -> int:
    return int(np.linalg.matrix_rank(columns, tol=_ROUNDING * len(columns))) if columns.size else 0
