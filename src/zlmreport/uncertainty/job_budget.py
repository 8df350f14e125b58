"""From what a job states of its measuring set-up to the uncertainty budget, and what it leaves out.

A report with an incomplete budget says so wherever it states U; a calibration certificate is refused, with
what is to be stated and how. So is one of a length whose temperature nobody knows.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from zlmreport.errors import InputError, Problem
from zlmreport.job.evaluation_keys import ContributionKeys
from zlmreport.job.job import Job
from zlmreport.job.keys import JobKeys
from zlmreport.language import Words, same
from zlmreport.measurement.axis import AxisKind
from zlmreport.measurement.measurement_set import STATE_OF_AIR, MeasurementSet
from zlmreport.quantities.arrays import FloatArray, decimals_of
from zlmreport.quantities.units import (
    MICROMETRE,
    MICROMETRE_PER_METRE_KELVIN,
    MILLIMETRE,
    ZERO_CELSIUS,
    Unit,
    above_reference,
)
from zlmreport.uncertainty import wording
from zlmreport.uncertainty.air import air_contributions
from zlmreport.uncertainty.budget import (
    Acts,
    Budget,
    Contribution,
    Distribution,
    NoBudget,
    expansion_range,
    from_range,
    misalignment_range,
    temperature_range,
)
from zlmreport.values import dataclass

#: Of the uncertainties that a job states as expanded.
_COVERAGE_FACTOR = 2.0
#: A step that readings may show is no smaller, µm or ″.
_MOST_DECIMALS = 3
#: The temperature that the scale, and with it the measured length, has: the first that is known counts.
_TEMPERATURES = ("axis_temperature", "material_temperature")
#: What is printed as 20.0 °C is 20 °C, K.
_AT_REFERENCE = 0.05


def budget_of(
    job: Job, measurements: MeasurementSet, of_the_instrument: tuple[Contribution, ...] = ()
) -> Budget | NoBudget:
    """Return the budget of a job's set-up; none where the job gives no number for the instrument.

    `of_the_instrument`: The instrument's own contributions where it is no device of one uncertainty.

    Raises `InputError` if a figure is stated without what its formula needs beside it.
    """
    set_up = SetUp.of(job, measurements)
    keys = job.keys.uncertainty
    negligible = tuple(keys.negligible.items())
    instrument = of_the_instrument or _instrument(job, set_up)
    contributions = (
        *(() if isinstance(instrument, Words) else instrument),
        *_of_the_length(job, set_up, is_artefact=bool(of_the_instrument)),
        *air_contributions(job, measurements, set_up.length),
        *_fluctuations(job, measurements),
        *(_other(each, job.axis.deviation_unit) for each in keys.contributions),
    )
    considered = {each.contributor for each in contributions} | keys.negligible.keys()
    if of_the_instrument:
        considered.add(INSTRUMENT)
    missing = tuple(name for name in demanded(job.keys) if name not in considered)
    has_length = job.axis.kind is AxisKind.LINEAR and not of_the_instrument
    expansion = set_up.uncorrected_expansion if has_length else 0.0
    if isinstance(instrument, Words):
        return NoBudget(instrument, missing, negligible, expansion)
    problems = sorted(set_up.lacks(job))
    if problems:
        raise InputError(problems)
    usual = not of_the_instrument and keys.instrument_acts is None
    return Budget(
        tuple(each for acts in Acts for each in contributions if each.acts is acts),
        missing,
        negligible,
        _COVERAGE_FACTOR * math.fsum(each.standard_uncertainty for each in instrument) if usual else 0.0,
        _capability(job, set_up),
        expansion,
    )


def _capability(job: Job, set_up: SetUp) -> float:
    """Return the smallest U that the laboratory's accreditation lets it state, m or rad."""
    cmc = job.keys.laboratory.cmc if job.keys.laboratory else None
    if cmc is None:
        return 0.0
    return job.axis.deviation_unit.to_si(cmc.constant) + MICROMETRE.to_si(cmc.per_metre) * set_up.length


