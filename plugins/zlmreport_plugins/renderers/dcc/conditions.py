"""With what and under which conditions: measuring equipment and influence conditions of a DCC."""

from __future__ import annotations

from collections.abc import Iterator
from xml.etree import ElementTree as ET

from zlmreport.plugin import CONDITION_NAMES, Job, Words
from zlmreport_plugins.renderers.dcc.administrative import Writer, serial_number
from zlmreport_plugins.renderers.dcc.quantities import (
    DEGREE_CELSIUS,
    HECTOPASCAL,
    MICROMETRE_PER_METRE_KELVIN,
    PERCENT,
    quantity,
    real,
)
from zlmreport_plugins.renderers.dcc.xml import dcc

#: Conditions that a job may state: their units, and the DCC's word for their kind.
_CONDITIONS = {
    "air_temperature": (DEGREE_CELSIUS, "basic_temperature"),
    "material_temperature": (DEGREE_CELSIUS, "basic_temperature"),
    "axis_temperature": (DEGREE_CELSIUS, "basic_temperature"),
    "air_pressure": (HECTOPASCAL, ""),
    "relative_humidity": (PERCENT, "basic_humidityRelative"),
    "expansion_coefficient": (MICROMETRE_PER_METRE_KELVIN, ""),
}
_NAMES = {
    **CONDITION_NAMES,
    "expansion_coefficient": Words(
        en="Expansion coefficient used for correction",
        de="Zur Korrektur benutzter Ausdehnungskoeffizient",
    ),
}
_STATE = Words(en="State of the axis", de="Zustand der Achse")
_STATES = {
    "before": Words(en="as found", de="wie vorgefunden"),
    "after": Words(en="as left", de="wie hinterlassen"),
}
_REMARKS = Words(en="Remarks on the environment", de="Bemerkungen zur Umgebung")
_CALIBRATION = Words(en="Calibration certificate: {number}", de="Kalibrierschein: {number}")


def equipment(job: Job, writer: Writer) -> ET.Element | None:
    """Return the measuring instrument with its calibration certificate; None where none is stated."""
    instrument = job.keys.instrument
    if instrument is None:
        return None
    number = instrument.certificate
    return dcc(
        "measuringEquipment",
        writer.named("name", instrument.name),
        dcc("description", writer.content(_CALIBRATION.given(number=number))) if number else None,
        dcc("manufacturer", writer.named("name", instrument.manufacturer))
        if instrument.manufacturer
        else None,
        dcc("identifications", serial_number(instrument.serial, writer)) if instrument.serial else None,
    )


def state(when: str, work: str | None, writer: Writer) -> ET.Element | None:
    """Return whether the axis was measured before or after an adjustment or repair; None without one.

    Parameters
    ----------
    when
        ``before`` or ``after``.
    work
        ``adjustment`` or ``repair``.
    writer
        In the certificate's language.
    """
    if work is None:
        return None
    return dcc(
        "influenceCondition",
        writer.named("name", _STATE),
        dcc("status", f"{when}{work.capitalize()}"),
        dcc("data", dcc("text", writer.content(_STATES[when]))),
    )


def influences(job: Job, writer: Writer) -> Iterator[ET.Element]:
    """Yield the conditions that the job states."""
    environment = job.keys.environment
    if environment is None:
        return
    for key, (unit, kind) in _CONDITIONS.items():
        name = _NAMES[key]
        value = getattr(environment, key)
        if value is None:
            continue
        stated = (
            dcc("text", writer.content(value))
            if isinstance(value, str)
            else quantity(writer.named("name", name), real(value, unit))
        )
        yield _condition(name, stated, writer, kind)
    if environment.remarks:
        yield _condition(_REMARKS, dcc("text", writer.content(environment.remarks)), writer)


def _condition(name: Words, stated: ET.Element, writer: Writer, kind: str = "") -> ET.Element:
    attributes = {"refType": kind} if kind else {}
    return dcc("influenceCondition", writer.named("name", name), dcc("data", stated), **attributes)
