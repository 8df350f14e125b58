"""The design of a test without its deviations: positions, directions, times, conditions by reading.

The design is known before anything is measured, so the same value serves the fit of a test, the simulation
of one, and the question what a planned test would be able to see.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from zlmreport.measurement.approach import Approach
from zlmreport.measurement.arrays import FloatArray, IntArray, read_only_floats, read_only_integers
from zlmreport.measurement.axis import Axis
from zlmreport.measurement.units import Unit, write_behind

_OF_THE_READINGS = (math.nan, math.nan)
_ROUNDING = 1e-12
_ARRAYS = ("position", "direction", "run", "target", "time", "since_reversal", "session")


@dataclass(frozen=True, slots=True)
class Design:
    """The readings of a test in the order in which they are taken, but for their deviations.

    Attributes
    ----------
    axis
        The axis under test, with its known periods and tables.
    position : (N,) array
        Target position P of each reading, m or rad.
    direction : (N,) array
        +1.0 for the positive approach, −1.0 for the negative.
    run : (N,) integer array
        Number of the run in its session, from 1.
    target : (N,) integer array
        Index of the target position.
    time : (N,) array
        From the first reading of its session, s; where the source tells no times, the number of the reading.
    time_is_counted
        True where `time` counts readings instead of seconds: time constants then come in readings.
    since_reversal : (N,) array
        Distance travelled since the last reversal of direction, m or rad.
    conditions : mapping of name to (N,) array
        Logged conditions, SI; complete (no NaN) and smoothed where they are noisy.
    span
        First and last position of the measured travel, m or rad; those of the readings if it is not given.
        ``dataclasses.replace`` keeps it, so that a design which asks for other positions (a prediction, a
        second test) still means the travel on which the parameters were estimated.
    rates : mapping of name to (N,) array
        What each logged condition changes by, SI per s (or per reading): of the log over the whole session,
        so that some of its readings have the rates that they have among all.
    session : (N,) integer array
        Which test of the axis each reading is of, where several are held together; 0, the job's own, where
        nothing is given.
    """

    axis: Axis
    position: FloatArray
    direction: FloatArray
    run: IntArray
    target: IntArray
    time: FloatArray
    time_is_counted: bool
    since_reversal: FloatArray
    conditions: Mapping[str, FloatArray] = field(default_factory=dict)
    rates: Mapping[str, FloatArray] = field(default_factory=dict)
    span: tuple[float, float] = _OF_THE_READINGS
    session: IntArray = field(default_factory=lambda: np.empty(0, dtype=np.int64))

    def __post_init__(self) -> None:
        """Take the span from the readings where none is given; let no effect alter the arrays."""
        if len(self.session) != len(self.position):  # other readings are asked for, of one session
            object.__setattr__(self, "session", np.zeros(len(self.position), dtype=np.int64))
        for name in _ARRAYS:
            if (array := getattr(self, name)).flags.writeable:
                object.__setattr__(self, name, array := array.view())
                array.setflags(write=False)
        if self.span is _OF_THE_READINGS:
            object.__setattr__(self, "span", (float(self.position.min()), float(self.position.max())))
        if any(len(self.rates.get(name, ())) != len(self.position) for name in self.conditions):
            rates = {
                name: _compute_rate(log, self.time, self.session) for name, log in self.conditions.items()
            }
            object.__setattr__(self, "rates", rates)

    @property
    def length(self) -> float:
        """The measured travel, m or rad."""
        first, last = self.span
        return last - first

    @property
    def middle(self) -> float:
        """The middle of the measured travel, m or rad."""
        first, last = self.span
        return (first + last) / 2

    @property
    def duration(self) -> float:
        """The time from the first to the last reading, s (or readings)."""
        return float(self.time.max() - self.time.min())

    @property
    def target_positions(self) -> FloatArray:
        """The distinct target positions, rising, m or rad."""
        return np.unique(self.position)

    @property
    def cycle(self) -> IntArray:
        """The number of each run among those of all sessions: those of a later one count on, shape (N,)."""
        runs = [0, *(int(self.run[self.session == each].max()) for each in range(self.session.max()))]
        return np.asarray(np.cumsum(runs)[self.session] + self.run, dtype=np.int64)

    @property
    def is_bidirectional(self) -> bool:
        """Whether targets are approached from both directions."""
        return bool(self.direction.min() < 0 < self.direction.max())


def _compute_rate(log: FloatArray, time: FloatArray, session: IntArray) -> FloatArray:
    """Return what a log changes by in time, within each session; zero where no time passes."""
    found = np.zeros(len(log))
    for each in np.unique(session):
        own = np.flatnonzero(session == each)
        moments, place = np.unique(time[own], return_inverse=True)
        if len(moments) > 1:
            course = np.bincount(place, log[own]) / np.bincount(place)
            found[own] = np.gradient(course, moments)[place]
    return read_only_floats(found)


def place_at_positions(design: Design, positions: FloatArray, approach: Approach) -> Design:
    """Return the design of one approach to positions, all else being as it was in the mean of the job's test.

    `positions`, (M,): Within its travel, m or rad.
    """
    count = len(positions)
    own = design.session == 0
    of_approach = np.flatnonzero((design.direction == approach) & own)
    order = of_approach[np.argsort(design.position[of_approach], kind="stable")]
    targets, first = np.unique(design.position[order], return_index=True)
    travelled = np.add.reduceat(design.since_reversal[order], first) / np.diff([*first, len(order)])
    return replace(
        design,
        position=read_only_floats(positions),
        direction=read_only_floats(np.full(count, float(approach))),
        run=read_only_integers(np.full(count, int(np.median(design.run[own])))),
        target=read_only_integers(np.arange(count)),
        time=read_only_floats(np.full(count, design.time[own].mean())),
        since_reversal=read_only_floats(np.interp(positions, targets, travelled)),
        conditions={
            name: read_only_floats(np.full(count, log[own].mean())) for name, log in design.conditions.items()
        },
        rates={
            name: read_only_floats(np.full(count, rate[own].mean())) for name, rate in design.rates.items()
        },
        session=read_only_integers(np.zeros(count)),
    )


def list_outside_of_measured(
    name: str, unit: Unit, positions: FloatArray, span: tuple[float, float]
) -> list[str]:
    """Return a sentence on each position at which nothing may be said: a model knows nothing beyond its data.

    `positions`, (M,): m or rad.
    `span`: First and last position that was measured, m or rad.
    """
    first, last = (unit.from_si(end) for end in span)
    # Positions come in decimal units: an end itself may be off by a rounding.
    slack = _ROUNDING * max(map(abs, span))
    behind = write_behind(unit.symbol)
    return [
        f"{name} = {unit.from_si(position):g}{behind} lies outside of what was measured, "
        f"{first:g} to {last:g}{behind}"
        for position in positions.tolist()
        if not span[0] - slack <= position <= span[1] + slack
    ]


def transform_to_position(order: int, span: tuple[float, float]) -> FloatArray:
    """Return T with T·c = coefficients of 1, P, P² …, where c are those of p, which is −1 … 1 over the span.

    `span`: First and last position, m or rad.
    """
    middle, half = (span[0] + span[1]) / 2, (span[1] - span[0]) / 2
    turn = np.zeros((order + 1, order + 1))
    for power in range(order + 1):
        for lower in range(power + 1):
            turn[lower, power] = math.comb(power, lower) * (-middle) ** (power - lower) / half**power
    return turn
