"""The certificate's content in one language, block by block; renderers give it a shape.

Every text here is data: renderers set it as it stands and interpret nothing in it. Symbols are kept apart
as `Symbol`, because they are set in italics and subscripts.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import field
from datetime import date
from enum import Enum
from typing import TYPE_CHECKING, Literal, TypeAlias

from zlmreport.values import dataclass

if TYPE_CHECKING:
    from zlmreport.certificate.attachments import Attachment, Source
    from zlmreport.certificate.linked import Linked
    from zlmreport.evaluation.evaluation import Evaluation
    from zlmreport.figures.figure import Figure
    from zlmreport.job.job import Job
    from zlmreport.language import Language, Words
    from zlmreport.measurement.measurement_set import MeasurementSet
    from zlmreport.model.diagnosis import Diagnosis
    from zlmreport.uncertainty.budget import Budget, NoBudget


@dataclass(frozen=True, slots=True)
class Symbol:
    """A standard's symbol or formula, in the notation of `zlmreport.quantities.formatting`."""

    notation: str


class Mark(Enum):
    """A sign that stands for a statement; a renderer gives it a shape and a word."""

    MET = "met"
    NOT_MET = "not met"
    OPEN = "open"


@dataclass(frozen=True, slots=True)
class Verdict:
    """A mark with its word in the document's language: ``conforms``, ``not met``, ``not stated``."""

    mark: Mark
    word: str


@dataclass(frozen=True, slots=True)
class Explained:
    """A name, and below it in small type what it means."""

    name: str
    meaning: str


#: Whatever stands in a cell of a table.
Cell: TypeAlias = str | Symbol | Verdict | Explained


class Align(Enum):
    """How a column stands: words to the left, numbers on their last digit to the right."""

    LEFT = "left"
    RIGHT = "right"
    CENTRE = "centre"


@dataclass(frozen=True, slots=True)
class Column:
    """A column of a table: its heading, unit below it, and alignment."""

    heading: Cell
    unit: str = ""
    align: Align = Align.LEFT


@dataclass(frozen=True, slots=True)
class RowGroup:
    """Rows under a heading of their own; no heading for a plain table.

    `note` stands under the heading: what the group means. `section` is the key of the section that says
    more; empty without one.
    """

    rows: tuple[tuple[Cell, ...], ...]
    heading: str = ""
    note: str = ""
    section: str = ""


@dataclass(frozen=True, slots=True)
class Table:
    """A table; `dense` asks for small type, for many columns."""

    caption: str
    columns: tuple[Column, ...]
    groups: tuple[RowGroup, ...]
    dense: bool = False


@dataclass(frozen=True, slots=True)
class Facts:
    """Pairs of a name and a value: who, what, where, when."""

    pairs: tuple[tuple[str, str], ...]
    heading: str = ""


@dataclass(frozen=True, slots=True)
class Paragraph:
    """A paragraph of running text."""

    text: str


@dataclass(frozen=True, slots=True)
class Notice:
    """A statement that nobody may overlook: a deviation from the standard, missing readings."""

    heading: str
    items: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Graph:
    """A figure in its place."""

    figure: Figure


@dataclass(frozen=True, slots=True)
class Formulas:
    """Definitions of symbols: (symbol, formula, name)."""

    caption: str
    rows: tuple[tuple[Symbol, Symbol, str], ...]


#: Whatever stands in a section of the document.
Block: TypeAlias = Table | Facts | Paragraph | Notice | Graph | Formulas


@dataclass(frozen=True, slots=True)
class Section:
    """A section: its key (an anchor, stable over languages), title, and blocks.

    `new_page` asks to begin a page.
    """

    key: str
    title: str
    blocks: tuple[Block, ...]
    new_page: bool = False


@dataclass(frozen=True, slots=True)
class Party:
    """A name and an address, line by line."""

    name: str
    lines: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Letterhead:
    """Who issues the document: the laboratory, its accreditation, its logo as bytes."""

    laboratory: Party
    accreditation: str = ""
    logo: bytes | None = None
    logo_type: str = ""


