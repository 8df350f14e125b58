"""Parses PDF objects from raw bytes, strictly: refuses what two readers might take differently.

A reader that mends what it reads shows a file as it thinks that it was meant. Here nothing is mended: a key
that stands twice, a comment, a number with two signs is an error, and so is anything between an object and
its end.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import TypeAlias

#: Objects that stand in one another.
_DEEPEST = 200
_SPACE = re.compile(rb"[ \t\r\n]*")
_NAME = re.compile(rb"/((?:[!-\"$&'*-.0-;=?-Z\\^-z|~]|#[0-9A-Fa-f]{2})*)")
_ESCAPED = re.compile(rb"#([0-9A-Fa-f]{2})")
_REFERENCE = re.compile(rb"([1-9]\d{0,9}) (0|[1-9]\d{0,4}) R(?![A-Za-z0-9])")
_NUMBER = re.compile(rb"[+-]?(?:\d{1,19}(?:\.\d{0,19})?|\.\d{1,19})(?=[ \t\r\n/<>()\[\]]|\Z)")
_WORD = re.compile(rb"(?:true|false|null)(?=[ \t\r\n/<>()\[\]]|\Z)")
_HEXADECIMAL = re.compile(rb"<([0-9A-Fa-f \t\r\n]*)>")
_OBJECT = re.compile(rb"([1-9]\d{0,9}) (0|[1-9]\d{0,4}) obj(?![A-Za-z0-9])")
_STREAM = re.compile(rb"stream(?:\r\n|\n)")
_END_OF_STREAM = re.compile(rb"(?:\r\n|\n|\r)?endstream[ \t\r\n]+endobj(?![A-Za-z0-9])")
_END = re.compile(rb"endobj(?![A-Za-z0-9])")
_MARK = re.compile(rb"[()\\]")


class OddError(ValueError):
    """Bytes that are no object, or one that readers may take differently."""


@dataclass(frozen=True, slots=True)
class Reference:
    """An object that stands elsewhere: its number and its generation."""

    number: int
    generation: int


@dataclass(frozen=True, slots=True)
class PdfName:
    """A name, without its solidus and without escapes."""

    text: bytes


#: What an object is: numbers, truth and nothing of Python; strings as they stand in the file.
Value: TypeAlias = (
    "int | float | bool | bytes | PdfName | Reference | list[Value] | dict[bytes, Value] | None"
)


@dataclass(frozen=True, slots=True)
class Indirect:
    """An object with a number, and where it stands.

    `stream` is where its packed data begin and end; None without any.
    """

    number: int
    generation: int
    value: Value
    start: int
    end: int
    stream: tuple[int, int] | None = None


def skip_space(content: bytes, at: int) -> int:
    """Return where the next byte that is no space stands."""
    found = _SPACE.match(content, at)
    return found.end() if found else at


def read_value(content: bytes, at: int, depth: int = 0) -> tuple[Value, int]:
    """Return the object that begins at a byte, and where it ends.

    Raises `OddError` if there is none, or one that readers may take differently.
    """
    if depth > _DEEPEST:
        raise OddError("objects stand in one another without end")
    if content.startswith(b"<<", at):
        return _read_dictionary(content, at + 2, depth)
    first = content[at : at + 1]
    if first == b"[":
        return _list(content, at + 1, depth)
    if first == b"(":
        end = _end_of_string(content, at)
        return content[at:end], end
    for kind, made in (
        (_NAME, lambda found: PdfName(_ESCAPED.sub(lambda each: bytes([int(each[1], 16)]), found[1]))),
        (_REFERENCE, lambda found: Reference(int(found[1]), int(found[2]))),
        (_NUMBER, lambda found: float(found[0]) if b"." in found[0] else int(found[0])),
        (_WORD, lambda found: {b"true": True, b"false": False}.get(found[0])),
        (_HEXADECIMAL, lambda found: found[0]),
    ):
        if found := kind.match(content, at):
            return made(found), found.end()
    raise OddError(f"what stands at byte {at} is no object")


def _read_dictionary(content: bytes, at: int, depth: int) -> tuple[Value, int]:
    found: dict[bytes, Value] = {}
    at = skip_space(content, at)
    while not content.startswith(b">>", at):
        key, at = read_value(content, at, depth)
        if not isinstance(key, PdfName):
            raise OddError(f"a key before byte {at} is no name")
        if key.text in found:
            raise OddError(f"a key before byte {at} stands twice")
        found[key.text], at = read_value(content, skip_space(content, at), depth + 1)
        at = skip_space(content, at)
    return found, at + 2


def _list(content: bytes, at: int, depth: int) -> tuple[Value, int]:
    found: list[Value] = []
    at = skip_space(content, at)
    while content[at : at + 1] != b"]":
        value, at = read_value(content, at, depth + 1)
        found.append(value)
        at = skip_space(content, at)
    return found, at + 1


def _end_of_string(content: bytes, at: int) -> int:
    opened, place = 0, at
    while found := _MARK.search(content, place):
        place = found.end()
        if found[0] == b"\\":
            place += 1
            continue
        opened += 1 if found[0] == b"(" else -1
        if not opened:
            return place
    raise OddError(f"the text that begins at byte {at} has no end")


def begins_object(content: bytes, at: int) -> bool:
    """Whether an object with a number begins at a byte."""
    return _OBJECT.match(content, at) is not None


def read_object(content: bytes, at: int) -> Indirect:
    """Return the object with a number that begins at a byte.

    The length of its data, if it has any, must be stated by it and be true.

    Raises `OddError` if there is none, or one that readers may take differently.
    """
    head = _OBJECT.match(content, at)
    if head is None:
        raise OddError(f"no object begins at byte {at}")
    number, generation = int(head[1]), int(head[2])
    value, place = read_value(content, skip_space(content, head.end()))
    place = skip_space(content, place)
    if end := _END.match(content, place):
        return Indirect(number, generation, value, at, end.end())
    begun = _STREAM.match(content, place)
    length = value.get(b"Length") if isinstance(value, dict) else None
    if begun is None or isinstance(length, bool) or not isinstance(length, int) or length < 0:
        raise OddError(f"object {number} has no end, or data of a length that it does not state")
    closed = _END_OF_STREAM.match(content, begun.end() + length)
    if closed is None:
        raise OddError(f"the data of object {number} are not as long as it states")
    data = begun.end(), begun.end() + length
    return Indirect(number, generation, value, at, closed.end(), data)
