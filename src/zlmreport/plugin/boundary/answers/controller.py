"""Checks what the methods of a control answer."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from zlmreport.model.compensation.curve import CompensationTable, CrossTable
from zlmreport.plugin.boundary import Guarded, Unacceptable
from zlmreport.plugin.boundary.answers.required import require_all_of, require_finite, require_kind


def tables(_controller: Guarded, answer: Any, *_: Any) -> Mapping[str, str]:
    """Refuse what are no files, and names that would leave their folder."""
    if not require_kind(Mapping, answer):
        raise Unacceptable("returns no file")
    return cross_tables(_controller, answer)


def cross_tables(_controller: Guarded, answer: Any, *_: Any) -> Mapping[str, str]:
    """Refuse the same of tables across axes, of which there may be none that the control takes."""
    for name, text in require_kind(Mapping, answer).items():
        if not isinstance(text, str) or not text:
            raise Unacceptable(f"returns no text for the file {name!r}")
        if not isinstance(name, str) or any(sign in name for sign in "/\\\0"):
            raise Unacceptable(f"returns a file that is called {name!r}; the end of a name is expected")
    return answer  # type: ignore[no-any-return]


def table(_controller: Guarded, answer: Any, *_: Any) -> CompensationTable:
    """Refuse a table with something else than a deviation at each position."""
    of: CompensationTable = require_kind(CompensationTable, answer)
    shape = (np.size(of.positions),)
    for what, values in (("positions", of.positions), ("forward", of.forward), ("reverse", of.reverse)):
        require_finite(values, shape, what)
    return of


def read_cross(_controller: Guarded, answer: Any, *_: Any) -> tuple[CrossTable, ...]:
    """Refuse a table across axes with something else than a value at each position."""
    found: tuple[CrossTable, ...] = require_all_of(CrossTable, answer)
    for each in found:
        shape = (np.size(each.positions),)
        for what, values in (("positions", each.positions), ("values", each.values)):
            require_finite(values, shape, what)
    return found


#: What is made of an answer, by method.
ACCEPTED: Mapping[str, Callable[..., Any]] = {
    "files": tables,
    "read": table,
    "cross_files": cross_tables,
    "read_cross": read_cross,
}
