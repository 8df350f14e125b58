"""Workbooks of spreadsheets (``.xlsx``), read as the lines of one sheet."""

from __future__ import annotations

import zipfile
from collections.abc import Iterable, Iterator
from datetime import date
from io import BytesIO

from zlmreport.errors import InputError, Place, did_you_mean, quoted

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


def read_sheet_lines(content: bytes, file: Place, largest: int, sheet: str | None = None) -> list[str]:
    """Return the rows of a sheet, cells apart by tabs; a formula as its last value.

    `sheet`: Its name; None for the only one that holds something.

    Raises `InputError` if the workbook is damaged, unpacks to more than `largest` bytes, has no such sheet,
    or none or several with content where none is named; or a cell that no line can hold.
    """
    filled = read_filled_sheets(content, file, largest)
    if sheet is not None and sheet not in filled:
        raise InputError.at(
            file, f"has no sheet {quoted(sheet)} that holds something; {did_you_mean(sheet, list(filled))}"
        )
    if sheet is None and len(filled) != 1:
        found = (
            f"has {len(filled)} sheets with content: {', '.join(map(quoted, filled))}; say which one in the "
            f"job, as in 'sheet: {next(iter(filled))}'"
            if filled
            else "has no content; a measurement file holds readings"
        )
        raise InputError.at(file, found)
    return list(_write_lines(filled[sheet or next(iter(filled))], file))


def read_filled_sheets(content: bytes, file: Place, largest: int) -> dict[str, list[tuple[object, ...]]]:
    """Return the rows of each sheet that holds something, by its name, in the order of the workbook.

    Raises `InputError` if the workbook is damaged, or unpacks to more than `largest` bytes.
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
    return {
        title: rows for title, rows in sheets.items() if any(cell is not None for row in rows for cell in row)
    }


def _write_lines(rows: Iterable[tuple[object, ...]], file: Place) -> Iterator[str]:
    for row, cells in enumerate(rows, 1):
        texts = [_write_cell(value) for value in cells]
        for column, text in enumerate(texts, 1):
            if not text.isprintable():
                raise InputError.at(
                    Place(file.file, row, column), "the cell holds a control character; remove it"
                )
        yield SEPARATOR.join(texts).rstrip(SEPARATOR)


def _write_cell(value: object) -> str:
    """Return a cell as text: numbers with all their digits and a decimal point, times as in ISO 8601.

    A line break in a cell, as in a heading with its unit below, is a blank, as are blanks of other kinds.
    """
    if value is None:
        return ""
    return value.isoformat() if isinstance(value, date) else " ".join(str(value).split())
