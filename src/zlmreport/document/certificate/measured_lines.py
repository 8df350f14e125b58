"""Sections on each of several measured lines (as for squareness) whose evaluations a document joins."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

from zlmreport.document.blocks import (
    Block,
    Column,
    ColumnKind,
    Facts,
    Formulas,
    Graph,
    Notice,
    RowGroup,
    Section,
    Table,
)
from zlmreport.document.certificate import conditions, readings, results, uncertainty
from zlmreport.document.writer import NOTHING, Writer
from zlmreport.language import PhraseRow, Words, named, same
from zlmreport.measurement.measurand import Coordinate

if TYPE_CHECKING:
    from zlmreport.document.certificate.results import Evaluated, Tested

#: Key of the section on lines without results of their own.
BARE_LINES = "lines"
#: Groups of facts that a line may have of its own: the machine is that of the document.
_OWN = ("axis", "measurement", "instrument", "environment")


def say_of_each(lines: Iterable[tuple[str | Words, Iterable[Words]]]) -> Iterator[Words]:
    """Yield sentences, each once, with the names of the lines that it is on; without where it is on all."""
    count = 0
    said: list[tuple[Words, list[str | Words]]] = []
    for name, sentences in lines:
        count += 1
        for sentence in sentences:
            names = next((names for known, names in said if known == sentence), None)
            if names is None:
                said.append((sentence, [name]))
            elif name not in names:
                names.append(name)
    for sentence, names in said:
        if len(names) == count > 1 or not names[0]:
            yield sentence
        else:
            yield named(PhraseRow(tuple(map(same, names))), sentence)


def _make_writer_of(test: Tested, writer: Writer) -> Writer:
    """Return a writer for the readings of a line, which have units and decimals of their own."""
    return Writer.of(test.measurements, writer.language, writer.marks)


def list_notices(tests: Sequence[Tested], writer: Writer) -> Iterator[Notice]:
    """Yield which readings of which line are missing."""
    for test in tests:
        for each in readings.list_missing_readings(test.measurements, _make_writer_of(test, writer)):
            yield replace(each, heading=_write_title(test, each.heading, writer))


def lay_out_results(
    tests: Sequence[Tested],
    known: Iterable[tuple[str, Facts]],
    writer: Writer,
    section_of: Callable[[Evaluated, Writer], Section] = results.lay_out_results,
) -> Iterator[Section]:
    """Yield a section for each line: its circumstances, and what standards give for it alone.

    Lines of which there is no more than their circumstances share a section, which says once what they share.

    `known`: The facts that the document states of all of them.
    """
    said = {pair for _, facts in known for pair in facts.pairs}
    bare: list[tuple[Tested, list[Facts]]] = []
    for test in tests:
        own = _make_writer_of(test, writer)
        circumstances = list(_list_circumstances(test, said, own))
        blocks = [
            *conditions.lay_out_corrections(test.measurements, own),
            *(
                _rename_block(block, test.name)
                for each in test.evaluated
                for block in section_of(each, own).blocks
                if not isinstance(block, Formulas)
            ),
        ]
        if blocks:
            title = _write_title(test, own.say(test.measurements.axis.subject), own)
            yield Section(f"{test.name}-line", title, (*circumstances, *blocks))
        else:
            bare.append((test, circumstances))
    if bare:
        yield _lay_out_bare_lines(bare, writer)


def _lay_out_bare_lines(lines: Sequence[tuple[Tested, Sequence[Facts]]], writer: Writer) -> Section:
    """Return what is stated of some lines: what all share, and a row for each with what they do not."""
    (first, of_first), *_ = lines
    stated = [
        {(facts.heading, label): value for facts in circumstances for label, value in facts.pairs}
        for _, circumstances in lines
    ]
    names = [test.name for test, _ in lines]
    labels = dict.fromkeys(label for each in stated for label in each)
    values = {label: [each.get(label, NOTHING) for each in stated] for label in labels}
    differing = [label for label, found in values.items() if len(set(found)) > 1 and found != names]
    blocks: list[Block] = []
    for facts in of_first:
        pairs = tuple(pair for pair in facts.pairs if set(values[facts.heading, pair[0]]) == {pair[1]})
        if pairs:
            blocks.append(replace(facts, pairs=pairs))
    is_over_time = first.measurements.axis.measurand.coordinate is Coordinate.TIME
    title = writer.say(Words("Sensors") if is_over_time else Words("Lines"))
    if differing:
        columns = (
            Column(writer.say(conditions.say_measured_of(first.job))),
            *(Column(label, kind=ColumnKind.SENTENCES) for _, label in differing),
        )
        rows = tuple(
            (name, *(values[label][number] for label in differing)) for number, name in enumerate(names)
        )
        blocks.append(Table(title, columns, (RowGroup(rows),), dense=True))
    return Section(BARE_LINES, title, tuple(blocks))


def lay_out_readings(tests: Sequence[Tested], writer: Writer) -> Iterator[Section]:
    """Yield the readings of each line; lines that have theirs in files share a section, said the same way."""
    found: list[tuple[Section, list[Tested]]] = []
    for test in tests:
        section = _lay_out_readings_of([test], writer)
        is_in_files = test.measurements.axis.measurand.is_continuous
        sharing = next((each for known, each in found if is_in_files and known == section), None)
        if sharing is None:
            found.append((section, [test]))
        else:
            sharing.append(test)
    for section, sharing in found:
        whole = section if len(sharing) == 1 else _lay_out_readings_of(sharing, writer)
        title = named(", ".join(each.name for each in sharing), section.title)
        yield replace(whole, key=f"{sharing[0].name}-readings", title=writer.say(title))


def _lay_out_readings_of(tests: Sequence[Tested], writer: Writer) -> Section:
    """Return the readings of a line, or of lines of which the same is said."""
    first = tests[0]
    key = f"measurement.tests.{first.name}.source"
    return readings.lay_out_readings(
        first.measurements, _make_writer_of(first, writer), key, lines=len(tests)
    )


def lay_out_uncertainty(
    evaluated: Evaluated, tests: Sequence[Tested], writer: Writer, *, with_bars: bool
) -> Section:
    """Return the uncertainty of what follows from the lines, and the budget of each; equal ones once."""
    section = uncertainty.lay_out_budgets(
        evaluated.budget, (evaluated.evaluation,), writer, with_bars=with_bars
    )
    budgets: list[tuple[list[Block], list[Tested]]] = []
    for test in tests:
        own = _make_writer_of(test, writer)
        of_line = list(
            uncertainty.lay_out_own_blocks(test.budget, test.measurements.axis, own, with_bars=with_bars)
        )
        alike = next((each for each in budgets if _list_tables(each[0]) == _list_tables(of_line)), None)
        if alike:
            alike[1].append(test)
        elif of_line:
            budgets.append((of_line, [test]))
    blocks = list(section.blocks)
    for of_lines, sharing in budgets:
        names = ", ".join(each.name for each in sharing)
        own = _make_writer_of(sharing[0], writer)
        blocks += (_caption_block(_rename_block(each, names), names, own) for each in of_lines)
    return replace(section, blocks=tuple(blocks))


def _list_tables(blocks: Iterable[Block]) -> list[Block]:
    return [each for each in blocks if isinstance(each, Table)]


def _list_circumstances(test: Tested, said: set[tuple[str, str]], writer: Writer) -> Iterator[Facts]:
    """Yield what is stated of a line and not of all of them."""
    for key, facts in conditions.list_groups(test.job, test.measurements, (), writer):
        pairs = tuple(pair for pair in facts.pairs if pair not in said)
        if key in _OWN and pairs:
            yield replace(facts, pairs=pairs)


def _write_title(test: Tested, title: str, writer: Writer) -> str:
    return writer.say(named(test.name, title))


def _rename_block(block: Block, name: str) -> Block:
    """Return a block whose graph, if it is one, is told from those of other lines by the name of its own."""
    if not isinstance(block, Graph):
        return block
    figure = block.figure
    title = named(name, figure.title)
    return Graph(replace(figure, key=f"{name.replace(', ', '-')}-{figure.key}", title=title))


def _caption_block(block: Block, name: str, writer: Writer) -> Block:
    if not isinstance(block, Table):
        return block
    return replace(block, caption=writer.say(named(name, block.caption)))
