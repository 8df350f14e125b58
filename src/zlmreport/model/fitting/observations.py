"""From a measurement set to the fit's input: overrun, smoothed logs, readings thinned, doubts about logs."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from zlmreport.language import Words, same
from zlmreport.measurement.arrays import FloatArray, IntArray, read_only_floats, read_only_integers
from zlmreport.measurement.axis import find_usual_overrun
from zlmreport.measurement.measurement_set import CONDITIONS, MeasurementSet
from zlmreport.measurement.units import write_behind
from zlmreport.model.effects.design import Design
from zlmreport.model.effects.model_error import ModelError
from zlmreport.model.effects.readings import LOGS_OF_AIR

#: Noise of a log, as a share of its variation, from which on effects cannot be told by it.
_NOISY = 0.2
#: The largest such share that is told as a number: the variation is next to nothing beyond it.
_MOST_NOISE = 10
#: Resolution of a log, as a share of its range, from which on its steps show.
_COARSE = 0.1
#: Share of a log that may be missing for the rest to tell it, and gaps that are named.
_MOST_GAPS, _NAMED_GAPS = 0.1, 5

_COUNTED = Words(
    "Not every reading has a time: the readings are taken to follow one another in equal steps, and time "
    "constants are counted in readings."
)
_OVERRUN = Words("The axis is taken to run over a target by {overrun}{unit} before it returns to it.")
_GAPS = Words("The log of {condition} has gaps (readings without it: {count}) and is left out.")
_FILLED = Words(
    "The log of {condition} has gaps (readings without it: {count}); for the model they are interpolated "
    "in time. Readings in the order of the file: {rows}."
)
_NOISE = Words(
    "The log of {condition} is noisy: its noise is {share} times its variation. Effects that follow it may "
    "be taken for others."
)
_RESOLUTION = Words("The log of {condition} is coarse: its resolution is {share} of its range.")
_DRY = Words(
    "No relative humidity was logged: where an effect follows the air's index, it is taken to stay as it is."
)
_DEGREE = 3
_MOST_INTERVALS = 40
_READINGS_PER_INTERVAL = 4
_STIFFNESSES = np.logspace(-6, 8, 71)


_THINNED = Words("The model is held against {kept} of the {all} target positions, spread over the travel.")
#: Target positions with which a model is compared at most.
MOST_TARGETS = 210
_GOLDEN = (5.0**0.5 - 1.0) / 2.0


@dataclass(frozen=True, slots=True)
class Observations:
    """What the error model works on."""

    design: Design  #: The readings that are there, but for their deviations.
    deviation: FloatArray  #: (N,): x, m or rad; no NaN.
    reading: IntArray  #: (N,) integer: The place of each among all readings of the measurement set.
    remarks: tuple[Words, ...]  #: What was assumed, and what was left out.

    def without(self, readings: IntArray) -> Observations:
        """Return the observations without some readings, named by their places here."""
        kept = np.setdiff1d(np.arange(len(self.deviation)), readings)
        return Observations(
            select_readings(self.design, kept),
            read_only_floats(self.deviation[kept]),
            read_only_integers(self.reading[kept]),
            self.remarks,
        )


def thin(observed: Observations) -> Observations:
    """Return the observations of so many targets as a comparison can hold, spread over the whole travel.

    What thousands of targets say of causes, two hundred say as well, in a fraction of the time. One is taken
    from each of so many stretches, at uneven places: every tenth of even targets might lie at one phase of
    the pitch.
    """
    targets = np.unique(observed.design.target)
    if len(targets) <= MOST_TARGETS:
        return observed
    stretches = np.arange(MOST_TARGETS)
    places = (stretches + (stretches * _GOLDEN) % 1.0) * len(targets) / MOST_TARGETS
    kept = targets[places.astype(np.int64)]
    found = observed.without(np.flatnonzero(~np.isin(observed.design.target, kept)))
    remark = _THINNED.given(all=len(targets), kept=len(kept))
    return replace(found, remarks=(*found.remarks, remark))


def make_observations_of(measurements: MeasurementSet, *, overrun: float | None = None) -> Observations:
    """Return what the error model works on; missing readings are dropped, the order is kept.

    `measurements`: The readings, in the order in which they were taken.
    `overrun`: How far the axis runs over a target before it returns to it, m or rad; what is usual where it
        is not known.

    Raises `ModelError` if every reading is missing.
    """
    axis = measurements.axis
    beyond = find_usual_overrun(axis) if overrun is None else overrun
    position = measurements.target_positions[measurements.target]
    direction = measurements.approach.astype(np.float64)
    present = np.flatnonzero(~np.isnan(measurements.deviation))
    if not present.size:
        raise ModelError(["no reading has a deviation; there is nothing to fit"])
    remarks = []
    time = measurements.time
    counted = time is None or bool(np.any(np.isnan(time[present])))
    if time is None or counted:
        time = np.arange(len(position), dtype=np.float64)
        remarks.append(_COUNTED)
    if overrun is None:
        unit = axis.position_unit
        remarks.append(_OVERRUN.given(overrun=unit.from_si(beyond), unit=write_behind(unit.symbol)))
    moments = time[present] - time[present[0]]
    conditions = {}
    for name, log in measurements.conditions.items():
        values = log[present]
        missing = np.isnan(values)
        gaps = int(np.count_nonzero(missing))
        if gaps > _MOST_GAPS * len(values):
            remarks.append(_GAPS.given(condition=name, count=gaps))
            continue
        if gaps:
            values = np.where(missing, np.interp(moments, moments[~missing], values[~missing]), values)
            rows = ", ".join(str(row + 1) for row in present[missing][:_NAMED_GAPS].tolist())
            more = ", …" if gaps > _NAMED_GAPS else ""
            remarks.append(_FILLED.given(condition=name, count=gaps, rows=rows + more))
        if name in CONDITIONS:
            smooth = smooth_log(moments, values)
            remarks.extend(_find_doubts(name, values, smooth.noise, smooth.variation))
            values = smooth.values
        conditions[name] = read_only_floats(values)
    if "relative_humidity" not in conditions and conditions.keys() >= {*LOGS_OF_AIR}:
        remarks.append(_DRY)
    design = Design(
        axis=axis,
        position=read_only_floats(position[present]),
        direction=read_only_floats(direction[present]),
        run=read_only_integers(measurements.run[present]),
        target=read_only_integers(measurements.target[present]),
        time=read_only_floats(moments),
        time_is_counted=counted,
        since_reversal=read_only_floats(_measure_since_reversal(position, direction, beyond)[present]),
        conditions=conditions,
    )
    return Observations(
        design, read_only_floats(measurements.deviation[present]), read_only_integers(present), tuple(remarks)
    )


def select_readings(design: Design, readings: IntArray) -> Design:
    """Return the design of some of its readings; the span of the travel stays."""
    return replace(
        design,
        position=read_only_floats(design.position[readings]),
        direction=read_only_floats(design.direction[readings]),
        run=read_only_integers(design.run[readings]),
        target=read_only_integers(design.target[readings]),
        time=read_only_floats(design.time[readings]),
        since_reversal=read_only_floats(design.since_reversal[readings]),
        conditions={name: read_only_floats(log[readings]) for name, log in design.conditions.items()},
        rates={name: read_only_floats(rate[readings]) for name, rate in design.rates.items()},
        session=read_only_integers(design.session[readings]),
    )


def select_of_the_job(observed: Observations) -> Observations:
    """Return the readings of the job's own session."""
    return observed.without(np.flatnonzero(observed.design.session > 0))


