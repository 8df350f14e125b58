"""The restricted likelihood of the readings, for sets of columns beside amplitudes of what has no name.

    x = X·β + C·γ + Σ_j √φ_j·Z_j·u_j + ε,   u_j and ε/σ standard normal

X is the job's model, C the columns of a set, Z_j the parts of the covariance: noise, and random curves
without a name. β and γ have flat priors here and drop out with the space of contrasts; σ is profiled out.
Everything is in units of −2·ln.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import TypeAlias

import numpy as np

from zlmreport.measurement.arrays import FloatArray, IntArray
from zlmreport.model.diagnosis.blocks import IMITATED, find_root_of, solve_blocks, take_from
from zlmreport.model.diagnosis.columns import Columns, HeldContrasts
from zlmreport.model.diagnosis.nameless import CovariancePart
from zlmreport.model.fitting.contrasts import Contrasts
from zlmreport.model.fitting.noise import NoiseSource

#: Sum of squares of a residual that is no residual at all; share of the readings' that is rounding.
NOTHING, ROUNDING = 1e-60, 1e-13
#: Digits behind the point up to which scores are no rounding. On few targets many sets describe the same:
#: which of them leads must not depend on the processor.
DIGITS_OF_SCORE = 6

#: For each part the number of its level.
Amplitudes: TypeAlias = tuple[int, ...]
#: Amplitudes, and the places of the columns of each member of a set, in their order.
Place: TypeAlias = tuple[Amplitudes, tuple[bytes, ...]]


@dataclass(frozen=True, slots=True)
class Reduced:
    """A set of columns under given amplitudes, ready for products with any others."""

    ratios: tuple[float, ...]  #: Of the irregular shares.
    places: IntArray  #: Of the columns of the parts, then of the set.
    root: FloatArray  #: R, of the parts: a·b − (R·Zᵀa)·(R·Zᵀb) is the product under V.
    crossed: FloatArray  #: R·ZᵀC.
    set_root: FloatArray  #: (r, p): S with S·(CᵀV⁻¹C)·Sᵀ the unit matrix.
    log_determinant: float  #: ln|V|.
    taken: FloatArray  #: The deviations in the coordinates of V and the set.
    squares: float  #: Their residual sum of squares.

    def compute_coordinates(self, products: FloatArray) -> FloatArray:
        """Return what V and the set take away of columns, from their products with `places`."""
        inner = self.root @ products[: len(self.root)]
        outer = self.set_root @ (products[len(self.root) :] - self.crossed.T @ inner)
        return np.concatenate([inner, outer])


@dataclass(frozen=True, slots=True)
class _Active:
    """The parts of the covariance under given amplitudes."""

    ratios: tuple[float, ...]  #: The irregular shares.
    places: IntArray  #: (r,) integer: The columns of the other parts.
    roots: FloatArray  #: (r,): The root of the variance of each.
    costs: float  #: −2·ln of the prior odds of the amplitudes.


@dataclass(frozen=True, kw_only=True)
class Likelihood:
    """What is asked about readings again and again, under any amplitudes and beside any set of columns."""

    columns: Columns
    parts: tuple[CovariancePart, ...]
    response: IntArray  #: The place of the deviations among the columns.
    squares: float  #: Their sum of squares, by which they were divided.
    known: float  #: Sum of squares of a noise of known size that stands beside σ.
    _known: dict[Amplitudes, _Active] = field(default_factory=dict, repr=False)
    # A search comes by the same set again and again, from other sets.
    _reduced: dict[Place, Reduced] = field(default_factory=dict, repr=False)
    _criteria: dict[Place, float] = field(default_factory=dict, repr=False)
    _levels: dict[tuple[Place, tuple[int, ...]], list[FloatArray]] = field(default_factory=dict, repr=False)

    @property
    def space(self) -> Contrasts:
        """The contrasts of the job's model."""
        return self.columns.space

    @cached_property
    def quiet(self) -> Amplitudes:
        """Every part at nothing."""
        return tuple(0 for _ in self.parts)

    def find_nearest_amplitudes(self, ratios: Mapping[NoiseSource, float]) -> Amplitudes:
        """Return the amplitudes that are nearest to φ of the sources of noise, all else at nothing."""
        return tuple(
            int(np.argmin(np.abs(np.array(part.levels) - ratios.get(part.source, 0.0)))) if part.source else 0
            for part in self.parts
        )

    def list_middling_amplitudes(self) -> Iterator[Amplitudes]:
        """Yield amplitudes that noise may have: nothing, of each source a middling one, of all together."""
        middle = [part.noise_levels // 2 if part.source else 0 for part in self.parts]
        yield self.quiet
        for number, level in enumerate(middle):
            if level:
                yield (*self.quiet[:number], level, *self.quiet[number + 1 :])
        yield tuple(middle)

    def list_noise_ratios(self, amplitudes: Amplitudes) -> dict[NoiseSource, float]:
        """Return φ of the sources of noise."""
        pairs = zip(self.parts, amplitudes, strict=True)
        return {part.source: part.levels[level] for part, level in pairs if part.source}

    def list_factors(self, amplitudes: Amplitudes) -> Iterator[FloatArray]:
        """Yield the factors of the parts under amplitudes, for readings as they stand, (N, k) each."""
        noise = {part.source: part.factor for part in self.space.parts}
        for part, level in zip(self.parts, amplitudes, strict=True):
            if level:
                own = noise.get(part.source) if part.source else None
                contrasts = self.space.single.undo_whitening(self.columns.select_columns(part.columns))
                yield np.sqrt(part.levels[level]) * (contrasts if own is None else own)

    def as_noise(self, amplitudes: Amplitudes) -> Amplitudes:
        """Return amplitudes held to what noise may be."""
        return tuple(
            min(level, part.noise_levels - 1) for level, part in zip(amplitudes, self.parts, strict=True)
        )

    def _find_active(self, amplitudes: Amplitudes) -> _Active:
        """Return the parts under amplitudes; the same ones are asked about with many a set."""
        if amplitudes in self._known:
            return self._known[amplitudes]
        ratios = [0.0] * sum(part.irregular is not None for part in self.parts)
        places, roots, costs = [self.response[:0]], [np.empty(0)], 0.0
        for part, level in zip(self.parts, amplitudes, strict=True):
            costs += part.costs[level]
            if part.irregular is not None:
                ratios[part.irregular] = part.levels[level]
            elif level:
                places.append(part.columns)
                roots.append(np.full(part.width, np.sqrt(part.levels[level])))
        found = _Active(tuple(ratios), np.concatenate(places), np.concatenate(roots), costs)
        self._known[amplitudes] = found
        return found

    def reduce_set(self, amplitudes: Amplitudes, members: Sequence[IntArray]) -> Reduced:
        """Return a set of columns under amplitudes."""
        place = place_of(amplitudes, members)
        if place not in self._reduced:
            self._reduced[place] = self._reduce_set(amplitudes, members)
        return self._reduced[place]

    def _reduce_set(self, amplitudes: Amplitudes, members: Sequence[IntArray]) -> Reduced:
        active, own = self._find_active(amplitudes), np.concatenate([self.response[:0], *members])
        count, root = len(active.places), active.roots
        products = self.columns.multiply_among(active.ratios, active.places, own, self.response)
        inner = root[:, np.newaxis] * products[:count, :count] * root
        factor = np.linalg.cholesky(np.eye(count) + inner)
        own_root = np.linalg.inv(factor) * root
        crossed = own_root @ products[:count, count:]
        left = products[count:, count:] - crossed.T @ crossed
        set_root = find_root_of(left[:-1, :-1])
        taken = set_root @ left[:-1, -1]
        return Reduced(
            active.ratios,
            np.concatenate([active.places, own]),
            own_root,
            crossed[:, :-1],
            set_root,
            self.columns.log_determinant(active.ratios) + 2.0 * float(np.log(np.diagonal(factor)).sum()),
            np.concatenate([crossed[:, -1], taken]),
            max(float(left[-1, -1] - taken @ taken), ROUNDING) * self.squares + self.known,
        )

    def compute_criterion(self, amplitudes: Amplitudes, members: Sequence[IntArray]) -> float:
        """Return −2·ln of the restricted likelihood times the prior odds of the amplitudes."""
        place = place_of(amplitudes, members)
        if place not in self._criteria:
            self._criteria[place] = self._compute_criterion(amplitudes, members)
        return self._criteria[place]

    def _compute_criterion(self, amplitudes: Amplitudes, members: Sequence[IntArray]) -> float:
        active, own = self._find_active(amplitudes), np.concatenate([self.response[:0], *members])
        count, key = len(active.places), active.ratios
        # The pivots of one factor tell all: those of the parts ln|V|, the last what is left of the readings.
        bordered = self.columns.multiply_among(key, active.places, own, self.response)
        bordered[:count] *= active.roots[:, np.newaxis]
        bordered[:, :count] *= active.roots
        diagonal = np.arange(len(bordered))
        bordered[diagonal[:count], diagonal[:count]] += 1.0
        bordered[-1, -1] += ROUNDING
        try:
            pivots = np.linalg.cholesky(bordered)[diagonal, diagonal]
            is_clear = bool((pivots[count:-1] ** 2 > IMITATED).all())
        except np.linalg.LinAlgError:
            is_clear = False
        if is_clear:
            squares = float(pivots[-1]) ** 2 * self.squares + self.known
            determinant = self.columns.log_determinant(key) + 2.0 * float(np.log(pivots[:count]).sum())
        else:  # columns of the set depend on each other
            reduced = self.reduce_set(amplitudes, members)
            squares, determinant = reduced.squares, reduced.log_determinant
        return float(
            self.compute_logarithm(squares) + determinant + self.space.single.log_determinant + active.costs
        )

    def by_level(
        self, amplitudes: Amplitudes, members: Sequence[IntArray], numbers: Sequence[int]
    ) -> list[FloatArray]:
        """Return `criterion` at every level of some parts, each by itself at each, all else as it is.

        `numbers`: Of parts that are at nothing, or of a single one; not of irregular ones.
        """
        base = tuple(0 if number in numbers else level for number, level in enumerate(amplitudes))
        key = place_of(base, members), tuple(numbers)
        if key not in self._levels:
            self._levels[key] = self._compute_by_level(base, members, numbers)
        return self._levels[key]

    def _compute_by_level(
        self, base: Amplitudes, members: Sequence[IntArray], numbers: Sequence[int]
    ) -> list[FloatArray]:
        """Return the same, all these parts being at nothing in `base`."""
        reduced = self.reduce_set(base, members)
        alike: dict[tuple[int, int], list[int]] = {}
        for number in numbers:
            alike.setdefault((self.parts[number].width, len(self.parts[number].levels)), []).append(number)
        beside = reduced.log_determinant + self.space.single.log_determinant + self._find_active(base).costs
        found: dict[int, FloatArray] = {}
        for group in alike.values():
            flat = np.concatenate([self.parts[number].columns for number in group])
            response = self.columns.multiply(reduced.ratios, flat, self.response)
            away, spread = self.take_parts(reduced, group, response, reduced.taken[:, np.newaxis])
            left = np.maximum(
                reduced.squares - away[:, :, 0] * self.squares, ROUNDING * self.squares + self.known
            )
            costs = np.array([self.parts[number].costs for number in group])
            criteria = self.compute_logarithm(left) + spread + beside + costs - costs[:, :1]
            found.update(zip(group, criteria, strict=True))
        return [found[number] for number in numbers]

    def take_parts(
        self, reduced: Reduced, numbers: Sequence[int], response: FloatArray, taken: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        """Return what parts beside a set take away of the squares of B sets of deviations, at every level.

        What each takes away, (parts, levels, B), and by how much it raises ln|V|, (parts, levels).

        `numbers`: Of parts of one width and as many levels, that are at nothing in the set; not of irregular
            ones.
        `response`, (k, B): Products of their columns with the deviations, V of the set eliminated in none.
        `taken`, (p, B): The deviations in the coordinates of the set.
        """
        blocks = np.stack([self.parts[number].columns for number in numbers])
        products = self.columns.multiply(reduced.ratios, reduced.places, blocks.ravel())
        coordinates = reduced.compute_coordinates(products)
        shape = (-1, *blocks.shape)
        inner = coordinates[: len(reduced.root)].reshape(shape).transpose(1, 2, 0)
        outer = coordinates[len(reduced.root) :].reshape(shape).transpose(1, 2, 0)
        gram = self.columns.multiply_core_blocks(reduced.ratios, blocks) - inner @ inner.transpose(0, 2, 1)
        strengths, vectors = np.linalg.eigh(gram - outer @ outer.transpose(0, 2, 1))
        left = (response - coordinates.T @ taken).reshape(*blocks.shape, -1)
        levels = np.array([self.parts[number].levels for number in numbers])[:, :, np.newaxis]
        shares = levels / (1.0 + levels * np.maximum(strengths, 0.0)[:, np.newaxis])
        spread = np.log1p(levels * np.maximum(np.linalg.eigvalsh(gram), 0.0)[:, np.newaxis]).sum(axis=2)
        return shares @ (vectors.transpose(0, 2, 1) @ left) ** 2, spread

    def compute_logarithm(self, squares: FloatArray | float) -> FloatArray:
        """Return −2·ln of the likelihood that residual sums of squares have, σ profiled out."""
        return np.asarray(self.space.degrees * np.log(np.maximum(squares, NOTHING)))

    def explain_blocks(self, reduced: Reduced, blocks: FloatArray) -> FloatArray:
        """Return what blocks of contrasts (N, g, k) explain of the squares beside a set, shape (g,)."""
        held = self.columns.hold(blocks.reshape(len(blocks), -1))
        both = np.concatenate([reduced.places, self.response])
        products = self.columns.multiply_with(reduced.ratios, both, held)
        coordinates = reduced.compute_coordinates(products[:-1])
        own = self.columns.multiply_held_blocks(reduced.ratios, held, blocks.shape[2])
        left = (products[-1] - reduced.taken @ coordinates) * np.sqrt(self.squares)
        return solve_blocks(take_from(own, coordinates), left.reshape(*own.shape[:2], 1))[0][:, 0]

    def compute_coordinates_of(self, reduced: Reduced, held: HeldContrasts) -> FloatArray:
        """Return contrasts that are not in the table in the coordinates of a set, shape (p, B)."""
        return reduced.compute_coordinates(self.columns.multiply_with(reduced.ratios, reduced.places, held))

    def compute_squares_beside(self, reduced: Reduced, held: HeldContrasts) -> FloatArray:
        """Return what V and a set leave of the squares of contrasts that are not in the table, (B,)."""
        taken = self.compute_coordinates_of(reduced, held)
        whole = self.columns.multiply_held_blocks(reduced.ratios, held, 1)[:, 0, 0]
        return np.asarray(whole - np.sum(taken**2, axis=0))


def place_of(amplitudes: Amplitudes, members: Sequence[IntArray]) -> Place:
    """Return by what amplitudes and a set are known again."""
    return amplitudes, tuple(each.tobytes() for each in members)
