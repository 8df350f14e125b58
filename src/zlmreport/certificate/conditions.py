"""What was measured, how, with what, and under which conditions."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import TypeAlias

import numpy as np

from zlmreport.certificate.document import Facts, Section
from zlmreport.certificate.scribe import Scribe
from zlmreport.job.job import Job
from zlmreport.job.model import JobKeys
from zlmreport.language import Words
from zlmreport.measurement.axis import AxisKind
from zlmreport.measurement.conditions import CONDITION_NAMES, CONDITIONS
from zlmreport.measurement.measurement_set import MeasurementSet
from zlmreport.quantities.arrays import FloatArray

#: A name, and a value that may not be stated.
MaybeFact: TypeAlias = tuple[Words, str | None]

_TITLE = Words(en="Item, method and conditions", de="Gegenstand, Verfahren und Bedingungen")

MACHINE_KINDS = {
    "machine tool": Words(en="machine tool", de="Werkzeugmaschine"),
    "coordinate measuring machine": Words(en="coordinate measuring machine", de="Koordinatenmessgerät"),
}

AXIS_KINDS = {
    AxisKind.LINEAR: Words(en="linear axis", de="Linearachse"),
    AxisKind.ROTARY: Words(en="rotary axis", de="Drehachse"),
}

_METHODS = {
    "linear": Words(en="linear method", de="Linearverfahren"),
    "unidirectional": Words(en="unidirectional linear method", de="einseitiges Linearverfahren"),
    "pendulum": Words(en="oscillation (pendulum-step) method", de="Pendelschrittverfahren"),
    "quasi-pilgrim": Words(en="quasi-pilgrim step method", de="Quasi-Pilgerschrittverfahren"),
}

_PASCAL_PER_HECTOPASCAL = 100.0
_PERCENT = 100.0


def section(job: Job, measurements: MeasurementSet, scribe: Scribe) -> Section:
    """Return the section on the item, the method, the instrument and the environment."""
    keys = job.keys
    groups = (
        (Words(en="Machine", de="Maschine"), _machine(keys, scribe)),
        (Words(en="Axis", de="Achse"), _axis(job, scribe)),
        (Words(en="Measurement", de="Messung"), _measurement(keys, measurements, scribe)),
        (Words(en="Measuring instrument", de="Messgerät"), _instrument(keys, scribe)),
        (Words(en="Environment", de="Umgebung"), _environment(keys, measurements, scribe)),
    )
    blocks = tuple(
        Facts(pairs, scribe.say(heading))
        for heading, maybe_facts in groups
        if (pairs := stated(maybe_facts, scribe))
    )
    return Section("conditions", scribe.say(_TITLE), blocks)


def stated(maybe_facts: Iterable[MaybeFact], scribe: Scribe) -> tuple[tuple[str, str], ...]:
    """Return the facts that have a value, named in the document's language."""
    return tuple((scribe.say(name), value) for name, value in maybe_facts if value)


def _machine(keys: JobKeys, scribe: Scribe) -> Iterator[MaybeFact]:
    machine = keys.machine
    yield Words(en="Manufacturer", de="Hersteller"), machine.manufacturer
    yield Words(en="Model", de="Typ"), machine.model
    yield Words(en="Serial number", de="Seriennummer"), machine.serial
    yield Words(en="Kind", de="Art"), scribe.say(MACHINE_KINDS[machine.kind])
    yield Words(en="Location", de="Aufstellort"), machine.location
    yield Words(en="Condition", de="Zustand"), machine.condition


def _axis(job: Job, scribe: Scribe) -> Iterator[MaybeFact]:
    axis = job.axis
    yield (
        Words(en="Axis", de="Achse"),
        scribe.say(
            Words("{name} ({kind})", "{name} ({kind})").given(name=axis.name, kind=AXIS_KINDS[axis.kind])
        ),
    )
    if axis.travel is not None:
        first, last = (scribe.number(scribe.position_unit.from_si(end)) for end in axis.travel)
        yield Words(en="Travel", de="Verfahrweg"), f"{first} … {last} {scribe.position_unit.symbol}"
    for name, length in (
        (Words(en="Screw or gear pitch", de="Spindel- oder Getriebesteigung"), axis.screw_pitch),
        (Words(en="Signal period of the scale", de="Signalperiode des Maßstabs"), axis.signal_period),
        (Words(en="Length of a scale element", de="Länge eines Maßstabselements"), axis.scale_element),
    ):
        yield name, None if length is None else scribe.length(length)