def _measure_since_reversal(position: FloatArray, direction: FloatArray, overrun: float) -> FloatArray:
    """Return the distance travelled since the last reversal, from the order of the rows.

    A target that lies ahead of the one before it is approached straight; then the axis has turned either
    there, or before. Any other is run over first.
    """
    travelled = np.full(len(position), overrun)
    for row in range(1, len(position)):
        ahead = (position[row] - position[row - 1]) * direction[row]
        if ahead > 0:
            straight = direction[row] == direction[row - 1]
            travelled[row] = ahead + (travelled[row - 1] if straight else 0.0)
    return travelled


def _find_doubts(name: str, log: FloatArray, noise: float, variation: float) -> Iterator[Words]:
    """Yield what makes a log doubtful."""
    if noise > _NOISY * variation:
        is_beyond = noise > _MOST_NOISE * variation
        share = same(f"> {_MOST_NOISE}") if is_beyond else round(noise / variation, 1)
        yield _NOISE.given(condition=same(name), share=share)
    steps = np.diff(np.unique(log))
    if steps.size and steps.min() > _COARSE * np.ptp(log):
        yield _RESOLUTION.given(condition=same(name), share=round(float(steps.min() / np.ptp(log)), 2))


@dataclass(frozen=True, slots=True)
class Smoothed:
    """A log, smoothed."""

    values: FloatArray  #: (N,): The smooth course at the readings, in the unit of the log.
    noise: float  #: Standard deviation of the log about it.
    variation: float  #: Standard deviation of the smooth course itself.


