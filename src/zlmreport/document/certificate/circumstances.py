"""Facts of measurement and environment, as rows of name and value: days, method, runs, temperatures."""

from __future__ import annotations

import datetime as dt
from collections.abc import Iterable, Iterator, Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from zlmreport.evaluation.checks import runs_in_words
from zlmreport.language import Words, join_parts, named
from zlmreport.measurement import units
from zlmreport.measurement.error_symbol import ROTARY_AXES, find_error_named
from zlmreport.measurement.measurand import Coordinate
from zlmreport.measurement.measurement_set import CONDITION_NAMES, CONDITIONS, MeasurementSet

if TYPE_CHECKING:
    from zlmreport.document.writer import Writer
    from zlmreport.job.measurement_keys import Environment, Measurement, SensorKeys
    from zlmreport.measurement.arrays import FloatArray

_METHODS = {
    "linear": Words("linear method"),
    "unidirectional": Words("unidirectional linear method"),
    "pendulum": Words("oscillation (pendulum-step) method"),
    "quasi-pilgrim": Words("quasi-pilgrim step method"),
}
_DAYS = Words("{first} to {last}")


def write_days(measurement: Measurement, writer: Writer) -> str | None:
    """Write the day of a measurement, or its first and last day."""
    first, last = measurement.date, measurement.end
    if first is None:
        return None
    return write_period(first, last or first, writer)


def write_period(first: dt.date, last: dt.date, writer: Writer) -> str:
    """Write a day, or from which to which day something went on."""
    if first == last:
        return writer.date(first)
    return writer.say(_DAYS.given(first=writer.date(first), last=writer.date(last)))


def write_date(day: dt.date | None, writer: Writer) -> str | None:
    """Write a day that may not be stated."""
    return None if day is None else writer.date(day)


def list_measurement_facts(
    measurement: Measurement, measurements: MeasurementSet, writer: Writer, within: str
) -> Iterator[Fact]:
    """Yield how readings were taken; `within` is the dotted key of the job's group."""

    def fact(label: Words, value: str | None, *names: str) -> Fact:
        return Fact(label, value, tuple(f"{within}.{name}" for name in names))

    unit = writer.position_unit.symbol
    method, plane = measurement.method, measurement.plane
    yield fact(Words("Date"), write_days(measurement, writer), "date", "end")
    yield fact(Words("Positioning method"), writer.say(_METHODS[method]) if method else None, "method")
    if measurements.axis.circle is not None:
        from zlmreport.document.certificate.circle_facts import list_path_facts  # noqa: PLC0415 - of the few that need it

        yield from list_path_facts(measurements, writer, within)
    elif measurements.axis.measurand.coordinate is Coordinate.TIME and not measurements.tests:
        yield fact(Words("Record"), writer.say(_record(measurements)), "source")
    elif not measurements.tests:
        yield fact(Words("Target positions"), writer.say(_write_targets(measurements, writer)), "source")
        yield fact(Words("Approaches and runs"), writer.say(_write_runs(measurements)), "source")
    yield fact(Words("Measured"), _write_measured(measurement, measurements, writer), "error", "symbols")
    yield fact(Words("Other axes at"), _write_elsewhere(measurement, writer), "at")
    feed = None if measurements.axis.circle else measurement.feed  # that of a circle stands with the circle
    yield fact(Words("Feed"), write_with_unit(feed, f"{unit}/min", writer), "feed")
    yield fact(Words("Dwell at each target"), write_with_unit(measurement.dwell, "s", writer), "dwell")
    yield fact(Words("Warm-up"), measurement.warm_up, "warm_up")
    yield fact(Words("Compensation"), measurement.compensation, "compensation")
    yield fact(Words("Measuring line"), measurement.line, "line")
    yield fact(
        Words("Position of the second axis"),
        f"{plane.axis} = {writer.number(plane.at)} mm" if plane else None,
        "plane",
    )
    yield fact(
        Words("Deviations from the method"), measurement.deviations_from_method, "deviations_from_method"
    )
    yield fact(Words("Measured by"), measurement.operator, "operator")
    yield fact(Words("Remarks"), measurement.remarks, "remarks")


_BOTH_SYMBOLS = Words("{error} ({of_guideline})")


def _write_measured(measurement: Measurement, measurements: MeasurementSet, writer: Writer) -> str | None:
    """Write what was measured and its sign; nothing of positioning that no symbol names."""
    axis = measurements.axis
    if axis.measurand.is_position and not measurement.error:
        return None
    subject = axis.subject
    if axis.error and measurement.symbols == "vdi-vde-2617-3":
        of_guideline = named("VDI/VDE 2617-3", find_error_named(axis.error).vdi)
        symbol = _BOTH_SYMBOLS.given(error=axis.error, of_guideline=of_guideline)
        subject = axis.measurand.named(axis.name, symbol)
    return writer.say(named(subject, axis.measurand.sign_of(axis.letter)))


