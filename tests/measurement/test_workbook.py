"""Of a workbook the sheet is read that the job names, or the only one that holds something."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

import pytest
from openpyxl import Workbook

from refusals import refusal
from zlmreport.plugin import InputError
from zlmreport.plugin.source import read_text, sheets_of

_READINGS = [["target", "1+", "1-"], [0, 0.1, -1e-05], [100, "1,3", None]]


def _saved(folder: Path, sheets: Mapping[str, Sequence[Sequence[object]]]) -> Path:
    book = Workbook()
    book.remove(book.active)
    for title, rows in sheets.items():
        sheet = book.create_sheet(title)
        for row in rows:
            sheet.append(row)
    path = folder / "readings.xlsx"
    book.save(path)
    return path


def _complaint(path: Path) -> str:
    return refusal(read_text, path).removeprefix(f"{path.parent}/")


def test_its_rows_are_lines_with_all_digits_and_empty_cells(tmp_path: Path) -> None:
    text = read_text(_saved(tmp_path, {"Notes": [], "Readings": _READINGS}))
    assert text.lines == ("target\t1+\t1-", "0\t0.1\t-1e-05", "100\t1,3")


def test_a_place_in_it_is_row_and_column(tmp_path: Path) -> None:
    text = read_text(_saved(tmp_path, {"Readings": _READINGS}))
    assert text.place(2, len("0\t0.1\t") + 1).column == 3


def test_the_workbook_itself_is_the_file_that_is_identified(tmp_path: Path) -> None:
    path = _saved(tmp_path, {"Readings": _READINGS})
    assert read_text(path).source.content == path.read_bytes()


def test_of_two_sheets_with_content_none_is_chosen(tmp_path: Path) -> None:
    path = _saved(tmp_path, {"Before": _READINGS, "After": _READINGS})
    assert _complaint(path) == (
        "readings.xlsx: has 2 sheets with content: 'Before', 'After'; say which one in the job, as in "
        "'sheet: Before'"
    )


def test_a_workbook_without_content_is_refused(tmp_path: Path) -> None:
    assert "has no content" in _complaint(_saved(tmp_path, {"Readings": []}))


def test_the_sheet_that_is_named_is_read(tmp_path: Path) -> None:
    path = _saved(tmp_path, {"Before": _READINGS, "After": [["target"], [1]]})
    assert read_text(path, sheet="After").lines == ("target", "1")
    assert sheets_of(path) == ("Before", "After")


def test_a_sheet_that_is_not_there_is_answered_with_its_name(tmp_path: Path) -> None:
    path = _saved(tmp_path, {"Before": _READINGS, "After": _READINGS})
    with pytest.raises(InputError, match="did you mean 'Before'"):
        read_text(path, sheet="before ")


def test_a_line_break_in_a_cell_is_a_blank(tmp_path: Path) -> None:
    path = _saved(tmp_path, {"Readings": [["target", "Deviation\n[µm]\u00a0"]]})
    assert read_text(path).lines == ("target\tDeviation [µm]",)


def test_a_cell_with_a_control_character_has_its_place(tmp_path: Path) -> None:
    path = _saved(tmp_path, {"Readings": [["target", "un\u200bseen"]]})
    assert _complaint(path).startswith("readings.xlsx:1:2: the cell holds a control character")


def test_a_damaged_workbook_is_refused(tmp_path: Path) -> None:
    path = _saved(tmp_path, {"Readings": _READINGS})
    content = bytearray(path.read_bytes())
    content[200:260] = b"\xff" * 60
    path.write_bytes(content)
    assert "is a damaged workbook" in _complaint(path)


def test_a_workbook_that_unpacks_to_too_much_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("zlmreport.measurement.text_file._LARGEST_UNPACKED", 100)
    assert "unpacks to more than" in _complaint(_saved(tmp_path, {"Readings": _READINGS}))
