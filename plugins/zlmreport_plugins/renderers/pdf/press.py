"""Prints by WeasyPrint: PDF/A and PDF/UA, colour profile, fonts, attachments, graphs as vectors.

Fonts and style sheets are shared by all documents: parsing them takes longer than setting a page, and every
new font configuration costs memory that WeasyPrint 70 never gives back.
"""

from __future__ import annotations

import atexit
import codecs
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from datetime import date, datetime, time
from functools import cache, lru_cache, partial
from importlib.resources import files
from threading import Lock
from typing import Any, TypeAlias
from unicodedata import bidirectional
from xml.etree import ElementTree as ET

import pydyf
from cssselect2 import ElementWrapper
from weasyprint import CSS, HTML, Attachment
from weasyprint.css.properties import INITIAL_VALUES
from weasyprint.draw.text import draw_first_line
from weasyprint.layout import inline
from weasyprint.matrix import Matrix
from weasyprint.text.fonts import FontConfiguration
from weasyprint.text.line_break import create_layout, split_first_line
from weasyprint.urls import URLFetcher, URLFetcherResponse

from zlmreport.plugin import Figure, Language
from zlmreport.plugin.html import GRAPH_ADDRESS, LOGO_ADDRESS, compose_html
from zlmreport.plugin.page import (
    FONT_FACES,
    Colour,
    Fill,
    FontFace,
    Segment,
    Stroke,
    TextRun,
    draw_figure,
    figure_size,
    font_face_rules,
    font_file,
    own_style,
    style_sheet,
)
from zlmreport.plugin.renderer import Certificate, Look
from zlmreport_plugins.letters import refuse_letters
from zlmreport_plugins.renderers.pdf import structure, subset
from zlmreport_plugins.renderers.pdf.ignored import refuse_ignored_rules, refuse_unfit_look

#: For archives, with its structure tagged: it costs a tenth more time than a plain one.
VARIANT = "pdf/a-3a"

_FONT_ADDRESS = "font:{}"
_PROFILE = "--srgb"
#: Bidirectional classes of letters: from left to right, and from right to left (Unicode, UAX 9).
_OF_LETTERS = {"L", "R", "AL"}


@dataclass(slots=True)
class _ColourProfile:
    """What colours are meant by, as WeasyPrint asks for it.

    Its own class packs the profile anew for each document, with other bytes from the second one on.
    """

    name: str
    content: bytes
    components: tuple[str, ...] = ("r", "g", "b")
    pdf_reference: Any = None


class Press:
    """Prints documents, one at a time."""

    def __init__(self) -> None:
        subset.settle()
        _settle_blanks()
        self._fonts = FontConfiguration()
        # It takes the fonts that it unpacked with it when it is collected; where a process ends, none is.
        atexit.register(self._fonts.__del__)
        self._lock = Lock()
        profile = (files("weasyprint.pdf") / "sRGB2014.icc").read_bytes()
        self._profiles = {_PROFILE: _ColourProfile("sRGB2014", profile)}
        faces = font_face_rules(lambda face: _FONT_ADDRESS.format(face.stem))
        supply = Supply(
            {
                _FONT_ADDRESS.format(face.stem): (font_file(f"{face.stem}.ttf"), "font/ttf")
                for face in FONT_FACES
            }
        )
        self._faces = self._parse(faces, supply)
        self._style = lru_cache(maxsize=4)(
            lambda accent, paper: self._parse(
                style_sheet("elements", "certificate", "paged", paper, accent=accent), supply
            )
        )
        self._own = lru_cache(maxsize=4)(self._read_own_look)

    def print(self, certificate: Certificate) -> bytes:
        """Return a certificate as PDF."""
        issuer, graphs = certificate.letterhead, enumerate(certificate.figures)
        logo: Contents = {LOGO_ADDRESS: (issuer.logo, issuer.logo_type)} if issuer and issuer.logo else {}
        root = ET.fromstring(compose_html(certificate))  # noqa: S314 - set here
        _set_directions(root)
        document = _Document(root, Supply(logo), has_any_element=bool(certificate.look.templates))
        with self._lock, refuse_unfit_look(certificate.look):
            pdf: bytes = document.write_pdf(
                stylesheets=[
                    self._faces,
                    self._style(certificate.look.accent, certificate.paper),
                    *self._own(certificate.look),
                ],
                font_config=self._fonts,
                color_profiles=self._profiles,
                output_intent=_PROFILE,
                cache={
                    GRAPH_ADDRESS.format(number): PageGraph(figure, certificate.language)
                    for number, figure in graphs
                },
                attachments=list(list_enclosures(certificate)),
                pdf_variant=VARIANT,
                finisher=partial(_finish, certificate),
            )
        return pdf

    def _read_own_look(self, look: Look) -> tuple[CSS, ...]:
        """Return the style sheet of a laboratory's own look, if it has one."""
        contents: Contents = {}

        def address(font: bytes) -> str:
            name = _FONT_ADDRESS.format(len(contents))
            contents[name] = font, "font/sfnt"
            return name

        style = own_style(look, address)
        with refuse_ignored_rules(look, style):
            return (self._parse(style, Supply(contents)),) if style else ()

    def _parse(self, style: str, supply: Supply) -> CSS:
        return CSS(string=style, font_config=self._fonts, url_fetcher=supply)


