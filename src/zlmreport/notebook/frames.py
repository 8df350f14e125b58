"""Tables as data frames (pandas, polars, pyarrow), frames as columns, tables as HTML."""

from __future__ import annotations

import html
import sys
from collections.abc import Iterable, Mapping, Sequence
from importlib.util import find_spec
from pathlib import Path
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from zlmreport.errors import InputError, Place, did_you_mean

Library = Literal["pandas", "polars", "pyarrow"]
#: Libraries that make frames, in the order in which they are asked for.
LIBRARIES: tuple[Library, ...] = ("pandas", "polars", "pyarrow")
#: Rows that a notebook shows; the middle of a longer table is left out.
_MOST_SHOWN = 60
_DIGITS = 6


def frame_of(columns: Mapping[str, NDArray[Any]], library: Library | None = None) -> Any:
    """Return a frame of columns: of the library that is named, that is in use, or that is installed.

    Of several in use, or several installed, pandas comes before polars and pyarrow. Where none is installed,
    it is a structured array of numpy: ``len`` of it are the rows, ``found["target"]`` is a column.

    `library`: One of `LIBRARIES`.

    Raises `InputError` if there is no such library.
    """
    if library is not None and library not in LIBRARIES:
        raise InputError.at(Place("to_frame"), f"{library!r} is unknown; {did_you_mean(library, LIBRARIES)}")
    chosen = library or _find_library_here()
    if chosen is None:
        return _make_structured(columns)
    try:
        import narwhals as nw  # noqa: PLC0415 - for who makes a frame

        return nw.from_dict(dict(columns), backend=chosen).to_native()
    except ModuleNotFoundError as error:
        message = f"{chosen} is not installed; install it: pip install {chosen}"
        raise InputError.at(Place("to_frame"), message) from error


def _make_structured(columns: Mapping[str, NDArray[Any]]) -> NDArray[Any]:
    rows = len(next(iter(columns.values()), ()))
    found = np.empty(rows, dtype=[(name, column.dtype) for name, column in columns.items()])
    for name, column in columns.items():
        found[name] = column
    return found


def _find_library_here() -> Library | None:
    """Return the library of frames that is in use, or else one that is installed; None if there is none."""
    in_use = [each for each in LIBRARIES if each in sys.modules]
    return next(iter(in_use), None) or next((each for each in LIBRARIES if find_spec(each)), None)


def library_of(frame: Any) -> Library | None:
    """Return the library that a frame is of; None for anything else."""
    name = type(frame).__module__.partition(".")[0]
    return next((each for each in LIBRARIES if each == name), None)


def columns_of(frame: Any) -> dict[str, NDArray[Any]] | None:
    """Return the columns of anything that has named ones; None if it has none.

    A frame of any library that narwhals knows, lazy ones collected; a mapping of arrays; a structured array.
    """
    if isinstance(frame, Mapping):
        return {str(name): np.asarray(column) for name, column in frame.items()}
    if isinstance(frame, np.ndarray):
        names = frame.dtype.names
        return None if names is None else {name: np.asarray(frame[name]) for name in names}
    if isinstance(frame, str | Path):
        return None
    import narwhals as nw  # noqa: PLC0415 - for who reads a frame

    found = nw.from_native(frame, pass_through=True)
    if isinstance(found, nw.LazyFrame):
        found = found.collect()
    if not isinstance(found, nw.DataFrame):
        return None
    return {str(name): found[name].to_numpy() for name in found.columns}


def table_html(columns: Mapping[str, NDArray[Any]]) -> str:
    """Return columns as a table for a notebook, the middle of a long one left out."""
    rows = list(zip(*(column.tolist() for column in columns.values()), strict=True))
    if len(rows) > _MOST_SHOWN:
        half = _MOST_SHOWN // 2
        rows = [*rows[:half], ("…",) * len(columns), *rows[-half:]]
    return as_html(tuple(columns), rows)


def as_html(head: Sequence[str], rows: Iterable[Sequence[Any]], caption: str = "") -> str:
    """Return a table for a notebook: texts escaped, numbers to a few digits, nothing where nothing is."""
    above = f"<caption>{html.escape(caption)}</caption>" if caption else ""
    titles = "".join(f"<th>{html.escape(title)}</th>" for title in head)
    body = "".join(f"<tr>{''.join(f'<td>{_show_cell(cell)}</td>' for cell in row)}</tr>" for row in rows)
    return f"<table>{above}<thead><tr>{titles}</tr></thead><tbody>{body}</tbody></table>"


def _show_cell(cell: Any) -> str:
    if cell is None or (isinstance(cell, float) and np.isnan(cell)):
        return ""
    return html.escape(f"{cell:.{_DIGITS}g}" if isinstance(cell, float) else str(cell))
