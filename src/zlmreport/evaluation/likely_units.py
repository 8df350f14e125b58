"""Warnings on values that suggest another unit: 68.2 °C, a limit of 0.02 µm, an axis C in mm.

Nothing is refused or changed for that: who knows the machine is told, with the unit that would fit.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from zlmreport.evaluation.evaluation import EvaluatedParameter, Evaluation
from zlmreport.evaluation.uncertainty.wording import name_contributor
from zlmreport.job.job import Job
from zlmreport.language import Words, same
from zlmreport.language.formatting import write_plain
from zlmreport.measurement.axis import AxisKind
from zlmreport.measurement.measurement_set import CONDITION_NAMES, CONDITIONS, MeasurementSet, find_step
from zlmreport.measurement.other_unit import CORRECT_RUN, IN_ANOTHER_UNIT, find_run_in_another_unit
from zlmreport.measurement.units import ANGLES, MICRORADIAN, Scale

_UNLIKELY = Words("{name}: {value} {unit} is unusual where machines are measured")
_LOGGED = Words(
    "{name}: {value} {unit} was logged at a reading, which is unusual where machines are measured"
)
_MEANT = Words(
    "{name}: {value} {unit} is unusual where machines are measured; {value} {other} would be {meant} {unit}"
)
_SMALL_LIMITS = Words(
    "{designation}: limits far below the values or their last digit: {limits}; tolerances are stated in "
    "{unit}, and 1 {other} is {per_other} {unit}"
)
_LARGE_LIMITS = Words(
    "{designation}: limits wider than the measured range: {limits}; tolerances are stated in {unit}"
)
_TURNS = Words(
    "Axis {name} is taken for a linear one that was measured over {range} mm; if these are degrees: "
    "axis.kind: rotary"
)
_MOVES_STRAIGHT = Words(
    "Axis {name} is taken for a rotary one that was measured over {range}°; if these are millimetres: "
    "axis.kind: linear"
)
_LARGE_ANGLES = Words(
    "Angles that span {span}{unit} are unusual; if the file has another unit, such as {meant}, state it "
    "under measurement.source.units"
)
_OF_A_RUN = Words("{statement}; {remedy}")
_FAR_BELOW_STEP = Words(
    "Expanded uncertainty of the instrument: {value} {unit}, and its readings were given in steps of {step} "
    "{unit}: it is stated in {unit}"
)
#: Part of a step below which the uncertainty of no instrument lies that was read so.
_OF_A_STEP = 0.05
#: Full ranges of set-ups, in their units; others are in another unit, or no measurement.
_RANGES: Mapping[str, tuple[float, float, str]] = {
    "misalignment": (0.001, 50.0, "mm"),
    "machine_temperature": (0.001, 10.0, "K"),
    "device_temperature": (0.001, 10.0, "K"),
    "expansion_coefficient": (0.005, 20.0, "µm/(m·K)"),
    "device_expansion_coefficient": (0.001, 20.0, "µm/(m·K)"),
    "air_temperature": (0.001, 20.0, "K"),
    "air_pressure": (0.02, 200.0, "hPa"),
    "relative_humidity": (0.3, 100.0, "%"),
}
#: Of a machine tool's axis, rad: 1000 arc seconds.
_LARGE_ANGLE = 1000 / 206264.80624709636
#: Axes by their first letters (ISO 841), and the ranges that say that one of them turns.
_TURNING, _STRAIGHT = frozenset("ABC"), frozenset("XYZUVW")
_PARTS_OF_A_TURN = (90.0, 180.0, 360.0)
_OF_MACHINE = Words("Expansion coefficient of the machine")
_OF_COMPENSATION = Words("Expansion coefficient by which the instrument compensated")
_OF_INSTRUMENT = Words("Expansion coefficient of the instrument")
#: Of materials of scales and machines, µm/(m·K): Invar to aluminium and zinc; of glass ceramic it is about 0.
_EXPANSIONS, _USUAL = (0.3, 35.0), (5.0, 25.0)
#: Of carbon fibre along its fibres, µm/(m·K).
_LEAST_EXPANSION = -1.5
#: Other units by how many µm/(m·K) they are.
_OTHER_EXPANSIONS = ((1e3, "mm/(m·K)"), (1e6, "1/K"), (1e-3, "nm/(m·K)"))
#: A limit as small as this, µm or ″, beside a value so many times as large, was meant in mm or °.
_SMALL, _MANY_TIMES = 0.5, 50.0


def find_doubts(
    job: Job, measurements: MeasurementSet, evaluations: Sequence[Evaluation]
) -> tuple[Words, ...]:
    """Return a sentence for each value of a job or its readings that seems to be in another unit.

    `evaluations`: Of its readings, with the limits that it states.
    """
    return (
        *_find_unlikely_conditions(job, measurements),
        *_find_unlikely_expansion(job),
        *_find_unlikely_ranges(job),
        *_find_unlikely_instrument(job, measurements),
        *(sentence for each in evaluations for sentence in find_unlikely_limits(each)),
        *_find_other_kind_of_axis(measurements),
        *_find_unlikely_angles(measurements),
        *_find_run_in_another_unit(measurements),
    )


def _find_unlikely_conditions(job: Job, measurements: MeasurementSet) -> Iterator[Words]:
    for name, kind in CONDITIONS.items():
        value = getattr(job.keys.environment, name, None)
        logged = measurements.conditions.get(name)
        low, high = kind.usual
        if logged is not None and np.isfinite(logged).any():
            of_readings = [
                kind.unit.from_si(float(of(logged))) for of in (np.nanmedian, np.nanmin, np.nanmax)
            ]
            value = of_readings[0] if value is None else value
            far = [each for each in of_readings[1:] if not low <= each <= high]
            if far and low <= of_readings[0] <= high:
                yield _LOGGED.given(name=CONDITION_NAMES[name], value=far[0], unit=kind.unit.symbol)
        if isinstance(value, float) and not low <= value <= high:
            meant = kind.find_likely_unit(value)
            sentence = _UNLIKELY
            if meant:
                sentence = _MEANT.given(other=_name_unit(meant[0]), meant=meant[1])
            yield sentence.given(name=CONDITION_NAMES[name], value=value, unit=kind.unit.symbol)


def _find_unlikely_expansion(job: Job) -> Iterator[Words]:
    """Yield the expansion coefficients that no material of a machine has."""
    environment, instrument, corrections = job.keys.environment, job.keys.instrument, job.keys.corrections
    material = corrections.material if corrections else None
    compensates = instrument.compensates if instrument else None
    for name, value in (
        (_OF_MACHINE, environment and environment.expansion_coefficient),
        (Words("Expansion coefficient of the correction"), material and material.expansion_coefficient),
        (_OF_COMPENSATION, compensates and compensates.material),
        (_OF_INSTRUMENT, instrument and instrument.expansion_coefficient),
    ):
        if not isinstance(value, float) or _is_of_a_material(value, name):
            continue
        factor, unit = next(
            (each for each in _OTHER_EXPANSIONS if _USUAL[0] <= abs(value) * each[0] <= _USUAL[1]), (0.0, "")
        )
        sentence = _UNLIKELY
        if factor:
            sentence = _MEANT.given(other=unit, meant=float(f"{value * factor:.3g}"))
        yield sentence.given(name=name, value=value, unit="µm/(m·K)")


def _is_of_a_material(expansion: float, name: Words) -> bool:
    """Return whether a material of machines expands so: glass ceramic by 0, along its fibres carbon by −1."""
    if not expansion:
        return name is _OF_INSTRUMENT
    return _EXPANSIONS[0] <= expansion <= _EXPANSIONS[1] or _LEAST_EXPANSION <= expansion <= -_EXPANSIONS[0]


def _name_unit(unit: Scale) -> Words:
    return Words("of 1") if unit.symbol == "1" else same(unit.symbol)


def find_unlikely_limits(evaluation: Evaluation) -> Iterator[Words]:
    """Yield what is said of the limits of a standard that do not fit the readings.

    Of what several lines give together, which has no readings of its own, they are held against the values.
    """
    measurements = evaluation.measurements
    axis, targets = measurements.axis, measurements.target_positions
    unit = axis.deviation_unit
    has_own = targets.size > 0
    step = unit.to_si(find_step(measurements)) if has_own else 0.0
    length = float(targets[-1] - targets[0]) if has_own else 0.0
    small, large = [], []
    for each in evaluation.parameters:
        if each.limit is None or each.quantity.unit is not None:
            continue
        is_tiny = each.limit < unit.to_si(_SMALL) and _MANY_TIMES * each.limit < abs(each.value)
        if is_tiny or each.limit < step:
            small.append(each)
        elif axis.measurand.is_position and each.limit > length > 0:
            large.append(each)
    other = axis.position_unit
    for sentence, found in (
        (_SMALL_LIMITS.given(other=other.symbol, per_other=unit.from_si(other.to_si(1.0))), small),
        (_LARGE_LIMITS, large),
    ):
        if found:
            limits = Words("{limits}").given(limits=_name_in_a_line(found, evaluation))
            yield sentence.given(designation=evaluation.designation, limits=limits, unit=unit.symbol)


def _find_unlikely_ranges(job: Job) -> Iterator[Words]:
    """Yield ranges of the set-up that seem to be in another unit, or not full ones."""
    for name, (low, high, unit) in _RANGES.items():
        value = getattr(job.keys.uncertainty, name)
        if value and not low <= value <= high:
            yield _UNLIKELY.given(name=name_contributor(name), value=value, unit=unit)


def _find_unlikely_instrument(job: Job, measurements: MeasurementSet) -> Iterator[Words]:
    """Yield an uncertainty of the instrument that is far below the steps in which it was read."""
    stated = job.keys.instrument.stated_uncertainty if job.keys.instrument else None
    if stated is None or stated[1] or not np.isfinite(measurements.deviation).any():
        return
    step = find_step(measurements)
    if stated[0] < _OF_A_STEP * step:
        unit = measurements.axis.deviation_unit.symbol
        yield _FAR_BELOW_STEP.given(value=stated[0], step=float(f"{step:.6g}"), unit=unit)


def _name_in_a_line(parameters: Sequence[EvaluatedParameter], evaluation: Evaluation) -> Words:
    unit = evaluation.measurements.axis.deviation_unit
    places = {f"limit{index}": unit.from_si(each.limit or 0.0) for index, each in enumerate(parameters)}
    phrase = ", ".join(
        f"{write_plain(each.quantity.notation)} {{limit{index}}} {unit.symbol}"
        for index, each in enumerate(parameters)
    )
    return Words(phrase).given(**places)


def _find_unlikely_angles(measurements: MeasurementSet) -> Iterator[Words]:
    """Yield whether angles seem to have been read in too large a unit."""
    axis, readings = measurements.axis, measurements.deviation
    if axis.measurand.is_position or axis.deviation_unit not in ANGLES or not np.isfinite(readings).any():
        return
    span = float(np.nanmax(readings) - np.nanmin(readings))
    if span > _LARGE_ANGLE:
        unit = axis.deviation_unit
        yield _LARGE_ANGLES.given(
            span=float(f"{unit.from_si(span):.4g}"), unit=unit.symbol, meant=MICRORADIAN.ascii
        )


def _find_other_kind_of_axis(measurements: MeasurementSet) -> Iterator[Words]:
    """Yield whether degrees seem to have been taken for millimetres, or the other way round."""
    axis, targets = measurements.axis, measurements.target_positions
    first, last = axis.travel or (float(targets[0]), float(targets[-1]))
    extent = axis.position_unit.from_si(last - first)
    letter = axis.name.strip().upper()[:1]
    name = same(axis.name)
    if axis.kind is AxisKind.LINEAR and letter in _TURNING and np.isclose(extent, _PARTS_OF_A_TURN).any():
        yield _TURNS.given(name=name, range=float(f"{extent:.4g}"))
    if axis.kind is AxisKind.ROTARY and letter in _STRAIGHT:
        yield _MOVES_STRAIGHT.given(name=name, range=float(f"{extent:.4g}"))


def _find_run_in_another_unit(measurements: MeasurementSet) -> Iterator[Words]:
    run = find_run_in_another_unit(measurements.run, measurements.deviation)
    if run is not None:
        yield _OF_A_RUN.given(statement=IN_ANOTHER_UNIT.given(run=run), remedy=CORRECT_RUN)
