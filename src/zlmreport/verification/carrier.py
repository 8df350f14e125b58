"""Opens a PDF that somebody sent, without trust: limits of size and pages, its attachments.

Streams are unpacked as they are: what is damaged is refused, and what has no end is cut off.
"""

from __future__ import annotations

import contextlib
import logging
import re
import zlib
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace
from io import BytesIO
from pathlib import Path
from typing import Any, TypeVar

from zlmreport.document.certificate.attachments import LARGEST_TOTAL, MOST_ATTACHMENTS
from zlmreport.errors import InputError, Place
from zlmreport.files import demand
from zlmreport.verification.transport import find_damage, find_wrapping

#: Of a PDF, in bytes; a certificate has some hundred thousand, and its attachments.
LARGEST = 2 * LARGEST_TOTAL
MOST_PAGES = 2000
#: Nodes of the tree of attachments that are looked at.
_MOST_NODES = 1000
_LONGEST_NAME = 200
#: What no name of an attachment has: parts of a path, and what is not seen.
_UNSAFE = re.compile(r"[\x00-\x1f\x7f-\x9f/\\\u200e\u200f\u202a-\u202e\u2066-\u2069]|\A\.+\Z|\A\Z")

#: Of a stream: how it is packed; looked at on its own.
PACKING = frozenset({"/DecodeParms", "/Filter", "/Length"})

Read = TypeVar("Read")


@dataclass(frozen=True, slots=True)
class Carried:
    """A file inside a PDF, as the PDF describes it.

    `checksum` is the MD5 digest that the PDF states, hexadecimal, and empty if it states none; `size` and
    `dates` are those that it states. `listed` are the names under which it stands in the list of names, and
    `associated` is how often it stands among the associated files. `entries` are the keys of all that
    describes it.
    """

    name: str
    content: bytes = field(repr=False)
    relationship: str
    description: str
    media_type: str
    checksum: str
    size: str = ""
    dates: tuple[str, ...] = ()
    listed: tuple[str, ...] = ()
    associated: int = 1
    entries: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Carrier:
    """An opened PDF."""

    place: Place  #: The file, for messages.
    content: bytes = field(repr=False)  #: Its bytes.
    reader: Any  #: The opened PDF, a `pypdf.PdfReader`.
    carried: dict[str, Carried]  #: Its attachments, by name.
    metadata: dict[str, str]  #: The entries of its information dictionary.

    @property
    def creator(self) -> str:
        """The program that the PDF says it was made by."""
        return str(self.metadata.get("/Creator", ""))


def read_file(path: Path) -> bytes:
    """Return the bytes of a PDF file, without zeros that filled the last block of a transfer or a disk.

    Raises `AccessError` if it cannot be read; `InputError` if it is no PDF, or larger than any certificate.
    """
    place = Place(str(path))
    content = demand(path, LARGEST)
    if len(content) > LARGEST:
        raise InputError.at(place, f"is larger than {LARGEST >> 20} MiB; no certificate is")
    if wrapping := find_wrapping(content):
        raise InputError.at(place, f"is no PDF, but {wrapping}")
    if b"%PDF-" not in content[:1024]:
        raise InputError.at(place, "is no PDF; verify takes a certificate, such as CAL-2026-0117.pdf")
    return content.rstrip(b"\0")


def open_pdf(content: bytes, place: Place) -> Carrier:
    """Open a PDF and take out its attachments.

    Raises `InputError` if it is damaged or encrypted, or carries more than any certificate.
    """
    return guard(lambda: _open_carrier(content, place), place, content)


def find_results_in(path: Path) -> bytes | None:
    """Return the results file that a certificate carries; None if it carries none."""
    carried = open_pdf(read_file(path), Place(str(path))).carried.values()
    return next(
        (each.content for each in carried if each.relationship == "Data" and each.name.endswith(".json")),
        None,
    )


def guard(read: Callable[[], Read], place: Place, content: bytes = b"") -> Read:
    """Return what is read from a PDF and what it carries; whatever breaks on the way is said in one line.

    `content`: The bytes of the PDF, where it is opened: how they were damaged is said before what a reader
        stumbled over.
    """
    with silence_pypdf():
        try:
            return read()
        except InputError:
            raise
        except Exception as error:  # a foreign file may break its reader in any way
            reason = find_damage(content) or " ".join(str(error).split())[:200] or type(error).__name__
            message = f"is damaged, and cannot be read as a certificate: {reason}"
            raise InputError.at(place, message) from error


@contextlib.contextmanager
def silence_pypdf() -> Iterator[None]:
    """Keep what pypdf has to say of a damaged file from the terminal."""
    logger = logging.getLogger("pypdf")
    level = logger.level
    logger.setLevel(logging.CRITICAL + 1)
    try:
        yield
    finally:
        logger.setLevel(level)


def find_value(value: Any) -> Any:
    """Return what a reference of pypdf leads to; anything else as it is."""
    return value.get_object() if hasattr(value, "get_object") else value


