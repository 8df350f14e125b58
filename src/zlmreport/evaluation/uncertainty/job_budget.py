"""From what a job states of its measuring set-up to the uncertainty budget."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np

from zlmreport.errors import InputError
from zlmreport.evaluation.uncertainty import wording
from zlmreport.evaluation.uncertainty.air import find_air_error, is_silent_on_air, list_air_contributions
from zlmreport.evaluation.uncertainty.budget import (
    Acts,
    Budget,
    Contribution,
    Distribution,
    KnownError,
    NoBudget,
    compute_expansion_range,
    compute_misalignment_range,
    compute_temperature_range,
    from_range,
    write_of_the_reading,
)
from zlmreport.evaluation.uncertainty.reasons import says_something
from zlmreport.evaluation.uncertainty.round_the_circle import list_circle_contributions
from zlmreport.evaluation.uncertainty.set_up import (
    INSTRUMENT,
    SetUp,
    has_radius,
    list_demanded,
    name_contributors_of_length,
)
from zlmreport.job.evaluation_keys import STATED_COVERAGE_FACTOR, ContributionKeys
from zlmreport.job.job import Job
from zlmreport.language import Words, same
from zlmreport.measurement.arrays import FloatArray, read_only_floats
from zlmreport.measurement.measurement_set import STATE_OF_AIR, MeasurementSet, find_last_digit, find_step
from zlmreport.measurement.units import (
    METRE,
    MICROMETRE,
    MICROMETRE_PER_METRE_KELVIN,
    MILLIMETRE,
    Unit,
    say_with_unit,
)

_OF_THE_READING = Unit("%", "%", 100.0)


def make_budget_of(
    job: Job, measurements: MeasurementSet, of_the_instrument: tuple[Contribution, ...] = ()
) -> Budget | NoBudget:
    """Return the budget of a job's set-up; none where the job gives no number for the instrument.

    `of_the_instrument`: The instrument's own contributions where it is no device of one uncertainty.

    Raises `InputError` if a figure is stated without what its formula needs beside it.
    """
    set_up = SetUp.of(job, measurements)
    keys = job.keys.uncertainty
    negligible = tuple(each for each in keys.negligible.items() if says_something(each[1]))
    instrument = of_the_instrument or _list_instrument_contributions(job, set_up)
    contributions = (
        *(() if isinstance(instrument, Words) else instrument),
        *_list_contributions_of_length(job, measurements, set_up),
        *(list_circle_contributions(job, job.axis.circle, measurements) if job.axis.circle else ()),
        *list_air_contributions(job, measurements, set_up.length),
        *_list_fluctuations(job, measurements),
        *(each for stated in keys.contributions for each in _make_other_contribution(stated, measurements)),
    )
    considered = {each.contributor for each in contributions} | {name for name, _ in negligible}
    if of_the_instrument:
        considered.add(INSTRUMENT)
    of_silence = () if of_the_instrument or not is_silent_on_air(job, measurements) else STATE_OF_AIR
    missing = tuple(name for name in list_demanded(job, of_silence) if name not in considered)
    has_length = (job.axis.has_length or has_radius(job)) and not of_the_instrument
    expansion = set_up.uncorrected_expansion if has_length else 0.0
    in_readings = (
        (*_list_expansion_in_readings(measurements, set_up), *find_air_error(job, measurements))
        if has_length
        else ()
    )
    if isinstance(instrument, Words):
        return NoBudget(instrument, missing, negligible, expansion)
    problems = sorted(set_up.list_lacking(job))
    if problems:
        raise InputError(problems)
    usual = not of_the_instrument and keys.instrument_acts is None
    return Budget(
        tuple(each for acts in Acts for each in contributions if each.acts is acts),
        missing,
        negligible,
        STATED_COVERAGE_FACTOR * math.fsum(each.standard_uncertainty for each in instrument)
        if usual
        else 0.0,
        _find_capability(job, set_up),
        expansion,
        in_readings,
        set_up.difference or 0.0,
    )


def _find_capability(job: Job, set_up: SetUp) -> float:
    """Return the smallest U that the laboratory's accreditation lets it state, m or rad."""
    cmc = job.keys.laboratory.cmc if job.keys.laboratory else None
    if cmc is None or not cmc.is_for(job.axis.measurand.identifier, job.axis.kind):
        return 0.0
    return float(job.axis.deviation_unit.to_si(cmc.constant + cmc.per_metre * set_up.length))


def _list_instrument_contributions(job: Job, set_up: SetUp) -> tuple[Contribution, ...] | Words:
    """Return the contributions of the instrument that the job names, or why there are none."""
    instrument = job.keys.instrument
    if instrument is None:
        return wording.NO_INSTRUMENT
    stated = instrument.stated_uncertainty
    if stated is None:
        in_words = isinstance(instrument.expanded_uncertainty, str)
        return wording.INSTRUMENT_IN_WORDS if in_words else wording.NO_INSTRUMENT
    return tuple(_list_device_contributions(*stated, job, set_up))


