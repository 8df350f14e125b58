"""From what a job states of its measuring set-up to the uncertainty budget."""

from __future__ import annotations

from collections.abc import Iterator

from zlmreport.errors import InputError
from zlmreport.job.evaluation_keys import ContributionKeys
from zlmreport.job.job import Job
from zlmreport.job.measurement_keys import Instrument
from zlmreport.language import Words, same
from zlmreport.measurement.axis import AxisKind
from zlmreport.measurement.measurement_set import MeasurementSet
from zlmreport.quantities.arrays import FloatArray
from zlmreport.quantities.decimals import decimals_of
from zlmreport.quantities.units import MICROMETRE, MICROMETRE_PER_METRE_KELVIN, MILLIMETRE, Unit
from zlmreport.uncertainty import terms, wording
from zlmreport.uncertainty.air import air_contributions
from zlmreport.uncertainty.budget import Budget, NoBudget
from zlmreport.uncertainty.contribution import Acts, Contribution, Distribution
from zlmreport.uncertainty.set_up import SetUp

#: Of the uncertainties that a job states as expanded.
_COVERAGE_FACTOR = 2.0
#: A step that readings may show is no smaller, µm or ″.
_MOST_DECIMALS = 3


def budget_of(
    job: Job, measurements: MeasurementSet, of_the_instrument: tuple[Contribution, ...] = ()
) -> Budget | NoBudget:
    """Return the budget of a job's set-up; none where the job gives no number for the instrument.

    Parameters
    ----------
    job
        The job.
    measurements
        Its readings.
    of_the_instrument
        The instrument's own contributions where it is no device of one uncertainty, but a step gauge.

    Raises
    ------
    InputError
        If a figure is stated without what its formula needs beside it.
    """
    set_up = SetUp.of(job, measurements)
    instrument = of_the_instrument or _instrument(job, set_up)
    if isinstance(instrument, NoBudget):
        return instrument
    problems = sorted(set_up.lacks(job))
    if problems:
        raise InputError(problems)
    contributions = (
        *instrument,
        *_of_the_length(job, set_up),
        *air_contributions(job, measurements, set_up.length),
        *_fluctuations(job, measurements),
        *(_other(each, job.axis.deviation_unit) for each in job.keys.uncertainty.contributions),
    )
    usual = wording.USUAL if job.axis.kind is AxisKind.LINEAR else wording.USUAL_OF_ROTARY
    considered = [each.name for each in contributions]
    ordered = tuple(each for acts in Acts for each in contributions if each.acts is acts)
    return Budget(ordered, tuple(words for words in usual.values() if words not in considered))


def _instrument(job: Job, set_up: SetUp) -> tuple[Contribution, ...] | NoBudget:
    """Return the contribution of the instrument that the job names."""
    instrument = job.keys.instrument
    if instrument is None or not (
        instrument.expanded_uncertainty or instrument.expanded_uncertainty_per_metre
    ):
        return NoBudget(wording.NO_INSTRUMENT)
    if isinstance(instrument.expanded_uncertainty, str):
        return NoBudget(wording.INSTRUMENT_IN_WORDS)
    return (_device(instrument, instrument.expanded_uncertainty or 0.0, job, set_up),)


def _device(instrument: Instrument, constant: float, job: Job, set_up: SetUp) -> Contribution:
    unit = job.axis.deviation_unit
    per_metre = instrument.expanded_uncertainty_per_metre or 0.0
    along = job.axis.kind is AxisKind.LINEAR
    usual = Acts.ALONG_THE_LENGTH if along else Acts.AT_EACH_POSITION
    stated_acts = job.keys.uncertainty.instrument_acts
    return Contribution(
        name=wording.DEVICE,
        standard_uncertainty=terms.device(
            unit.to_si(constant), MICROMETRE.to_si(per_metre), set_up.length, _COVERAGE_FACTOR
        ),
        acts=Acts(stated_acts) if stated_acts else usual,
        distribution=Distribution.NORMAL,
        stated=wording.expanded(constant, per_metre, unit, _COVERAGE_FACTOR),
        source=wording.calibration(instrument.certificate),
    )


