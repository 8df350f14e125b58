"""The layout ``sheet``: one page a standard, to hang at the machine.

A calibration certificate of which a mandatory item does not fit on its page is refused, and the items are
named; a measuring report goes on on the next page. The error model has no place on a sheet.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from zlmreport.certificate import columns, conditions, conformity, cover, results, statements, uncertainty
from zlmreport.certificate.circumstances import stated_facts
from zlmreport.certificate.document import Block, Facts, Graph, Paragraph, Section
from zlmreport.certificate.material import LaidOut, Material
from zlmreport.certificate.readings import missing_readings
from zlmreport.certificate.results import Evaluated, section_key
from zlmreport.certificate.standard_layout import (
    designations,
    in_smaller_type,
    main_graph,
    on_a_page,
    parameters,
    said_of_all,
    together,
)
from zlmreport.errors import InputError, Problem

if TYPE_CHECKING:
    from zlmreport.figures.figure import Figure

#: Heights of the graph, mm: the least, that with a table by position below it, and the most.
_LEAST_GRAPH, _LEAST_ABOVE_TABLE, _LARGEST_GRAPH = 38.0, 50.0, 130.0
#: What a page before the last has besides, points: no end of the document, but some to spare for browsers.
_GAINED = columns.END_MARK - 9.0
#: Of its caption and of the space around it, mm.
_BESIDE_GRAPH = 8.0


@dataclass(frozen=True, slots=True)
class _Item:
    """What must stand on the page: how a message names it, its clause of ISO/IEC 17025:2017, its blocks."""

    what: str
    clause: str
    blocks: tuple[Block, ...]


def lay_out(of: Material) -> LaidOut:
    """Return the document.

    Raises `InputError` if a calibration certificate has more to state than its pages hold: every item that
    does not fit.
    """
    beyond = dict(_of_no_sheet(of))
    sections: list[Section] = []
    pages = together(of.evaluated, of.writer)
    for page in pages:
        begins = not sections and not of.as_found
        beside = columns.head_height(of.letterhead, of.title) if begins else 0.0
        section, left_over = _sheet(of, page, beside if page is pages[-1] else beside - _GAINED)
        beyond |= left_over
        sections.append(section)
    if beyond and of.job.keys.certificate.kind == "certificate":
        raise InputError(_refusals(of, beyond))
    first, *others = (
        *_beside_as_found(of, sections),
        *statements.opinion_sections(of.job.keys, of.writer),
    )
    return LaidOut((), (first, *(replace(each, new_page=True) for each in others)), is_compact=True)


def _of_no_sheet(of: Material) -> Iterator[tuple[str, str]]:
    """Yield what is stated and has no place on a sheet: how a message names it, and its clause."""
    if of.job.keys.as_found:
        yield "the results before the adjustment", "7.8.4.1 d"
    if of.job.keys.opinions:
        yield "opinions and interpretations", "7.8.7"


def _refusals(of: Material, beyond: dict[str, str]) -> tuple[Problem, ...]:
    place = of.job.place_of("certificate.layout")
    return tuple(
        Problem(
            place,
            f"a sheet does not hold all that a calibration certificate must state: {what} "
            f"(ISO/IEC 17025:2017, {clause}) does not fit; choose certificate.layout: standard, or make a "
            "measuring report by certificate.kind: report",
        )
        for what, clause in beyond.items()
    )


def _beside_as_found(of: Material, sections: Sequence[Section]) -> Iterator[Section]:
    """Yield the sheets; of an axis that was adjusted, those before, after, and compared."""
    keys = of.job.keys.as_found
    if keys is None:
        return iter(sections)
    from zlmreport.certificate.as_found import beside_as_found  # noqa: PLC0415 - of the few that need it

    comparison, *others = beside_as_found(
        keys, sections, of.as_found, of.evaluated, of.writer, lambda each, _: _sheet(of, (each,), 0.0)[0]
    )
    free = columns.PAGES[of.job.keys.certificate.paper] - columns.head_height(of.letterhead, of.title)
    return iter((on_a_page(in_smaller_type(comparison), free), *others))


def _sheet(of: Material, page: tuple[Evaluated, ...], beside: float) -> tuple[Section, dict[str, str]]:
    """Return a page, and what of it does not fit beside what else stands there (points)."""
    writer = of.writer
    evaluation = page[0].evaluation
    title = results.title_of([each.evaluation for each in page], writer)
    before, after = _before_graph(of, page), _after_graph(of, page)
    main = main_graph(page[0].figures)
    free = columns.PAGES[of.job.keys.certificate.paper] - beside - columns.heading_height(title)
    free -= sum(columns.height(each.blocks) for each in (*before, *after))
    table = results.positions(evaluation, writer)
    graph, above_table = (
        (each + _BESIDE_GRAPH) * columns.MILLIMETRE if main else 0.0
        for each in (_LEAST_GRAPH, _LEAST_ABOVE_TABLE)
    )
    holds_table = columns.height([table]) <= free - above_table
    if holds_table:
        free -= columns.height([table])
    blocks = (
        *_blocks(before),
        *([Graph(_as_high_as(main, free))] if main else []),
        *([table] if holds_table else []),
        *_blocks(after),
    )
    return Section(section_key(evaluation), title, blocks), _beyond((*before, *after), graph - free)


def _blocks(items: Iterable[_Item]) -> Iterator[Block]:
    return (block for each in items for block in each.blocks)


def _as_high_as(figure: Figure, free: float) -> Figure:
    height = free / columns.MILLIMETRE - _BESIDE_GRAPH
    return replace(figure, height=round(min(max(height, _LEAST_GRAPH), _LARGEST_GRAPH), 1))


def _beyond(items: Sequence[_Item], excess: float) -> dict[str, str]:
    """Return the items at the foot of a page that would have to go for the rest to fit."""
    found: dict[str, str] = {}
    for each in reversed(items):
        if excess <= 0:
            break
        if each.blocks:
            found[each.what] = each.clause
            excess -= columns.height(each.blocks)
    return found


def _before_graph(of: Material, page: Sequence[Evaluated]) -> tuple[_Item, ...]:
    keys, writer = of.job.keys, of.writer
    evaluations = [each.evaluation for each in page]
    first = evaluations[0]
    of_results: tuple[Block, ...] = (
        (parameters(first, writer), *results.raised(first, writer)) if first.parameters else ()
    )
    return (
        _Item("what is amended", "7.8.8.1", tuple(statements.amendment_notice(keys.certificate, writer))),
        _Item("the customer, the item and the conditions", "7.8.2.1, 7.8.4.1 b", tuple(_facts(of, page))),
        _Item("what departs from the standard", "7.8.2.1 n", tuple(said_of_all(evaluations, writer))),
        _Item("the results", "7.8.2.1 m", of_results),
    )


def _after_graph(of: Material, page: Sequence[Evaluated]) -> tuple[_Item, ...]:
    keys, writer = of.job.keys, of.writer
    evaluations = [each.evaluation for each in page]
    rule = tuple(conformity.rule_paragraph(keys.decision_rule, evaluations, writer))
    no_influence = (each for each in _conditions(of) if isinstance(each, Paragraph))
    of_uncertainty = uncertainty.statement(page[0].budget, writer)
    aside = (
        *cover.unlikely(of.doubts, writer),
        *missing_readings(of.measurements, writer),
        *statements.notices(keys, writer),
    )
    return (
        _Item("missing readings and departures from the method", "7.8.2.1 n", aside),
        _Item("the corrections", "7.8.2.1 n", tuple(conditions.correction_blocks(of.measurements, writer))),
        _Item("the decision rule", "7.8.6.1", rule),
        _Item(
            "the uncertainty, traceability, and what the results relate to",
            "7.8.4.1 a, 7.8.4.1 c, 7.8.2.1 l",
            tuple(
                statements.in_a_paragraph(
                    (*of_uncertainty, *no_influence, *statements.paragraphs(keys, writer))
                )
            ),
        ),
    )


def _conditions(of: Material) -> Iterator[Block]:
    """Yield what is stated of the conditions; not of the machine what the facts above say."""
    beside = conditions.identified(of.job, of.writer)
    return conditions.facts(of.job, of.measurements, of.described, of.writer, beside)


def _facts(of: Material, page: Sequence[Evaluated]) -> Iterator[Block]:
    """Yield who and what in two columns of one height; of the conditions, a line each group."""
    job, writer = of.job, of.writer
    in_title = designations(page)
    pairs = tuple(
        pair
        for pair in stated_facts(cover.identity(job, [each.evaluation for each in page], writer), writer)
        if pair[1] != in_title
    )
    yield from min(
        ((Facts(pairs[:end]), Facts(pairs[end:])) for end in range(1, len(pairs))), key=columns.height
    )
    axis = conditions.axis_in_words(job, writer)
    for group in _conditions(of):
        if isinstance(group, Facts):
            stated = [": ".join(pair) for pair in group.pairs if pair[1] != axis]
            if stated:
                yield Paragraph(f"{group.heading} – {'; '.join(stated)}")