@dataclass(frozen=True, slots=True)
class PageWords:
    """The words of page margins and captions: ``page {page} of {pages}`` is split around its numbers.

    `figure` and `table` stand before the numbers that captions are given: ``Figure 1``, ``Table 2``. `head`
    stands above every page but the first in place of laboratory and subject, `foot` below the number; empty
    for none.
    """

    number: str
    page: str
    of: str
    end: str
    figure: str = ""
    table: str = ""
    head: str = ""
    foot: str = ""


@dataclass(frozen=True, slots=True)
class Typeface:
    """The fonts of a typeface, TrueType or OpenType; widths of a figure and of a decimal sign, in em."""

    regular: bytes = field(repr=False)
    semibold: bytes = field(repr=False)
    figure: float
    sign: float


@dataclass(frozen=True, slots=True)
class Look:
    """Colour of headings and lines, as ``#0d4a63``; on which side of the letterhead the logo stands.

    `typeface` is the laboratory's own, None for the bundled one; `templates` are its own ones, by name, with
    its style sheet ``style.css`` among them.
    """

    accent: str = "#0d4a63"
    logo: Literal["left", "right"] = "right"
    typeface: Typeface | None = None
    templates: tuple[tuple[str, str], ...] = ()


@dataclass(frozen=True, slots=True)
class Certificate:
    """A certificate or a measuring report, complete.

    Attributes
    ----------
    number
        Unique identification; on every page and the stem of every file.
    title, subtitle
        As printed on the cover.
    language
        Of all its text.
    issued
        Date of issue; None where the job states none.
    paper
        ``A4`` or ``Letter``.
    is_compact
        Whether it is set in smaller type, with less room between its parts.
    letterhead
        The issuing laboratory.
    cover
        The blocks of the first page under the title.
    sections
        The rest, in order.
    page_words
        Words of the page margins.
    keywords, description
        For the metadata of the file.
    measurements, evaluations, diagnosis
        What the sections were made of, for renderers of data; the diagnosis is None where the job names no
        error model.
    linked
        The readings beside the error model, one by one, for documents in which they can be pointed at; None
        without a model, or where single readings are not to be shown.
    budget
        Of the uncertainties of the evaluations, or why there is none; None where nobody asked for it.
    job
        What was asked for, for renderers of data; None where the document was made of no job.
    evaluations_as_found, budget_as_found
        Of the axis before it was adjusted, by the same standards; empty and None where it was not.
    generator
        Name and version of this program.
    plugins
        Identifier and version of every plugin that took part.
    sources
        The files that it was made from, the job first.
    attachments
        What a document that can carry files carries.
    look
        Colour, and the place of the logo.
    doubts
        Values that seem to be in another unit, in sentences; the first page has them, too.
    """

    number: str
    title: str
    subtitle: str
    language: Language
    issued: date | None
    paper: str
    letterhead: Letterhead | None
    cover: tuple[Block, ...]
    sections: tuple[Section, ...]
    page_words: PageWords
    description: str
    measurements: MeasurementSet
    evaluations: tuple[Evaluation, ...]
    generator: str
    keywords: tuple[str, ...] = ()
    plugins: Mapping[str, str] = field(default_factory=dict)
    diagnosis: Diagnosis | None = None
    linked: Linked | None = None
    evaluations_as_found: tuple[Evaluation, ...] = ()
    budget: Budget | NoBudget | None = None
    budget_as_found: Budget | NoBudget | None = None
    job: Job | None = None
    sources: tuple[Source, ...] = ()
    attachments: tuple[Attachment, ...] = ()
    is_compact: bool = False
    look: Look = Look()
    doubts: tuple[Words, ...] = ()

    @property
    def running_head(self) -> str:
        """What stands above every page but the first: words of its own, or laboratory and subject."""
        laboratory = self.letterhead.laboratory.name if self.letterhead else ""
        return self.page_words.head or " · ".join(filter(None, (laboratory, self.subtitle)))

    @property
    def figures(self) -> tuple[Figure, ...]:
        """All figures in reading order."""
        blocks = (*self.cover, *(block for section in self.sections for block in section.blocks))
        return tuple(block.figure for block in blocks if isinstance(block, Graph))