def _list_device_contributions(
    constant: float, per_metre: float, job: Job, set_up: SetUp
) -> Iterator[Contribution]:
    """Yield the constant part of an instrument's error, and the one that grows with the length."""
    unit = job.axis.deviation_unit
    stated_acts = job.keys.uncertainty.instrument_acts
    source = wording.say_calibration(job.keys.instrument.certificate if job.keys.instrument else None)
    for expanded, name, acts, stated in (
        (
            unit.to_si(constant),
            wording.DEVICE,
            Acts(stated_acts) if stated_acts else set_up.acts_of_device,
            wording.say_expanded_uncertainty(constant, unit.symbol, STATED_COVERAGE_FACTOR),
        ),
        (
            unit.to_si(per_metre) * set_up.length,
            wording.DEVICE_ALONG,
            set_up.acts_of_length,
            wording.say_expanded_uncertainty(per_metre, f"{unit.symbol}/m · L", STATED_COVERAGE_FACTOR),
        ),
    ):
        if expanded:
            yield Contribution(
                name=name,
                standard_uncertainty=expanded / STATED_COVERAGE_FACTOR,
                acts=acts,
                distribution=Distribution.NORMAL,
                stated=stated,
                source=source,
                contributor=INSTRUMENT,
            )


def _list_contributions_of_length(
    job: Job, measurements: MeasurementSet, set_up: SetUp
) -> Iterator[Contribution]:
    """Yield what is in proportion to the measured length: alignment, temperatures, expansion.

    Only of a length, or of a calibrated radius: what lies across the motion, turns or rises neither expands
    nor shortens with it, whatever a job that shares its keys with others states. A range of zero states
    nothing: there is no error of which nobody could be wrong.
    """
    keys, named = job.keys.uncertainty, name_contributors_of_length(job)
    length, acts = set_up.length, set_up.acts_of_length
    if not length:
        return
    if keys.misalignment and "misalignment" in named:
        full_range = compute_misalignment_range(MILLIMETRE.to_si(keys.misalignment), length)
        stated = wording.say_full_range("R", keys.misalignment, "mm")
        source = wording.MISALIGNED.given(length=say_with_unit(length, METRE.symbol))
        yield _make_contribution(
            "misalignment", full_range, stated, source, distribution=Distribution.ONE_SIDED
        )
    for key, temperature, expansion in (
        ("machine_temperature", keys.machine_temperature, set_up.of_the_sensor),
        ("device_temperature", keys.device_temperature, set_up.device_expansion),
    ):
        if temperature and expansion is not None and key in named:
            full_range = compute_temperature_range(expansion, length, temperature)
            source = wording.TEMPERATURE.given(
                expansion=expansion / MICROMETRE_PER_METRE_KELVIN, length=say_with_unit(length, METRE.symbol)
            )
            stated = wording.say_full_range("R(θ)", temperature, "K")
            yield _make_contribution(key, full_range, stated, source, acts=acts)
    for key, coefficient in (
        ("expansion_coefficient", keys.expansion_coefficient),
        ("device_expansion_coefficient", keys.device_expansion_coefficient),
    ):
        if coefficient and set_up.difference is not None and key in named:
            alpha = coefficient * MICROMETRE_PER_METRE_KELVIN
            full_range = compute_expansion_range(length, set_up.difference, alpha)
            stated = wording.say_full_range("R(α)", coefficient, "µm/(m·K)")
            yield replace(
                _make_contribution(key, full_range, stated, _say_from_which_difference(set_up), acts=acts),
                effect=_share_while_warming(measurements, set_up),
            )


def _say_from_which_difference(set_up: SetUp) -> Words:
    """Return from which difference to 20 °C an error of the coefficient becomes one of the length."""
    length = say_with_unit(set_up.length, METRE.symbol)
    if not set_up.warms_up or set_up.differences is None:
        return wording.EXPANSION.given(difference=set_up.difference or 0.0, length=length)
    low, high = (_write_shown(float(each)) for each in (set_up.differences.min(), set_up.differences.max()))
    return wording.EXPANSION_THAT_MOVES.given(low=low, high=high, length=length)


def _share_while_warming(measurements: MeasurementSet, set_up: SetUp) -> FloatArray | None:
    """Return which part of an error of the coefficient acts on each reading; None where ΔT stands still."""
    if not set_up.warms_up or set_up.differences is None or not set_up.difference:
        return None
    share = _measure_expanding_lengths(measurements, set_up) / set_up.length
    return read_only_floats(share * set_up.differences / set_up.difference)


