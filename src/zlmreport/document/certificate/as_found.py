"""The axis before and after it was adjusted or repaired (ISO/IEC 17025:2017, 7.8.4.1 d)."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from zlmreport.document.blocks import (
    Align,
    Block,
    Cell,
    Column,
    Facts,
    Formulas,
    Graph,
    Notice,
    Paragraph,
    RowGroup,
    Section,
    Symbol,
    Table,
)
from zlmreport.document.certificate import conformity, readings, results, uncertainty
from zlmreport.document.certificate.circumstances import (
    Fact,
    list_environment_facts,
    list_measurement_facts,
    select_stated_facts,
)
from zlmreport.document.certificate.conditions import lay_out_corrections
from zlmreport.document.certificate.values import limit, tell_columns_apart
from zlmreport.document.figures.prescribed import draw_comparison
from zlmreport.document.writer import (
    NOTHING,
    Writer,
    add_unit,
    is_mixed,
    write_rounded_together,
    write_with_uncertainty,
)
from zlmreport.evaluation.evaluation import Change, EvaluatedParameter, Evaluation, compare_parameters
from zlmreport.language import Words

if TYPE_CHECKING:
    from zlmreport.document.certificate.results import Evaluated
    from zlmreport.document.figures.figure import Figure
    from zlmreport.job.measurement_keys import AsFound
    from zlmreport.measurement.measurement_set import MeasurementSet

#: What the two measurements are called, by the work between them.
NAMES = {
    "adjustment": (Words("as found, before the adjustment"), Words("as left, after the adjustment")),
    "repair": (Words("as found, before the repair"), Words("as left, after the repair")),
}
_TITLE = Words("As found and as left")
_ON_COVER = Words(
    "The axis was {done} between two measurements. The results above are those after the {work}; the "
    "section “{title}” compares them with those before."
)
#: The work between the measurements, that it was done, and the same as the name of a fact.
_WORK = {
    "adjustment": (Words("adjustment"), Words("adjusted"), Words("Adjusted")),
    "repair": (Words("repair"), Words("repaired"), Words("Repaired")),
}
_NOT_ALIKE = Words("The two measurements are not alike; differences between them may come from that")
_OTHER_RUNS = Words("Other number of runs: {before} before, {after} after")
_LABELLED = Words("{title} ({state})")
#: Evaluations of both measurements by one standard: as found, as left.
Pair: TypeAlias = tuple[Evaluation, Evaluation]

_BEFORE = Words("As found")
_AFTER = Words("As left")
_CHANGES = Words("Parameters as found and as left; change = as left − as found, of unrounded values")
_CHANGES_WITH_U = Words(
    "{changes}. Its U is the sum of both U: it holds whatever errors the two measurements share"
)
_LIMITS = Words("Limits as found and as left")


def say_on_cover(keys: AsFound, writer: Writer) -> Paragraph:
    """Return which of the two measurements the first page shows."""
    work, done, _ = _WORK[keys.work]
    return Paragraph(writer.say(_ON_COVER.given(work=work, done=done, title=_TITLE)))


def lay_out_beside_as_found(  # noqa: PLR0913, PLR0917 - two measurements of everything
    keys: AsFound,
    as_left: Iterable[Section],
    before: Sequence[Evaluated],
    after: Sequence[Evaluated],
    writer: Writer,
    section: Callable[[Evaluated, Writer], Section] = results.lay_out_results,
) -> Iterator[Section]:
    """Yield the comparison, the results as left, and those as found; each says which it is.

    `before`, `after`: Evaluations of the two measurements, by the same standards in the same order.
    """
    state_before, state_after = NAMES[keys.work]
    yield _lay_out_comparison(keys, before, after, writer)
    yield from (_label_section(each, state_after, writer) for each in as_left)
    own = _make_writer_as_found(before, writer)
    yield from (_lay_out_results(section, each, state_before, own) for each in before)


def lay_out_readings_as_found(keys: AsFound, before: Sequence[Evaluated], writer: Writer) -> Section:
    """Return the section of the readings as found."""
    measurements = before[0].evaluation.measurements
    section = readings.lay_out_readings(
        measurements, _make_writer_as_found(before, writer), "as_found.measurement.source"
    )
    return _label_section(replace(section, key="as-found-readings"), NAMES[keys.work][0], writer)


def lay_out_uncertainty_beside_as_found(
    keys: AsFound, before: Sequence[Evaluated], after: Sequence[Evaluated], writer: Writer, *, with_bars: bool
) -> Iterator[Section]:
    """Yield the section on the uncertainty: one for both measurements, or two where their budgets differ."""
    as_left, as_found = (
        uncertainty.lay_out_budgets(
            of[0].budget, [each.evaluation for each in of], writer, with_bars=with_bars
        )
        for of in (after, before)
    )
    if before[0].budget == after[0].budget:
        yield as_left
        return
    state_before, state_after = NAMES[keys.work]
    yield _label_section(as_left, state_after, writer)
    yield _label_section(replace(as_found, key="as-found-uncertainty"), state_before, writer)


def _make_writer_as_found(before: Sequence[Evaluated], writer: Writer) -> Writer:
    """Return a writer for readings that may have other decimals than those as left."""
    return Writer.of(before[0].evaluation.measurements, writer.language, writer.marks)


def _lay_out_comparison(
    keys: AsFound, before: Sequence[Evaluated], after: Sequence[Evaluated], writer: Writer
) -> Section:
    first, last = before[0].evaluation, after[0].evaluation
    pairs = [(one.evaluation, other.evaluation) for one, other in zip(before, after, strict=True)]
    blocks: list[Block] = [
        *_list_circumstances(keys, first.measurements, writer),
        *lay_out_corrections(first.measurements, writer),
        *_find_differences(first.measurements, last.measurements, writer),
        Graph(draw_comparison(first, last, NAMES[keys.work])),
        _lay_out_changes(pairs, writer),
        *_lay_out_limits(pairs, writer),
    ]
    return Section("as-found-as-left", writer.say(_TITLE), tuple(blocks))


def _lay_out_results(
    section_of: Callable[[Evaluated, Writer], Section], evaluated: Evaluated, state: Words, writer: Writer
) -> Section:
    """Return the results as found by a standard, whose definitions stand with the results as left."""
    section = section_of(evaluated, writer)
    blocks = tuple(
        Graph(_name_figure(block.figure, state)) if isinstance(block, Graph) else block
        for block in section.blocks
        if not isinstance(block, Formulas)
    )
    return _label_section(replace(section, key=f"as-found-{section.key}", blocks=blocks), state, writer)


def _label_section(section: Section, state: Words, writer: Writer) -> Section:
    """Return a section whose title says to which of the two measurements it belongs."""
    return replace(section, title=writer.say(_LABELLED.given(title=section.title, state=state)))


def _name_figure(figure: Figure, state: Words) -> Figure:
    title = _LABELLED.given(title=figure.title, state=state)
    return replace(figure, key=f"as-found-{figure.key}", title=title)


def _list_circumstances(keys: AsFound, measurements: MeasurementSet, writer: Writer) -> Iterator[Facts]:
    within = "as_found.measurement"
    environment = list_environment_facts(keys.environment, measurements, writer, "as_found.environment")
    groups = (
        (
            Words("Measurement as found"),
            list_measurement_facts(keys.measurement, measurements, writer, within),
        ),
        (Words("Environment as found"), environment),
        (
            Words("Between the measurements"),
            (Fact(_WORK[keys.work][2], keys.adjustment, ("as_found.work", "as_found.adjustment")),),
        ),
    )
    for heading, facts in groups:
        pairs = select_stated_facts(facts, writer)
        if pairs:
            yield Facts(pairs, writer.say(heading))


def _find_differences(before: MeasurementSet, after: MeasurementSet, writer: Writer) -> Iterator[Notice]:
    """Yield what hinders a comparison of like with like."""
    found = []
    if not np.array_equal(before.target_positions, after.target_positions):
        found.append(Words("Other target positions"))
    if before.approaches != after.approaches:
        found.append(Words("Other directions of approach"))
    if len(before.runs) != len(after.runs):
        found.append(_OTHER_RUNS.given(before=len(before.runs), after=len(after.runs)))
    if found:
        yield Notice(writer.say(_NOT_ALIKE), tuple(map(writer.say, found)))


def _lay_out_changes(pairs: Sequence[Pair], writer: Writer) -> Table:
    """Return the table of parameters before and after, with their uncertainties where these are known."""
    changed = [compare_parameters(*pair) for pair in pairs]
    every = [each for of_pair in changed for each in of_pair]
    known = any(one.expanded_uncertainty is not None for each in every for one in _both(each))
    mixed = is_mixed((each.either for each in every), writer)
    unit = "" if mixed else writer.deviation_unit.symbol
    uncertainty = [Column(Symbol("U"), unit, Align.RIGHT)] if known else []
    columns = (
        Column(writer.say(Words("Symbol"))),
        Column(writer.say(Words("Parameter"))),
        Column(writer.say(_BEFORE), unit, Align.RIGHT),
        *uncertainty,
        Column(writer.say(_AFTER), unit, Align.RIGHT),
        *uncertainty,
        Column(writer.say(Words("Change")), unit, Align.RIGHT),
        *uncertainty,
    )
    groups = tuple(
        RowGroup(
            tuple(_make_row_of_change(each, writer, known=known, with_units=mixed) for each in of_pair),
            pair[1].designation,
        )
        for pair, of_pair in zip(pairs, changed, strict=True)
    )
    caption = _CHANGES_WITH_U.given(changes=_CHANGES) if known else _CHANGES
    quantities = (each.either.quantity for each in every)
    told, symbols = tell_columns_apart(caption, quantities, has_uncertainty=known, writer=writer)
    return Table(told, columns, groups, symbols=symbols)


def _both(change: Change) -> Iterator[EvaluatedParameter]:
    yield from filter(None, (change.before, change.after))


def _make_row_of_change(change: Change, writer: Writer, *, known: bool, with_units: bool) -> tuple[Cell, ...]:
    quantity, parts = change.either.quantity, 2 if known else 1
    numbers = (
        *(write_with_uncertainty(change.before, writer) if change.before else (NOTHING, NOTHING))[:parts],
        *(write_with_uncertainty(change.after, writer) if change.after else (NOTHING, NOTHING))[:parts],
        *_write_change(change, writer)[:parts],
    )
    shown = (add_unit(each, quantity, writer) if with_units else each for each in numbers)
    return (Symbol(quantity.notation), writer.say(quantity.name), *shown)


def _write_change(change: Change, writer: Writer) -> tuple[str, str]:
    """Write a change, with the sign that the standard's edition prints, and its U."""
    if change.value is None:
        return NOTHING, NOTHING
    writer = writer.of_quantity(change.either.quantity)
    value = change.either.quantity.printed_sign * change.value
    if change.expanded_uncertainty is None:
        return writer.deviation(value), NOTHING
    return write_rounded_together(value, change.expanded_uncertainty, writer)


