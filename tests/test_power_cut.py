"""A power cut at any moment leaves a file old or new, and of a journal all that was kept."""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path
from types import ModuleType

import pytest

from power import Disk
from zlmreport import files

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="asks Linux for the names of open files")

_OLD, _NEW = b"old " * 20, b"the new content " * 20
_RECORDS = [b"first record\n", b"second record\n", b"third record\n"]
#: What holds of the marks passed and the files left.
Check = Callable[[list[str], dict[str, bytes]], bool]


def _one(module: ModuleType, disk: Disk) -> Check:
    module.write([module.Document(disk.root / "x.pdf", _NEW)])
    disk.mark("written")
    return lambda passed, left: left.get("x.pdf") in ([_NEW] if passed else [_OLD, _NEW])


def _several(module: ModuleType, disk: Disk) -> Check:
    new = {name: _NEW + name.encode() for name in ("x.pdf", "y.json")}
    module.write([module.Document(disk.root / name, content) for name, content in new.items()])
    disk.mark("written")

    def holds(passed: list[str], left: dict[str, bytes]) -> bool:
        before = {"x.pdf": _OLD, "y.json": None}
        return all(left.get(name) in ([new[name]] if passed else [before[name], new[name]]) for name in new)

    return holds


def _in_a_new_folder(module: ModuleType, disk: Disk) -> Check:
    module.write([module.Document(disk.root / "a" / "b" / "x.pdf", _NEW)])
    disk.mark("written")
    return lambda passed, left: left.get("a/b/x.pdf") in ([_NEW] if passed else [None, _NEW])


def _edited(module: ModuleType, disk: Disk) -> Check:
    module.rewrite(disk.root / "x.pdf", _NEW, lambda _: None)
    disk.mark("written")
    return lambda passed, left: left.get("x.pdf") in ([_NEW] if passed else [_OLD, _NEW])


def _journal(module: ModuleType, disk: Disk) -> Check:
    with module.Appended(disk.root / "new" / "x.journal") as journal:
        for record in _RECORDS:
            journal.append(record)
            disk.mark(record.decode())
    whole = b"".join(_RECORDS)

    def holds(passed: list[str], left: dict[str, bytes]) -> bool:
        found = left.get("new/x.journal", b"")
        return whole.startswith(found) and found.startswith("".join(passed).encode())

    return holds


def _cut(module: ModuleType, disk: Disk) -> Check:
    """What was torn off is cut away before anything is added behind it."""
    with module.Appended(disk.root / "x.pdf") as journal:
        journal.cut(4)
        disk.mark("cut")
    return lambda passed, left: left.get("x.pdf") in ([_OLD[:4]] if passed else [_OLD, _OLD[:4]])


_DEEDS = {
    each.__name__.strip("_"): each for each in (_one, _several, _in_a_new_folder, _edited, _journal, _cut)
}


def _broken(
    deed: Callable[[ModuleType, Disk], Check], module: ModuleType, folder: Path
) -> list[dict[str, bytes]]:
    """Return what may be left that must not be."""
    folder.mkdir()
    (folder / "x.pdf").write_bytes(_OLD)
    with pytest.MonkeyPatch.context() as patched:
        disk = Disk(folder)
        disk.watch(patched)
        holds = deed(module, disk)
    cuts = list(disk.after_power_cuts())
    assert len(cuts) > 10
    return [left for passed, left in cuts if not holds(passed, left)]


@pytest.mark.parametrize("deed", _DEEDS.values(), ids=_DEEDS)
def test_whenever_the_power_goes_a_file_is_old_or_new(
    deed: Callable[[ModuleType, Disk], Check], tmp_path: Path
) -> None:
    assert _broken(deed, files, tmp_path / "disk") == []


#: Each push to the disk in the module that writes: what stands there, and behind which words.
_PUSHES = {
    "of a file": ("os.fsync(file.fileno())", "file.flush()"),
    "of a new folder": ("push_folder(folder)", "for folder in touched:"),
    "of names": ("push_folder(folder)", "for folder in {path.parent for path in names}:"),
    "of a record": ("os.fsync(self._handle)", "record = record[os.write(self._handle, record) :]"),
    "of a journal's name": ("push_folder(folder)", "for folder in folders:"),
    "of a cut": ("os.fsync(self._handle)", "os.ftruncate(self._handle, length)"),
}


@pytest.mark.parametrize("planted", _PUSHES)
def test_a_push_that_is_left_out_shows(planted: str, tmp_path: Path) -> None:
    push, behind = _PUSHES[planted]
    source = Path(files.__file__).read_text(encoding="utf-8")
    start = source.index(push, source.index(behind))
    changed = source[:start] + "pass" + source[start + len(push) :]
    module = ModuleType("files_without_a_push")
    sys.modules[module.__name__] = module  # dataclasses look there
    try:
        exec(compile(changed, "files.py", "exec"), module.__dict__)
        found = [_broken(deed, module, tmp_path / name) for name, deed in _DEEDS.items()]
    finally:
        del sys.modules[module.__name__]
    assert any(found)


def test_every_push_of_the_module_is_left_out_once() -> None:
    source = Path(files.__file__).read_text(encoding="utf-8")
    pushes = source.count("os.fsync(") + source.count("push_folder(") - 2  # its definition, and its own push
    assert pushes == len(_PUSHES)
