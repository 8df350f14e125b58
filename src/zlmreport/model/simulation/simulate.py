"""From a description to a test: the measurement set, and what it hides.

Or the machine that carries out its plan and errs as described, for emulated instruments to watch.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from zlmreport.language import Words
from zlmreport.measurement.arrays import FloatArray, read_only_floats, read_only_integers
from zlmreport.measurement.measurement_set import CONDITIONS, MeasurementSet
from zlmreport.measurement.provenance import Provenance
from zlmreport.model.effects.design import Design
from zlmreport.model.effects.effect import Effect
from zlmreport.model.planning.methods import make_planned_design
from zlmreport.model.planning.plan import AxisPlan
from zlmreport.model.simulation.description import (
    Description,
    compute_logged_course,
    compute_true_course,
    is_missing,
    round_as_shown,
    sample_noise_of,
)

_REMARK = Words("Simulated readings, not measurements (seed {seed}).")


@dataclass(frozen=True, slots=True)
class Simulation:
    """A simulated test."""

    measurements: MeasurementSet  #: The readings as an instrument would have given them.
    design: Design  #: The test with its true conditions; it has every reading, the missing ones too.
    systematic: FloatArray  #: (N,): The deviation that the effects make, without noise, m or rad.


def simulate(description: Description) -> Simulation:
    """Return a test of the axis that is described.

    Raises `ValueError` if a searched parameter of an effect has no value.
    """
    design = make_design_of(description)
    systematic = _compute_deviation_by_all(description, design)
    return Simulation(observe(description, design, systematic), design, read_only_floats(systematic))


def make_design_of(description: Description) -> Design:
    """Return the test that is described with its true conditions; whatever its effects."""
    plan = description.plan
    design = make_planned_design(description.axis, plan.targets, plan.visits, plan.feed, plan.dwell)
    conditions = {
        name: read_only_floats(compute_true_course(course, design.time))
        for name, course in description.conditions.items()
    }
    return replace(design, conditions=conditions)


def _compute_deviation_by_all(description: Description, design: Design) -> FloatArray:
    """Return the deviation that all effects of a description make, shape (N,), m or rad.

    Raises `ValueError` if a searched parameter of an effect has no value.
    """
    systematic = np.zeros(len(design.position))
    for each in description.effects:
        systematic += compute_deviation_by(each.effect, design, each.fixed)
    return systematic


def compute_deviation_by(effect: Effect, design: Design, values: Mapping[str, float]) -> FloatArray:
    """Return the deviation that an effect makes, shape (N,), m or rad.

    `values`: Its parameters by name, SI. Linear ones that are left out are 0; searched ones may be left out
        where the axis tells them (a stated pitch).

    Raises `ValueError` if a searched parameter has no value.
    """
    known = {**effect.expected(design.axis), **values}
    missing = [parameter.name for parameter in effect.searched if parameter.name not in known]
    if missing:
        raise ValueError(f"{effect.identifier} needs a value of {missing[0]}")
    theta = np.array([known[parameter.name] for parameter in effect.searched])
    gamma = np.array([values.get(parameter.name, 0.0) for parameter in effect.linear])
    return np.asarray(effect.columns(design, theta) @ gamma)


def observe(description: Description, design: Design, systematic: FloatArray) -> MeasurementSet:
    """Return what an instrument gives of deviations, with all noise of the description.

    `systematic`, (N,): The deviation without noise, m or rad.
    """
    noise, seed = description.noise, description.seed
    shown = round_as_shown(systematic + sample_noise_of(noise, design, seed), noise.resolution)
    shown = np.where(is_missing(noise, len(shown), seed), np.nan, shown)
    return MeasurementSet(
        axis=description.axis,
        target_positions=read_only_floats(description.plan.targets),
        target=design.target,
        approach=read_only_integers(design.direction),
        run=design.run,
        deviation=read_only_floats(shown),
        time=design.time if description.time_is_logged else None,
        conditions=_simulate_logs(description, design),
        provenance=Provenance("simulation", remarks=(_REMARK.given(seed=seed),)),
    )


def _simulate_logs(description: Description, design: Design) -> dict[str, FloatArray]:
    return {
        name: read_only_floats(
            compute_logged_course(course, design.conditions[name], description.seed, _choose_number(name))
        )
        for name, course in description.conditions.items()
        if course.is_logged
    }


def _choose_number(condition: str) -> int:
    """Return a number that belongs to a condition whatever others are there."""
    known = list(CONDITIONS)
    return known.index(condition) if condition in known else int.from_bytes(condition.encode(), "big")


@dataclass(frozen=True, slots=True)
class EmulatedMachine:
    """A machine under its part program: `zlmreport.live.emulation.emulator.EmulatedAxis`, its truth known."""

    #: moments and places: Corners of the motion, s from the start of the emulation, and m or rad: between two
    #: of them the axis moves evenly, after the last it rests.
    moments: Sequence[float]
    places: Sequence[float]
    weather: Mapping[str, Sequence[float]]  #: Conditions at these moments, SI, by name.
    #: arrives and leaves: (N,): When the axis arrives at each visit of the plan, and when it goes on, s from
    #: the start.
    arrives: FloatArray
    leaves: FloatArray
    truth: MeasurementSet  #: What the axis really did: its deviation at each visit, and the true conditions.

    @property
    def duration(self) -> float:
        """When the program has ended, s from the start."""
        return self.moments[-1]

    def position(self, time: float) -> float:
        """Return where the axis is, m or rad, at a time in s from the start."""
        return _interpolate(self.moments, self.places, time)

    def conditions(self, time: float) -> dict[str, float]:
        """Return the true conditions at a time in s from the start, SI."""
        return {name: _interpolate(self.moments, values, time) for name, values in self.weather.items()}


class StartedMachine:
    """A machine whose program begins when somebody starts it; until then it rests where that begins.

    `machine`: Its time counts from the start.
    """

    def __init__(self, machine: EmulatedMachine) -> None:
        self.elapsed: float | None = None  #: How long it has been started, s; None before.
        self._machine = machine
        self._started_at: float | None = None
        self._is_started = False

    def start(self) -> None:
        """Start it; a second time does nothing."""
        self._is_started = True

    def position(self, time: float) -> float:
        """Return where the axis is, m or rad, at a time in s from the start of the emulation."""
        return self._machine.position(self._measure_time(time))

    def conditions(self, time: float) -> dict[str, float]:
        """Return the true conditions at a time in s from the start of the emulation, SI."""
        return self._machine.conditions(self._measure_time(time))

    def _measure_time(self, time: float) -> float:
        if not self._is_started:
            return 0.0
        if self._started_at is None:
            self._started_at = time
        self.elapsed = max(0.0, time - self._started_at)
        return self.elapsed


def make_emulated_machine(description: Description, lead: float) -> EmulatedMachine:
    """Return a machine that carries out the plan of a description.

    At each target it errs by its effects and by its noise, drawn as for simulated readings, and rests there;
    on the way to the next its error goes over from the one to the other. Where it rests before its program,
    and where it comes back to at the end, it does not err: there the instrument gets its datum. What a
    description says of an instrument, its resolution and its missing readings, is left to the instrument that
    watches.

    `lead`: How long the axis rests before its program begins, s.

    Raises `ValueError` if a searched parameter of an effect has no value.
    """
    seen = _drop_instrument(description)
    design = make_design_of(seen)
    truth = observe(seen, design, _compute_deviation_by_all(seen, design))
    moments, nominal, visited = _make_course(description.plan, lead)
    arrives, leaves = moments[visited], moments[visited + 1]
    at_rest = np.column_stack([arrives, leaves]).ravel()
    errs = np.interp(moments, [lead, *at_rest, moments[-1]], [0.0, *np.repeat(truth.deviation, 2), 0.0])
    course = nominal + errs
    return EmulatedMachine(
        tuple(moments.tolist()),
        tuple(course.tolist()),
        {
            name: tuple(np.interp(moments, leaves, values).tolist())
            for name, values in truth.conditions.items()
        },
        read_only_floats(arrives),
        read_only_floats(leaves),
        truth,
    )


def _drop_instrument(description: Description) -> Description:
    """Return a description whose readings and logs are the truth."""
    return replace(
        description,
        noise=replace(description.noise, missing_share=0.0, resolution=0.0),
        conditions={
            name: replace(course, sensor_noise=0.0, resolution=0.0, is_logged=True)
            for name, course in description.conditions.items()
        },
        time_is_logged=True,
    )


def _make_course(plan: AxisPlan, lead: float) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return moments, positions where nothing errs, and the indices of the moments of arrival at targets."""
    corners = list(_find_corners(plan, lead))
    visited = [index for index, (_, _, is_arrival) in enumerate(corners) if is_arrival]
    moments, nominal, _ = zip(*corners, strict=True)
    return np.array(moments), np.array(nominal), np.array(visited)


def _find_corners(plan: AxisPlan, lead: float) -> Iterator[tuple[float, float, bool]]:
    """Yield each corner of the motion: when, where, and whether the axis arrives at a target there."""
    stops = plan.stops
    yield 0.0, stops[0].position, False
    if stops[-1].position != stops[0].position:
        stops = (*stops, stops[0])
    now = lead
    yield now, stops[0].position, False
    for before, stop in pairwise(stops):
        now += abs(stop.position - before.position) / plan.feed
        yield now, stop.position, stop.target is not None
        if stop.target is not None:
            now += plan.dwell
            yield now, stop.position, False


def _interpolate(moments: Sequence[float], values: Sequence[float], time: float) -> float:
    """Return a value between the corners of a course; beyond its ends the first or the last."""
    after = bisect_right(moments, time)
    if after == 0 or after == len(moments):
        return values[min(after, len(values) - 1)]
    share = (time - moments[after - 1]) / (moments[after] - moments[after - 1])
    return values[after - 1] + share * (values[after] - values[after - 1])
