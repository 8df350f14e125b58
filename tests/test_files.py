"""Files appear whole or not at all, and all of a job's or none."""

import ast
import errno
import os
from collections.abc import Iterator
from pathlib import Path

import pytest

from environments import ROOT
from refusals import refused
from zlmreport.files import Document, push_folder, rewrite, write, write_new
from zlmreport.plugin import AccessError, InputError, Place

#: Where a file is opened for writing beside `files.py`, and why it may be.
EXCEPTIONS = {
    "src/zlmreport/cli/__init__.py": "the null device, for an output that nobody reads any more",
    "src/zlmreport/cli/fleet.py": "a log, added to",
    "src/zlmreport/fleet/database.py": "a lock, which holds who has it",
    "src/zlmreport/presence.py": "the null device, for a stream that a plugin closed",
    "src/zlmreport/testing/sources.py": "damaged copies in a temporary folder",
    "src/zlmreport/verification/attached.py": "a temporary folder",
    "src/zlmreport/verification/readers.py": "a temporary folder, for programs of the system",
}


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
    with pytest.raises(AccessError, match=r"x\.pdf: cannot be written: .*out is a file and no folder"):
        write([Document(tmp_path / "out" / "x.pdf", b"new")])


def test_a_disk_that_is_full_is_named_with_the_file_that_found_no_room(tmp_path, monkeypatch):
    def full(_handle):
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(AccessError, match=r"/x\.pdf: cannot be written: no space left on device"):
        write([Document(tmp_path / "x.pdf", b"new")])


def test_if_the_last_file_cannot_take_its_name_the_others_are_as_they_were(tmp_path, monkeypatch):
    """Some files may be replaced by their owner alone, which shows only when it is tried."""
    replaced = Path.replace

    def refused(aside, path):
        if path.name == "c.json":
            raise OSError(errno.EPERM, "Operation not permitted")
        return replaced(aside, path)

    (tmp_path / "a.pdf").write_bytes(b"old")
    monkeypatch.setattr(Path, "replace", refused)
    with pytest.raises(AccessError, match=r"c\.json: cannot be written: operation not permitted"):
        write([Document(tmp_path / name, b"new") for name in ("a.pdf", "b.csv", "c.json")])
    assert {path.name: path.read_bytes() for path in tmp_path.iterdir()} == {"a.pdf": b"old"}


def test_a_file_may_have_the_longest_name_that_there_is(tmp_path):
    (path,) = write([Document(tmp_path / ("x" * 251 + ".pdf"), b"new")])
    assert path.read_bytes() == b"new"


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


def test_a_file_that_a_check_refuses_is_left_as_it_is(tmp_path):
    def refused(found):
        raise InputError.at(Place("x"), found.decode())

    path = tmp_path / "x.yaml"
    path.write_bytes(b"theirs")
    with pytest.raises(InputError, match="theirs"):
        rewrite(path, b"mine", refused)
    assert [each.read_bytes() for each in tmp_path.iterdir()] == [b"theirs"]


def test_every_file_that_is_in_the_way_is_named_and_none_is_written(tmp_path):
    for name in "ab":
        (tmp_path / name).touch()
    told = refused(write_new, [Document(tmp_path / name, b"new") for name in "abc"])
    assert [Path(problem.place.file).name for problem in told.problems] == ["a", "b"]
    assert {each.name: each.read_bytes() for each in tmp_path.iterdir()} == {"a": b"", "b": b""}


def test_a_disk_that_pushes_no_folders_is_good_enough(tmp_path, monkeypatch):
    def unknown(_handle):
        raise OSError(errno.EINVAL, "Invalid argument")

    monkeypatch.setattr(os, "fsync", unknown)
    push_folder(tmp_path)


@pytest.mark.long
def test_no_other_module_opens_a_file_to_write_it():
    modules = [*ROOT.glob("src/**/*.py"), *ROOT.glob("plugins/*/**/*.py")]
    found = {path.relative_to(ROOT).as_posix() for path in modules if any(map(_is_writing, _calls(path)))}
    assert found - {"src/zlmreport/files.py"} == set(EXCEPTIONS)


def _calls(module: Path) -> Iterator[ast.Call]:
    return (node for node in ast.walk(ast.parse(module.read_bytes())) if isinstance(node, ast.Call))


def _is_writing(call: ast.Call) -> bool:
    name = ast.unparse(call.func)
    if name == "os.open":
        return any(flag in ast.unparse(call) for flag in ("O_WRONLY", "O_RDWR", "O_CREAT"))
    if name.rpartition(".")[2] == "open":
        return any(mode in ast.unparse(call) for mode in ("'w", "'a", "'x", "'r+"))
    return name.endswith((".write_text", ".write_bytes", "mkstemp", "NamedTemporaryFile", "fdopen"))
