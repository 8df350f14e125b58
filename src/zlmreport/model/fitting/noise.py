"""The noise model: which sources of scatter are tried, and in which ratios.

Readings of one target share its irregular geometry, those of one run its displacement, neighbours in time
the slow drift between them; 210 readings of 21 targets are no 210 independent ones. So

    Var x = σ²·V(φ),   V(φ) = diag(w) + Σ_j φ_j·Z_j·Z_jᵀ

with one part Z_j for each of these sources, and its variance φ_j in units of σ².
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from enum import Enum
from functools import cache
from itertools import product

import numpy as np

from zlmreport.language import Words
from zlmreport.measurement.arrays import FloatArray, IntArray, read_only_floats
from zlmreport.model.effects.design import Design
from zlmreport.model.fitting.pauses import compute_working_time

#: Time over which the slow drift forgets itself, as a share of the test's duration.
_MEMORY = 0.25
#: Eigenfunctions of the drift that are kept; what they leave out is faster than the readings follow.
_DRIFT_TERMS = 20
_DRIFT_MOMENTS = 160
#: A source needs so many readings to be told from the scatter of single readings.
_FEWEST_READINGS = 12


class NoiseSource(Enum):
    """What several readings share without being an effect: irregular, and different in every test."""

    POSITION = "position"
    DIRECTION = "position and direction"
    RUN = "run"
    TIME = "time"

    @property
    def words(self) -> Words:
        """What it is."""
        return _WORDS[self]


_WORDS = {
    NoiseSource.POSITION: Words("irregular, fixed in position"),
    NoiseSource.DIRECTION: Words("irregular, fixed in position and different up and down"),
    NoiseSource.RUN: Words("every run displaced as a whole"),
    NoiseSource.TIME: Words("slow irregular drift"),
}

#: Sources of which readings of other targets share nothing.
BY_TARGET = frozenset({NoiseSource.POSITION, NoiseSource.DIRECTION})
#: Ratios φ that are tried. What is larger than half the repeatability of a single reading (φ = ¼), and of a
#: whole run than a quarter of it, is no noise but something that the model lacks.
_RATIOS = {
    NoiseSource.POSITION: (0.0, 0.03, 0.1, 0.25),
    NoiseSource.DIRECTION: (0.0, 0.05, 0.25),
    NoiseSource.RUN: (0.0, 0.015, 0.06),
    NoiseSource.TIME: (0.0, 0.03, 0.1, 0.25),
}


@dataclass(frozen=True, slots=True)
class NoisePart:
    """One source of shared scatter."""

    source: NoiseSource  #: What is shared.
    factor: FloatArray  #: (N, r): Z, scaled so that Z·Zᵀ has ones on its diagonal.

    @property
    def ratios(self) -> tuple[float, ...]:
        """The ratios φ that are tried, rising from zero."""
        return _RATIOS[self.source]


@dataclass(frozen=True, slots=True)
class Noise:
    """The noise of a test, as estimated."""

    sigma: float  #: σ, the repeatability of a single reading, m or rad.
    ratios: Mapping[NoiseSource, float]  #: φ_j by source; sources that the design cannot show are not there.
    weights: FloatArray  #: (N,): w, the variance of each reading over the mean one.

    @property
    def span(self) -> tuple[float, float]:
        """The least and the largest repeatability of a single reading, m or rad."""
        least, largest = np.sqrt([self.weights.min(), self.weights.max()]).tolist()
        return self.sigma * least, self.sigma * largest

    def compute_amount(self, source: NoiseSource) -> float:
        """Return the standard deviation σ·√φ of a source, m or rad."""
        return self.sigma * float(np.sqrt(self.ratios.get(source, 0.0)))


def list_noise_parts(design: Design) -> tuple[NoisePart, ...]:
    """Return the sources of shared scatter that the design can tell from that of single readings."""
    readings = len(design.position)
    if readings < _FEWEST_READINGS:
        return ()
    by_target = _make_membership(design.target)
    # What is irregular at one target is no scatter: it is its deviation, and its lost motion.
    is_irregular, parts = by_target.shape[1] > 1, []
    if is_irregular and _has_repeats(by_target):
        parts.append(NoisePart(NoiseSource.POSITION, by_target))
    by_cell = _make_membership(2 * design.target + (design.direction > 0))
    if is_irregular and design.is_bidirectional and _has_repeats(by_cell):
        signed = by_target * design.direction[:, np.newaxis]
        parts.append(NoisePart(NoiseSource.DIRECTION, signed))
    by_run = _make_membership(design.cycle)
    if by_run.shape[1] > 1 and _has_repeats(by_run):
        parts.append(NoisePart(NoiseSource.RUN, by_run))
    if design.duration > 0:
        parts.append(NoisePart(NoiseSource.TIME, _make_slow_drift(design)))
    return tuple(parts)


def make_ratio_grid(parts: Sequence[NoisePart]) -> FloatArray:
    """Return every combination of the ratios that are tried, shape (f, parts)."""
    return combine_levels([part.ratios for part in parts])


def make_coarse_grid(parts: Sequence[NoisePart]) -> FloatArray:
    """Return every combination of none and a middling ratio: where a continuous search may begin."""
    return combine_levels([(0.0, part.ratios[len(part.ratios) // 2]) for part in parts])


def combine_levels(levels: Sequence[Sequence[float]]) -> FloatArray:
    """Return every combination of one level of each source, shape (f, sources), the last varying fastest."""
    rows = list(product(*levels))
    return np.array(rows, dtype=np.float64).reshape(len(rows), len(levels))


def _make_membership(labels: IntArray) -> FloatArray:
    return np.asarray(labels[:, np.newaxis] == np.unique(labels), dtype=np.float64)


def split_by_session(design: Design, columns: FloatArray) -> FloatArray:
    """Return columns, shape (N, k), once for each session, zero in the others: what each has of its own."""
    own = design.session[:, np.newaxis] == np.unique(design.session)
    return np.asarray((own[:, :, np.newaxis] * columns[:, np.newaxis]).reshape(len(columns), -1))


def _has_repeats(membership: FloatArray) -> bool:
    """Whether most members of the groups have company: only then does a group show itself."""
    company = membership.sum(axis=0)
    return bool(company[company > 1].sum() > 0.5 * company.sum())


def _make_slow_drift(design: Design) -> FloatArray:
    """Return the leading eigenfunctions of the covariance exp(−|t − t'|/τ), as a factor of it."""
    time = compute_working_time(design)
    moment = (time - time.min()) / float(np.ptp(time))
    # On a grid, and by its interpolation at the readings: a test of thousands costs no more than a small one.
    grid, terms = _compute_drift_terms()
    factor = np.column_stack([np.interp(moment, grid, term) for term in terms])
    return split_by_session(design, factor / np.linalg.norm(factor, axis=1, keepdims=True))


@cache
def _compute_drift_terms() -> tuple[FloatArray, FloatArray]:
    """Return moments of a test of unit duration, shape (g,), and the eigenfunctions there, (terms, g)."""
    grid = np.linspace(0.0, 1.0, _DRIFT_MOMENTS)
    covariance = np.exp(-np.abs(grid[:, np.newaxis] - grid) / _MEMORY)
    values, functions = np.linalg.eigh(covariance)
    terms = functions[:, -_DRIFT_TERMS:] * np.sqrt(values[-_DRIFT_TERMS:])
    return read_only_floats(grid), read_only_floats(terms.T)
