"""The contest: how much each effect would add to a set, beside amplitudes of what has no name.

    x = X·β + Σ_k C_k(θ_k)·γ_k + Σ_j √φ_j·Z_j·u_j + ε,   u_j and ε/σ standard normal

X is the job's model, C_k are the effects of a set, Z_j the parts of the covariance: noise, and random curves
without a name. β has a flat prior and drops out with the space of contrasts; σ is profiled out. The
coefficients γ of an effect have a normal prior about zero, its variance that of a single reading or, rarely,
far larger (A. Zellner's g-prior, mixed over g: F. Liang et al., J. Amer. Statist. Assoc. 103 (2008) 410): so
a large effect costs evidence as its logarithm, and none is impossible. Everything is in units of −2·ln.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import TypeAlias

import numpy as np

from zlmreport.measurement.arrays import FloatArray, IntArray
from zlmreport.model.diagnosis.blocks import average_likelihoods, solve_blocks, take_from
from zlmreport.model.diagnosis.columns import Columns
from zlmreport.model.diagnosis.families import Family, group_forms_by_effect, is_known, list_families_of
from zlmreport.model.diagnosis.likelihood import (
    DIGITS_OF_SCORE,
    ROUNDING,
    Amplitudes,
    Likelihood,
    Place,
    Reduced,
    place_of,
)
from zlmreport.model.diagnosis.nameless import list_parts_of, make_irregular_factors
from zlmreport.model.effects.design import Design
from zlmreport.model.effects.effect import Effect
from zlmreport.model.fitting.contrasts import describe_single_readings, make_contrasts_of
from zlmreport.model.fitting.noise import list_noise_parts
from zlmreport.model.fitting.priors import PriorExpectation

#: Variances of an effect before any reading, in units of what one reading is worth, and their weights; the
#: first is what earlier tests say, where they do.
_WORTHS = ((1.0, 0.9), (1e2, 0.05), (1e4, 0.03), (1e6, 0.02))
#: Is told the share of some work that is done, 0 to 1.
Told: TypeAlias = Callable[[float], object]


def tell_nobody(_share: float) -> None:
    """Tell nobody."""


@dataclass(frozen=True, slots=True)
class Group:
    """Families whose blocks are of one width, their blocks below one another."""

    families: IntArray  #: (f,) integer: Their numbers.
    places: IntArray  #: (g, k) integer: The places of the columns of each block.
    starts: IntArray  #: (f,) integer: The first block of each family.
    sizes: IntArray  #: (f,) integer: The number of its blocks.
    squares: FloatArray  #: (g,): Mean square that is expected of each over σ².
    log_weights: FloatArray  #: (g,)
    prices: FloatArray  #: (f,)


@dataclass(frozen=True, slots=True)
class Scan:
    """What each family would add to a set, under given amplitudes."""

    #: (families,): −2·ln of the odds for it; the lower the better. Infinite where the set imitates it.
    criterion: FloatArray
    best: IntArray  #: (families,) integer: The best of its blocks.
    spread: FloatArray  #: (families,): How much more than its best value the average over all costs.


@dataclass(frozen=True, kw_only=True)
class Contest(Likelihood):
    """Everything about a contest that does not depend on what was measured, and the readings themselves."""

    design: Design
    base: FloatArray  #: (N, q): Columns of the job's model, tangents of its searched parameters included.
    families: tuple[Family, ...]
    invisible: tuple[Effect, ...]  #: Effects of which the plan sees nothing beside the model.
    deviation: FloatArray  #: (N,): x, m or rad; zeros where only simulated readings are asked about.
    least_visible: float
    expected: PriorExpectation = field(default_factory=PriorExpectation)
    _groups: dict[tuple[int, ...] | None, tuple[Group, ...]] = field(default_factory=dict, repr=False)
    _scans: dict[tuple[Place, tuple[int, ...] | None], Scan] = field(default_factory=dict, repr=False)

    @classmethod
    def of(  # noqa: PLR0913 - a test, a model, what contends, and what is known
        cls,
        design: Design,
        base: FloatArray,
        effects: Iterable[Effect],
        deviation: FloatArray | None = None,
        *,
        weights: FloatArray | None = None,
        memory: float = 0.0,
        forms: Iterable[Effect] = (),
        known: float = 0.0,
        least_visible: float = 1e-6,
        expected: PriorExpectation | None = None,
        with_nameless: bool = True,
    ) -> Contest:
        """Prepare a contest.

        `base`, (N, q): Columns of the job's model, tangents of its searched parameters included.
        `effects`: Forms of installed effects that can be tested on the design.
        `deviation`, (N,): x, m or rad; None where only simulated readings are asked about.
        `weights`, (N,): w, the variance of each reading over the mean one.
        `memory`: Time over which a reading is forgotten, in the unit of the design's time; 0 for none.
        `forms`: Forms without a name.
        `known`: Standard deviation of a noise of known size that stands beside σ, m or rad.
        `least_visible`: Share of an effect's length below which the model imitates it entirely.
        `expected`: What earlier tests say, sizes in units of σ.
        `with_nameless`: Whether parts without a name are thought of.
        """
        readings, sources = len(design.position), list_noise_parts(design)
        expected = expected or PriorExpectation()
        weights = np.ones(readings) if weights is None else weights
        space = make_contrasts_of(base, sources, describe_single_readings(design, weights, memory))
        columns = Columns(space, make_irregular_factors(sources))
        deviation = np.zeros(readings) if deviation is None else deviation
        contrast = space.of(deviation)
        squares = float(contrast @ contrast)
        response = columns.add(contrast[:, np.newaxis] / (np.sqrt(squares) or 1.0))
        parts = list_parts_of(design, columns, sources, expected, with_nameless=with_nameless)
        core = 1 + sum(part.width for part in parts)
        listed = [(each, each.grid(design)) for each in effects]
        named, invisible = list_families_of(design, columns, listed, least_visible)
        rivals = [each for each in forms if not is_known(each, design, columns, named)]
        unnamed, _ = list_families_of(
            design, columns, [(each, each.grid(design)) for each in rivals], least_visible, is_named=False
        )
        columns.keep(core)
        return cls(
            columns=columns,
            parts=parts,
            response=response,
            squares=squares,
            known=space.degrees * known**2,
            design=design,
            base=base,
            families=(*named, *unnamed),
            invisible=invisible,
            deviation=deviation,
            least_visible=least_visible,
            expected=expected,
        )

    @cached_property
    def by_effect(self) -> tuple[tuple[int, ...], ...]:
        """For each installed effect, the places of its forms among the families."""
        return group_forms_by_effect(self.families)

    @cached_property
    def identifiers(self) -> tuple[str, ...]:
        """The installed effects in this order."""
        return tuple(self.families[forms[0]].identifier for forms in self.by_effect)

    def group_by_width(self, numbers: tuple[int, ...] | None) -> tuple[Group, ...]:
        """Return families by the width of their blocks; all of them, or some by their numbers."""
        if numbers not in self._groups:
            widths: dict[int, list[int]] = {}
            for number in range(len(self.families)) if numbers is None else numbers:
                widths.setdefault(self.families[number].blocks.shape[1], []).append(number)
            self._groups[numbers] = tuple(self._group(members) for _, members in sorted(widths.items()))
        return self._groups[numbers]

    def _group(self, members: Sequence[int]) -> Group:
        """Return families of one width, their blocks below one another."""
        own = [self.families[each] for each in members]
        sizes = np.array([len(each.blocks) for each in own])
        squares = [self.expected.find_square(each.identifier) for each in own]
        return Group(
            np.array(members),
            np.concatenate([each.blocks for each in own]),
            np.cumsum([0, *sizes])[:-1],
            sizes,
            np.repeat(squares, sizes),
            np.concatenate([each.log_weights for each in own]),
            np.array([each.price for each in own]),
        )

    def explain_group(
        self, reduced: Reduced, group: Group, response: FloatArray, taken: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        """Return what each block explains of the squares of B sets of deviations beside a set, and its rank.

        `response`, (g·k, B): Products of the columns with the deviations.
        `taken`, (p, B): The deviations in the coordinates of the set.
        """
        flat = group.places.ravel()
        coordinates = reduced.compute_coordinates(
            self.columns.multiply_with_kept(reduced.ratios, reduced.places, flat)
        )
        gram = take_from(self.columns.multiply_kept_blocks(reduced.ratios, group.places), coordinates)
        left = response - coordinates.T @ taken
        return solve_blocks(gram, left.reshape(*group.places.shape, -1))

    def scan(
        self, amplitudes: Amplitudes, members: Sequence[IntArray], only: Sequence[int] | None = None
    ) -> Scan:
        """Return what every family would add to a set; or only some, by their numbers."""
        place = place_of(amplitudes, members), None if only is None else tuple(only)
        if place not in self._scans:
            self._scans[place] = self._scan(
                self.reduce_set(amplitudes, members), self.group_by_width(place[1])
            )
        return self._scans[place]

    def _scan(self, reduced: Reduced, groups: Iterable[Group]) -> Scan:
        count = len(self.families)
        scan = Scan(np.full(count, np.inf), np.zeros(count, dtype=np.int64), np.zeros(count))
        for group in groups:
            response = self.columns.multiply_with_kept(reduced.ratios, self.response, group.places.ravel())
            explained, ranks = self.explain_group(reduced, group, response.T, reduced.taken[:, np.newaxis])
            added = self.compute_criterion_of_blocks(
                reduced.squares, explained[:, 0] * self.squares, ranks, group.squares
            )
            least = np.minimum.reduceat(added, group.starts)
            above = added - np.repeat(least, group.sizes)
            spread = -2.0 * np.log(np.add.reduceat(np.exp(group.log_weights - 0.5 * above), group.starts))
            seen = np.maximum.reduceat(ranks, group.starts) > 0
            scan.criterion[group.families] = np.where(seen, least + spread + group.prices, np.inf)
            scan.spread[group.families] = spread
            first = np.flatnonzero(above < 10.0**-DIGITS_OF_SCORE)
            owner = np.repeat(np.arange(len(group.sizes)), group.sizes)[first]
            scan.best[group.families[owner[::-1]]] = (first - group.starts[owner])[::-1]
        return scan

    def compute_criterion_of_blocks(
        self, squares: FloatArray | float, explained: FloatArray, ranks: FloatArray, square: FloatArray
    ) -> FloatArray:
        """Return the criterion of blocks against none, their coefficients averaged over."""
        priors, costs = self._list_priors(square)
        left = squares - explained * (priors / (1.0 + priors))
        left = np.maximum(left, ROUNDING * self.squares + self.known)
        gained = self.compute_logarithm(left) - self.compute_logarithm(squares)
        return average_likelihoods(gained + ranks * np.log1p(priors) + costs, 0)

    def weigh_block(self, explained: float, rank: int, square: float) -> float:
        """Return what a block costs that explains so much, in σ², its coefficients averaged over."""
        priors, costs = self._list_priors(square)
        return float(average_likelihoods(explained / (1.0 + priors) + rank * np.log1p(priors) + costs, 0))

    def _list_priors(self, square: FloatArray | float) -> tuple[FloatArray, FloatArray]:
        """Return variances of effects before any reading, over σ², along a first axis, and what each costs.

        `square`: Mean square that is expected of each effect, over σ².
        """
        shape = (-1, *(1 for _ in np.shape(square)))
        worths, weights = (column.reshape(shape) for column in np.array(_WORTHS).T)
        expected = np.ones((len(_WORTHS), *np.shape(square)))
        expected[0] = square
        return float(self.space.degrees) * worths * expected, -2.0 * np.log(weights)
