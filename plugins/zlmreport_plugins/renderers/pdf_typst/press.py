"""Typst, set up once in a process: the template and the fonts are shared by all documents."""

from __future__ import annotations

import json
from datetime import UTC, date, datetime, time
from functools import cache
from importlib.resources import files
from threading import Lock

import typst

from zlmreport.plugin import Certificate
from zlmreport_plugins.renderers.pdf_typst.contents import contents, enclosures
from zlmreport_plugins.renderers.pdf_typst.words import demand_letters

_TEMPLATES = "zlmreport_templates"
#: Of a document that states no date of issue: one that carries files must have one, and no clock is asked.
_UNKNOWN = date(1970, 1, 1)


class Press:
    """Prints documents, one at a time."""

    def __init__(self) -> None:
        templates = files(_TEMPLATES)
        self._template = (templates / "typst" / "certificate.typ").read_bytes()
        fonts = typst.Fonts(
            include_system_fonts=False,
            include_embedded_fonts=False,
            font_paths=[str(templates / "fonts")],
        )
        self._compiler = typst.Compiler(font_paths=fonts)
        self._lock = Lock()

    def print(self, certificate: Certificate) -> bytes:
        """Return a certificate as PDF."""
        document = json.dumps(contents(certificate), ensure_ascii=False)
        demand_letters(document, certificate.number)
        moment = datetime.combine(certificate.issued or _UNKNOWN, time(), UTC)
        with self._lock:
            pdf = self._compiler.compile(
                input=self._template,
                sys_inputs={
                    "certificate": document,
                    "enclosures": json.dumps(enclosures(certificate), ensure_ascii=False),
                },
                pdf_standards=["a-3a", "ua-1"],  # for archives and for accessibility
                timestamp=moment,
            )
        assert isinstance(pdf, bytes)  # noqa: S101 - no file was named to write it to
        return pdf


@cache
def press() -> Press:
    """Return the press of this process."""
    return Press()
