"""A disk without power: what may lie on it after each operation, if what was not pushed to it is lost.

Operations are recorded while they happen. Then the power is cut after each of them, in thought: of a file any
part of what was not pushed may be there; of the names in a folder any of those that were not pushed.
"""

from __future__ import annotations

import itertools
import os
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import pytest

#: Name, and the number of the file that it has before and after; None for no file.
_Change = tuple[Path, int | None]


@dataclass
class Disk:
    """Records what happens to the files below a folder.

    Attributes
    ----------
    root
        The folder.
    operations
        What happened: contents of files by number, changes of names, pushes, and marks of the test.
    """

    root: Path
    operations: list[tuple[Any, ...]] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.before: dict[Path, int | None] = {path: path.stat().st_ino for path in self.root.rglob("*")}
        self.contents = {path.stat().st_ino: path.read_bytes() for path in self.before if path.is_file()}

    def mark(self, name: str) -> None:
        """Note that a call returned."""
        self.operations.append(("mark", name))

    def watch(self, monkeypatch: pytest.MonkeyPatch) -> None:
        """Record from now on."""
        for name in ("fsync", "write", "ftruncate"):
            monkeypatch.setattr(os, name, self._by_handle(name, getattr(os, name)))
        monkeypatch.setattr(os, "open", self._opened(os.open))
        monkeypatch.setattr(os, "link", self._named(os.link))
        monkeypatch.setattr(Path, "open", self._file(Path.open))
        for name in ("replace", "unlink", "mkdir"):
            monkeypatch.setattr(Path, name, self._named(getattr(Path, name)))

    def _by_handle(self, name: str, real: Callable[..., Any]) -> Callable[..., Any]:
        def call(handle: int, *more: Any) -> Any:
            done = real(handle, *more)
            path = Path(f"/proc/self/fd/{handle}").readlink()
            if path.is_relative_to(self.root):
                if path.is_file():
                    self.operations.append(("content", path.stat().st_ino, path.read_bytes()))
                if name == "fsync":
                    self.operations.append(("push", path, path.stat().st_ino))
            return done

        return call

    def _opened(self, real: Callable[..., Any]) -> Callable[..., Any]:
        def call(path: Any, flags: int, *more: Any, **settings: Any) -> Any:
            is_new = flags & os.O_CREAT and not os.path.lexists(path)
            handle = real(path, flags, *more, **settings)
            if is_new:
                self.operations.append(("names", ((Path(path), os.fstat(handle).st_ino),)))
            return handle

        return call

    def _file(self, real: Callable[..., Any]) -> Callable[..., Any]:
        def call(path: Path, mode: str = "r", *more: Any, **settings: Any) -> Any:
            opened = real(path, mode, *more, **settings)
            if "w" in mode and path.is_relative_to(self.root):
                self.operations.append(("names", ((path, path.stat().st_ino),)))
                write = opened.write

                class Watched:
                    def __enter__(watched) -> Any:  # noqa: N805
                        return watched

                    def __exit__(watched, *_: object) -> None:  # noqa: N805
                        opened.close()

                    def write(watched, content: bytes) -> int:  # noqa: N805
                        done: int = write(content)
                        opened.flush()
                        self.operations.append(("content", path.stat().st_ino, path.read_bytes()))
                        return done

                    flush = opened.flush
                    fileno = opened.fileno

                return Watched()
            return opened

        return call

    def _named(self, real: Callable[..., Any]) -> Callable[..., Any]:
        def call(*paths: Any, **settings: Any) -> Any:
            before = self._names()
            done = real(*paths, **settings)
            after = self._names()
            changed = [
                (path, after.get(path))
                for path in before.keys() | after.keys()
                if before.get(path) != after.get(path)
            ]
            if changed:
                self.operations.append(("names", tuple(sorted(changed, key=lambda each: each[1] is None))))
            return done

        return call

    def _names(self) -> dict[Path, int]:
        return {
            Path(folder, name): os.lstat(Path(folder, name)).st_ino
            for folder, folders, files in os.walk(self.root)
            for name in (*folders, *files)
        }

    def after_power_cuts(self) -> Iterator[tuple[list[str], dict[str, bytes]]]:
        """Yield the marks that were passed, and files that may be there, for each cut."""
        for end in range(len(self.operations) + 1):
            passed = [each[1] for each in self.operations[:end] if each[0] == "mark"]
            yield from ((passed, files) for files in self._left(self.operations[:end]))

    def _left(self, operations: list[tuple[Any, ...]]) -> Iterator[dict[str, bytes]]:
        pushed, latest = dict(self.contents), dict(self.contents)
        names, waiting = dict(self.before), list[tuple[_Change, ...]]()
        for operation in operations:
            match operation:
                case ("content", number, content):
                    latest[number] = content
                case ("names", changes):
                    waiting.append(changes)
                case ("push", folder, _) if folder.is_dir():
                    _push_names(folder, names, waiting)
                case ("push", _, number):
                    pushed[number] = latest.get(number, b"")
        for kept in itertools.product((False, True), repeat=len(waiting)):
            there = dict(names)
            for change in itertools.compress(waiting, kept):
                there.update(change)
            for torn in (0.0, 0.5, 1.0):
                yield {
                    str(path.relative_to(self.root)): _torn(pushed.get(number, b""), latest[number], torn)
                    for path, number in there.items()
                    if number in latest and (path.parent == self.root or there.get(path.parent))
                }


def _push_names(folder: Path, names: dict[Path, int | None], waiting: list[tuple[_Change, ...]]) -> None:
    """Let changes of names in a folder be on the disk; a change is one, whatever else is lost."""
    for change in [each for each in waiting if any(path.parent == folder for path, _ in each)]:
        names.update(change)
        waiting.remove(change)


def _torn(pushed: bytes, latest: bytes, share: float) -> bytes:
    """Return what is there of a file of which a share of what was written behind came to the disk."""
    if latest.startswith(pushed):
        return pushed + latest[len(pushed) : len(pushed) + int(share * (len(latest) - len(pushed)))]
    return latest if share == 1.0 else pushed
