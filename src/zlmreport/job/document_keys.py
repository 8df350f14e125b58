"""Keys of a job on the document: laboratory, customer, certificate, dates, style, signature, output."""

import operator
import re
from typing import Annotated, Literal, Self, TypeAlias

from pydantic import AfterValidator, Field, field_validator, model_validator

from zlmreport.errors import quoted
from zlmreport.job.types import Date, JobPart, JobPath, Lines, NotNegative, Text, optional, take_file_stem
from zlmreport.language import Language
from zlmreport.measurement.axis import AxisKind


class Person(JobPart):
    """Somebody who answers for the certificate."""

    name: Text = Field(description="The person's name.", examples=["Erika Mustermann"])
    function: Text | None = optional("The person's function in the laboratory.", example="Head of laboratory")


class Amends(JobPart):
    """An earlier document that this one changes (ISO/IEC 17025:2017, 7.8.8)."""

    number: Text = Field(description="Number of the earlier document.", examples=["CAL-2026-0117"])
    reason: Lines = Field(
        description="Why it is changed.", examples=["The serial number of the machine was wrong."]
    )
    changes: list[Lines] = Field(
        [],
        description="What is changed, one text a change.",
        examples=[["Serial number: 4712 instead of 4711"]],
    )
    kind: Literal["amendment", "replacement"] = Field(
        "amendment",
        description="amendment: a further document beside the earlier one; replacement: a whole new one in "
        "its place.",
    )


class Location(JobPart):
    """Where the work was done."""

    kind: Literal["laboratory", "customer", "laboratory branch", "customer branch", "other"] = Field(
        description="Whose place it is."
    )
    address: Lines | None = optional(
        "Its address; without it, that of the laboratory or the customer.",
        example="Hall 3, Millway 2, 12345 Sampletown",
    )

    @model_validator(mode="after")
    def _has_an_address(self) -> Self:
        """Refuse a place whose address nothing else in the job states."""
        if self.address is None and self.kind not in {"laboratory", "customer"}:
            raise ValueError(f"a location of kind {self.kind} needs an address")
        return self


class Dates(JobPart):
    """Dates beside those of the measurement and the document."""

    received: Date | None = optional("When the item was received, if that matters for the results.")
    sampled: Date | None = optional("When the item was sampled, if that matters.")


class External(JobPart):
    """Results that an external provider supplied."""

    results: Lines = Field(description="Which results.", examples=["Temperatures of the machine's scale"])
    provider: Text = Field(description="Who supplied them.", examples=["Thermometry Ltd"])
    reference: Text | None = optional("The provider's own document.", example="Report 2026-88")
    keys: list[Text] = Field(
        [],
        description="Keys of this job that hold them: marked wherever they are printed.",
        examples=[["environment.axis_temperature"]],
    )


class OpinionKeys(JobPart):
    """An opinion or interpretation; no result."""

    statement: Lines = Field(
        description="The opinion.", examples=["The reversal error points to play in the nut."]
    )
    basis: Lines = Field(
        description="On what it rests.", examples=["The reversal value is alike at all targets."]
    )
    by: Person | None = optional("Who is authorised to state it; without it certificate.authorised_by.")


class NextDue(JobPart):
    """When the next calibration is due; only if the customer has agreed that the document says so."""

    date: Date = Field(description="The date.", examples=["2027-11-18"])
    agreed: bool = Field(default=False, description="Whether the customer has agreed; it must be true.")


class Agreement(JobPart):
    """What was agreed with the customer about the document."""

    simplified: bool = Field(
        default=False,
        description="Whether results are reported in a simplified way: the single readings are left out.",
    )
    reference: Text | None = optional("Where it was agreed.", example="Order 4711 of 2026-10-02")


#: Unique identification of a document, that also names its files.
Number = Annotated[
    Text,
    AfterValidator(take_file_stem),
    Field(json_schema_extra={"pattern": r"^[A-Za-z0-9][A-Za-z0-9._-]{0,99}$"}),
]


class OwnText(JobPart):
    """A section with words of the laboratory's own; ``{certificate.number}`` stands for that key's value."""

    title: Text = Field(description="Its heading.", examples=["About this laboratory"])
    text: Lines = Field(
        description="Its text, a paragraph a line; a key of the job in braces stands for its value.",
        examples=["Certificate {certificate.number} was made for {customer.name}."],
    )


