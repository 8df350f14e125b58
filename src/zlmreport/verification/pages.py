"""The pages of a certificate against the pages that its attachments give when they are printed again."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from difflib import SequenceMatcher
from typing import Any

from zlmreport.verification.carrier import Carrier, guarded
from zlmreport.verification.findings import Finding, Verdict
from zlmreport.verification.fingerprint import Fingerprints
from zlmreport.verification.fonts import show_the_same

#: Words of a page that are compared, and differences of a page that are told.
_MOST_WORDS = 5000
_MOST_DIFFERENCES = 4
_LONGEST_PASSAGE = 60

_RESOURCES = {"/Font": "fonts", "/XObject": "pictures", "/ColorSpace": "colours"}
_PARTS = {
    "/Dests": "targets of links",
    "/Lang": "language",
    "/Metadata": "metadata (XMP)",
    "/Outlines": "bookmarks",
    "/OutputIntents": "colours",
    "/StructTreeRoot": "structure with alternative texts",
}
#: Compared page by page and file by file, or added by a signature.
_NOT_COMPARED = frozenset(
    {
        "/AF",
        "/AcroForm",
        "/DSS",
        "/EmbeddedFiles",
        "/Extensions",
        "/Names",
        "/Pages",
        "/Perms",
        "/Type",
        "/Version",
    }
)


@dataclass(frozen=True, slots=True)
class Compared:
    """What came of two documents.

    Attributes
    ----------
    pages, document
        The findings.
    is_drawn_alike
        Whether some page is the same, stroke for stroke. If none is, other libraries printed the document:
        then its words are compared, and its drawing is left open.
    """

    pages: tuple[Finding, ...]
    document: tuple[Finding, ...]
    is_drawn_alike: bool


def compare(carrier: Carrier, again: Carrier) -> Compared:
    """Compare a document with the same one printed again, page by page and part by part."""
    return guarded(lambda: _Comparison(carrier, again).compared(), carrier.place)


def words(carrier: Carrier, number: int) -> list[str]:
    """Return the words of a page in reading order."""
    text: str = carrier.reader.pages[number].extract_text()
    return text.split()[:_MOST_WORDS]


class _Comparison:
    """Two documents, the certificate and the one printed again, with the digests of their pages."""

    def __init__(self, carrier: Carrier, again: Carrier) -> None:
        self._carrier = carrier
        self._again = again
        self._prints = _Prints(carrier)
        self._prints_again = _Prints(again)
        self._pages = self._prints.of_pages()
        self._pages_again = self._prints_again.of_pages()
        self._is_drawn_alike = bool(set(self._pages) & set(self._pages_again))
        self._same: dict[tuple[str, str], bool] = {}

    def compared(self) -> Compared:
        return Compared(tuple(self._of_pages()), tuple(self._of_document()), self._is_drawn_alike)

    def _of_pages(self) -> Iterator[Finding]:
        """Yield a finding for each page; pages that were put in or taken out shift those that follow."""
        matched = SequenceMatcher(None, self._pages, self._pages_again, autojunk=False)
        for kind, first, end, first_again, end_again in matched.get_opcodes():
            common = min(end - first, end_again - first_again)
            for number, number_again in zip(range(first, end), range(first_again, end_again), strict=False):
                if kind == "equal":
                    yield self._drawn_with(number, number_again)
                else:
                    yield self._altered(number, number_again)
            for number in range(first + common, end):
                yield Finding(_page(number), Verdict.DIFFERS, "is no page of this certificate")
            for number in range(first_again + common, end_again):
                yield Finding(_page(number), Verdict.DIFFERS, "is missing")

    def _drawn_with(self, number: int, number_again: int) -> Finding:
        """Return whether a page of the same strokes is drawn with the same fonts and pictures."""
        used = self._prints.resources(number)
        for name, again in self._prints_again.resources(number_again).items():
            if name not in used or not self._is_same_resource(name, used[name], again):
                return Finding(
                    _page(number), Verdict.DIFFERS, f"its {_RESOURCES.get(name[0], name[0])} differ"
                )
        return Finding(_page(number), Verdict.HOLDS)

    def _is_same_resource(self, name: tuple[str, str], used: Any, again: Any) -> bool:
        digests = self._prints.of(used), self._prints_again.of(again)
        if digests not in self._same:
            is_font = name[0] == "/Font"
            self._same[digests] = digests[0] == digests[1] or (
                is_font
                and show_the_same(
                    used.get_object(), again.get_object(), completely=self._pages == self._pages_again
                )
            )
        return self._same[digests]

    def _altered(self, number: int, number_again: int) -> Finding:
        """Return what is to be said of a page that is not the same, stroke for stroke."""
        subject = _page(number)
        if _draws_forms(self._carrier, number) and not _draws_forms(self._again, number_again):
            # Their text is not looked for: forms that draw forms that draw forms are read without end.
            return Finding(subject, Verdict.DIFFERS, "something is drawn on it that is not printed again")
        differences = list(_differences(words(self._carrier, number), words(self._again, number_again)))
        if differences:
            shown = "; ".join(differences[:_MOST_DIFFERENCES])
            more = len(differences) - _MOST_DIFFERENCES
            return Finding(subject, Verdict.DIFFERS, shown + (f"; and {more} more" if more > 0 else ""))
        if self._is_drawn_alike:
            return Finding(subject, Verdict.DIFFERS, "its words are the same, but it is drawn otherwise")
        return Finding(subject, Verdict.OPEN, "its words are the same; its drawing is not compared")

    def _of_document(self) -> Iterator[Finding]:
        """Yield what else a document holds, part by part."""
        otherwise = Verdict.DIFFERS if self._is_drawn_alike else Verdict.OPEN
        stated, again = self._prints.of_parts(), self._prints_again.of_parts()
        for key in sorted({*stated, *again}):
            subject = _PARTS.get(key, key)
            if stated.get(key) == again.get(key):
                yield Finding(subject, Verdict.HOLDS)
            elif key not in again:
                yield Finding(subject, Verdict.DIFFERS, "is added")
            else:
                yield Finding(
                    subject, otherwise, "is not what is printed again" if key in stated else "is missing"
                )
        yield from _metadata(self._carrier.metadata, self._again.metadata)


class _Prints:
    """The digests of a document's pages and parts."""

    def __init__(self, carrier: Carrier) -> None:
        self._reader = carrier.reader
        self._known: dict[int, str] = {}
        pages = {page.indirect_reference.idnum: number for number, page in enumerate(self._reader.pages, 1)}
        self._fingerprints = Fingerprints(pages, carrier.place)

    def of(self, part: Any) -> str:
        """Return the digest of a part; one that has a number of its own is looked at once."""
        number = getattr(part, "idnum", None)
        if number is None:
            return self._fingerprints.of(part)
        if number not in self._known:
            self._known[number] = self._fingerprints.of(part)
        return self._known[number]

    def of_pages(self) -> list[str]:
        """Return the digest of each page, of its strokes and links without the fonts and pictures it uses."""
        return [self._fingerprints.of(page, without=frozenset({"/Resources"})) for page in self._reader.pages]

    def resources(self, number: int) -> dict[tuple[str, str], Any]:
        """Return what a page may draw with, by kind and name."""
        kinds: Any = self._reader.pages[number].get("/Resources", {}).get_object()
        return {
            (str(kind), str(name)): kinds[kind].raw_get(name)
            for kind in kinds
            if isinstance(kinds[kind], dict)
            for name in kinds[kind]
        }

    def of_parts(self) -> dict[str, str]:
        """Return the digest of each part beside pages and attachments, by its key."""
        root = self._reader.trailer["/Root"].get_object()
        names: Any = root["/Names"].get_object() if "/Names" in root else {}
        parts: dict[str, Any] = {
            str(key): holder.raw_get(key)
            for holder in (root, names)
            for key in holder
            if key not in _NOT_COMPARED
        }
        return {key: self.of(part) for key, part in parts.items()}


