"""Compares the results file with that of the attached readings, value by value; tolerances."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

from zlmreport.verification.findings import ComparedValue, VerificationVerdict, is_number

#: Relative, and in units of the results file: another processor rounds the last digits otherwise.
_TOLERANCE = 1e-9
#: Of fitted parameters: an iteration multiplies such differences.
_TOLERANCE_OF_FITS = 1e-6
_FITTED = "model"
#: What every release computes alike of a parameter.
_KEPT = frozenset({"value", "limit"})
#: What holds results of the same form by names: of measured lines, of the measurements of one document.
_NAMED = frozenset({"tests", "parts"})
_OF_NAME = 2
#: What names an item of a list, first found.
_NAMES = ("standard", "symbol", "name", "target", "effect", "path", "requirement")


def compare(stated: Any, recomputed: Any, *, same_programs: bool) -> tuple[ComparedValue, ...]:
    """Return every value of two results files, side by side.

    `same_programs`: Whether both come from the same releases. Otherwise readings, parameters and limits are
        compared; words, uncertainties, what only this release states, and whatever else differs are left
        open.
    """
    return tuple(
        value if same_programs else _compare_with_another_release(value)
        for value in _walk(stated, recomputed, ())
    )


def _compare_with_another_release(value: ComparedValue) -> ComparedValue:
    path = value.path
    while path[0] in _NAMED and len(path) > _OF_NAME:
        path = path[_OF_NAME:]
    is_kept = path[0] == "measurements" or (path[2:3] == ("parameters",) and path[-1] in _KEPT)
    if value.verdict is VerificationVerdict.HOLDS or (
        value.is_number and is_kept and value.stated is not None
    ):
        return value
    return ComparedValue(value.path, value.stated, value.recomputed, VerificationVerdict.OPEN)


def _walk(stated: Any, recomputed: Any, path: tuple[str, ...]) -> Iterator[ComparedValue]:
    if isinstance(stated, dict) and isinstance(recomputed, dict):
        for key in dict.fromkeys((*stated, *recomputed)):
            yield from _walk(stated.get(key), recomputed.get(key), (*path, key))
    elif isinstance(stated, list) and isinstance(recomputed, list):
        for name, one, other in _pair_items(stated, recomputed):
            yield from _walk(one, other, (*path, name))
    elif isinstance(stated, dict | list) or isinstance(recomputed, dict | list):
        yield from _list_on_one_side(stated, recomputed, path)
    else:
        yield ComparedValue(path, stated, recomputed, _decide_verdict(stated, recomputed, path))


def _pair_items(stated: list[Any], recomputed: list[Any]) -> Iterator[tuple[str, Any, Any]]:
    """Pair the items of two lists: in their order, or by their names if the lists are not equally long."""
    if len(stated) == len(recomputed):
        for number, (one, other) in enumerate(zip(stated, recomputed, strict=True), 1):
            yield _name_item(other, number), one, other
        return
    left, right = _key_by_name(stated), _key_by_name(recomputed)
    for name in dict.fromkeys((*left, *right)):
        yield name, left.get(name), right.get(name)


def _key_by_name(items: list[Any]) -> dict[str, Any]:
    found: dict[str, Any] = {}
    for number, item in enumerate(items, 1):
        name = _name_item(item, number)
        found[f"{name} ({number})" if name in found else name] = item
    return found


def _name_item(item: Any, number: int) -> str:
    keys = item if isinstance(item, dict) else {}
    if {"measurement", "standard"} <= keys.keys():  # of one document of several measurements
        return f"{keys['measurement']} {keys['standard']}"
    return next((f"{keys[key]}" for key in _NAMES if key in keys), str(number))


def _list_on_one_side(stated: Any, recomputed: Any, path: tuple[str, ...]) -> Iterator[ComparedValue]:
    """Yield the values of a branch that has no counterpart of its kind."""
    for leaf_path, leaf in _walk_leaves(stated, path):
        yield ComparedValue(leaf_path, leaf, None, VerificationVerdict.DIFFERS)
    for leaf_path, leaf in _walk_leaves(recomputed, path):
        yield ComparedValue(leaf_path, None, leaf, VerificationVerdict.DIFFERS)


def _walk_leaves(node: Any, path: tuple[str, ...]) -> Iterator[tuple[tuple[str, ...], Any]]:
    if isinstance(node, dict):
        for key, child in node.items():
            yield from _walk_leaves(child, (*path, key))
    elif isinstance(node, list):
        for number, child in enumerate(node, 1):
            yield from _walk_leaves(child, (*path, _name_item(child, number)))
    elif node is not None:
        yield path, node


def _decide_verdict(stated: Any, recomputed: Any, path: tuple[str, ...]) -> VerificationVerdict:
    if is_number(stated) and is_number(recomputed):
        tolerance = _TOLERANCE_OF_FITS if path[0] == _FITTED else _TOLERANCE
        agree = math.isclose(stated, recomputed, rel_tol=tolerance, abs_tol=tolerance)
    else:
        agree = type(stated) is type(recomputed) and stated == recomputed
    return VerificationVerdict.HOLDS if agree else VerificationVerdict.DIFFERS