#: Sections of a document by what stands in them; a layout has those that it needs.
SectionName = Literal[
    "results", "conditions", "definitions", "uncertainty", "readings", "origin", "opinions", "model"
]
#: What a document has after its first page.
Sections: TypeAlias = list[SectionName | OwnText] | None
_COLOUR = re.compile(r"#[0-9a-fA-F]{6}")
#: Colour of headings and lines where a job states none; the style sheets have it, too.
ACCENT = "#0d4a63"
#: Of text on white (WCAG 2.2, 1.4.3).
_LEAST_CONTRAST = 4.5


def _require_readable(colour: str) -> str:
    if not _COLOUR.fullmatch(colour):
        raise ValueError(f"{quoted(colour)} is no colour; write red, green and blue as in {ACCENT}")
    parts = (int(colour[at : at + 2], 16) / 255 for at in (1, 3, 5))
    linear = (each / 12.92 if each <= 0.04045 else ((each + 0.055) / 1.055) ** 2.4 for each in parts)
    luminance = sum(map(operator.mul, (0.2126, 0.7152, 0.0722), linear))
    contrast = 1.05 / (luminance + 0.05)
    if contrast < _LEAST_CONTRAST:
        raise ValueError(
            f"{colour} is too light for headings on white: its contrast is {contrast:.1f}, "
            f"and {_LEAST_CONTRAST} is the least"
        )
    return colour.lower()


class TypefaceKeys(JobPart):
    """The fonts of a laboratory's own typeface."""

    regular: JobPath = Field(description="Font of the text: TrueType or OpenType.", examples=["House.ttf"])
    semibold: JobPath = Field(description="Font of headings.", examples=["House-Bold.ttf"])


class Style(JobPart):
    """The look of the document."""

    accent: Annotated[str, AfterValidator(_require_readable)] = Field(
        ACCENT,
        json_schema_extra={"pattern": "^#[0-9A-Fa-f]{6}$"},
        description="Colour of headings and of the lines that part them.",
        examples=["#5c1a33"],
    )
    logo: Literal["left", "right"] = Field(
        "right", description="Side of the letterhead on which the logo stands."
    )
    header: Text | None = optional(
        "What stands at the head of every page but the first, in place of laboratory and "
        "subject; a key of the job in braces stands for its value.",
        example="{laboratory.name} · {machine.serial}",
    )
    footer: Text | None = optional(
        "A line below the number at the foot of every page; a key of the job in braces stands for its value.",
        example="Order 4711 · {customer.name}",
    )
    typeface: TypefaceKeys | None = optional(
        "The laboratory's own typeface, for `pdf` and `html`; symbols, graphs and letters that "
        "it lacks are set in the bundled one."
    )
    templates: JobPath | None = optional(
        "A folder with templates of the laboratory's own for single blocks, and a style sheet "
        "`style.css`, for `pdf` and `html`.",
        example="templates",
    )


class SignatureKeys(JobPart):
    """How a PDF is signed, where it is."""

    timestamp: Annotated[str, Field(pattern=r"^https?://\S+$")] = Field(
        description="Address of a service of time stamps (RFC 3161). What tells of revocations is kept, "
        "too, so that the signature can be checked without a network, and after they have expired.",
        examples=["http://timestamp.example.org"],
    )


class CertificateKeys(JobPart):
    """The document."""

    number: Number = Field(
        description="Unique identification of the document; also the stem of the output files.",
        examples=["CAL-2026-0117"],
    )
    kind: Literal["certificate", "report"] = Field(
        "certificate",
        description="A calibration certificate after ISO/IEC 17025:2017 clause 7.8, or a measuring report.",
    )
    title: Text | None = optional("Title on the cover, instead of the usual one.")
    issued: Date | None = optional("Date of issue.", example="2026-11-20")
    language: Language = Field(Language.ENGLISH, description="Language of the document.")
    authorised_by: Person | None = optional("Who authorises the document.")
    signature: SignatureKeys | None = optional("How the PDF is signed, where it is.")
    amends: Amends | None = optional(
        "The earlier document that this one amends or replaces.",
        example={"number": "CAL-2026-0117", "reason": "The serial number of the machine was wrong."},
    )
    layout: Literal["sheet", "standard", "full"] = Field(
        "standard",
        description="How much room the document takes: `sheet` has one page for each standard, and one of "
        "details for what they do not hold; `standard` has a page or so for each, and says once for all what "
        "they share; `full` has a chapter for each.",
    )
    paper: Literal["A4", "Letter"] = Field("A4", description="Paper size.")
    readings_on_graphs: bool = Field(
        default=True, description="Whether the graphs show all single readings behind the means."
    )
    style: Style = Field(default_factory=Style, description="The look of the document.")
    sections: Sections = optional(
        "What the document has after its first page, in this order: names of sections, and texts "
        "of one's own; all in the usual order without it. `results` must be there.",
        example=["results", "uncertainty", "conditions", {"title": "Note", "text": "Valid with its annex."}],
        json_schema_extra={"uniqueItems": True, "contains": {"const": "results"}},
    )

    @field_validator("sections")
    @classmethod
    def _has_each_section_once(cls, sections: Sections) -> Sections:
        named = [each for each in sections or () if isinstance(each, str)]
        twice = sorted({each for each in named if named.count(each) > 1})
        if twice:
            raise ValueError(f"sections stand more than once: {', '.join(twice)}")
        if sections is not None and "results" not in named:
            raise ValueError("a document has its results; add results to the list")
        return sections

    @model_validator(mode="after")
    def _arranges_what_has_sections(self) -> Self:
        if self.layout == "sheet" and self.sections is not None:
            raise ValueError(
                "a sheet has a page for each standard and no sections; choose layout: standard, or full"
            )
        return self


