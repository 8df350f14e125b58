"""The first page: who, for whom, what, when, and the results in brief."""

from __future__ import annotations

from collections.abc import Iterator

from zlmreport.certificate.conditions import AXIS_KINDS, MACHINE_KINDS, MaybeFact, stated
from zlmreport.certificate.document import (
    Block,
    Column,
    Facts,
    Notice,
    Paragraph,
    RowGroup,
    Symbol,
    Table,
)
from zlmreport.certificate.readings import missing_readings
from zlmreport.certificate.results import Evaluated, value_cells, value_columns
from zlmreport.certificate.scribe import Scribe
from zlmreport.evaluation.evaluation import Evaluation, Parameter
from zlmreport.evaluation.quantity import Group
from zlmreport.job.job import Job
from zlmreport.job.model import JobKeys
from zlmreport.language import Words
from zlmreport.measurement.measurement_set import MeasurementSet


def blocks(
    job: Job, measurements: MeasurementSet, evaluated: tuple[Evaluated, ...], scribe: Scribe
) -> tuple[Block, ...]:
    """Return the blocks under the title."""
    evaluations = tuple(each.evaluation for each in evaluated)
    return (
        Facts(stated(_identity(job, evaluations, scribe), scribe)),
        _results(evaluations, scribe),
        *_decision(job.keys, evaluations, scribe),
        *missing_readings(measurements, scribe),
        *_shortfalls(evaluations, scribe),
        *_statements(job.keys, scribe),
    )


def _identity(job: Job, evaluations: tuple[Evaluation, ...], scribe: Scribe) -> Iterator[MaybeFact]:
    keys = job.keys
    machine = keys.machine
    if keys.customer:
        address = ", ".join(lines(keys.customer.address))
        yield Words(en="Customer", de="Auftraggeber"), ", ".join(filter(None, (keys.customer.name, address)))
    named = " ".join(filter(None, (machine.manufacturer, machine.model)))
    kind = scribe.say(MACHINE_KINDS[machine.kind])
    yield Words(en="Item calibrated", de="Gegenstand"), f"{named} ({kind})" if named else kind
    yield Words(en="Serial number", de="Seriennummer"), machine.serial
    yield (
        Words(en="Axis", de="Achse"),
        scribe.say(
            Words("{name} ({kind})", "{name} ({kind})").given(
                name=job.axis.name, kind=AXIS_KINDS[job.axis.kind]
            )
        ),
    )
    yield (
        Words(en="Evaluated by", de="Ausgewertet nach"),
        ", ".join(evaluation.designation for evaluation in evaluations),
    )
    date = keys.measurement.date
    yield Words(en="Date of measurement", de="Datum der Messung"), scribe.date(date) if date else None
    issued = keys.certificate.issued
    yield Words(en="Date of issue", de="Ausstellungsdatum"), scribe.date(issued) if issued else None
    person = keys.certificate.authorised_by
    if person:
        yield (
            Words(en="Authorised by", de="Freigegeben durch"),
            ", ".join(filter(None, (person.name, person.function))),
        )


def lines(address: str | None) -> tuple[str, ...]:
    """Part an address into lines, at its commas or line breaks."""
    if not address:
        return ()
    return tuple(
        part for piece in address.split("\n") for part in (part.strip() for part in piece.split(",")) if part
    )


def _results(evaluations: tuple[Evaluation, ...], scribe: Scribe) -> Table:
    values = value_columns(evaluations, scribe)
    columns = (
        Column(scribe.say(Words(en="Symbol", de="Zeichen"))),
        Column(scribe.say(Words(en="Parameter", de="Kenngröße"))),
        *values,
    )
    groups = tuple(
        RowGroup(
            tuple(
                (
                    Symbol(parameter.quantity.notation),
                    scribe.say(parameter.quantity.name),
                    *value_cells(parameter, values, scribe),
                )
                for parameter in _in_brief(evaluation)
            ),
            evaluation.designation,
        )
        for evaluation in evaluations
    )
    return Table(scribe.say(Words(en="Results in brief", de="Ergebnisse im Überblick")), columns, groups)


def _in_brief(evaluation: Evaluation) -> tuple[Parameter, ...]:
    """Return what a customer looks for: what has a limit, else the composite parameters, else all."""
    limited = tuple(parameter for parameter in evaluation.parameters if parameter.limit is not None)
    composite = tuple(
        parameter for parameter in evaluation.parameters if parameter.quantity.group is Group.COMPOSITE
    )
    return limited or composite or evaluation.parameters


_RULES = {
    "simple": Words(
        en="Decision rule: simple acceptance. A parameter conforms when its unrounded amount does not "
        "exceed the limit; "
        "the measurement uncertainty is not taken into account, so that the risk of a wrong acceptance "
        "or rejection "
        "reaches 50 % for a value at the limit.",
        de="Entscheidungsregel: einfache Annahme. Eine Kenngröße hält den Grenzwert ein, wenn ihr "
        "ungerundeter Betrag ihn nicht "
        "überschreitet; die Messunsicherheit bleibt unberücksichtigt, sodass das Risiko einer falschen "
        "Annahme oder "
        "Ablehnung für einen Wert am Grenzwert bis zu 50 % beträgt.",
    ),
}
_UNDECIDED = Words(
    en="Decision rule: {rule}. It needs the expanded uncertainty of each parameter, which this document "
    "does not state; "
    "conformity is therefore not decided.",
    de="Entscheidungsregel: {rule}. Sie braucht die erweiterte Messunsicherheit jeder Kenngröße, die "
    "dieses Dokument nicht angibt; "
    "über die Konformität ist daher nicht entschieden.",
)


def _decision(keys: JobKeys, evaluations: tuple[Evaluation, ...], scribe: Scribe) -> Iterator[Paragraph]:
    if any(parameter.limit is not None for evaluation in evaluations for parameter in evaluation.parameters):
        rule = _RULES.get(keys.decision_rule, _UNDECIDED.given(rule=keys.decision_rule))
        yield Paragraph(scribe.say(rule))


def _shortfalls(evaluations: tuple[Evaluation, ...], scribe: Scribe) -> Iterator[Notice]:
    one = Words(
        en="{designation}: {count} not met; see its section",
        de="{designation}: {count} nicht erfüllt; siehe den Abschnitt dazu",
    )
    items = tuple(
        scribe.say(one.given(designation=evaluation.designation, count=unmet))
        for evaluation in evaluations
        if (unmet := sum(finding.met is False for finding in evaluation.findings))
    )
    if items:
        heading = Words(
            en="Requirements of the standards that the test does not meet",
            de="Anforderungen der Normen, die die Messung nicht erfüllt",
        )
        yield Notice(scribe.say(heading), items)


def _statements(keys: JobKeys, scribe: Scribe) -> Iterator[Paragraph]:
    yield Paragraph(
        scribe.say(
            Words(
                en="The results relate only to the item calibrated, in its condition at the time of the "
                "measurement.",
                de="Die Ergebnisse gelten nur für den kalibrierten Gegenstand in seinem Zustand zur Zeit "
                "der Messung.",
            )
        )
    )
    if keys.certificate.kind == "certificate":
        yield Paragraph(
            scribe.say(
                Words(
                    en="This certificate may be reproduced only in full, unless the laboratory agrees in "
                    "writing.",
                    de="Dieser Kalibrierschein darf nur vollständig vervielfältigt werden; Auszüge "
                    "bedürfen der "
                    "schriftlichen Zustimmung des Laboratoriums.",
                )
            )
        )
