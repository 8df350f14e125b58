"""The layout ``standard``: a page or so for each standard, and once for all what the standards share.

Editions that give the same numbers share their page, and it says so.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from dataclasses import replace
from typing import TypeAlias, TypeGuard

from zlmreport.document.blocks import Block, Facts, Graph, Notice, Paragraph, RowGroup, Section, Symbol, Table
from zlmreport.document.certificate import columns, conditions, conformity, origin, results
from zlmreport.document.certificate.cover import Behind, lay_out_cover
from zlmreport.document.certificate.document import Head
from zlmreport.document.certificate.material import (
    LaidOut,
    Material,
    lay_out_opinions_and_model,
    lay_out_readings,
    lay_out_uncertainty,
)
from zlmreport.document.certificate.measured_lines import lay_out_results
from zlmreport.document.certificate.results import Evaluated, make_section_key
from zlmreport.document.certificate.values import Values, tell_columns_apart
from zlmreport.document.figures.figure import Figure, Panel
from zlmreport.document.writer import Writer
from zlmreport.evaluation.evaluation import Evaluation, QuantityGroup
from zlmreport.language import Words

#: Heights of graphs, mm: of the main one, of panels beside each other, of any other, of what is no result.
_MAIN, _BESIDE, _OTHER, _ASIDE = 57.0, 43.0, 54.0, 46.0
#: Of a picture, as of a circle or a plate, mm: the other one stands below it on the same page.
_PICTURE = 120.0
#: The part of its height that a graph keeps at least where a page is short of room.
_LEAST_DRAWN = 0.75
#: Points that are none.
_ROUNDED = 1e-6
#: The part of the first page that must be taken for the next part to begin a page.
_FULL_ENOUGH = 0.38
#: The part of a page with which a line that is too long for one may end: the next goes on below.
_LITTLE = 0.5
#: Panels that have room beside each other.
_MOST_BESIDE = 2

#: Groups of conditions by their job keys, in the order in which they leave the first page; an extension's has
#: none.
_LEAST_LOOKED_FOR = ("", "environment", "instrument", "measurement", "axis", "circle", "machine")

#: Evaluations that share a page, page by page.
Pages: TypeAlias = list[tuple[Evaluated, ...]]

_SHARED = Words("These readings give the same numbers by {others}; {named} are those of {first}.")
_NAMES = Words("the names")
_NAMES_AND_LIMITS = Words("names and limits")
_DEFINITIONS = Words("Limits, requirements and definitions")
_IN_THREE_GROUPS = Words("{parameters}: systematic, random and composite deviations")
_DEFINED = Words("{caption} {designations}.")


def lay_out(of: Material) -> LaidOut:
    """Return the document.

    Each standard begins a page where the first page holds all that stands before the results, and is not
    left empty by it; where it does not, parts follow each other without a break.
    """
    pages = group_together(of.evaluated, of.writer)
    page = columns.PAGES[of.job.keys.certificate.paper]
    below_title = page - measure_head_height(of)
    on_cover, behind = _lay_out_first_page(of, pages, below_title)
    free = below_title - columns.estimate_height(on_cover)
    breaks = 0 <= free <= (1 - _FULL_ENOUGH) * page
    return LaidOut(
        on_cover,
        (
            *_lay_out_results(of, pages, page if breaks else None),
            *(lay_out_results_by_line(of) if of.tests else ()),
            *map(set_in_smaller_type, _lay_out_further_conditions(of, behind)),
            *_lay_out_in_common(pages, of.writer),
            # without bars: the table says what they would repeat
            *lay_out_uncertainty(of, with_bars=False),
            *lay_out_readings(of),
            set_in_smaller_type(origin.lay_out_origin(of)),
            *map(set_in_smaller_type, lay_out_opinions_and_model(of)),
        ),
        is_compact=True,
    )


def _lay_out_first_page(
    of: Material, pages: Sequence[tuple[Evaluated, ...]], room: float
) -> tuple[tuple[Block, ...], tuple[Facts, ...]]:
    """Return the blocks under the title, and the groups of conditions that stand behind.

    Who and what, the results in brief, the decision rule and the statements stand together, whatever a job
    states. What is long stands behind, and the page says where: first conditions of the measurement, group by
    group, then what U means. Where even that leaves too little room, it is the results that go on on the next
    page.

    `pages`: Evaluations that share their results in brief. `room`: What the page has below its title, points.
    """
    groups = list(
        conditions.list_groups_beside_identification(of.job, of.measurements, of.described, of.writer)
    )
    for behind in _list_ways(of, [key for key, _ in groups]):
        blocks = lay_out_cover(of, pages, behind)
        if columns.estimate_height(blocks) <= room:
            break
    left = [group for key, group in groups if key in behind.conditions]
    return blocks, tuple(left)


def _list_ways(of: Material, groups: Collection[str]) -> Iterator[Behind]:
    """Yield what stands behind, from nothing to all that can; a section that a job leaves out takes none.

    `groups`: The job keys of the conditions that the first page has where there is room.
    """
    wanted = of.job.keys.certificate.sections
    behind = Behind()
    yield behind
    if wanted is None or "conditions" in wanted:
        for key in _LEAST_LOOKED_FOR:
            if key in groups:
                behind = replace(behind, conditions=behind.conditions | {key})
                yield behind
    if wanted is None or "uncertainty" in wanted:
        behind = replace(behind, explains_uncertainty=True)
        yield behind
    yield replace(behind, results=True)


def measure_head_height(of: Material, head: Head = Head.WHOLE) -> float:
    """Return how high a document's letterhead and title stand, points."""
    it = of.document
    return columns.estimate_head_height(it.letterhead, it.title, it.subtitle, it.number, head)


