"""Makes the plan of a test and its defaults: targets, method, feed, dwell, runs; named as assumed.

Targets and runs are as few as meet the requirements of the standards, and what custom adds. What a plan sees
of an effect depends on the course of its condition, not on its size: conditions that nobody has measured yet
get a plausible course.
"""

from __future__ import annotations

import hashlib
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from zlmreport.errors import InputError, count_in_words
from zlmreport.job.job import Job
from zlmreport.language import Words
from zlmreport.measurement.approach import Approach
from zlmreport.measurement.arrays import FloatArray, read_only_floats, read_only_integers
from zlmreport.measurement.axis import Axis, AxisKind, find_usual_overrun
from zlmreport.measurement.measurement_set import MeasurementSet
from zlmreport.measurement.refractive_index import STANDARD_HUMIDITY, STANDARD_PRESSURE
from zlmreport.measurement.units import REFERENCE_TEMPERATURE, SECONDS_PER_MINUTE
from zlmreport.model.planning.methods import RUN_BY_RUN, Method, Stop, Visit, list_visits, plan_path
from zlmreport.model.planning.targets import makes_whole_turns, sample_targets

if TYPE_CHECKING:
    from zlmreport.plugin.protocols import Standard

_USUAL_FEED = 2000.0
_USUAL_DWELL = 5.0
#: In both directions together: a working day.
_MOST_READINGS = 5000
#: What the air does in an hour of an ordinary day: Pa, and a share.
_FALL_OF_PRESSURE, _RISE_OF_HUMIDITY = 100.0, 0.03
#: How many of its time constants a machine has warmed up for when the test ends.
_TIME_CONSTANTS = 3.0
_OF_MACHINE = ("axis_temperature", "screw_temperature", "material_temperature")

ASSUMPTION = Words(
    "temperatures rise by {rise} K during the test from 20 °C, the machine's ever more slowly, the air's "
    "steadily; air pressure falls by 1 hPa, humidity rises by 3 %"
)
#: Where a job names no number: targets in all, and the interval that is not exceeded where these are not
#: too many, m or rad.
_LEAST_TARGETS, _MOST_TARGETS = 11, 101
_LARGEST_INTERVAL = {AxisKind.LINEAR: 0.1, AxisKind.ROTARY: math.radians(30)}
_FURTHER_TARGETS = 60
#: Runs in the order in which they are tried: the first that meets most requirements is taken.
_RUNS = (5, 1, 2, 3, 4, 6, 7, 8, 9, 10)
_ROUNDING = 1e-9


@dataclass(frozen=True, slots=True)
class Proposal:
    """The plan of a test."""

    plan: AxisPlan  #: Targets, method, runs, overrun, feed and dwell.
    expected: ExpectedTest  #: What is expected of the readings.
    seed: int  #: Of random fractions.
    #: Whether the targets were drawn with it: not where the job lists them, or asks for even ones.
    has_fractions: bool
    assumed: frozenset[str]  #: Keys of the job that it does not state and that nothing but custom answers.


def propose(job: Job, standards: Sequence[PlannedStandard]) -> Proposal:
    """Return the plan of a job's test.

    `job`: The job; its readings need not exist.
    `standards`: The standards that it names, each with its own keys: their requirements choose the numbers
        that the job leaves open.

    Raises `InputError` if the axis has no travel and the plan no list of targets, if its targets do not fit,
    or if there are more readings than anybody takes.
    """
    keys, axis = job.keys.plan, job.axis
    if axis.travel is None and keys.targets.positions is None:
        raise InputError.at(
            job.place_of("axis"),
            "axis.travel is missing: targets are spread over it; for example [0, 1000]",
        )
    to_si = axis.position_unit.to_si
    motion = _plan_motion(job)
    method, overrun = motion.method, motion.overrun
    seed = make_seed_of(job.keys.certificate.number) if keys.seed is None else keys.seed
    period = None if keys.targets.fractions_of is None else to_si(keys.targets.fractions_of)

    def sample(count: int) -> FloatArray:
        return sample_targets(axis, count, overrun, period, seed)

    try:
        if keys.targets.positions is not None:
            targets = read_only_floats(to_si(np.array(keys.targets.positions)))
        else:
            count = keys.targets.count or choose_count(axis, method, keys.runs, sample, standards)
            targets = sample(count)
    except ValueError as error:
        raise InputError.at(job.place_of("plan.targets"), f"plan.targets: {error}") from error
    runs = keys.runs or choose_runs(axis, method, targets, standards)
    if keys.pause and (method not in RUN_BY_RUN or runs == 1):
        raise InputError.at(
            job.place_of("plan.pause"),
            "plan.pause lies between two runs: take the linear or the unidirectional method, and two runs",
        )
    if 2 * len(targets) * runs > _MOST_READINGS:
        raise InputError.at(
            job.place_of("plan"),
            f"plan: {count_in_words(len(targets), 'target')} in {count_in_words(runs, 'run')} are more than "
            f"{_MOST_READINGS:,} readings; state a smaller plan.targets.count, or plan.runs",
        )
    plan = replace(motion, targets=targets, runs=runs)
    expected = ExpectedTest(axis.deviation_unit.to_si(keys.repeatability), keys.temperature_change)
    has_fractions = keys.targets.positions is None and period != 0
    return Proposal(plan, expected, seed, has_fractions, _list_assumed(job))


