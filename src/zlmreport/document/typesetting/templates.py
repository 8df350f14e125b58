"""What each template is given, one dataclass a template (a test compares the two), and the Jinja environment.

Every value is escaped, and a missing one is an error; templates of a laboratory's own run in a sandbox.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass, fields
from functools import lru_cache
from html import unescape
from math import inf
from typing import ClassVar

from jinja2 import ChoiceLoader, Environment, FunctionLoader, PackageLoader, PrefixLoader
from markupsafe import Markup

from zlmreport.document.blocks import Facts, Symbol, split_at_symbols
from zlmreport.document.certificate.document import Certificate, Letterhead, OwnTemplate
from zlmreport.document.figures.canvas import TypeFace
from zlmreport.document.figures.metrics import measure_advance
from zlmreport.document.typesetting.own_templates import (
    BoundedEnvironment,
    LackingValue,
    demand_xhtml,
    render_own,
)
from zlmreport.document.typesetting.resources import PACKAGE
from zlmreport.errors import InputError, Place
from zlmreport.language.formatting import HELD, WORD_JOINER, Span, hold_together, split_spans


@dataclass(frozen=True, slots=True)
class Context:
    """What a template is rendered with."""

    template: ClassVar[str]  #: Its name.


@dataclass(frozen=True, slots=True)
class CellContext:
    """A table's cell or heading."""

    content: str  #: Text, or a symbol that is set already.
    style: str  #: Class names: alignment, distance from the decimal sign, shape of a verdict.
    unit: str = ""  #: Below a heading; empty elsewhere.
    note: str = ""  #: Below the content, in small type; empty for most.


@dataclass(frozen=True, slots=True)
class SymbolContext(Context):
    """A symbol or formula, each stretch with its way of being set."""

    template = "symbol.html"
    spans: tuple[Span, ...]


@dataclass(frozen=True, slots=True)
class RowGroupContext:
    """Rows under a heading of their own, which may lead to a section; no heading for plain rows."""

    heading: str
    note: str
    section: str
    rows: tuple[tuple[CellContext, ...], ...]


@dataclass(frozen=True, slots=True)
class TableContext(Context):
    """A table."""

    template = "table.html"
    label: str  #: ``Table 2``.
    caption: Markup  #: What it shows.
    size: str  #: Class name of its type size.
    whole: bool  #: Whether it is short enough to stay on one page.
    in_fives: bool  #: Whether its rows are read in fives.
    widths: tuple[str, ...]  #: Of the columns, in per cent of the page's.
    headings: tuple[CellContext, ...]  #: One for each column.
    groups: tuple[RowGroupContext, ...]  #: The rows.
    page: str  #: Word before the number of a page that the table refers to.
    is_for_screens: bool = False  #: Whether keys can scroll it.
    #: What stands above each column, for a screen on which the cells of a row stand below each other; empty
    #: where they never do.
    labels: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class FormulasContext(Context):
    """Definitions: symbol and formula, set already, and name of each; the rest as in a table."""

    template = "formulas.html"
    label: str
    caption: str
    whole: bool
    widths: tuple[str, ...]
    rows: tuple[tuple[Markup, Markup, str], ...]


@dataclass(frozen=True, slots=True)
class FactsContext(Context):
    """Groups of names and values, in one column or two."""

    template = "facts.html"
    columns: tuple[tuple[Facts, ...], ...]

    @property
    def room(self) -> float:
        """Em of a value."""
        return _VALUE_EM[len(self.columns) > 1]


@dataclass(frozen=True, slots=True)
class ParagraphContext(Context):
    """A paragraph of running text, which a verdict may begin."""

    template = "paragraph.html"
    text: Markup
    fine: bool  #: Whether it is in small type.
    shape: str  #: Class name of the verdict's shape; empty without one.
    word: str  #: The verdict's word; empty without one.


@dataclass(frozen=True, slots=True)
class NoticeContext(Context):
    """A statement that nobody may overlook, or words of somebody else."""

    template = "notice.html"
    heading: str
    items: tuple[Markup, ...]
    is_quoted: bool


@dataclass(frozen=True, slots=True)
class GraphContext(Context):
    """A graph with its caption."""

    template = "graph.html"
    label: str  #: ``Figure 3``.
    caption: Markup  #: Its title.
    alternative: str  #: What it shows, for those who cannot see it.
    address: str  #: Where the renderer finds the drawing: ``graph:2``.
    drawing: Markup  #: The drawing itself as markup; empty where it stands at its address.


@dataclass(frozen=True, slots=True)
class SectionContext(Context):
    """A section: its anchor, number, title, and its blocks as markup.

    `is_whole`: Whether no page parts it; `is_joined`: Whether it stays with what ends before it; `kept`: How
    many of its last blocks no page parts, where that is not all of it.
    """

    template = "section.html"
    key: str
    number: int
    title: str
    new_page: bool
    blocks: tuple[Markup, ...]
    is_whole: bool = False
    is_joined: bool = False
    kept: int = 0


@dataclass(frozen=True, slots=True)
class LinkedContext(Context):
    """The place of the linked graphs, which a script fills; `values` is what they show, as JSON."""

    template = "linked.html"
    values: Markup


@dataclass(frozen=True, slots=True)
class LetterheadContext(Context):
    """Who issues the document; `logo` is the address of the logo, empty without one."""

    template = "letterhead.html"
    letterhead: Letterhead
    logo: str