def _lay_out_one(each: Evaluated, writer: Writer) -> Section:
    return _lay_out_page((each,), writer)


def lay_out_results_by_line(
    of: Material, section_of: Callable[[Evaluated, Writer], Section] = _lay_out_one
) -> Iterator[Section]:
    """Yield what is said of each of several measured lines, on a page if it fits on one.

    Lines of which little is said share one, and below a line that ends at the top of a page the next goes on.
    """
    known = conditions.list_groups(of.job, of.measurements, of.described, of.writer)
    sections = lay_out_results(of.tests, known, of.writer, section_of)
    room = columns.PAGES[of.job.keys.certificate.paper]
    used = room
    for each in sections:
        section = fit_on_a_page(each, room)
        taken = columns.estimate_heading_height(section.title) + columns.estimate_height(section.blocks)
        begins_page = used + taken > room and used > _LITTLE * room
        yield replace(section, new_page=begins_page)
        used = (taken if begins_page else used + taken) % room


def _lay_out_further_conditions(of: Material, behind: tuple[Facts, ...]) -> Iterator[Section]:
    """Yield what is to be said of the conditions besides what the first page states of them."""
    blocks = (*behind, *conditions.list_besides(of.measurements, of.described, of.writer))
    if blocks:
        yield Section("conditions", of.writer.say(conditions.TITLE), blocks)


def _lay_out_results(of: Material, pages: Pages, room_of_page: float | None) -> Iterator[Section]:
    """Yield the results; of an axis that was adjusted, compared first, after and before.

    Each standard begins a page of that many points, or goes on where the one before ends.
    """
    sections: Iterator[Section] = (_lay_out_page(each, of.writer) for each in pages)
    keys = of.job.keys.as_found
    if keys:
        from zlmreport.document.certificate.as_found import lay_out_beside_as_found  # noqa: PLC0415 - of the few that need it

        sections = lay_out_beside_as_found(keys, sections, of.as_found, of.evaluated, of.writer, _lay_out_one)
        comparison = fit_on_a_page(
            set_in_smaller_type(next(sections)), columns.PAGES[of.job.keys.certificate.paper]
        )
        yield replace(comparison, new_page=room_of_page is not None)
    if room_of_page is None:
        yield from sections
    else:
        yield from (replace(fit_on_a_page(each, room_of_page), new_page=True) for each in sections)


def set_in_smaller_type(section: Section) -> Section:
    """Return a section with graphs no higher than they must be, and tables in smaller type."""
    return replace(section, blocks=tuple(map(_shrink_block, section.blocks)))