def find_measured_plan(job: Job, measurements: MeasurementSet) -> AxisPlan:
    """Return the plan of a test that has been done, as far as its job and its readings tell it."""
    runs = max(1, int(measurements.run.max(initial=1)))
    return replace(_plan_motion(job), targets=measurements.target_positions, runs=runs)


def _plan_motion(job: Job) -> AxisPlan:
    """Return what a job says of a plan, and custom of the rest, but for targets and runs."""
    axis, keys, measured = job.axis, job.keys.plan, job.keys.measurement
    to_si = axis.position_unit.to_si
    pause = keys.pause
    return AxisPlan(
        targets=read_only_floats([]),
        method=Method(measured.method or Method.LINEAR),
        overrun=to_si(keys.overrun) if keys.overrun else find_usual_overrun(axis),
        feed=to_si(measured.feed or _USUAL_FEED) / SECONDS_PER_MINUTE,
        dwell=measured.dwell or _USUAL_DWELL,
        pause=Pause(pause.minutes * SECONDS_PER_MINUTE, pause.change, pause.of) if pause else None,
    )


def make_seed_of(number: str) -> int:
    """Return the seed that belongs to a certificate's number: the same number gives the same targets."""
    return int.from_bytes(hashlib.sha256(number.encode()).digest()[:4], "big")


def _list_assumed(job: Job) -> frozenset[str]:
    stated = {f"measurement.{key}" for key in job.keys.measurement.model_fields_set}
    stated |= {f"plan.{key}" for key in job.keys.plan.model_fields_set}
    stated |= {"model.effects"} if job.effects else set()
    customary = {"measurement.method", "measurement.feed", "measurement.dwell"}
    customary |= {"plan.repeatability", "plan.temperature_change", "model.effects"}
    return frozenset(customary - stated)


@dataclass(frozen=True, slots=True)
class ExpectedTest:
    """What is expected of a test that nobody has done yet."""

    sigma: float  #: Repeatability of a single reading, m or rad.
    temperature_change: float  #: From the first reading to the last, K.


@dataclass(frozen=True, slots=True)
class AxisPlan:
    """How the axis is tested."""

    targets: FloatArray  #: (m,): Target positions, rising, m or rad.
    method: Method = Method.LINEAR  #: The positioning method.
    runs: int = 5  #: How often each target is read in each direction.
    overrun: float = 5e-3  #: How far beyond a target the axis turns round, m or rad.
    feed: float = 2 / 60  #: m/s or rad/s.
    dwell: float = 5.0  #: Time at rest before each reading, s.
    pause: Pause | None = None  #: Half-way.
    #: What is waited for after a first session with which the readings are held together; None for a test by
    #: itself.
    after: Pause | None = None

    @property
    def stops(self) -> tuple[Stop, ...]:
        """Where the axis stops one after another."""
        return plan_path(self.method, self.targets.tolist(), self.runs, self.overrun)

    @property
    def visits(self) -> tuple[Visit, ...]:
        """The readings in their order."""
        return list_visits(self.stops)

    @property
    def travelled(self) -> float:
        """The whole way of the axis, loops included, m or rad."""
        return sum(abs(later.position - earlier.position) for earlier, later in pairwise(self.stops))

    @property
    def readings(self) -> int:
        """How many are taken."""
        return len(self.targets) * self.runs * (1 if self.method is Method.UNIDIRECTIONAL else 2)

    @property
    def duration(self) -> float:
        """Of motion, rest and pauses together, s."""
        pauses = sum(pause.duration for pause in (self.pause, self.after) if pause)
        return self.travelled / self.feed + self.dwell * self.readings + pauses


def find_beyond_travel(axis: Axis, plan: AxisPlan) -> tuple[float, float] | None:
    """Return the lowest and highest position of a plan, m or rad, where the axis has an end before one."""
    return None if makes_whole_turns(axis) else find_beyond_stated_travel(axis, plan)


def find_beyond_stated_travel(axis: Axis, plan: AxisPlan) -> tuple[float, float] | None:
    """Return the lowest and highest position of a plan, m or rad, where one lies beyond the travel as stated.

    Nobody has said whether an axis that states a whole turn has ends there.
    """
    if axis.travel is None:
        return None
    first, last = axis.travel
    slack = _ROUNDING * (last - first)
    stops = [stop.position for stop in plan.stops]
    lowest, highest = min(stops), max(stops)
    return (lowest, highest) if lowest < first - slack or highest > last + slack else None