def _instrument(job: Job, set_up: SetUp) -> tuple[Contribution, ...] | Words:
    """Return the contributions of the instrument that the job names, or why there are none."""
    instrument = job.keys.instrument
    if instrument is None:
        return wording.NO_INSTRUMENT
    stated = instrument.stated_uncertainty
    if stated is None:
        in_words = isinstance(instrument.expanded_uncertainty, str)
        return wording.INSTRUMENT_IN_WORDS if in_words else wording.NO_INSTRUMENT
    return tuple(_device(*stated, job, set_up))


def _device(constant: float, per_metre: float, job: Job, set_up: SetUp) -> Iterator[Contribution]:
    """Yield the constant part of an instrument's error, and the one that grows with the length."""
    unit = job.axis.deviation_unit
    stated_acts = job.keys.uncertainty.instrument_acts
    source = wording.calibration(job.keys.instrument.certificate if job.keys.instrument else None)
    for expanded, name, acts, stated in (
        (
            unit.to_si(constant),
            wording.DEVICE,
            Acts(stated_acts) if stated_acts else Acts.AT_EACH_POSITION,
            wording.expanded(constant, unit.symbol, _COVERAGE_FACTOR),
        ),
        (
            MICROMETRE.to_si(per_metre) * set_up.length,
            wording.DEVICE_ALONG,
            Acts.ALONG_THE_LENGTH,
            wording.expanded(per_metre, "µm/m · L", _COVERAGE_FACTOR),
        ),
    ):
        if expanded:
            yield Contribution(
                name=name,
                standard_uncertainty=expanded / _COVERAGE_FACTOR,
                acts=acts,
                distribution=Distribution.NORMAL,
                stated=stated,
                source=source,
                contributor=INSTRUMENT,
            )


def _of_the_length(job: Job, set_up: SetUp, *, is_artefact: bool) -> Iterator[Contribution]:
    """Yield what is in proportion to the measured length: alignment, temperatures, expansion.

    An artefact's own contributions have the expansion of machine and artefact in them.
    """
    keys = job.keys.uncertainty
    length = set_up.length
    if keys.misalignment is not None:
        full_range = misalignment_range(MILLIMETRE.to_si(keys.misalignment), length)
        stated = wording.full_range("R", keys.misalignment, "mm")
        source = wording.MISALIGNED.given(length=wording.length(length))
        yield _contribution("misalignment", full_range, stated, source, distribution=Distribution.ONE_SIDED)
    for key, temperature, expansion in (
        ("machine_temperature", keys.machine_temperature, set_up.expansion),
        ("device_temperature", keys.device_temperature, set_up.device_expansion),
    ):
        if temperature is not None and expansion is not None:
            full_range = temperature_range(expansion, length, temperature)
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
            full_range = expansion_range(length, set_up.difference, alpha)
            source = wording.EXPANSION.given(difference=set_up.difference, length=wording.length(length))
            yield _contribution(key, full_range, wording.full_range("R(α)", coefficient, "µm/(m·K)"), source)
    expansion = 0.0 if is_artefact else set_up.uncorrected_expansion
    if job.axis.kind is AxisKind.LINEAR and expansion:
        yield Contribution(
            name=wording.UNCORRECTED,
            standard_uncertainty=abs(expansion),
            acts=Acts.ALONG_THE_LENGTH,
            distribution=Distribution.KNOWN,
            stated=wording.full_range("α·ΔT·L", _shown(MICROMETRE.from_si(expansion)), "µm"),
            source=wording.UNCORRECTED_SOURCE.given(
                expansion=_shown((set_up.expansion or 0.0) / MICROMETRE_PER_METRE_KELVIN),
                difference=_shown(set_up.difference or 0.0),
                length=wording.length(set_up.length),
            ),
            sign=-1 if expansion > 0 else 1,  # what a warm machine shows too long would have to be taken off
        )


def _shown(value: float) -> float:
    return float(f"{value:.4g}")


