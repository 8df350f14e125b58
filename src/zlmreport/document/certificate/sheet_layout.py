"""The layout ``sheet``: a page for each standard, to hang at the machine.

The verdict, the graph and the parameters come first and always stand on the page; what was measured and
how stands below them as short facts, and what ISO/IEC 17025:2017 wants besides in small type at the foot.
What the page does not hold goes to a last page, *Details*, and the page says so: nothing is refused, and
nothing left out. The error model has no place on a sheet.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
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
from zlmreport.document.certificate.circumstances import stated_facts
from zlmreport.document.certificate.digest import DIGEST
from zlmreport.document.certificate.material import LaidOut, Material
from zlmreport.document.certificate.readings import missing_readings
from zlmreport.document.certificate.results import Evaluated, section_key
from zlmreport.document.certificate.standard_layout import (
    designations,
    in_smaller_type,
    main_graph,
    on_a_page,
    parameters,
    results_by_line,
    said_of_all,
    together,
)
from zlmreport.language import Words
from zlmreport.language.formatting import plain

if TYPE_CHECKING:
    from zlmreport.document.figures.figure import Figure
    from zlmreport.evaluation.evaluation import Evaluation

#: Heights of the graph, mm: that it has wherever a page allows it, the least, and the most.
_GRAPH, _LEAST_GRAPH, _LARGEST_GRAPH = 90.0, 45.0, 130.0
#: What a page before the last has besides, points: no end of the document, but some to spare for browsers.
_GAINED = columns.END_MARK - 9.0
#: Of its caption and of the space around it, mm.
_BESIDE_GRAPH = 8.0
#: Facts in two columns, from as many as there are to the fewest that somebody at the machine looks for.
_MOST_IN_COLUMNS = (24, 10, 6)
#: Groups of facts that need no heading, for their names say of what they are.
_PLAIN_GROUPS = ("axis", "circle", "measurement", "environment")

_DETAILS = Words(en="Details", de="Einzelheiten")
_ELSEWHERE = Words(en="On the page “{details}”: {what}.", de="Auf der Seite „{details}“: {what}.")
#: What a page says besides, in the order of how much it matters there, and how the page calls it.
_NAMES = {
    "notices": Words(en="what must not be overlooked", de="was zu beachten ist"),
    "facts": Words(en="who, what and when", de="wer, was und wann"),
    "law": Words(
        en="decision rule, uncertainty and traceability",
        de="Entscheidungsregel, Messunsicherheit und Rückführbarkeit",
    ),
    "further": Words(en="further conditions", de="weitere Bedingungen"),
    "corrections": Words(en="the corrections", de="die Korrektionen"),
}
_DIGEST = Words("{name}: {digest}.", "{name}: {digest}.")
#: Marks of verdicts in the order of their lines.
_GRAVEST_FIRST = ("not met", "open", "met")


@dataclass(frozen=True, slots=True)
class _Item:
    """What stands on the page if it holds it, and on the page of details if it does not."""

    what: str  #: Its key in `_NAMES`.
    blocks: tuple[Block, ...]  #: As they stand on the page.
    in_full: tuple[Block, ...] = ()  #: On the page of details, which has room; the same where this is empty.
    is_above: bool = False  #: Whether it stands above the graph.


def lay_out(of: Material) -> LaidOut:
    """Return the document: the sheets, and what they do not hold."""
    pages = together(of.evaluated, of.writer)
    beside = [0.0 if page is pages[-1] else -_GAINED for page in pages]
    if not of.as_found:  # or else the comparison stands before them
        beside[0] += columns.head_height(of.letterhead, of.title)
    elsewhere: set[str] = set()
    for page, taken in zip(pages, beside, strict=True):
        elsewhere |= _items_on(of, page, taken)[1]
    sections = [_sheet(of, page, taken, elsewhere) for page, taken in zip(pages, beside, strict=True)]
    first, *others = _beside_as_found(of, sections, elsewhere)
    last = (*_details(of, pages, elsewhere), *statements.opinion_sections(of.job.keys, of.writer))
    begun = (*_on_pages(others), *results_by_line(of), *_on_pages(last))
    return LaidOut((), (first, *begun), is_compact=True)


def _on_pages(sections: Iterable[Section]) -> Iterator[Section]:
    """Yield sections that each begin a page."""
    return (replace(each, new_page=True) for each in sections)


def _beside_as_found(of: Material, sections: Sequence[Section], elsewhere: set[str]) -> Iterator[Section]:
    """Yield the sheets; of an axis that was adjusted, those before, after, and compared."""
    keys = of.job.keys.as_found
    if keys is None:
        return iter(sections)
    from zlmreport.document.certificate.as_found import beside_as_found  # noqa: PLC0415 - of the few that need it

    comparison, *others = beside_as_found(
        keys,
        sections,
        of.as_found,
        of.evaluated,
        of.writer,
        lambda each, _: _sheet(of, (each,), 0.0, elsewhere),
    )
    free = columns.PAGES[of.job.keys.certificate.paper] - columns.head_height(of.letterhead, of.title)
    return iter((on_a_page(in_smaller_type(comparison), free), *others))


def _details(of: Material, pages: Sequence[tuple[Evaluated, ...]], elsewhere: set[str]) -> Iterator[Section]:
    """Yield the page of what the sheets do not hold; what several of them would say stands there once."""
    blocks = dict.fromkeys(
        block
        for page in pages
        for item in _items(of, page, _MOST_IN_COLUMNS[0])
        if item.what in elsewhere
        for block in item.in_full or item.blocks
    )
    if blocks:
        yield Section("details", of.writer.say(_DETAILS), tuple(blocks))


def _room(of: Material, page: tuple[Evaluated, ...], beside: float) -> float:
    """Return what a page has for the graph and all items, points, beside what always stands on it."""
    title = results.title_of([each.evaluation for each in page], of.writer)
    free = columns.PAGES[of.job.keys.certificate.paper] - beside - columns.heading_height(title)
    evaluation = page[0].evaluation
    always = (*_outcome(evaluation, of), *_parameters(evaluation, of), *_digest(of))
    return free - columns.height(always)


def _graph_height(figure: Figure | None, room: float) -> float:
    """Return how high a graph stands with its caption, points, in a page that has so much room for it."""
    if figure is None:
        return 0.0
    height = min(max(room / columns.MILLIMETRE - _BESIDE_GRAPH, _LEAST_GRAPH), _GRAPH)
    return (height + _BESIDE_GRAPH) * columns.MILLIMETRE


def _items_on(of: Material, page: tuple[Evaluated, ...], beside: float) -> tuple[tuple[_Item, ...], set[str]]:
    """Return what a page says besides, and the keys of what of it the page does not hold.

    Facts in columns are read at a glance and take room; where all of them leave too little, some go into the
    running text, and only where that is not enough does the page part with what matters least.
    """
    room = _room(of, page, beside)
    room -= _graph_height(main_graph(page[0].figures), room)
    for most in _MOST_IN_COLUMNS:
        items = _items(of, page, most)
        if sum(columns.height(each.blocks) for each in items) <= room:
            return items, set()
    items = _items(of, page, _MOST_IN_COLUMNS[0])
    room -= columns.height([_elsewhere({each.what for each in items}, of)])
    gone: set[str] = set()
    for each in items:
        height = columns.height(each.blocks)
        if height > room:
            gone.add(each.what)
        else:
            room -= height
    return items, gone


def _sheet(of: Material, page: tuple[Evaluated, ...], beside: float, elsewhere: set[str]) -> Section:
    """Return a page, but for what stands elsewhere."""
    writer, evaluation = of.writer, page[0].evaluation
    items, _ = _items_on(of, page, beside)
    here = [each for each in items if each.what not in elsewhere]
    above = [block for each in here if each.is_above for block in each.blocks]
    below = [block for each in here if not each.is_above for block in each.blocks]
    if gone := {each.what for each in items} & elsewhere:
        below.append(_elsewhere(gone, of))
    main = main_graph(page[0].figures)
    free = _room(of, page, beside) - columns.height(above) - columns.height(below)
    table = tuple(results.by_position(evaluation, writer))
    with_graph = (_GRAPH + _BESIDE_GRAPH) * columns.MILLIMETRE if main else 0.0
    holds_table = columns.height(table) <= free - with_graph
    if holds_table:
        free -= columns.height(table)
    blocks = (
        *above,
        *_outcome(evaluation, of),
        *([Graph(_as_high_as(main, free))] if main else []),
        *_parameters(evaluation, of),
        *(table if holds_table else ()),
        *below,
        *_digest(of),
    )
    return Section(
        section_key(evaluation), results.title_of([each.evaluation for each in page], writer), blocks
    )


def _as_high_as(figure: Figure, free: float) -> Figure:
    height = free / columns.MILLIMETRE - _BESIDE_GRAPH
    return replace(figure, height=round(min(max(height, _LEAST_GRAPH), _LARGEST_GRAPH), 1))


def _outcome(evaluation: Evaluation, of: Material) -> Iterator[Paragraph]:
    """Yield what is stated of the limits, a line for each verdict: those who read no more have read this."""
    found: dict[Verdict, list[str]] = {}
    for each in evaluation.parameters:
        verdict = conformity.verdict(each, of.writer)
        if isinstance(verdict, Verdict):
            found.setdefault(verdict, []).append(plain(each.quantity.notation))
    for verdict in sorted(found, key=lambda each: _GRAVEST_FIRST.index(each.mark.value)):
        yield Paragraph(", ".join(found[verdict]), verdict=verdict)


def _parameters(evaluation: Evaluation, of: Material) -> tuple[Block, ...]:
    if not evaluation.parameters:
        return ()
    return (parameters(evaluation, of.writer), *results.raised(evaluation, of.writer))


def _digest(of: Material) -> Iterator[Paragraph]:
    """Yield the digest as a sentence of its own: by it a page is told from another of the same number."""
    if not of.is_part:  # that of the whole document stands on its first page
        yield Paragraph(of.writer.say(_DIGEST.given(name=DIGEST, digest=of.digest)), fine=True)


def _elsewhere(what: set[str], of: Material) -> Paragraph:
    """Return the line that says what stands on the page of details."""
    named = ", ".join(of.writer.say(name) for key, name in _NAMES.items() if key in what)
    return Paragraph(of.writer.say(_ELSEWHERE.given(details=_DETAILS, what=named)))


def _items(of: Material, page: Sequence[Evaluated], most: int) -> tuple[_Item, ...]:
    """Return what a page says besides, in the order of how much it matters; `most` facts stand in columns."""
    job, writer = of.job, of.writer
    evaluations = [each.evaluation for each in page]
    said = (
        *uncertainty.statement(page[0].budget, evaluations, writer),
        *uncertainty.neglected(page[0].budget, writer),
        *conformity.rule_paragraph(job.keys.decision_rule, evaluations, writer),
        *conditions.no_influence(job, of.measurements, writer),
        *statements.paragraphs(job, writer),
    )
    notices = (
        *statements.amendment_notice(job.keys.certificate, writer),
        *said_of_all(evaluations, writer),
        *cover.unlikely(of, writer),
        *missing_readings(of.measurements, writer),
        *measured_lines.notices(of.tests, writer),
        *statements.notices(job.keys, writer),
        *(each for each in said if isinstance(each, Notice)),
    )
    law = tuple(each for each in said if isinstance(each, Paragraph))
    stated = tuple(_stated(of, page))
    short, long = _shown(stated, most)
    items = (
        _Item("notices", notices, is_above=True),
        _Item("facts", _in_two_columns(short)),
        _Item("law", (Paragraph(" ".join(each.text for each in law), fine=True),), law),
        _Item("further", (Paragraph(long, fine=True),) if long else (), tuple(group for _, group in stated)),
        _Item("corrections", tuple(conditions.correction_blocks(of.measurements, writer))),
    )
    return tuple(each for each in items if each.blocks)


def _stated(of: Material, page: Sequence[Evaluated]) -> Iterator[tuple[str, Facts]]:
    """Yield the groups of facts by their job keys; what title, heading or another fact says is left out."""
    job, writer = of.job, of.writer
    said = {designations(page), of.digest, conditions.axis_in_words(job, writer)}
    identity = stated_facts(cover.identity(of, [each.evaluation for each in page]), writer)
    groups = (("", Facts(identity)), *conditions.groups(job, of.measurements, of.described, writer))
    for key, group in groups:
        pairs = tuple(pair for pair in group.pairs if pair[1] not in said)
        said |= {value for _, value in pairs} | conditions.identified(job, writer)
        if pairs:
            yield key, replace(group, pairs=pairs)


def _shown(groups: Sequence[tuple[str, Facts]], most: int) -> tuple[list[tuple[str, str]], str]:
    """Return the facts of a line each, whose names say of what they are; and the others as running text."""
    short: list[tuple[str, str]] = []
    long: list[str] = []
    for key, group in groups:
        is_plain = key in _PLAIN_GROUPS or not group.heading
        fits = [pair for pair in group.pairs if is_plain and columns.fact_lines(*pair) == 1]
        fits = fits[: most - len(short)]
        short += fits
        if others := [": ".join(pair) for pair in group.pairs if pair not in fits]:
            heading = f"{group.heading} – " if group.heading else ""
            long.append(f"{heading}{'; '.join(others)}.")
    return short, " ".join(long)


def _in_two_columns(pairs: Sequence[tuple[str, str]]) -> tuple[Block, ...]:
    if len(pairs) < 2:
        return (Facts(tuple(pairs)),) if pairs else ()
    ways: Iterable[tuple[Facts, Facts]] = (
        (Facts(tuple(pairs[:end])), Facts(tuple(pairs[end:]))) for end in range(1, len(pairs))
    )
    return min(ways, key=columns.height)