#: What other temperatures do while one changes by 1 K: a hall warms its machines slowly, a screw the scale
#: beside it; what warms the scale warms the whole machine.
_THIRD = 1 / 3
_FOLLOW: Mapping[str, Mapping[str, float]] = {
    "axis_temperature": {"screw_temperature": 1.0, "material_temperature": 1.0, "air_temperature": _THIRD},
    "screw_temperature": {"axis_temperature": _THIRD},
    "air_temperature": {
        "axis_temperature": _THIRD,
        "screw_temperature": _THIRD,
        "material_temperature": _THIRD,
    },
}


@dataclass(frozen=True, slots=True)
class Pause:
    """A rest half-way through a test, or before it, in which a temperature changes."""

    duration: float  #: s.
    change: float  #: Of the temperature, K.
    of: str  #: Which one, by the name of its column: others follow it in part.

    def compute_change(self, column: str) -> float:
        """Return by how much another temperature changes meanwhile, K."""
        return self.change if column == self.of else self.change * _FOLLOW[self.of].get(column, 0.0)


def expect_conditions(
    rise: float, time: FloatArray, pause: Pause | None = None, half_way: int = 0
) -> Mapping[str, FloatArray]:
    """Return every condition that files may log, by its name, as it may be expected at each reading, SI.

    `rise`: Of temperatures from the first reading to the last, K.
    `time`, (N,): Of the readings, s from the first.
    `pause`, `half_way`: What changes temperatures beside that, and before which reading.
    """
    duration = float(time[-1]) or 1.0
    warming = np.expm1(-_TIME_CONSTANTS * time / duration) / math.expm1(-_TIME_CONSTANTS)
    steadily = time / duration
    after = np.arange(len(time)) >= half_way

    def temperature(column: str, course: FloatArray) -> FloatArray:
        jump = pause.compute_change(column) if pause else 0.0
        return read_only_floats(REFERENCE_TEMPERATURE + rise * course + jump * after)

    return {
        **{name: temperature(name, warming) for name in _OF_MACHINE},
        "air_temperature": temperature("air_temperature", steadily),
        "air_pressure": read_only_floats(STANDARD_PRESSURE - _FALL_OF_PRESSURE * steadily),
        "relative_humidity": read_only_floats(STANDARD_HUMIDITY + _RISE_OF_HUMIDITY * steadily),
    }


#: A standard with its own job keys.
PlannedStandard: TypeAlias = "tuple[Standard, Any]"


def choose_count(
    axis: Axis,
    method: Method,
    runs: int | None,
    drawn: Callable[[int], FloatArray],
    standards: Sequence[PlannedStandard],
) -> int:
    """Return the least number of targets that meets as many requirements as can be met.

    `axis`: An axis with a travel.
    """
    assert axis.travel is not None  # noqa: S101 - the caller has seen to it
    intervals = math.ceil((axis.travel[1] - axis.travel[0]) / _LARGEST_INTERVAL[axis.kind] - _ROUNDING)
    least = min(max(_LEAST_TARGETS, intervals + 1), _MOST_TARGETS)
    runs = runs or choose_runs(axis, method, drawn(least), standards)
    unmet = []
    for count in range(least, least + _FURTHER_TARGETS):
        unmet.append(_count_unmet(make_as_measured(axis, method, drawn(count), runs), standards))
        if unmet[-1] == 0:
            break
    return least + unmet.index(min(unmet))


def choose_runs(axis: Axis, method: Method, targets: FloatArray, standards: Sequence[PlannedStandard]) -> int:
    """Return the number of runs that meets most requirements; 5 if several do."""
    return min(_RUNS, key=lambda runs: _count_unmet(make_as_measured(axis, method, targets, runs), standards))


def make_as_measured(axis: Axis, method: Method, targets: FloatArray, runs: int) -> MeasurementSet:
    """Return a test as standards would see it once it is done; its deviations are zero."""
    approaches = [Approach.POSITIVE] if method is Method.UNIDIRECTIONAL else list(Approach)
    run, approach, target = np.meshgrid(
        np.arange(1, runs + 1), [int(each) for each in approaches], np.arange(len(targets)), indexing="ij"
    )
    return MeasurementSet(
        axis=axis,
        target_positions=targets,
        target=read_only_integers(target.ravel()),
        approach=read_only_integers(approach.ravel()),
        run=read_only_integers(run.ravel()),
        deviation=read_only_floats(np.zeros(target.size)),
    )


def _count_unmet(measurements: MeasurementSet, standards: Sequence[PlannedStandard]) -> int:
    return sum(
        finding.met is False
        for standard, options in standards
        for finding in standard.requirements(measurements, options)
    )
