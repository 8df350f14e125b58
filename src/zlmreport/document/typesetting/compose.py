"""A certificate becomes one document of HTML that is well-formed XML as well.

So a browser reads it, and a PDF renderer parses it in a fraction of the time that HTML's own grammar takes.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from itertools import repeat

from markupsafe import Markup

from zlmreport.document.blocks import (
    Align,
    Cell,
    Explained,
    Formulas,
    Graph,
    Notice,
    Paragraph,
    Section,
    Table,
    Verdict,
    write_cell_text,
)
from zlmreport.document.certificate import columns
from zlmreport.document.certificate.columns import GatheredBlock, NumberedBlock
from zlmreport.document.certificate.document import Certificate, Linked, OwnTemplate
from zlmreport.document.certificate.endings import Ending, find_endings, is_all_of
from zlmreport.document.typesetting.resources import write_linked_values
from zlmreport.document.typesetting.templates import (
    CellContext,
    Context,
    DocumentContext,
    FactsContext,
    FormulasContext,
    GraphContext,
    LetterheadContext,
    LinkedContext,
    NoticeContext,
    ParagraphContext,
    RowGroupContext,
    SectionContext,
    TableContext,
    render,
    set_symbol,
    set_text_with_symbols,
)

#: Where a renderer finds a drawing by its number from 0, and the logo.
GRAPH_ADDRESS = "graph:{}"
#: Where a page asks for the logo of the laboratory.
LOGO_ADDRESS = "logo:"


@dataclass(frozen=True, slots=True)
class Setting:
    """What differs from renderer to renderer.

    Attributes
    ----------
    style
        Style sheets in the document's head; empty where they are handed over otherwise.
    drawings
        The graphs as markup, in reading order; empty where they stand at ``graph:0``, ``graph:1`` …
    logo
        Address of the logo.
    policy
        Content security policy; empty where the document is none for a browser.
    is_for_screens
        Whether its tables stack their cells where a screen is narrow, and can be scrolled by keys.
    script
        Shows the linked graphs; empty where nothing is run, and then the document has none.
    """

    style: str = ""
    drawings: tuple[str, ...] = ()
    logo: str = LOGO_ADDRESS
    policy: str = ""
    script: str = ""
    is_for_screens: bool = False


def compose_html(certificate: Certificate, setting: Setting = Setting()) -> str:
    """Set a certificate; the result starts with a document type and parses as XML."""
    own = certificate.look.templates
    cover, *sections = (
        [(each.block, render(_make_context(each, certificate, setting), own)) for each in blocks]
        for blocks in columns.number_blocks(certificate)
    )
    linked = certificate.linked if setting.script else None
    context = DocumentContext(
        certificate,
        style=Markup(setting.style),  # noqa: S704 (the renderer's own style sheets)
        policy=setting.policy,
        script=Markup(setting.script),  # noqa: S704 (the renderer's own script)
        letterhead=_set_letterhead(certificate, setting),
        cover=tuple(markup for _, markup in cover),
        sections=tuple(
            _set_section(number, section, ending, blocks, linked, own)
            for number, (section, ending, blocks) in enumerate(
                zip(certificate.sections, find_endings(certificate), sections, strict=True), start=1
            )
        ),
    )
    return render(context)


def _set_letterhead(certificate: Certificate, setting: Setting) -> Markup:
    letterhead = certificate.printed_letterhead
    if letterhead is None:
        return Markup()
    logo = setting.logo if letterhead.logo else ""
    return render(LetterheadContext(letterhead, logo), certificate.look.templates)


def _set_section(  # noqa: PLR0913, PLR0917 - what a section is set from
    number: int,
    section: Section,
    ending: Ending,
    blocks: list[tuple[GatheredBlock, Markup]],
    linked: Linked | None,
    own: tuple[OwnTemplate, ...],
) -> Markup:
    """Set a section, the linked graphs before the first that cannot be pointed at."""
    markup = [each for _, each in blocks]
    if linked and linked.section == section.key:
        first = next(at for at, (block, _) in enumerate(blocks) if isinstance(block, Graph))
        markup.insert(first, render(LinkedContext(write_linked_values(linked))))
    is_whole = is_all_of(section, ending)
    context = SectionContext(
        section.key,
        number,
        section.title,
        section.new_page,
        tuple(markup),
        is_whole,
        ending.is_joined,
        0 if is_whole else ending.kept,
    )
    return render(context, own)


def _make_context(numbered: NumberedBlock, certificate: Certificate, setting: Setting) -> Context:
    label = numbered.label
    match numbered.block:
        case Table() as table:
            return _make_table_context(table, label, certificate, is_for_screens=setting.is_for_screens)
        case Formulas() as formulas:
            return _make_formulas_context(formulas, label, certificate)
        case Graph(figure):
            number = numbered.number - 1
            return GraphContext(
                label=label,
                caption=set_text_with_symbols(figure.title.in_language(certificate.language), figure.symbols),
                alternative=figure.alternative.in_language(certificate.language),
                address=GRAPH_ADDRESS.format(number),
                drawing=Markup(setting.drawings[number]) if setting.drawings else Markup(),  # noqa: S704 (the drawer's own)
            )
        case Paragraph(text, fine=fine, verdict=verdict, symbols=symbols):
            shape = _name_shape(verdict) if verdict else ""
            return ParagraphContext(
                set_text_with_symbols(text, symbols), fine, shape, verdict.word if verdict else ""
            )
        case Notice(heading, items, is_quoted, symbols):
            return NoticeContext(
                heading, tuple(set_text_with_symbols(each, symbols) for each in items), is_quoted
            )
        case facts:
            return FactsContext(columns.balance_facts(facts))


def _name_shape(verdict: Verdict) -> str:
    """Return the class name of a verdict's shape."""
    return verdict.mark.value.replace(" ", "-")