class Capability(JobPart):
    """The smallest uncertainty that the laboratory's accreditation lets it state (CMC), with k = 2."""

    constant: NotNegative = Field(
        0.0, description="Micrometres; of angles and rotary axes arc seconds.", examples=[0.3]
    )
    per_metre: NotNegative = Field(
        0.0,
        description="What it gains with each metre of measured length, micrometres/m (arc seconds/m): a "
        "capability that states it is for linear axes.",
        examples=[0.5],
    )
    length: Annotated[float, Field(gt=0)] | None = optional(
        "Longest measured length of the accredited scope, mm (degrees): results beyond it are marked.",
        example=2000,
    )
    kind: AxisKind | None = optional("Kind of axes of the accredited scope: results of others are marked.")
    quantity: Literal["positioning", "straightness", "angle", "circle"] = Field(
        "positioning",
        description="What the capability is for: U of others is not raised to it, and their results "
        "are marked.",
    )
    standards: list[Text] | None = optional(
        "Standards of the accredited scope, by their identifiers: results by others are marked.",
        example=["iso230-2:2014"],
    )

    @model_validator(mode="after")
    def _grows_with_a_length(self) -> Self:
        if self.kind is AxisKind.ROTARY and self.per_metre:
            raise ValueError("per_metre belongs to linear axes: a rotary one has no metres; take it out")
        return self

    @property
    def axes(self) -> AxisKind | None:
        """The kind of axes that it is for; None for any. What grows with each metre is of linear ones."""
        return self.kind or (AxisKind.LINEAR if self.per_metre else None)

    def is_for(self, quantity: str, kind: AxisKind) -> bool:
        """Return whether its numbers are of a quantity on a kind of axis, and so in its unit."""
        return quantity == self.quantity and self.axes in (None, kind)


class Laboratory(JobPart):
    """Who issues the document."""

    name: Text = Field(description="Name of the laboratory.", examples=["Calibration Laboratory North"])
    address: Lines | None = optional(
        "Postal address; commas or line breaks part its lines.", example="Gaugeway 1, 12345 Sampletown"
    )
    country: Annotated[str, Field(pattern=r"^[A-Z]{2}$")] | None = optional(
        "Country by its two letters (ISO 3166-1), for the digital calibration certificate.", example="DE"
    )
    accreditation: Text | None = optional("Accreditation body and number.")
    cmc: Capability | None = optional(
        "Calibration and measurement capability: a smaller U is raised to it, and says so.",
        example={"constant": 0.3, "per_metre": 0.5},
    )
    logo: JobPath | None = optional("PNG or JPEG file beside the file that names it.", example="logo.png")


class Customer(JobPart):
    """For whom the work was done."""

    name: Text = Field(description="Name of the customer.", examples=["Precision Parts Ltd"])
    address: Lines | None = optional(
        "Postal address; commas or line breaks part its lines.", example="Millway 2, 12345 Sampletown"
    )


class Output(JobPart):
    """What is written, and where."""

    directory: JobPath | None = optional(
        "Folder of the output files; the job's own folder without it.", example="out"
    )
    formats: list[Text] = Field(
        default_factory=lambda: ["pdf", "json"],
        min_length=1,
        description="Identifiers of installed renderers.",
        examples=[["pdf", "json"]],
    )
