"""Error contrasts: the readings with a model's columns projected out; whitening; restricted estimates.

Restricted likelihood and comparison see nothing else, so the base model is removed once and for all. In this
space V(φ) is the unit matrix plus parts of low rank, and every product with its inverse is one with r × r
matrices (Woodbury), r the number of targets, runs and drift terms; the number of readings does not matter.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import product

import numpy as np

from zlmreport.measurement.arrays import FloatArray, IntArray, make_orthonormal_basis
from zlmreport.model.effects.design import Design
from zlmreport.model.fitting.by_target import FactorsByTarget, ProductsByTarget, RootByTarget
from zlmreport.model.fitting.noise import BY_TARGET, Noise, NoisePart

#: Columns that add less than this share of their length to those before them add nothing.
_DEPENDENT = 1e-11
_REFINEMENTS = (4.0, 2.0, 1.4, 1.15)
#: Likelihood that a further step must gain.
_WORTHWHILE = 1e-3
_SMALLEST_RATIO = 1e-3
#: Sum of squares of a residual that is no residual at all, m² or rad².
_NOTHING = 1e-60
#: Correlation of a reading with the one before it at most: two at the same moment are still two.
_MOST_KEPT = 0.999
#: Share of the readings' squares below which what a covariance leaves of them is rounding.
_ROUNDING = 1e-13


@dataclass(frozen=True, slots=True)
class Metric:
    """The inner product of error contrasts under one covariance: aᵀ·V⁻¹·b = aᵀb − (R·Zᵀa)ᵀ(R·Zᵀb)."""

    active: IntArray  #: (a,) integer: Columns of the factors that have a share in the covariance.
    root: FloatArray  #: (a, a): R, of these alone.
    log_determinant: float  #: ln|V| within the space of contrasts.

    def compute_coordinates(self, products: FloatArray) -> FloatArray:
        """Return R·Zᵀa from Zᵀa, shape (r, …)."""
        return np.asarray(self.root @ products[self.active])


@dataclass(frozen=True, slots=True)
class SingleReadings:
    """How readings scatter singly: unequally, and each for a short time like the one before it.

    W with W·V·Wᵀ the unit matrix, V = D·R·D, R_ab = exp(−|t_a − t_b|/τ): a reading depends on that before it
    alone (J. L. Doob, Annals of Mathematics 43 (1942) 351).
    """

    scale: FloatArray  #: (N,): 1/√w.
    #: (N − 1,): The correlation of each reading with the one before it; None where there is none.
    kept: FloatArray | None = None

    @property
    def log_determinant(self) -> float:
        """ln|R|."""
        return 0.0 if self.kept is None else float(np.log1p(-(self.kept**2)).sum())

    def whiten(self, columns: FloatArray) -> FloatArray:
        """Return W times columns over the readings, shape (N, …)."""
        scaled = (columns.T * self.scale).T
        if self.kept is None:
            return scaled
        found = scaled.copy()
        found[1:] = ((scaled[1:].T - scaled[:-1].T * self.kept) / np.sqrt(1.0 - self.kept**2)).T
        return found

    def apply_transposed(self, columns: FloatArray) -> FloatArray:
        """Return Wᵀ times columns, shape (N, …)."""
        found = columns.copy()
        if self.kept is not None:
            found[1:] = (found[1:].T / np.sqrt(1.0 - self.kept**2)).T
            found[:-1] -= (found[1:].T * self.kept).T
        return (found.T * self.scale).T

    def undo_whitening(self, columns: FloatArray) -> FloatArray:
        """Return W⁻¹ times columns: what was made independent as it was read."""
        found = columns.copy()
        for later, share in enumerate([] if self.kept is None else self.kept.tolist(), 1):
            found[later] = found[later] * np.sqrt(1.0 - share**2) + share * found[later - 1]
        return np.asarray((found.T / self.scale).T)


def describe_single_readings(design: Design, weights: FloatArray, memory: float) -> SingleReadings:
    """Return how readings scatter singly.

    `weights`, (N,): w, the variance of each reading over the mean one.
    `memory`: τ, the time over which a reading is forgotten, in the unit of the design's time; 0 for none.
    """
    scale = 1.0 / np.sqrt(weights)
    if not memory:
        return SingleReadings(scale)
    steps = np.maximum(np.diff(design.time), 0.0)
    kept = np.where(np.diff(design.session) == 0, np.exp(-steps / memory), 0.0)
    return SingleReadings(scale, np.minimum(kept, _MOST_KEPT))


@dataclass(frozen=True)
class Contrasts:
    """The space of error contrasts of a base model."""

    base: FloatArray  #: (N, q): Orthonormal columns that span the model, single readings made independent.
    single: SingleReadings  #: How these scatter by themselves.
    parts: tuple[NoisePart, ...]  #: The sources of shared scatter.

    @cached_property
    def gram(self) -> FloatArray:
        """Products of their factors Z side by side, as contrasts, shape (r, r)."""
        factors = np.concatenate([self.base[:, :0], *(part.factor for part in self.parts)], axis=1)
        contrasts = self.of(factors)
        return np.asarray(contrasts.T @ contrasts)

    @property
    def scale(self) -> FloatArray:
        """1/√w, shape (N,)."""
        return self.single.scale

    @property
    def degrees(self) -> int:
        """The dimension of the space: readings less columns."""
        return int(self.base.shape[0] - self.base.shape[1])

    def of(self, columns: FloatArray) -> FloatArray:
        """Return the contrasts of columns over the readings, shape (N, …)."""
        flat = self.single.whiten(columns.reshape(len(columns), -1))
        flat = flat - self.base @ (self.base.T @ flat)
        return flat.reshape(columns.shape)

    def make_criterion(self, contrast: FloatArray) -> Callable[[FloatArray], tuple[float, float]]:
        """Return what gives −2 ln(restricted likelihood) and the residual sum of squares for one φ, (parts,).

        σ is profiled out.

        `contrast`, (N,): Of the deviations.
        """
        total = float(contrast @ contrast)
        # Readings of other targets share nothing of such a part, made independent singly.
        is_single = self.single.kept is None
        is_by_target = np.array([is_single and each.source in BY_TARGET for each in self.parts], np.bool_)
        own = [self.single.whiten(part.factor) for part in self.parts]
        widths = [each.shape[1] for each, apart in zip(own, is_by_target, strict=True) if not apart]
        beside = [each for each, apart in zip(own, is_by_target, strict=True) if not apart]
        readings = contrast[:, np.newaxis] / np.sqrt(max(total, _NOTHING))
        factors = FactorsByTarget(
            [each for each, apart in zip(own, is_by_target, strict=True) if apart], len(contrast)
        )
        products = ProductsByTarget(factors, np.concatenate([*beside, self.base, readings], axis=1))
        shared = sum(widths)

        def criterion(ratios: FloatArray) -> tuple[float, float]:
            bordered, logarithm = products.compute_under(ratios[is_by_target])
            roots = np.ones(len(bordered))
            roots[:shared] = np.sqrt(np.repeat(ratios[~is_by_target], widths))
            bordered = roots[:, np.newaxis] * bordered * roots
            bordered[np.diag_indices(shared)] += 1.0
            bordered[-1, -1] += _ROUNDING
            # The last pivot of the root is what all else leaves of the readings.
            pivots = np.diagonal(np.linalg.cholesky(bordered))
            squares = total * float(pivots[-1]) ** 2
            logarithm += self.degrees * np.log(max(squares, _NOTHING)) + 2.0 * np.log(pivots[:-1]).sum()
            return float(logarithm), squares

        return criterion

    def make_metric(self, ratios: FloatArray) -> Metric:
        """Return the inner product for one φ, shape (parts,)."""
        spread = np.repeat(ratios, [part.factor.shape[1] for part in self.parts])
        active = np.flatnonzero(spread)
        roots = np.sqrt(spread[active])
        gram = roots[:, np.newaxis] * self.gram[np.ix_(active, active)] * roots
        factor = np.linalg.cholesky(np.eye(len(active)) + gram)
        logarithms = np.log(np.diagonal(factor))
        return Metric(active, np.linalg.inv(factor) * roots, 2.0 * float(logarithms.sum()))


def make_contrasts_of(
    base: FloatArray, parts: Sequence[NoisePart], weights: FloatArray | SingleReadings
) -> Contrasts:
    """Return the space of error contrasts.

    `base`, (N, q): Columns of the model; those that depend on others count once.
    `weights`: w, the variance of each reading over the mean one, shape (N,); or how readings scatter singly.
    """
    single = weights if isinstance(weights, SingleReadings) else SingleReadings(1.0 / np.sqrt(weights))
    return Contrasts(make_orthonormal_basis(single.whiten(base), _DEPENDENT), single, tuple(parts))


def estimate_restricted(
    space: Contrasts, contrasts: FloatArray, grid: FloatArray, largest: FloatArray
) -> tuple[FloatArray, float]:
    """Return φ̂ and σ̂² by restricted maximum likelihood.

    `contrasts`, (N,): Of the deviations.
    `grid`, (f, parts): Ratios that the search begins with.
    `largest`, (parts,): Ratios that it does not exceed.
    """
    criterion = space.make_criterion(contrasts)
    tried = [criterion(ratios)[0] for ratios in grid]
    best, ratios = min(tried), grid[int(np.argmin(tried))].copy()
    for step in _REFINEMENTS:
        improved = True
        while improved:
            improved = False
            for part, factor in product(range(len(ratios)), (step, 1 / step)):
                changed = ratios.copy()
                changed[part] = min(max(ratios[part], _SMALLEST_RATIO) * factor, largest[part])
                value = criterion(changed)[0]
                if value < best - _WORTHWHILE:
                    best, ratios, improved = value, changed, True
    return ratios, criterion(ratios)[1] / space.degrees


@dataclass(frozen=True, slots=True)
class Whitener:
    """The symmetric root of V⁻¹, with V = diag(w) + Z·diag(φ)·Zᵀ."""

    scale: FloatArray  #: (N,): 1/√w.
    modes: FloatArray  #: (N, r): Orthonormal directions in which readings scatter together.
    excess: FloatArray  #: (r,): 1 − 1/√(1 + λ), λ the variance of each mode over that of single readings.

    def __call__(self, columns: FloatArray) -> FloatArray:
        """Return W times columns over the readings, shape (N,) or (N, k)."""
        scaled = (columns.T * self.scale).T
        return scaled - self.modes @ ((self.modes.T @ scaled).T * self.excess).T


def make_whitener(parts: Sequence[NoisePart], noise: Noise) -> Whitener:
    """Return the whitener of a noise."""
    scale = 1.0 / np.sqrt(noise.weights)
    active = [
        part.factor * np.sqrt(noise.ratios[part.source])
        for part in parts
        if noise.ratios.get(part.source, 0.0) > 0
    ]
    factors = np.concatenate([np.empty((len(scale), 0)), *active], axis=1) * scale[:, np.newaxis]
    modes, singular, _ = np.linalg.svd(factors, full_matrices=False)
    return Whitener(scale, modes, 1.0 - 1.0 / np.sqrt(1.0 + singular**2))


@dataclass(frozen=True, slots=True)
class Root:
    """A root W of V⁻¹, WᵀW = V⁻¹, that a hundred targets make hardly dearer than ten."""

    scale: FloatArray  #: (N,): 1/√w.
    by_target: RootByTarget  #: The root of what readings of other targets do not share.
    modes: FloatArray  #: (N, r): Orthonormal directions in which readings scatter together beside that.
    excess: FloatArray  #: (r,): 1 − 1/√(1 + λ), λ the variance of each mode over that of single readings.

    def __call__(self, columns: FloatArray) -> FloatArray:
        """Return W times columns over the readings, shape (N, k)."""
        return self._keep_modes(self.by_target(self.scale[:, np.newaxis] * columns))

    def apply_transposed(self, columns: FloatArray) -> FloatArray:
        """Return Wᵀ times columns, shape (N, k)."""
        return self.scale[:, np.newaxis] * self.by_target(self._keep_modes(columns))

    def _keep_modes(self, columns: FloatArray) -> FloatArray:
        return columns - self.modes @ (self.excess[:, np.newaxis] * (self.modes.T @ columns))


def make_root(parts: Sequence[NoisePart], noise: Noise) -> Root:
    """Return what makes readings independent under a noise; single ones where no part has a share."""
    scale = 1.0 / np.sqrt(noise.weights)
    active = [part for part in parts if noise.ratios.get(part.source, 0.0) > 0]
    apart = [part for part in active if part.source in BY_TARGET]
    factors = FactorsByTarget([scale[:, np.newaxis] * part.factor for part in apart], len(scale))
    by_target = RootByTarget(factors, np.array([noise.ratios[part.source] for part in apart]))
    shared = [
        part.factor * np.sqrt(noise.ratios[part.source]) for part in active if part.source not in BY_TARGET
    ]
    together = by_target(scale[:, np.newaxis] * np.concatenate([np.empty((len(scale), 0)), *shared], axis=1))
    modes, singular, _ = np.linalg.svd(together, full_matrices=False)
    return Root(scale, by_target, modes, 1.0 - 1.0 / np.sqrt(1.0 + singular**2))
