"""A certificate becomes one document of HTML that is well-formed XML as well.

So a browser reads it, and a PDF renderer parses it in a fraction of the time that HTML's own grammar takes.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from itertools import count

from markupsafe import Markup

from zlmreport.certificate import columns
from zlmreport.certificate.columns import GatheredBlock, gather_facts, side_by_side
from zlmreport.certificate.document import (
    Align,
    Block,
    Cell,
    Certificate,
    Explained,
    Formulas,
    Graph,
    Mark,
    Notice,
    Paragraph,
    Section,
    Table,
    Verdict,
)
from zlmreport.typesetting.resources import linked_values
from zlmreport.typesetting.templates import (
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
    symbol,
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


def compose(certificate: Certificate, setting: Setting = Setting()) -> str:
    """Set a certificate; the result starts with a document type and parses as XML."""
    compositor = _Compositor(certificate, setting)
    issued = certificate.issued
    letterhead = certificate.letterhead
    words = certificate.page_words
    return render(
        DocumentContext(
            language=certificate.language.value,
            is_compact=certificate.is_compact,
            title=certificate.title,
            subtitle=certificate.subtitle,
            number=certificate.number,
            author=letterhead.laboratory.name if letterhead else "",
            description=certificate.description,
            keywords=", ".join(certificate.keywords),
            generator=certificate.generator,
            issued=issued.isoformat() if issued else "",
            logo=certificate.look.logo,
            head=certificate.running_head,
            foot=words.foot,
            running_number=words.number,
            page=words.page,
            of=words.of,
            end=words.end,
            style=Markup(setting.style),  # noqa: S704 (the renderer's own style sheets)
            policy=setting.policy,
            script=Markup(setting.script),  # noqa: S704 (the renderer's own script)
            letterhead=compositor.letterhead(),
            cover=compositor.blocks(certificate.cover),
            sections=tuple(
                compositor.section(number, section)
                for number, section in enumerate(certificate.sections, start=1)
            ),
        )
    )


class _Compositor:
    """Sets the parts of one document, and counts its tables and figures."""

    def __init__(self, certificate: Certificate, setting: Setting) -> None:
        self._certificate = certificate
        self._setting = setting
        self._own = certificate.look.templates
        self._tables = count(1)
        self._figures = count(1)

    def letterhead(self) -> Markup:
        letterhead = self._certificate.letterhead
        if letterhead is None:
            return Markup()
        logo = self._setting.logo if letterhead.logo else ""
        return render(LetterheadContext(letterhead, logo), self._own)

    def section(self, number: int, section: Section) -> Markup:
        return render(
            SectionContext(
                key=section.key,
                number=number,
                title=section.title,
                new_page=section.new_page,
                blocks=self._section_blocks(section),
            ),
            self._own,
        )

    def blocks(self, blocks: Iterable[Block]) -> tuple[Markup, ...]:
        return tuple(render(self._context(block), self._own) for block in gather_facts(blocks))

    def _section_blocks(self, section: Section) -> tuple[Markup, ...]:
        """Return the blocks of a section, the linked graphs before the first that cannot be pointed at."""
        linked = self._certificate.linked
        if not self._setting.script or linked is None or linked.section != section.key:
            return self.blocks(section.blocks)
        first = next(at for at, block in enumerate(section.blocks) if isinstance(block, Graph))
        return (
            *self.blocks(section.blocks[:first]),
            render(LinkedContext(linked_values(linked))),
            *self.blocks(section.blocks[first:]),
        )

    def _context(self, block: GatheredBlock) -> Context:
        match block:
            case Table():
                page = self._certificate.page_words.page
                return table_context(
                    block, self._table_label(), page, is_for_screens=self._setting.is_for_screens
                )
            case Formulas():
                return formulas_context(block, self._table_label())
            case Graph():
                return self._graph(block)
            case Paragraph(text):
                return ParagraphContext(text)
            case Notice(heading, items):
                return NoticeContext(heading, items)
            case facts:
                return FactsContext(side_by_side(facts))

    def _graph(self, graph: Graph) -> GraphContext:
        number = next(self._figures)
        language = self._certificate.language
        drawings = self._setting.drawings
        return GraphContext(
            label=f"{self._certificate.page_words.figure} {number}".strip(),
            caption=graph.figure.title.in_language(language),
            alternative=graph.figure.alternative.in_language(language),
            address=GRAPH_ADDRESS.format(number - 1),
            drawing=Markup(drawings[number - 1]) if drawings else Markup(),  # noqa: S704 (the drawer's own)
        )

    def _table_label(self) -> str:
        return f"{self._certificate.page_words.table} {next(self._tables)}".strip()


_SHAPE = {Mark.MET: "met", Mark.NOT_MET: "not-met", Mark.OPEN: "open"}
_ALIGNMENT = {Align.LEFT: "", Align.RIGHT: "right", Align.CENTRE: "centre"}


def table_context(table: Table, label: str, page: str, *, is_for_screens: bool = False) -> TableContext:
    """Return the context of a table.

    Parameters
    ----------
    table
        The table.
    label
        Its number: ``Table 2``.
    page
        Word before the number of a page.
    is_for_screens
        Whether it says of a cell what stands above it, and can be scrolled by keys.
    """
    layout = columns.table_layout(table)
    styles = tuple(
        "apart" if apart else _ALIGNMENT[column.align]
        for column, apart in zip(table.columns, layout.apart, strict=True)
    )
    padding = iter(columns.decimal_padding(table))
    return TableContext(
        label=label,
        caption=table.caption,
        size=layout.size,
        whole=layout.is_whole,
        in_fives=layout.in_fives,
        widths=_per_cent(layout.widths),
        headings=tuple(
            CellContext(columns.text_of(column.heading, symbol), style, column.unit)
            for column, style in zip(table.columns, styles, strict=True)
        ),
        is_for_screens=is_for_screens,
        labels=_labels(table) if is_for_screens else (),
        groups=tuple(
            RowGroupContext(
                heading=group.heading,
                note=group.note,
                section=group.section,
                rows=tuple(tuple(map(_cell, row, styles, next(padding))) for row in group.rows),
            )
            for group in table.groups
        ),
        page=page,
    )


def formulas_context(formulas: Formulas, label: str) -> FormulasContext:
    """Return the context of definitions, which are set as a table without headings."""
    layout = columns.table_layout(formulas)
    return FormulasContext(
        label=label,
        caption=formulas.caption,
        whole=layout.is_whole,
        widths=_per_cent(layout.widths),
        rows=tuple(
            (symbol(letter.notation), symbol(formula.notation), name)
            for letter, formula, name in formulas.rows
        ),
    )


def _labels(table: Table) -> tuple[str, ...]:
    """Return what stands above the cells of a table of words; nothing of one of numbers: it is scrolled."""
    if table.columns[0].align is Align.RIGHT:
        return ()
    return tuple(
        f"{columns.text_of(each.heading)} ({each.unit})" if each.unit else columns.text_of(each.heading)
        for each in table.columns
    )


def _per_cent(widths: Iterable[float]) -> tuple[str, ...]:
    return tuple(f"{width:.2f}" for width in widths)


def _cell(cell: Cell, style: str, padding: str) -> CellContext:
    if isinstance(cell, Verdict):
        return CellContext(cell.word, f"verdict {_SHAPE[cell.mark]} {style}".strip())
    note = cell.meaning if isinstance(cell, Explained) else ""
    return CellContext(columns.text_of(cell, symbol), f"{style} {padding}".strip(), note=note)
