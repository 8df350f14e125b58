"""Style sheets, fonts and the files of the workbench's page, as they lie in the package of templates."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from importlib.resources import files

#: The package whose templates, styles and scripts are used, and no others.
PACKAGE = "zlmreport_templates"

#: The family under which the faces are known to style sheets.
FAMILY = "IBM Plex Sans"


@dataclass(frozen=True, slots=True)
class Face:
    """A face of the bundled typeface: the stem of its files, and what style sheets call it."""

    stem: str
    style: str
    weight: int


#: The faces of the bundled typeface.
FACES = (
    Face("IBMPlexSans-Regular", "normal", 400),
    Face("IBMPlexSans-Italic", "italic", 400),
    Face("IBMPlexSans-SemiBold", "normal", 600),
)


def font(name: str) -> bytes:
    """Return the bytes of a font file: ``IBMPlexSans-Regular.woff2``."""
    return (files(PACKAGE) / "fonts" / name).read_bytes()


#: Colour of headings as the style sheets have it.
_ACCENT = "#0d4a63"


def style_sheet(*names: str, accent: str = _ACCENT) -> str:
    """Return the style sheets of these names, one after the other, with headings and lines in a colour."""
    sheets = ((files(PACKAGE) / "styles" / f"{name}.css").read_text("utf-8") for name in names)
    return "\n".join(sheets).replace(_ACCENT, accent)


def font_faces(address: Callable[[Face], str]) -> str:
    """Return the rules that bring in the typeface; `address` says where each face is found."""
    return "\n".join(
        f'@font-face {{ font-family: "{FAMILY}"; font-style: {face.style}; font-weight: {face.weight}; '
        f"src: url({address(face)}) }}"
        for face in FACES
    )


_WORKBENCH = "workbench"
_FACES = "faces.css"
_TOKENS = "tokens.css"
_MEDIA_TYPES = {".css": "text/css", ".js": "text/javascript", ".svg": "image/svg+xml", ".woff2": "font/woff2"}


@dataclass(frozen=True, slots=True)
class PageFile:
    """A file that a page loads."""

    content: bytes
    media_type: str


def page_file(name: str) -> PageFile | None:
    """Return a file by its name; None for any name that is not on the list."""
    return page_files().get(name)


@cache
def page_files() -> dict[str, PageFile]:
    """Return all files of the page by their names."""
    found = {
        each.name: each.read_bytes()
        for each in (files(PACKAGE) / _WORKBENCH).iterdir()
        if each.is_file() and _suffix(each.name) in _MEDIA_TYPES
    }
    found |= {f"{face.stem}.woff2": font(f"{face.stem}.woff2") for face in FACES}
    found[_TOKENS] = style_sheet("tokens").encode()
    found[_FACES] = font_faces(lambda face: f"{face.stem}.woff2").encode()
    return {name: PageFile(content, _MEDIA_TYPES[_suffix(name)]) for name, content in found.items()}


def _suffix(name: str) -> str:
    return f".{name.rpartition('.')[2]}"
