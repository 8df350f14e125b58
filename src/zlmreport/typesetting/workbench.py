"""The files of the workbench's page, as they lie in the package of templates: these, and no others."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from importlib.resources import files

from zlmreport.typesetting.resources import FACES, font, font_faces
from zlmreport.typesetting.templates import PACKAGE

_FOLDER = "workbench"
_FACES = "faces.css"
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
        for each in (files(PACKAGE) / _FOLDER).iterdir()
        if each.is_file() and _suffix(each.name) in _MEDIA_TYPES
    }
    found |= {f"{face.stem}.woff2": font(f"{face.stem}.woff2") for face in FACES}
    found[_FACES] = font_faces(lambda face: f"{face.stem}.woff2").encode()
    return {name: PageFile(content, _MEDIA_TYPES[_suffix(name)]) for name, content in found.items()}


def _suffix(name: str) -> str:
    return f".{name.rpartition('.')[2]}"
