"""The layout ``standard``: a page or so for each standard, and once for all what the standards share.

Editions that give the same numbers share their page, and it says so.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from typing import TypeAlias

from zlmreport.certificate import conformity, results
from zlmreport.certificate.document import (
    Block,
    Column,
    Graph,
    Notice,
    Paragraph,
    RowGroup,
    Section,
    Symbol,
    Table,
)
from zlmreport.certificate.results import Evaluated, section_key
from zlmreport.certificate.values import Values
from zlmreport.evaluation.evaluation import Evaluation
from zlmreport.evaluation.quantity import Group
from zlmreport.figures.figure import Figure, Panel
from zlmreport.language import Words
from zlmreport.presenting.writer import Writer

#: Heights of graphs, mm: of the main one, of panels beside each other, of any other panel.
_MAIN, _BESIDE, _OTHER = 57.0, 43.0, 54.0
#: Panels that have room beside each other.
_MOST_BESIDE = 2

#: Evaluations that share a page, page by page.
Pages: TypeAlias = list[tuple[Evaluated, ...]]

_TITLE = Words(en="Results by {designations}", de="Ergebnisse nach {designations}")
_SHARED = Words(
    en="These readings give the same numbers by {others}; the names are those of {first}.",
    de="Diese Messwerte ergeben nach {others} dieselben Zahlen; die Benennungen sind die von {first}.",
)
_SHARED_WITH_LIMITS = Words(
    en="These readings give the same numbers by {others}; names and limits are those of {first}.",
    de="Diese Messwerte ergeben nach {others} dieselben Zahlen; Benennungen und Grenzwerte sind die von "
    "{first}.",
)
_DEFINITIONS = Words(
    en="Limits, requirements and definitions", de="Grenzwerte, Anforderungen und Definitionen"
)
_DEFINED = Words(en="{caption} {designations}.", de="{caption} {designations}.")


def together(evaluated: Iterable[Evaluated], writer: Writer) -> Pages:
    """Return the evaluations, those together that share a page: the first of them gives names and limits."""
    pages: Pages = []
    for each in evaluated:
        for number, page in enumerate(pages):
            if _is_alike(page[0].evaluation, each.evaluation, writer):
                pages[number] = (*page, each)
                break
        else:
            pages.append((each,))
    return pages


def designations(page: Sequence[Evaluated]) -> str:
    """Return the standards of a page."""
    return ", ".join(each.evaluation.designation for each in page)


def page(shared: Sequence[Evaluated], writer: Writer) -> Section:
    """Return the results by a standard, and by others that give the same numbers."""
    first, *others = (each.evaluation for each in shared)
    blocks: list[Block] = []
    if others:
        words = _SHARED_WITH_LIMITS if any(each.limit is not None for each in first.parameters) else _SHARED
        names = ", ".join(each.designation for each in others)
        blocks.append(Paragraph(writer.say(words.given(others=names, first=first.designation))))
    blocks += _shortfalls((first, *others), writer)
    if first.parameters:
        blocks += (_parameters(first, writer), *results.raised(first, writer))
    blocks += map(Graph, in_less_room(shared[0].figures))
    blocks.append(results.positions(first, writer))
    title = _TITLE.given(designations=designations(shared))
    return Section(section_key(first), writer.say(title), tuple(blocks), new_page=True)


def page_of_one(evaluated: Evaluated, writer: Writer) -> Section:
    """Return the results by a standard that shares its page with none."""
    return page((evaluated,), writer)


def in_common(pages: Sequence[Sequence[Evaluated]], writer: Writer) -> Iterator[Section]:
    """Yield what is said once for all standards: limits, requirements, definitions, notes."""
    evaluations = [each.evaluation for page in pages for each in page]
    blocks: list[Block] = [*conformity.statements([page[0].evaluation for page in pages], writer)]
    if any(each.findings for each in evaluations):
        blocks.append(results.requirements(evaluations, writer))
    for page in pages:
        lead = page[0].evaluation
        if lead.parameters:
            defined = results.definitions(lead, writer)
            caption = _DEFINED.given(caption=defined.caption, designations=designations(page))
            blocks.append(replace(defined, caption=writer.say(caption)))
    notes = (writer.say(note) for each in evaluations for note in each.notes)
    blocks += map(Paragraph, dict.fromkeys(notes))
    if blocks:
        yield Section("definitions", writer.say(_DEFINITIONS), tuple(blocks))


def in_less_room(figures: Sequence[Figure]) -> Iterator[Figure]:
    """Yield a standard's graphs: the one with the brackets first, and none that shows its curves again.

    Single readings of a graph that is left out stand in the one that is kept.
    """
    single = [each for each in figures if len(each.panels) == 1]
    main = next((each for each in single if each.panels[0].brackets), single[0] if single else None)
    if main is not None:
        again = [each for each in single if each is not main and _shows_again(each.panels[0], main.panels[0])]
        readings = main.panels[0].readings or next((each.panels[0].readings for each in again), ())
        yield replace(main, panels=(replace(main.panels[0], readings=readings),), height=_MAIN)
        single = [each for each in single if each is not main and each not in again]
    for each in figures:
        if 1 < len(each.panels) <= _MOST_BESIDE:
            yield replace(each, height=_BESIDE, is_wide=True)
        elif len(each.panels) > 1:
            yield each
        elif any(each is other for other in single):
            yield replace(each, height=_OTHER)


def _shows_again(panel: Panel, main: Panel) -> bool:
    def shown(of: Panel) -> set[tuple[object, ...]]:
        curves = {(each.role, each.y.tobytes()) for each in of.curves}
        return curves | {(each.role, each.lower.tobytes(), each.upper.tobytes()) for each in of.bands}

    return not panel.bars and not panel.levels and shown(panel) <= shown(main)


def _is_alike(first: Evaluation, other: Evaluation, writer: Writer) -> bool:
    """Return whether two evaluations print the same numbers, and the other has no limits of its own."""
    limits = [(each.limit, each.decision) for each in other.parameters]
    return _numbers(first, writer) == _numbers(other, writer) and (
        all(limit is None for limit, _ in limits)
        or limits == [(each.limit, each.decision) for each in first.parameters]
    )


def _numbers(evaluation: Evaluation, writer: Writer) -> list[object]:
    without_limits = Values(writer, has_uncertainty=True, has_limits=False)
    parameters = [
        (each.quantity.notation, each.quantity.group, without_limits.cells(each))
        for each in evaluation.parameters
    ]
    return [parameters, results.positions(evaluation, writer)]


def _shortfalls(evaluations: Sequence[Evaluation], writer: Writer) -> Iterator[Notice]:
    """Yield the notices of requirements that are not met; standards with the same ones share a notice."""
    found: dict[tuple[str, ...], list[str]] = {}
    for each in evaluations:
        if items := results.unmet(each, writer):
            found.setdefault(items, []).append(each.designation)
    for items, names in found.items():
        yield results.shortfall(", ".join(names), items, writer)


def _parameters(evaluation: Evaluation, writer: Writer) -> Table:
    values = Values.of([evaluation], writer)
    columns = (
        Column(writer.say(Words(en="Symbol", de="Zeichen"))),
        Column(writer.say(Words(en="Parameter", de="Kenngröße"))),
        *values.columns,
    )
    order = list(Group)
    rows = tuple(
        (Symbol(each.quantity.notation), writer.say(each.quantity.name), *values.cells(each))
        for each in sorted(evaluation.parameters, key=lambda each: order.index(each.quantity.group))
    )
    caption = Words(
        en="Parameters of the axis: systematic, random and composite deviations",
        de="Kenngrößen der Achse: systematische, zufällige und Gesamtabweichungen",
    )
    return Table(writer.say(caption), columns, (RowGroup(rows),), dense=True)
