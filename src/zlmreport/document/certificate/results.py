"""The results by one standard: parameters, graphs, table by position, requirements, definitions."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from zlmreport.document.blocks import (
    Align,
    Block,
    Cell,
    Column,
    Explained,
    Formulas,
    Graph,
    Mark,
    Notice,
    Paragraph,
    RowGroup,
    Section,
    Symbol,
    Table,
    Verdict,
)
from zlmreport.document.certificate import conformity
from zlmreport.document.certificate.values import Values, tell_columns_apart
from zlmreport.document.writer import write_uncertainty
from zlmreport.evaluation.evaluation import Basis, Finding, QuantityGroup
from zlmreport.evaluation.uncertainty.wording import RAISED_TO
from zlmreport.language import Words
from zlmreport.language.formatting import write_plain
from zlmreport.measurement.arrays import count_decimals_of

if TYPE_CHECKING:
    from zlmreport.document.figures.figure import Figure
    from zlmreport.document.writer import Writer
    from zlmreport.evaluation.evaluation import Evaluation
    from zlmreport.evaluation.uncertainty.budget import Budget, NoBudget
    from zlmreport.job.job import Job
    from zlmreport.measurement.arrays import FloatArray
    from zlmreport.measurement.measurement_set import MeasurementSet


@dataclass(frozen=True, slots=True)
class Evaluated:
    """An evaluation with the standard's prescribed graphs of it, and the budget of its uncertainties."""

    evaluation: Evaluation
    figures: tuple[Figure, ...]
    budget: Budget | NoBudget


@dataclass(frozen=True, slots=True)
class Tested:
    """One of several measured lines that are evaluated together."""

    name: str  #: As the job calls it.
    job: Job  #: What the job says of it, as a job of its own.
    measurements: MeasurementSet
    budget: Budget | NoBudget
    evaluated: tuple[Evaluated, ...]  #: By those standards that evaluate it alone; there may be none.


_GROUPS = {
    QuantityGroup.SYSTEMATIC: (
        Words("Systematic deviations"),
        Words("What repeats from run to run: the average error to expect."),
    ),
    QuantityGroup.RANDOM: (
        Words("Random deviations"),
        Words("How far repeated approaches to one position scatter."),
    ),
    QuantityGroup.COMPOSITE: (
        Words("Composite deviations"),
        Words("Systematic and random deviations together."),
    ),
}

_OF_THE_AXIS = Words("Parameters of the axis")
_PARAMETERS = Words("Parameters")
NO_PARAMETER = Words("This test defines none of the parameters.")
_BY_STANDARD = Words("Results by {designations}")
_BY_METHOD = Words("Results by the method of {designations}")
_MET = Words("met")
_NOT_MET = Words("not met")
_OPEN = Words("open")


def write_title_of(evaluations: Sequence[Evaluation], writer: Writer) -> str:
    """Return the title of the results by one standard or method, or by several that give the same numbers."""
    title = _BY_METHOD if evaluations[0].is_method else _BY_STANDARD
    return writer.say(title.given(designations=", ".join(each.designation for each in evaluations)))


def make_section_key(evaluation: Evaluation) -> str:
    """Return the key of the section on the results by one standard."""
    return evaluation.standard.replace(":", "-")


def lay_out_results(evaluated: Evaluated, writer: Writer) -> Section:
    """Return the section on the results by one standard."""
    evaluation = evaluated.evaluation
    blocks: list[Block] = [
        Paragraph(writer.say(evaluation.title)),
        *(
            [make_shortfall(evaluation.designation, items, [evaluation], writer)]
            if (items := list_unmet(evaluation, writer))
            else []
        ),
        _lay_out_parameters(evaluation, writer)
        if evaluation.parameters
        else Paragraph(writer.say(NO_PARAMETER)),
        *say_raised(evaluation, writer),
        *map(Graph, evaluated.figures),
        *conformity.lay_out_conformity(evaluation, writer),
        *lay_out_by_position(evaluation, writer),
        *([lay_out_requirements([evaluation], writer)] if evaluation.findings else []),
        *([lay_out_definitions(evaluation, writer)] if evaluation.parameters else []),
        *(Paragraph(writer.say(note)) for note in evaluation.notes),
    ]
    return Section(
        key=make_section_key(evaluation),
        title=write_title_of([evaluation], writer),
        blocks=tuple(blocks),
    )


_UNMET = {
    Basis.PUBLISHED: Words("{requirement}; found: {found}"),
    Basis.APPLIED: Words("{requirement} (as applied); found: {found}"),
}


