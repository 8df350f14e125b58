"""Compares the pages of a certificate with the pages that its attachments give, printed again."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from difflib import SequenceMatcher
from functools import cached_property
from typing import Any
from xml.etree import ElementTree as ET

from zlmreport.verification import raster, shape
from zlmreport.verification.carrier import PACKING, Carrier, find_value, guard, unpack
from zlmreport.verification.findings import CheckedStatement, VerificationVerdict, name_first_of
from zlmreport.verification.fingerprint import Fingerprints
from zlmreport.verification.fonts import show_the_same
from zlmreport.verification.marks import TOLERANCE, DrawnMark, ForeignError, list_marks

#: Words of a page that are compared, and differences of a page that are told.
_MOST_WORDS = 5000
_MOST_DIFFERENCES = 4
_LONGEST_PASSAGE = 60
#: Programs that save a file again and draw nothing anew; whatever else stands there is read as a statement.
_SAVED_BY = re.compile(r"(pypdf|pikepdf|qpdf)( \d{1,3}(\.\d{1,3}){0,3})?", re.ASCII)

#: Metadata, and the most that they may be unpacked to.
_XMP = "/Metadata"
_LARGEST_XMP = 1 << 20
#: XML in the frame of XMP, and no other instructions for programs.
_PACKET = re.compile(rb"\s*<\?xpacket begin=[^?]*\?>(?:[^<]|<(?!\?))*<\?xpacket end=[^?]*\?>\s*")

_COLOURS = "/ColorSpace"
#: What of a page is compared mark by mark, and link by link.
_DRAWN = frozenset({"/Annots", "/Contents", "/Resources"})
#: What else there is of a page, by the keys that say so.
_FRAMING = {
    **dict.fromkeys(("/MediaBox", "/CropBox", "/BleedBox", "/TrimBox", "/ArtBox"), "size"),
    "/Rotate": "rotation",
    "/UserUnit": "unit of length",
}
_RESOURCES = {"/Font": "fonts", "/XObject": "pictures", "/ColorSpace": "colours"}
#: What a certificate consists of beside its pages and attachments, by the keys of the catalog and of its
#: lists of names. A part that is not among them is none of a certificate, whoever prints it.
_PARTS = {
    "/Dests": "targets of links",
    "/Lang": "language",
    "/MarkInfo": "marks of the structure",
    "/Metadata": "metadata (XMP)",
    "/Outlines": "bookmarks",
    "/OutputIntents": "colours",
    "/StructTreeRoot": "structure with alternative texts",
    "/ViewerPreferences": "what a viewer shows in its title",
}
#: Compared page by page and file by file, or added by a signature.
_NOT_COMPARED = shape.OF_SIGNATURES | {"/AF", "/EmbeddedFiles", "/Names", "/Pages", "/Type"}


@dataclass(frozen=True, slots=True)
class ComparedPages:
    """What came of two documents."""

    #: pages and document: The findings.
    pages: tuple[CheckedStatement, ...]
    document: tuple[CheckedStatement, ...]
    #: Whether some page is the same, stroke for stroke. If none is, other libraries printed the document, or
    #: every page is altered: then each mark of each page is compared.
    is_drawn_alike: bool
    #: Whether every page is.
    is_same: bool = True


def compare(carrier: Carrier, again: Prints, *, is_signed: bool) -> ComparedPages:
    """Compare a document with the same one printed again, page by page and part by part.

    `is_signed` says whether it may have what belongs to a signature.
    """
    return guard(lambda: _Comparison(Prints(carrier), again).compare(is_signed=is_signed), carrier.place)


class _Comparison:
    """Two documents, the certificate and the one printed again, with the digests of their pages."""

    def __init__(self, prints: Prints, again: Prints) -> None:
        self._prints = prints
        self._prints_again = again
        self._pages = prints.pages
        self._pages_again = again.pages
        self._is_drawn_alike = bool(set(self._pages) & set(self._pages_again))
        self._same: dict[tuple[str, str], bool] = {}

    def compare(self, *, is_signed: bool) -> ComparedPages:
        structure = shape.compare(self._prints.carrier, self._prints_again.traits, is_signed=is_signed)
        document = (structure, *self._compare_document())
        pages = tuple(self._compare_pages())
        if all(each.verdict is VerificationVerdict.HOLDS for each in (*pages, *document)):
            pages = self._look_at(pages)
        return ComparedPages(pages, document, self._is_drawn_alike, self._pages == self._pages_again)

    def _look_at(self, pages: tuple[CheckedStatement, ...]) -> tuple[CheckedStatement, ...]:
        """Return what is found of pages that are the same on paper, looked at as a viewer shows them."""
        is_alike = list(map(str.__eq__, self._pages, self._pages_again))
        content, again = self._prints.carrier.content, self._prints_again.carrier.content
        differing = raster.compare(content, again, is_alike)
        return tuple(differing.get(number, finding) for number, finding in enumerate(pages))

    def _compare_pages(self) -> Iterator[CheckedStatement]:
        """Yield a finding for each page; pages that were put in or taken out shift those that follow."""
        matched = SequenceMatcher(None, self._pages, self._pages_again, autojunk=False)
        for kind, first, end, first_again, end_again in matched.get_opcodes():
            common = min(end - first, end_again - first_again)
            for number, number_again in zip(range(first, end), range(first_again, end_again), strict=False):
                if kind == "equal":
                    yield self._compare_resources(number, number_again)
                else:
                    yield self._describe_altered(number, number_again)
            for number in range(first + common, end):
                yield CheckedStatement.of(_say_page(number), "is no page of this certificate")
            for number in range(first_again + common, end_again):
                yield CheckedStatement.of(_say_page(number), "is missing")

    def _compare_resources(self, number: int, number_again: int) -> CheckedStatement:
        """Return whether a page of the same strokes is drawn with the same fonts and pictures."""
        used = self._prints.list_resources(number)
        again = self._prints_again.list_resources(number_again)
        differing = [
            name
            for name in (*again, *(name for name in used if name[0] == _COLOURS))
            if name not in used
            or name not in again
            or not self._is_same_resource(name, used[name], again[name])
        ]
        kinds = [_RESOURCES.get(kind, kind) for kind, _ in differing[:1]]
        return CheckedStatement.of(_say_page(number), f"its {kinds[0]} differ" if kinds else "")

    def _is_same_resource(self, name: tuple[str, str], used: Any, again: Any) -> bool:
        digests = self._prints.compute_digest(used), self._prints_again.compute_digest(again)
        if digests not in self._same:
            is_font = name[0] == "/Font"
            self._same[digests] = digests[0] == digests[1] or (
                is_font
                and show_the_same(
                    used.get_object(),
                    again.get_object(),
                    self._prints.compute_digest,
                    self._prints_again.compute_digest,
                    completely=self._pages == self._pages_again,
                )
            )
        return self._same[digests]

    def _describe_altered(self, number: int, number_again: int) -> CheckedStatement:
        """Return what is to be said of a page that is not the same, stroke for stroke."""
        subject = _say_page(number)
        if not self._prints.is_framed_like(number, self._prints_again, number_again):
            differing = self._prints.list_framing_differences(number, self._prints_again, number_again)
            return CheckedStatement.of(subject, f"not as printed again: its {', its '.join(differing)}")
        try:
            drawn, drawn_again = self._prints.list_marks(number), self._prints_again.list_marks(number_again)
        except (ForeignError, ValueError, RecursionError) as error:
            return CheckedStatement.of(subject, f"is drawn as no certificate is: {error}")
        is_same = len(drawn) == len(drawn_again) and all(map(DrawnMark.is_as, drawn, drawn_again))
        if is_same and all(map(DrawnMark.is_where, drawn, drawn_again)):
            return CheckedStatement(subject, VerificationVerdict.HOLDS)
        words, words_again = self._prints.list_words(number), self._prints_again.list_words(number_again)
        differences = list(_find_differences(words, words_again))
        if differences:
            return CheckedStatement(
                subject, VerificationVerdict.DIFFERS, name_first_of(differences, _MOST_DIFFERENCES)
            )
        if is_same and not self._is_drawn_alike:
            return CheckedStatement(
                subject,
                VerificationVerdict.OPEN,
                "the same is drawn, but not where it is printed again: look at it",
            )
        return CheckedStatement.of(subject, "its words are the same, but it is drawn otherwise")

    def _compare_document(self) -> Iterator[CheckedStatement]:
        """Yield what else a document holds, part by part."""
        stated, again = self._prints.parts, self._prints_again.parts
        for key in sorted({*stated, *again}):
            if key not in _PARTS:
                difference = "is no part of a certificate"
            elif key not in again:
                difference = "is added"
            elif key not in stated:
                difference = "is missing"
            else:
                is_same = self._is_same_part(stated[key], again[key]) or (
                    key == _XMP and self._is_same_xmp(stated[key], again[key])
                )
                difference = "" if is_same else "is not what is printed again"
            yield CheckedStatement.of(_PARTS.get(key, key), difference)
        yield from _check_metadata(self._prints.carrier.metadata, self._prints_again.carrier.metadata)

    def _is_same_xmp(self, stated: Any, again: Any) -> bool:
        """Whether metadata say the same: programs that save a file again write their XML anew."""
        streams = [each.get_object() for each in (stated, again)]
        kinds = [{key: value for key, value in each.items() if key not in PACKING} for each in streams]
        said = [_read_xmp(unpack(each, _LARGEST_XMP)) for each in streams]
        return kinds[0] == kinds[1] and said[0] is not None and said[0] == said[1]

    def _is_same_part(self, stated: Any, again: Any) -> bool:
        if self._prints.compute_digest(stated) == self._prints_again.compute_digest(again):
            return True
        return not self._is_drawn_alike and self._prints.is_like(stated, self._prints_again, again)


class Prints:
    """What is compared of a document: the digests of its pages and parts, how it is built, and what it draws.

    Each is found when it is first asked for.
    """

    def __init__(self, carrier: Carrier) -> None:
        self.carrier = carrier
        self._reader = carrier.reader
        self._known: dict[int, str] = {}
        self._fonts: dict[str, Any] = {}
        self._marks: dict[int, list[DrawnMark]] = {}
        pages = {page.indirect_reference.idnum: number for number, page in enumerate(self._reader.pages, 1)}
        self._fingerprints = Fingerprints(pages, carrier.place)

    def compute_digest(self, part: Any) -> str:
        """Return the digest of a part; one that has a number of its own is looked at once."""
        number = getattr(part, "idnum", None)
        if number is None:
            return self._fingerprints.compute_digest(part)
        if number not in self._known:
            self._known[number] = self._fingerprints.compute_digest(part)
        return self._known[number]

    @cached_property
    def pages(self) -> list[str]:
        """Return the digest of each page, of its strokes and links without the fonts and pictures it uses."""
        return [
            self._fingerprints.compute_digest(page, without=frozenset({"/Resources"}))
            for page in self._reader.pages
        ]

    def is_like(self, part: Any, other: Prints, part_of_other: Any) -> bool:
        """Whether two parts are the same but for places on the pages, which other libraries compute."""
        return self._fingerprints.is_like(part, other._fingerprints, part_of_other, TOLERANCE)

    def is_framed_like(self, number: int, other: Prints, number_of_other: int) -> bool:
        """Whether two pages are the same but for what they draw, and for the places of their links."""
        page, page_of_other = self._reader.pages[number], other._reader.pages[number_of_other]
        digests = (
            prints._fingerprints.compute_digest(each, without=_DRAWN)  # noqa: SLF001 - another of its kind
            for prints, each in ((self, page), (other, page_of_other))
        )
        return len(set(digests)) == 1 and self._has_like_links(page, other, page_of_other)

    def list_framing_differences(self, number: int, other: Prints, number_of_other: int) -> list[str]:
        """Return in what two pages differ that are not framed alike."""
        page, page_of_other = self._reader.pages[number], other._reader.pages[number_of_other]
        differing = [
            _FRAMING.get(key, key)
            for key in sorted({*page, *page_of_other} - _DRAWN)
            if self._digest_entry(page, key) != other._digest_entry(page_of_other, key)
        ]
        if not self._has_like_links(page, other, page_of_other):
            differing.append("links, notes or fields")
        return list(dict.fromkeys(differing)) or ["frame"]

    def _digest_entry(self, page: Any, key: str) -> str | None:
        return self._fingerprints.compute_digest(page.raw_get(key)) if key in page else None

    def _has_like_links(self, page: Any, other: Prints, page_of_other: Any) -> bool:
        return self.is_like(_read_links(page), other, _read_links(page_of_other))

    @cached_property
    def traits(self) -> frozenset[shape.Trait]:
        """How it is built."""
        return frozenset(shape.list_traits(self.carrier))

    def list_marks(self, number: int) -> list[DrawnMark]:
        """Return what a page draws."""
        if number not in self._marks:
            self._marks[number] = list_marks(self._reader.pages[number], self.compute_digest, self._fonts)
        return self._marks[number]

    def list_words(self, number: int) -> list[str]:
        """Return the words of a page in reading order."""
        text: str = self._reader.pages[number].extract_text()
        return text.split()[:_MOST_WORDS]

    def list_resources(self, number: int) -> dict[tuple[str, str], Any]:
        """Return what a page may draw with, by kind and name."""
        kinds: Any = self._reader.pages[number].get("/Resources", {}).get_object()
        return {
            (str(kind), str(name)): kinds[kind].raw_get(name)
            for kind in kinds
            if isinstance(kinds[kind], dict)
            for name in kinds[kind]
        }

    @cached_property
    def parts(self) -> dict[str, Any]:
        """Return each part beside pages and attachments, by its key."""
        root = self._reader.trailer["/Root"].get_object()
        names: Any = root["/Names"].get_object() if "/Names" in root else {}
        return {
            str(key): holder.raw_get(key)
            for holder in (root, names)
            for key in holder
            if key not in _NOT_COMPARED
        }


def _read_links(page: Any) -> Any:
    from pypdf.generic import ArrayObject  # noqa: PLC0415 - slow to load

    listed = find_value(page.get("/Annots", ()))
    return ArrayObject(each for each in listed if not shape.is_of_signature(each.get_object()))


def _say_page(number: int) -> str:
    return f"page {number + 1}"


def _find_differences(stated: list[str], again: list[str]) -> Iterator[str]:
    matched = SequenceMatcher(None, stated, again, autojunk=False)
    for kind, first, end, first_again, end_again in matched.get_opcodes():
        found, expected = _quote_passage(stated[first:end]), _quote_passage(again[first_again:end_again])
        if kind == "replace":
            yield f"{found} stands where {expected} is printed again"
        elif kind == "delete":
            yield f"{found} is added"
        elif kind == "insert":
            yield f"{expected} is missing"


def _quote_passage(found: list[str]) -> str:
    text = " ".join(found)
    return f"'{text if len(text) <= _LONGEST_PASSAGE else text[: _LONGEST_PASSAGE - 1] + '…'}'"


def _read_xmp(content: bytes) -> list[tuple[object, ...]] | None:
    """Return what metadata say, element by element; None where they are more than the elements of an XML."""
    if b"<!" in content or not _PACKET.fullmatch(content):
        return None
    try:
        root = ET.fromstring(content)  # noqa: S314 - without entities, and bounded
    except (ET.ParseError, ValueError):
        return None
    return [(each.tag, sorted(each.items()), each.text, each.tail, len(each)) for each in root.iter()]


def _check_metadata(stated: Mapping[str, str], again: Mapping[str, str]) -> Iterator[CheckedStatement]:
    """Yield the entries of the information dictionary; a program that saved it again may name itself."""
    for key in sorted({*stated, *again}):
        found, expected = stated.get(key), again.get(key)
        if key == "/Producer" and found is not None and _SAVED_BY.fullmatch(found):
            continue
        difference = "" if found == expected else f"{found!r} stands where {expected!r} is printed again"
        yield CheckedStatement.of(f"metadata: {key.removeprefix('/')}", difference)