def _page(number: int) -> str:
    return f"page {number + 1}"


def _draws_forms(carrier: Carrier, number: int) -> bool:
    resources = carrier.reader.pages[number].get("/Resources", {}).get_object()
    objects = resources["/XObject"].get_object() if "/XObject" in resources else {}
    return any(objects[name].get("/Subtype") == "/Form" for name in objects)


def _differences(stated: list[str], again: list[str]) -> Iterator[str]:
    matched = SequenceMatcher(None, stated, again, autojunk=False)
    for kind, first, end, first_again, end_again in matched.get_opcodes():
        found, expected = _passage(stated[first:end]), _passage(again[first_again:end_again])
        if kind == "replace":
            yield f"{found} stands where {expected} is printed again"
        elif kind == "delete":
            yield f"{found} is added"
        elif kind == "insert":
            yield f"{expected} is missing"


def _passage(found: list[str]) -> str:
    text = " ".join(found)
    return f"'{text if len(text) <= _LONGEST_PASSAGE else text[: _LONGEST_PASSAGE - 1] + '…'}'"


def _metadata(stated: Mapping[str, str], again: Mapping[str, str]) -> Iterator[Finding]:
    """Yield the entries of the information dictionary; the library that wrote the file is no part of it."""
    for key in sorted({*stated, *again} - {"/Producer"}):
        found, expected = stated.get(key), again.get(key)
        subject = f"metadata: {key.removeprefix('/')}"
        if found == expected:
            yield Finding(subject, Verdict.HOLDS)
        else:
            yield Finding(subject, Verdict.DIFFERS, f"{found!r} stands where {expected!r} is printed again")