def list_unmet(evaluation: Evaluation, writer: Writer) -> tuple[str, ...]:
    """Return the requirements that the test does not meet, each with what was found."""
    return tuple(
        writer.say(_UNMET[finding.basis].given(requirement=finding.requirement, found=finding.found))
        for finding in evaluation.findings
        if finding.met is False
    )


def list_subscripted(evaluations: Iterable[Evaluation]) -> tuple[str, ...]:
    """Return the notations of parameters that sentences speak of by name, and that have a subscript."""
    notations = (each.quantity.notation for evaluation in evaluations for each in evaluation.parameters)
    return tuple(dict.fromkeys(each for each in notations if "_" in each))


def make_shortfall(
    designations: str, items: tuple[str, ...], evaluations: Iterable[Evaluation], writer: Writer
) -> Notice:
    """Return the notice of requirements that evaluations do not meet."""
    heading = Words("The test deviates from {designation}")
    return Notice(
        writer.say(heading.given(designation=designations)), items, symbols=list_subscripted(evaluations)
    )


def say_parameters(evaluation: Evaluation) -> Words:
    """Return what a table of parameters is called: those of an axis, or of whatever was measured."""
    is_position = evaluation.measurements.axis.measurand.is_position
    return _OF_THE_AXIS if is_position else _PARAMETERS


def _lay_out_parameters(evaluation: Evaluation, writer: Writer) -> Table:
    values = Values.of([evaluation], writer, with_interval=True)
    columns = tuple(values.list_columns(Words("Parameter and what it means")))
    groups = []
    for group, (heading, note) in _GROUPS.items():
        rows = tuple(
            (
                Symbol(parameter.quantity.notation),
                Explained(writer.say(parameter.quantity.name), writer.say(parameter.quantity.meaning)),
                *values.list_cells(parameter),
            )
            for parameter in evaluation.parameters
            if parameter.quantity.group is group
        )
        if rows:
            groups.append(RowGroup(rows, writer.say(heading), writer.say(note)))
    if len(groups) == 1 and not evaluation.measurements.axis.measurand.is_position:
        groups = [replace(groups[0], heading="", note="")]  # nothing that they would be told apart from
    caption, symbols = tell_columns_apart(
        say_parameters(evaluation),
        (each.quantity for each in evaluation.parameters),
        has_uncertainty=values.has_uncertainty,
        writer=writer,
    )
    return Table(caption, columns, tuple(groups), symbols=symbols)


def say_raised(evaluation: Evaluation, writer: Writer) -> Iterator[Paragraph]:
    """Yield which uncertainties were raised, and to what."""
    for least, words in RAISED_TO.items():
        symbols = [each.quantity.notation for each in evaluation.parameters if each.raised_to is least]
        if symbols:
            statement = Words("U of {symbols}: {what}.")
            said = writer.say(statement.given(symbols=", ".join(map(write_plain, symbols)), what=words))
            yield Paragraph(said, symbols=("U", *symbols))


def lay_out_by_position(evaluation: Evaluation, writer: Writer) -> Iterator[Table]:
    """Yield the table by position.

    None of several lines, which have theirs one by one, and none of what was read without targets: the graph
    shows it, and the results file has the values.
    """
    measurements = evaluation.measurements
    if not measurements.tests and not measurements.axis.measurand.is_continuous:
        yield _lay_out_positions(evaluation, writer)


