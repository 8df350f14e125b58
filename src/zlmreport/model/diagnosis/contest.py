"""The contest: how much each effect would add to a set, beside amplitudes of what has no name.

    x = X·β + Σ_k C_k(θ_k)·γ_k + Σ_j √φ_j·Z_j·u_j + ε,   u_j and ε/σ standard normal

X is the job's model, C_k are the effects of a set, Z_j the parts of the covariance: noise, and random curves
without a name. β has a flat prior and drops out with the space of contrasts; σ is profiled out. The
coefficients γ of an effect have a normal prior about zero, its variance that of a single reading or, rarely,
far larger (A. Zellner's g-prior, mixed over g: F. Liang et al., J. Amer. Statist. Assoc. 103 (2008) 410): so
a large effect costs evidence as its logarithm, and none is impossible. Everything is in units of −2·ln.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import TypeAlias

import numpy as np

from zlmreport.measurement.arrays import FloatArray, IntArray
from zlmreport.model.diagnosis.columns import Columns
from zlmreport.model.diagnosis.families import Family, group_forms_by_effect, is_known, list_families_of
from zlmreport.model.diagnosis.nameless import CovariancePart, list_parts_of, make_irregular_factors
from zlmreport.model.effects.design import Design
from zlmreport.model.effects.effect import Effect
from zlmreport.model.fitting.contrasts import Contrasts, describe_single_readings, make_contrasts_of
from zlmreport.model.fitting.noise import NoiseSource, list_noise_parts
from zlmreport.model.fitting.priors import PriorExpectation

#: Variances of an effect before any reading, in units of what one reading is worth, and their weights; the
#: first is what earlier tests say, where they do.
_WORTHS = ((1.0, 0.9), (1e2, 0.05), (1e4, 0.03), (1e6, 0.02))
#: Sum of squares of a residual that is no residual at all; share of the readings' that is rounding.
_NOTHING, _ROUNDING = 1e-60, 1e-13
#: Square of the share of a block's length below which a set imitates it.
_IMITATED = 1e-6
#: Columns of a set whose product is smaller, of the largest, depend on the others.
_DEPENDENT = 1e-9
#: Square of the length of a column, of one in a block, that is rounding: the model imitates it.
_ZERO = 1e-14

#: Is told the share of some work that is done, 0 to 1.
Told: TypeAlias = Callable[[float], object]
#: For each part the number of its level.
Amplitudes: TypeAlias = tuple[int, ...]
#: Amplitudes, and the places of the columns of each member of a set, in their order.
_Place: TypeAlias = tuple[Amplitudes, tuple[bytes, ...]]


def tell_nobody(_share: float) -> None:
    """Tell nobody."""


@dataclass(frozen=True, slots=True)
class Reduced:
    """A set of columns under given amplitudes, ready for products with any others."""

    ratios: tuple[float, ...]  #: Of the irregular shares.
    places: IntArray  #: Of the columns of the parts, then of the set.
    root: FloatArray  #: R, of the parts: a·b − (R·Zᵀa)·(R·Zᵀb) is the product under V.
    crossed: FloatArray  #: R·ZᵀC.
    set_root: FloatArray  #: (r, p): S with S·(CᵀV⁻¹C)·Sᵀ the unit matrix.
    log_determinant: float  #: ln|V|.

    def coordinates(self, products: FloatArray) -> FloatArray:
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


@dataclass(frozen=True, slots=True)
class _Group:
    """Families whose blocks are of one width, their blocks below one another."""

    families: IntArray  #: (f,) integer: Their numbers.
    places: IntArray  #: (g, k) integer: The places of the columns of each block.
    starts: IntArray  #: (f,) integer: The first block of each family.
    squares: FloatArray  #: (g,): Mean square that is expected of each over σ².
    log_weights: FloatArray  #: (g,)


@dataclass(frozen=True, slots=True)
class Scan:
    """What each family would add to a set, under given amplitudes."""

    #: (families,): −2·ln of the odds for it; the lower the better. Infinite where the set imitates it.
    criterion: FloatArray
    best: IntArray  #: (families,) integer: The best of its blocks.
    spread: FloatArray  #: (families,): How much more than its best value the average over all costs.


@dataclass(frozen=True, slots=True)
class Trials:
    """What families and parts without a name would add on many sets of deviations."""

    ratios: FloatArray  #: (effects, B): LR of each installed effect, its best value and coefficients taken.
    evidence: FloatArray  #: (effects, B): 2·ln of its Bayes factor, averaged over them.
    nameless: FloatArray  #: (forms and parts, B): The evidence of all that has no name.
    criterion: FloatArray  #: (B,): −2·ln of the restricted likelihood of nothing of this.


@dataclass(frozen=True)
class Contest:
    """Everything about a contest that does not depend on what was measured, and the readings themselves."""

    design: Design
    columns: Columns
    parts: tuple[CovariancePart, ...]
    families: tuple[Family, ...]
    invisible: tuple[Effect, ...]  #: Effects of which the plan sees nothing beside the model.
    deviation: FloatArray  #: (N,): x, m or rad; zeros where only simulated readings are asked about.
    response: IntArray  #: The place of the deviations among the columns.
    squares: float  #: Their sum of squares, by which they were divided.
    known: float  #: Sum of squares of a noise of known size that stands beside σ.
    least_visible: float
    expected: PriorExpectation = field(default_factory=PriorExpectation)
    _known: dict[Amplitudes, _Active] = field(default_factory=dict, repr=False)
    # A search comes by the same set again and again, from other sets.
    _reduced: dict[_Place, Reduced] = field(default_factory=dict, repr=False)
    _criteria: dict[_Place, float] = field(default_factory=dict, repr=False)
    _scans: dict[tuple[_Place, tuple[int, ...] | None], Scan] = field(default_factory=dict, repr=False)

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

        Parameters
        ----------
        base : (N, q) array
            Columns of the job's model, tangents of its searched parameters included.
        effects
            Forms of installed effects that can be tested on the design.
        deviation : (N,) array or None
            x, m or rad; None where only simulated readings are asked about.
        weights : (N,) array or None
            w, the variance of each reading over the mean one.
        memory
            Time over which a reading is forgotten, in the unit of the design's time; 0 for none.
        forms
            Forms without a name.
        known
            Standard deviation of a noise of known size that stands beside σ, m or rad.
        least_visible
            Share of an effect's length below which the model imitates it entirely.
        expected
            What earlier tests say, sizes in units of σ.
        with_nameless
            Whether parts without a name are thought of.
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
            design,
            columns,
            parts,
            (*named, *unnamed),
            invisible,
            deviation,
            response,
            squares,
            space.degrees * known**2,
            least_visible,
            expected,
        )

    @property
    def space(self) -> Contrasts:
        """The contrasts of the job's model."""
        return self.columns.space

    @cached_property
    def by_effect(self) -> tuple[tuple[int, ...], ...]:
        """For each installed effect, the places of its forms among the families."""
        return group_forms_by_effect(self.families)

    @cached_property
    def identifiers(self) -> tuple[str, ...]:
        """The installed effects in this order."""
        return tuple(self.families[forms[0]].identifier for forms in self.by_effect)

    @cached_property
    def quiet(self) -> Amplitudes:
        """Every part at nothing."""
        return tuple(0 for _ in self.parts)

    @cached_property
    def _groups(self) -> tuple[_Group, ...]:
        """The families by the width of their blocks."""
        widths: dict[int, list[int]] = {}
        for number, each in enumerate(self.families):
            widths.setdefault(each.blocks.shape[1], []).append(number)
        return tuple(self._group(members) for _, members in sorted(widths.items()))

    def _group(self, members: Sequence[int]) -> _Group:
        """Return families of one width, their blocks below one another."""
        own = [self.families[each] for each in members]
        sizes = [len(each.blocks) for each in own]
        squares = [self.expected.square(each.identifier) for each in own]
        return _Group(
            np.array(members),
            np.concatenate([each.blocks for each in own]),
            np.cumsum([0, *sizes])[:-1],
            np.repeat(squares, sizes),
            np.concatenate([each.log_weights for each in own]),
        )

    def nearest(self, ratios: Mapping[NoiseSource, float]) -> Amplitudes:
        """Return the amplitudes that are nearest to φ of the sources of noise, all else at nothing."""
        return tuple(
            int(np.argmin(np.abs(np.array(part.levels) - ratios.get(part.source, 0.0)))) if part.source else 0
            for part in self.parts
        )

    def middling(self) -> Iterator[Amplitudes]:
        """Yield amplitudes that noise may have: nothing, of each source a middling one, of all together."""
        middle = [part.noise_levels // 2 if part.source else 0 for part in self.parts]
        yield self.quiet
        for number, level in enumerate(middle):
            if level:
                yield (*self.quiet[:number], level, *self.quiet[number + 1 :])
        yield tuple(middle)

    def ratios_of(self, amplitudes: Amplitudes) -> dict[NoiseSource, float]:
        """Return φ of the sources of noise."""
        pairs = zip(self.parts, amplitudes, strict=True)
        return {part.source: part.levels[level] for part, level in pairs if part.source}

    def factors(self, amplitudes: Amplitudes) -> Iterator[FloatArray]:
        """Yield the factors of the parts under amplitudes, for readings as they stand, (N, k) each."""
        noise = {part.source: part.factor for part in self.space.parts}
        for part, level in zip(self.parts, amplitudes, strict=True):
            if level:
                own = noise.get(part.source) if part.source else None
                contrasts = self.space.single.coloured(self.columns.values(part.columns))
                yield np.sqrt(part.levels[level]) * (contrasts if own is None else own)

    def as_noise(self, amplitudes: Amplitudes) -> Amplitudes:
        """Return amplitudes held to what noise may be."""
        return tuple(
            min(level, part.noise_levels - 1) for level, part in zip(amplitudes, self.parts, strict=True)
        )

    def _active(self, amplitudes: Amplitudes) -> _Active:
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

    def reduced(self, amplitudes: Amplitudes, members: Sequence[IntArray]) -> Reduced:
        """Return a set of columns under amplitudes."""
        place = _place_of(amplitudes, members)
        if place not in self._reduced:
            self._reduced[place] = self._reduce(amplitudes, members)
        return self._reduced[place]

    def _reduce(self, amplitudes: Amplitudes, members: Sequence[IntArray]) -> Reduced:
        active, own = self._active(amplitudes), np.concatenate([self.response[:0], *members])
        count, root = len(active.places), active.roots
        products = self.columns.products_among(active.ratios, active.places, own)
        inner = root[:, np.newaxis] * products[:count, :count] * root
        factor = np.linalg.cholesky(np.eye(count) + inner)
        own_root = np.linalg.inv(factor) * root
        crossed = own_root @ products[:count, count:]
        return Reduced(
            active.ratios,
            np.concatenate([active.places, own]),
            own_root,
            crossed,
            _root_of(products[count:, count:] - crossed.T @ crossed),
            self.columns.log_determinant(active.ratios) + 2.0 * float(np.log(np.diagonal(factor)).sum()),
        )

    def left(self, reduced: Reduced) -> tuple[float, FloatArray]:
        """Return the residual sum of squares, and the deviations in the coordinates of the set."""
        products = self.columns.products(reduced.ratios, reduced.places, self.response)
        taken = reduced.coordinates(products)[:, 0]
        own = self.columns.products(reduced.ratios, self.response, self.response)[0, 0]
        return max(float(own - taken @ taken), _ROUNDING) * self.squares + self.known, taken

    def criterion(self, amplitudes: Amplitudes, members: Sequence[IntArray]) -> float:
        """Return −2·ln of the restricted likelihood times the prior odds of the amplitudes."""
        place = _place_of(amplitudes, members)
        if place not in self._criteria:
            self._criteria[place] = self._compute_criterion(amplitudes, members)
        return self._criteria[place]

    def _compute_criterion(self, amplitudes: Amplitudes, members: Sequence[IntArray]) -> float:
        active, own = self._active(amplitudes), np.concatenate([self.response[:0], *members])
        count, key = len(active.places), active.ratios
        products = self.columns.products_among(key, np.concatenate([active.places, self.response]), own)
        # The pivots of one factor tell all: those of the parts ln|V|, the last what is left of the readings.
        order = np.r_[:count, count + 1 : len(products), count]
        bordered = products[order[:, np.newaxis], order]
        bordered[:count] *= active.roots[:, np.newaxis]
        bordered[:, :count] *= active.roots
        diagonal = np.arange(len(bordered))
        bordered[diagonal[:count], diagonal[:count]] += 1.0
        bordered[-1, -1] += _ROUNDING
        try:
            pivots = np.linalg.cholesky(bordered)[diagonal, diagonal]
            is_clear = bool((pivots[count:-1] ** 2 > _IMITATED).all())
        except np.linalg.LinAlgError:
            is_clear = False
        if is_clear:
            squares = float(pivots[-1]) ** 2 * self.squares + self.known
            determinant = self.columns.log_determinant(key) + 2.0 * float(np.log(pivots[:count]).sum())
        else:  # columns of the set depend on each other
            reduced = self.reduced(amplitudes, members)
            squares, determinant = self.left(reduced)[0], reduced.log_determinant
        return float(
            self._logarithm(squares) + determinant + self.space.single.log_determinant + active.costs
        )

    def by_level(
        self, amplitudes: Amplitudes, members: Sequence[IntArray], numbers: Sequence[int]
    ) -> list[FloatArray]:
        """Return `criterion` at every level of some parts, each by itself at each, all else as it is.

        `numbers`: Of parts that are at nothing, or of a single one; not of irregular ones.
        """
        base = tuple(0 if number in numbers else level for number, level in enumerate(amplitudes))
        reduced = self.reduced(base, members)
        squares, taken = self.left(reduced)
        alike: dict[tuple[int, int], list[int]] = {}
        for number in numbers:
            alike.setdefault((self.parts[number].width, len(self.parts[number].levels)), []).append(number)
        beside = reduced.log_determinant + self.space.single.log_determinant + self._active(base).costs
        found: dict[int, FloatArray] = {}
        for (width, _), group in alike.items():
            blocks = np.stack([self.parts[number].columns for number in group])
            flat = blocks.ravel()
            coordinates = reduced.coordinates(self.columns.products(reduced.ratios, reduced.places, flat))
            response = self.columns.products(reduced.ratios, self.response, flat)[0]
            shape = (-1, len(group), width)
            inner = coordinates[: len(reduced.root)].reshape(shape).transpose(1, 2, 0)
            outer = coordinates[len(reduced.root) :].reshape(shape).transpose(1, 2, 0)
            gram = self.columns.squares_of_core(reduced.ratios, blocks) - inner @ inner.transpose(0, 2, 1)
            strengths, vectors = np.linalg.eigh(gram - outer @ outer.transpose(0, 2, 1))
            left = (response - taken @ coordinates).reshape(len(group), width, 1)
            turned = (vectors.transpose(0, 2, 1) @ left)[:, np.newaxis, :, 0] ** 2 * self.squares
            levels = np.array([self.parts[number].levels for number in group])[:, :, np.newaxis]
            shares = levels / (1.0 + levels * np.maximum(strengths, 0.0)[:, np.newaxis])
            spread = np.log1p(levels * np.maximum(np.linalg.eigvalsh(gram), 0.0)[:, np.newaxis]).sum(axis=2)
            left = np.maximum(
                squares - np.sum(shares * turned, axis=2), _ROUNDING * self.squares + self.known
            )
            costs = np.array([self.parts[number].costs for number in group])
            criteria = self._logarithm(left) + spread + beside + costs - costs[:, :1]
            found.update(zip(group, criteria, strict=True))
        return [found[number] for number in numbers]

    def _logarithm(self, squares: FloatArray | float) -> FloatArray:
        return np.asarray(self.space.degrees * np.log(np.maximum(squares, _NOTHING)))

    def explained(self, reduced: Reduced, blocks: FloatArray, taken: FloatArray) -> FloatArray:
        """Return what blocks of contrasts (N, g, k) explain of the squares beside a set, shape (g,).

        `taken`: The deviations in the coordinates of the set.
        """
        flat = blocks.reshape(len(blocks), -1)
        own = self.columns.squares_of(reduced.ratios, blocks)
        products = self.columns.products_with(reduced.ratios, reduced.places, flat)
        response = self.columns.products_with(reduced.ratios, self.response, flat)[0]
        return self._explained(reduced, own, products, response, taken)[0][:, 0]

    def _explained(
        self,
        reduced: Reduced,
        own: FloatArray,
        products: FloatArray,
        response: FloatArray,
        taken: FloatArray,
    ) -> tuple[FloatArray, FloatArray]:
        count, width = own.shape[:2]
        coordinates = reduced.coordinates(products)
        left = ((response - taken @ coordinates) * np.sqrt(self.squares)).reshape(count, width)
        inner = coordinates.reshape(-1, count, width)
        return _solve_blocks(own - np.einsum("rgi,rgj->gij", inner, inner), left[:, :, np.newaxis])

    def squares_beside(self, reduced: Reduced, contrasts: FloatArray) -> FloatArray:
        """Return what V and a set leave of the squares of contrasts (N, B) not in the table, (B,)."""
        taken = reduced.coordinates(self.columns.products_with(reduced.ratios, reduced.places, contrasts))
        whole = self.columns.squares_of(reduced.ratios, contrasts[:, :, np.newaxis])[:, 0, 0]
        return np.asarray(whole - np.sum(taken**2, axis=0))

    def scan(
        self, amplitudes: Amplitudes, members: Sequence[IntArray], only: Sequence[int] | None = None
    ) -> Scan:
        """Return what every family would add to a set; or only some, by their numbers."""
        place = _place_of(amplitudes, members), None if only is None else tuple(only)
        if place not in self._scans:
            self._scans[place] = self._scan(amplitudes, members, only)
        return self._scans[place]

    def _scan(self, amplitudes: Amplitudes, members: Sequence[IntArray], only: Sequence[int] | None) -> Scan:
        reduced = self.reduced(amplitudes, members)
        squares, taken = self.left(reduced)
        count = len(self.families)
        scan = Scan(np.full(count, np.inf), np.zeros(count, dtype=np.int64), np.zeros(count))
        for group in self._groups if only is None else [self._group([each]) for each in only]:
            flat, width = group.places.ravel(), group.places.shape[1]
            own = (
                self.columns.squares(reduced.ratios, width, group.places)
                if only is None
                else self.columns.squares_of(
                    reduced.ratios, self.columns.values(flat).reshape(-1, *group.places.shape)
                )
            )
            explained, ranks = self._explained(
                reduced,
                own,
                self.columns.products_with_kept(reduced.ratios, reduced.places, flat),
                self.columns.products_with_kept(reduced.ratios, self.response, flat)[0],
                taken,
            )
            added = self._added(squares, explained[:, 0], ranks, group.squares)
            sizes = np.diff([*group.starts, len(added)])
            least = np.minimum.reduceat(added, group.starts)
            likelihoods = np.exp(group.log_weights - 0.5 * (added - np.repeat(least, sizes)))
            spread = -2.0 * np.log(np.add.reduceat(likelihoods, group.starts))
            seen = np.maximum.reduceat(ranks, group.starts) > 0
            prices = np.array([self.families[each].price for each in group.families])
            scan.criterion[group.families] = np.where(seen, least + spread + prices, np.inf)
            scan.spread[group.families] = spread
            first = np.flatnonzero(added == np.repeat(least, sizes))
            owner = np.repeat(np.arange(len(sizes)), sizes)[first]
            scan.best[group.families[owner[::-1]]] = (first - group.starts[owner])[::-1]
        return scan

    def _added(
        self, squares: FloatArray | float, explained: FloatArray, ranks: FloatArray, square: FloatArray
    ) -> FloatArray:
        """Return the criterion of blocks against none, their coefficients averaged over."""
        found = []
        for factor, weight in _WORTHS:
            prior = factor * float(self.space.degrees) * (square if factor == 1.0 else 1.0)
            left = squares - explained * (prior / (1.0 + prior))
            left = np.maximum(left, _ROUNDING * self.squares + self.known)
            gained = self._logarithm(left) - self._logarithm(squares)
            found.append(gained + ranks * np.log1p(prior) - 2.0 * np.log(weight))
        return _average_likelihoods(np.array(found), 0)

    def worth(self, explained: float, rank: int, square: float) -> float:
        """Return what a block costs that explains so much, in σ², its coefficients averaged over."""
        found = []
        for factor, weight in _WORTHS:
            prior = factor * float(self.space.degrees) * (square if factor == 1.0 else 1.0)
            found.append(explained / (1.0 + prior) + rank * np.log1p(prior) - 2.0 * np.log(weight))
        return float(_average_likelihoods(np.array(found), 0))

    def trials(
        self,
        amplitudes: Amplitudes,
        members: Sequence[IntArray],
        deviations: FloatArray,
        known: float = 0.0,
        *,
        only: frozenset[str] = frozenset(),
    ) -> Trials:
        """Return what all would add on many sets of deviations, (N, B), m or rad, under given amplitudes.

        `known`: Standard deviation of a noise of known size, m or rad.
        `only`: Effects that are asked about, by their identifiers, and nothing without a name; all if none.
        """
        contrasts = self.space.of(deviations)
        reduced = self.reduced(amplitudes, members)
        taken = reduced.coordinates(self.columns.products_with(reduced.ratios, reduced.places, contrasts))
        squares = self.squares_beside(reduced, contrasts) + self.space.degrees * known**2
        sets = deviations.shape[1]
        fits = np.full((len(self.families), sets), np.inf)
        averages = np.full((len(self.families), sets), np.inf)
        for group in self._groups:
            places, square = group.places, group.squares
            if only and not only & {self.families[each].identifier for each in group.families.tolist()}:
                continue
            flat = places.ravel()
            coordinates = reduced.coordinates(
                self.columns.products_with_kept(reduced.ratios, reduced.places, flat)
            )
            left = self.columns.products_with(reduced.ratios, flat, contrasts) - coordinates.T @ taken
            inner = coordinates.reshape(-1, *places.shape)
            gram = self.columns.squares(reduced.ratios, places.shape[1], places)
            explained, ranks = _solve_blocks(
                gram - np.einsum("rgi,rgj->gij", inner, inner), left.reshape(*places.shape, sets)
            )
            added = self._added(squares, explained, ranks[:, np.newaxis], square[:, np.newaxis])
            fitted = self._logarithm(np.maximum(squares - explained, _NOTHING)) - self._logarithm(squares)
            ends = [*group.starts[1:], len(added)]
            for number, first, end in zip(group.families.tolist(), group.starts.tolist(), ends, strict=True):
                fits[number] = fitted[first:end].min(axis=0)
                weights = group.log_weights[first:end, np.newaxis]
                averages[number] = _average_likelihoods(added[first:end] - 2.0 * weights, 0)
        named = [
            list(forms)
            for name, forms in zip(self.identifiers, self.by_effect, strict=True)
            if not only or name in only
        ]
        unnamed = [number for number, each in enumerate(self.families) if not each.is_named]
        shapes = [-averages[unnamed]]
        if not only:
            shapes += self._of_parts(amplitudes, members, contrasts, squares, known)
        return Trials(
            -np.array([fits[forms].min(axis=0) for forms in named]).reshape(-1, sets),
            -np.array(
                [_average_likelihoods(averages[forms] + 2.0 * np.log(len(forms)), 0) for forms in named]
            ).reshape(-1, sets),
            np.concatenate(shapes).reshape(-1, sets),
            self._logarithm(squares) + reduced.log_determinant,
        )

    def _of_parts(
        self,
        amplitudes: Amplitudes,
        members: Sequence[IntArray],
        contrasts: FloatArray,
        squares: FloatArray,
        known: float,
    ) -> list[FloatArray]:
        """Return the evidence of each part without a name, its amplitude averaged over, shape (1, B) each."""
        found = []
        before = self.reduced(amplitudes, members).log_determinant
        for number, part in enumerate(self.parts):
            tried = []
            for level in range(part.noise_levels, len(part.levels)):
                reduced = self.reduced((*amplitudes[:number], level, *amplitudes[number + 1 :]), members)
                left = self.squares_beside(reduced, contrasts) + self.space.degrees * known**2
                added = self._logarithm(left) - self._logarithm(squares)
                tried.append(added + reduced.log_determinant - before)
            if tried:
                found.append(-_average_likelihoods(np.array(tried), 0)[np.newaxis] - 2.0 * np.log(len(tried)))
        return found


def average_evidence(trials: Sequence[Trials]) -> tuple[FloatArray, FloatArray]:
    """Return the evidence of effects and of what has no name, averaged over amplitudes all as likely."""
    criteria = np.array([each.criterion for each in trials])
    nothing = _average_likelihoods(criteria, 0)
    return (
        nothing
        - _average_likelihoods(criteria[:, np.newaxis] - np.array([each.evidence for each in trials]), 0),
        nothing
        - _average_likelihoods(criteria[:, np.newaxis] - np.array([each.nameless for each in trials]), 0),
    )


def _place_of(amplitudes: Amplitudes, members: Sequence[IntArray]) -> _Place:
    return amplitudes, tuple(each.tobytes() for each in members)


def _root_of(gram: FloatArray) -> FloatArray:
    """Return S with S·G·Sᵀ the unit matrix, for a Gram matrix whose columns may depend on each other."""
    if not len(gram):
        return np.empty((0, 0))
    squares = np.diagonal(gram)
    # A column of zeros has no length: divided by one, the rounding of a vector would outgrow all the others.
    seen = squares > _ZERO
    lengths = np.sqrt(np.where(seen, squares, 1.0))
    values, vectors = np.linalg.eigh(np.where(np.outer(seen, seen), gram, 0.0) / np.outer(lengths, lengths))
    kept = values > _DEPENDENT * max(float(values[-1]), _NOTHING)
    return np.asarray((vectors[:, kept] / np.sqrt(values[kept])).T * (seen / lengths))


def _solve_blocks(gram: FloatArray, products: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return bᵀG⁻¹b and the rank of G for each of many blocks: gram (g, k, k), products (g, k, B)."""
    if gram.shape[1] == 1:
        seen = gram[:, 0, 0] > _IMITATED
        inverse = np.where(seen, 1.0 / np.where(seen, gram[:, 0, 0], 1.0), 0.0)
        return products[:, 0] ** 2 * inverse[:, np.newaxis], seen.astype(np.float64)
    values, vectors = np.linalg.eigh(gram)
    seen = values > _IMITATED
    inverse = np.where(seen, 1.0 / np.where(seen, values, 1.0), 0.0)
    turned = vectors.transpose(0, 2, 1) @ products
    return np.einsum("gk,gkb->gb", inverse, turned**2), seen.sum(axis=1).astype(np.float64)


def _average_likelihoods(criteria: FloatArray, axis: int | None = None) -> FloatArray:
    """Return −2·ln of the sum of likelihoods along an axis, or over all."""
    least = criteria.min(axis=axis, keepdims=True)
    summed = np.exp(-0.5 * (criteria - least)).sum(axis=axis)
    return np.asarray(np.squeeze(least, axis) - 2.0 * np.log(summed))
