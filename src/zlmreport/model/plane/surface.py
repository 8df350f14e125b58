"""Fits the surface of deviations over two axes: cubic terms, their coefficients, U anywhere.

M. Halaj, E. Kureková, R. Palenčár and T. Loebl, The positional deviation in two axes, equation (13):

    Δ = a + b₁·P + c₁·P² + d₁·P³ + b₂·R + c₂·R² + d₂·R³

The paper fits means of known variance; here single readings are fitted, with the noise that they show.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from zlmreport.language import same
from zlmreport.measurement.approach import Approach
from zlmreport.measurement.arrays import FloatArray, IntArray, read_only_floats, read_only_integers
from zlmreport.measurement.units import Unit
from zlmreport.model.diagnosis.error_numbers import LARGEST_RATIO, ErrorNumbers
from zlmreport.model.effects.axis_model import AxisModel, Term
from zlmreport.model.effects.design import Design, list_outside_of_measured, transform_to_position
from zlmreport.model.effects.effect import Dimension, Effect, Parameter, Shape
from zlmreport.model.effects.model_error import ModelError
from zlmreport.model.fitting.blunders import find_outliers
from zlmreport.model.fitting.estimate import InstrumentError, ParameterEstimate
from zlmreport.model.fitting.fit import Assumptions, Fit, Prediction, cross_validate, fit
from zlmreport.model.fitting.noise import NoiseSource, list_noise_parts
from zlmreport.model.fitting.observations import Observations, select_readings
from zlmreport.model.fitting.repeats import estimate_noise_floor

#: The condition under which a design holds the position of the second axis, m.
ACROSS = "position_of_second_axis"


@dataclass(frozen=True, slots=True)
class SurfaceLine:
    """A test of the axis at one position of the second axis."""

    across: float  #: R, the position of the second axis, m.
    observed: Observations  #: The readings, none set aside.

    def list_aside(self) -> IntArray:
        """Return the readings that stand off, by their places among those observed."""
        return find_outliers(self.observed.design, self.observed.deviation).readings


@dataclass(frozen=True, slots=True)
class SurfaceReadings:
    """The readings of all lines that approach from one side."""

    second: str  #: Name of the second axis.
    #: With R as the condition `ACROSS`. A target is a point of the plane: a line that is measured again
    #: shares its targets, but no two lines share a run.
    design: Design
    deviation: FloatArray  #: (N,): x, m.
    #: σ_f of a single reading, from the repeats within each line, m; None without repeats.
    noise_floor: float | None

    @property
    def across(self) -> FloatArray:
        """R of each reading, shape (N,), m."""
        return self.design.conditions[ACROSS]


def join_side_by_side(lines: Sequence[SurfaceLine], approach: Approach, second: str = "R") -> SurfaceReadings:
    """Return the readings of lines in one direction of approach, those that stand off set aside.

    `lines`: In any order.
    """
    kept = [_select_one_way(line, approach) for line in lines]
    designs = [each.design for each in kept]
    counts = [len(each.deviation) for each in kept]
    number = np.repeat(np.arange(len(kept), dtype=np.float64), counts)
    across = np.repeat([line.across for line in lines], counts)
    position = np.concatenate([design.position for design in designs])
    run = np.concatenate([design.run for design in designs])
    design = Design(
        axis=designs[0].axis,
        position=read_only_floats(position),
        direction=read_only_floats(np.full(len(number), float(approach))),
        run=_number_pairs(number, run) + 1,
        target=_number_pairs(across, position),
        time=read_only_floats(np.arange(len(number))),
        time_is_counted=True,
        since_reversal=read_only_floats(np.concatenate([each.since_reversal for each in designs])),
        conditions={ACROSS: read_only_floats(across)},
    )
    deviation = read_only_floats(np.concatenate([each.deviation for each in kept]))
    return SurfaceReadings(second, design, deviation, _pool_floors(kept))


def _make_points(readings: SurfaceReadings, along: FloatArray, across: FloatArray) -> Design:
    """Return a design that asks for points of the plane, each (M,), m."""
    design = readings.design
    none = np.zeros(len(along))
    return Design(
        axis=design.axis,
        position=along,
        direction=np.full(len(along), design.direction[0]),
        run=none.astype(np.int64),
        target=none.astype(np.int64),
        time=none,
        time_is_counted=True,
        since_reversal=none,
        conditions={ACROSS: across},
        span=design.span,
    )


def _select_one_way(line: SurfaceLine, approach: Approach) -> Observations:
    kept = line.observed.without(line.list_aside())
    chosen = np.flatnonzero(kept.design.direction == float(approach))
    return Observations(
        select_readings(kept.design, chosen),
        read_only_floats(kept.deviation[chosen]),
        read_only_integers(kept.reading[chosen]),
        kept.remarks,
    )


def _number_pairs(one: FloatArray, other: FloatArray | IntArray) -> IntArray:
    """Return numbers from 0 for the pairs of two values, the same for the same pair."""
    _, index = np.unique(np.stack([one, other]), axis=1, return_inverse=True)
    return read_only_integers(index.reshape(-1))


def _pool_floors(lines: Sequence[Observations]) -> float | None:
    floors = [estimate_noise_floor(each.design, each.deviation) for each in lines]
    known = [floor for floor in floors if floor is not None]
    return float(np.sqrt(np.mean(np.square(known)))) if known else None


#: The highest power of each position in equation (13).
CUBIC = 3


def list_coefficient_names(orders: tuple[int, int]) -> tuple[str, ...]:
    """Return the letters of equation (13), up to the orders: a, b1, c1, d1, b2, c2, d2."""
    letters = "bcd"
    return (
        "a",
        *(f"{letters[power]}{axis}" for axis, order in enumerate(orders, 1) for power in range(order)),
    )


class Powers(Effect):
    """The powers of both positions, each scaled to −1 … 1 of what was measured, without interaction.

    `orders`: Highest power along the axis, and across it.
    `across`: First and last position of the second axis, m.
    `interaction`: Whether the product of the two positions is added, which equation (13) leaves out.
    """

    identifier = "plane"
    title = same("Δ(P, R)")
    equation = "a + b_{1}·P + c_{1}·P² + d_{1}·P³ + b_{2}·R + c_{2}·R² + d_{2}·R³"
    shape = Shape.POSITION
    look = same("")

    def __init__(
        self, orders: tuple[int, int], across: tuple[float, float], *, interaction: bool = False
    ) -> None:
        self.orders = orders
        self.across = across
        self.interaction = interaction
        names = (*list_coefficient_names(orders), *(("interaction",) if interaction else ()))
        self.linear = tuple(Parameter(name, name, Dimension.DEVIATION, same(name)) for name in names)

    def columns(self, design: Design, theta: FloatArray) -> FloatArray:  # noqa: ARG002 - no θ
        """Return the powers at the points of a plane."""
        along = (design.position - design.middle) / (design.length / 2)
        first, last = self.across
        aside = (design.conditions[ACROSS] - (first + last) / 2) / ((last - first) / 2)
        powers = [np.vander(along, self.orders[0] + 1, increasing=True)]
        powers.append(np.vander(aside, self.orders[1] + 1, increasing=True)[:, 1:])
        if self.interaction:
            powers.append((along * aside)[:, np.newaxis])
        return np.concatenate(powers, axis=1)


@dataclass(frozen=True, slots=True)
class Coefficients:
    """The polynomial in powers of both positions, as equation (13) prints it."""

    orders: tuple[int, int]  #: Highest power of P, and of R.
    values: FloatArray  #: (1 + both orders,): a, b₁, c₁, d₁, b₂, c₂, d₂; SI: m, 1, m⁻¹, m⁻², …
    covariance: FloatArray  #: square: Of the values.

    @property
    def powers(self) -> tuple[tuple[int, int], ...]:
        """The powers of P and of R that each value stands before."""
        along, across = self.orders
        return (
            (0, 0),
            *((power, 0) for power in range(1, along + 1)),
            *((0, power) for power in range(1, across + 1)),
        )

    def in_units(self, position: Unit, deviation: Unit) -> Coefficients:
        """Return the values for positions and deviations in printed units."""
        degrees = np.array(self.powers, dtype=np.float64).sum(axis=1)
        scale = deviation.per_si / position.per_si**degrees
        return Coefficients(self.orders, self.values * scale, self.covariance * np.outer(scale, scale))


@dataclass(frozen=True, slots=True)
class Surface:
    """The deviation over the plane for one direction of approach."""

    approach: Approach  #: The direction.
    readings: SurfaceReadings  #: What was fitted.
    fit: Fit  #: The model, with scaled positions.
    powers: Powers  #: Its one effect.
    error: ErrorNumbers  #: How far the readings are from it.
    #: The product of both positions, when it is added: the deviation at the corners of the plane that
    #: equation (13) has no term for, m.
    interaction: ParameterEstimate

    @property
    def missed(self) -> float:
        """What the polynomial misses of what the lines show beyond their scatter, root mean square, m.

        0 where the error is no larger than that scatter, or nothing tells it.
        """
        error = self.error
        if error.chi2_per_dof is None or error.noise_rms is None or error.chi2_per_dof <= LARGEST_RATIO:
            return 0.0
        return math.sqrt(max(0.0, error.rms**2 - error.noise_rms**2))

    @property
    def along(self) -> tuple[float, float]:
        """First and last measured position of the axis, m."""
        return self.fit.design.span

    @property
    def across(self) -> tuple[float, float]:
        """First and last line, m."""
        return self.powers.across

    def predict(self, places: Sequence[tuple[float, float]]) -> Prediction:
        """Return the deviation at points of the plane, measured or not.

        `places`: P and R of each, m.

        Raises `ModelError` if a point lies outside what was measured: a polynomial knows nothing there.
        """
        along, across = np.array(places, dtype=np.float64).reshape(-1, 2).T
        axis = self.fit.design.axis
        sentences = [
            *list_outside_of_measured(axis.name, axis.position_unit, along, self.along),
            *list_outside_of_measured(self.readings.second, axis.position_unit, across, self.across),
        ]
        if sentences:
            raise ModelError(sentences)
        return self.fit.predict(_make_points(self.readings, along, across))

    def compute_coefficients(self) -> Coefficients:
        """Return the polynomial in powers of P and R themselves."""
        turn = _to_powers(self.powers.orders, self.along, self.across)
        gamma = self.fit.solution.coefficients[0]
        return Coefficients(
            self.powers.orders, turn @ gamma, turn @ self.fit.uncertainties.covariance @ turn.T
        )


def fit_surface(readings: SurfaceReadings, instrument: InstrumentError) -> Surface:
    """Fit equation (13) to the lines of a plane.

    The orders are 3, or less by one than the number of positions or lines where these are fewer than four.

    Raises `ModelError` if the points do not determine the coefficients.
    """
    design = readings.design
    lines = np.unique(readings.across)
    if len(lines) < 2 or len(design.target_positions) < 2:
        raise ModelError(["a plane needs two lines at least, and two positions on them"])
    orders = (min(CUBIC, len(design.target_positions) - 1), min(CUBIC, len(lines) - 1))
    powers = Powers(orders, (float(lines[0]), float(lines[-1])))
    # Nobody states when a line was measured after the other, so no drift is taken to run through all of them.
    parts = tuple(part for part in list_noise_parts(design) if part.source is not NoiseSource.TIME)
    assumed = Assumptions(instrument=instrument, parts=parts)
    fitted = _fit(powers, readings, assumed)
    crossed = Powers(orders, powers.across, interaction=True)
    return Surface(
        Approach(int(design.direction[0])),
        readings,
        fitted,
        powers,
        _compute_error(fitted, readings.noise_floor),
        _fit(crossed, readings, assumed).estimates[-1],
    )


def _fit(powers: Powers, readings: SurfaceReadings, assumed: Assumptions) -> Fit:
    try:
        return fit(AxisModel((Term(powers),)), readings.design, readings.deviation, assumed)
    except ModelError as error:
        sentence = (
            f"the {len(readings.deviation)} readings do not determine the {len(powers.linear)} coefficients; "
            "measure the same positions on every line, and more than one run"
        )
        raise ModelError([sentence]) from error


def _compute_error(fitted: Fit, floor: float | None) -> ErrorNumbers:
    return ErrorNumbers(
        fitted.rms,
        floor,
        (fitted.rms / floor) ** 2 if floor else None,
        cross_validate(fitted.model, fitted.design, fitted.deviation, fitted.solution.thetas),
    )


def _to_powers(
    orders: tuple[int, int], along: tuple[float, float], across: tuple[float, float]
) -> FloatArray:
    """Return T with T·(scaled coefficients) = coefficients of P and R themselves."""
    turn = np.zeros((1 + sum(orders), 1 + sum(orders)))
    turn[0, 0] = 1.0
    first = 1
    for order, span in zip(orders, (along, across), strict=True):
        own = slice(first, first + order)
        turn[0, own], turn[own, own] = np.split(transform_to_position(order, span)[:, 1:], [1])
        first += order
    return turn
