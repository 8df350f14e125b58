"""Workbooks of spreadsheets (``.xlsx``), read as the lines of the one sheet that holds something."""

from __future__ import annotations

import zipfile
from collections.abc import Iterable, Iterator
from datetime import date
from io import BytesIO

from zlmreport.errors import InputError, Place, quoted

#: Beginning of every ZIP archive, and the part that makes one a workbook.
_ARCHIVE = b"PK\x03\x04"
_WORKBOOK = "xl/workbook.xml"
#: Between the cells of a line; no cell may hold it.
SEPARATOR = "\t"


def is_workbook(content: bytes) -> bool:
    """Return whether the bytes of a file are a workbook."""
    if not content.startswith(_ARCHIVE):
        return False
    try:
        with zipfile.ZipFile(BytesIO(content)) as archive:
            return _WORKBOOK in archive.namelist()
    except zipfile.BadZipFile:
        return False


def sheet_lines(content: bytes, file: Place, largest: int) -> list[str]:
    """Return the rows of the only sheet with content, cells apart by tabs; a formula as its last value.

    Raises `InputError` if it is damaged, unpacks to more than `largest` bytes, holds several sheets with
    content or none, or a cell that no line can hold.
    """
    from openpyxl import load_workbook  # noqa: PLC0415 (slow to load)

    try:
        with zipfile.ZipFile(BytesIO(content)) as archive:
            size = sum(part.file_size for part in archive.infolist())
        book = load_workbook(BytesIO(content), read_only=True, data_only=True) if size <= largest else None
        sheets = (
            {sheet.title: [*sheet.iter_rows(values_only=True)] for sheet in book.worksheets} if book else {}
        )
    except Exception as error:  # openpyxl raises whatever its XML parser meets
        raise InputError.at(
            file, "is a damaged workbook; save it again, or export the sheet as CSV"
        ) from error
    if book is None:
        raise InputError.at(file, f"unpacks to more than {largest >> 20} MiB; is this a test's workbook?")
    filled = {
        title: rows for title, rows in sheets.items() if any(cell is not None for row in rows for cell in row)
    }
    if len(filled) != 1:
        found = (
            f"{len(filled)} sheets with content: {', '.join(map(quoted, filled))}" if filled else "no content"
        )
        raise InputError.at(
            file,
            f"has {found}; a measurement file has one: save the sheet with the readings as a file of its own",
        )
    return list(_lines(next(iter(filled.values())), file))


def _lines(rows: Iterable[tuple[object, ...]], file: Place) -> Iterator[str]:
    for row, cells in enumerate(rows, 1):
        texts = [_text(value) for value in cells]
        for column, text in enumerate(texts, 1):
            if not text.isprintable():
                raise InputError.at(
                    Place(file.file, row, column),
                    "the cell holds a line break or a control character; remove it",
                )
        yield SEPARATOR.join(texts).rstrip(SEPARATOR)


def _text(value: object) -> str:
    """Return a cell as text: numbers with all their digits and a decimal point, times as in ISO 8601."""
    if value is None:
        return ""
    return value.isoformat() if isinstance(value, date) else str(value)
