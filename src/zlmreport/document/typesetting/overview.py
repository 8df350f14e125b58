"""What the templates of a fleet's overview are given, and its style sheet and script."""

from __future__ import annotations

import zlib
from base64 import b64encode
from collections.abc import Iterable
from dataclasses import dataclass
from importlib.resources import files

from markupsafe import Markup

from zlmreport.document.typesetting.resources import (
    PACKAGE,
    FontFace,
    read_font,
    style_sheet,
    write_font_faces,
)
from zlmreport.document.typesetting.templates import Context


def make_drawing(image: str) -> Markup:
    """Return a graph of our own as markup.

    `image`: As `zlmreport.document.figures.canvas.SvgCanvas` writes it, which escapes all text.
    """
    return Markup(image.strip())  # noqa: S704 (the canvas has escaped every text)


def make_overview_style() -> Markup:
    """Return the style sheet of an overview, the typeface in it."""
    return Markup(f"{write_font_faces(_embed_face)}\n{style_sheet('tokens', 'overview')}")  # noqa: S704 (our own style sheets)


def read_overview_script() -> Markup:
    """Return the script by which a reader searches an overview; it is well-formed in XML, too."""
    text = (files(PACKAGE) / "scripts" / "overview.js").read_text("utf-8")
    return Markup(f"//<![CDATA[\n{text}//]]>\n")  # noqa: S704 (our own script)


def _embed_face(face: FontFace) -> str:
    return f"data:font/woff2;base64,{b64encode(read_font(f'{face.stem}.woff2')).decode('ascii')}"


def pack(markup: Iterable[str]) -> str:
    """Return markup as the script of an overview unpacks it: deflated, in base64."""
    return b64encode(zlib.compress("".join(markup).encode(), zlib.Z_BEST_COMPRESSION)).decode("ascii")


_NO_DRAWING = Markup()


@dataclass(frozen=True, slots=True)
class LinkContext:
    """A link: its text, what it leads to for those who hear the text alone, and the address."""

    text: str
    name: str
    address: str


@dataclass(frozen=True, slots=True)
class OverviewCellContext:
    """A cell or heading of a table of the overview."""

    content: str = ""  #: Text, or a symbol that is set already.
    style: str = ""  #: Class names: alignment, or the shape of a state.
    note: str = ""  #: Below the content, in small type; empty for most.
    links: tuple[LinkContext, ...] = ()  #: Below the content.
    drawing: Markup = _NO_DRAWING  #: A small graph in place of text; empty for most.
    #: address and title: Where a click on the graph leads, and what a pointer on it says; empty for most.
    address: str = ""
    title: str = ""
    packed: str = ""  #: Number of the trend whose graph the script puts here; empty for most.


@dataclass(frozen=True, slots=True)
class OverviewGroupContext:
    """Rows that share their first cell."""

    head: OverviewCellContext
    rows: tuple[tuple[OverviewCellContext, ...], ...]


@dataclass(frozen=True, slots=True)
class OverviewTableContext(Context):
    """A table of the overview."""

    template = "overview_table.html"
    key: str  #: Its anchor.
    style: str  #: Class name of its columns.
    title: str  #: Its heading.
    count: str  #: Number after the heading; empty for none.
    caption: str  #: What it shows.
    headings: tuple[OverviewCellContext, ...]  #: One for each column.
    groups: tuple[OverviewGroupContext, ...]  #: The rows.


@dataclass(frozen=True, slots=True)
class OverviewRowContext:
    """A parameter of an axis: its cells, before them the axis."""

    #: The axis, which of several rows of one only the first names; over how many rows it stands; and by what
    #: a reader chooses and orders it.
    head: OverviewCellContext | None
    rows: int
    facts: tuple[tuple[str, str], ...]
    cells: tuple[OverviewCellContext, ...]


@dataclass(frozen=True, slots=True)
class OverviewMachineContext:
    """A machine: its name, what is said of it, and its parameters."""

    name: str
    note: str
    rows: tuple[OverviewRowContext, ...]


@dataclass(frozen=True, slots=True)
class OverviewMachinesContext(Context):
    """Every machine with its axes."""

    template = "overview_machines.html"
    title: str
    count: str  #: Of axes.
    caption: str
    headings: tuple[str, ...]  #: One for each column, that of the axis first.
    machines: tuple[OverviewMachineContext, ...]


@dataclass(frozen=True, slots=True)
class OverviewTrendContext(Context):
    """A parameter over the years: it is shown when its small graph is chosen."""

    template = "overview_trend.html"
    key: str  #: Its anchor.
    title: str
    subtitle: str
    close: str  #: Text of what leads back.
    drawing: Markup
    facts: tuple[tuple[str, str], ...]  #: Name and value of what the tests say of change and drift.
    tables: tuple[Markup, ...]


@dataclass(frozen=True, slots=True)
class OverviewPackedContext(Context):
    """A small graph with the trend behind it, before both are packed."""

    template = "overview_packed.html"
    course: OverviewCellContext
    trend: Markup


@dataclass(frozen=True, slots=True)
class PackContext:
    """Trends that the script unpacks when one of them is looked at: number of the first, and all of them."""

    first: str
    content: str


@dataclass(frozen=True, slots=True)
class TileContext:
    """A number of the headline: what it counts, its style, and the anchor of the table that lists it."""

    number: str
    label: str
    style: str
    anchor: str


@dataclass(frozen=True, slots=True)
class OverviewSectionContext(Context):
    """A section of the overview: its anchor and title, a lead below it, and its tables as markup."""

    template = "overview_section.html"
    key: str
    title: str
    lead: str
    lead_style: str
    blocks: tuple[Markup, ...]


@dataclass(frozen=True, slots=True)
class OverviewSearchContext(Context):
    """The search in all tables, above them."""

    template = "overview_search.html"
    #: search and example: Label of the field, and what may stand in it.
    search: str
    example: str
    found: str  #: How many axes are shown: ``{shown}`` of ``{all}``.


@dataclass(frozen=True, slots=True)
class OverviewChoicesContext(Context):
    """Choices and order of the axes, above their table."""

    template = "overview_choices.html"
    #: Name, label, and the options of each list: what an option stands for, and its text.
    choices: tuple[tuple[str, str, tuple[tuple[str, str], ...]], ...]


@dataclass(frozen=True, slots=True)
class OverviewLegendContext(Context):
    """How to read a small graph: the graph, what each line of it is, and what the tests mean."""

    template = "overview_legend.html"
    drawing: Markup
    terms: tuple[tuple[str, str], ...]
    paragraphs: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class OverviewContext(Context):
    """The overview of a fleet: head, headline, tiles, sections, trends."""

    template = "overview.html"
    language: str  #: ISO 639-1 code.
    #: title and subtitle: At the head.
    title: str
    subtitle: str
    generator: str  #: The program with its version.
    #: style, script and policy: Style sheets, the script, and the fingerprint by which the page allows it and
    #: no other.
    style: Markup
    script: Markup
    policy: str
    facts: tuple[tuple[str, str], ...]  #: Name and value of what is said of the last night.
    tiles: tuple[TileContext, ...]  #: The numbers of the headline.
    tiles_title: str  #: Name of the headline, for those who cannot see it.
    search: tuple[Markup, ...]  #: None where there is nothing to be searched.
    sections: tuple[Markup, ...]  #: Markup, in this order.
    trends: tuple[Markup, ...]  #: Trends in full.
    packs: tuple[PackContext, ...]  #: And those that nobody may ever look at, by their numbers.
