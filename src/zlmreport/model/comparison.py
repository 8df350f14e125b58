"""The comparison: how much better each effect would explain the readings than the model alone.

Two numbers for each effect. Its likelihood ratio LR, of the best values of its parameters and of the noise,
says whether something is missing once it is held against what chance would give (`null`). Its
evidence, averaged over those values, says which effect it is (`evidence`). Both count the base model as zero,
in units of 2·ln(likelihood).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace

import numpy as np

from zlmreport.model.candidates import Bases, BlockGroup, Entry, bases_of
from zlmreport.model.contrasts import Contrasts, Metric, contrasts_of
from zlmreport.model.design import Design
from zlmreport.model.effect import Effect
from zlmreport.model.nameless import SIZES, NamelessShape, ShapeModes, modes, nameless_shapes, side_by_side
from zlmreport.model.noise import NoisePart, NoiseSource, noise_parts, ratio_grid
from zlmreport.quantities.arrays import FloatArray, IntArray


@dataclass(frozen=True, slots=True)
class Scores:
    """How effects and nameless shapes did on B sets of deviations.

    Attributes
    ----------
    ratios : (effects, B) array
        LR of each effect, in its best form.
    nameless_ratios : (nameless, B) array
        LR of each nameless shape, its coefficients averaged over.
    """

    ratios: FloatArray
    nameless_ratios: FloatArray


@dataclass(frozen=True, slots=True)
class Criteria:
    """−2 ln(likelihood) of one set of deviations under each φ, σ profiled out.

    Attributes
    ----------
    null : (f,) array
        Of the model alone.
    fits : (f, blocks) array
        With each block of columns at its best coefficients; the blocks of a family side by side.
    averages : (f, blocks) array
        With the coefficients averaged over instead.
    nameless : (φ and sizes, nameless) array
        Of the nameless shapes, under some φ.
    """

    null: FloatArray
    fits: FloatArray
    averages: FloatArray
    nameless: FloatArray


@dataclass(frozen=True, slots=True)
class _Trial:
    """Sets of deviations under one φ: residual squares, and products with all columns and features."""

    index: int
    squares: FloatArray
    products: FloatArray
    nameless_products: FloatArray


@dataclass(frozen=True, slots=True)
class Comparison:
    """Everything about a comparison that does not depend on what was measured.

    Attributes
    ----------
    space
        The contrasts of the base model.
    grid : (f, parts) array
        The values of φ that are tried.
    bases
        What the effects could add.
    nameless
        Shapes without a name.
    """

    space: Contrasts
    grid: FloatArray
    bases: Bases
    nameless: tuple[NamelessShape, ...]
    _metrics: tuple[Metric, ...]
    _shared: FloatArray
    _roots: tuple[tuple[FloatArray, ...], ...]
    _nameless_columns: FloatArray
    _nameless_shared: FloatArray
    _nameless_places: IntArray
    _nameless_modes: dict[int, ShapeModes]

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

        Parameters
        ----------
        design
            The test.
        base : (N, q) array
            Columns of the base model, tangents of its searched parameters included.
        effects
            That can be tested on the design.
        weights : (N,) array
            w, the variance of each reading over the mean one.
        least_visible
            Share of an effect's length below which the base model imitates it entirely.
        """
        parts = noise_parts(design)
        space = contrasts_of(base, parts, weights)
        grid = ratio_grid(parts)
        bases = bases_of(design, space, [(effect, effect.grid(design)) for effect in effects], least_visible)
        nameless = nameless_shapes(design, space)
        columns, places = side_by_side(nameless, len(base))
        metrics = tuple(space.metric(ratios) for ratios in grid)
        shared, nameless_shared = space.factors.T @ bases.columns, space.factors.T @ columns
        gram = np.stack([columns[:, row].T @ columns[:, row] for row in places])
        return cls(
            space,
            grid,
            bases,
            nameless,
            metrics,
            shared,
            tuple(bases.roots(metric, shared) for metric in metrics),
            columns,
            nameless_shared,
            places,
            {index: modes(metrics[index], nameless_shared, gram, places) for index in _coarse(grid, parts)},
        )

    def scores(self, deviations: FloatArray) -> Scores:
        """Return the likelihood ratios on sets of deviations, shape (N, B)."""
        sets = deviations.shape[1]
        null = np.full(sets, np.inf)
        families = np.full((len(self.bases.families), sets), np.inf)
        nameless = np.full((len(self.nameless), sets), np.inf)
        for trial in self._trials(deviations):
            np.minimum(null, self._criterion(trial, trial.squares), out=null)
            for group, explained in self._explained(trial):
                most = np.maximum.reduceat(explained, group.starts, axis=0)
                listed = families[group.families]
                np.minimum(listed, self._criterion(trial, trial.squares - most), out=listed)
            for averaged in self._nameless_criteria(trial):
                np.minimum(nameless, averaged, out=nameless)
        best = [families[list(forms)].min(axis=0) for forms in self.bases.by_effect]
        return Scores(null - np.array(best).reshape(-1, sets), null - nameless)

    def criteria(self, deviation: FloatArray) -> Criteria:
        """Return the criteria of one set of deviations, shape (N,)."""
        null: list[float] = []
        fits: list[FloatArray] = []
        averages: list[FloatArray] = []
        nameless: list[FloatArray] = []
        # Variance of an effect before any reading, over that which all leave: one reading's worth.
        prior = float(self.space.degrees)
        for trial in self._trials(deviation[:, np.newaxis]):
            null.append(self._criterion(trial, trial.squares)[0])
            explained = [each[:, 0] for _, each in self._explained(trial)]
            ranks = [group.ranks for group in self.bases.groups]
            together, rank = np.concatenate([*explained, []]), np.concatenate([*ranks, []])
            fits.append(self._criterion(trial, trial.squares - together))
            shrunk = together * prior / (1.0 + prior)
            averages.append(self._criterion(trial, trial.squares - shrunk) + rank * np.log1p(prior))
            nameless.extend(averaged[:, 0] for averaged in self._nameless_criteria(trial))
        return Criteria(
            np.array(null),
            np.array(fits),
            np.array(averages),
            np.array(nameless).reshape(len(nameless), len(self.nameless)),
        )

    def of_others(self, design: Design, entries: Iterable[Entry], least_visible: float) -> Comparison:
        """Return the comparison of other entries beside the same model, without nameless shapes."""
        bases = bases_of(design, self.space, entries, least_visible)
        shared = self.space.factors.T @ bases.columns
        roots = tuple(bases.roots(metric, shared) for metric in self._metrics)
        return replace(self, bases=bases, nameless=(), _shared=shared, _roots=roots)

    def _trials(self, deviations: FloatArray) -> Iterator[_Trial]:
        contrasts = self.space.of(deviations)
        squares = np.sum(contrasts**2, axis=0)
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
        """Return −2 ln(likelihood) of residual squares, σ profiled out."""
        return self.space.criterion(self._metrics[trial.index], squares)

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
        squared = (found.turn @ trial.nameless_products[self._nameless_places]) ** 2
        for size in SIZES:
            spread = 1.0 + size * found.strengths
            explained = ((size / spread)[:, np.newaxis, :] @ squared)[:, 0]
            averaged = np.log(spread).sum(axis=1)[:, np.newaxis]
            yield self._criterion(trial, trial.squares - explained) + averaged


def _coarse(grid: FloatArray, parts: tuple[NoisePart, ...]) -> list[int]:
    """Return the rows of the grid for nameless shapes: all geometry, but little of the rest."""
    kept = np.ones(len(grid), dtype=np.bool_)
    for column, part in zip(grid.T, parts, strict=True):
        if part.source is not NoiseSource.POSITION:
            kept &= (column == 0) | (column == part.ratios[len(part.ratios) // 2])
    return np.flatnonzero(kept).tolist()
