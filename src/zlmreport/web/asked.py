"""The fields that a page asks for because a certificate would lack them: customer, instrument, U."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any, Literal

from zlmreport import pipeline
from zlmreport.document.certificate.clauses import MANDATORY_ITEMS
from zlmreport.evaluation.uncertainty.set_up import INSTRUMENT
from zlmreport.evaluation.uncertainty.wording import DEVICE, name_contributor
from zlmreport.job.job import Job
from zlmreport.language import Language, Words
from zlmreport.model.diagnosis.asking import name_length
from zlmreport.plugin.registry import Registry
from zlmreport.web.bench import Loaded

_INSTRUMENT_U = "instrument.expanded_uncertainty"


@dataclass(frozen=True, slots=True)
class Field:
    """Something that the job does not state."""

    key: str  #: Its key in the job.
    name: Words  #: What people call it.
    form: Literal["text", "date", "number", "place"] = "text"  #: How it is written.
    unit: str = ""  #: Symbol of the unit of a number.
    reason: str = ""  #: The key that says instead why it is negligible; empty where it cannot be.


#: What people call the table that a control takes away.
COMPENSATION_TABLE = Words("Compensation table")

#: Of the items that clause 7.8 demands, by the keys that its check names.
_FIELDS: Mapping[str, Field] = {
    each.key: each
    for each in (
        Field("laboratory.name", Words("Laboratory")),
        Field("laboratory.address", Words("Its address")),
        Field("location", Words("Place of the work"), "place"),
        Field("customer.name", Words("Customer")),
        Field("customer.address", Words("The customer's address")),
        Field("machine.model", Words("Model of the machine")),
        Field("machine.serial", Words("Its serial number")),
        Field("measurement.date", Words("Date of the measurement"), "date"),
        Field("as_found.measurement.date", Words("Date of the measurement before the adjustment"), "date"),
        Field("certificate.issued", Words("Date of issue"), "date"),
        Field("certificate.authorised_by.name", Words("Authorised by")),
        Field("instrument.name", DEVICE),
        Field(_INSTRUMENT_U, Words("Its U (k = 2)"), "number"),
        Field("instrument.certificate", Words("Its calibration certificate")),
        Field("as_found.adjustment", Words("What was adjusted")),
        Field("environment.air_temperature", Words("Air temperature"), "number", "°C"),
        Field("environment.axis_temperature", Words("Temperature of the machine's scale"), "number", "°C"),
        Field(
            "environment.expansion_coefficient",
            Words("Expansion coefficient of the machine"),
            "number",
            "µm/(m·K)",
        ),
    )
}
#: Items that groups of keys state: the first of their keys.
_FIRST_OF = {
    "certificate.authorised_by": "certificate.authorised_by.name",
    "environment": "environment.air_temperature",
}
_TEMPERATURES = ("environment.axis_temperature", "environment.expansion_coefficient")
_UNITS = {
    "misalignment": "mm",
    "machine_temperature": "K",
    "device_temperature": "K",
    "expansion_coefficient": "µm/(m·K)",
    "device_expansion_coefficient": "µm/(m·K)",
    "air_temperature": "K",
    "air_pressure": "hPa",
    "relative_humidity": "%",
}


def list_what_is_lacking(loaded: Loaded, registry: Registry) -> tuple[Field, ...]:
    """Return what a job lacks to be a calibration certificate; nothing for a measuring report."""
    job = loaded.job
    if job.keys.certificate.kind != "certificate":
        return ()
    return tuple({each.key: each for each in _list_lacking(job, loaded, registry)}.values())


def _list_lacking(job: Job, loaded: Loaded, registry: Registry) -> Iterator[Field]:
    unstated = (item.key for item in MANDATORY_ITEMS if not item.stated(job.keys))
    of_clause = {_FIRST_OF.get(key, key) for key in unstated}
    if of_clause & {_INSTRUMENT_U, "instrument.certificate"} and job.keys.instrument is None:
        of_clause.add("instrument.name")
    unit = job.axis.deviation_unit.symbol
    for key, field in _FIELDS.items():
        if key in of_clause:
            yield replace(field, unit=unit) if key == _INSTRUMENT_U else field
    budget = pipeline.make_budget_of_job(job, loaded.measurements, registry)
    if budget.uncorrected_expansion is None:
        stated = job.keys.environment
        for key in _TEMPERATURES:
            if stated is None or getattr(stated, key.partition(".")[2]) is None:
                yield _FIELDS[key]
    for name in budget.missing:
        if name == INSTRUMENT:
            yield replace(_FIELDS[_INSTRUMENT_U], unit=unit)
        else:
            yield Field(
                f"uncertainty.{name}",
                name_contributor(name)
                if name == "resolution"
                else Words("{name}: full range").given(name=name_contributor(name)),
                "number",
                _UNITS.get(name, unit),
                f"uncertainty.negligible.{name}",
            )


def name_key(key: str) -> Words | None:
    """Return what people call a key that the page asks for; None for one that has no name but its own."""
    group, _, name = key.partition(".")
    if group == "axis":
        return COMPENSATION_TABLE if name == "compensation_table" else name_length(name)
    if group == "uncertainty":
        return name_contributor(name.removeprefix("negligible."))
    field = _FIELDS.get(key.removesuffix(".kind"))
    return field.name if field else None


def collect_field(field: Field, language: Language) -> dict[str, Any]:
    """Return a field as a page is told of it."""
    return {
        "key": field.key,
        "name": field.name.in_language(language),
        "form": field.form,
        "unit": field.unit,
        "reason": field.reason,
    }
