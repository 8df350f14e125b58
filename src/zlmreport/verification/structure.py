"""Whether a tagged PDF's structure and its pages point to each other alike.

The structure says both: each element lists the places that belong to it, and a table lists for each place its
element. A screen reader follows the one, and a program that is asked what stands at a place the other.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from zlmreport.verification.carrier import find_value
from zlmreport.verification.findings import CheckedStatement

_SUBJECT = "places of the structure"
_MOST_NODES = 1_000_000


def compare(reader: Any) -> CheckedStatement:
    """Return whether both ways lead to the same elements; elements are compared elsewhere."""
    root = reader.trailer["/Root"].get_object().get("/StructTreeRoot")
    if root is None:
        return CheckedStatement.of(_SUBJECT, "")
    tree = root.get_object()
    places = dict(_list_places(tree))
    table = dict(_list_numbers(tree.get("/ParentTree")))
    for number, page in enumerate(reader.pages, 1):
        listed = find_value(table.get(page.get("/StructParents")))
        own = page.indirect_reference.idnum
        elements = listed if isinstance(listed, list) else []
        by_table = {
            (own, place): element.idnum
            for place, element in enumerate(elements)
            if getattr(element, "idnum", None) is not None
        }
        by_elements = {place: element for place, element in places.items() if place[0] == own}
        if by_table != by_elements:
            return CheckedStatement.of(
                _SUBJECT, f"those of page {number} lead to other elements than list them"
            )
    return CheckedStatement.of(_SUBJECT, "")


def _list_places(tree: Any) -> Iterator[tuple[tuple[int, int], int]]:
    """Yield each place, by the number of its page's object and its own, with the number of its element."""
    waiting: list[tuple[Any, Any]] = [(each, None) for each in _list_kids(tree)]
    walked = 0
    while waiting:
        reference, page = waiting.pop()
        walked += 1
        if walked > _MOST_NODES:
            raise ValueError("its structure has no end")
        element = find_value(reference)
        if not isinstance(element, dict) or "/S" not in element:
            continue
        page = element.raw_get("/Pg") if "/Pg" in element else page  # type: ignore[attr-defined]
        for kid in _list_kids(element):
            inner = find_value(kid)
            if isinstance(inner, int):
                yield (page.idnum, int(inner)), reference.idnum
            elif isinstance(inner, dict) and inner.get("/Type") == "/MCR":
                of = inner.raw_get("/Pg") if "/Pg" in inner else page  # type: ignore[attr-defined]
                yield (of.idnum, int(inner["/MCID"])), reference.idnum
            else:
                waiting.append((kid, page))


def _list_kids(element: Any) -> list[Any]:
    kids = element.raw_get("/K") if "/K" in element else []
    found = find_value(kids)
    return list(found) if isinstance(found, list) else [kids]


def _list_numbers(node: Any) -> Iterator[tuple[int, Any]]:
    waiting, walked = [node], 0
    while waiting:
        found = find_value(waiting.pop())
        walked += 1
        if walked > _MOST_NODES:
            raise ValueError("its structure has no end")
        if isinstance(found, dict):
            pairs = list(find_value(found.get("/Nums", [])))
            yield from zip(map(int, pairs[::2]), pairs[1::2], strict=True)
            waiting.extend(find_value(found.get("/Kids", [])))
