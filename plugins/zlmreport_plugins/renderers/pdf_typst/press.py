"""Runs Typst with template and fonts; packs the objects of its PDF into compressed streams.

Its files are a classic PDF, each object in the clear; `packed` puts them into compressed streams.
"""

from __future__ import annotations

import json
import re
import zlib
from datetime import UTC, date, datetime, time
from functools import cache
from importlib.resources import files
from itertools import accumulate, pairwise
from struct import pack
from threading import Lock

import typst

from zlmreport.plugin.renderer import Certificate
from zlmreport_plugins.renderers.pdf_typst.contents import collect_contents, list_enclosures
from zlmreport_plugins.renderers.pdf_typst.words import demand_letters

_TEMPLATES = "zlmreport_templates"
#: Of a document that states no date of issue: one that carries files must have one, and no clock is asked.
_UNKNOWN = date(1970, 1, 1)


class TypstPress:
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
        document = json.dumps(collect_contents(certificate), ensure_ascii=False)
        demand_letters(document, certificate)
        moment = datetime.combine(certificate.issued or _UNKNOWN, time(), UTC)
        with self._lock:
            pdf = self._compiler.compile(
                input=self._template,
                sys_inputs={
                    "certificate": document,
                    "enclosures": json.dumps(list_enclosures(certificate), ensure_ascii=False),
                },
                pdf_standards=["a-3a", "ua-1"],  # for archives and for accessibility
                timestamp=moment,
            )
        assert isinstance(pdf, bytes)  # noqa: S101 - no file was named to write it to
        return packed(pdf)


_IN_USE = re.compile(rb"(\d{10}) 00000 n")
_TRAILER = re.compile(rb"/Root.*(?=>>)")
_STREAM = b"%d 0 obj\n<</Type%b/Filter/FlateDecode/Length %d>>\nstream\n%b\r\nendstream\nendobj\n"
#: Objects that a stream holds: a reader unpacks all to find one.
_TOGETHER = 200


def packed(pdf: bytes) -> bytes:
    """Return a PDF of Typst with all objects that are no streams in streams (ISO 32000-1, 7.5.7 and 7.5.8).

    Most of a tagged file is its structure, which compresses to a tenth.
    """
    table = int(pdf[pdf.rindex(b"startxref") :].split()[1])
    trailer = _TRAILER.search(pdf, table)
    assert trailer is not None  # noqa: S101 - Typst has written it
    offsets = sorted(int(each) for each in _IN_USE.findall(pdf, table))
    out, entries = bytearray(pdf[: offsets[0]]), {0: (0, 0, 65535)}
    loose: list[tuple[int, bytes]] = []
    for begin, end in pairwise((*offsets, table)):
        name, _, rest = pdf[begin:end].partition(b" 0 obj")
        body = rest[: rest.rindex(b"endobj")].strip()
        if body.endswith(b"endstream"):
            entries[int(name)] = 1, len(out), 0
            out += pdf[begin:end]
        else:
            loose.append((int(name), body))
    number = len(offsets) + 1
    for held in (loose[at : at + _TOGETHER] for at in range(0, len(loose), _TOGETHER)):
        entries[number] = 1, len(out), 0
        entries |= {each: (2, number, at) for at, (each, _) in enumerate(held)}
        places = accumulate((len(body) + 1 for _, body in held), initial=0)
        head = b" ".join(b"%d %d" % (each, place) for (each, _), place in zip(held, places, strict=False))
        kind = b"/ObjStm/N %d/First %d" % (len(held), len(head) + 1)
        out += _make_stream(number, kind, b"\n".join((head, *(body for _, body in held))))
        number += 1
    entries[number] = 1, len(out), 0
    listed = b"".join(pack(">BIH", *entries[each]) for each in range(number + 1))
    kind = b"/XRef/W[1 4 2]/Size %d%b" % (number + 1, trailer[0])
    return bytes(out) + _make_stream(number, kind, listed) + b"startxref\n%d\n%%%%EOF" % len(out)


def _make_stream(number: int, kind: bytes, content: bytes) -> bytes:
    content = zlib.compress(content)
    return _STREAM % (number, kind, len(content), content)


@cache
def find_press() -> TypstPress:
    """Return the press of this process."""
    return TypstPress()