def _fluctuations(job: Job, measurements: MeasurementSet) -> Iterator[Contribution]:
    """Yield what each reading has of its own: the drift of the environment, and its last digit.

    Readings that were corrected have digits that the instrument never showed.
    """
    unit = job.axis.deviation_unit
    keys = job.keys.uncertainty
    step, source = keys.resolution, wording.STATED
    if step is None and not measurements.provenance.corrections:
        step, source = _last_digit(unit.from_si(measurements.deviation)), wording.LAST_DIGIT
    for key, full_range, origin, acts in (
        ("environmental_variation", keys.environmental_variation, wording.DRIFT_AT_REST, Acts.IN_TIME),
        ("resolution", step, source, Acts.AT_EACH_READING),
    ):
        if full_range is not None:
            stated = wording.full_range("R", full_range, unit.symbol)
            yield _contribution(key, unit.to_si(full_range), stated, origin, acts=acts)


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
        standard_uncertainty=from_range(full_range, distribution),
        acts=acts,
        distribution=distribution,
        stated=stated,
        source=source,
        contributor=key,
    )


def _other(keys: ContributionKeys, unit: Unit) -> Contribution:
    """Return a contribution that has no key of its own."""
    distribution = Distribution(keys.distribution or ("normal" if keys.range is None else "rectangular"))
    if keys.range is not None:
        stated = wording.full_range("R", keys.range, unit.symbol)
        standard_uncertainty = from_range(keys.range, distribution)
    elif keys.standard_uncertainty is not None:
        stated = wording.standard(keys.standard_uncertainty, unit)
        standard_uncertainty = keys.standard_uncertainty
    else:
        expanded = keys.expanded_uncertainty or 0.0
        stated = wording.expanded(expanded, unit.symbol, _COVERAGE_FACTOR)
        standard_uncertainty = expanded / _COVERAGE_FACTOR
    return Contribution(
        name=same(keys.name),
        standard_uncertainty=unit.to_si(standard_uncertainty),
        acts=Acts(keys.acts),
        distribution=distribution,
        stated=stated,
        source=wording.STATED,
    )


@dataclass(frozen=True, slots=True)
class SetUp:
    """The circumstances of a test, SI; None for what is not known as a number."""

    length: float  #: L, from the first target position to the last, m or rad.
    expansion: float | None  #: α of the machine, 1/K.
    device_expansion: float | None  #: α of the measuring device, 1/K.
    #: ΔT, the largest distance of the machine's temperature from 20 °C, K, with its sign; the measuring
    #: device lies on the machine and is taken to share it.
    difference: float | None
    is_corrected: bool = False  #: Whether the readings are corrected to 20 °C.

    @classmethod
    def of(cls, job: Job, measurements: MeasurementSet) -> SetUp:
        """Return the circumstances that a job and its readings tell."""
        targets = measurements.target_positions
        environment, instrument, corrections = job.keys.environment, job.keys.instrument, job.keys.corrections
        material = corrections.material if corrections else None
        stated = environment.expansion_coefficient if environment else None
        return cls(
            length=float(targets[-1] - targets[0]),
            expansion=_coefficient((material and material.expansion_coefficient) or stated),
            device_expansion=_coefficient(instrument.expansion_coefficient if instrument else None),
            difference=_difference(job, measurements),
            is_corrected=material is not None,
        )

    @property
    def is_at_reference(self) -> bool:
        """Whether the machine was at 20 °C."""
        return self.difference is not None and abs(self.difference) < _AT_REFERENCE

    @property
    def uncorrected_expansion(self) -> float | None:
        """By how much the measured length was longer than at 20 °C, against the measuring device, m.

        0 where the readings are corrected to 20 °C, or were taken there; None where it is not known.
        """
        if self.is_corrected or self.is_at_reference:
            return 0.0
        if self.difference is None or self.expansion is None:
            return None
        return (self.expansion - (self.device_expansion or 0.0)) * self.difference * self.length

    def lacks(self, job: Job) -> Iterator[Problem]:
        """Yield the keys of the budget whose formula needs what is not known."""
        keys = job.keys.uncertainty
        temperature = "environment.axis_temperature or environment.material_temperature"
        machine, device = "environment.expansion_coefficient", "instrument.expansion_coefficient"
        for key, known, needed in (
            ("machine_temperature", self.expansion, machine),
            ("device_temperature", self.device_expansion, device),
            ("expansion_coefficient", self.difference, temperature),
            ("device_expansion_coefficient", self.difference, temperature),
        ):
            if getattr(keys, key) is not None and known is None:
                path = f"uncertainty.{key}"
                yield Problem(
                    job.place_of(path),
                    f"{path}: its part of the uncertainty cannot be computed without a number in {needed}",
                )