def smooth_log(moments: FloatArray, log: FloatArray) -> Smoothed:
    """Return a log without its noise.

    `moments`, (N,): When it was logged; any unit, not falling.
    `log`, (N,): The values; complete.
    """
    extent = float(np.ptp(moments))
    intervals = min(_MOST_INTERVALS, len(log) // _READINGS_PER_INTERVAL)
    if extent == 0 or intervals < 2 or np.ptp(log) == 0:
        return Smoothed(log, 0.0, float(np.std(log)))
    basis = _compute_splines((moments - moments[0]) / extent, intervals)
    penalty = np.diff(np.eye(basis.shape[1]), 2, axis=0)
    # In the basis that makes both the fit and the penalty diagonal, all stiffnesses are tried at once.
    gram = basis.T @ basis + 1e-10 * len(log) * np.eye(basis.shape[1])
    inverse = np.linalg.inv(np.linalg.cholesky(gram))
    bending, turn = np.linalg.eigh(inverse @ (penalty.T @ penalty) @ inverse.T)
    orthonormal = basis @ inverse.T @ turn
    mean = float(np.mean(log))
    coefficients = orthonormal.T @ (log - mean)
    shrinkage = 1.0 / (1.0 + _STIFFNESSES[:, np.newaxis] * np.maximum(bending, 0.0))
    curves = mean + (shrinkage * coefficients) @ orthonormal.T
    squares = np.sum((log - curves) ** 2, axis=1)
    free = len(log) - shrinkage.sum(axis=1)
    best = int(np.argmin(squares / free**2))
    noise = float(np.sqrt(squares[best] / free[best]))
    return Smoothed(curves[best], noise, float(np.std(curves[best])))


def _compute_splines(where: FloatArray, intervals: int) -> FloatArray:
    """Return the cubic B-splines over equal intervals of 0 to 1, shape (N, intervals + 3)."""
    step = 1.0 / intervals
    knots = (np.arange(intervals + 2 * _DEGREE + 1) - _DEGREE) * step
    inside = np.minimum(where, 1.0 - 1e-12)[:, np.newaxis]
    values = ((inside >= knots[:-1]) & (inside < knots[1:])).astype(np.float64)
    for degree in range(1, _DEGREE + 1):
        rising = (inside - knots[: -degree - 1]) / (degree * step)
        falling = (knots[degree + 1 :] - inside) / (degree * step)
        values = rising * values[:, :-1] + falling * values[:, 1:]
    return values
