"""Checks the cross-reference tables of a PDF against its raw bytes: each object once, nothing besides.

Some viewers believe the table that says where objects stand; others, and all of them where a table is
damaged, put the file together anew from what they find in it. So the two must be the same: one header, one
table, each number once, nothing between objects, and `/Size` exact. Only a signature adds a revision: objects
behind the end, with a table of their own.
"""

from __future__ import annotations

import re
import zlib
from collections.abc import Iterator
from dataclasses import dataclass

from zlmreport.language import Words
from zlmreport.verification.findings import CheckedStatement, VerificationVerdict, name_first_of
from zlmreport.verification.tokens import (
    Indirect,
    OddError,
    PdfName,
    Reference,
    Value,
    begins_object,
    read_object,
    read_value,
    skip_space,
)

#: Of packed tables and packed objects of one file, in bytes; revisions; objects.
_LARGEST = 128 << 20
_MOST_REVISIONS = 40
_MOST_OBJECTS = 1_000_000
_HEADER = re.compile(rb"%PDF-[12]\.\d(?:\r\n|\n|\r)(?:%[\x80-\xff]{4,20}(?:\r\n|\n|\r)+)?")
_SECTION = re.compile(rb"(0|[1-9]\d{0,9}) ([1-9]\d{0,9}) ?(?:\r\n|\n|\r)")
_ENTRY = re.compile(rb"(\d{10}) (\d{5}) ([nf])(?: \r| \n|\r\n)")
_BEGIN = re.compile(rb"xref ?(?:\r\n|\n|\r)")
_TRAILER = re.compile(rb"trailer[ \t\r\n]*(?=<<)")
_END = re.compile(rb"startxref(?:\r\n|\n|\r)(\d{1,12})(?:\r\n|\n|\r)%%EOF(?:\r\n|\n|\r|\Z)")
#: What a viewer that puts a file together anew looks for, wherever it stands.
_LOOKED_FOR = re.compile(
    rb"(?<!\d)\d+[\s\0]+\d+[\s\0]*obj|endobj|endstream|trailer|startxref|%%EOF|%PDF-|%!PS"
)
_WHOLE = re.compile(rb"\d{1,10}")
#: A file whose first page comes first has two tables, of which some viewers read the one and some the other.
_LINEARISED = re.compile(_HEADER.pattern + rb"\s*\d+ 0 obj\s*<<\s*/Linearized\b")
_SAY_LINEARISED = Words(
    "arranged anew for fast web view (linearized), with two tables of which a viewer may go by either: ask "
    "for the file as it was issued, or save it without that (qpdf FILE NEW), and verify the new one"
)
#: A file that was written for people to read has comments between its objects.
_FOR_PEOPLE = re.compile(_HEADER.pattern + rb"%QDF-1\.0\s")
_SAY_FOR_PEOPLE = Words(
    "written anew for people to read (QDF), with comments between its objects: ask for the file as it was "
    "issued, or save it without that (qpdf FILE NEW), and verify the new one"
)
_SUBJECT = "objects of the file"
_TOO_MANY = "it holds more objects than any certificate"
_MOST_TOLD = 4
_FREE, _PLAIN, _PACKED = 0, 1, 2
_ENTRY_SIZE = 20
_WIDEST = 8


@dataclass(frozen=True, slots=True)
class TableEntry:
    """What a table says of an object.

    `kind` is 0 for a number that is free, 1 for an object that begins at byte `first`, 2 for one that is
    packed in the object of the number `first`, as number `second`.
    """

    kind: int
    first: int
    second: int


@dataclass(frozen=True, slots=True)
class _Table:
    """A table: entries by number, the dictionary at its end, where it begins and where its revision ends."""

    entries: dict[int, TableEntry]
    trailer: dict[bytes, Value]
    start: int
    end: int


@dataclass(frozen=True, slots=True)
class Scanned:
    """What stands in a file: the newest object of each number, and the last dictionary of a table."""

    objects: dict[int, Value]
    trailer: dict[bytes, Value]


def check_table(content: bytes, *, is_signed: bool) -> CheckedStatement:
    """Return whether a file is what its tables say, byte for byte, and all of it leads somewhere."""
    try:
        scanned = scan(content, is_signed=is_signed)
    except OddError as error:
        for written, said in ((_LINEARISED, _SAY_LINEARISED), (_FOR_PEOPLE, _SAY_FOR_PEOPLE)):
            if written.match(content):
                return CheckedStatement(_SUBJECT, VerificationVerdict.OPEN, said)
        return CheckedStatement(_SUBJECT, VerificationVerdict.DIFFERS, str(error))
    lost = [f"nothing leads to object {number}" for number in _find_orphans(scanned)]
    return CheckedStatement.of(_SUBJECT, name_first_of(lost, _MOST_TOLD))