def _coefficient(stated: float | str | None) -> float | None:
    return stated * MICROMETRE_PER_METRE_KELVIN if isinstance(stated, float) else None


def _difference(job: Job, measurements: MeasurementSet) -> float | None:
    """Return ΔT of the first temperature that the job states as a number, or that was logged."""
    for key in _TEMPERATURES:
        stated = getattr(job.keys.environment, key, None)
        logged = measurements.conditions.get(key)
        if isinstance(stated, float):
            return above_reference(stated + ZERO_CELSIUS)
        if stated is None and logged is not None and np.isfinite(logged).any():
            differences = above_reference(logged[np.isfinite(logged)])
            return float(differences[np.argmax(np.abs(differences))])
    return None


INSTRUMENT = "instrument"
_OF_EVERY_AXIS = ("environmental_variation", "resolution")
_OF_LENGTHS = (
    "misalignment",
    "machine_temperature",
    "device_temperature",
    "expansion_coefficient",
    "device_expansion_coefficient",
)
_HOW: dict[str, str] = {
    INSTRUMENT: "state instrument.expanded_uncertainty as a number (µm or ″, k = 2)",
    "misalignment": "state how far the measuring line departs from the axis over its length, mm",
    "machine_temperature": "state the range of error of the machine's measured temperature, K, and "
    "environment.expansion_coefficient",
    "device_temperature": "state the range of error of the measuring device's temperature, K, and "
    "instrument.expansion_coefficient",
    "expansion_coefficient": "state the range of the machine's coefficient, µm/(m·K), and "
    "environment.axis_temperature",
    "device_expansion_coefficient": "state the range of the measuring device's coefficient, µm/(m·K), and "
    "environment.axis_temperature",
    "air_temperature": "state the range of error of the measured air temperature, K",
    "air_pressure": "state the range of error of the measured air pressure, hPa",
    "relative_humidity": "state the range of error of the measured humidity, %",
    "environmental_variation": "state the range of the readings of the axis at rest over the time of a test",
    "resolution": "state the smallest step of the readings: corrected ones do not show it",
}


def demanded(keys: JobKeys) -> tuple[str, ...]:
    """Return the contributors that a job must state, by axis and set-up."""
    of_lengths = _OF_LENGTHS if keys.axis.kind is AxisKind.LINEAR else ()
    of_air = STATE_OF_AIR if keys.corrections and keys.corrections.air else ()
    return (INSTRUMENT, *of_lengths, *of_air, *_OF_EVERY_AXIS)


def refusals(job: Job, budget: Budget | NoBudget) -> Iterator[Problem]:
    """Yield what a calibration certificate must state of its uncertainty and does not.

    `job`: The job; a report may leave out what it says that it leaves out.
    """
    if job.keys.certificate.kind != "certificate":
        return
    for name in budget.missing:
        key = "instrument.expanded_uncertainty" if name == INSTRUMENT else f"uncertainty.{name}"
        yield Problem(
            job.place_of(key),
            f"a calibration certificate needs {key}: {_HOW[name]}; or say why it is negligible: "
            f"uncertainty.negligible: {{{name}: reason}}",
        )
    if budget.uncorrected_expansion is None:
        yield Problem(
            job.place_of("environment"),
            "a calibration certificate needs the temperature of the measured length: state environment."
            "axis_temperature and environment.expansion_coefficient (the expansion then enters U), or "
            "correct the readings to 20 °C by corrections.material",
        )
