"""The first page: who, for whom, what, when, and the results in brief."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from zlmreport.certificate import amendment, conformity, statements, uncertainty
from zlmreport.certificate.document import (
    Block,
    Column,
    Facts,
    Notice,
    RowGroup,
    Symbol,
    Table,
)
from zlmreport.certificate.facts import stated
from zlmreport.certificate.identity import identity
from zlmreport.certificate.readings import missing_readings
from zlmreport.certificate.results import Evaluated, section_key
from zlmreport.certificate.values import Values
from zlmreport.evaluation.quantity import Group
from zlmreport.language import Words

if TYPE_CHECKING:
    from zlmreport.evaluation.evaluation import Evaluation, Parameter
    from zlmreport.job.job import Job
    from zlmreport.measurement.measurement_set import MeasurementSet
    from zlmreport.presenting.writer import Writer


def blocks(
    job: Job, measurements: MeasurementSet, evaluated: tuple[Evaluated, ...], writer: Writer
) -> tuple[Block, ...]:
    """Return the blocks under the title."""
    evaluations = tuple(each.evaluation for each in evaluated)
    return (
        *amendment.notice(job.keys.certificate, writer),
        Facts(stated(identity(job, evaluations, writer), writer)),
        _results(evaluations, writer),
        uncertainty.statement(evaluated[0].budget, writer),
        *conformity.rule_paragraph(job.keys.decision_rule, evaluations, writer),
        *missing_readings(measurements, writer),
        *_shortfalls(evaluations, writer),
        *_as_found(job, writer),
        *statements.notices(job.keys, writer),
        *statements.paragraphs(job.keys, writer),
    )


def _as_found(job: Job, writer: Writer) -> Iterator[Block]:
    """Yield which of two measurements the first page shows, if there are two."""
    if job.keys.as_found:
        from zlmreport.certificate.as_found import on_cover  # noqa: PLC0415 - of the few that need it

        yield from on_cover(job.keys.as_found, writer)


def _results(evaluations: tuple[Evaluation, ...], writer: Writer) -> Table:
    values = Values.of(evaluations, writer)
    columns = (
        Column(writer.say(Words(en="Symbol", de="Zeichen"))),
        Column(writer.say(Words(en="Parameter", de="Kenngröße"))),
        *values.columns,
    )
    groups = tuple(
        RowGroup(
            tuple(
                (
                    Symbol(parameter.quantity.notation),
                    writer.say(parameter.quantity.name),
                    *values.cells(parameter),
                )
                for parameter in _in_brief(evaluation)
            ),
            evaluation.designation,
            section=section_key(evaluation),
        )
        for evaluation in evaluations
    )
    return Table(writer.say(Words(en="Results in brief", de="Ergebnisse im Überblick")), columns, groups)


def _in_brief(evaluation: Evaluation) -> tuple[Parameter, ...]:
    """Return what a customer looks for: what has a limit, else the composite parameters, else all."""
    limited = tuple(parameter for parameter in evaluation.parameters if parameter.limit is not None)
    composite = tuple(
        parameter for parameter in evaluation.parameters if parameter.quantity.group is Group.COMPOSITE
    )
    return limited or composite or evaluation.parameters


def _shortfalls(evaluations: tuple[Evaluation, ...], writer: Writer) -> Iterator[Notice]:
    one = Words(
        en="{designation}: {count} not met; see its section",
        de="{designation}: {count} nicht erfüllt; siehe den Abschnitt dazu",
    )
    items = tuple(
        writer.say(one.given(designation=evaluation.designation, count=unmet))
        for evaluation in evaluations
        if (unmet := sum(finding.met is False for finding in evaluation.findings))
    )
    if items:
        heading = Words(
            en="Requirements of the standards that the test does not meet",
            de="Anforderungen der Normen, die die Messung nicht erfüllt",
        )
        yield Notice(writer.say(heading), items)
