"""Simulates what rival effects would do in a planned test."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from zlmreport.measurement.arrays import FloatArray, read_only_floats, read_only_integers
from zlmreport.measurement.axis import Axis
from zlmreport.model.effects.axis_model import AxisModel
from zlmreport.model.effects.design import Design
from zlmreport.model.effects.effect import Effect
from zlmreport.model.fitting.contrasts import make_contrasts_of
from zlmreport.model.fitting.fit import Fit
from zlmreport.model.fitting.noise import NoisePart, NoiseSource, list_noise_parts, make_ratio_grid
from zlmreport.model.fitting.observations import Observations
from zlmreport.model.fitting.sessions import SessionZeros, join_sessions
from zlmreport.model.planning.plan import AxisPlan, ExpectedTest
from zlmreport.model.planning.visibility import expect_design, list_logs_of

#: Share of the coefficients that shrinking must leave.
_STANDS_OUT = 0.5
#: Noises that stand for all that readings leave open.
_SCATTERS = 8


@dataclass(frozen=True, slots=True)
class PossibleNoise:
    """A noise that may be that of the axis."""

    sigma: float  #: Repeatability of single readings, m or rad.
    ratios: Mapping[NoiseSource, float]  #: φ of the other sources of scatter.


def list_possible_scatters(after: Fit) -> tuple[PossibleNoise, ...]:
    """Return noises that readings leave open beside a model, each as likely as any other of them.

    They lie evenly in what restricted likelihood says of the ratios φ that noise may have.
    """
    parts = list_noise_parts(after.design)
    space = make_contrasts_of(after.compute_base(), parts, after.noise.weights)
    criterion, grid = space.make_criterion(space.of(after.open_deviation)), make_ratio_grid(parts)
    criteria, squares = np.transpose([criterion(ratios) for ratios in grid])
    likelihoods = np.cumsum(np.exp(-0.5 * (criteria - criteria.min())))
    places = np.searchsorted(likelihoods, likelihoods[-1] * (np.arange(_SCATTERS) + 0.5) / _SCATTERS)
    sigmas = np.sqrt(squares / space.degrees)
    sources = [part.source for part in parts]
    return tuple(
        PossibleNoise(float(sigmas[place]), dict(zip(sources, grid[place].tolist(), strict=True)))
        for place in places
    )


@dataclass(frozen=True, slots=True)
class Rival:
    """An effect that may be the true one."""

    effect: Effect  #: In one form.
    probability: float  #: That it is.
    #: theta and gamma: (s,), (k,): Its searched and linear parameters, SI; empty γ where no readings tell
    #: them.
    theta: FloatArray
    gamma: FloatArray
    root: FloatArray  #: (k + s, k + s): A factor of their covariance.
    #: (s,): Half-widths of the intervals of searched parameters that are known among the values of a grid.
    widths: FloatArray
    scatters: tuple[
        PossibleNoise, ...
    ] = ()  #: Noises that it leaves open, each as likely; none without readings.
    size: float = 0.0  #: Where no readings tell its parameters: its root mean square value, m or rad.
    kept: float = 1.0  #: What the shrinking left of its coefficients, 0 to 1.

    @property
    def stands_out(self) -> bool:
        """Whether its estimate is more than chance."""
        return self.kept > _STANDS_OUT

    @classmethod
    def of_fit(cls, after: Fit, probability: float) -> Rival:
        """Return the last effect of a fitted model.

        What stands out little is overestimated where it was chosen for its size: its coefficients are
        shrunk as W. James and C. Stein have it, by 1 − k/χ².
        """
        index = len(after.model.terms) - 1
        term = after.model.terms[index]
        count = len(after.uncertainties.inverse)
        last = count - len(after.places)
        first = last - int(np.count_nonzero(term.is_solved))
        gamma = after.solution.coefficients[index]
        places = [(number, place.column) for number, place in enumerate(after.places) if place.term == index]
        own = np.array([*range(first, last), *(last + number for number, _ in places)], dtype=np.int64)
        covariance = after.uncertainties.sigma**2 * after.uncertainties.inverse[np.ix_(own, own)]
        values, vectors = np.linalg.eigh(covariance)
        rows = [*range(len(gamma)), *(len(gamma) + column for _, column in places)]
        root = np.zeros((len(gamma) + len(term.effect.searched), len(own)))
        root[rows] = vectors * np.sqrt(np.maximum(values, 0.0))
        kept = 1.0
        if not term.effect.contains:
            square = float(gamma @ np.linalg.pinv(covariance[: len(gamma), : len(gamma)]) @ gamma)
            kept = max(0.0, 1.0 - len(gamma) / square) if square else 0.0
        # The last effect's estimates are the last ones, those of its searched parameters at the end.
        estimates = after.estimates[len(after.estimates) - len(term.effect.searched) :]
        widths = np.array([each.expanded_uncertainty * each.is_scanned for each in estimates])
        theta, scatters = after.solution.thetas[index], list_possible_scatters(after)
        return cls(term.effect, probability, theta, kept * gamma, root, widths, scatters, kept=kept)

    @classmethod
    def of_size(
        cls, effect: Effect, probability: float, size: float, scatters: tuple[PossibleNoise, ...] = ()
    ) -> Rival:
        """Return an effect of which nothing but its size can be said."""
        nothing = np.empty(0)
        return cls(effect, probability, nothing, nothing, np.empty((0, 0)), nothing, scatters, size)

    def sample_deviation(
        self, design: Design, grid: FloatArray, generator: np.random.Generator
    ) -> FloatArray:
        """Return what it would do in a test, drawn at random, shape (N,), m or rad."""
        if not self.gamma.size:
            columns = self.effect.columns(design, grid[generator.integers(len(grid))])
            lengths = np.std(columns, axis=0)
            gamma = generator.standard_normal(columns.shape[1]) / np.where(lengths > 0, lengths, 1.0)
            gamma = gamma * (self.size / (float(np.std(columns @ gamma)) or 1.0))
            return columns @ _bring_into_possible(gamma, self.effect)
        drawn = self.root @ generator.standard_normal(self.root.shape[1])
        within = self.widths * generator.uniform(-1.0, 1.0, len(self.widths))
        theta = self.theta + drawn[len(self.gamma) :] + within
        extent = np.ptp(grid, axis=0)
        distances = (grid - theta) / np.where(extent > 0, extent, 1.0)
        nearest = grid[int(np.argmin(np.sum(distances**2, axis=1)))]
        return self.effect.columns(design, nearest) @ (self.gamma + drawn[: len(self.gamma)])


def _bring_into_possible(gamma: FloatArray, effect: Effect) -> FloatArray:
    """Return coefficients with possible signs, all brought down until none is larger than is plausible."""
    share, signed = 1.0, gamma.copy()
    for index, parameter in enumerate(effect.linear):
        low = -np.inf if parameter.smallest is None else parameter.smallest
        high = np.inf if parameter.largest is None else parameter.largest
        if low >= 0 or high <= 0:
            signed[index] = abs(gamma[index]) * (1.0 if low >= 0 else -1.0)
        limit = high if signed[index] > 0 else -low
        share = min(share, limit / abs(signed[index])) if signed[index] else share
    return signed * share


@dataclass(frozen=True, slots=True)
class Question:
    """Which of several effects it is, or whether it is one."""

    #: axis and model: The axis, and the effects beside which they stand.
    axis: Axis
    model: AxisModel
    base: Callable[[Design], FloatArray]  #: Returns what the model can imitate in a test, shape (N, p).
    rivals: tuple[Rival, ...]  #: The effects in question.
    #: sigma and degrees: Repeatability of single readings, m or rad, and how well it is known.
    sigma: float
    degrees: int
    ratios: Mapping[NoiseSource, float]  #: φ of the other sources of scatter.
    known: float = 0.0  #: Standard deviation of a noise of known size beside σ, m or rad.
    #: The readings that leave it open, as the model sees them; None if there are none.
    first: Observations | None = None

    @property
    def names(self) -> tuple[str, ...]:
        """Identifiers of the effects in question."""
        return tuple(rival.effect.identifier for rival in self.rivals)

    @property
    def may_go_on(self) -> bool:
        """Whether a second session can be held together with the readings that leave it open."""
        design = None if self.first is None else self.first.design
        return design is not None and not design.time_is_counted and not design.session.any()

    def make_design(self, plan: AxisPlan, expected: ExpectedTest) -> Design:
        """Return a plan as effects see it; the readings of a first session stand below its own."""
        own = self.make_next_design(plan, expected)
        if self.first is None or plan.after is None:
            return own
        count = len(own.position)
        planned = Observations(
            own, read_only_floats(np.zeros(count)), read_only_integers(np.arange(count)), ()
        )
        return replace(join_sessions(planned, [("", self.first)]).design, span=own.span)

    def make_next_design(self, plan: AxisPlan, expected: ExpectedTest) -> Design:
        """Return a plan by itself, with the logs of the test and those that the rivals ask for.

        What was logged begins as it did then.
        """
        design = expect_design(self.axis, plan, expected)
        if self.first is None:
            return design
        first = self.first.design
        conditions = {name: design.conditions[name] for name in self.list_logs(design)}
        for name, log in first.conditions.items():
            course = design.conditions.get(name, log[:1])
            change = plan.after.compute_change(name) if plan.after else 0.0
            begun = course - course[0] + log[0] + change
            conditions[name] = read_only_floats(np.broadcast_to(begun, len(design.position)))
        # A test of one target has no travel of which a place could be a share.
        span = first.span if first.length > 0 else design.span
        return replace(design, conditions=conditions, span=span)

    def compute_columns(self, design: Design) -> FloatArray:
        """Return what model and set-up can imitate: each session has a zero of its own."""
        zeros = SessionZeros(int(design.session.max()) + 1)
        return np.concatenate([zeros.columns(design, np.empty(0)), self.base(design)], axis=1)

    def list_logs(self, design: Design) -> tuple[str, ...]:
        """Return the columns that the effects in question ask for."""
        asked = (name for rival in self.rivals for name in list_logs_of(rival.effect, design))
        return tuple(name for name in dict.fromkeys(asked) if name in design.conditions)

    def simulate_readings(
        self,
        design: Design,
        parts: Sequence[NoisePart],
        rival: Rival,
        sets: int,
        generator: np.random.Generator,
    ) -> FloatArray:
        """Return tests that have one of the rivals as the truth, simulated, shape (N, sets), m or rad.

        A first session is as it was: model and noise of the second are drawn from what its readings leave
        open once the rival is taken away.
        """
        scatters = rival.scatters or (PossibleNoise(self.sigma, self.ratios),)
        turns = np.arange(sets) % len(scatters)
        spread = np.sqrt(self.degrees / generator.chisquare(self.degrees, sets))
        sigma = np.array([each.sigma for each in scatters])[turns] * spread
        noise = generator.standard_normal((len(design.position), sets))
        for part in parts:
            roots = np.sqrt([each.ratios.get(part.source, 0.0) for each in scatters])[turns]
            noise += part.factor @ (roots * generator.standard_normal((part.factor.shape[1], sets)))
        noise *= sigma
        grid = rival.effect.grid(design)
        true = np.column_stack([rival.sample_deviation(design, grid, generator) for _ in range(sets)])
        if self.first is None or not design.session.any():
            return true + noise
        readings = np.empty_like(true)
        for turn, scatter in enumerate(scatters):
            own = np.flatnonzero(turns == turn)
            if own.size:
                shared = [np.sqrt(scatter.ratios.get(part.source, 0.0)) * part.factor for part in parts]
                unit = sigma[own] * generator.standard_normal((np.count_nonzero(design.session), len(own)))
                readings[:, own] = self._simulate_second_session(
                    design, shared, true[:, own], noise[:, own], unit
                )
        return readings

    def _simulate_second_session(
        self,
        design: Design,
        shared: Sequence[FloatArray],
        true: FloatArray,
        noise: FloatArray,
        unit: FloatArray,
    ) -> FloatArray:
        """Return readings of a second session below those of the first, which stay, shape (N, B).

        `shared`: Factors of the covariance of what scatters, in units of σ.
        `true`, `noise`, (N, B): What the rival does, and what scatters.
        `unit`: Scatter of the first session's whitened readings.
        """
        before, own = np.flatnonzero(design.session), np.flatnonzero(design.session == 0)
        covariance = np.eye(len(before)) + sum(factor[before] @ factor[before].T for factor in shared)
        across = sum((factor[own] @ factor[before].T for factor in shared), np.zeros((len(own), len(before))))
        whiten, base = np.linalg.inv(np.linalg.cholesky(covariance)), self.base(design)
        assert self.first is not None  # noqa: S101 - the caller has seen to it
        left = self.first.deviation[:, np.newaxis] - true[before]
        coefficients = np.linalg.lstsq(whiten @ base[before], whiten @ left + unit, rcond=None)[0]
        irregular = left - base[before] @ coefficients - noise[before]
        kriged = across @ (whiten.T @ (whiten @ irregular))
        own_readings = true[own] + base[own] @ coefficients + noise[own] + kriged
        return np.concatenate([own_readings, np.tile(self.first.deviation[:, np.newaxis], unit.shape[1])])