def _set_directions(root: ET.Element) -> None:
    """Set from right to left what asks for the direction of its first letter, where that is so written.

    WeasyPrint 70 does not know ``dir="auto"``: a number would stand apart from its unit.
    """
    for each in root.iter():
        if each.get("dir") == "auto":
            kinds = map(bidirectional, "".join(each.itertext()))
            if next((kind for kind in kinds if kind in _OF_LETTERS), "L") != "L":
                each.set("style", "direction: rtl")


@cache
def find_press() -> Press:
    """Return the press of this process."""
    return Press()


def _finish(certificate: Certificate, document: Any, pdf: Any) -> None:
    """Complete a file that is ready but for its trailer.

    Raises `InputError` if it shows boxes where letters belong, of which programs that read it make nonsense.
    """
    if not certificate.look.may_lack_letters:
        refuse_letters(
            (chr(letter) for font in document.fonts.values() for letter in font.missing),
            certificate,
            "neither the typeface of the format pdf nor one of this system has",
            "install a typeface that has it, state one (certificate.style.typeface), or write it otherwise, "
            "the name of a file, too",
        )
    if "AF" in pdf.catalog:  # WeasyPrint 70 names each attachment twice among the associated files
        pdf.catalog["AF"] = pydyf.Array(dict.fromkeys(pdf.catalog["AF"]))
        _sort_files(pdf)
    structure.identify(pdf, certificate)
    structure.mend(pdf, {section.key: section.title for section in certificate.sections})
    structure.settle(pdf)


def _sort_files(pdf: Any) -> None:
    """Put the attachments in the order of their names: a reader may look for one by halves.

    WeasyPrint 70 lists them by their names in UTF-8, which readers take for other letters.
    """
    number, *_ = pdf.catalog["Names"]["EmbeddedFiles"].split()
    listed = pdf.objects[int(number)]["Names"]
    files = [pdf.objects[int(each.split()[0])] for each in listed[1::2]]
    for each in files:
        each["F"] = each["UF"]
    names = [each["UF"].string for each in files]
    write = _write_in_utf_16 if not all(map(str.isascii, names)) else pydyf.String
    listed[:] = [
        each for name, file in sorted(zip(names, listed[1::2], strict=True)) for each in (write(name), file)
    ]


def _write_in_utf_16(name: str) -> bytes:
    """Return a name as a PDF writes letters beyond ASCII: names that all stand so have one order.

    Of some others readers compare the bytes, and some the letters.
    """
    return b"<%s>" % (codecs.BOM_UTF16_BE + name.encode("utf-16-be")).hex().encode()


