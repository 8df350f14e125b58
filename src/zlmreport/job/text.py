"""From a file's bytes to text that can be printed: its encoding and its characters."""

from __future__ import annotations

import codecs
import re
import unicodedata

from zlmreport.errors import InputError, Place, Problem

#: Of a job file, in bytes.
LARGEST = 1024 * 1024
#: Characters of one file that are complained of one by one.
_MOST_NAMED = 10

#: Control characters and lone surrogates, for which there is nothing to print; overrides and isolates of
#: the writing direction, with which a text reads otherwise than it is stored; separators that split lines
#: where an editor does not; and byte order marks in the middle, which nobody typed.
_UNPRINTABLE = re.compile(
    "[\x00-\x08\x0b\x0c\x0e-\x1f\x7f-\x9f\ud800-\udfff\u202a-\u202e\u2066-\u2069\u2028\u2029\ufeff]"
)
_UTF16 = (codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)


def decoded(content: bytes, file: str) -> str:
    """Return the text of a job file.

    Raises
    ------
    InputError
        If it is not UTF-8, or holds characters that cannot be seen.
    """
    if len(content) > LARGEST:
        raise InputError.at(
            Place(file, 1, 1),
            "is larger than 1 MiB; a job file holds keys, and names the files that hold readings",
        )
    if content.startswith(_UTF16) or content[:2].count(0) == 1:
        raise InputError.at(Place(file, 1, 1), "is UTF-16; save it as UTF-8")
    content = content.removeprefix(codecs.BOM_UTF8)
    try:
        text = content.decode("utf-8")
    except UnicodeDecodeError as error:
        before = content[: error.start].decode("utf-8")
        raise InputError.at(
            _place(before, file),
            f"byte 0x{content[error.start]:02X} is not UTF-8; save the file as UTF-8",
        ) from error
    problems: list[Problem] = []
    for found in _UNPRINTABLE.finditer(text):
        place = _place(text[: found.start()], file)
        if len(problems) == _MOST_NAMED:
            problems.append(Problem(place, "and more of the kind; is this a text file?"))
            break
        problems.append(Problem(place, f"{described(found[0])}; remove it"))
    if problems:
        raise InputError(problems)
    return text


def unprintable(text: str) -> str | None:
    """Return the first character of a text that cannot be printed, if there is one."""
    found = _UNPRINTABLE.search(text)
    return found[0] if found else None


def described(character: str) -> str:
    r"""Say which character that nobody sees stands in a text.

    >>> described("\x07"), described("\u202e")
    ('control character U+0007', 'invisible character U+202E (right-to-left override)')
    """
    code = f"U+{ord(character):04X}"
    name = unicodedata.name(character, "").lower()
    return f"invisible character {code} ({name})" if name else f"control character {code}"


def counted(number: int, thing: str) -> str:
    """Return a number of things.

    >>> counted(1, "value"), counted(100000, "character")
    ('1 value', '100,000 characters')
    """
    return f"{number:,} {thing}{'' if number == 1 else 's'}"


def _place(before: str, file: str) -> Place:
    """Return the place of the character after a text."""
    lines = before.replace("\r\n", "\n").replace("\r", "\n").split("\n")
    return Place(file, len(lines), len(lines[-1]) + 1)
