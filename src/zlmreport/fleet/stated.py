"""What a certificate states, as the ledger keeps it: its subject and its parameters."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Self

from zlmreport.certificate.document import Certificate
from zlmreport.fleet.layout import designation
from zlmreport.fleet.records import RecordedParameter
from zlmreport.job.job import Job
from zlmreport.quantities.units import Unit


@dataclass(frozen=True, slots=True)
class Subject:
    """What a job is about, as `zlmreport.fleet.records.Entry` has it; empty where the job cannot be read."""

    number: str = ""
    machine: str = ""
    axis: str = ""
    measured: str = ""

    @classmethod
    def of(cls, job: Job) -> Self:
        """Return what a job is about."""
        keys = job.keys
        date = keys.measurement.date
        measured = date.isoformat() if date else ""
        return cls(keys.certificate.number, designation(keys.machine), keys.axis.name, measured)


def parameters_of(certificate: Certificate) -> Iterator[RecordedParameter]:
    """Yield every parameter by every standard, in the units of the results file."""
    for evaluation in certificate.evaluations:
        unit = evaluation.measurements.axis.deviation_unit
        for each in evaluation.parameters:
            yield RecordedParameter(
                standard=evaluation.standard,
                symbol=each.quantity.symbol,
                value=float(unit.from_si(each.value)),
                unit=unit.ascii,
                expanded_uncertainty=_in_unit(unit, each.expanded_uncertainty),
                limit=_in_unit(unit, each.limit),
                conforms=None if each.conforms is None else bool(each.conforms),
            )


def _in_unit(unit: Unit, value: float | None) -> float | None:
    return None if value is None else float(unit.from_si(value))
