"""Files appear whole or not at all, and all of a job's or none."""

import os

import pytest

from zlmreport.errors import AccessError
from zlmreport.pipeline import Document, write


def test_documents_are_written_into_a_folder_that_is_made_for_them(tmp_path):
    folder = tmp_path / "a" / "b"
    written = write([Document(folder / "x.pdf", b"one"), Document(folder / "x.json", b"two")])
    assert [path.read_bytes() for path in written] == [b"one", b"two"]
    assert sorted(path.name for path in folder.iterdir()) == ["x.json", "x.pdf"]


def test_a_file_of_the_same_name_is_replaced(tmp_path):
    (tmp_path / "x.pdf").write_bytes(b"old")
    write([Document(tmp_path / "x.pdf", b"new")])
    assert (tmp_path / "x.pdf").read_bytes() == b"new"


def test_if_one_file_cannot_be_written_none_is_and_the_old_ones_stay(tmp_path):
    (tmp_path / "x.pdf").write_bytes(b"old")
    (tmp_path / "x.json").mkdir()
    with pytest.raises(AccessError, match=r"x\.json: cannot be written: a folder of this name"):
        write([Document(tmp_path / "x.pdf", b"new"), Document(tmp_path / "x.json", b"new")])
    assert (tmp_path / "x.pdf").read_bytes() == b"old"
    assert sorted(path.name for path in tmp_path.iterdir()) == ["x.json", "x.pdf"]


def test_a_folder_that_cannot_be_made_is_named(tmp_path):
    (tmp_path / "out").write_bytes(b"a file")
    with pytest.raises(AccessError, match="cannot be written"):
        write([Document(tmp_path / "out" / "x.pdf", b"new")])


def test_an_interrupt_leaves_nothing_behind(tmp_path, monkeypatch):
    def interrupted(_handle):
        raise KeyboardInterrupt

    monkeypatch.setattr(os, "fsync", interrupted)
    with pytest.raises(KeyboardInterrupt):
        write([Document(tmp_path / "x.pdf", b"new")])
    assert list(tmp_path.iterdir()) == []


def test_files_get_the_rights_that_the_user_gives_new_files(tmp_path):
    mask = os.umask(0o027)
    try:
        (path,) = write([Document(tmp_path / "x.pdf", b"new")])
    finally:
        os.umask(mask)
    assert path.stat().st_mode & 0o777 == 0o640


def test_nothing_to_write_is_nothing_written():
    assert write([]) == ()
