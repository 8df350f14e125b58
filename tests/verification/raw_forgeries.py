"""Forged certificates of which the bytes say one thing by their table and another by what stands there.

No library of PDFs writes these, and most mend them while they read: they are put together byte by byte.
"""

from __future__ import annotations

import re
import zlib
from collections.abc import Callable, Mapping
from io import BytesIO

import pikepdf
from pikepdf import Name, Pdf

from verification.altering import draw, page_of, rewritten
from verification.forgeries import BOX, forge_bytes, plain
from verification.issued import content_of

READINGS = "x-axis.csv"
_OBJECT = re.compile(rb"(?<=\n)(\d+) 0 obj\b.*?\nendobj\n", re.DOTALL)


def objects(whole: bytes) -> dict[int, bytes]:
    """Return the objects of a PDF without packed objects, by number."""
    return {int(each[1]): each[0] for each in _OBJECT.finditer(whole)}


def together(  # noqa: PLR0913 - each is one part of a file
    whole: bytes,
    more: bytes = b"",
    *,
    rows: Mapping[int, bytes] | None = None,
    head: bytes | None = None,
    trailer: Callable[[bytes], bytes] = lambda each: each,
    before: bytes = b"",
) -> bytes:
    """Return a PDF without packed objects with its table made anew.

    `more` and `before` stand behind and before the objects of the table; `rows` are entries of its own, and
    `head` is the head of its section.
    """
    body = whole[: whole.rindex(b"\nxref\n") + 1]
    first = _OBJECT.search(body)
    assert first is not None
    body = body[: first.start()] + before + body[first.start() :]
    places = {int(each[1]): each.start() for each in _OBJECT.finditer(body) if each.start() >= first.start()}
    body += more
    entries = {number: b"%010d 00000 n \n" % place for number, place in places.items()}
    entries[0] = b"0000000000 65535 f \n"
    entries |= rows or {}
    last = max(entries)
    free = b"0000000000 65535 f \n"
    table = b"xref\n%s\n" % (b"0 %d" % (last + 1) if head is None else head)
    table += b"".join(entries.get(number, free) for number in range(last + 1))
    end = whole[whole.rindex(b"trailer") : whole.rindex(b"startxref")]
    return body + table + trailer(end) + b"startxref\n%d\n%%%%EOF\n" % len(body)


def boxed(pdf: bytes, page: int = 2) -> dict[int, bytes]:
    """Return the objects of the same PDF with a white box on a page of it."""
    return objects(plain(rewritten(pdf, lambda opened: draw(opened, page_of(opened, page), BOX))))


def other_readings(pdf: bytes) -> tuple[int, bytes]:
    """Return the object of the attached readings, with other readings, and its number."""
    content = content_of(pdf, READINGS)
    assert b"2.9" in content
    changed = content.replace(b"2.9", b"0.9").replace(b"3.1", b"1.1")
    with pikepdf.open(BytesIO(plain(pdf))) as opened:
        number = opened.attachments[READINGS].get_file().obj.objgen[0]
    old = objects(plain(pdf))[number]
    packed = zlib.compress(changed)
    head = re.sub(rb"/Length \d+", b"/Length %d" % len(packed), old[: old.index(b"stream\n")])
    head = re.sub(rb"/DecodeParms <<.*?>>", b"", head)
    assert b"/FlateDecode" in head
    return number, head + b"stream\n" + packed + b"\nendstream\nendobj\n"


@forge_bytes("second copy of every object, and a table of one", "a white box, in viewers that mend the table")
def _(pdf: bytes) -> bytes:
    copies = b"".join(boxed(pdf).values())
    return together(plain(pdf), copies, trailer=lambda end: re.sub(rb"/Size \d+", b"/Size 1", end))


@forge_bytes("second copy of every object", "a white box, in viewers that put the file together anew")
def _(pdf: bytes) -> bytes:
    return together(plain(pdf), b"".join(boxed(pdf).values()))


@forge_bytes("second copy before the first", "a white box, in viewers that take the first of two")
def _(pdf: bytes) -> bytes:
    whole = plain(pdf)
    changed = boxed(pdf)
    only = {number: each for number, each in changed.items() if objects(whole).get(number) != each}
    body = whole[: whole.rindex(b"\nxref\n") + 1]
    first = _OBJECT.search(body)
    assert first is not None
    ahead = b"".join(only.values())
    moved = {
        int(each[1]): b"%010d 00000 n \n" % (each.start() + len(ahead)) for each in _OBJECT.finditer(body)
    }
    return together(whole, before=ahead, rows=moved)


@forge_bytes("table without a last object", "a white box, in viewers that look for what the table lacks")
def _(pdf: bytes) -> bytes:
    return together(
        plain(pdf),
        b"".join(boxed(pdf).values()),
        trailer=lambda end: re.sub(rb"/Size (\d+)", b"/Size 9", end),
    )


@forge_bytes("object twice in the table", "other readings, in programs that take the first of two entries")
def _(pdf: bytes) -> bytes:
    whole = plain(pdf)
    number, changed = other_readings(pdf)
    place = whole.rindex(b"\nxref\n") + 1
    made = together(whole, changed)
    section = b"%d 1\n%010d 00000 n \n" % (number, place)
    at = made.rindex(b"trailer")
    return made[:at] + section + made[at:]


