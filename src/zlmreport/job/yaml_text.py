"""Writes values in YAML: within a line, or a value a line."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Mapping
from typing import Any

from zlmreport.job.tree import Items, Keys, Node, Scalar

#: Text that means nothing but itself without quotes, wherever it stands.
_PLAIN = re.compile(r"[^\W\d_]((?:[\w ./()+-]|:(?=[\w./-]))*[\w).])?")
#: Of names of files that are no UTF-8: nothing that is written can hold them, and they are escaped.
_HALVES = re.compile("[\ud800-\udfff]")
_WORDS_OF_YAML = frozenset({"true", "false", "yes", "no", "on", "off", "null", "y", "n"})


def write_as_text(node: Node, quote: str = "", *, in_lines: bool = False) -> str:
    """Return a value as it is written within a line.

    `quote`: The quotation mark of text; empty for none where none is needed.
    `in_lines`: Whether a single key needs no braces.
    """
    if isinstance(node, Scalar):
        if node.is_nothing:
            return "null"
        return node.text if node.is_number else quote_text(node.text, quote)
    if isinstance(node, Items):
        return f"[{', '.join(write_as_text(item, quote) for item in node.items)}]"
    pairs = ", ".join(
        f"{quote_text(key, quote)}: {write_as_text(entry.value, quote)}"
        for key, entry in node.entries.items()
    )
    return pairs if in_lines and len(node.entries) == 1 else f"{{{pairs}}}"


def quote_text(text: str, quote: str = "") -> str:
    """Return a text or a key with a quotation mark, or with none where it needs none."""
    if quote == "'" and "'" not in text and "\n" not in text:
        return f"'{text}'"
    is_plain = _PLAIN.fullmatch(text) and text.casefold() not in _WORDS_OF_YAML
    is_written = _HALVES.search(text) is None
    return text if is_plain and not quote else json.dumps(text, ensure_ascii=not is_written)


def write_in_a_line(value: Any) -> str:
    """Return a value of Python in YAML, on one line: text without quotation marks where that is safe."""
    if isinstance(value, Mapping):
        pairs = (f"{write_in_a_line(name)}: {write_in_a_line(each)}" for name, each in value.items())
        return f"{{{', '.join(pairs)}}}"
    if isinstance(value, list | tuple):
        return f"[{', '.join(map(write_in_a_line, value))}]"
    if isinstance(value, str):
        return quote_text(value)
    return json.dumps(int(value) if isinstance(value, float) and value.is_integer() else value)


def write_group(group: Mapping[str, Any], indent: str = "") -> Iterator[str]:
    """Yield the lines of a group of values of Python; what is no group stands within its line."""
    for key, value in group.items():
        if isinstance(value, Mapping) and value:
            yield f"{indent}{quote_text(key)}:"
            yield from write_group(value, f"{indent}  ")
        else:
            yield f"{indent}{quote_text(key)}: {write_in_a_line(value)}"


def write_lines(node: Keys | Items, indent: str) -> Iterator[str]:
    """Yield the lines of a group or a list as YAML, a value a line."""
    if isinstance(node, Items):
        labelled: list[tuple[str, Node]] = [("-", item) for item in node.items]
    else:
        labelled = [(f"{quote_text(entry.key)}:", entry.value) for entry in node.entries.values()]
    for label, value in labelled:
        if isinstance(value, Scalar):
            yield f"{indent}{label} {_write_scalar(value)}".rstrip()
        elif list(write_lines(value, "")):
            yield f"{indent}{label}"
            yield from write_lines(value, f"{indent}  ")
        else:
            yield f"{indent}{label} {'[]' if isinstance(value, Items) else '{}'}"


def _write_scalar(value: Scalar) -> str:
    """Write a value as it was written: whether it stands in quotes tells a number from a text."""
    is_plain = value.plain and "\n" not in value.text
    return value.text if is_plain else json.dumps(value.text, ensure_ascii=False)
