"""Certificates appear whole, under their own names, and what an interruption left is put right."""

from __future__ import annotations

from pathlib import Path

import pytest

from zlmreport.fleet.basis import FileStamp, KnownFile, is_intact
from zlmreport.fleet.issuing import lay, tidy
from zlmreport.fleet.making import FinishedFile

FILES = (FinishedFile(".pdf", "m/X/CAL-1.pdf", b"pages"), FinishedFile(".json", "m/X/CAL-1.json", b"{}"))


def names(folder: Path) -> set[str]:
    return {path.name for path in folder.rglob("*") if path.is_file()}


def left_behind(folder: Path) -> tuple[KnownFile, ...]:
    """Leave the files under their hidden names, as a kill does; return what a ledger would know of them."""
    with lay(folder, FILES) as files:
        hidden = {path: path.read_bytes() for path in files.names.values()}
    for path, content in hidden.items():
        path.write_bytes(content)
    return files.known


def test_files_have_no_names_before_the_ledger_has_them(tmp_path: Path) -> None:
    with lay(tmp_path, FILES) as files:
        assert not names(tmp_path) & {"CAL-1.pdf", "CAL-1.json"}
        assert len(names(tmp_path)) == 2
        files.name_files()
    assert names(tmp_path) == {"CAL-1.pdf", "CAL-1.json"}


def test_what_the_ledger_refuses_leaves_nothing(tmp_path: Path) -> None:
    with pytest.raises(RuntimeError), lay(tmp_path, FILES):
        raise RuntimeError
    assert not names(tmp_path)


def test_the_ledger_knows_the_files_as_they_lie_there(tmp_path: Path) -> None:
    with lay(tmp_path, FILES) as files:
        files.name_files()
    for known, file in zip(files.known, FILES, strict=True):
        assert (known.path, known.sha256) == (file.path, file.sha256)
        assert known.look == FileStamp.at(tmp_path / file.path)


def test_files_that_the_ledger_took_over_get_their_names(tmp_path: Path) -> None:
    known = left_behind(tmp_path)
    assert tidy(tmp_path, known) == 2
    assert (tmp_path / "m/X/CAL-1.pdf").read_bytes() == b"pages"
    assert names(tmp_path) == {"CAL-1.pdf", "CAL-1.json"}


def test_files_that_were_never_issued_go(tmp_path: Path) -> None:
    left_behind(tmp_path)
    assert tidy(tmp_path, ()) == 0
    assert not names(tmp_path)


def test_a_file_that_is_not_whole_gets_no_name(tmp_path: Path) -> None:
    known = left_behind(tmp_path)
    (hidden,) = (path for path in tmp_path.rglob("*.zlmreport-new") if "pdf" in path.name)
    hidden.write_bytes(b"pa")
    assert tidy(tmp_path, known) == 1
    assert names(tmp_path) == {"CAL-1.json"}


def test_other_files_are_left_alone(tmp_path: Path) -> None:
    (tmp_path / ".hidden").touch()
    (tmp_path / "CAL-0.pdf").touch()
    tidy(tmp_path, ())
    assert names(tmp_path) == {".hidden", "CAL-0.pdf"}


@pytest.mark.parametrize(
    ("content", "intact"), [(b"pages", True), (b"pages, signed", True), (b"paper", False), (b"pag", False)]
)
def test_a_pdf_is_as_it_was_issued_if_it_begins_so(tmp_path: Path, content: bytes, *, intact: bool) -> None:
    with lay(tmp_path, FILES[:1]) as files:
        files.name_files()
    path = tmp_path / "m/X/CAL-1.pdf"
    path.write_bytes(content)
    assert is_intact(path, files.known[0]) is intact


def test_to_any_other_file_nothing_may_be_added(tmp_path: Path) -> None:
    with lay(tmp_path, FILES[1:2]) as files:
        files.name_files()
    path = tmp_path / files.known[0].path
    path.write_bytes(path.read_bytes() + b" ")
    assert not is_intact(path, files.known[0])
