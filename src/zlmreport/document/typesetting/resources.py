"""Finds style sheets, fonts, scripts and the files of the workbench's page in the package of templates.

The script of linked graphs is bundled from the workbench's modules, so both draw alike. It is wrapped so that
the document stays XML as well.
"""

from __future__ import annotations

import json
import re
from base64 import b64encode
from collections.abc import Callable
from dataclasses import asdict, dataclass
from functools import cache
from hashlib import sha256
from importlib.resources import files
from pathlib import PurePosixPath

from markupsafe import Markup

from zlmreport.document.certificate.document import Linked, Look
from zlmreport.document.figures.canvas import FAMILY
from zlmreport.job.document_keys import ACCENT

#: The package whose templates, styles and scripts are used, and no others.
PACKAGE = "zlmreport_templates"


@dataclass(frozen=True, slots=True)
class FontFace:
    """A face of the bundled typeface: the stem of its files, and what style sheets call it."""

    stem: str
    style: str
    weight: int


#: The faces of the bundled typeface.
FACES = (
    FontFace("IBMPlexSans-Regular", "normal", 400),
    FontFace("IBMPlexSans-Italic", "italic", 400),
    FontFace("IBMPlexSans-SemiBold", "normal", 600),
)


def read_font(name: str) -> bytes:
    """Return the bytes of a font file: ``IBMPlexSans-Regular.woff2``."""
    return (files(PACKAGE) / "fonts" / name).read_bytes()


def style_sheet(*names: str, accent: str = ACCENT) -> str:
    """Return the style sheets of these names, one after the other, with headings and lines in a colour."""
    sheets = ((files(PACKAGE) / "styles" / f"{name}.css").read_text("utf-8") for name in names)
    return "\n".join(sheets).replace(ACCENT, accent)


def write_font_faces(address: Callable[[FontFace], str]) -> str:
    """Return the rules that bring in the typeface; `address` says where each face is found."""
    return "\n".join(
        f'@font-face {{ font-family: "{FAMILY}"; font-style: {face.style}; font-weight: {face.weight}; '
        f"src: url({address(face)}) }}"
        for face in FACES
    )


def write_own_style(look: Look, address: Callable[[bytes], str]) -> str:
    """Return the style sheet of a laboratory's own look; `address` says where a font is found."""
    rules = [look.style_sheet.text] if look.style_sheet else []
    if face := look.typeface:
        regular, semibold = face.regular, face.semibold
        family = f"own-{sha256(regular + semibold).hexdigest()[:12]}"
        names = f'font-family: {family}, "{FAMILY}", sans-serif'
        rules = [
            *(
                f"@font-face {{ font-family: {family}; font-weight: {weight}; src: url({address(font)}) }}"
                for weight, font in ((400, regular), (600, semibold))
            ),
            f'html {{ {names} }} @page {{ {names} }} .symbol, .drawing {{ font-family: "{FAMILY}" }}',
            *(
                f".sheet .{kind}-{lacking} {{ padding-right: {0.45 + sign + lacking * face.figure:.3f}em }}"
                for kind, sign in (("short", 0.0), ("whole", face.sign))
                for lacking in range(1, 7)
            ),
            *rules,
        ]
    return "\n".join(rules)


_WORKBENCH = "workbench"
_FACES = "faces.css"
_TOKENS = "tokens.css"
_MEDIA_TYPES = {".css": "text/css", ".js": "text/javascript", ".svg": "image/svg+xml", ".woff2": "font/woff2"}


@dataclass(frozen=True, slots=True)
class PageFile:
    """A file that a page loads."""

    content: bytes
    media_type: str


def find_page_file(name: str) -> PageFile | None:
    """Return a file by its name; None for any name that is not on the list."""
    return read_page_files().get(name)


@cache
def read_page_files() -> dict[str, PageFile]:
    """Return all files of the page by their names."""
    found = {
        each.name: each.read_bytes()
        for each in (files(PACKAGE) / _WORKBENCH).iterdir()
        if each.is_file() and _find_suffix(each.name) in _MEDIA_TYPES
    }
    found |= {f"{face.stem}.woff2": read_font(f"{face.stem}.woff2") for face in FACES}
    found[_TOKENS] = style_sheet("tokens").encode()
    found[_FACES] = write_font_faces(lambda face: f"{face.stem}.woff2").encode()
    return {name: PageFile(content, _MEDIA_TYPES[_find_suffix(name)]) for name, content in found.items()}


def _find_suffix(name: str) -> str:
    return f".{name.rpartition('.')[2]}"


_FOLDER = "linked"
_ENTRY = "linked.js"
_STYLES = ("linked.css", "graphs.css")
_IMPORT = re.compile(r'^import (\{[^}]*\}) from "\./([\w.]+)";$', re.MULTILINE)
_EXPORT = re.compile(r"^export (?=(?:async )?(?:function|class|const) (\w+))", re.MULTILINE)
#: In XML, a section in which nothing is markup; in HTML, two comments of the script.
_AS_XML = "//<![CDATA[\n{}//]]>\n"


def write_linked_values(linked: Linked) -> Markup:
    """Return the values as JSON without any character that begins markup or a reference to an entity."""
    text = json.dumps(asdict(linked), separators=(",", ":"), allow_nan=False)
    for character in "<>&":
        text = text.replace(character, f"\\u{ord(character):04x}")
    return Markup(text)  # noqa: S704 (nothing in it is markup any more)


@cache
def read_linked_script() -> str:
    """Return the script that shows the values."""
    modules: dict[str, str] = {}
    _gather(_ENTRY, modules)
    body = "".join(modules.values())
    return _AS_XML.format(f'(() => {{\n"use strict";\n{body}}})();\n')


def digest_script(content: str) -> str:
    """Return the digest of a script as a content security policy names it."""
    return f"'sha256-{b64encode(sha256(content.encode()).digest()).decode('ascii')}'"


@cache
def read_linked_style() -> str:
    """Return the style sheets of the graphs."""
    return "\n".join(_read_text(name) for name in _STYLES)


def _gather(name: str, modules: dict[str, str]) -> None:
    """Add a module after those that it imports, each as a constant that holds what it exports."""
    text = _read_text(name)
    for _, other in _IMPORT.findall(text):
        if other not in modules:
            _gather(other, modules)
    exported = ", ".join(_EXPORT.findall(text))
    text = _IMPORT.sub(lambda found: f"const {found[1]} = {_read_constant(found[2])};", text)
    text = _EXPORT.sub("", text)
    modules[name] = f"const {_read_constant(name)} = (() => {{\n{text}return {{ {exported} }};\n}})();\n"


def _read_constant(name: str) -> str:
    return f"{PurePosixPath(name).stem}Module"


def _read_text(name: str) -> str:
    shared: PageFile | None = read_page_files().get(name)
    return shared.content.decode() if shared else (files(PACKAGE) / _FOLDER / name).read_text("utf-8")
