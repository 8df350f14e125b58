"""What a signature adds to a PDF: its field that nobody sees, its place in the structure, and its proofs."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

_FIELD = frozenset(
    {"/F", "/FT", "/P", "/Parent", "/Rect", "/StructParent", "/Subtype", "/T", "/TU", "/Type", "/V"}
)
_PLACE = frozenset({"/K", "/P", "/Pg", "/S", "/Type"})
_SIGNATURE = frozenset(
    {
        "/ByteRange",
        "/Contents",
        "/Filter",
        "/Location",
        "/M",
        "/Name",
        "/Prop_Build",
        "/Reason",
        "/Reference",
        "/SubFilter",
        "/Type",
    }
)
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
        kids: Any = item.get("/K", ())
        kids = kids.get_object() if hasattr(kids, "get_object") else kids
        references = kids if isinstance(kids, list) else [kids]
        return all(_leads_to_field(each.get_object()) for each in references)
    return False


def _leads_to_field(reference: Any) -> bool:
    if not isinstance(reference, dict) or reference.get("/Type") != "/OBJR" or "/Obj" not in reference:
        return False
    field = reference["/Obj"].get_object()
    return bool(isinstance(field, dict) and field.get("/Subtype") == "/Widget" and is_of_signature(field))


def strangers(reader: Any, *, is_signed: bool) -> Iterator[str]:
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