def fit_on_a_page(section: Section, page: float) -> Section:
    """Return a section with its graphs somewhat lower, if that makes it fit on a page.

    Panels beside each other are low already: they give way last.
    """
    excess = columns.estimate_heading_height(section.title) + columns.estimate_height(section.blocks) - page
    blocks = section.blocks
    for is_wide in (False, True):
        heights = [each.figure.height or 0.0 for each in blocks if _is_drawn(each, is_wide=is_wide)]
        drawn = sum(heights) * columns.MILLIMETRE
        part = min(1.0, max(_LEAST_DRAWN, 1 - excess / drawn)) if drawn else 1.0
        blocks = tuple(
            _lower_graph(each, part) if _is_drawn(each, is_wide=is_wide) else each for each in blocks
        )
        excess -= (1 - part) * drawn
    return section if excess > _ROUNDED else replace(section, blocks=blocks)


def _is_drawn(block: Block, *, is_wide: bool) -> TypeGuard[Graph]:
    return isinstance(block, Graph) and block.figure.is_wide is is_wide


def _lower_graph(graph: Graph, part: float) -> Graph:
    height = graph.figure.height
    return Graph(replace(graph.figure, height=height and round(height * part, 1)))


def _shrink_block(block: Block) -> Block:
    match block:
        case Graph(figure):
            return Graph(replace(figure, height=_ASIDE * len(figure.panels)))
        case Table():
            return replace(block, dense=True)
        case _:
            return block


def group_together(evaluated: Iterable[Evaluated], writer: Writer) -> Pages:
    """Return the evaluations, those together that share a page: the first of them gives names and limits."""
    pages: Pages = []
    numbers: list[list[object]] = []
    for each in evaluated:
        printed = _list_numbers(each.evaluation, writer)
        for number, page in enumerate(pages):
            if printed == numbers[number] and _has_no_other_limits(page[0].evaluation, each.evaluation):
                pages[number] = (*page, each)
                break
        else:
            pages.append((each,))
            numbers.append(printed)
    return pages


def list_designations(page: Sequence[Evaluated]) -> str:
    """Return the standards of a page."""
    return ", ".join(each.evaluation.designation for each in page)


def _lay_out_page(shared: Sequence[Evaluated], writer: Writer) -> Section:
    """Return the results by a standard, and by others that give the same numbers."""
    first, *others = (each.evaluation for each in shared)
    blocks: list[Block] = [*say_of_all((first, *others), writer)]
    if first.parameters:
        blocks += (lay_out_parameters(first, writer), *results.say_raised(first, writer))
    blocks += map(Graph, draw_in_less_room(shared[0].figures))
    blocks += results.lay_out_by_position(first, writer)
    return Section(make_section_key(first), results.write_title_of((first, *others), writer), tuple(blocks))


def say_of_all(evaluations: Sequence[Evaluation], writer: Writer) -> Iterator[Block]:
    """Yield that standards share a page, whose names it has, and what deviates from them."""
    first, *others = evaluations
    if others:
        has_limits = any(each.limit is not None for each in first.parameters)
        named = _NAMES_AND_LIMITS if has_limits else _NAMES
        names = ", ".join(each.designation for each in others)
        yield Paragraph(writer.say(_SHARED.given(others=names, named=named, first=first.designation)))
    yield from _list_shortfalls(evaluations, writer)


def _lay_out_in_common(pages: Sequence[Sequence[Evaluated]], writer: Writer) -> Iterator[Section]:
    """Yield what is said once for all standards: limits, requirements, definitions, notes."""
    evaluations = [each.evaluation for page in pages for each in page]
    tables = [*conformity.lay_out_statements([page[0].evaluation for page in pages], writer)]
    if any(each.findings for each in evaluations):
        tables.append(results.lay_out_requirements(evaluations, writer))
    blocks: list[Block] = [*map(_shrink_block, tables)]
    for page in pages:
        lead = page[0].evaluation
        if lead.parameters:
            defined = results.lay_out_definitions(lead, writer)
            caption = _DEFINED.given(caption=defined.caption, designations=list_designations(page))
            blocks.append(replace(defined, caption=writer.say(caption)))
        # Below its own definitions: of "2 standard deviations" a reader must know which standard takes them.
        notes = (writer.say(note) for each in page for note in each.evaluation.notes)
        blocks += (Paragraph(note, fine=True) for note in dict.fromkeys(notes))
    if blocks:
        yield Section("definitions", writer.say(_DEFINITIONS), tuple(blocks))