def scan(content: bytes, *, is_signed: bool) -> Scanned:
    """Read a file from its first to its last byte.

    `is_signed`: Whether it may have the revisions of signatures.

    Raises `OddError` at the first byte that no table accounts for, or that is otherwise than a table says.
    """
    return _Scan(content, is_signed=is_signed).scan()


class _Scan:
    """A scan of one file."""

    def __init__(self, content: bytes, *, is_signed: bool) -> None:
        self._content = content
        self._most_revisions = _MOST_REVISIONS if is_signed else 1
        self._known: dict[int, Value] = {}
        self._unpacked = 0
        self._begins: list[int] = []

    def scan(self) -> Scanned:
        header = _HEADER.match(self._content)
        if header is None:
            raise OddError("it does not begin with the header of a PDF alone")
        at, trailer, before = header.end(), {}, None
        revisions = 0
        while skip_space(self._content, at) < len(self._content):
            revisions += 1
            if revisions > self._most_revisions:
                raise OddError("something is appended that no signature brings")
            table = self._read_revision(at, before)
            at, trailer, before = table.end, table.trailer, table.start
        if not revisions:
            raise OddError("it holds no table of its objects")
        self._look_for_others()
        return Scanned(self._known, trailer)

    def _read_revision(self, at: int, before: int | None) -> _Table:
        """Read the objects of a revision and its table; `before` is where the table before it begins."""
        content, found = self._content, list[Indirect]()
        at = skip_space(content, at)
        while begins_object(content, at):
            found.append(read_object(content, at))
            if len(found) + len(self._known) > _MOST_OBJECTS:
                raise OddError(_TOO_MANY)
            at = skip_space(content, found[-1].end)
        begun = _BEGIN.match(content, at)
        table = self._read_plain_table(begun.end(), at) if begun else self._read_table_of_stream(found, at)
        self._begins += [each.start for each in found]
        self._hold_against_objects(found, table, before)
        return table

    def _read_plain_table(self, at: int, start: int) -> _Table:
        content, entries = self._content, dict[int, TableEntry]()
        while section := _SECTION.match(content, at):
            first, count = int(section[1]), int(section[2])
            at = section.end()
            if entries and first <= next(reversed(entries)):  # they rise: the last is the largest
                raise OddError("the sections of its table are in no order")
            if at + count * _ENTRY_SIZE > len(content):
                raise OddError("its table states more objects than it lists")
            for number in range(first, first + count):
                row = _ENTRY.match(content, at)
                if row is None or row.end() - at != _ENTRY_SIZE:
                    raise OddError(f"the entry of object {number} in its table is not of 20 bytes")
                is_used = row[3] == b"n"
                entries[number] = TableEntry(_PLAIN if is_used else _FREE, int(row[1]), int(row[2]))
                at = row.end()
        begun = _TRAILER.match(content, at)
        if begun is None:
            raise OddError("something stands in or behind its table")
        trailer, at = read_value(content, begun.end())
        if not isinstance(trailer, dict) or b"XRefStm" in trailer:
            raise OddError("it has a second table beside the first")
        return _Table(entries, trailer, start, self._find_end(at, start))

    def _read_table_of_stream(self, found: list[Indirect], at: int) -> _Table:
        last = found[-1] if found else None
        value = last.value if last else None
        if last is None or not isinstance(value, dict) or value.get(b"Type") != PdfName(b"XRef"):
            raise OddError(f"what stands at byte {at} is no object and no table")
        entries = _unpack_entries(value, self._unpack(last))
        return _Table(entries, value, last.start, self._find_end(at, last.start))

    def _find_end(self, at: int, start: int) -> int:
        """Return where a revision ends, behind the words that lead to its table."""
        end = _END.match(self._content, skip_space(self._content, at))
        if end is None or int(end[1]) != start:
            raise OddError("its end does not lead to its table")
        return end.end()

    def _hold_against_objects(self, found: list[Indirect], table: _Table, before: int | None) -> None:
        """Hold a table against the objects that stand before it; know them from now on."""
        if table.trailer.get(b"Prev") != before:
            raise OddError("its table leads to another one")
        values, places = self._list_values(found, table)
        for number, entry in table.entries.items():
            if entry.kind == _FREE:
                if number in values or (number and number in self._known):
                    raise OddError(f"object {number} is free by the table, and stands there")
            elif places.get(number) != entry:
                raise OddError(f"object {number} is not where the table says")
        own = {each.number for each in found if each.start == table.start}
        if unlisted := places.keys() - own - {n for n, entry in table.entries.items() if entry.kind}:
            raise OddError(f"object {min(unlisted)} stands in no table")
        self._known |= values
        self._check_count(table, before)

    def _list_values(
        self, found: list[Indirect], table: _Table
    ) -> tuple[dict[int, Value], dict[int, TableEntry]]:
        """Return the objects of a revision by number, those packed in others too, and where each stands."""
        values, places = dict[int, Value](), dict[int, TableEntry]()

        def know(number: int, value: Value, place: TableEntry) -> None:
            if number in values:
                raise OddError(
                    f"object {number} ({_name_kind(value)}) stands there twice, and some viewers take the "
                    "one, some the other; ask for the file as it was issued"
                )
            values[number], places[number] = value, place

        for each in found:
            if each.generation:
                raise OddError(f"object {each.number} stands there in another generation")
            if _has_type(each, b"XRef") and each.start != table.start:
                raise OddError("it has a second table of its objects")
            know(each.number, each.value, TableEntry(_PLAIN, each.start, 0))
        for each in found:
            if _has_type(each, b"ObjStm"):
                for index, (number, value) in enumerate(self._list_packed(each)):
                    know(number, value, TableEntry(_PACKED, each.number, index))
        return values, places

    def _check_count(self, table: _Table, before: int | None) -> None:
        """Hold the stated number of objects against the numbers that there are, without any gap at first."""
        size = table.trailer.get(b"Size")
        numbers = {*self._known, *table.entries}
        if not isinstance(size, int) or size != max(numbers) + 1:
            raise OddError("its table states another number of objects than there are")
        if before is None and len(table.entries.keys() | {max(numbers)}) < size:
            raise OddError("its table leaves numbers out")

    def _list_packed(self, holder: Indirect) -> Iterator[tuple[int, Value]]:
        """Yield the objects that are packed in another one, which must fill it."""
        entries, data = holder.value, self._unpack(holder)
        assert isinstance(entries, dict)  # noqa: S101 - it has a type
        count, first = entries.get(b"N"), entries.get(b"First")
        odd = OddError(f"the objects that are packed in object {holder.number} are not as it states")
        if not isinstance(count, int) or not isinstance(first, int) or b"Extends" in entries:
            raise odd
        head = data[:first].split()
        if len(head) != 2 * count or not all(_WHOLE.fullmatch(each) for each in head):
            raise odd
        numbers, places = [int(each) for each in head[::2]], [int(each) + first for each in head[1::2]]
        end = first
        for number, place in zip(numbers, places, strict=True):
            if skip_space(data, end) != place:
                raise odd
            value, end = read_value(data, place)
            if isinstance(value, Reference):
                raise odd
            yield number, value
        if skip_space(data, end) != len(data):
            raise odd

    def _unpack(self, holder: Indirect) -> bytes:
        """Return the unpacked data of a table or of packed objects."""
        entries = holder.value
        assert isinstance(entries, dict)  # noqa: S101 - only such an object has data
        if holder.stream is None:
            raise OddError(f"object {holder.number} has no data")
        data = self._content[slice(*holder.stream)]
        packing = entries.get(b"Filter")
        if packing in (PdfName(b"FlateDecode"), [PdfName(b"FlateDecode")]):
            unpacking = zlib.decompressobj()
            try:
                data = unpacking.decompress(data, _LARGEST - self._unpacked + 1)
            except zlib.error as error:
                raise OddError(f"object {holder.number} cannot be unpacked") from error
            if not unpacking.eof or unpacking.unused_data:
                raise OddError(f"object {holder.number} is packed with more behind it, or without an end")
            data = _undo_prediction(data, entries.get(b"DecodeParms"), holder.number)
        elif packing is not None:
            raise OddError(f"object {holder.number} is packed as no certificate is")
        self._unpacked += len(data)
        return data

    def _look_for_others(self) -> None:
        """Refuse what would be found by a viewer that puts the file together anew, and was not found here."""
        begins = set(self._begins)
        for found in _LOOKED_FOR.finditer(self._content):
            if found[0].endswith(b"obj") and found[0] != b"endobj" and found.start() not in begins:
                raise OddError(f"an object that is none begins at byte {found.start()}")
        for word, count in ((b"endobj", len(begins)), (b"%PDF-", 1), (b"%!PS", 0)):
            if self._content.count(word) != count:
                raise OddError(f"{word.decode()} stands there where it marks nothing")