def _measure_expanding_lengths(measurements: MeasurementSet, set_up: SetUp) -> FloatArray:
    """Return the length that expands under each reading, (N,), m: from the datum; of a circle its radius."""
    if set_up.is_circle:
        return np.full(len(measurements.target), set_up.length)
    return np.asarray(measurements.target_positions[measurements.target] - measurements.zero)


def _list_expansion_in_readings(measurements: MeasurementSet, set_up: SetUp) -> Iterator[KnownError]:
    """Yield the expansion that is in the readings, each by its own temperature: the machine may warm up."""
    alpha, expansion = set_up.uncorrected_coefficient, set_up.uncorrected_expansion
    if not (alpha and expansion) or set_up.differences is None:
        return
    distance = _measure_expanding_lengths(measurements, set_up)
    yield KnownError(
        name=wording.UNCORRECTED,
        correction=read_only_floats(-alpha * set_up.differences * distance),
        stated=wording.say_full_range("α·ΔT·L", _write_shown(MICROMETRE.from_si(expansion)), "µm"),
        source=wording.UNCORRECTED_SOURCE.given(
            expansion=_write_shown(alpha / MICROMETRE_PER_METRE_KELVIN),
            difference=_write_shown(set_up.difference or 0.0),
            length=say_with_unit(set_up.length, METRE.symbol),
        ),
    )


def _write_shown(value: float) -> float:
    return float(f"{value:.4g}")


def _list_fluctuations(job: Job, measurements: MeasurementSet) -> Iterator[Contribution]:
    """Yield what each reading has of its own: the drift of the environment, and its last digit.

    Readings that were corrected have digits that the instrument never showed: their resolution is to be
    stated. It is never smaller than the step in which the readings were given, nor negligible: no result is
    known better than it was read.
    """
    unit = job.axis.deviation_unit
    keys = job.keys.uncertainty
    step, source = keys.resolution or None, wording.STATED
    given = _step_given(measurements, unit)
    is_asked = not measurements.provenance.corrections or "resolution" in keys.negligible or step is not None
    if is_asked and given is not None and given > (step or 0.0):
        is_digit = given == find_last_digit(measurements) or bool(measurements.provenance.corrections)
        step, source = given, wording.LAST_DIGIT if is_digit else wording.STEPS
    for key, full_range, origin, acts in (
        ("environmental_variation", keys.environmental_variation, wording.DRIFT_AT_REST, Acts.IN_TIME),
        ("resolution", step, source, Acts.AT_EACH_READING),
    ):
        if full_range:
            stated = wording.say_full_range("R", full_range, unit.symbol)
            yield _make_contribution(key, unit.to_si(full_range), stated, origin, acts=acts)


def _step_given(measurements: MeasurementSet, unit: Unit) -> float | None:
    """Return the step in which the instrument showed the readings, in their unit; None where nobody knows."""
    provenance = measurements.provenance
    if provenance.corrections:
        return None if provenance.step is None else unit.from_si(provenance.step)
    return find_step(measurements)


def _make_contribution(  # noqa: PLR0913 - a usual contribution, but for what usually holds
    key: str,
    full_range: float,
    stated: Words,
    source: Words,
    *,
    acts: Acts = Acts.ALONG_THE_LENGTH,
    distribution: Distribution = Distribution.RECTANGULAR,
) -> Contribution:
    return Contribution(
        name=wording.USUAL[key],
        standard_uncertainty=from_range(full_range, distribution),
        acts=acts,
        distribution=distribution,
        stated=stated,
        source=source,
        contributor=key,
    )


def _make_other_contribution(keys: ContributionKeys, measurements: MeasurementSet) -> Iterator[Contribution]:
    """Yield a contribution that has no key of its own; none of no size."""
    is_share = keys.acts == Acts.WITH_THE_READING.value
    unit = _OF_THE_READING if is_share else measurements.axis.deviation_unit
    distribution = Distribution(keys.distribution or ("normal" if keys.range is None else "rectangular"))
    if keys.range is not None:
        stated = wording.say_full_range("R", keys.range, unit.symbol)
        standard_uncertainty = from_range(keys.range, distribution)
    elif keys.standard_uncertainty is not None:
        stated = wording.say_standard_uncertainty(keys.standard_uncertainty, unit)
        standard_uncertainty = keys.standard_uncertainty
    else:
        expanded = keys.expanded_uncertainty or 0.0
        stated = wording.say_expanded_uncertainty(expanded, unit.symbol, STATED_COVERAGE_FACTOR)
        standard_uncertainty = expanded / STATED_COVERAGE_FACTOR
    if not standard_uncertainty:
        return
    size = float(unit.to_si(standard_uncertainty))
    how: dict[str, Any] = {"standard_uncertainty": size, "acts": Acts(keys.acts)}
    if is_share:
        how = write_of_the_reading(size, measurements, keys.name)
    yield Contribution(
        name=same(keys.name),
        distribution=distribution,
        stated=stated,
        source=wording.say_calibration(keys.certificate),
        **how,
    )