def _lay_out_positions(evaluation: Evaluation, writer: Writer) -> Table:
    """Return the table by position; it shows n where readings are missing somewhere."""
    statistics = evaluation.statistics
    measurements = evaluation.measurements
    unit = writer.deviation_unit.symbol
    index = f"_{{{evaluation.position_index}}}"
    columns = [
        Column(Symbol(evaluation.position_index), align=Align.RIGHT),
        Column(Symbol(f"P{index}"), writer.position_unit.symbol, Align.RIGHT),
    ]
    cells: list[tuple[str, ...]] = [
        tuple(str(number) for number in range(1, len(measurements.target_positions) + 1)),
        tuple(writer.position(float(target)) for target in measurements.target_positions),
    ]

    def add(notation: str, values: FloatArray, write: Callable[[float], str] = writer.mean) -> None:
        columns.append(Column(Symbol(notation), unit, Align.RIGHT))
        cells.append(tuple(write(float(value)) for value in values))

    # One reading is no mean, and the difference of two has their digits.
    of_a_run = writer.mean if len(measurements.runs) > 1 else writer.deviation

    for approach in measurements.approaches:
        if measurements.missing():
            columns.append(Column(Symbol(f"n{index}{approach.arrow}"), align=Align.RIGHT))
            cells.append(tuple(str(int(count)) for count in statistics.count[approach.index]))
        add(f"x̄{index}{approach.arrow}", statistics.mean[approach.index], of_a_run)
        if len(measurements.runs) > 1:
            add(f"s{index}{approach.arrow}", statistics.standard_deviation[approach.index])
    if measurements.is_bidirectional and not measurements.one_sided_targets:
        add(f"x̄{index}", statistics.mean_bidirectional)
        add(f"B{index}", statistics.reversal_value, of_a_run)
    for arrows, expanded in _list_mean_uncertainties(evaluation):
        columns.append(Column(Symbol(f"U(x̄{index}{arrows})"), unit, Align.RIGHT))
        cells.append(tuple(write_uncertainty(float(value), writer) for value in expanded))
    shown = [column for column in evaluation.columns if not np.isnan(column.values).all()]
    for column in shown:
        add(column.quantity.notation, column.values, _choose_writing(column.values, measurements, writer))
    caption = Words("Results by target position")
    told, symbols = tell_columns_apart(
        caption,
        (column.quantity for column in shown),
        has_uncertainty=evaluation.mean_uncertainty is not None,
        writer=writer,
    )
    rows = tuple(zip(*cells, strict=True))
    return Table(told, tuple(columns), (RowGroup(rows),), dense=True, symbols=symbols)


def _choose_writing(
    values: FloatArray, measurements: MeasurementSet, writer: Writer
) -> Callable[[float], str]:
    """Return what writes a standard's own column: of a single run with no digit that no reading has."""
    in_unit, decimals = writer.deviation_unit.from_si(values), writer.deviation_decimals
    is_read = len(measurements.runs) == 1 and count_decimals_of(in_unit, decimals + 1) <= decimals
    return writer.deviation if is_read else writer.mean


def _list_mean_uncertainties(evaluation: Evaluation) -> Iterator[tuple[str, FloatArray]]:
    """Yield U of the mean deviations by direction: once, if it is alike in both directions."""
    expanded = evaluation.mean_uncertainty
    if expanded is None:
        return
    approaches = evaluation.measurements.approaches
    of_each = [expanded.by_approach[approach.index] for approach in approaches]
    if all(np.array_equal(values, of_each[0], equal_nan=True) for values in of_each):
        yield "".join(approach.arrow for approach in approaches), of_each[0]
        return
    for approach, values in zip(approaches, of_each, strict=True):
        yield approach.arrow, values


def lay_out_requirements(evaluations: Sequence[Evaluation], writer: Writer) -> Table:
    """Return what standards require of a test, and what was found; standards that agree share their rows."""
    columns = (
        Column(writer.say(Words("Requirement on the test"))),
        Column(writer.say(Words("Found"))),
        Column(writer.say(Words("Result"))),
    )
    groups: dict[tuple[tuple[Cell, ...], ...], list[str]] = {}
    for evaluation in evaluations:
        rows = tuple(
            (_write_requirement(finding, writer), writer.say(finding.found), _mark(finding, writer))
            for finding in evaluation.findings
        )
        groups.setdefault(rows, []).append(evaluation.designation)
    caption = Words(
        "Requirements on the test. Those marked * are applied as this program's reading of the "
        "standard, not quoted from its text."
    )
    of_several = len(evaluations) > 1
    return Table(
        writer.say(caption),
        columns,
        tuple(
            RowGroup(rows, ", ".join(names) if of_several else "") for rows, names in groups.items() if rows
        ),
        symbols=list_subscripted(evaluations),
    )


def _write_requirement(finding: Finding, writer: Writer) -> str:
    words = writer.say(finding.requirement)
    return words if finding.basis is Basis.PUBLISHED else f"{words}\N{NO-BREAK SPACE}*"


def _mark(finding: Finding, writer: Writer) -> Verdict:
    if finding.met is None:
        return Verdict(Mark.OPEN, writer.say(_OPEN))
    if finding.met:
        return Verdict(Mark.MET, writer.say(_MET))
    return Verdict(Mark.NOT_MET, writer.say(_NOT_MET))


def lay_out_definitions(evaluation: Evaluation, writer: Writer) -> Formulas:
    """Return the definitions of a standard's parameters."""
    caption = Words("Definitions. Names describe the parameters; the formulas define what was computed.")
    return Formulas(
        writer.say(caption),
        tuple(
            (
                Symbol(parameter.quantity.notation),
                Symbol(parameter.quantity.formula),
                writer.say(parameter.quantity.name),
            )
            for parameter in evaluation.parameters
        ),
    )
