"""A PAdES signature (ETSI EN 319 142-1, level B-B) that leaves PDF/A-3a and PDF/UA-1 as they are."""

from __future__ import annotations

from io import BytesIO
from typing import Any

from pkcs11.exceptions import PKCS11Error
from pyhanko.pdf_utils.generic import ArrayObject, DictionaryObject, IndirectObject, NameObject, NumberObject
from pyhanko.pdf_utils.incremental_writer import IncrementalPdfFileWriter
from pyhanko.sign.fields import MDPPerm, SigFieldSpec, SigSeedSubFilter, append_signature_field
from pyhanko.sign.general import SigningError
from pyhanko.sign.signers import PdfSignatureMetadata, PdfSigner

from zlmreport.errors import AccessError, Place

_FIELD = "Signature"
_DIGEST = "sha256"


class Pades:
    """Signs with a key of pyHanko's.

    Called with the bytes of a PDF and the name of the signature for people, it returns the signed PDF.
    The signature is appended, covers the whole file, and allows no change after it. `place` is where the
    key is named, for messages.
    """

    def __init__(self, key: Any, place: Place) -> None:
        self._key = key
        self._place = place

    def __call__(self, pdf: bytes, name: str) -> bytes:
        """Return the signed PDF."""
        writer = _Increment(BytesIO(pdf if pdf.endswith(b"\n") else pdf + b"\n"))
        append_signature_field(writer, SigFieldSpec(_FIELD, readable_field_name=name))
        _tag(writer, writer.root["/AcroForm"]["/Fields"].raw_get(-1))
        settings = PdfSignatureMetadata(
            field_name=_FIELD,
            md_algorithm=_DIGEST,
            subfilter=SigSeedSubFilter.PADES,
            certify=True,
            docmdp_permissions=MDPPerm.NO_CHANGES,
        )
        try:
            signed: bytes = PdfSigner(settings, self._key).sign_pdf(writer).getvalue()
        except (PKCS11Error, SigningError) as error:
            raise AccessError.at(
                self._place, f"the key did not sign: {str(error) or type(error).__name__}"
            ) from error
        return signed


class _Increment(IncrementalPdfFileWriter):  # type: ignore[misc]
    """What is appended to a PDF: nothing but what is asked for.

    pyHanko would write the metadata anew with the time of signing, in a form that PDF/A does not allow.
    """

    def _update_meta(self) -> None:
        pass


def _tag(writer: Any, widget: IndirectObject) -> None:
    """Give the signature's widget a place at the end of a tagged document's structure, as PDF/UA asks."""
    if "/StructTreeRoot" not in writer.root:
        return
    root = writer.root["/StructTreeRoot"]
    document = root["/K"].raw_get(0)
    places = root["/ParentTree"]["/Nums"]
    place = NumberObject(places[-2] + 1)
    field = widget.get_object()
    page = field.raw_get("/P")
    reference = writer.add_object(_dictionary(Type=NameObject("/OBJR"), Obj=widget, Pg=page))
    form = writer.add_object(
        _dictionary(
            Type=NameObject("/StructElem"),
            S=NameObject("/Form"),
            P=document,
            Pg=page,
            K=ArrayObject([reference]),
        )
    )
    field[NameObject("/StructParent")] = place
    document.get_object()["/K"].append(form)
    places.extend([place, form])
    writer.mark_update(document)
    writer.update_container(places)


def _dictionary(**entries: Any) -> Any:
    return DictionaryObject({NameObject(f"/{name}"): value for name, value in entries.items()})
