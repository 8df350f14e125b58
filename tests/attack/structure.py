"""Structural edits of the raw bytes of a PDF: its objects, its tables, and what leads from one to another.

A library of PDFs mends what it writes, so these are made on the bytes. What is drawn is an edit, and whether
the table of objects is put right after it.
"""

from __future__ import annotations

import random
import re
import zlib
from collections.abc import Callable, Sequence

Edit = Callable[[random.Random, bytes], bytes]

_OBJECT = re.compile(rb"(?<=[\n\r])(\d+) 0 obj\b.*?\nendobj\n", re.DOTALL)
_REFERENCE = re.compile(rb"(?<![\d.])\d+ 0 R\b")
_PAIR = re.compile(rb"/[A-Za-z]+ (?:/[A-Za-z0-9+]+|\d+ 0 R|\d+(?:\.\d+)?|\([^()]*\)|<[0-9a-f]+>)")
_ROW = re.compile(rb"\d{10} \d{5} [nf] ?[\r\n]+")
_DIGIT = re.compile(rb"(?<=[\s(<,])\d(?=[\d.,])")
_JUNK = (
    *(b"% 1 0 obj\n", b"\0", b"endobj\n", b"trailer\n<< /Root 1 0 R >>\n", b"%PDF-1.4\n", b"%%EOF\n", b" "),
    *(
        b"\nstartxref\n0\n%%EOF\n",
        b"9999 0 obj\n<< /Type /Catalog >>\nendobj\n",
        b"A = 0.5 um, conforms\n",
        b"\r",
    ),
)
_KEYS = re.findall(
    rb"/\w+",
    b"/AA /AF /Annots /Contents /CropBox /DecodeParms /EF /Encrypt /Extends /F /Filter /ID /Kids /Length "
    b"/Metadata /Names /OC /OpenAction /Pages /Parent /Prev /Resources /Root /Rotate /Size /UF /Version "
    b"/XRefStm",
)
_VALUES = (b"null", b"0", b"1", b"90", b"[0 0 9 9]", b"(x)", b"/X", b"[]", b"<< >>", b"true", b"-1", b"99999")


def _objects(content: bytes) -> list[re.Match[bytes]]:
    return list(_OBJECT.finditer(content))


def _put(content: bytes, at: int, what: bytes) -> bytes:
    return content[:at] + what + content[at:]


def _altered(draw: random.Random, each: bytes) -> bytes:
    """Return an object that says something else: another number, reference or value, packed data too."""
    begin = each.find(b"stream\n")
    if begin >= 0 and draw.random() < 0.7:
        data, end = each[begin + 7 : each.rfind(b"\nendstream")], each[each.rfind(b"\nendstream") :]
        try:
            unpacked = zlib.decompress(data)
        except zlib.error:
            return each
        packed = zlib.compress(_other_digit(draw, unpacked))
        head = re.sub(rb"/Length \d+", b"/Length %d" % len(packed), each[:begin])
        return head + b"stream\n" + packed + end
    return draw.choice((_other_digit, _other_reference, _other_value))(draw, each)


def _other_digit(draw: random.Random, each: bytes) -> bytes:
    found = list(_DIGIT.finditer(each))
    if not found:
        return each
    one = draw.choice(found)
    return each[: one.start()] + b"%d" % draw.randrange(10) + each[one.end() :]


def _other_reference(draw: random.Random, each: bytes) -> bytes:
    found = list(_REFERENCE.finditer(each))
    if not found:
        return each
    one = draw.choice(found)
    return each[: one.start()] + b"%d 0 R" % draw.randrange(1, 200) + each[one.end() :]


def _other_value(draw: random.Random, each: bytes) -> bytes:
    found = list(_PAIR.finditer(each))
    if not found:
        return each
    one = draw.choice(found)
    key = one[0].split(b" ")[0]
    return each[: one.start()] + key + b" " + draw.choice(_VALUES) + each[one.end() :]


def copy_of_object(draw: random.Random, content: bytes) -> bytes:
    """Put an altered copy of an object somewhere: between others, before all, behind the table or the end."""
    found = _objects(content)
    if not found:
        return content
    one = draw.choice(found)
    places = [draw.choice(found).start(), found[0].start(), found[-1].end(), len(content)]
    at = draw.choice([*places, max(content.rfind(b"trailer"), 0), max(content.rfind(b"startxref"), 0)])
    copy = _altered(draw, one[0])
    return _put(content, at, (b"% " if draw.random() < 0.1 else b"") + copy)