def _write_elsewhere(measurement: Measurement, writer: Writer) -> str | None:
    """Write where the other axes stood, and the tool's offset."""
    said = []
    for name, value in measurement.at.items():
        if isinstance(value, tuple):
            said.append(f"{_TOOL.in_language(writer.language)} ({' / '.join(map(writer.number, value))}) mm")
        else:
            unit = "°" if name[:1].upper() in ROTARY_AXES else "mm"
            said.append(f"{name} = {units.with_unit(writer.number(value), unit)}")
    return join_parts(said, writer.language) or None


_TOOL = Words("tool")


def list_environment_facts(
    environment: Environment | None, measurements: MeasurementSet, writer: Writer, within: str
) -> Iterator[Fact]:
    """Yield the conditions that the job states, and those that were logged beside the readings."""
    for name, key, unit, logged in _CONDITIONS:
        from_job = getattr(environment, key, None)
        if from_job is not None:
            yield Fact(name, write_with_unit(from_job, unit, writer), (f"{within}.{key}",))
        elif logged:
            yield Fact(name, _write_logged(measurements.conditions.get(key), key, writer))
    if environment is not None:
        sensors = Words("Sensor locations")
        yield Fact(sensors, environment.sensors, (f"{within}.sensors",))
        stated = (_write_sensor(each, writer) for each in environment.thermometers)
        calibrated = join_parts(stated, writer.language)
        name = Words("Thermometers and sensors")
        yield Fact(name, calibrated, (f"{within}.thermometers",))
        yield Fact(Words("Remarks"), environment.remarks, (f"{within}.remarks",))


_CALIBRATED = Words("calibrated {date}")


def write_extent(ends: Sequence[float], unit: str, writer: Writer) -> str:
    """Write from where to where something goes."""
    first, last = map(writer.number, ends)
    return f"{first} … {units.with_unit(last, unit)}"


def _write_sensor(sensor: SensorKeys, writer: Writer) -> str:
    """Write a sensor with its calibration certificate, date and range."""
    day = writer.say(_CALIBRATED.given(date=writer.date(sensor.calibrated))) if sensor.calibrated else None
    extent = write_extent(sensor.calibrated_range, "°C", writer) if sensor.calibrated_range else None
    return ", ".join(filter(None, (sensor.name, sensor.certificate, day, extent)))


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
    (Words("Expansion coefficient of the machine"), "expansion_coefficient", "µm/(m·K)", False),
)


def write_with_unit(value: str | float | None, unit: str, writer: Writer) -> str | None:
    """Write a number with its unit; what the job states in words stays as it is."""
    if value is None or isinstance(value, str):
        return value
    return units.with_unit(writer.number(value), unit)


def _write_targets(measurements: MeasurementSet, writer: Writer) -> Words:
    targets = measurements.target_positions
    first, last = (writer.position(float(each)) for each in (targets[0], targets[-1]))
    last = units.with_unit(last, writer.position_unit.symbol)
    if len(targets) == 1:
        return Words("1, at {position}").given(position=last)
    return Words("{count}, from {first} to {last}").given(count=len(targets), first=first, last=last)


def _record(measurements: MeasurementSet) -> Words:
    """Say over which time something was read, and how often."""
    targets, axis = measurements.target_positions, measurements.axis
    hours = float(f"{axis.position_unit.from_si(float(targets[-1] - targets[0])):.4g}")
    record = _AVERAGES if measurements.provenance.averaging else _MOMENTS
    return record.given(count=len(targets), duration=hours, unit=axis.position_unit.symbol)


_MOMENTS = Words("{duration} {unit}, read at {count} moments")
_AVERAGES = Words("{duration} {unit}, as averages over {count} intervals")


def _write_runs(measurements: MeasurementSet) -> Words:
    count = len(measurements.runs)
    if measurements.is_bidirectional:
        return Words("both directions (↑ and ↓), {runs} each").given(runs=runs_in_words(count))
    return Words("one direction ({arrow}), {runs}").given(
        arrow=measurements.approaches[0].arrow, runs=runs_in_words(count)
    )


def _write_logged(values: FloatArray | None, key: str, writer: Writer) -> str | None:
    """Write the range of a logged condition in the unit that is printed."""
    if values is None or not np.any(np.isfinite(values)):
        return None
    return writer.condition_span(values, CONDITIONS[key].unit)


class Fact(NamedTuple):
    """A fact.

    Attributes
    ----------
    name
        What is stated.
    value
        In the document's language; None or empty where the job does not state it.
    keys
        Dotted job keys that the value comes from: a mark stands behind the name if others supplied one.
    """

    name: Words
    value: str | None
    keys: tuple[str, ...] = ()


def select_stated_facts(facts: Iterable[Fact], writer: Writer) -> tuple[tuple[str, str], ...]:
    """Return the facts that have a value, named and marked in the document's language."""
    return tuple(
        (writer.say(fact.name) + writer.marks.write_after(*fact.keys), fact.value)
        for fact in facts
        if fact.value
    )
