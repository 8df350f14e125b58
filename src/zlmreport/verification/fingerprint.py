"""Digests of parts of PDFs, whatever their objects are numbered and however they are packed."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator, Mapping
from itertools import zip_longest
from typing import Any, TypeAlias

from zlmreport.errors import InputError, Place
from zlmreport.verification.carrier import PACKING, TooLargeError, unpack
from zlmreport.verification.shape import is_of_signature

#: An object of pypdf.
PdfObject: TypeAlias = Any

#: Of the streams of one document, in bytes.
_LARGEST = 256 * 1024 * 1024
_MOST_OBJECTS = 2_000_000
#: How streams are packed, and what leads back up or is counted over the whole file.
_LEFT_OUT = PACKING | {"/Parent", "/ParentTree", "/ParentTreeNextKey", "/StructParent", "/StructParents"}
#: Lists to which a signature adds; one alone may stand there without a list.
_EXTENDED_BY_SIGNATURES = frozenset({"/Annots", "/K"})


class Fingerprints:
    """Digests of the parts of one document.

    `pages`: Numbers of the pages by the numbers of their objects: a part that leads to a page does not hold
        it.
    """

    def __init__(self, pages: Mapping[int, int], place: Place) -> None:
        self._pages = pages
        self._place = place
        self._objects = 0
        self._size = 0
        self._streams: dict[int, bytes] = {}

    def compute_digest(self, part: PdfObject, without: frozenset[str] = frozenset()) -> str:
        """Return the digest of an object with all that it leads to, but for what stands under some keys."""
        digest = hashlib.sha256()
        for each in self._list_tokens(part, without):
            digest.update(each if type(each) is bytes else f"{each!r};".encode("utf-8", "replace"))
        return digest.hexdigest()

    def is_like(
        self, part: PdfObject, other: Fingerprints, part_of_other: PdfObject, tolerance: float
    ) -> bool:
        """Whether two objects of two documents are the same, but for numbers that differ a little.

        Whole numbers count and name things: they must agree.
        """
        ours, theirs = self._list_tokens(part), other._list_tokens(part_of_other)
        return all(_is_like(one, two, tolerance) for one, two in zip_longest(ours, theirs, fillvalue=None))

    def _list_tokens(self, part: PdfObject, without: frozenset[str] = frozenset()) -> Iterator[Any]:
        """Yield what an object is made of, marks as bytes.

        The objects are walked without recursion: a foreign file may nest them as deep as it likes.
        """
        from pypdf.generic import DictionaryObject, IndirectObject  # noqa: PLC0415 - slow to load

        met: dict[int, int] = {}
        waiting: list[Any] = [part]
        while waiting:
            each = waiting.pop()
            self._count()
            if isinstance(each, IndirectObject):
                number = each.idnum
                if number in self._pages:
                    yield f"page {self._pages[number]};".encode()
                elif number in met:
                    yield f"again {met[number]};".encode()
                else:
                    met[number] = len(met)
                    waiting.append(each.get_object())
            elif isinstance(each, DictionaryObject):
                waiting.extend(reversed(list(self._list_entries(each, without))))
            elif isinstance(each, list):
                waiting.extend((b"]", *reversed(each), b"["))
            else:
                yield each

    def _list_entries(self, dictionary: PdfObject, without: frozenset[str]) -> Iterator[Any]:
        """Yield what a dictionary is made of: marks as bytes, and objects."""
        yield b"<<"
        if hasattr(dictionary, "get_data"):
            yield self._digest_stream(dictionary)
        for key in sorted(dictionary):
            value = dictionary.raw_get(key)
            if key in _EXTENDED_BY_SIGNATURES:
                found = value.get_object()
                items = found if isinstance(found, list) else [value]
                value = [item for item in items if not is_of_signature(item.get_object())]
                if not value:
                    continue
            if key not in _LEFT_OUT and key not in without:
                yield f"{key}=".encode()
                yield value
        yield b">>"

    def _digest_stream(self, stream: PdfObject) -> bytes:
        """Return the digest of a stream's unpacked bytes."""
        key = id(stream)
        if key not in self._streams:
            try:
                content = unpack(stream, _LARGEST - self._size)
            except TooLargeError as error:
                raise InputError.at(
                    self._place, f"comes to more than {_LARGEST >> 20} MiB; no certificate does"
                ) from error
            self._size += len(content)
            self._streams[key] = hashlib.sha256(content).digest()
        return self._streams[key]

    def _count(self) -> None:
        self._objects += 1
        if self._objects > _MOST_OBJECTS:
            raise InputError.at(self._place, "holds more objects than any certificate")


def _is_like(one: Any, other: Any, tolerance: float) -> bool:
    if isinstance(one, float) or isinstance(other, float):
        try:
            return abs(float(one) - float(other)) <= tolerance
        except (TypeError, ValueError):
            return False
    return type(one) is type(other) and bool(one == other)
