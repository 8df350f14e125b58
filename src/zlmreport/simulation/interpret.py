"""From a simulation file to its description in SI."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np

from zlmreport.errors import InputError, Problem
from zlmreport.job.simulation import CourseKeys, NoiseKeys, SimulationFile
from zlmreport.language import Language
from zlmreport.measurement.measurement_set import CONDITIONS
from zlmreport.model.axis_model import Term, chosen_terms
from zlmreport.model.effect import Effect
from zlmreport.model.parameter import unit_of
from zlmreport.planning.methods import Method
from zlmreport.planning.targets import target_positions
from zlmreport.quantities.arrays import FloatArray, read_only_floats
from zlmreport.quantities.units import Scale, Unit
from zlmreport.simulation.description import Course, Description, Noise, Plan
from zlmreport.simulation.randomness import Stream
from zlmreport.simulation.simulate import design_of
from zlmreport.simulation.writing import POSITION_DIGITS

_SECONDS_PER_MINUTE = 60
_AS_FOUND = Scale("")


def description_of(file: SimulationFile, find: Callable[[str], Effect]) -> Description:
    """Return what a simulation file describes.

    Parameters
    ----------
    file
        The checked file.
    find
        Returns an installed effect by its identifier.

    Raises
    ------
    InputError
        If its targets do not fit into the travel, an effect lacks a parameter, or cannot act on this test.
    """
    keys, axis = file.keys, file.axis
    position = axis.position_unit
    description = Description(
        axis=axis,
        plan=Plan(
            targets=_targets(file),
            method=Method(keys.method),
            runs=keys.runs,
            overrun=position.to_si(keys.overrun),
            feed=position.to_si(keys.feed) / _SECONDS_PER_MINUTE,
            dwell=keys.dwell,
        ),
        seed=keys.seed,
        effects=chosen_terms(file.effects, find, axis.kind),
        conditions={name: _course(name, course) for name, course in keys.conditions.items()},
        noise=_noise(keys.noise, axis.deviation_unit),
        time_is_logged=keys.time_logged,
    )
    problems = list(_impossible(file, description))
    if problems:
        raise InputError(problems)
    return description


def _targets(file: SimulationFile) -> FloatArray:
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
        drawn = target_positions(
            keys.axis.travel, keys.targets.count, period, Stream.TARGETS.generator(keys.seed)
        )
    except ValueError as error:
        raise InputError.at(file.place_of("targets", "count"), f"targets.count: {error}") from error
    # as they can be typed into a part program, and never beyond an end
    typed = np.floor(drawn * 10**POSITION_DIGITS) / 10**POSITION_DIGITS
    return read_only_floats(unit.to_si(np.maximum(typed, keys.axis.travel[0])))


def _course(name: str, keys: CourseKeys) -> Course:
    kind = CONDITIONS.get(name)
    unit = kind.unit if kind else _AS_FOUND
    return Course(
        start=unit.to_si(keys.start),
        end=None if keys.end is None else unit.to_si(keys.end),
        time_constant=keys.time_constant,
        swing=keys.swing * unit.si,
        swing_period=keys.swing_period,
        sensor_noise=keys.sensor_noise * unit.si,
        resolution=keys.resolution * unit.si,
        is_logged=keys.logged,
    )


def _noise(keys: NoiseKeys, unit: Unit) -> Noise:
    return Noise(
        reading=unit.to_si(keys.reading),
        unequal=keys.unequal,
        position=unit.to_si(keys.position),
        position_and_direction=unit.to_si(keys.position_and_direction),
        run=unit.to_si(keys.run),
        drift=unit.to_si(keys.drift),
        drift_time=keys.drift_time,
        outlier_share=keys.outlier_share,
        outlier_size=unit.to_si(keys.outlier_size),
        missing_share=keys.missing_share,
        resolution=unit.to_si(keys.resolution),
    )


def _impossible(file: SimulationFile, description: Description) -> Iterator[Problem]:
    """Yield effects that cannot act: for want of a parameter or a condition, or on an axis of this kind."""
    design = design_of(description)
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
                for name, unit in _searched(term, description)
                if name not in known
            )
        if not any(parameter.name in term.fixed for parameter in effect.linear):
            example = effect.linear[0]
            unit = unit_of(example.dimension, file.axis.kind).symbol or "a number"
            yield Problem(
                choice.place,
                f"{effect.identifier} has no size; give {' or '.join(each.name for each in effect.linear)}, "
                f"as in {{{effect.identifier}: {{{example.name}: 1}}}} ({unit})",
            )


def _searched(term: Term, description: Description) -> Iterator[tuple[str, str]]:
    """Yield each searched parameter with what it is and its unit."""
    for parameter in term.effect.searched:
        unit = unit_of(parameter.dimension, description.axis.kind).symbol
        meaning = parameter.description.in_language(Language.ENGLISH)
        yield parameter.name, f"the {meaning}, {unit}" if unit else f"the {meaning}"