#: What objects are, by their types.
_KINDS = {
    PdfName(b"Annot"): "an annotation",
    PdfName(b"Catalog"): "the catalog",
    PdfName(b"EmbeddedFile"): "an attached file",
    PdfName(b"Filespec"): "the name of an attached file",
    PdfName(b"Font"): "a font",
    PdfName(b"FontDescriptor"): "a font",
    PdfName(b"Metadata"): "the metadata",
    PdfName(b"Page"): "a page",
    PdfName(b"Pages"): "the list of pages",
    PdfName(b"StructElem"): "a part of the structure",
    PdfName(b"XObject"): "a picture",
}


def _name_kind(value: Value) -> str:
    """Return what an object is, for those who do not know how a PDF is built."""
    if not isinstance(value, dict):
        return "a list" if isinstance(value, list) else "a value"
    kind = value.get(b"Type")
    if isinstance(kind, PdfName) and kind in _KINDS:
        return _KINDS[kind]
    if b"Producer" in value:
        return "what the file says of its origin"
    return "content, such as that of a page" if b"Length" in value else "a list of entries"


def _has_type(each: Indirect, name: bytes) -> bool:
    return isinstance(each.value, dict) and each.value.get(b"Type") == PdfName(name)


def _unpack_entries(trailer: dict[bytes, Value], data: bytes) -> dict[int, TableEntry]:
    """Return the entries of a packed table."""
    widths, size = trailer.get(b"W"), trailer.get(b"Size")
    sections = trailer.get(b"Index", [0, size])
    if (
        not isinstance(widths, list)
        or len(widths) != 3
        or not all(isinstance(each, int) and 0 < each <= _WIDEST for each in widths)
        or not isinstance(sections, list)
        or len(sections) % 2
        or not all(isinstance(each, int) and each >= 0 for each in sections)
    ):
        raise OddError("its packed table is built as no certificate's")
    columns = [each for each in widths if isinstance(each, int)]
    numbers = [each for each in sections if isinstance(each, int)]
    if sum(numbers[1::2]) > _MOST_OBJECTS:
        raise OddError(_TOO_MANY)
    if sum(numbers[1::2]) * sum(columns) != len(data):
        raise OddError("its packed table states another number of objects than it lists")
    entries: dict[int, TableEntry] = {}
    at = 0
    for first, count in zip(numbers[::2], numbers[1::2], strict=True):
        if entries and first <= next(reversed(entries)):
            raise OddError("the sections of its table are in no order")
        for number in range(first, first + count):
            row = []
            for width in columns:
                row.append(int.from_bytes(data[at : at + width]))
                at += width
            if row[0] not in {_FREE, _PLAIN, _PACKED}:
                raise OddError(f"the entry of object {number} in its table is of no known kind")
            entries[number] = TableEntry(row[0], row[1], row[2])
    return entries