class _Document(HTML):  # type: ignore[misc]
    """A document that is a tree already.

    `HTML` itself only takes text, and parses it by the rules of HTML in ten times the time. Of elements that
    only templates of a laboratory's own have, WeasyPrint's own style sheet says how they look.
    """

    def __init__(self, root: ET.Element, supply: Supply, *, has_any_element: bool = True) -> None:
        self._has_any_element = has_any_element
        self.base_url = None
        self.url_fetcher = supply
        self.media_type = "print"
        self.wrapper_element: Any = ElementWrapper.from_html_root(root, content_language=None)
        self.etree_element = self.wrapper_element.etree_element

    def _ua_stylesheets(self, forms: bool = False) -> list[CSS]:  # noqa: FBT001, FBT002 - as WeasyPrint has it
        found: list[CSS] = super()._ua_stylesheets(forms) if self._has_any_element else []
        return found


_ENCLOSURE_ADDRESS = "attachment:{}"
#: Of a document that states no date of issue: a file in a PDF must have one, and the clock is not asked.
_UNKNOWN = date(1970, 1, 1)


def list_enclosures(certificate: Certificate) -> Iterator[Attachment]:
    """Yield the attachments; each is loaded by an address, for only so WeasyPrint takes its media type."""
    moment = datetime.combine(certificate.issued or _UNKNOWN, time())
    for number, attachment in enumerate(certificate.attachments):
        address = _ENCLOSURE_ADDRESS.format(number)
        yield Attachment(
            url=address,
            url_fetcher=Supply({address: (attachment.content, attachment.media_type)}),
            name=attachment.name,
            description=attachment.description,
            created=moment,
            modified=moment,
            relationship=attachment.relationship.value,
        )


#: What there is to load: by address, bytes and media type.
Contents: TypeAlias = dict[str, tuple[bytes, str]]


class Supply(URLFetcher):  # type: ignore[misc]
    """Answers addresses from memory and refuses every other one, be it a file or a network address."""

    def __init__(self, contents: Contents) -> None:
        # The base class's own set-up is left out: it installs the openers of files and networks.
        self._contents = contents
        self._fail_on_errors = False

    def fetch(self, url: str, headers: Mapping[str, str] | None = None) -> URLFetcherResponse:
        """Return what lies at an address; WeasyPrint reports an error and goes on without it otherwise."""
        del headers
        if url not in self._contents:
            raise ValueError(f"a certificate loads nothing from outside: {url}")
        content, media_type = self._contents[url]
        return URLFetcherResponse(url, content, {"Content-Type": media_type})


#: The family under which the document's style sheet brings the bundled faces in.
FAMILY = "IBM Plex Sans"

_PIXELS_PER_POINT = 96 / 72
_FACES = {
    FontFace.REGULAR: ("normal", 400),
    FontFace.ITALIC: ("italic", 400),
    FontFace.SEMIBOLD: ("normal", 600),
}
# A hundredth of a point is 4 µm of paper.
_OPERATORS = {"M": "%.2f %.2f m", "L": "%.2f %.2f l", "C": "%.2f %.2f %.2f %.2f %.2f %.2f c", "Z": "h"}
_PAINTING = {(True, False): "S", (False, True): "f", (True, True): "B"}


class PageGraph:
    """A figure as an image of a document, drawn straight into the page.

    An image of a document is anything with `get_intrinsic_size` and `draw` in the ``cache`` mapping of
    ``write_pdf``, under the address that the document names: ``<img src="graph:0" alt="…">``. So a graph
    needs no SVG in between, its text is text of the document's own fonts, and the image's alternative text
    tags it. This leans on parts of WeasyPrint 70 that are no public interface: the page's stream, and text
    laid out by Pango. Tests hold them.
    """

    def __init__(self, figure: Figure, language: Language) -> None:
        self._figure = figure
        self._language = language

    def get_intrinsic_size(self, image_resolution: float, font_size: float) -> tuple[float, float, float]:
        """Return width and height in CSS pixels, and their ratio."""
        del image_resolution, font_size
        width, height = figure_size(self._figure)
        return width * _PIXELS_PER_POINT, height * _PIXELS_PER_POINT, width / height

    def draw(self, stream: Any, concrete_width: float, concrete_height: float, style: Any) -> None:
        """Draw the figure into the page, in the size that the document gives it."""
        width, height = figure_size(self._figure)
        stream.transform(a=concrete_width / width, d=concrete_height / height)
        draw_figure(self._figure, self._language, StreamCanvas(stream, style.font_config))


