"""What is said of each of several measured lines whose evaluations a document joins: a section for each."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

from zlmreport.document.blocks import Block, Facts, Formulas, Graph, Notice, Section, Table
from zlmreport.document.certificate import conditions, readings, results, uncertainty
from zlmreport.document.writer import Writer
from zlmreport.language import Words

if TYPE_CHECKING:
    from zlmreport.document.certificate.results import Evaluated, Tested

_NAMED = Words("{name}: {said}")
#: Groups of facts that a line may have of its own: the machine is that of the document.
_OWN = ("axis", "measurement", "instrument", "environment")
_TABLE = Words("{name}: {caption}")


def say_of_each(lines: Iterable[tuple[str | Words, Iterable[Words]]]) -> Iterator[Words]:
    """Yield sentences, each with the name of the line that it is on; without one where there is only one.

    What holds of every line, as of the instrument that read them all, is said once.
    """
    listed = [(name, tuple(sentences)) for name, sentences in lines]
    of_all = [said for said in listed[0][1] if all(said in own for _, own in listed)] if listed[1:] else []
    yield from of_all
    for name, sentences in listed:
        for said in sentences:
            if said not in of_all:
                yield _NAMED.given(name=name, said=said) if name else said


def make_writer_of(test: Tested, writer: Writer) -> Writer:
    """Return a writer for the readings of a line, which have units and decimals of their own."""
    return Writer.of(test.measurements, writer.language, writer.marks)


def list_notices(tests: Sequence[Tested], writer: Writer) -> Iterator[Notice]:
    """Yield which readings of which line are missing."""
    for test in tests:
        for each in readings.list_missing_readings(test.measurements, make_writer_of(test, writer)):
            yield replace(each, heading=_write_title(test, each.heading, writer))


def lay_out_results(
    tests: Sequence[Tested],
    known: Iterable[tuple[str, Facts]],
    writer: Writer,
    section_of: Callable[[Evaluated, Writer], Section] = results.lay_out_results,
) -> Iterator[Section]:
    """Yield a section for each line: its circumstances, and what standards give for it alone.

    `known`: The facts that the document states of all of them.
    """
    said = {pair for _, facts in known for pair in facts.pairs}
    for test in tests:
        own = make_writer_of(test, writer)
        yield Section(
            f"{test.name}-line",
            _write_title(test, own.say(test.measurements.axis.subject), own),
            (
                *_list_circumstances(test, said, own),
                *conditions.lay_out_corrections(test.measurements, own),
                *(
                    _rename_block(block, test.name)
                    for each in test.evaluated
                    for block in section_of(each, own).blocks
                    if not isinstance(block, Formulas)
                ),
            ),
        )


def lay_out_readings(tests: Sequence[Tested], writer: Writer) -> Iterator[Section]:
    """Yield the readings of each line."""
    for test in tests:
        own = make_writer_of(test, writer)
        section = readings.lay_out_readings(test.measurements, own, f"measurement.tests.{test.name}.source")
        yield replace(section, key=f"{test.name}-readings", title=_write_title(test, section.title, own))


def lay_out_uncertainty(evaluated: Evaluated, tests: Sequence[Tested], writer: Writer) -> Section:
    """Return the uncertainty of what follows from the lines, and the budget of each; equal ones once."""
    section = uncertainty.lay_out_budgets(evaluated.budget, (evaluated.evaluation,), writer)
    budgets: list[tuple[list[Block], list[Tested]]] = []
    for test in tests:
        own = make_writer_of(test, writer)
        of_line = list(uncertainty.lay_out_own_blocks(test.budget, test.measurements.axis, own))
        alike = next((each for each in budgets if _list_tables(each[0]) == _list_tables(of_line)), None)
        if alike:
            alike[1].append(test)
        elif of_line:
            budgets.append((of_line, [test]))
    blocks = list(section.blocks)
    for of_lines, sharing in budgets:
        names = ", ".join(each.name for each in sharing)
        own = make_writer_of(sharing[0], writer)
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
    return writer.say(_NAMED.given(name=test.name, said=title))


def _rename_block(block: Block, name: str) -> Block:
    """Return a block whose graph, if it is one, is told from those of other lines by the name of its own."""
    if not isinstance(block, Graph):
        return block
    figure = block.figure
    title = _NAMED.given(name=name, said=figure.title)
    return Graph(replace(figure, key=f"{name.replace(', ', '-')}-{figure.key}", title=title))


def _caption_block(block: Block, name: str, writer: Writer) -> Block:
    if not isinstance(block, Table):
        return block
    return replace(block, caption=writer.say(_TABLE.given(name=name, caption=block.caption)))
