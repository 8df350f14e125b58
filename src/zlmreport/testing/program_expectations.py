"""What is expected of a program that a plugin writes for a machine, whatever its language."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from typing import Any

from zlmreport.testing.expectations import (
    expect,
    expect_identifier,
    expect_members,
    expect_options,
    expect_own_keys,
    expect_words,
)

_SUFFIX = re.compile(r"\.[a-z0-9]+(\.[a-z0-9]+)*")
_CORE_KEYS = frozenset({"program"})
_LONGEST_LINE = 200


def expect_named(program: Any, protocol: type, suffix: str) -> None:
    """Expect an identifier that can be typed, a title in every language, and a suffix like the given one."""
    expect_members(program, protocol)
    expect_identifier(program.identifier, repr(program))
    expect_words(program.title, f"{program.identifier}: title")
    expect(
        _SUFFIX.fullmatch(program.suffix),
        f"{program.identifier}: suffix {program.suffix!r} must be like {suffix!r}",
    )


def expect_defaults(program: Any) -> None:
    """Expect job keys that are described, none of them a key of the core, and all with a default."""
    expect_options(program.options, program.identifier)
    expect_own_keys(program.options, _CORE_KEYS, program.identifier)
    required = [key for key, field in program.options.model_fields.items() if field.is_required()]
    expect(
        not required,
        f"{program.identifier}: job keys {', '.join(required)} need a default: --program has no keys",
    )


def expect_plain_text(text: str, where: str) -> None:
    """Expect ASCII in lines that a machine can hold, the last of them with an end."""
    expect(isinstance(text, str) and text, f"{where}: write must return the text of a program")
    expect(text.isascii(), f"{where}: the program holds characters beyond ASCII")
    expect(
        all(line.isprintable() for line in text.splitlines()),
        f"{where}: the program holds control characters",
    )
    expect(text.endswith("\n"), f"{where}: the last line has no end")
    longest = max(len(line) for line in text.splitlines())
    expect(longest <= _LONGEST_LINE, f"{where}: a line has {longest} characters; {_LONGEST_LINE} at most")


def expect_same_deeds(
    text: str, understand: Callable[[str], Sequence[Any]], plain: Sequence[Any], where: str, verb: str
) -> None:
    """Expect that a program with a hostile name does what the one with a plain name does.

    Parameters
    ----------
    text
        The program.
    understand
        From a text of its language to what a machine does of it.
    plain
        What it does with a plain name.
    where
        Of which program and name, for the message.
    verb
        What `understand` does with a text: ``run``, ``read``.
    """
    expect(text.isascii(), f"{where}, the program holds characters beyond ASCII")
    try:
        deeds = list(understand(text))
    except Exception as error:
        message = f"{where}, the program cannot be {verb}: {error!r}"
        raise AssertionError(message) from error
    expect(deeds == plain, f"{where}, the program does something else")
