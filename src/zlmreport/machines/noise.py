"""The scatter of circles: noise along the path, and irregular geometry that all turns share.

V = σ²·(1 + p·exp(−Δφ/6°) within a turn + k(Δθ)·(g + h·s·s′) within a plane) + what else is known to be
uncertain: the errors of the axes, and the angle at which each turn began. White noise alone would take
correlated readings for evidence: 77 to 82 % of healthy circles would then raise an alarm.

V is never formed. Each turn is whitened by the Cholesky factor of its own part; all that turns share is of
low rank, and so is what the base model takes out: both together are the mixed-model equations (C. R.
Henderson, Biometrics 31 (1975) 423), whose solution has the parameters with their covariance, too.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import product

import numpy as np
from numpy.linalg import cholesky

from zlmreport.machines.design import ThinnedDesign
from zlmreport.measurement.arrays import BoolArray, FloatArray, IntArray

#: Correlation length along the path, and of irregular geometry, rad: the shortest, and all that are tried.
PATH_LENGTH, GEOMETRY_LENGTH = float(np.radians(6.0)), float(np.radians(10.0))
_LENGTHS = (GEOMETRY_LENGTH, 2.0 * GEOMETRY_LENGTH)
#: Variances that are tried, in units of that of a single reading: along the path; irregular geometry that is
#: alike in both senses, and that is opposite.
_PATH, _EVEN, _ODD = (0.0, 0.2, 0.6, 1.8), (0.0, 0.05, 0.2, 0.8), (0.0, 0.1)
#: Share of the probability that the values of the noise which are kept must hold, and the most of them.
_KEPT, _MOST = 0.98, 6
_LEAST_VARIANCE = 1e-4
#: What a wave of a longer correlation length has at least, of its variance at the shortest.
_LEAST_SHARE = 1e-8
#: A hair of the diagonal: columns of the base that nearly coincide must not stop the work.
_HAIR = 1e-12
#: Of the square of deviations, what is taken to be left where a model explains them exactly: rounding leaves
#: anything about zero there, and deviations that are nothing but zeros have a logarithm, too.
_LEAST_LEFT, _LEAST_SQUARE = 1e-10, 1e-300


def bound_square(left: FloatArray, whole: FloatArray) -> FloatArray:
    """Return what a model leaves of squared deviations, (B,), but no less than rounding may leave."""
    return np.asarray(np.maximum(left, _LEAST_LEFT * whole + _LEAST_SQUARE))


@dataclass(frozen=True, slots=True)
class NoiseShape:
    """The variances of a noise relative to that of a single reading."""

    path: float
    even: float
    odd: float
    length: float = GEOMETRY_LENGTH  #: Correlation length of irregular geometry, rad.

    @property
    def total(self) -> float:
        """The variance of a reading, all parts together."""
        return 1.0 + self.path + self.even + self.odd


SHAPES = tuple(
    NoiseShape(path, even, odd, length)
    for path, even, odd in product(_PATH, _EVEN, _ODD)
    for length in (_LENGTHS if even or odd else _LENGTHS[:1])
)


def _list_orders() -> FloatArray:
    """Return the numbers of waves about the circle that the shortest correlation length has."""
    orders = np.arange(2, 64)
    return np.asarray(orders[np.exp(-0.5 * (orders * GEOMETRY_LENGTH) ** 2) > _LEAST_VARIANCE])


def _find_spectrum(length: float) -> FloatArray:
    """Return the share of the variance that each of these waves has."""
    spectrum = np.exp(-0.5 * (_list_orders() * length) ** 2)
    return np.asarray(spectrum / np.sum(spectrum))


def make_geometry(design: ThinnedDesign) -> tuple[FloatArray, FloatArray]:
    """Return irregular geometry, even and odd, as columns of random combination: (N, r) each, variance one.

    Waves about the circle, weighted so that their combination is correlated over `GEOMETRY_LENGTH`; each
    plane, centre and radius has its own.
    """
    orders, size = _list_orders(), np.sqrt(_find_spectrum(GEOMETRY_LENGTH))
    waves = np.concatenate(
        [size * np.cos(np.outer(design.angle, orders)), size * np.sin(np.outer(design.angle, orders))], axis=1
    )
    places = [(each.nominal.plane, each.nominal.centre, each.nominal.radius) for each in design.tests]
    groups = np.array([places.index(places[test]) for test in design.test.tolist()])
    even = np.concatenate(
        [waves * (groups == group)[:, np.newaxis] for group in sorted(set(groups.tolist()))], axis=1
    )
    return even, even * design.sense[:, np.newaxis]


@dataclass(frozen=True, slots=True)
class Whitening:
    """The readings of each turn whitened for a noise along the path, with the geometry that they share."""

    turns: tuple[IntArray, ...]
    factors: tuple[FloatArray, ...]  #: Of each turn, L⁻¹ with L·Lᵀ its covariance over σ².
    log_determinant: float
    geometry: FloatArray  #: Even and odd columns, whitened, (N, 2r).
    gram: FloatArray  #: Their products, (2r, 2r).

    def whiten(self, columns: FloatArray) -> FloatArray:
        """Return columns whitened by turn, (N, k)."""
        found = np.empty_like(columns)
        for turn, factor in zip(self.turns, self.factors, strict=True):
            found[turn] = factor @ columns[turn]
        return found


class CircleNoise:
    """What the noise of a design has in common, whatever the model: each whitening is made once."""

    def __init__(self, design: ThinnedDesign) -> None:
        self.design = design
        self.even, self.odd = make_geometry(design)
        repeats = self.even.shape[1] // len(_list_orders())
        #: By correlation length: variances of the columns of geometry, (r,), one each at the shortest.
        self.shares = {
            length: np.tile(
                np.maximum(_find_spectrum(length) / _find_spectrum(GEOMETRY_LENGTH), _LEAST_SHARE), repeats
            )
            for length in _LENGTHS
        }
        self._turns = tuple(np.flatnonzero(design.turn == turn) for turn in design.turns)
        self._by_path: dict[float, Whitening] = {}

    def compute_kernel(self, turn: IntArray) -> FloatArray:
        """Return exp(−Δφ/6°) within a turn."""
        travelled = self.design.travelled[turn]
        return np.asarray(np.exp(-np.abs(travelled[:, np.newaxis] - travelled) / PATH_LENGTH))

    def make_whitening(self, path: float) -> Whitening:
        """Return the whitening for a variance along the path."""
        if path not in self._by_path:
            lowers = [cholesky(np.eye(len(turn)) + path * self.compute_kernel(turn)) for turn in self._turns]
            total = 2.0 * sum(float(np.sum(np.log(np.diag(lower)))) for lower in lowers)
            bare = Whitening(
                self._turns, tuple(np.linalg.inv(lower) for lower in lowers), total,
                np.zeros((0, 0)), np.zeros((0, 0)),
            )  # fmt: skip
            columns = bare.whiten(np.concatenate([self.even, self.odd], axis=1))
            self._by_path[path] = Whitening(self._turns, bare.factors, total, columns, columns.T @ columns)
        return self._by_path[path]

    def simulate(
        self, shapes: Sequence[NoiseShape], known: FloatArray, random: np.random.Generator
    ) -> FloatArray:
        """Return deviations that hold nothing but noise, σ = 1, one column for each shape."""
        found = random.standard_normal((self.design.count, len(shapes)))
        path = np.sqrt(np.array([each.path for each in shapes]))
        for turn in self._turns:
            lower = cholesky(self.compute_kernel(turn) + 1e-9 * np.eye(len(turn)))
            found[turn] += path * (lower @ random.standard_normal((len(turn), len(shapes))))
        even, odd = (
            np.array([getattr(each, name) * self.shares[each.length] for each in shapes]).T
            for name in ("even", "odd")
        )
        for columns, variances in ((self.even, even), (self.odd, odd), (known, 1.0)):
            found += columns @ (np.sqrt(variances) * random.standard_normal((columns.shape[1], len(shapes))))
        return found


@dataclass(frozen=True, slots=True)
class Whitened:
    """The readings under one noise, the base model taken out: products are P-products.

    P = V⁻¹ − V⁻¹X(XᵀV⁻¹X)⁻¹XᵀV⁻¹; a column c stands as (I − UUᵀ)·L⁻¹·c.
    """

    whitening: Whitening
    taken: FloatArray  #: U, (N, r), orthonormal but for what the noise's finite parts leave.
    log_determinant: float  #: ln|V| + ln|XᵀV⁻¹X|.
    freedom: int  #: Number of readings minus that of the base model's columns.

    def whiten(self, columns: FloatArray) -> FloatArray:
        """Return columns whitened by turn, (N, k)."""
        return self.whitening.whiten(columns)

    def multiply(self, one: FloatArray, other: FloatArray) -> FloatArray:
        """Return oneᵀ·P·other of columns that were whitened by turn."""
        return np.asarray(one.T @ other - (self.taken.T @ one).T @ (self.taken.T @ other))

    def measure_explained(self, columns: FloatArray, curve: FloatArray) -> float:
        """Return the squared length of what columns make of a curve, (N, 1); both were whitened by turn."""
        matrix, products = self.multiply(columns, columns), self.multiply(columns, curve)
        return float((products.T @ np.linalg.pinv(matrix, rcond=1e-10) @ products)[0, 0])


class NoiseModel:
    """The noise of a design beside a model, for any of its shapes."""

    def __init__(self, noise: CircleNoise, base: FloatArray, known: FloatArray) -> None:
        """Take columns that are free, (N, p), and a factor of what is uncertain by itself, (N, r), in σ."""
        self.noise = noise
        self._lengths = np.sqrt(np.maximum(np.sum(base**2, axis=0), 1e-300))
        self._base, self.known = base / self._lengths, known
        self._by_path: dict[float, tuple[FloatArray, FloatArray]] = {}

    @property
    def freedom(self) -> int:
        """Number of readings minus that of the base model's columns."""
        return self.noise.design.count - int(self._base.shape[1])

    def whiten(self, shape: NoiseShape) -> Whitened:
        """Return the readings under one noise."""
        matrix, used, log_rest = self._make_matrix(shape)
        lower = np.asarray(cholesky(matrix), dtype=np.float64)
        taken = np.linalg.solve(lower, self._whiten_columns(shape.path)[0][:, used].T).T
        log_determinant = log_rest + 2.0 * float(np.sum(np.log(np.diag(lower))))
        return Whitened(
            self.noise.make_whitening(shape.path),
            np.asarray(taken, dtype=np.float64),
            log_determinant,
            self.freedom,
        )

    def compute_log_likelihoods(self, shapes: Sequence[NoiseShape], deviation: FloatArray) -> FloatArray:
        """Return restricted log-likelihoods of deviations, σ maximised, and their P-squares, (shapes, 2)."""
        reads = {path: self._read(path, deviation) for path in {each.path for each in shapes}}
        return np.array([self._compute_log_likelihood(each, *reads[each.path]) for each in shapes])

    def _compute_log_likelihood(
        self, shape: NoiseShape, products: FloatArray, square: float
    ) -> tuple[float, float]:
        matrix, used, log_rest = self._make_matrix(shape)
        # With the deviations as a last column, the factor's last element is the root of their P-square.
        bordered = np.empty((len(matrix) + 1, len(matrix) + 1))
        bordered[:-1, :-1], bordered[-1, :-1] = matrix, products[used]
        bordered[-1, -1] = square * (1.0 + _LEAST_LEFT) + _LEAST_SQUARE
        factor = np.diag(cholesky(bordered))
        log_determinant = log_rest + 2.0 * float(np.sum(np.log(factor[:-1])))
        left = float(factor[-1]) ** 2
        return -0.5 * log_determinant - 0.5 * self.freedom * float(np.log(left)), left

    def solve(self, shape: NoiseShape, deviation: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the coefficients of the base's columns and their covariance over σ², (p,) and (p, p)."""
        matrix, used, _ = self._make_matrix(shape)
        products, _ = self._read(shape.path, deviation)
        count = self._base.shape[1]
        wanted = np.column_stack([np.eye(len(matrix))[:, :count], products[used]])
        half = np.linalg.solve(cholesky(matrix), wanted)
        values, covariance = half[:, :count].T @ half[:, count], half[:, :count].T @ half[:, :count]
        return values / self._lengths, covariance / np.outer(self._lengths, self._lengths)

    def _read(self, path: float, deviation: FloatArray) -> tuple[FloatArray, float]:
        """Return the products of all columns with deviations, whitened, and the square of these."""
        read = self.noise.make_whitening(path).whiten(deviation[:, np.newaxis])[:, 0]
        return self._whiten_columns(path)[0].T @ read, float(read @ read)

    def _make_matrix(self, shape: NoiseShape) -> tuple[FloatArray, BoolArray, float]:
        """Return the equations' matrix, which columns are in it, and ln|V| + ln|XᵀV⁻¹X| less its own ln."""
        _, gram = self._whiten_columns(shape.path)
        base, shares = self._base.shape[1], self.noise.shares[shape.length]
        sizes = np.concatenate(
            [
                np.full(base, np.inf),
                shape.even * shares,
                shape.odd * shares,
                np.ones(self.known.shape[1]),
            ]
        )
        used = sizes > 0
        matrix = gram[np.ix_(used, used)]
        diagonal = np.diag_indices_from(matrix)
        matrix[diagonal] = (matrix[diagonal] + 1.0 / sizes[used]) * (1.0 + _HAIR)
        finite = sizes[used & np.isfinite(sizes)]
        return (
            matrix,
            used,
            self.noise.make_whitening(shape.path).log_determinant + float(np.sum(np.log(finite))),
        )

    def _whiten_columns(self, path: float) -> tuple[FloatArray, FloatArray]:
        """Return all columns side by side, whitened, and their products."""
        if path not in self._by_path:
            whitening = self.noise.make_whitening(path)
            base, known = whitening.whiten(self._base), whitening.whiten(self.known)
            columns = np.concatenate([base, whitening.geometry, known], axis=1)
            count, shared = base.shape[1], whitening.geometry.shape[1]
            gram = np.empty((columns.shape[1], columns.shape[1]))
            inner = slice(count, count + shared)
            gram[inner, inner] = whitening.gram
            outer = np.r_[0:count, count + shared : columns.shape[1]]
            crossed = columns[:, outer].T @ columns
            gram[outer], gram[:, outer] = crossed, crossed.T
            self._by_path[path] = columns, gram
        return self._by_path[path]


@dataclass(frozen=True, slots=True)
class NoiseFound:
    """The noise that readings show: its likely shapes, with their probabilities."""

    shapes: tuple[NoiseShape, ...]
    weights: FloatArray
    #: Standard deviation of a single white reading, m.
    sigma: float

    @property
    def likeliest(self) -> NoiseShape:
        """The likeliest shape."""
        return self.shapes[int(np.argmax(self.weights))]

    @property
    def rms(self) -> float:
        """Root mean square of all that scatters, m."""
        return self.sigma * float(
            np.sqrt(sum(w * s.total for w, s in zip(self.weights, self.shapes, strict=True)))
        )

    def estimate_of_readings(self, averaged: float) -> float:
        """Return the same of single readings, where so many neighbours were averaged: what is white grows."""
        return float(np.sqrt(self.rms**2 + (averaged - 1.0) * self.sigma**2))


def find_anew(model: NoiseModel, deviation: FloatArray, kept: Sequence[NoiseShape]) -> float:
    """Return 2·ln of what a model gains if its noise may have any shape, and not only some.

    Evidence is weighed under the noise that readings show without an effect. Where the effect is many times
    the noise, they show another beside it.
    """
    logs = model.compute_log_likelihoods(SHAPES, deviation)[:, 0]
    own = [index for index, shape in enumerate(SHAPES) if shape in kept]
    return 2.0 * float(np.logaddexp.reduce(logs) - np.logaddexp.reduce(logs[own]))


def find_noise(model: NoiseModel, deviation: FloatArray) -> NoiseFound:
    """Return the noise by restricted likelihood, over a grid of shapes; those are kept that count."""
    found = model.compute_log_likelihoods(SHAPES, deviation)
    weights = np.exp(found[:, 0] - found[:, 0].max())
    weights /= weights.sum()
    order = np.argsort(-weights)
    count = min(int(np.searchsorted(np.cumsum(weights[order]), _KEPT)) + 1, _MOST)
    kept = order[:count]
    share = weights[kept] / weights[kept].sum()
    sigma = float(np.sqrt(share @ found[kept, 1] / model.freedom))
    shapes = tuple(SHAPES[index] for index in kept.tolist())
    return NoiseFound(shapes, share, sigma)
