"""Warnings on traceability: dates of calibrations, missing certificates, ranges, the accredited scope.

A calibration certificate is refused where the chain is broken by the job's own words; what is merely not
said, or old, is marked on its first page, as all of it is in a measuring report.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from zlmreport.errors import Problem
from zlmreport.evaluation.correction.compensated import find_compensated_by_instrument
from zlmreport.evaluation.uncertainty.reasons import is_reference
from zlmreport.job.contradictions import find_last_day
from zlmreport.language import Language, Words, same
from zlmreport.measurement.axis import AxisKind
from zlmreport.measurement.measurand import ANGLE, CIRCLE, POSITIONING, STRAIGHTNESS
from zlmreport.measurement.measurement_set import CONDITION_NAMES, CONDITIONS, MeasurementSet
from zlmreport.measurement.units import CELSIUS, say_stated, say_with_unit

if TYPE_CHECKING:
    from zlmreport.job.document_keys import Capability
    from zlmreport.job.job import Job
    from zlmreport.job.keys import JobKeys
    from zlmreport.job.measurement_keys import InstrumentKeys, SensorKeys

#: Years after which a calibration is called old: intervals of measuring instruments are one to three.
_OLD = 3
_DAYS_OF_A_YEAR = 365.25
_ROUNDING = 1e-9
#: Temperatures that lengths have, and the one at which they hold, °C.
_OF_LENGTHS, _REFERENCE = ("axis_temperature", "material_temperature"), 20.0

_OLD_CALIBRATION = Words("{what}: calibrated on {date}, {years} years before the measurement")
_AFTER = Words("{what}: calibrated on {date}, after the measurement of {measured}")
_OVERDUE = Words("{what}: calibration was due on {date}, before the measurement of {measured}")
_NO_CERTIFICATE = Words("{what}: no calibration certificate named, so not shown to be traceable")
_THIS_DOCUMENT = Words("{what}: the calibration certificate named, {number}, is this document")
_NO_THERMOMETER = Words("A temperature enters the results, and no thermometer is named with its calibration")
_OUT_OF_SCOPE = Words("Outside the accredited scope: {what}")
_OF_KIND = {
    AxisKind.LINEAR: Words("results of a linear axis"),
    AxisKind.ROTARY: Words("results of a rotary axis"),
}
_OF_LENGTH = Words("results over {length} (the scope ends at {most})")
_OTHER_CAPABILITY = Words(
    "Outside the accredited scope: {quantity}. The capability that the laboratory states is for {own}; no "
    "U is raised to it"
)
_OF_QUANTITY = {each.identifier: each.title for each in (POSITIONING, STRAIGHTNESS, ANGLE, CIRCLE)}
_OF_STANDARD = Words("results by {standard}")
_INSTRUMENT = Words("Measuring instrument")
_OUT_OF_RANGE = Words("Outside the calibrated range of the measuring instrument: {what}")
_OF_SPAN = Words("results over {length} (it is calibrated over {most})")
_OF_TEMPERATURE = Words(
    "Outside the calibrated range of the thermometers: {name} {value} °C (they are calibrated from {low} to "
    "{high} °C)"
)


class _Break(NamedTuple):
    """A place at which the chain does not hold."""

    key: str  #: The job key that would have to be another.
    words: Words
    is_broken: bool  #: Whether by the job's own words, so that a calibration certificate is refused.


def find_doubts(job: Job, measurements: MeasurementSet) -> Iterator[Words]:
    """Yield a sentence for each place at which the chain does not hold, or is not said to."""
    laboratory, instrument, environment = job.keys.laboratory, job.keys.instrument, job.keys.environment
    found = [*_find_breaks_of_instruments(job.keys), *_find_breaks_of_artefacts(job)]
    if job.keys.certificate.kind == "certificate" and not (environment and environment.thermometers):
        found += _find_breaks_of_temperatures(job, measurements)
    yield from (each.words for each in found)
    if laboratory and laboratory.cmc:
        yield from _say_out_of_scope(job, laboratory.cmc, measurements)
    if instrument and instrument.calibrated_range:
        yield from _say_out_of_range(instrument.calibrated_range, measurements)
    extents = [each.calibrated_range for each in environment.thermometers] if environment else []
    known = [each for each in extents if each]
    if known and len(known) == len(extents):
        yield from _say_too_warm(job, known, measurements)


def find_other_capability(job: Job) -> Iterator[Words]:
    """Yield that the laboratory's capability is for another quantity than the one that a job is about.

    Of several lines it is the one that they were measured for: squareness, and not the straightness of both.
    """
    cmc = job.keys.laboratory.cmc if job.keys.laboratory else None
    if cmc and cmc.quantity != job.axis.measurand.identifier:
        yield _OTHER_CAPABILITY.given(quantity=job.axis.measurand.title, own=_OF_QUANTITY[cmc.quantity])


def find_doubts_of_artefacts(job: Job) -> Iterator[Words]:
    """Yield the artefacts of a job that are not shown to be traceable: those of all its lines together."""
    yield from (each.words for each in _find_breaks_of_artefacts(job))


@dataclass(frozen=True, slots=True)
class TraceabilityChain:
    """The calibration certificates through which results are traceable, each once."""

    of_instruments: tuple[str, ...] = ()
    of_artefacts: tuple[str, ...] = ()  #: Of squares, straightedges, bars: what was measured against.


def find_chain(job: Job) -> TraceabilityChain:
    """Return the calibration certificates through which the results of a job are traceable.

    Of the instrument of every line of every part, and of the artefacts that were measured against; none
    where an instrument, or an artefact of which U is stated, names no certificate, or where something that
    the job says breaks the chain, or a day is not stated.
    """
    lines = [line for part in job.parts for line in part.lines.values()]
    of_all = [each.keys for each in (job, *lines, *(one.as_found for one in lines if one.as_found))]
    named = [(each.keys.instrument and each.keys.instrument.certificate) or "" for each in lines]
    is_dated = all(keys.measurement.date for keys in of_all)
    if not is_dated or any(each.is_broken for keys in of_all for each in _find_breaks_of_instruments(keys)):
        return TraceabilityChain()
    of_artefacts = [each for part in job.parts for each in _list_artefacts(part)]
    if not all(map(is_reference, (*named, *of_artefacts))):
        return TraceabilityChain()
    own = dict.fromkeys(named)
    return TraceabilityChain(
        tuple(own), tuple(each for each in dict.fromkeys(of_artefacts) if each not in own)
    )


def _list_artefacts(job: Job) -> Iterator[str]:
    """Yield the certificate of each artefact that was measured against; empty where none is named.

    An artefact is a group of keys that a standard takes from the measurement, such as a square, or causes a
    contribution that the job states with its certificate.
    """
    for _, group in _list_artefact_keys(job):
        certificate = getattr(group, "certificate", None) or ""
        yield "" if _is_this_document(job.keys, certificate) else certificate
    for line in job.lines.values():
        stated = line.keys.uncertainty.contributions
        yield from (each.certificate for each in stated if each.certificate)


def _list_artefact_keys(job: Job) -> Iterator[tuple[str, object]]:
    """Yield the groups of keys of which a certificate or U is stated, each by its name."""
    for choice in job.standards:
        for key in choice.options.of_the_measurement:
            group = getattr(choice.options, key, None)
            is_stated = getattr(group, "expanded_uncertainty", None) is not None
            if getattr(group, "certificate", None) or is_stated:
                yield key, group


def is_within_calibrated_range(job: Job, measurements: MeasurementSet) -> bool:
    """Return whether no instrument was used, on any line, over more than it is calibrated for."""
    for name, line in job.lines.items():
        extent = line.keys.instrument.calibrated_range if line.keys.instrument else None
        if extent and any(_say_out_of_range(extent, measurements.tests.get(name, measurements))):
            return False
    return True


def find_broken_chain(job: Job) -> Iterator[Problem]:
    """Yield what breaks the chain of a calibration certificate by the job's own words."""
    if job.keys.certificate.kind != "certificate":
        return
    for each in (*_find_breaks_of_instruments(job.keys), *_find_breaks_of_artefacts(job)):
        if each.is_broken:
            yield Problem(
                job.place_of(each.key),
                f"{each.key}: {each.words.in_language(Language.ENGLISH)}: a calibration certificate needs a "
                "calibration that was valid at the measurement (ISO/IEC 17025:2017, 7.8.4.1 c); state the "
                "one that was",
            )


