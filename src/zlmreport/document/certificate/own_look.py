"""A laboratory's own typeface, templates and logo: read, and refused if too large or unfit for printing.

A logo is recognised by its first bytes, without being unpacked.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from io import BytesIO
from pathlib import Path
from string import ascii_letters, digits, punctuation
from typing import TYPE_CHECKING

from zlmreport.document.certificate.document import STYLE_SHEET, Look, OwnTemplate, Typeface
from zlmreport.document.figures.canvas import TypeFace
from zlmreport.document.figures.metrics import measure_advance
from zlmreport.errors import AccessError, InputError, Place, did_you_mean, quoted
from zlmreport.files import demand, say_reason
from zlmreport.measurement.provenance import SourceFile

if TYPE_CHECKING:
    from zlmreport.job.job import Job

#: What a folder of templates may hold: a template for each kind of block, and a style sheet.
TEMPLATES = (
    *(
        f"{block}.html"
        for block in ("facts", "formulas", "graph", "letterhead", "notice", "paragraph", "section", "table")
    ),
    STYLE_SHEET,
)
_LARGEST = 4 << 20
#: By which the widths of typefaces are compared, beside a figure.
_WORDS = "Unidirectional systematic positioning error, in the POSITIVE Direction: Measured by the Laboratory"
#: How far the bundled typeface rises above its line and falls below it, in em: lines of both stay as high.
_RISES, _FALLS = 1.025, 0.275
#: OS/2.fsType of a font that must not be embedded (OpenType specification).
_RESTRICTED = 0x2


def read_own_look(usual: Look, job: Job) -> Look:
    """Return the look that a job asks for: the usual one with a typeface or templates of its own.

    Raises `AccessError` if a file or the folder cannot be read; `InputError` if a file of the typeface is no
    font, lacks letters or must not be embedded; if the folder holds what is no template.
    """
    style = job.keys.certificate.style
    typeface = None
    if style.typeface:
        place = job.place_of("certificate.style.typeface")
        regular, figure, sign = _load_font(style.typeface.regular, TypeFace.REGULAR, place)
        semibold, _, _ = _load_font(style.typeface.semibold, TypeFace.SEMIBOLD, place)
        typeface = Typeface(regular, semibold, figure, sign)
    folder = style.templates
    place = job.place_of(f"certificate.style.{'templates' if folder else 'typeface'}")
    templates = _read_templates(folder, place) if folder else ()
    return replace(usual, typeface=typeface, templates=templates, place=place)


def _load_font(path: Path, face: TypeFace, place: Place) -> tuple[bytes, float, float]:
    """Return a font that takes as much room as a bundled face, and widths of a figure and a decimal sign.

    Its em is made another, so that neither its figures nor its words are wider, and its lines not higher.
    """
    from fontTools.ttLib import TTFont  # noqa: PLC0415 - of the few that need it

    content = _read_content(path, place)
    try:
        font = TTFont(BytesIO(content), recalcTimestamp=False)
        letters, metrics, rights = font.getBestCmap(), font["hmtx"].metrics, font["OS/2"].fsType
    except Exception as error:  # a foreign file may break its reader in any way
        raise InputError.at(
            place, f"{path.name} is no font; a typeface is two TrueType or OpenType files (.ttf, .otf)"
        ) from error
    lacking = [each for each in f" {ascii_letters}{digits}{punctuation}" if ord(each) not in letters]
    if lacking:
        raise InputError.at(
            place,
            f"the font {path.name} has no {' '.join(map(quoted, lacking[:10]))}; a typeface needs every "
            "letter, figure and sign of ASCII; what else it lacks is taken from the bundled one",
        )
    if rights & _RESTRICTED:
        raise InputError.at(place, f"the font {path.name} says that it must not be embedded in documents")

    def width(text: str) -> int:
        return sum(metrics[letters[ord(each)]][0] for each in text)

    font["head"].unitsPerEm = em = round(
        max(width(text) / measure_advance(text, face) for text in ("0", _WORDS))
    )
    if "CFF " in font:
        font["CFF "].cff.topDictIndex[0].FontMatrix = [1 / em, 0, 0, 1 / em, 0, 0]
    table, rises, falls = font["OS/2"], round(_RISES * em), round(_FALLS * em)
    font["hhea"].ascent = table.sTypoAscender = table.usWinAscent = rises
    font["hhea"].descent = table.sTypoDescender = -falls
    font["hhea"].lineGap, table.sTypoLineGap, table.usWinDescent = 0, 0, falls
    scaled = BytesIO()
    font.save(scaled)
    return scaled.getvalue(), width("0") / em, width(".") / em


def _read_templates(folder: Path, place: Place) -> tuple[OwnTemplate, ...]:
    try:
        names = sorted(each.name for each in folder.iterdir() if not each.name.startswith("."))
    except OSError as error:
        raise AccessError.at(place, f"the folder {folder} cannot be read: {say_reason(error)}") from error
    for name in names:
        if name not in TEMPLATES:
            told = did_you_mean(name, TEMPLATES)
            raise InputError.at(place, f"{folder.name}/{name} stands for no block of a document; {told}")
    return tuple(OwnTemplate(name, str(folder / name), _read_text(folder / name, place)) for name in names)


def _read_text(path: Path, place: Place) -> str:
    content = _read_content(path, place)
    try:
        return content.decode()
    except UnicodeDecodeError as error:
        line = content.count(b"\n", 0, error.start) + 1
        raise InputError.at(
            Place(str(path), line), f"byte {error.start + 1} is no UTF-8; save the file as UTF-8"
        ) from error


def _read_content(path: Path, place: Place) -> bytes:
    content = demand(path, _LARGEST, place)
    if len(content) > _LARGEST:
        raise InputError.at(place, f"{path.name} is larger than {_LARGEST >> 20} MiB")
    return content


_LARGEST_LOGO = 2 << 20
#: A few bytes can stand for a picture that fills the memory.
_MOST_PIXELS = 16_000_000


@dataclass(frozen=True, slots=True)
class Logo:
    """A picture as it was read, and its media type."""

    file: SourceFile
    media_type: str


def read_logo(path: Path, place: Place) -> Logo:
    """Return the logo.

    Raises `AccessError` if it cannot be read; `InputError` if it is too large, or neither PNG nor JPEG:
    formats that hold a picture and nothing else. If its colours are those of a printing press, for which an
    archived document has no meaning.
    """
    content = demand(path, _LARGEST_LOGO, place)
    if len(content) > _LARGEST_LOGO:
        raise InputError.at(
            place, f"the logo {path.name} is larger than 2 MiB; a logo of some 100 kB prints as well"
        )
    picture = describe(content)
    if picture is None:
        raise InputError.at(place, f"the logo {path.name} is neither PNG nor JPEG; save it as one of them")
    pixels = picture.width * picture.height
    if not pixels:
        raise InputError.at(place, f"the logo {path.name} is damaged; save it again")
    if pixels > _MOST_PIXELS:
        raise InputError.at(
            place,
            f"the logo {path.name} has {picture.width} by {picture.height} pixels; 2000 by 1000 are plenty",
        )
    if picture.for_printing_press:
        raise InputError.at(
            place, f"the logo {path.name} is in CMYK colours, for a printing press; save it in RGB colours"
        )
    return Logo(SourceFile.of(path, content), picture.media_type)


@dataclass(frozen=True, slots=True)
class Picture:
    """What a file says of the picture in it."""

    media_type: str  #: ``image/png`` or ``image/jpeg``.
    #: width and height: In pixels; 0 where the file does not say, and so is damaged.
    width: int = 0
    height: int = 0
    for_printing_press: bool = False  #: Whether its colours are those of inks (CMYK).


def describe(content: bytes) -> Picture | None:
    """Return what there is to say of a picture; None for what is neither PNG nor JPEG."""
    if content.startswith(b"\x89PNG\r\n\x1a\n"):
        return _read_png(content)
    if content.startswith(b"\xff\xd8\xff"):
        return _read_jpeg(content)
    return None


def _read_png(content: bytes) -> Picture:
    """Read the header (ISO/IEC 15948), which comes first and knows no inks; one without an end is damaged."""
    if content[12:16] != b"IHDR" or not _has_end(content):
        return Picture("image/png")
    return Picture("image/png", int.from_bytes(content[16:20]), int.from_bytes(content[20:24]))


def _has_end(content: bytes) -> bool:
    """Return whether the chunks of a PNG lead to its last one: length, name, data, check sum."""
    place = 8
    while (name := content[place + 4 : place + 8]) and name != b"IEND":
        place += 12 + int.from_bytes(content[place : place + 4])
    return bool(name)


def _read_jpeg(content: bytes) -> Picture:
    """Read the first header of a frame (ISO/IEC 10918-1, B.2.2): C0 to CF, but for C4, C8 and CC.

    One that does not come to its end (D9) is damaged.
    """
    place = 2 if b"\xff\xd9" in content else len(content)
    while content[place : place + 1] == b"\xff" and place + 10 <= len(content):
        marker = content[place + 1]
        if 0xC0 <= marker <= 0xCF and marker not in {0xC4, 0xC8, 0xCC}:
            height = int.from_bytes(content[place + 5 : place + 7])
            width = int.from_bytes(content[place + 7 : place + 9])
            return Picture("image/jpeg", width, height, for_printing_press=content[place + 9] == 4)
        place += 2 + int.from_bytes(content[place + 2 : place + 4])
    return Picture("image/jpeg")