def _lay_out_limits(pairs: Sequence[Pair], writer: Writer) -> Iterator[Table]:
    """Yield the table of what is stated of the limits before and after, where the job states any."""
    limited = [
        [each for each in compare_parameters(*pair) if each.either.limit is not None] for pair in pairs
    ]
    mixed = is_mixed((each.either for some in limited for each in some), writer)
    columns = (
        Column(writer.say(Words("Symbol"))),
        Column(
            writer.say(Words("Limit")) + writer.marks.write_after("evaluate.tolerances"),
            "" if mixed else writer.deviation_unit.symbol,
            Align.RIGHT,
        ),
        Column(writer.say(_BEFORE)),
        Column(writer.say(_AFTER)),
    )
    groups = tuple(
        RowGroup(tuple(_show_verdicts(each, writer, with_units=mixed) for each in some), after.designation)
        for (_, after), some in zip(pairs, limited, strict=True)
        if some
    )
    if groups:
        yield Table(writer.say(_LIMITS), columns, groups)


def _show_verdicts(change: Change, writer: Writer, *, with_units: bool) -> tuple[Cell, ...]:
    quantity, stated = change.either.quantity, limit(change.either, writer)
    return (
        Symbol(quantity.notation),
        add_unit(stated, quantity, writer) if with_units else stated,
        *(
            conformity.make_verdict_cell(each, writer) if each else NOTHING
            for each in (change.before, change.after)
        ),
    )
