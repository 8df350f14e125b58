"""The layout ``sheet``: a page for each standard, for somebody who stands at the machine.

The verdict and the graph come first, then what is to be noted, the parameters with U, who and what was
measured and how as short facts in two columns, and what ISO/IEC 17025:2017 wants besides in small type at the
foot. What a page does not hold goes to a last page, *Details*, and the page says so: nothing is refused. The
error model has no place on a sheet.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from zlmreport.document.blocks import Block, Facts, Graph, Notice, Paragraph, Section, Verdict
from zlmreport.document.certificate import (
    columns,
    conditions,
    conformity,
    cover,
    measured_lines,
    results,
    statements,
    uncertainty,
)
from zlmreport.document.certificate.circumstances import select_stated_facts
from zlmreport.document.certificate.digest import DIGEST
from zlmreport.document.certificate.document import Head
from zlmreport.document.certificate.material import LaidOut, Material
from zlmreport.document.certificate.readings import list_missing_readings
from zlmreport.document.certificate.results import Evaluated, make_section_key
from zlmreport.document.certificate.sheet_filling import (
    Pair,
    SheetContent,
    fill,
    lay_out_details,
    measure_least,
)
from zlmreport.document.certificate.standard_layout import (
    find_main_graph,
    fit_on_a_page,
    group_together,
    lay_out_parameters,
    lay_out_results_by_line,
    list_designations,
    measure_head_height,
    say_of_all,
    set_in_smaller_type,
)
from zlmreport.language import Words, join_parts, named
from zlmreport.language.formatting import write_plain

if TYPE_CHECKING:
    from zlmreport.document.figures.figure import Figure
    from zlmreport.document.writer import Writer
    from zlmreport.evaluation.evaluation import Evaluation

#: Heights of the graph, mm: that it has wherever a page allows it, the least, and the most.
_GRAPH, _LEAST_GRAPH, _LARGEST_GRAPH = 90.0, 45.0, 130.0
#: What stands above and below a circle, mm: its angles.
_ABOUT_CIRCLE = 9.5
#: Of one of several measured lines, mm: two of them share a page.
_GRAPH_OF_A_LINE = 46.0
#: What a page before the last has besides, points: no end of the document, but some to spare for browsers.
_GAINED = columns.END_MARK - 9.0
#: For a line on what is to be noted, one on what stands elsewhere, and customer and machine in small type, in
#: points.
_LEAST_ROOM = 57.0
#: What a graph leaves that grows beyond its usual height, points: how high all else is, is an estimate.
_SPARE = 6.0
#: Of its caption and of the space around it, mm.
_BESIDE_GRAPH = 8.0
#: Groups of facts that need no heading, for their names say of what they are.
_PLAIN_GROUPS = ("axis", "circle", "measurement", "environment")

_LABORATORY = Words("Laboratory")
#: Marks of verdicts in the order of their lines.
_GRAVEST_FIRST = ("not met", "open", "met")


@dataclass(frozen=True, slots=True)
class _Page:
    """Evaluations that share a page, and what of it is taken before they begin."""

    evaluated: tuple[Evaluated, ...]
    free: float  #: What of the page is left for them, points; of the last, beside the mark of the end.
    gained: float  #: What there is besides where another page follows after all.
    is_as_found: bool = False  #: Whether it was measured before an adjustment.
    head: Head = Head.WHOLE  #: What of the letterhead stands above it, if it is the first.

    @property
    def evaluations(self) -> tuple[Evaluation, ...]:
        return tuple(each.evaluation for each in self.evaluated)


@dataclass(frozen=True, slots=True)
class _Sheet:
    """A page as it is printed, and what has no place on it."""

    section: Section
    left: SheetContent


def lay_out(of: Material) -> LaidOut:
    """Return the document: the sheets, and what they do not hold."""
    keys, whole = of.job.keys, columns.PAGES[of.job.keys.certificate.paper]
    *before_last, last = group_together(of.evaluated, of.writer)
    goes_on = bool(keys.as_found or keys.opinions or of.tests or of.is_part)
    pages = [
        *(_Page(page, whole + _GAINED, 0.0) for page in before_last),
        _Page(last, whole + _GAINED, 0.0) if goes_on else _Page(last, whole, _GAINED),
    ]
    if not of.is_part:  # or else the summary stands before them
        pages[0] = _choose_head(of, pages[0])
    sheets = [_fill_sheet(of, page) for page in pages]
    before = {
        each.evaluation.standard: _fill_sheet(of, _Page((each,), whole + _GAINED, 0.0, is_as_found=True))
        for each in of.as_found
    }
    left = [each.left for each in (*sheets, *before.values())]
    first, *others = _lay_out_beside_as_found(of, [each.section for each in sheets], before, whole)
    title, lacking = lay_out_details(left, of.writer, whole)
    last_pages = (
        *([Section("details", title, lacking)] if lacking else []),
        *([statements.lay_out_opinions(keys, of.writer)] if keys.opinions else ()),
    )
    by_line = tuple(lay_out_results_by_line(of, _lay_out_line))
    ended = tuple(_begin_pages(last_pages))
    if ended and by_line and by_line[-1].key == measured_lines.BARE_LINES:
        # What little is said of lines without results of their own fills no page.
        ended = (replace(ended[0], new_page=False), *ended[1:])
    begun = (*_begin_pages(others), *by_line, *ended)
    return LaidOut((), (first, *begun), is_compact=True, head=pages[0].head)


def _choose_head(of: Material, first: _Page) -> _Page:
    """Return the first page below as much of letterhead and title as leaves the graph its usual height."""
    ways = [
        replace(first, free=first.free - measure_head_height(of, head) - columns.BELOW_TITLE, head=head)
        for head in Head
    ]
    for page in ways:
        figure = find_main_graph(page.evaluated[0].figures)
        beside = _measure_with_graph(_measure_usual_height(figure)) if figure else 0.0
        if _measure_free(of, page) - beside >= _LEAST_ROOM:
            return page
    return ways[-1]


def _begin_pages(sections: Iterable[Section]) -> Iterator[Section]:
    """Yield sections that each begin a page."""
    return (replace(each, new_page=True) for each in sections)


def _lay_out_beside_as_found(
    of: Material, sections: Sequence[Section], before: Mapping[str, _Sheet], free: float
) -> Iterator[Section]:
    """Yield the sheets; of an axis that was adjusted, those after, both states compared, and those before.

    `free`: What the page has for the comparison, points.
    """
    keys = of.job.keys.as_found
    if keys is None:
        return iter(sections)
    from zlmreport.document.certificate.as_found import lay_out_beside_as_found  # noqa: PLC0415 - of the few that need it

    comparison, *others = lay_out_beside_as_found(
        keys,
        sections,
        of.as_found,
        of.evaluated,
        of.writer,
        lambda each, _: before[each.evaluation.standard].section,
    )
    after, before_that = others[: len(sections)], others[len(sections) :]
    return iter((*after, fit_on_a_page(set_in_smaller_type(comparison), free), *before_that))


def _fill_sheet(of: Material, page: _Page) -> _Sheet:
    """Return a page, and what has no place on it."""
    writer, evaluation = of.writer, page.evaluations[0]
    outcome, listed, digest = _lay_out_always(of, evaluation)
    free, main = _measure_free(of, page), find_main_graph(page.evaluated[0].figures)
    said = _gather_said(of, page)
    room = _measure_room_beside(main, free, measure_least(said, writer))
    filled = fill(said, room, writer, page.gained)
    free += page.gained if filled.left != SheetContent() else 0.0
    free -= columns.estimate_height(filled.notices) + columns.estimate_height(filled.others)
    table = tuple(results.lay_out_by_position(evaluation, writer))
    with_graph = _measure_with_graph(_measure_usual_height(main)) if main else 0.0
    holds_table = columns.estimate_height(table) <= free - with_graph
    if holds_table:
        free -= columns.estimate_height(table)
    blocks = (
        *outcome,
        *([Graph(_fit_height(main, free))] if main else []),
        *filled.notices,
        *listed,
        *(table if holds_table else ()),
        *filled.others,
        *digest,
    )
    title = results.write_title_of(page.evaluations, writer)
    return _Sheet(Section(make_section_key(evaluation), title, blocks), filled.left)


def _lay_out_always(
    of: Material, evaluation: Evaluation
) -> tuple[tuple[Block, ...], tuple[Block, ...], tuple[Block, ...]]:
    """Return what every sheet has beside its graph: verdicts, parameters, digest."""
    return tuple(_say_outcome(evaluation, of)), _lay_out_parameters(evaluation, of.writer), tuple(_digest(of))


def _measure_free(of: Material, page: _Page) -> float:
    """Return what a page leaves for its graph and all that it need not have, points."""
    title = results.write_title_of(page.evaluations, of.writer)
    always = [block for blocks in _lay_out_always(of, page.evaluations[0]) for block in blocks]
    return page.free - columns.estimate_heading_height(title) - columns.estimate_height(always)


def _lay_out_line(each: Evaluated, writer: Writer) -> Section:
    """Return what a standard gives of one of several measured lines: their graph and their parameters."""
    main, evaluation = find_main_graph(each.figures), each.evaluation
    graph = [Graph(replace(main, height=_GRAPH_OF_A_LINE))] if main else []
    title = results.write_title_of([evaluation], writer)
    return Section(make_section_key(evaluation), title, (*graph, *_lay_out_parameters(evaluation, writer)))


def _measure_room_beside(figure: Figure | None, free: float, least: float) -> float:
    """Return what a page leaves to all but the graph, which is lower only where nothing else had room.

    `least`: That all else must have, points.
    """
    if figure is None:
        return free
    usual, lowest = map(_measure_with_graph, (_measure_usual_height(figure), _LEAST_GRAPH))
    return max(free - usual, min(least, free - lowest))


def _measure_with_graph(height: float) -> float:
    """Return the points that a graph of a height, mm, takes with its caption."""
    return (height + _BESIDE_GRAPH) * columns.MILLIMETRE


def _measure_usual_height(figure: Figure) -> float:
    """Return the height of a graph, mm, that it has wherever a page allows it: of a circle, its diameter."""
    is_round = all(panel.is_polar for panel in figure.panels)
    return _GRAPH + (_ABOUT_CIRCLE if is_round else 0.0)


def _fit_height(figure: Figure, free: float) -> Figure:
    usual = min(free / columns.MILLIMETRE - _BESIDE_GRAPH, _measure_usual_height(figure))
    height = max(usual, (free - _SPARE) / columns.MILLIMETRE - _BESIDE_GRAPH)
    return replace(figure, height=round(min(max(height, _LEAST_GRAPH), _LARGEST_GRAPH), 1))


def _say_outcome(evaluation: Evaluation, of: Material) -> Iterator[Paragraph]:
    """Yield what is stated of the limits, a line for each verdict: those who read no more have read this."""
    found: dict[Verdict, list[str]] = {}
    for each in evaluation.parameters:
        verdict = conformity.make_verdict_cell(each, of.writer)
        if isinstance(verdict, Verdict):
            found.setdefault(verdict, []).append(each.quantity.notation)
    for verdict in sorted(found, key=lambda each: _GRAVEST_FIRST.index(each.mark.value)):
        symbols = tuple(found[verdict])
        yield Paragraph(", ".join(map(write_plain, symbols)), verdict=verdict, symbols=symbols)


def _lay_out_parameters(evaluation: Evaluation, writer: Writer) -> tuple[Block, ...]:
    if not evaluation.parameters:
        return ()
    return (lay_out_parameters(evaluation, writer), *results.say_raised(evaluation, writer))


def _digest(of: Material) -> Iterator[Paragraph]:
    """Yield the digest as a sentence of its own: by it a page is told from another of the same number."""
    if not of.is_part:  # that of the whole document stands on its first page
        yield Paragraph(of.writer.say(named(DIGEST, f"{of.document.digest}.")), fine=True)


def _gather_said(of: Material, page: _Page) -> SheetContent:
    """Return what a page says besides; that of several measurements leaves out what their document says."""
    job, writer, evaluations = of.job, of.writer, page.evaluations
    said = (
        *uncertainty.say_uncertainty(page.evaluated[0].budget, evaluations, writer),
        *uncertainty.say_neglected(page.evaluated[0].budget, writer),
        *conformity.say_rule(job.keys.decision_rule, evaluations, writer),
        *conditions.say_no_influence(job, of.measurements, writer),
        *(() if of.is_part else statements.lay_out_paragraphs(job, writer, of.measurements)),
        *say_of_all(evaluations, writer),
    )
    notices = (
        *statements.make_amendment_notice(job.keys.certificate, writer),
        *(each for each in said if isinstance(each, Notice)),
        *cover.list_unlikely(of.document, writer, evaluations),
        *list_missing_readings(evaluations[0].measurements, writer),
        *measured_lines.list_notices(of.tests, writer),
        *statements.list_notices(job.keys, writer, names_all=True),
    )
    who, stated = _gather_stated(of, page)
    if page.head is not Head.WHOLE:
        who = (*who, *_list_laboratory(of))
    groups = [(key, replace(group, heading="") if key in _PLAIN_GROUPS else group) for key, group in stated]
    return SheetContent(
        notices=notices,
        who=who,
        law=tuple(each for each in said if isinstance(each, Paragraph)),
        conditions=tuple(group for _, group in groups),
        plain=frozenset(
            pair
            for _, group in groups
            if not group.heading
            for pair in group.pairs
            if columns.count_fact_lines(*pair) == 1
        ),
        corrections=()
        if page.is_as_found
        else tuple(conditions.lay_out_corrections(of.measurements, writer)),
    )


def _list_laboratory(of: Material) -> Iterator[Pair]:
    """Yield what of the laboratory its letterhead has no room for."""
    letterhead = of.document.letterhead
    if letterhead:
        said = filter(None, (", ".join(letterhead.laboratory.lines), letterhead.accreditation))
        yield of.writer.say(_LABORATORY), join_parts(said, of.writer.language)


def _gather_stated(of: Material, page: _Page) -> tuple[tuple[Pair, ...], tuple[tuple[str, Facts], ...]]:
    """Return who and what was measured, and the circumstances, in groups by their job keys.

    What head, heading or another fact says is left out, and the circumstances of an axis as found: they stand
    with the comparison.
    """
    job, writer = of.job, of.writer
    facts = cover.list_identity(of, page.evaluations)
    if of.is_part:
        facts = (each for each in facts if set(each.keys) & cover.OF_MEASUREMENT)
    said = {of.document.digest, conditions.describe_axis(job, writer)}
    if not of.is_part:  # a part has another heading
        said.add(list_designations(page.evaluated))
    who = tuple(pair for pair in select_stated_facts(facts, writer) if pair[1] not in said)
    if page.is_as_found:
        return who, ()
    said |= {value for _, value in who} | conditions.find_identified(job, writer)
    found = []
    for key, group in conditions.list_groups(job, of.measurements, of.described, writer):
        pairs = tuple(pair for pair in group.pairs if pair[1] not in said)
        said |= {value for _, value in pairs}
        if pairs and not (of.is_part and key == "machine"):
            found.append((key, replace(group, pairs=pairs)))
    return who, tuple(found)
