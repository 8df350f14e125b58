"""The certificate as data: head, letterhead, words of page margins (page 1 of 3), look, sections."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from datetime import date
from enum import StrEnum
from typing import TYPE_CHECKING, Any, Literal

from zlmreport.document.blocks import Block, Graph, Section
from zlmreport.errors import NOWHERE, Place
from zlmreport.job.document_keys import ACCENT
from zlmreport.language import Words

#: Name of the style sheet in a folder of templates.
STYLE_SHEET = "style.css"

if TYPE_CHECKING:
    from zlmreport.document.certificate.attachments import Attachment, Source
    from zlmreport.document.certificate.results import Tested
    from zlmreport.document.figures.figure import Figure
    from zlmreport.evaluation.evaluation import Evaluation
    from zlmreport.evaluation.uncertainty.budget import Budget, NoBudget
    from zlmreport.job.job import Job
    from zlmreport.language import Language
    from zlmreport.measurement.measurement_set import MeasurementSet
    from zlmreport.model.diagnosis.diagnosis import AxisDiagnosis


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


class Head(StrEnum):
    """How much stands above the first page of a document, and how large."""

    WHOLE = "whole"  #: Letterhead and title.
    NAME = "name"  #: Of the laboratory the name alone: address and accreditation stand elsewhere.
    SMALL = "small"  #: The same, in small type.


def shorten_letterhead(letterhead: Letterhead | None, head: Head) -> Letterhead | None:
    """Return what of a letterhead is printed."""
    if letterhead is None or head is Head.WHOLE:
        return letterhead
    return replace(letterhead, laboratory=Party(letterhead.laboratory.name), accreditation="")


_OF_PAGES = (Words("page"), Words("of"), Words("End of document"), Words("Figure"), Words("Table"))


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

    @classmethod
    def in_language(cls, language: Language, number: str, *, head: str = "", foot: str = "") -> PageWords:
        """Return the words in a language; `number` is the running title with the document's number."""
        page, of, end, figure, table = (each.in_language(language) for each in _OF_PAGES)
        return cls(number, page, of, end, figure, table, head, foot)


@dataclass(frozen=True, slots=True)
class Typeface:
    """The fonts of a typeface, TrueType or OpenType; widths of a figure and of a decimal sign, in em."""

    regular: bytes = field(repr=False)
    semibold: bytes = field(repr=False)
    figure: float
    sign: float


@dataclass(frozen=True, slots=True)
class OwnTemplate:
    """A template of a laboratory's own, or its style sheet: name, path as messages show it, text."""

    name: str
    path: str
    text: str


@dataclass(frozen=True, slots=True)
class Look:
    """Colour of headings and lines, as ``#0d4a63``; on which side of the letterhead the logo stands.

    `typeface` is the laboratory's own, None for the bundled one; `templates` are its own ones, its
    style sheet ``style.css`` among them, asked for by the key at `place`. Where it `may_lack_letters`, boxes
    stand for those that no typeface has: so a document is printed only to be compared with one that was
    issued.
    """

    accent: str = ACCENT
    logo: Literal["left", "right"] = "right"
    typeface: Typeface | None = None
    templates: tuple[OwnTemplate, ...] = ()
    place: Place = field(default=NOWHERE, compare=False)
    may_lack_letters: bool = False

    @property
    def style_sheet(self) -> OwnTemplate | None:
        """The laboratory's own."""
        return next((each for each in self.templates if each.name == STYLE_SHEET), None)


@dataclass(frozen=True, slots=True)
class Linked:
    """Two graphs of the same readings, and the model's failures that point at them; plain values only."""

    section: str  #: Key of the section that they belong to.
    texts: Mapping[str, str]  #: What they say, by name, in the document's language.
    graphs: Mapping[str, Any]  #: What both draw, in the units of the page.
    #: Where the model fails: statement, axis that shows it, readings.
    failures: tuple[Mapping[str, Any], ...]


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
    head
        How much of it stands above the first page.
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
    digest
        Of readings and results, to be held against other copies; the first page has it, too.
    evidence
        What the readings show that the job does not say, and what of calibrations is open: likewise.
    tests
        Of several measured lines that are evaluated together, each by itself; empty of most documents.
    parts
        Of one document of several measurements: what was made of each, by what it is called; empty of most.
        Readings and model are then those of the parts, and the evaluations all of theirs.
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
    diagnosis: AxisDiagnosis | None = None
    linked: Linked | None = None
    evaluations_as_found: tuple[Evaluation, ...] = ()
    budget: Budget | NoBudget | None = None
    budget_as_found: Budget | NoBudget | None = None
    job: Job | None = None
    sources: tuple[Source, ...] = ()
    attachments: tuple[Attachment, ...] = ()
    is_compact: bool = False
    head: Head = Head.WHOLE
    look: Look = Look()
    doubts: tuple[Words, ...] = ()
    digest: str = ""
    evidence: tuple[Words, ...] = ()
    tests: tuple[Tested, ...] = ()
    parts: Mapping[str, Certificate] = field(default_factory=dict)

    @property
    def printed_letterhead(self) -> Letterhead | None:
        """What of the letterhead stands above the first page."""
        return shorten_letterhead(self.letterhead, self.head)

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