@forge_bytes("object twice in the table, other order", "other readings, in programs that take the last entry")
def _(pdf: bytes) -> bytes:
    whole = plain(pdf)
    number, changed = other_readings(pdf)
    place = whole.rindex(b"\nxref\n") + 1
    made = together(whole, changed)
    at = made.rindex(b"\nxref\n") + len(b"\nxref\n")
    return made[:at] + b"%d 1\n%010d 00000 n \n" % (number, place) + made[at:]


@forge_bytes(
    "object twice in a packed table", "other readings, in programs that take the first of two entries"
)
def _(pdf: bytes) -> bytes:
    return with_packed_table(pdf, repeated=True)


def with_packed_table(pdf: bytes, *, repeated: bool) -> bytes:
    """Return a PDF whose table is packed; in it an object may stand twice."""
    whole = plain(pdf)
    number, changed = other_readings(pdf)
    body = whole[: whole.rindex(b"\nxref\n") + 1]
    places = {int(each[1]): each.start() for each in _OBJECT.finditer(body)}
    second = len(body)
    if repeated:
        body += changed
    last = max(places) + 1
    places[last] = len(body)
    rows = [(1, places[each], 0) if each in places else (0, 0, 65535) for each in range(last + 1)]
    index = [0, last + 1]
    if repeated:
        rows.append((1, second, 0))
        index += [number, 1]
    data = zlib.compress(b"".join(b"%c%s%s" % (k, p.to_bytes(4), g.to_bytes(2)) for k, p, g in rows))
    trailer = whole[whole.rindex(b"trailer") + 7 : whole.rindex(b"startxref")].strip()
    entries = re.sub(rb"/Size \d+", b"", trailer[2:-2])
    head = (
        b"%d 0 obj\n<< /Type /XRef /Size %d /W [1 4 2] /Index [%s] /Filter /FlateDecode /Length %d %s >>\n"
        % (last, last + 1, b" ".join(b"%d" % each for each in index), len(data), entries)
    )
    made = body + head + b"stream\n" + data + b"\nendstream\nendobj\n"
    return made + b"startxref\n%d\n%%%%EOF\n" % places[last]


def _with_entries(pdf: bytes, change: Callable[[bytes], bytes]) -> bytes:
    """Return a PDF whose table has entries of another kind, with other readings behind its objects."""
    whole = plain(pdf)
    _, changed = other_readings(pdf)
    made = together(whole, changed)
    begin = made.rindex(b"\nxref\n") + 1
    return made[:begin] + change(made[begin : made.rindex(b"trailer")]) + made[made.rindex(b"trailer") :]


@forge_bytes("entries of 19 bytes", "other readings, in programs that count twenty bytes an entry")
def _(pdf: bytes) -> bytes:
    return _with_entries(pdf, lambda table: table.replace(b" n \n", b" n\n").replace(b" f \n", b" f\n"))


@forge_bytes("entries of 21 bytes", "other readings, in programs that count twenty bytes an entry")
def _(pdf: bytes) -> bytes:
    return _with_entries(pdf, lambda table: table.replace(b" n \n", b" n \r\n"))


@forge_bytes("section that begins at 1", "other readings, in programs that mend such a table")
def _(pdf: bytes) -> bytes:
    return _with_entries(pdf, lambda table: table.replace(b"xref\n0 ", b"xref\n1 ", 1))


@forge_bytes("object behind the end", "other readings, in programs that put the file together anew")
def _(pdf: bytes) -> bytes:
    return pdf + b"\n" + other_readings(pdf)[1]


@forge_bytes("object in a comment", "other readings, in programs that look for objects in every line")
def _(pdf: bytes) -> bytes:
    changed = other_readings(pdf)[1]
    return together(plain(pdf), b"% a comment\n% " + changed)


@forge_bytes("object between others", "other readings, in programs that put the file together anew")
def _(pdf: bytes) -> bytes:
    return together(plain(pdf), other_readings(pdf)[1])


@forge_bytes("second beginning", "an empty document, in viewers that look for a catalog")
def _(pdf: bytes) -> bytes:
    def change(opened: Pdf) -> None:
        pages = opened.make_indirect(pikepdf.Dictionary(Type=Name.Pages, Count=0, Kids=[]))
        other = opened.make_indirect(pikepdf.Dictionary(Type=Name.Catalog, Pages=pages))
        opened.Root.Lost = other

    whole = plain(rewritten(pdf, change))
    return together(re.sub(rb"/Lost \d+ 0 R", b"", whole, count=1))


@forge_bytes("another header", "another release of the format, in viewers that take the last header")
def _(pdf: bytes) -> bytes:
    return together(plain(pdf), before=b"%PDF-1.4\n", rows=_moved(plain(pdf), 9))


@forge_bytes("text between objects", "as before; whoever looks at the bytes finds a statement")
def _(pdf: bytes) -> bytes:
    said = b"A = 0.5 um, passed\n"
    return together(plain(pdf), said)


def _moved(whole: bytes, by: int) -> dict[int, bytes]:
    body = whole[: whole.rindex(b"\nxref\n") + 1]
    return {int(each[1]): b"%010d 00000 n \n" % (each.start() + by) for each in _OBJECT.finditer(body)}


@forge_bytes("longer data", "more on a page, in viewers that look for the end of data")
def _(pdf: bytes) -> bytes:
    whole = plain(pdf)
    number, changed = other_readings(pdf)
    longer = objects(whole)[number].replace(b"\nendstream", b"\n" + changed + b"\nendstream", 1)
    return together(whole.replace(objects(whole)[number], longer))