def copies_of_all(draw: random.Random, content: bytes) -> bytes:
    """Put a second copy of every object, some of them altered, between the objects and the table."""
    found = _objects(content)
    if not found:
        return content
    copies = b"".join(_altered(draw, each[0]) if draw.random() < 0.1 else each[0] for each in found)
    return _put(content, draw.choice((found[0].start(), found[-1].end())), copies)


def alter_object(draw: random.Random, content: bytes) -> bytes:
    """Alter an object in its place."""
    found = _objects(content)
    if not found:
        return content
    one = draw.choice(found)
    return content[: one.start()] + _altered(draw, one[0]) + content[one.end() :]


def exchange_objects(draw: random.Random, content: bytes) -> bytes:
    """Let two objects have each other's numbers."""
    found = _objects(content)
    if len(found) < 2:
        return content
    one, other = sorted(draw.sample(found, 2), key=lambda each: each.start())
    first = other[1] + one[0][len(one[1]) :]
    second = one[1] + other[0][len(other[1]) :]
    between = content[one.end() : other.start()]
    return content[: one.start()] + first + between + second + content[other.end() :]


def drop_object(draw: random.Random, content: bytes) -> bytes:
    """Leave an object out."""
    found = _objects(content)
    if not found:
        return content
    one = draw.choice(found)
    return content[: one.start()] + content[one.end() :]


def add_entry(draw: random.Random, content: bytes) -> bytes:
    """Put an entry into a dictionary: at its beginning or its end, some keys a second time."""
    found = [each.end() for each in re.finditer(rb"<<", content)]
    ends = [each.start() for each in re.finditer(rb">>", content)]
    if not found:
        return content
    reference = b"%d 0 R" % draw.randrange(1, 200)
    value = reference if draw.random() < 0.4 else draw.choice(_VALUES)
    return _put(
        content, draw.choice(draw.choice((found, ends or found))), b" %s %s " % (draw.choice(_KEYS), value)
    )


def row_of_table(draw: random.Random, content: bytes) -> bytes:
    """Let an entry of the table lead elsewhere, be of another width or kind, or stand twice or not at all."""
    found = list(_ROW.finditer(content))
    if not found:
        return content
    one = draw.choice(found)
    place = draw.choice([each.start() for each in _objects(content)] or [0])
    other = draw.choice(
        (
            b"%010d 00000 n \n" % place,
            b"%010d 00000 n\n" % int(one[0][:10]),
            b"%010d 00000 n \r\n" % int(one[0][:10]),
            b"%010d 00001 n \n" % int(one[0][:10]),
            b"0000000000 65535 f \n",
            one[0] * 2,
            b"",
        )
    )
    return content[: one.start()] + other + content[one.end() :]


def all_rows(draw: random.Random, content: bytes) -> bytes:
    """Let all entries of the table be of another width, or its section begin or end elsewhere."""
    begin = content.rfind(b"\nxref\n")
    end = content.rfind(b"trailer")
    if not 0 <= begin < end:
        return content
    table = content[begin:end]
    change = draw.choice(
        (
            lambda each: each.replace(b" n \n", b" n\n"),
            lambda each: each.replace(b" n \n", b" n \r\n"),
            lambda each: re.sub(rb"xref\n\d+ ", b"xref\n%d " % draw.randrange(4), each),
            lambda each: re.sub(
                rb"(xref\n\d+ )(\d+)", lambda found: found[1] + b"%d" % draw.randrange(200), each
            ),
            lambda each: (
                each + b"%d 1\n%010d 00000 n \n" % (draw.randrange(1, 100), draw.randrange(len(content)))
            ),
        )
    )
    return content[:begin] + change(table) + content[end:]


def trailer(draw: random.Random, content: bytes) -> bytes:
    """Let the end of the file state something else, or be there twice."""
    begin, end = content.rfind(b"trailer"), content.rfind(b"startxref")
    if not 0 <= begin < end:
        return content
    stated = content[begin:end]
    change = draw.choice(
        (
            lambda each: re.sub(rb"/Size \d+", b"/Size %d" % draw.choice((1, 9, 50, 9999)), each),
            lambda each: re.sub(rb"/Root \d+", b"/Root %d" % draw.randrange(1, 200), each),
            lambda each: each.replace(b">>", b"/Prev %d >>" % draw.randrange(len(content)), 1),
            lambda each: each * 2,
            lambda each: _other_value(draw, each),
        )
    )
    return content[:begin] + change(stated) + content[end:]