_ALIGNMENT = {Align.LEFT: "", Align.RIGHT: "right", Align.CENTRE: "centre"}


def _make_table_context(
    table: Table, label: str, certificate: Certificate, *, is_for_screens: bool
) -> TableContext:
    layout = columns.lay_out_table(table, is_compact=certificate.is_compact)
    styles = tuple(
        "apart" if apart else _ALIGNMENT[column.align]
        for column, apart in zip(table.columns, layout.apart, strict=True)
    )
    padding = iter(columns.pad_decimals(table))
    return TableContext(
        label=label,
        caption=set_text_with_symbols(table.caption, table.symbols),
        size=layout.size,
        whole=layout.is_whole,
        in_fives=layout.in_fives,
        widths=_write_per_cent(layout.widths),
        headings=tuple(
            CellContext(write_cell_text(column.heading, set_symbol), style, column.unit)
            for column, style in zip(table.columns, styles, strict=True)
        ),
        is_for_screens=is_for_screens,
        labels=_list_labels(table) if is_for_screens else (),
        groups=tuple(
            RowGroupContext(
                heading=group.heading,
                note=group.note,
                section=group.section,
                rows=tuple(
                    tuple(map(_make_cell_context, row, styles, next(padding), repeat(table.symbols)))
                    for row in group.rows
                ),
            )
            for group in table.groups
        ),
        page=certificate.page_words.page,
    )


def _make_formulas_context(formulas: Formulas, label: str, certificate: Certificate) -> FormulasContext:
    layout = columns.lay_out_table(formulas, is_compact=certificate.is_compact)
    return FormulasContext(
        label=label,
        caption=formulas.caption,
        whole=layout.is_whole,
        widths=_write_per_cent(layout.widths),
        rows=tuple(
            (set_symbol(letter.notation), set_symbol(formula.notation), name)
            for letter, formula, name in formulas.rows
        ),
    )


def _list_labels(table: Table) -> tuple[str, ...]:
    """Return what stands above the cells of a table of words; nothing of one of numbers: it is scrolled."""
    if table.columns[0].align is Align.RIGHT:
        return ()
    return tuple(
        f"{write_cell_text(each.heading)} ({each.unit})" if each.unit else write_cell_text(each.heading)
        for each in table.columns
    )


def _write_per_cent(widths: Iterable[float]) -> tuple[str, ...]:
    return tuple(f"{width:.2f}" for width in widths)


def _make_cell_context(cell: Cell, style: str, padding: str, symbols: tuple[str, ...]) -> CellContext:
    if isinstance(cell, Verdict):
        return CellContext(cell.word, f"verdict {_name_shape(cell)} {style}".strip())
    if isinstance(cell, str) and symbols:
        return CellContext(set_text_with_symbols(cell, symbols), f"{style} {padding}".strip())
    note = cell.meaning if isinstance(cell, Explained) else ""
    return CellContext(write_cell_text(cell, set_symbol), f"{style} {padding}".strip(), note=note)
