"""Ways to spoil a file: each is drawn from a generator, so that a seed makes the same file again."""

from __future__ import annotations

import random
import re
from collections.abc import Callable, Sequence

_NUMBERS = (
    *("0", "-0", "-1", "1e308", "-1e308", "1e-308", "5e-324", "1e999", "nan", "inf", "-inf", ".nan", ".inf"),
    *(
        "99999999999999999999",
        "0x10",
        "0o17",
        "1_000",
        "1,5",
        "1.5.5",
        "1e",
        "٣",
        "²",
        "",
        "2026-02-30",
        "00012",
    ),
)
_WORDS = (
    *(
        "null",
        "~",
        "no",
        "[]",
        "{}",
        "[[[[]]]]",
        "{a: {b: c}}",
        "''",
        '"',
        "*x",
        "&x y",
        "!!python/name:os.system",
    ),
    *(
        "../../../etc/passwd",
        "/dev/zero",
        "/proc/self/environ",
        "CON",
        "a" * 600,
        "\u202eabc",
        "\ud7ff",
        "\x00",
        "\x1b[2J",
    ),
    *(
        "{{7*7}}",
        "<script>",
        "%s%n",
        "${HOME}",
        "é" * 40,
        "🜚",
        "=1+1",
        "x" * 70_000,
        "- - - -",
        "? :",
        "| >",
        "%YAML 2",
    ),
)
_BYTES = (
    b"\xff",
    b"\x00",
    b"\xc3\x28",
    b"\xed\xa0\x80",
    b"\r",
    b"\n",
    b"\xef\xbb\xbf",
    b"\xfe\xff",
    b"\t",
    b"\x1a",
)
_NUMBER = re.compile(rb"[-+]?\d+(?:\.\d+)?")
_WORD = re.compile(rb"[A-Za-z_][A-Za-z0-9_-]+")

Edit = Callable[[random.Random, bytes], bytes]


def _at(draw: random.Random, content: bytes) -> int:
    return draw.randrange(len(content) + 1)


def _replaced(pattern: re.Pattern[bytes], others: Sequence[str]) -> Edit:
    def edit(draw: random.Random, content: bytes) -> bytes:
        found = list(pattern.finditer(content))
        if not found:
            return content
        one = draw.choice(found)
        other = draw.choice(others).encode("utf-8", "surrogatepass")
        return content[: one.start()] + other + content[one.end() :]

    return edit


def _other_of_the_file(draw: random.Random, content: bytes) -> bytes:
    """Put one word of the file in the place of another."""
    found = list(_WORD.finditer(content)) or [re.compile(b"").search(content)]
    one, other = draw.choice(found), draw.choice(found)
    assert one is not None
    assert other is not None
    return content[: one.start()] + other[0] + content[one.end() :]


def _lines(change: Callable[[random.Random, list[bytes]], None]) -> Edit:
    def edit(draw: random.Random, content: bytes) -> bytes:
        lines = content.splitlines(keepends=True) or [b""]
        change(draw, lines)
        return b"".join(lines)

    return edit


def _drop(draw: random.Random, lines: list[bytes]) -> None:
    first = draw.randrange(len(lines))
    del lines[first : first + draw.choice((1, 1, 1, 2, 10))]


def _repeat(draw: random.Random, lines: list[bytes]) -> None:
    first = draw.randrange(len(lines))
    lines[first:first] = lines[first : first + draw.choice((1, 3))] * draw.choice((1, 1, 2, 300))


def _swap(draw: random.Random, lines: list[bytes]) -> None:
    one, other = draw.randrange(len(lines)), draw.randrange(len(lines))
    lines[one], lines[other] = lines[other], lines[one]


def _indent(draw: random.Random, lines: list[bytes]) -> None:
    one = draw.randrange(len(lines))
    lines[one] = b" " * draw.choice((1, 2, 4)) + lines[one] if draw.random() < 0.5 else lines[one].lstrip()


def _cut(draw: random.Random, content: bytes) -> bytes:
    return content[: _at(draw, content)]


def _inserted(draw: random.Random, content: bytes) -> bytes:
    place = _at(draw, content)
    return content[:place] + draw.choice(_BYTES) * draw.choice((1, 1, 1, 40)) + content[place:]


def _flipped(draw: random.Random, content: bytes) -> bytes:
    place = min(_at(draw, content), max(len(content) - 1, 0))
    return content[:place] + bytes([draw.randrange(256)]) + content[place + 1 :]


def _moved(draw: random.Random, content: bytes) -> bytes:
    """Put a piece of the file where another was."""
    start, place, length = _at(draw, content), _at(draw, content), draw.choice((1, 4, 20, 200))
    return content[:place] + content[start : start + length] + content[place + length :]


#: Of a text; the frequent ones stand more than once.
TEXT: tuple[Edit, ...] = (
    *(
        _replaced(_NUMBER, _NUMBERS),
        _replaced(_NUMBER, _NUMBERS),
        _replaced(_WORD, _WORDS),
        _other_of_the_file,
    ),
    *(_lines(_drop), _lines(_repeat), _lines(_swap), _lines(_indent), _inserted, _flipped, _cut),
)
#: Of a file with a structure of its own.
BINARY: tuple[Edit, ...] = (_flipped, _flipped, _inserted, _moved, _cut, _replaced(_NUMBER, _NUMBERS))


def spoiled(content: bytes, seeds: Sequence[int], edits: Sequence[Edit]) -> bytes:
    """Return a file after an edit for each seed."""
    for seed in seeds:
        draw = random.Random(seed)
        content = draw.choice(edits)(draw, content)
    return content
