"""Refuses objects in a PDF that the same certificate, printed again, does not have.

The document that is printed again is the list of what is allowed: which entries its dictionaries have, of
what kind they are, and which names they have as values. A form, a script, a layer, a box that pages inherit,
an encoding of one's own: whatever a viewer might make of it, it is a difference. Beside it only a signature
of our own making is allowed, and streams that are packed otherwise.
"""

from __future__ import annotations

import re
import zlib
from collections.abc import Collection, Iterator
from typing import Any, TypeAlias

from zlmreport.errors import InputError
from zlmreport.verification.carrier import PACKING, Carrier, find_value
from zlmreport.verification.findings import CheckedStatement, name_first_of

#: Where an entry stands, its key, and what kind of value it has.
Trait: TypeAlias = tuple[str, str, str]
#: An object, what holds it, and under which key.
_Place: TypeAlias = tuple[Any, str, str]

_MOST_OBJECTS = 2_000_000
_MOST_TOLD = 4
_PIECE = 1 << 16
_SUBJECT = "structure of the file"
_PACKED = frozenset({"/FlateDecode"})
_PREDICTION = frozenset({"/BitsPerComponent", "/Colors", "/Columns", "/Predictor"})
#: Entries whose keys are names that a renderer gives.
_MAPS = frozenset({"/ColorSpace", "/ExtGState", "/Font", "/Pattern", "/Properties", "/Shading", "/XObject"})
#: Names of which a part is given by chance.
_NAMES_BY_CHANCE = frozenset({"/BaseFont", "/FontName"})
#: Added by a signature, and looked at with it.
OF_SIGNATURES = frozenset({"/AcroForm", "/DSS", "/Extensions", "/Perms", "/Version"})
#: Of the end of the file, which leads to everything else. What was there before belongs to a signature alone.
_TRAILER = frozenset({"/ID", "/Info", "/Root", "/Size"})
_TRAILER_PACKED = frozenset({"/DecodeParms", "/Filter", "/Index", "/Length", "/Type", "/W"})
_TRAILER_SIGNED = frozenset({"/Prev"})
_BEGIN = re.compile(rb"%PDF-\d\.\d[\r\n]")
_END = re.compile(rb"startxref\s+(\d+)\s+%%EOF\s*\Z")
_OBJECTS = re.compile(rb"\s*(xref\b|\d+\s+\d+\s+obj\b)")


def compare(carrier: Carrier, known: Collection[Trait], *, is_signed: bool) -> CheckedStatement:
    """Return whether a document is built of nothing but what the one printed again is built of."""
    told = [
        *_check_around(carrier.content),
        *_check_trailer(carrier.reader, is_signed=is_signed),
        *find_strangers(carrier.reader, is_signed=is_signed),
        *dict.fromkeys(_say(trait) for trait in list_traits(carrier) if trait not in known),
    ]
    return CheckedStatement.of(_SUBJECT, name_first_of(told, _MOST_TOLD))


def _check_around(content: bytes) -> Iterator[str]:
    if not _BEGIN.match(content):
        yield "something stands before the PDF"
    end = _END.search(content, max(0, len(content) - 4096))
    if end is None:
        yield "something stands behind the PDF"
    elif not _OBJECTS.match(content, int(end[1])):
        yield "the table of its objects is not where the file says"


def _check_trailer(reader: Any, *, is_signed: bool) -> Iterator[str]:
    """Yield what the end of the file has besides: viewers may be led to other objects by it."""
    known = _TRAILER | _TRAILER_PACKED | (_TRAILER_SIGNED if is_signed else frozenset())
    for key in sorted(reader.trailer.keys() - known):
        yield f"the end of the file has {key}, which may lead to other objects"


def _say(trait: Trait) -> str:
    where, key, kind = trait
    return f"{where} has {key} ({kind}), which is not printed again"


def list_traits(carrier: Carrier) -> Iterator[Trait]:
    """Yield what each dictionary that the document leads to has, and of what kind.

    The objects are walked without recursion: a foreign file may nest them as deep as it likes.
    """
    from pypdf.generic import IndirectObject  # noqa: PLC0415 - slow to load

    root = carrier.reader.trailer.raw_get("/Root")
    if root.get_object()["/Pages"].get("/Count") != len(carrier.reader.pages):
        yield "the page tree", "/Count", "another number of pages"
    seen: set[int] = set()
    walked = 0
    waiting: list[_Place] = [(root, "the file", "/Root")]
    while waiting:
        value, where, key = waiting.pop()
        walked += 1
        if walked > _MOST_OBJECTS:
            raise InputError.at(carrier.place, "holds more objects than any certificate")
        is_met = False
        if isinstance(value, IndirectObject):
            if value.generation:
                yield where, key, "an object of another generation"
            is_met = value.idnum in seen
            seen.add(value.idnum)
            value = value.get_object()
        if is_of_signature(value):
            continue
        yield where, key, _find_kind(value, key)
        if not is_met:
            waiting.extend(_list_inside(value, where, key))
            yield from _find_packing(value, key)


def _list_inside(value: Any, where: str, key: str) -> Iterator[_Place]:
    """Yield what stands in a dictionary or a list."""
    if isinstance(value, list):
        yield from ((item, where, f"{key} []") for item in value)
    elif isinstance(value, dict):
        dictionary: Any = value
        left_out = PACKING | (OF_SIGNATURES if where == "the file" else frozenset())
        for inner in sorted(dictionary):  # so that an object that two lead to is met on the same way
            if inner not in left_out:
                named = _name_entry(inner, key, is_map=key in _MAPS)
                yield dictionary.raw_get(inner), _find_role(dictionary, key), named