def _of_the_length(job: Job, set_up: SetUp) -> Iterator[Contribution]:
    """Yield what is in proportion to the measured length: alignment, temperatures, expansion."""
    keys = job.keys.uncertainty
    length = set_up.length
    if keys.misalignment is not None:
        full_range = terms.misalignment_range(MILLIMETRE.to_si(keys.misalignment), length)
        stated = wording.full_range("R", keys.misalignment, "mm")
        source = wording.MISALIGNED.given(length=wording.length(length))
        yield _contribution("misalignment", full_range, stated, source, distribution=Distribution.ONE_SIDED)
    for key, temperature, expansion in (
        ("machine_temperature", keys.machine_temperature, set_up.expansion),
        ("device_temperature", keys.device_temperature, set_up.device_expansion),
    ):
        if temperature is not None and expansion is not None:
            full_range = terms.temperature_range(expansion, length, temperature)
            source = wording.TEMPERATURE.given(
                expansion=expansion / MICROMETRE_PER_METRE_KELVIN, length=wording.length(length)
            )
            yield _contribution(key, full_range, wording.full_range("R(θ)", temperature, "K"), source)
    for key, coefficient in (
        ("expansion_coefficient", keys.expansion_coefficient),
        ("device_expansion_coefficient", keys.device_expansion_coefficient),
    ):
        if coefficient is not None and set_up.difference is not None:
            alpha = coefficient * MICROMETRE_PER_METRE_KELVIN
            full_range = terms.expansion_range(length, set_up.difference, alpha)
            source = wording.EXPANSION.given(difference=set_up.difference, length=wording.length(length))
            yield _contribution(key, full_range, wording.full_range("R(α)", coefficient, "µm/(m·K)"), source)


def _fluctuations(job: Job, measurements: MeasurementSet) -> Iterator[Contribution]:
    """Yield what each reading has of its own: the drift of the environment, and its last digit.

    Readings that were corrected have digits that the instrument never showed.
    """
    unit = job.axis.deviation_unit
    keys = job.keys.uncertainty
    step, source = keys.resolution, wording.STATED
    if step is None and not measurements.provenance.corrections:
        step, source = _last_digit(unit.from_si(measurements.deviation)), wording.LAST_DIGIT
    for key, full_range, origin in (
        ("environmental_variation", keys.environmental_variation, wording.DRIFT_AT_REST),
        ("resolution", step, source),
    ):
        if full_range is not None:
            stated = wording.full_range("R", full_range, unit.symbol)
            yield _contribution(key, unit.to_si(full_range), stated, origin, acts=Acts.AT_EACH_READING)


def _last_digit(readings: FloatArray) -> float:
    """Return the step of the last decimal in which readings were given; that of the third one at least."""
    return float(10.0 ** -decimals_of(readings, _MOST_DECIMALS))


def _contribution(  # noqa: PLR0913 - a usual contribution, but for what usually holds
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
        standard_uncertainty=terms.from_range(full_range, distribution),
        acts=acts,
        distribution=distribution,
        stated=stated,
        source=source,
    )


def _other(keys: ContributionKeys, unit: Unit) -> Contribution:
    """Return a contribution that has no key of its own."""
    distribution = Distribution(keys.distribution or ("normal" if keys.range is None else "rectangular"))
    if keys.range is not None:
        stated = wording.full_range("R", keys.range, unit.symbol)
        standard_uncertainty = terms.from_range(keys.range, distribution)
    elif keys.standard_uncertainty is not None:
        stated = wording.standard(keys.standard_uncertainty, unit)
        standard_uncertainty = keys.standard_uncertainty
    else:
        expanded = keys.expanded_uncertainty or 0.0
        stated = wording.expanded(expanded, 0.0, unit, _COVERAGE_FACTOR)
        standard_uncertainty = expanded / _COVERAGE_FACTOR
    return Contribution(
        name=same(keys.name),
        standard_uncertainty=unit.to_si(standard_uncertainty),
        acts=Acts(keys.acts),
        distribution=distribution,
        stated=stated,
        source=wording.STATED,
    )
