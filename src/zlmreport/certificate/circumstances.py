"""Facts of the measurement and its surroundings: a name, a value that may not be stated, whose it is."""

from __future__ import annotations

import datetime as dt
from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from zlmreport.language import Words
from zlmreport.measurement.measurement_set import CONDITION_NAMES, CONDITIONS, MeasurementSet
from zlmreport.quantities import units

if TYPE_CHECKING:
    from zlmreport.job.measurement_keys import Environment, Measurement
    from zlmreport.presenting.writer import Writer
    from zlmreport.quantities.arrays import FloatArray

_METHODS = {
    "linear": Words(en="linear method", de="Linearverfahren"),
    "unidirectional": Words(en="unidirectional linear method", de="einseitiges Linearverfahren"),
    "pendulum": Words(en="oscillation (pendulum-step) method", de="Pendelschrittverfahren"),
    "quasi-pilgrim": Words(en="quasi-pilgrim step method", de="Quasi-Pilgerschrittverfahren"),
}
_DAYS = Words(en="{first} to {last}", de="{first} bis {last}")


def days(measurement: Measurement, writer: Writer) -> str | None:
    """Write the day of a measurement, or its first and last day."""
    first, last = measurement.date, measurement.end
    if first is None:
        return None
    if last is None or last == first:
        return writer.date(first)
    return writer.say(_DAYS.given(first=writer.date(first), last=writer.date(last)))


def date(day: dt.date | None, writer: Writer) -> str | None:
    """Write a day that may not be stated."""
    return None if day is None else writer.date(day)


def measurement_facts(
    measurement: Measurement, measurements: MeasurementSet, writer: Writer, within: str
) -> Iterator[Fact]:
    """Yield how readings were taken; `within` is the dotted key of the job's group."""

    def fact(en: str, de: str, value: str | None, *names: str) -> Fact:
        return Fact(Words(en, de), value, tuple(f"{within}.{name}" for name in names))

    unit = writer.position_unit.symbol
    method, plane = measurement.method, measurement.plane
    yield fact("Date", "Datum", days(measurement, writer), "date", "end")
    yield fact(
        "Positioning method",
        "Positionierverfahren",
        writer.say(_METHODS[method]) if method else None,
        "method",
    )
    yield fact("Target positions", "Sollpositionen", writer.say(_targets(measurements, writer)), "source")
    yield fact(
        "Approaches and runs",
        "Anfahrrichtungen und Durchläufe",
        writer.say(_runs(measurements)),
        "source",
    )
    yield fact("Feed", "Vorschub", with_unit(measurement.feed, f"{unit}/min", writer), "feed")
    yield fact(
        "Rest at each target", "Verweilzeit je Position", with_unit(measurement.dwell, "s", writer), "dwell"
    )
    yield fact("Warm-up", "Warmlauf", measurement.warm_up, "warm_up")
    yield fact("Compensation", "Kompensation", measurement.compensation, "compensation")
    yield fact("Measuring line", "Messlinie", measurement.line, "line")
    yield fact(
        "Position of the second axis",
        "Stellung der zweiten Achse",
        f"{plane.axis} = {writer.number(plane.at)} {unit}" if plane else None,
        "plane",
    )
    yield fact(
        "Deviations from the method",
        "Abweichungen vom Verfahren",
        measurement.deviations_from_method,
        "deviations_from_method",
    )
    yield fact("Measured by", "Gemessen von", measurement.operator, "operator")
    yield fact("Remarks", "Bemerkungen", measurement.remarks, "remarks")


def environment_facts(
    environment: Environment | None, measurements: MeasurementSet, writer: Writer, within: str
) -> Iterator[Fact]:
    """Yield the conditions that the job states, and those that were logged beside the readings."""
    for name, key, unit, logged in _CONDITIONS:
        from_job = getattr(environment, key, None)
        if from_job is not None:
            yield Fact(name, with_unit(from_job, unit, writer), (f"{within}.{key}",))
        elif logged:
            yield Fact(name, _logged(measurements.conditions.get(key), key, writer))
    if environment is not None:
        sensors = Words(en="Places of the sensors", de="Messstellen")
        yield Fact(sensors, environment.sensors, (f"{within}.sensors",))
        yield Fact(Words(en="Remarks", de="Bemerkungen"), environment.remarks, (f"{within}.remarks",))


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
        Words(en="Expansion coefficient of the machine", de="Koeffizient der Längenausdehnung der Maschine"),
        "expansion_coefficient",
        "µm/(m·K)",
        False,
    ),
)


def with_unit(value: str | float | None, unit: str, writer: Writer) -> str | None:
    """Write a number with its unit; what the job states in words stays as it is."""
    if value is None or isinstance(value, str):
        return value
    return units.with_unit(writer.number(value), unit)


def _targets(measurements: MeasurementSet, writer: Writer) -> Words:
    first, last = measurements.target_positions[0], measurements.target_positions[-1]
    return Words(en="{count}, from {first} to {last}", de="{count}, von {first} bis {last}").given(
        count=len(measurements.target_positions),
        first=writer.position(float(first)),
        last=units.with_unit(writer.position(float(last)), writer.position_unit.symbol),
    )


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


def _logged(values: FloatArray | None, key: str, writer: Writer) -> str | None:
    """Write the range of a logged condition in the unit that is printed."""
    if values is None or not np.any(np.isfinite(values)):
        return None
    return writer.condition_span(values, CONDITIONS[key].unit)


class Fact(NamedTuple):
    """A fact.

    Attributes
    ----------
    name
        What is stated_facts.
    value
        In the document's language; None or empty where the job does not state it.
    keys
        Dotted job keys that the value comes from: a mark stands behind the name if others supplied one.
    """

    name: Words
    value: str | None
    keys: tuple[str, ...] = ()


def stated_facts(facts: Iterable[Fact], writer: Writer) -> tuple[tuple[str, str], ...]:
    """Return the facts that have a value, named and marked in the document's language."""
    return tuple(
        (writer.say(fact.name) + writer.marks.after(*fact.keys), fact.value) for fact in facts if fact.value
    )
