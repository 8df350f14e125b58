"""A laboratory's own look: its typeface and its templates, read and checked before anything is printed."""

from __future__ import annotations

from io import BytesIO
from pathlib import Path
from string import ascii_letters, digits, punctuation
from typing import TYPE_CHECKING

from zlmreport.certificate.document import Look, Typeface
from zlmreport.errors import AccessError, InputError, Place, did_you_mean, quoted
from zlmreport.figures.canvas import Face
from zlmreport.figures.metrics import advance
from zlmreport.files import read, reason

if TYPE_CHECKING:
    from zlmreport.job.job import Job

#: What a folder of templates may hold: a template for each kind of block, and a style sheet.
STYLE_SHEET = "style.css"
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


def read_look(job: Job) -> Look:
    """Return the look that a job asks for.

    Raises `AccessError` if a file or the folder cannot be read; `InputError` if a file of the typeface is no
    font, lacks letters or must not be embedded; if the folder holds what is no template.
    """
    style = job.keys.certificate.style
    typeface = None
    if style.typeface:
        place = job.place_of("certificate.style.typeface")
        regular, figure, sign = _font(style.typeface.regular, Face.REGULAR, place)
        semibold, _, _ = _font(style.typeface.semibold, Face.SEMIBOLD, place)
        typeface = Typeface(regular, semibold, figure, sign)
    folder = style.templates
    templates = _templates(folder, job.place_of("certificate.style.templates")) if folder else ()
    return Look(style.accent, style.logo, typeface, templates)


def _font(path: Path, face: Face, place: Place) -> tuple[bytes, float, float]:
    """Return a font that takes as much room as a bundled face, and widths of a figure and a decimal sign.

    Its em is made another, so that neither its figures nor its words are wider, and its lines not higher.
    """
    from fontTools.ttLib import TTFont  # noqa: PLC0415 - of the few that need it

    content = _content(path, place)
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

    font["head"].unitsPerEm = em = round(max(width(text) / advance(text, face) for text in ("0", _WORDS)))
    if "CFF " in font:
        font["CFF "].cff.topDictIndex[0].FontMatrix = [1 / em, 0, 0, 1 / em, 0, 0]
    table, rises, falls = font["OS/2"], round(_RISES * em), round(_FALLS * em)
    font["hhea"].ascent = table.sTypoAscender = table.usWinAscent = rises
    font["hhea"].descent = table.sTypoDescender = -falls
    font["hhea"].lineGap, table.sTypoLineGap, table.usWinDescent = 0, 0, falls
    scaled = BytesIO()
    font.save(scaled)
    return scaled.getvalue(), width("0") / em, width(".") / em


def _templates(folder: Path, place: Place) -> tuple[tuple[str, str], ...]:
    try:
        names = sorted(each.name for each in folder.iterdir() if not each.name.startswith("."))
    except OSError as error:
        raise AccessError.at(place, f"the folder {folder} cannot be read: {reason(error)}") from error
    for name in names:
        if name not in TEMPLATES:
            told = did_you_mean(name, TEMPLATES)
            raise InputError.at(place, f"{folder.name}/{name} stands for no block of a document; {told}")
    try:
        return tuple((name, _content(folder / name, place).decode()) for name in names)
    except UnicodeDecodeError as error:
        raise InputError.at(place, f"a template of {folder.name} is no UTF-8") from error


def _content(path: Path, place: Place) -> bytes:
    try:
        content = read(path, _LARGEST)
    except OSError as error:
        raise AccessError.at(place, f"{path} cannot be read: {reason(error)}") from error
    if len(content) > _LARGEST:
        raise InputError.at(place, f"{path.name} is larger than {_LARGEST >> 20} MiB")
    return content