def _open_carrier(content: bytes, place: Place) -> Carrier:
    from pypdf import PdfReader  # noqa: PLC0415 - slow to load

    # Strictly: of a key that stands twice, also under another spelling, one viewer takes this and one that.
    reader = PdfReader(BytesIO(content), strict=True)
    if reader.is_encrypted:
        raise InputError.at(
            place,
            "is encrypted, which no certificate is: verify the file as it was issued, or save this one "
            "without its password (qpdf --decrypt FILE NEW), and verify the new one",
        )
    if len(reader.pages) > MOST_PAGES:
        raise InputError.at(place, f"has more than {MOST_PAGES} pages; no certificate has")
    carried: dict[str, Carried] = {}
    room = LARGEST_TOTAL
    for specification, listed, associated in _list_specifications(reader, place):
        if len(carried) == MOST_ATTACHMENTS:
            raise InputError.at(place, f"carries more than {MOST_ATTACHMENTS} files; no certificate does")
        try:
            each = replace(_read_carried(specification, room, place), listed=listed, associated=associated)
        except TooLargeError as error:
            raise InputError.at(
                place, f"carries files of more than {LARGEST_TOTAL >> 20} MiB in all; no certificate does"
            ) from error
        room -= len(each.content)
        if each.name in carried:
            raise InputError.at(place, f"carries two files of the name {each.name!r}; no certificate does")
        carried[each.name] = each
    metadata = {str(key): str(value) for key, value in (reader.metadata or {}).items()}
    return Carrier(place, content, reader, carried, metadata)


def _list_specifications(reader: Any, place: Place) -> Iterator[tuple[Any, tuple[str, ...], int]]:
    """Yield each file specification that the document lists by name, or as associated with it.

    With it come the names under which it is listed, and how often it is associated with the document.
    """
    root = reader.trailer["/Root"].get_object()
    waiting = [root.get("/Names", {}).get_object().get("/EmbeddedFiles")] if "/Names" in root else []
    names: list[tuple[str, Any]] = []
    nodes = 0
    while waiting:
        node = waiting.pop()
        if node is None:
            continue
        nodes += 1
        if nodes > _MOST_NODES:
            raise InputError.at(place, "lists its attachments without end; no certificate does")
        node = node.get_object()
        pairs = list(node.get("/Names", ()))
        names.extend(zip(map(str, pairs[::2]), pairs[1::2], strict=True))
        waiting.extend(node.get("/Kids", ()))
    associated = list(root.get("/AF", ()))
    seen: set[Any] = set()
    for specification in (*(each for _, each in names), *associated):
        identity = _find_identity(specification)
        if identity not in seen:
            seen.add(identity)
            yield (
                specification.get_object(),
                tuple(name for name, each in names if _find_identity(each) == identity),
                sum(_find_identity(each) == identity for each in associated),
            )


def _find_identity(specification: Any) -> int:
    """Return what tells a file specification from others: its number, or where it lies in memory."""
    number: int | None = getattr(specification, "idnum", None)
    return id(specification) if number is None else number


def _read_carried(specification: Any, room: int, place: Place) -> Carried:
    name = str(specification.get("/UF") or specification.get("/F") or "")
    if _UNSAFE.search(name) or len(name) > _LONGEST_NAME:
        raise InputError.at(place, f"carries a file whose name is none: {name[:60]!a}")
    embedded = specification["/EF"].get_object()
    stream = embedded["/F"].get_object()
    if any(each.get_object() is not stream for each in embedded.values()) or not all(
        _is_name(specification[key], name) for key in ("/F", "/UF") if key in specification
    ):
        raise InputError.at(
            place,
            f"carries {name!r} with two names or two contents, one for some viewers; no certificate does",
        )
    parameters = stream["/Params"].get_object() if "/Params" in stream else {}
    content = unpack(stream, room)
    return Carried(
        name,
        content,
        str(specification.get("/AFRelationship", "")).removeprefix("/"),
        str(specification.get("/Desc", "")),
        str(stream.get("/Subtype", "")).removeprefix("/"),
        _write_hexadecimal(parameters.get("/CheckSum")),
        str(parameters.get("/Size", "")),
        tuple(f"{key} {parameters[key]}" for key in ("/CreationDate", "/ModDate") if key in parameters),
        entries=tuple(
            f"{holder} {key}"
            for holder, keys in (("", specification), ("/EF", embedded), ("stream", stream), ("", parameters))
            for key in sorted(keys.keys() - PACKING)
        ),
    )


def _is_name(written: Any, name: str) -> bool:
    """Whether a name is the one that is meant: as text, or as the bytes of UTF-8, as Typst has it."""
    content = bytes(written) if isinstance(written, bytes) else getattr(written, "original_bytes", b"")
    return str(written) == name or content == name.encode()


def _write_hexadecimal(checksum: Any) -> str:
    """Return a digest that the reader may have taken for text."""
    original = getattr(checksum, "original_bytes", b"")
    with contextlib.suppress(AttributeError):
        return bytes(original).hex()
    return ""


class DamagedError(ValueError):
    """A stream that cannot be unpacked to its end; pypdf would mend it as well as it can, and say nothing."""


class TooLargeError(ValueError):
    """A stream that unpacks to more than is allowed."""


def unpack(stream: Any, most: int) -> bytes:
    """Return the bytes of a stream of pypdf.

    `most`: Bytes that it may unpack to.

    Raises `DamagedError` if it is damaged; `TooLargeError` if it unpacks to more.
    """
    from pypdf.errors import LimitReachedError  # noqa: PLC0415 - slow to load

    packing = stream.get("/Filter")
    if packing in ("/FlateDecode", ["/FlateDecode"]) and "/DecodeParms" not in stream:
        unpacker = zlib.decompressobj()
        try:
            content = unpacker.decompress(stream._data, most + 1)  # noqa: SLF001 - only packed bytes tell damage
        except zlib.error as error:
            raise DamagedError(f"a stream cannot be unpacked: {error}") from error
        if len(content) <= most and not unpacker.eof:
            raise DamagedError("a stream ends before its end")
    else:
        try:
            content = stream.get_data()
        except LimitReachedError as error:
            raise TooLargeError from error
        content = content if isinstance(content, bytes) else content.encode("utf-8", "replace")
    if len(content) > most:
        raise TooLargeError
    return content