def draw_in_less_room(figures: Sequence[Figure]) -> Iterator[Figure]:
    """Yield a standard's graphs: the one with the brackets first, and none that shows its curves again.

    Single readings of a graph that is left out stand in the one that is kept.
    """
    single = [each for each in figures if len(each.panels) == 1]
    main = find_main_graph(figures)
    if main is not None and len(main.panels) == 1:
        again = [
            each for each in single if each is not main and _is_shown_again(each.panels[0], main.panels[0])
        ]
        readings = main.panels[0].readings or next((each.panels[0].readings for each in again), ())
        height = _PICTURE if main.panels[0].projection != "straight" else _MAIN
        yield replace(main, panels=(replace(main.panels[0], readings=readings),), height=height)
        single = [each for each in single if each is not main and each not in again]
    for each in figures:
        if 1 < len(each.panels) <= _MOST_BESIDE and not each.has_several_quantities:
            yield replace(each, height=_BESIDE, is_wide=True)
        elif len(each.panels) > 1:
            yield each
        elif any(each is other for other in single):
            yield replace(each, height=_PICTURE if each.panels[0].is_wire else _OTHER)


def find_main_graph(figures: Sequence[Figure]) -> Figure | None:
    """Return the graph that shows where the parameters arise; any other of one panel if none does.

    Of a circle it is that about the circle; where none has one panel, that of several quantities on one axis,
    or the first one with panels beside each other.
    """
    single = [each for each in figures if len(each.panels) == 1]
    single = single or [each for each in figures if each.has_several_quantities] or list(figures)
    single = [each for each in single if each.panels[0].is_polar] or single
    return next((each for each in single if each.panels[0].brackets), single[0] if single else None)


def _is_shown_again(panel: Panel, main: Panel) -> bool:
    def shown(of: Panel) -> set[tuple[object, ...]]:
        curves = {(each.role, each.y.tobytes()) for each in of.curves}
        return curves | {(each.role, each.lower.tobytes(), each.upper.tobytes()) for each in of.bands}

    return not panel.bars and not panel.levels and shown(panel) <= shown(main)


def _has_no_other_limits(first: Evaluation, other: Evaluation) -> bool:
    """Return whether the other evaluation has no limits of its own."""
    limits = [(each.limit, each.decision) for each in other.parameters]
    return all(limit is None for limit, _ in limits) or limits == [
        (each.limit, each.decision) for each in first.parameters
    ]


def _list_numbers(evaluation: Evaluation, writer: Writer) -> list[object]:
    """Return what is printed of an evaluation, but for its limits."""
    without_limits = Values(writer, has_uncertainty=True, has_limits=False)
    parameters = [
        (each.quantity.notation, each.quantity.group, tuple(without_limits.list_cells(each)))
        for each in evaluation.parameters
    ]
    return [parameters, *results.lay_out_by_position(evaluation, writer)]


def _list_shortfalls(evaluations: Sequence[Evaluation], writer: Writer) -> Iterator[Notice]:
    """Yield the notices of requirements that are not met; standards with the same ones share a notice."""
    found: dict[tuple[str, ...], list[str]] = {}
    for each in evaluations:
        if items := results.list_unmet(each, writer):
            found.setdefault(items, []).append(each.designation)
    for items, names in found.items():
        yield results.make_shortfall(", ".join(names), items, evaluations, writer)


def lay_out_parameters(evaluation: Evaluation, writer: Writer) -> Table:
    """Return all parameters by a standard: a row each, what repeats apart from what scatters."""
    values = Values.of([evaluation], writer, with_interval=True)
    headings = tuple(values.list_columns())
    groups = (
        tuple(
            (Symbol(each.quantity.notation), writer.say(each.quantity.name), *values.list_cells(each))
            for each in evaluation.parameters
            if each.quantity.group is group
        )
        for group in QuantityGroup
    )
    caption = results.say_parameters(evaluation)
    if evaluation.measurements.axis.measurand.is_position:
        caption = _IN_THREE_GROUPS.given(parameters=caption)
    rows = tuple(RowGroup(each) for each in groups if each)
    told, symbols = tell_columns_apart(
        caption,
        (each.quantity for each in evaluation.parameters),
        has_uncertainty=values.has_uncertainty,
        writer=writer,
    )
    return Table(told, headings, rows, dense=True, symbols=symbols)
