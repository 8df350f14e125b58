"""The linked graphs inside a document: their values as text that cannot be markup, and one script for them.

The script is bundled from the workbench's modules, so both draw alike. It is wrapped so that the document
stays XML as well.
"""

from __future__ import annotations

import json
import re
from base64 import b64encode
from dataclasses import asdict
from functools import cache
from hashlib import sha256
from importlib.resources import files
from pathlib import PurePosixPath

from markupsafe import Markup

from zlmreport.certificate.linked import Linked
from zlmreport.typesetting.resources import PACKAGE, PageFile, page_files

_FOLDER = "linked"
_ENTRY = "linked.js"
_STYLES = ("linked.css", "graphs.css")
_IMPORT = re.compile(r'^import (\{[^}]*\}) from "\./([\w.]+)";$', re.MULTILINE)
_EXPORT = re.compile(r"^export (?=(?:async )?(?:function|class|const) (\w+))", re.MULTILINE)
#: In XML, a section in which nothing is markup; in HTML, two comments of the script.
_AS_XML = "//<![CDATA[\n{}//]]>\n"


def values(linked: Linked) -> Markup:
    """Return the values as JSON without any character that begins markup or a reference to an entity."""
    text = json.dumps(asdict(linked), separators=(",", ":"), allow_nan=False)
    for character in "<>&":
        text = text.replace(character, f"\\u{ord(character):04x}")
    return Markup(text)  # noqa: S704 (nothing in it is markup any more)


@cache
def script() -> str:
    """Return the script that shows the values."""
    modules: dict[str, str] = {}
    _gather(_ENTRY, modules)
    body = "".join(modules.values())
    return _AS_XML.format(f'(() => {{\n"use strict";\n{body}}})();\n')


def fingerprint(content: str) -> str:
    """Return the digest of a script as a content security policy names it."""
    return f"'sha256-{b64encode(sha256(content.encode()).digest()).decode('ascii')}'"


@cache
def style() -> str:
    """Return the style sheets of the graphs."""
    return "\n".join(_text(name) for name in _STYLES)


def _gather(name: str, modules: dict[str, str]) -> None:
    """Add a module after those that it imports, each as a constant that holds what it exports."""
    text = _text(name)
    for _, other in _IMPORT.findall(text):
        if other not in modules:
            _gather(other, modules)
    exported = ", ".join(_EXPORT.findall(text))
    text = _IMPORT.sub(lambda found: f"const {found[1]} = {_constant(found[2])};", text)
    text = _EXPORT.sub("", text)
    modules[name] = f"const {_constant(name)} = (() => {{\n{text}return {{ {exported} }};\n}})();\n"


def _constant(name: str) -> str:
    return f"{PurePosixPath(name).stem}Module"


def _text(name: str) -> str:
    shared: PageFile | None = page_files().get(name)
    return shared.content.decode() if shared else (files(PACKAGE) / _FOLDER / name).read_text("utf-8")