def _undo_prediction(data: bytes, parameters: Value, number: int) -> bytes:
    """Return data that are stated as differences to the row above (PNG); as they are without such rows."""
    if parameters is None:
        return data
    stated = parameters if isinstance(parameters, dict) else {}
    columns = stated.get(b"Columns")
    is_known = stated.get(b"Predictor") in {12, 15} and stated.keys() <= {b"Columns", b"Predictor"}
    if not is_known or not isinstance(columns, int) or columns < 1 or len(data) % (columns + 1):
        raise OddError(f"object {number} is packed as no certificate is")
    rows, above = bytearray(), bytes(columns)
    for start in range(0, len(data), columns + 1):
        if data[start] not in {0, 2}:
            raise OddError(f"object {number} is packed as no certificate is")
        row = data[start + 1 : start + 1 + columns]
        if data[start]:
            row = bytes((one + other) & 0xFF for one, other in zip(row, above, strict=True))
        rows += row
        above = row
    return bytes(rows)


def _find_orphans(scanned: Scanned) -> Iterator[int]:
    """Yield the numbers of objects that say something and to which nothing leads.

    A viewer that puts a file together anew may take such an object for its beginning, or for a page.
    """
    met: set[int] = set()
    waiting: list[Value] = [scanned.trailer.get(key) for key in (b"Root", b"Info")]
    while waiting:
        each = waiting.pop()
        if isinstance(each, Reference):
            if each.number not in met:
                met.add(each.number)
                waiting.append(scanned.objects.get(each.number))
        elif isinstance(each, dict):
            waiting.extend(each.values())
        elif isinstance(each, list):
            waiting.extend(each)
    for number in sorted(scanned.objects.keys() - met):
        value = scanned.objects[number]
        kind = value.get(b"Type") if isinstance(value, dict) else None
        if value not in (None, {}, []) and kind not in {PdfName(b"XRef"), PdfName(b"ObjStm")}:
            yield number
