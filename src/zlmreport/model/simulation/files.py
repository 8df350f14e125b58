"""From a simulation file to what is simulated; the table of readings and the job that are written."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from zlmreport.errors import InputError, Problem
from zlmreport.job.simulation import CourseKeys, SimulatedNoiseKeys, SimulationFile
from zlmreport.job.yaml_text import write_in_a_line
from zlmreport.language import Language
from zlmreport.measurement.approach import Approach
from zlmreport.measurement.arrays import FloatArray, read_only_floats
from zlmreport.measurement.axis import find_usual_overrun
from zlmreport.measurement.measurement_set import CONDITIONS, MeasurementSet
from zlmreport.measurement.units import SECONDS_PER_MINUTE, Scale, Unit
from zlmreport.model.effects.axis_model import Term, choose_terms
from zlmreport.model.effects.effect import Effect, find_unit_of
from zlmreport.model.planning.methods import Method
from zlmreport.model.planning.plan import AxisPlan
from zlmreport.model.planning.planned_test import USUAL_MODEL
from zlmreport.model.planning.targets import compute_target_positions, make_target_generator
from zlmreport.model.simulation.description import ConditionCourse, Description, SimulatedNoise
from zlmreport.model.simulation.simulate import compute_deviation_by, make_design_of

#: Of a deviation, m or rad: no axis is so far off.
_LARGEST = 1e3
_AS_FOUND = Scale("")
#: Digits after the decimal point: of positions in mm or °, of deviations in µm or ″, of times in s.
POSITION_DIGITS, _DEVIATION_DIGITS, _TIME_DIGITS = 4, 3, 1
_CONDITION_DIGITS = 4
#: More digits of mm or ° than anybody types, and fewer than a double rounds at.
_MEANT_DIGITS = 9
#: Of the keys of the noise; all others are deviations.
_NO_DEVIATIONS = frozenset({"unequal", "drift_time", "outlier_share", "missing_share"})
_DIRECTIONS = {Approach.POSITIVE: "+", Approach.NEGATIVE: "-"}


def read_description_of(file: SimulationFile, find: Callable[[str], Effect]) -> Description:
    """Return what a simulation file describes.

    Raises `InputError` if its targets do not fit into the travel, an effect lacks a parameter, or cannot act
    on this test.
    """
    keys, axis = file.keys, file.axis
    position = axis.position_unit
    description = Description(
        axis=axis,
        plan=AxisPlan(
            targets=_read_targets(file),
            method=Method(keys.method),
            runs=keys.runs,
            overrun=position.to_si(keys.overrun),
            feed=position.to_si(keys.feed) / SECONDS_PER_MINUTE,
            dwell=keys.dwell,
        ),
        seed=keys.seed,
        effects=choose_terms(file.effects, find, axis.kind),
        conditions={name: _read_course(name, course) for name, course in keys.conditions.items()},
        noise=_read_noise(keys.noise, axis.deviation_unit),
        time_is_logged=keys.time_logged,
    )
    problems = list(_find_impossible(file, description)) or list(_find_boundless(file, description))
    if problems:
        raise InputError(problems)
    return description


def _read_targets(file: SimulationFile) -> FloatArray:
    key = "count" if file.keys.targets.positions is None else "positions"
    targets = _choose_targets(file)
    unit = file.axis.position_unit
    if np.any(np.diff(np.round(unit.from_si(targets), POSITION_DIGITS)) <= 0):
        raise InputError.at(
            file.place_of("targets", key),
            f"targets.{key}: two targets are nearer to each other than {10**-POSITION_DIGITS:.12g} "
            f"{unit.symbol}, the last digit of the table of readings; take them farther apart",
        )
    return targets


def _choose_targets(file: SimulationFile) -> FloatArray:
    keys = file.keys
    unit = file.axis.position_unit
    if keys.targets.positions is not None:
        return read_only_floats(unit.to_si(np.array(keys.targets.positions)))
    assert keys.axis.travel is not None  # noqa: S101  # demanded when the file was loaded
    assert keys.targets.count is not None  # noqa: S101  # the same
    period = keys.targets.fractions_of
    if period is None:
        period = keys.axis.screw_pitch or 0.0
    try:
        drawn = compute_target_positions(
            keys.axis.travel, keys.targets.count, period, make_target_generator(keys.seed)
        )
    except ValueError as error:
        raise InputError.at(file.place_of("targets", "count"), f"targets.count: {error}") from error
    # as they can be typed into a part program, and never beyond an end; 208.8 may come as 208.79999999999998
    typed = np.floor(np.round(drawn * 10**POSITION_DIGITS, 6)) / 10**POSITION_DIGITS
    return read_only_floats(unit.to_si(np.maximum(typed, keys.axis.travel[0])))


def _read_course(name: str, keys: CourseKeys) -> ConditionCourse:
    kind = CONDITIONS.get(name)
    unit = kind.unit if kind else _AS_FOUND
    return ConditionCourse(
        start=unit.to_si(keys.start),
        end=None if keys.end is None else unit.to_si(keys.end),
        time_constant=keys.time_constant,
        swing=keys.swing * unit.si,
        swing_period=keys.swing_period,
        sensor_noise=keys.sensor_noise * unit.si,
        resolution=keys.resolution * unit.si,
        is_logged=keys.logged,
    )


def _read_noise(keys: SimulatedNoiseKeys, unit: Unit) -> SimulatedNoise:
    return SimulatedNoise(
        **{name: value if name in _NO_DEVIATIONS else unit.to_si(value) for name, value in keys}
    )


def _find_impossible(file: SimulationFile, description: Description) -> Iterator[Problem]:
    """Yield effects that cannot act: for want of a parameter or a condition, or on an axis of this kind."""
    design = make_design_of(description)
    for choice, term in zip(file.effects, description.effects, strict=True):
        effect = term.effect
        reason = effect.untestable(design)
        if reason:
            said = reason.in_language(Language.ENGLISH)
            yield Problem(choice.place, f"{effect.identifier} cannot act on this test: {said}")
        else:
            known = {**effect.expected(file.axis), **term.fixed}
            yield from (
                Problem(choice.place, f"{effect.identifier}: {name} is missing, {unit}")
                for name, unit in _list_searched(term, description)
                if name not in known
            )
        if not any(parameter.name in term.fixed for parameter in effect.linear):
            example = effect.linear[0]
            unit = find_unit_of(example.dimension, file.axis.kind).symbol or "a number"
            yield Problem(
                choice.place,
                f"{effect.identifier} has no size; give {' or '.join(each.name for each in effect.linear)}, "
                f"as in {{{effect.identifier}: {{{example.name}: 1}}}} ({unit})",
            )


def _find_boundless(file: SimulationFile, description: Description) -> Iterator[Problem]:
    """Yield effects whose deviation is no number, and conditions that no reader takes."""
    design = make_design_of(description)
    for choice, term in zip(file.effects, description.effects, strict=True):
        with np.errstate(all="ignore"):
            deviation = compute_deviation_by(term.effect, design, term.fixed)
        if not np.all(np.abs(deviation) < _LARGEST):
            message = f"{term.effect.identifier}: with these values it deviates beyond all bounds"
            yield Problem(choice.place, message)
    for name, keys in file.keys.conditions.items():
        kind = CONDITIONS.get(name)
        ends = [keys.start, keys.start if keys.end is None else keys.end]
        if kind and not kind.lowest <= min(ends) <= max(ends) <= kind.highest:
            yield Problem(
                file.place_of("conditions", name),
                f"conditions.{name}: lies from {kind.lowest:g} to {kind.highest:g} {kind.unit.symbol}",
            )


def _list_searched(term: Term, description: Description) -> Iterator[tuple[str, str]]:
    """Yield each searched parameter with what it is and its unit."""
    for parameter in term.effect.searched:
        unit = find_unit_of(parameter.dimension, description.axis.kind).symbol
        meaning = parameter.description.in_language(Language.ENGLISH)
        yield parameter.name, f"the {meaning}, {unit}" if unit else f"the {meaning}"


def write_readings_table(measurements: MeasurementSet, remarks: Sequence[str]) -> str:
    """Return the readings as a table that the data source ``laser-csv`` reads."""
    axis = measurements.axis
    target = axis.position_unit.from_si(measurements.target_positions)[measurements.target]
    deviation = axis.deviation_unit.from_si(measurements.deviation)
    columns: dict[str, list[str]] = {
        "target": _write_numbers(target, POSITION_DIGITS),
        "direction": [_DIRECTIONS[Approach(sign)] for sign in measurements.approach.tolist()],
        "run": [str(run) for run in measurements.run.tolist()],
        "deviation": _write_numbers(deviation, _DEVIATION_DIGITS),
    }
    if measurements.time is not None:
        columns["time"] = _write_numbers(measurements.time, _TIME_DIGITS)
    for name, values in measurements.conditions.items():
        columns[name] = _write_numbers(_convert_to_users_unit(name, values), _CONDITION_DIGITS)
    lines = [f"# {remark}" for remark in remarks]
    lines.append(",".join(columns))
    lines.extend(",".join(row) for row in zip(*columns.values(), strict=True))
    return "\n".join(lines) + "\n"


def _write_numbers(values: FloatArray, digits: int) -> list[str]:
    """Write numbers without trailing zeros; a missing one is an empty cell."""
    return ["" if np.isnan(value) else _write_number(value, digits) for value in values.tolist()]


def _write_number(value: float, digits: int) -> str:
    text = f"{value:.{digits}f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def _convert_to_users_unit(name: str, values: FloatArray) -> FloatArray:
    kind = CONDITIONS.get(name)
    return (values - kind.unit.zero) / kind.unit.si if kind else values


def write_job_text(file: SimulationFile, folder: Path, readings: str) -> str:
    """Return a job that evaluates simulated readings, and models them.

    `folder`: Where the job will stand: tables of the axis are named from there.
    `readings`: Name of the file with the readings, beside the job.
    """
    source = {"plugin": "laser-csv", "file": readings}
    return "\n".join([*_write_job_lines(file, folder, source), *_write_overrun(file), _OUTPUT]) + "\n"


def _write_overrun(file: SimulationFile) -> Iterator[str]:
    """Yield how far the axis ran over the targets, where it is not what is taken of a job that is silent."""
    unit, overrun = file.axis.position_unit, file.keys.overrun
    if unit.to_si(overrun) != find_usual_overrun(file.axis):
        yield f"plan: {{overrun: {write_in_a_line(overrun)}}} # {unit.symbol}"


def write_live_job_text(file: SimulationFile, folder: Path, plan: AxisPlan, source: Mapping[str, Any]) -> str:
    """Return a job that captures the readings of an emulated machine from an instrument, and models them."""
    unit = file.axis.position_unit
    targets = unit.from_si(plan.targets).round(_MEANT_DIGITS).tolist()
    lines = [
        *_write_job_lines(file, folder, source, dwell=file.keys.dwell),
        "plan:",
        f"  targets: {write_in_a_line({'positions': targets})}",
        f"  runs: {plan.runs}",
        f"  overrun: {write_in_a_line(file.keys.overrun)} # {unit.symbol}",
        _OUTPUT,
    ]
    return "\n".join(lines) + "\n"


_OUTPUT = "output: {directory: out, formats: [pdf, json]}"


def _write_job_lines(
    file: SimulationFile, folder: Path, source: Mapping[str, Any], dwell: float | None = None
) -> Iterator[str]:
    keys = file.keys
    effects = keys.model.effects if keys.model else USUAL_MODEL
    axis = {
        key: os.path.relpath(value, folder) if isinstance(value, Path) else value
        for key, value in keys.axis.model_dump(exclude_defaults=True).items()
    }
    yield "# A measuring report of simulated readings: nothing here was measured."
    yield "schema: zlmreport/job/1"
    yield "certificate:"
    yield f"  number: {write_in_a_line(keys.output.number)}"
    yield "  kind: report"
    yield f"axis: {write_in_a_line(axis)} # {file.axis.position_unit.symbol}"
    yield "measurement:"
    yield f"  method: {keys.method}"
    yield f"  feed: {write_in_a_line(keys.feed)} # {file.axis.position_unit.symbol}/min"
    if dwell is not None:
        yield f"  dwell: {write_in_a_line(dwell)} # s"
    yield f"  source: {write_in_a_line(source)}"
    yield "  remarks: Simulated readings, not measurements."
    yield "evaluate:"
    yield "  - iso230-2:2014"
    yield "model:"
    yield "  effects:"
    yield from (f"    - {write_in_a_line(effect)}" for effect in effects)