def _find_breaks_of_instruments(keys: JobKeys) -> Iterator[_Break]:
    instrument, environment = keys.instrument, keys.environment
    if instrument is not None:
        yield from _find_breaks_of_calibration(keys, instrument, "instrument", _INSTRUMENT)
    for number, each in enumerate(environment.thermometers if environment else ()):
        yield from _find_breaks_of_calibration(
            keys, each, f"environment.thermometers.{number}", same(each.name)
        )


def _find_breaks_of_artefacts(job: Job) -> Iterator[_Break]:
    """Yield the artefacts of which no calibration certificate is named, or this document, each once."""
    for key, group in dict(_list_artefact_keys(job)).items():
        certificate, name = getattr(group, "certificate", None) or "", getattr(group, "name", None)
        what = same(name) if name else Words("What was measured against ({key})").given(key=key)
        where = f"{_find_group(job, key)}.certificate"
        if not is_reference(certificate):
            yield _Break(where, _NO_CERTIFICATE.given(what=what), is_broken=False)
        elif _is_this_document(job.keys, certificate):
            words = _THIS_DOCUMENT.given(what=what, number=job.keys.certificate.number)
            yield _Break(where, words, is_broken=True)


def _find_group(job: Job, key: str) -> str:
    """Return the dotted name of a group of keys that a standard takes from the measurement."""
    places = (
        f"evaluate.{number}.{key}"
        for number, choice in enumerate(job.standards)
        if key in choice.options.of_the_measurement
    )
    return next(places, key)


