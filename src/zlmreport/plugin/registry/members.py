"""Whether what an object of a plugin states is of the types that its interface declares."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import is_dataclass

#: A declaration that is held against a value: ``str``, ``Words | None``, ``tuple[Quantity, ...]``.
_DECLARED = re.compile(r"(?P<row>tuple\[)?(?P<name>\w+)(?(row), \.\.\.\])(?P<may_be_none> \| None)?")
#: Types that are known by their names: nothing is imported to look at a plugin.
_KNOWN = frozenset(
    {
        "str",
        "bool",
        "Words",
        "Quantity",
        "QuantityGroup",
        "PositionQuantity",
        "Parameter",
        "Dimension",
        "Shape",
        "Confusion",
    }
)
#: Questions, whose places are filled when they are asked.
_ASKED = frozenset({"question", "question_below"})


def find_unlike(interface: type, offered: object, prefix: str = "") -> Iterator[str]:
    """Yield each member that is not of its declared type, such as ``quantities[1].name: Words, not str``."""
    for member, annotation in interface.__annotations__.items():
        declared = _DECLARED.fullmatch(annotation) if isinstance(annotation, str) else None
        if declared is None or declared["name"] not in _KNOWN:
            continue
        value, where = getattr(offered, member), f"{prefix}{member}"
        if value is None and declared["may_be_none"]:
            continue
        if not declared["row"]:
            yield from _find_unlike_value(declared["name"], value, where)
        elif not isinstance(value, tuple | list):
            yield f"{where}: {annotation}, not {_name_type(value)}"
        else:
            for index, each in enumerate(value):
                yield from _find_unlike_value(declared["name"], each, f"{where}[{index}]")


def _find_unlike_value(name: str, value: object, where: str) -> Iterator[str]:
    if name not in {each.__name__ for each in type(value).__mro__}:
        yield f"{where}: {name}, not {_name_type(value)}"
    elif is_dataclass(value):
        unlike = [*find_unlike(type(value), value, f"{where}.")]
        yield from unlike
        list_unfilled = getattr(value, "list_unfilled", None)  # of Words alone
        if list_unfilled and not unlike and where.rpartition(".")[2] not in _ASKED:
            yield from (f"{where}: no value for {{{place}}}" for place in list_unfilled())


def _name_type(value: object) -> str:
    return "None" if value is None else type(value).__name__