def leads(draw: random.Random, content: bytes) -> bytes:
    """Let the number that leads to the table lead elsewhere, or take it away."""
    place = draw.choice((0, draw.randrange(len(content) + 1), len(content) + 5))
    return re.sub(rb"startxref\s+\d+", draw.choice((b"startxref\n%d" % place, b"")), content)


def revision(draw: random.Random, content: bytes) -> bytes:
    """Append a revision with an altered object and a table of its own."""
    found = _objects(content)
    last = re.search(rb"startxref\s+(\d+)\s+%%EOF\s*\Z", content)
    stated = re.search(rb"trailer\s*<<(.*?)>>\s*startxref", content, re.DOTALL)
    if not found or last is None or stated is None:
        return content
    one = draw.choice(found)
    place = len(content)
    added = _altered(draw, one[0])
    table = b"xref\n%d 1\n%010d 00000 n \n" % (int(one[1]), place)
    end = b"trailer\n<<%s /Prev %d >>\n" % (stated[1], int(last[1]))
    return content + added + table + end + b"startxref\n%d\n%%%%EOF\n" % (place + len(added))


def junk(draw: random.Random, content: bytes) -> bytes:
    """Put bytes between two objects, before the first or behind the end."""
    places = [
        0,
        len(content),
        *(each.start() for each in _objects(content)),
        *(each.end() for each in _objects(content)),
    ]
    return _put(content, draw.choice(places), draw.choice(_JUNK))


def lengths(draw: random.Random, content: bytes) -> bytes:
    """Let data be of another length than they state, or state it elsewhere."""
    found = list(re.finditer(rb"/Length (\d+)(?! 0 R)", content))
    if not found:
        return content
    one = draw.choice(found)
    other = draw.choice(
        (b"%d" % (int(one[1]) + draw.choice((-1, 1, 5, -20))), b"%d 0 R" % draw.randrange(1, 200))
    )
    return content[: one.start(1)] + other + content[one.end(1) :]


def texts(draw: random.Random, content: bytes) -> bytes:
    """Let a text of the file be another, or be spelt otherwise."""
    found = list(re.finditer(rb"\(([^()\\]{2,60})\)", content))
    if not found:
        return content
    one, other = draw.choice(found), draw.choice(found)
    spelt = draw.choice(
        (
            other[0],
            b"<%s>" % one[1].hex().encode(),
            b"(%s )" % one[1],
            b"(\\%03o%s)" % (one[1][0], one[1][1:]),
        )
    )
    return content[: one.start()] + spelt + content[one.end() :]


def with_table(content: bytes) -> bytes:
    """Return a PDF with its table made anew, of the last object of each number."""
    begin = content.rfind(b"\nxref\n") + 1
    stated = content.rfind(b"trailer"), content.rfind(b"startxref")
    if not 0 < begin < stated[0] < stated[1]:
        return content
    body = content[:begin]
    places = {int(each[1]): each.start() for each in _OBJECT.finditer(body)}
    if not places or max(places) > 100_000:
        return content
    free = b"0000000000 65535 f \n"
    rows = (b"%010d 00000 n \n" % places[each] if each in places else free for each in range(max(places) + 1))
    table = b"xref\n0 %d\n%s" % (max(places) + 1, b"".join(rows))
    end = re.sub(rb"/Size \d+", b"/Size %d" % (max(places) + 1), content[stated[0] : stated[1]])
    return body + table + end + b"startxref\n%d\n%%%%EOF\n" % begin


EDITS: Sequence[Edit] = (
    *(
        copy_of_object,
        copy_of_object,
        copies_of_all,
        alter_object,
        alter_object,
        exchange_objects,
        drop_object,
    ),
    *(add_entry, add_entry, row_of_table, all_rows, trailer, leads, revision, junk, lengths, texts),
)


def drawn(sound: bytes, seeds: Sequence[int]) -> bytes:
    """Return a file after an edit for each seed; half of them have the table put right after it."""
    content = sound
    for seed in seeds:
        draw = random.Random(seed)
        content = draw.choice(EDITS)(draw, content)
        if draw.random() < 0.5:
            content = with_table(content)
    return content