def _is_this_document(keys: JobKeys, certificate: str) -> bool:
    return certificate.casefold() == keys.certificate.number.casefold()


def _find_breaks_of_calibration(
    keys: JobKeys, device: InstrumentKeys | SensorKeys, key: str, what: Words
) -> Iterator[_Break]:
    """Yield where the calibration of a device does not cover the day of the measurement."""
    first, last = keys.measurement.date, find_last_day(keys.measurement)
    is_instrument = key == "instrument"
    if not is_reference(device.certificate or "") and not is_instrument:
        yield _Break(f"{key}.certificate", _NO_CERTIFICATE.given(what=what), is_broken=False)
    elif is_instrument and device.certificate and not is_reference(device.certificate):
        yield _Break(f"{key}.certificate", _NO_CERTIFICATE.given(what=what), is_broken=True)
    if device.certificate and _is_this_document(keys, device.certificate):
        words = _THIS_DOCUMENT.given(what=what, number=keys.certificate.number)
        yield _Break(f"{key}.certificate", words, is_broken=True)
    day = device.calibrated
    if day is None:
        if device.certificate and is_reference(device.certificate):
            words = Words("{what}: date of calibration not stated").given(what=what)
            yield _Break(f"{key}.calibrated", words, is_broken=False)
    elif first and day > first:
        words = _AFTER.given(what=what, date=day.isoformat(), measured=first.isoformat())
        yield _Break(f"{key}.calibrated", words, is_broken=True)
    elif first and (first - day).days > _OLD * _DAYS_OF_A_YEAR:
        years = int((first - day).days / _DAYS_OF_A_YEAR)
        words = _OLD_CALIBRATION.given(what=what, date=day.isoformat(), years=years)
        yield _Break(f"{key}.calibrated", words, is_broken=False)
    if device.due and last and device.due < last:
        words = _OVERDUE.given(what=what, date=device.due.isoformat(), measured=last.isoformat())
        yield _Break(f"{key}.due", words, is_broken=True)


