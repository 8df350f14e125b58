"""The comparison: how much better each effect would explain the readings than the model alone.

Two numbers for each effect. Its likelihood ratio LR, of the best values of its parameters and of the noise,
says whether something is missing once it is held against what chance would give (`null`). Its
evidence, averaged over those values, says which effect it is (`evidence`). Both count the base model as zero,
in units of 2·ln(likelihood).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from typing import TypeAlias

import numpy as np

from zlmreport.model.candidates import Bases, BlockGroup, Entry, bases_of
from zlmreport.model.contrasts import Contrasts, Metric, contrasts_of
from zlmreport.model.design import Design
from zlmreport.model.effect import Effect
from zlmreport.model.nameless import (
    SIZES,
    NamelessShape,
    ShapeGroup,
    ShapeModes,
    modes,
    nameless_shapes,
    side_by_side,
)
from zlmreport.model.noise import NoisePart, NoiseSource, coarse_grid, noise_parts, ratio_grid
from zlmreport.model.priors import Expected
from zlmreport.quantities.arrays import FloatArray

#: Variances of an effect before any reading, in units of what one reading is worth, and their weights; the
#: first is what earlier tests say, where they do.
_WORTHS = ((1.0, 0.9), (1e2, 0.05), (1e4, 0.03), (1e6, 0.02))


#: Is told the share of some work that is done, 0 to 1.
Told: TypeAlias = Callable[[float], object]


def untold(_share: float) -> None:
    """Tell nobody."""


@dataclass(frozen=True, slots=True)
class Scores:
    """How effects and nameless shapes did on B sets of deviations."""

    ratios: FloatArray  #: (effects, B): LR of each effect, in its best form.
    nameless_ratios: FloatArray  #: (nameless, B): LR of each nameless shape, its coefficients averaged over.


@dataclass(frozen=True, slots=True)
class Criteria:
    """−2 ln(likelihood) of one set of deviations under each φ, σ profiled out."""

    null: FloatArray  #: (f,): Of the model alone.
    #: (f, blocks): With each block of columns at its best coefficients; the blocks of a family side by side.
    fits: FloatArray
    averages: FloatArray  #: (f, blocks): With the coefficients averaged over instead.
    nameless: FloatArray  #: (φ and sizes, nameless): Of the nameless shapes, under some φ.


@dataclass(frozen=True, slots=True)
class _Trial:
    """Sets of deviations under one φ: residual squares, and products with all columns and features."""

    index: int
    squares: FloatArray
    products: FloatArray
    nameless_products: FloatArray


@dataclass(frozen=True, slots=True)
class Comparison:
    """Everything about a comparison that does not depend on what was measured."""

    space: Contrasts  #: The contrasts of the base model.
    grid: FloatArray  #: (f, parts): The values of φ that are tried.
    bases: Bases  #: What the effects could add.
    nameless: tuple[NamelessShape, ...]  #: Shapes without a name.
    prior: FloatArray  #: (f,): Probability of each φ before the test.
    _squares: tuple[FloatArray, ...]
    _metrics: tuple[Metric, ...]
    _shared: FloatArray
    _roots: tuple[tuple[FloatArray, ...], ...]
    _nameless_columns: FloatArray
    _nameless_shared: FloatArray
    _nameless_groups: tuple[ShapeGroup, ...]
    _nameless_modes: dict[int, tuple[ShapeModes, ...]]
    _expected: Expected

    @classmethod
    def of(
        cls,
        design: Design,
        base: FloatArray,
        effects: Iterable[Effect],
        weights: FloatArray,
        *,
        least_visible: float = 1e-6,
    ) -> Comparison:
        """Prepare a comparison.

        `base`, (N, q): Columns of the base model, tangents of its searched parameters included.
        `weights`, (N,): w, the variance of each reading over the mean one.
        `least_visible`: Share of an effect's length below which the base model imitates it entirely.
        """
        parts = noise_parts(design)
        space = contrasts_of(base, parts, weights)
        bases = bases_of(design, space, [(effect, effect.grid(design)) for effect in effects], least_visible)
        return cls._prepared(space, ratio_grid(parts), bases, nameless_shapes(design, space))

    @classmethod
    def quick(
        cls,
        design: Design,
        base: FloatArray,
        effects: Iterable[Effect],
        ratios: Mapping[NoiseSource, float] | None = None,
    ) -> Comparison:
        """Prepare a comparison that takes a tenth of the time, as simulations of many plans need it.

        `design`, `base`, `effects`: As for `of`.
        `ratios`: φ by source, where it is taken for known: then there are no nameless shapes. Without it,
            each source has none or a middling share.
        """
        parts = noise_parts(design)
        space = contrasts_of(base, parts, np.ones(len(base)))
        bases = bases_of(design, space, [(effect, effect.grid(design)) for effect in effects], 1e-6)
        if ratios is None:
            return cls._prepared(space, coarse_grid(parts), bases, nameless_shapes(design, space))
        known = np.array([[ratios.get(part.source, 0.0) for part in parts]])
        return cls._prepared(space, known, bases, ())

    @classmethod
    def _prepared(
        cls, space: Contrasts, grid: FloatArray, bases: Bases, nameless: tuple[NamelessShape, ...]
    ) -> Comparison:
        nothing, (columns, groups) = Expected(), side_by_side(nameless, len(space.scale))
        metrics = tuple(space.metric(ratios) for ratios in grid)
        shared, nameless_shared = space.factors.T @ bases.columns, space.factors.T @ columns
        return cls(
            space,
            grid,
            bases,
            nameless,
            nothing.probabilities([part.source for part in space.parts], grid),
            _squares(bases, nothing),
            metrics,
            shared,
            tuple(bases.roots(metric, shared) for metric in metrics),
            columns,
            nameless_shared,
            groups,
            {
                index: tuple(modes(metrics[index], nameless_shared, group) for group in groups)
                for index in _coarse(grid, space.parts)
            },
            nothing,
        )

    def expecting(self, expected: Expected) -> Comparison:
        """Return the same comparison by one who knows what earlier tests say, sizes in units of σ.

        Without them every φ is as likely as any, and an effect as large as the scatter.
        """
        prior = expected.probabilities([part.source for part in self.space.parts], self.grid)
        return replace(self, prior=prior, _squares=_squares(self.bases, expected), _expected=expected)

    def scores(self, deviations: FloatArray, known: float = 0.0, told: Told = untold) -> Scores:
        """Return the likelihood ratios on sets of deviations.

        `deviations`, (N, B): m or rad.
        `known`: Standard deviation of a noise of known size that stands beside σ, m or rad.
        """
        sets = deviations.shape[1]
        null = np.full(sets, np.inf)
        families = np.full((len(self.bases.families), sets), np.inf)
        nameless = np.full((len(self.nameless), sets), np.inf)
        for trial in self._trials(deviations, known):
            np.minimum(null, self._criterion(trial, trial.squares), out=null)
            for group, explained in self._explained(trial):
                most = np.maximum.reduceat(explained, group.starts, axis=0)
                listed = families[group.families]
                np.minimum(listed, self._criterion(trial, trial.squares - most), out=listed)
            for averaged in self._nameless_criteria(trial):
                np.minimum(nameless, averaged, out=nameless)
            told((1 + trial.index) / len(self.grid))
        best = [families[list(forms)].min(axis=0) for forms in self.bases.by_effect]
        return Scores(null - np.array(best).reshape(-1, sets), null - nameless)

    def posterior(self, deviation: FloatArray, known: float = 0.0) -> FloatArray:
        """Return the probability of each φ on one set of deviations, shape (N,), without any effect."""
        trials = self._trials(deviation[:, np.newaxis], known)
        criteria = np.array([self._criterion(trial, trial.squares)[0] for trial in trials])
        likelihoods = np.exp(-0.5 * (criteria - criteria.min()))
        return np.asarray(likelihoods / likelihoods.sum())

    def criteria(self, deviation: FloatArray, known: float = 0.0) -> Criteria:
        """Return the criteria of one set of deviations, shape (N,); `known` as in `scores`."""
        null: list[float] = []
        fits: list[FloatArray] = []
        averages: list[FloatArray] = []
        nameless: list[FloatArray] = []
        for trial in self._trials(deviation[:, np.newaxis], known):
            null.append(self._criterion(trial, trial.squares)[0])
            explained = [each[:, 0] for _, each in self._explained(trial)]
            ranks = [group.ranks for group in self.bases.groups]
            together, rank = np.concatenate([*explained, []]), np.concatenate([*ranks, []])
            square = np.concatenate([*self._squares, []])
            fits.append(self._criterion(trial, trial.squares - together))
            averages.append(self._averaged(trial, together, rank, square))
            nameless.extend(averaged[:, 0] for averaged in self._nameless_criteria(trial))
        return Criteria(
            np.array(null),
            np.array(fits),
            np.array(averages),
            np.array(nameless).reshape(len(nameless), len(self.nameless)),
        )

    def evidence(self, deviations: FloatArray, known: float = 0.0) -> tuple[FloatArray, FloatArray]:
        """Return the evidence of effects and of nameless shapes on many sets of deviations, quickly.

        As `zlmreport.model.evidence` has it of one set, but for the finer grid about the best values.

        Parameters
        ----------
        deviations : (N, B) array
            m or rad.
        known
            As in `scores`.

        Returns
        -------
        (effects, B) and (nameless, B) arrays
            2·ln of Bayes factors against the model alone.
        """
        sets = deviations.shape[1]
        null = np.full(sets, -np.inf)
        families = np.full((len(self.bases.families), sets), -np.inf)
        nameless = np.full((len(self.nameless), sets), -np.inf)
        sizes = max(1, len(self._nameless_modes)) * len(SIZES)
        for trial in self._trials(deviations, known):
            np.logaddexp(null, -0.5 * self._criterion(trial, trial.squares), out=null)
            for (group, explained), square in zip(self._explained(trial), self._squares, strict=True):
                rank = group.ranks[:, np.newaxis]
                averaged = -0.5 * self._averaged(trial, explained, rank, square[:, np.newaxis])
                most = averaged.max(axis=0)
                counts = np.diff([*group.starts, len(group.ranks)])[:, np.newaxis]
                likelihoods = np.add.reduceat(np.exp(averaged - most), group.starts, axis=0) / counts
                listed = families[group.families]
                with np.errstate(divide="ignore"):  # far behind the best
                    np.logaddexp(listed, most + np.log(likelihoods), out=listed)
            for averaged in self._nameless_criteria(trial):
                np.logaddexp(nameless, -0.5 * averaged, out=nameless)
        null -= np.log(len(self.grid))
        families -= np.log(len(self.grid))
        best = [
            np.logaddexp.reduce(families[list(forms)], axis=0) - np.log(len(forms))
            for forms in self.bases.by_effect
        ]
        return 2.0 * (np.array(best).reshape(-1, sets) - null), 2.0 * (nameless - np.log(sizes) - null)

    def of_others(self, design: Design, entries: Iterable[Entry], least_visible: float) -> Comparison:
        """Return the comparison of other entries beside the same model, without nameless shapes."""
        bases = bases_of(design, self.space, entries, least_visible)
        shared = self.space.factors.T @ bases.columns
        roots = tuple(bases.roots(metric, shared) for metric in self._metrics)
        squares = _squares(bases, self._expected)
        return replace(self, bases=bases, nameless=(), _shared=shared, _roots=roots, _squares=squares)

    def _trials(self, deviations: FloatArray, known: float) -> Iterator[_Trial]:
        contrasts = self.space.of(deviations)
        squares = np.sum(contrasts**2, axis=0) + self.space.degrees * known**2
        by_factor = self.space.factors.T @ contrasts
        by_column = self.bases.columns.T @ contrasts
        by_nameless = self._nameless_columns.T @ contrasts
        for index, metric in enumerate(self._metrics):
            coordinates = metric.coordinates(by_factor)
            back = metric.root.T @ coordinates
            active = metric.active
            yield _Trial(
                index,
                squares - np.sum(coordinates**2, axis=0),
                by_column - self._shared[active].T @ back,
                by_nameless - self._nameless_shared[active].T @ back
                if index in self._nameless_modes
                else by_nameless,
            )

    def _criterion(self, trial: _Trial, squares: FloatArray) -> FloatArray:
        """Return −2 ln(likelihood × probability of φ) of residual squares, σ profiled out."""
        prior = 2.0 * float(np.log(self.prior[trial.index]))
        return self.space.criterion(self._metrics[trial.index], squares) - prior

    def _averaged(
        self, trial: _Trial, explained: FloatArray, rank: FloatArray, square: FloatArray
    ) -> FloatArray:
        """Return the criterion of every block, its coefficients averaged over, shaped as what they explain.

        Before any reading, the variance of an effect is what is expected, or rarely more: with that alone no
        evidence could grow beyond the number of readings, however small the scatter.
        """
        found = []
        for factor, weight in _WORTHS:
            prior = factor * float(self.space.degrees) * (square if factor == 1.0 else 1.0)
            left = trial.squares - explained * prior / (1.0 + prior)
            found.append(self._criterion(trial, left) + rank * np.log1p(prior) - 2.0 * np.log(weight))
        least = np.min(found, axis=0)
        likelihoods = np.exp(-0.5 * (np.array(found) - least)).sum(axis=0)
        return np.asarray(least - 2.0 * np.log(likelihoods), dtype=np.float64)

    def _explained(self, trial: _Trial) -> Iterator[tuple[BlockGroup, FloatArray]]:
        """Yield for each group what its blocks explain of the squares, shape (blocks, B)."""
        for group, roots in zip(self.bases.groups, self._roots[trial.index], strict=True):
            products = trial.products[group.columns]
            if group.width == 1:
                yield group, (roots[:, 0] * products) ** 2
            else:
                blocks = products.reshape(group.blocks, group.width, -1)
                yield group, np.sum((roots @ blocks) ** 2, axis=1)

    def _nameless_criteria(self, trial: _Trial) -> Iterator[FloatArray]:
        """Yield for each size that is tried the criterion of every nameless shape, (shapes, B)."""
        found = self._nameless_modes.get(trial.index)
        if found is None or not self.nameless:
            return
        groups, tried = self._nameless_groups, list(self._nameless_modes)
        # They stand under some φ only: what these are worth together is that of all.
        worth = 2.0 * float(np.log(len(tried) / len(self.grid) / self.prior[tried].sum()))
        squared = [
            (own.turn @ trial.nameless_products[group.places]) ** 2
            for group, own in zip(groups, found, strict=True)
        ]
        for size in SIZES:
            criteria = np.empty((len(self.nameless), len(trial.squares)))
            for group, own, products in zip(groups, found, squared, strict=True):
                spread = 1.0 + size * own.strengths
                explained = ((size / spread)[:, np.newaxis, :] @ products)[:, 0]
                averaged = np.log(spread).sum(axis=1)[:, np.newaxis] - worth
                criteria[group.shapes] = self._criterion(trial, trial.squares - explained) + averaged
            yield criteria


def _squares(bases: Bases, expected: Expected) -> tuple[FloatArray, ...]:
    """Return for each group the mean square that is expected of its blocks over σ², shape (blocks,)."""
    found = [np.full(len(each.thetas), expected.square(each.effect.identifier)) for each in bases.families]
    return tuple(np.concatenate(found[group.families]) for group in bases.groups)


def _coarse(grid: FloatArray, parts: tuple[NoisePart, ...]) -> list[int]:
    """Return the rows of the grid for nameless shapes: all geometry, but little of the rest."""
    kept = np.ones(len(grid), dtype=np.bool_)
    for column, part in zip(grid.T, parts, strict=True):
        if part.source is not NoiseSource.POSITION:
            kept &= (column == 0) | (column == part.ratios[len(part.ratios) // 2])
    return np.flatnonzero(kept).tolist()