def _name_entry(key: str, holder: str, *, is_map: bool) -> str:
    """Return the key of an entry, or a mark for a name that a renderer gave; a default colour rules all."""
    return f"{holder}/*" if is_map and not key.startswith("/Default") else key


def _find_role(dictionary: Any, key: str) -> str:
    names = (str(dictionary.get(name, "")) for name in ("/Type", "/Subtype", "/S"))
    stream = "stream " if hasattr(dictionary, "get_data") else ""
    return f"{stream}{key}{''.join(names)}" if "/Type" not in dictionary else f"{stream}{''.join(names)}"


def _find_packing(stream: Any, key: str) -> Iterator[Trait]:
    """Yield how a stream is packed, unless it is as any program packs."""
    if not hasattr(stream, "get_data"):
        return
    role = _find_role(stream, key)
    packing = stream.get("/Filter", [])
    for each in packing if isinstance(packing, list) else [packing]:
        if each not in _PACKED:
            yield role, "/Filter", str(each)
    parameters = stream.get("/DecodeParms", [])
    for each in parameters if isinstance(parameters, list) else [parameters]:
        for entry in getattr(each.get_object(), "keys", tuple)():
            if entry not in _PREDICTION:
                yield role, "/DecodeParms", str(entry)
    if packing == "/FlateDecode" and _has_more(stream._data):  # noqa: SLF001 - as it is packed
        yield role, "/FlateDecode", "data behind what is packed"


def _has_more(packed: bytes) -> bool:
    """Whether something stands behind packed data, which some viewers read on and others do not."""
    unpacking = zlib.decompressobj()
    waiting = packed
    while waiting and not unpacking.eof:  # piece by piece: what it unpacks to may be large
        unpacking.decompress(waiting, _PIECE)
        waiting = unpacking.unconsumed_tail
    return bool(unpacking.unused_data.strip())


def _find_kind(value: Any, key: str) -> str:
    if isinstance(value, dict):
        return _find_role(value, key)
    if isinstance(value, list):
        return "a list"
    from pypdf.generic import NameObject, NullObject, NumberObject  # noqa: PLC0415 - slow to load

    if isinstance(value, NameObject):
        return "a name" if key in _NAMES_BY_CHANCE else str(value)
    if isinstance(value, NullObject):
        return "nothing"
    return "a number" if isinstance(value, NumberObject | float) else type(value).__name__


_FIELD = frozenset(
    {"/F", "/FT", "/P", "/Parent", "/Rect", "/StructParent", "/Subtype", "/T", "/TU", "/Type", "/V"}
)
_PLACE = frozenset({"/K", "/P", "/Pg", "/S", "/Type"})
#: Of a signature: how it is made, and what it says of itself.
_MADE_BY = frozenset({"/ByteRange", "/Contents", "/Filter", "/Reference", "/SubFilter", "/Type"})
_SIGNATURE = _MADE_BY | {"/Location", "/M", "/Name", "/Prop_Build", "/Reason"}
_FORM = frozenset({"/Fields", "/SigFlags"})
_PROOFS = frozenset({"/CRLs", "/Certs", "/OCSPs", "/Type", "/VRI"})
_PERMISSIONS = frozenset({"/DocMDP"})


def is_of_signature(item: Any) -> bool:
    """Whether an object is what a signature that nobody sees adds: its field, or its place in the structure.

    A field that takes room on a page, has an appearance or an action is none: it could cover what is printed
    there.
    """
    if not isinstance(item, dict):
        return False
    if item.get("/Subtype") == "/Widget" and item.get("/FT") == "/Sig":
        value = item.get("/V")
        value = value.get_object() if value is not None else None
        return (
            item.keys() <= _FIELD
            and isinstance(value, dict)
            and value.keys() <= _SIGNATURE
            and "/ByteRange" in value
            and list(map(float, item.get("/Rect", ()))) == [0.0] * 4
        )
    if item.get("/S") == "/Form" and item.keys() <= _PLACE:
        kids = find_value(item.get("/K", ()))
        references = kids if isinstance(kids, list) else [kids]
        return all(_is_leading_to_field(each.get_object()) for each in references)
    return False


def _is_leading_to_field(reference: Any) -> bool:
    if not isinstance(reference, dict) or reference.get("/Type") != "/OBJR" or "/Obj" not in reference:
        return False
    field = reference["/Obj"].get_object()
    return bool(isinstance(field, dict) and field.get("/Subtype") == "/Widget" and is_of_signature(field))


def find_strangers(reader: Any, *, is_signed: bool) -> Iterator[str]:
    """Yield what stands where a signature would stand, and belongs to none."""
    root = reader.trailer["/Root"].get_object()
    entries = {"/AcroForm": _FORM, "/DSS": _PROOFS, "/Perms": _PERMISSIONS}
    for key in (*entries, "/Extensions", "/Version"):
        if key not in root:
            continue
        if not is_signed:
            yield f"the catalog has {key}, and the file is not signed"
            continue
        value = root[key].get_object()
        if key in entries and (not isinstance(value, dict) or value.keys() - entries[key]):
            yield f"the catalog's {key} is none of a signature"
        elif key == "/AcroForm":
            fields = [each.get_object() for each in value.get("/Fields", [])]
            if not all(isinstance(each, dict) and is_of_signature(each) for each in fields):
                yield "the form has fields that are no signatures"
        elif key == "/Perms" and value["/DocMDP"].get_object().keys() - _SIGNATURE:
            yield "a permission is none of a signature"
