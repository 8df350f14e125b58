"""Columns by name: what a notebook shows as a table, and what pandas and polars make a frame of."""

from __future__ import annotations

import html
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

#: Rows that a notebook shows; the middle of a longer table is left out.
_MOST_SHOWN = 60
_DIGITS = 6


class Table(dict[str, NDArray[Any]]):
    """Columns of equal length by name, such as ``table["target"]``.

    ``pandas.DataFrame(table)`` and ``polars.DataFrame(table)`` make a frame of it.
    """

    def __repr__(self) -> str:
        """Return the names of the columns and the number of rows."""
        return f"<Table of {self.rows} rows: {', '.join(self)}>"

    @property
    def rows(self) -> int:
        """How many rows there are."""
        return len(next(iter(self.values()), ()))

    def _repr_html_(self) -> str:
        rows = list(zip(*(column.tolist() for column in self.values()), strict=True))
        if len(rows) > _MOST_SHOWN:
            half = _MOST_SHOWN // 2
            rows = [*rows[:half], ("…",) * len(self), *rows[-half:]]
        return as_html(tuple(self), rows)


def as_html(head: Sequence[str], rows: Iterable[Sequence[Any]], caption: str = "") -> str:
    """Return a table for a notebook: texts escaped, numbers to a few digits, nothing where nothing is."""
    above = f"<caption>{html.escape(caption)}</caption>" if caption else ""
    titles = "".join(f"<th>{html.escape(title)}</th>" for title in head)
    body = "".join(f"<tr>{''.join(f'<td>{_shown(cell)}</td>' for cell in row)}</tr>" for row in rows)
    return f"<table>{above}<thead><tr>{titles}</tr></thead><tbody>{body}</tbody></table>"


def _shown(cell: Any) -> str:
    if cell is None or (isinstance(cell, float) and np.isnan(cell)):
        return ""
    return html.escape(f"{cell:.{_DIGITS}g}" if isinstance(cell, float) else str(cell))


def columns_of(frame: Any) -> dict[str, NDArray[Any]] | None:
    """Return the columns of anything that has named ones; None if it has none.

    A frame of pandas or polars, a table of Arrow, a mapping of arrays: their names are listed, and each
    column is an array to numpy.
    """
    names = getattr(frame, "column_names", None)  # pyarrow; its columns are the arrays themselves
    if names is None:
        names = frame.keys() if isinstance(frame, Mapping) else getattr(frame, "columns", None)
    if names is None:
        return None
    return {str(name): np.asarray(frame[name]) for name in names}