def _find_breaks_of_temperatures(job: Job, measurements: MeasurementSet) -> Iterator[_Break]:
    """Yield that a temperature enters the results and nobody says by which thermometer it was measured."""
    corrections = job.keys.corrections
    by_program = corrections is not None and (corrections.material or corrections.air)
    is_counted = by_program or _is_expanded(job, measurements)
    if is_counted and not find_compensated_by_instrument(job, measurements).material:
        yield _Break("environment.thermometers", _NO_THERMOMETER, is_broken=False)


def _is_expanded(job: Job, measurements: MeasurementSet) -> bool:
    """Return whether a length was measured at another temperature than 20 °C, so that expansion counts."""
    if not job.axis.has_length:
        return False
    environment = job.keys.environment
    stated = (getattr(environment, each, None) for each in _OF_LENGTHS)
    return any(isinstance(each, float) and each != _REFERENCE for each in stated) or any(
        each in measurements.conditions for each in _OF_LENGTHS
    )


def _say_out_of_scope(job: Job, cmc: Capability, measurements: MeasurementSet) -> Iterator[Words]:
    """Yield which results lie outside the scope for which the laboratory is accredited for their quantity."""
    axis, targets = job.axis, measurements.target_positions
    if cmc.quantity != axis.measurand.identifier:
        return
    if cmc.axes not in (None, axis.kind):
        yield _OUT_OF_SCOPE.given(what=_OF_KIND[axis.kind])
    length = axis.position_unit.from_si(float(targets[-1] - targets[0]))
    if cmc.length is not None and length > cmc.length * (1 + _ROUNDING):
        over = say_stated(length, axis.position_unit.symbol)
        most = say_stated(cmc.length, axis.position_unit.symbol)
        yield _OUT_OF_SCOPE.given(what=_OF_LENGTH.given(length=over, most=most))
    for choice in job.standards:
        if cmc.standards is not None and choice.identifier not in cmc.standards:
            yield _OUT_OF_SCOPE.given(what=_OF_STANDARD.given(standard=choice.identifier))


def _say_out_of_range(extent: tuple[float, float], measurements: MeasurementSet) -> Iterator[Words]:
    """Yield which results lie over more than what the instrument is calibrated for.

    Where its range begins nobody sees in deviations: a length, or a span of readings, is held against the
    width of the range.
    """
    if not np.isfinite(measurements.deviation).any():
        return
    axis, width = measurements.axis, extent[1] - extent[0]
    is_position = axis.measurand.is_position
    unit = axis.position_unit if is_position else axis.deviation_unit
    spanned = measurements.target_positions if is_position else measurements.deviation
    span = unit.from_si(float(np.nanmax(spanned) - np.nanmin(spanned)))
    if span > width * (1 + _ROUNDING):
        over = say_with_unit(float(f"{span:.4g}"), unit.symbol)
        most = say_stated(width, unit.symbol)
        yield _OUT_OF_RANGE.given(what=_OF_SPAN.given(length=over, most=most))


def _say_too_warm(
    job: Job, known: Sequence[tuple[float, float]], measurements: MeasurementSet
) -> Iterator[Words]:
    """Yield the temperatures, stated or logged, for which no thermometer is calibrated.

    `known`: The ranges of all thermometers. Which of them measured what, a job does not say: as long as one
        states no range, it may have been that.
    """
    for name, kind in CONDITIONS.items():
        if kind.unit is not CELSIUS:
            continue
        stated = getattr(job.keys.environment, name, None)
        logged = measurements.conditions.get(name)
        values = [stated] if isinstance(stated, float) else []
        if logged is not None and np.isfinite(logged).any():
            values += [kind.unit.from_si(float(each)) for each in (np.nanmin(logged), np.nanmax(logged))]
        for value in values:
            if not any(low <= value <= high for low, high in known):
                low, high = min(each[0] for each in known), max(each[1] for each in known)
                rounded = float(f"{value:.4g}")
                yield _OF_TEMPERATURE.given(name=CONDITION_NAMES[name], value=rounded, low=low, high=high)
                break