@dataclass(frozen=True, slots=True)
class DocumentContext(Context):
    """The document: head with metadata and style, title, cover, sections, texts for the page margins."""

    template = "document.html"
    #: What stands beside its blocks: titles, words of the page margins, metadata of the file.
    certificate: Certificate
    style: Markup  #: Style sheets in the document's head; empty where the renderer hands them over otherwise.
    #: policy and script: The only script and the content security policy that names it; empty where nothing
    #: is run.
    policy: str
    script: Markup
    #: letterhead, cover and sections: Markup, in this order.
    letterhead: Markup
    cover: tuple[Markup, ...]
    sections: tuple[Markup, ...]


@dataclass(frozen=True, slots=True)
class WorkbenchContext(Context):
    """The page of the workbench, which its scripts fill: language, title, and what it says without them."""

    template = "workbench.html"
    language: str
    title: str
    needs_script: str


#: Characters that XML 1.0 has no place for, not even escaped.
_NOT_IN_XML = re.compile(r"[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
_REPLACEMENT = "\N{REPLACEMENT CHARACTER}"


#: What stands before the name of a template in its usual form, for one that adds to it.
_USUAL = "usual"
_WORDS = re.compile(r"[+−-]?\w+(?:[.,]\w+)*")
_PICTURES = re.compile(r"<(?:img|svg)\b")


def _hold_together(value: object) -> object:
    """Hold together what belongs together in a text; markup and what was escaped are left as they are."""
    return hold_together(value) if type(value) is str else value


@lru_cache(maxsize=8)
def make_environment(own: tuple[OwnTemplate, ...] = ()) -> Environment:
    """Return the environment; templates are compiled once in a process, those of a laboratory's own first."""
    usual, house = PackageLoader(PACKAGE), {each.name: (each.text, each.path, lambda: True) for each in own}
    return (BoundedEnvironment if own else Environment)(
        loader=ChoiceLoader([FunctionLoader(house.get), usual, PrefixLoader({_USUAL: usual})])
        if own
        else usual,
        autoescape=True,
        finalize=_hold_together,
        undefined=LackingValue,
        trim_blocks=True,
        lstrip_blocks=True,
        auto_reload=False,
    )


def render(context: Context, own: tuple[OwnTemplate, ...] = ()) -> Markup:
    """Render the template that belongs to a context; characters that XML cannot hold are shown as U+FFFD.

    Raises `InputError` if a template of a laboratory's own is wrong, or leaves out a word that the usual one
    prints.
    """
    values = {field.name: getattr(context, field.name) for field in fields(context)}
    name = context.template
    text = make_environment().get_template(name).render(values)
    if house := next((each for each in own if each.name == name), None):
        usual, text = text, render_own(house, own, make_environment(own), values)
        demand_xhtml(house, _NOT_IN_XML.sub(_REPLACEMENT, text))
        if lacking := [*(_count_shown(usual) - _count_shown(text))]:
            raise InputError.at(
                Place(house.path), f"this template leaves out {' '.join(lacking[:8])}; all must be printed"
            )
    text = _set_held_words(
        _NOT_IN_XML.sub(_REPLACEMENT, text), context.room if isinstance(context, FactsContext) else inf
    )
    return Markup(text)  # noqa: S704 (the template has escaped every value)


#: Em that a value has where facts share a page's width with their names, and in one of two columns.
_VALUE_EM = (36.0, 13.5)
#: What holds no elements, and a tag; and words whose parts are joined, in the text between tags. The number
#: before a unit is of its word: a line that is broken before such a unit would end anywhere before it.
_HELD_WORDS = re.compile(
    rf"<(title|style|script|svg|a)\b.*?</\1>|<[^>]*>"
    rf"|(?:[^\s<>]|{HELD})*(?:{WORD_JOINER} ?[^\s<>{WORD_JOINER}]*)+",
    re.DOTALL,
)


def _set_held_words(markup: str, room: float) -> str:
    """Set words that no line parts as such, and take the signs out that joined their parts.

    Nothing but what is seen stands in the text then. A word that is wider than its place, of so many em, is
    set in smaller type, and parted there if it is wider yet. In a link its blanks are held: an element within
    would be a second link.
    """
    if WORD_JOINER not in markup:
        return markup

    def set_words(found: re.Match[str]) -> str:
        if WORD_JOINER not in found[0]:
            return found[0]
        is_link = found[1] == "a"
        words = found[0].replace(f"{WORD_JOINER} ", HELD if is_link else " ").replace(WORD_JOINER, "")
        if words.startswith("<"):
            return words
        smaller = " smaller" if measure_advance(unescape(words), TypeFace.REGULAR) > room else ""
        return f'<span class="held{smaller}">{words}</span>'

    return _HELD_WORDS.sub(set_words, markup)


def _count_shown(markup: str) -> Counter[str]:
    """Return the words and pictures of a block."""
    text = Markup(markup).striptags()  # noqa: S704 - it is only looked at
    return Counter([*_WORDS.findall(text), *_PICTURES.findall(markup)])


def set_text_with_symbols(text: str, notations: Iterable[str]) -> Markup:
    """Set a text, and in it as symbols those of these notations."""
    return Markup().join(
        set_symbol(part.notation) if isinstance(part, Symbol) else hold_together(part)
        for part in split_at_symbols(text, notations)
    )


@lru_cache(maxsize=1024)
def set_symbol(notation: str) -> Markup:
    """Set a symbol or a formula; the same few come again and again."""
    return render(SymbolContext(split_spans(notation)))