def _measurement(keys: JobKeys, measurements: MeasurementSet, scribe: Scribe) -> Iterator[MaybeFact]:
    measurement = keys.measurement
    first, last = measurements.target_positions[0], measurements.target_positions[-1]
    unit = scribe.position_unit.symbol
    feed_unit = f"{unit}/min"
    yield Words(en="Date", de="Datum"), scribe.date(measurement.date) if measurement.date else None
    yield (
        Words(en="Positioning method", de="Positionierverfahren"),
        scribe.say(_METHODS[measurement.method]) if measurement.method else None,
    )
    yield (
        Words(en="Target positions", de="Sollpositionen"),
        scribe.say(
            Words(
                en="{count}, from {first} to {last} {unit}", de="{count}, von {first} bis {last} {unit}"
            ).given(
                count=len(measurements.target_positions),
                first=scribe.position(float(first)),
                last=scribe.position(float(last)),
                unit=unit,
            )
        ),
    )
    yield (
        Words(en="Approaches and runs", de="Anfahrrichtungen und Durchläufe"),
        scribe.say(_runs(measurements)),
    )
    yield Words(en="Feed", de="Vorschub"), _with_unit(measurement.feed, feed_unit, scribe)
    yield (
        Words(en="Rest at each target", de="Verweilzeit je Position"),
        _with_unit(measurement.dwell, "s", scribe),
    )
    yield Words(en="Warm-up", de="Warmlauf"), measurement.warm_up
    yield Words(en="Compensation", de="Kompensation"), measurement.compensation
    yield Words(en="Measuring line", de="Messlinie"), measurement.line
    yield Words(en="Measured by", de="Gemessen von"), measurement.operator
    yield Words(en="Remarks", de="Bemerkungen"), measurement.remarks


def _runs(measurements: MeasurementSet) -> Words:
    count = len(measurements.runs)
    if measurements.is_bidirectional:
        return Words(
            en="both directions (↑ and ↓), {count} runs each",
            de="beide Richtungen (↑ und ↓), je {count} Durchläufe",
        ).given(count=count)
    return Words(
        en="one direction ({arrow}), {count} runs", de="eine Richtung ({arrow}), {count} Durchläufe"
    ).given(arrow=measurements.approaches[0].arrow, count=count)


def _instrument(keys: JobKeys, scribe: Scribe) -> Iterator[MaybeFact]:
    instrument = keys.instrument
    if instrument is None:
        return
    yield Words(en="Instrument", de="Gerät"), instrument.name
    yield Words(en="Manufacturer", de="Hersteller"), instrument.manufacturer
    yield Words(en="Serial number", de="Seriennummer"), instrument.serial
    yield Words(en="Calibration certificate", de="Kalibrierschein"), instrument.certificate
    yield (
        Words(en="Calibrated", de="Kalibriert am"),
        scribe.date(instrument.calibrated) if instrument.calibrated else None,
    )
    uncertainty = instrument.expanded_uncertainty
    if isinstance(uncertainty, float):
        uncertainty = f"U = {scribe.number(uncertainty)} {scribe.deviation_unit.symbol} (k = 2)"
    yield Words(en="Expanded uncertainty", de="Erweiterte Messunsicherheit"), uncertainty


def _environment(keys: JobKeys, measurements: MeasurementSet, scribe: Scribe) -> Iterator[MaybeFact]:
    stated_values = keys.environment
    for name, key, unit, logged in _CONDITIONS:
        from_job = getattr(stated_values, key, None)
        if from_job is not None:
            yield name, _with_unit(from_job, unit, scribe)
        elif logged:
            yield name, _logged(measurements.conditions.get(key), unit, scribe)
    if stated_values is not None:
        yield Words(en="Remarks", de="Bemerkungen"), stated_values.remarks


#: Name, key (in the job and among the logged conditions), unit, and whether a log may state it.
_CONDITIONS = (
    *(
        (CONDITION_NAMES[key], key, CONDITIONS[key].unit.symbol, True)
        for key in (
            "air_temperature",
            "axis_temperature",
            "screw_temperature",
            "material_temperature",
            "air_pressure",
            "relative_humidity",
        )
    ),
    (
        Words(en="Expansion coefficient used", de="Verwendeter Ausdehnungskoeffizient"),
        "expansion_coefficient",
        "µm/(m·K)",
        False,
    ),
)


def _with_unit(value: str | float | None, unit: str, scribe: Scribe) -> str | None:
    if value is None or isinstance(value, str):
        return value
    return f"{scribe.number(value)} {unit}"


def _logged(values: FloatArray | None, unit: str, scribe: Scribe) -> str | None:
    """Write the range of a logged condition in the unit that is printed."""
    if values is None or not np.any(np.isfinite(values)):
        return None
    if unit == "°C":
        return scribe.celsius_span(values)
    if unit == "hPa":
        return f"{scribe.span(values / _PASCAL_PER_HECTOPASCAL, 1)} hPa"
    return f"{scribe.span(values * _PERCENT, 1)} %"