class StreamCanvas:
    """A canvas on a page's stream, whose unit is the point and whose y axis points downwards.

    `stream`: WeasyPrint's stream; its state belongs to this canvas alone.
    """

    def __init__(self, stream: Any, font_config: Any) -> None:
        self._stream = stream
        self._style = _TextStyle(INITIAL_VALUES, font_family=[FAMILY])
        self._style.font_config = font_config
        self._stroke: Stroke | None = None
        self._fill: Fill | None = None

    def outline(
        self, kind: str, segments: Sequence[Segment], stroke: Stroke | None, fill: Fill | None
    ) -> None:
        """Draw an outline."""
        del kind
        if stroke is not None:
            self._take_stroke(stroke)
        if fill is not None:
            self._take_fill(fill)
        path = [_OPERATORS[operator] % points for operator, points in segments]
        self._stream.stream.append("\n".join((*path, _PAINTING[stroke is not None, fill is not None])))

    def text(self, kind: str, runs: Sequence[TextRun], colour: Colour, angle: float) -> None:
        """Set a line of text, each run laid out by Pango as the document's own text is."""
        del kind
        self._take_fill(Fill(colour))
        cosine, sine = math.cos(math.radians(angle)), math.sin(math.radians(angle))
        self._stream.begin_marked_content("Span", _write_meant(runs))
        self._stream.begin_text()
        for run in runs:
            self._style["font_style"], self._style["font_weight"] = _FACES[run.face]
            self._style["font_size"] = run.size
            layout = create_layout(run.text, self._style, None, None, 0)
            matrix = Matrix(cosine, -sine, -sine, -cosine, run.x, run.y)
            draw_first_line(self._stream, _TextBox(layout, self._style), "none", "none", matrix)
        self._stream.end_text()
        self._stream.end_marked_content()

    def _take_stroke(self, stroke: Stroke) -> None:
        if stroke != self._stroke:
            self._stream.set_color_rgb(*stroke.colour, stroke=True)
            self._stream.set_line_width(stroke.width)
            self._stream.set_dash(stroke.dashes, 0)
            self._stroke = stroke

    def _take_fill(self, fill: Fill) -> None:
        if fill != self._fill:
            self._stream.set_color_rgb(*fill.colour)
            self._stream.set_alpha(fill.opacity)
            self._fill = fill


def _write_meant(runs: Sequence[TextRun]) -> Any:
    """Return what a symbol reads as: some readers see a space where a bar ends or an index begins."""
    return pydyf.Dictionary({"ActualText": pydyf.String("".join(run.text for run in runs))})


class _TextStyle(dict[str, Any]):
    """Computed style of a text: WeasyPrint wants a mapping with the fonts as an attribute."""

    font_config: Any


class _TextBox:
    """What WeasyPrint wants to know of a line of text."""

    def __init__(self, layout: Any, style: _TextStyle) -> None:
        self.pango_layout = layout
        self.style = style
        self.text = layout.text


#: Em that a letter of a text has at least, in the mean: a text of more letters fits into no such line.
_NARROWEST = 0.25


def _settle_blanks() -> None:
    """Make WeasyPrint leave a blank at the end of a line out of its width in this process.

    WeasyPrint 70 takes a text that fits into its line but for the blank at its end to be too long for it, and
    puts its first word alone on the line, however many more would fit.
    """
    inline.split_first_line = _split_first_line


def _split_first_line(
    text: str, style: Any, context: Any, max_width: float | None, *others: Any, **named: Any
) -> Any:
    """Return the first line of a text as WeasyPrint does: all of it if only its last blank is too much."""
    found = split_first_line(text, style, context, max_width, *others, **named)
    _, _, resume_index, *_ = found
    words = text.rstrip(" ")
    if (
        resume_index is None
        or words == text
        or max_width is None
        or len(words) * style["font_size"] * _NARROWEST > max_width
    ):
        return found
    _, _, rest, width, *_ = split_first_line(words, style, context, max_width, *others, **named)
    if rest is None and width <= max_width:
        return split_first_line(text, style, context, None, *others, **named)
    return found
