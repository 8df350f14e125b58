"""Reads and writes files: whole or not at all, inside a folder, journals and their lock; what fails.

A file is written under a hidden name in its own folder and pushed to the disk; then it takes the place of
the one that is there, and the folder is pushed to the disk, so that a power cut leaves either the old file
or the new one. Only journals, to which each reading is added as it comes, are written where they lie: what
was added is on the disk when the call returns. While the program is confined to a folder, it reads and writes
nothing outside.
"""

from __future__ import annotations

import contextlib
import errno
import os
import shutil
import stat
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Self

from zlmreport.errors import AccessError, InputError, Place, Problem

#: Characters of a file's name that its hidden name repeats: a long name shall not become too long by that.
_REPEATED = 40
#: What a file system answers that knows no pushing of folders.
_NO_FOLDERS = {errno.EINVAL, errno.ENOTSUP}


#: A pipe is opened without waiting for whoever writes into it, a terminal without becoming this program's.
_WITHOUT_WAITING = getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_NOCTTY", 0) | getattr(os, "O_BINARY", 0)

#: The folder outside of which nothing is read or written; of the process: threads have no part in contexts.
_confinement: Path | None = None


@contextlib.contextmanager
def confine(folder: Path | None) -> Iterator[None]:
    """Read and write only in a folder, instead of in the one until now; as until now for None.

    What a link leads to counts, and not where the link lies. Plug-ins that open files by themselves are
    bound only in the paths that they get from a job.
    """
    global _confinement  # noqa: PLW0603 - nobody else sets it
    before = _confinement
    _confinement = before if folder is None else Path(os.path.realpath(folder))
    try:
        yield
    finally:
        _confinement = before


def find_confinement() -> Path | None:
    """Return the folder to which the program is confined."""
    return _confinement


def say_outside(path: Path) -> str:
    """Return why a path must not be touched while the program is confined; empty if it may be."""
    if _confinement is None or Path(os.path.realpath(path)).is_relative_to(_confinement):
        return ""
    return f"it lies outside of {_confinement}, to which this run is confined"


def read(path: Path, most: int) -> bytes:
    """Return what a file holds; of one that is longer than `most` bytes, the beginning, and one byte more.

    Raises `OSError` if it cannot be read, is no file but a folder, a device or a pipe, or lies outside of the
    folder to which the program is confined.
    """
    with _name_in_errors(path):
        _demand_inside(path)
        try:
            handle = os.open(path, os.O_RDONLY | _WITHOUT_WAITING)
        except ValueError as error:  # a name that no file system takes
            raise OSError(errno.EINVAL, str(error)) from error
        try:
            _demand_a_file(os.fstat(handle).st_mode)
            with os.fdopen(handle, "rb", closefd=False) as file:
                return file.read(most + 1)
        finally:
            os.close(handle)


def demand(path: Path, most: int, named_at: Place | None = None) -> bytes:
    """Return what a file holds, as `read` does; raise `AccessError` if it cannot be read.

    `named_at`: Where somebody names the file; it is told of there.
    """
    try:
        return read(path, most)
    except OSError as error:
        if named_at:
            raise AccessError.at(named_at, f"{path} cannot be read: {say_reason(error)}") from error
        raise make_unreadable(path, error) from error


def _demand_a_file(mode: int) -> None:
    if stat.S_ISDIR(mode):
        raise OSError(errno.EISDIR, "it is a folder; name the file in it")
    if not stat.S_ISREG(mode):
        raise OSError(errno.EINVAL, "it is no file but a device or a pipe")


def _demand_inside(path: Path) -> None:
    reason = say_outside(path)
    if reason:
        raise OSError(errno.EACCES, reason)


@dataclass(frozen=True, slots=True)
class Document:
    """A finished file that has not been written yet."""

    path: Path
    content: bytes


def write(documents: Iterable[Document]) -> tuple[Path, ...]:
    """Write files: all of them, or none; folders are made for them, and files of their names replaced.

    Raises `AccessError` if one cannot be written, with its path; then all are as they were.
    """
    contents = {document.path: document.content for document in documents}
    try:
        for path in contents:
            with _name_in_errors(path):
                if path.is_dir():
                    raise IsADirectoryError(errno.EISDIR, "a folder of this name is in the way")
        with write_beside(contents, _hide_path) as names:
            _take_places(names)
    except OSError as error:
        raise make_unwritable(Path(error.filename), error) from error
    return tuple(contents)


def rewrite(path: Path, content: bytes, check: Callable[[bytes], None]) -> None:
    """Write a file anew that is there: a link to it stays a link, and its rights stay.

    `check`: Gets what the file holds, last of all before it is replaced, and may refuse by an exception.

    Raises `AccessError` if it is not there or cannot be written.
    """
    try:
        real = path.resolve(strict=True)
        with write_beside({real: content}, _hide_path) as names:
            shutil.copymode(real, names[real])
            check(real.read_bytes())
            take_names(names)
    except OSError as error:
        raise make_unwritable(path, error) from error


def find_cache_folder() -> Path | None:
    """Return the folder of this program among those that the user's system keeps for what can be made again.

    None where the user has no such folder.
    """
    folders = (Path(os.environ.get("XDG_CACHE_HOME", "")), Path(os.environ.get("HOME", ""), ".cache"))
    return next((each / "zlmreport" for each in folders if each.is_absolute()), None)


@contextlib.contextmanager
def write_beside(
    contents: Mapping[Path, bytes], hidden: Callable[[Path], Path]
) -> Iterator[Mapping[Path, Path]]:
    """Write files under hidden names, and push them to the disk; what gets no name within is removed.

    Raises `OSError` if one cannot be written, with the name that it should have got.

    Yields
    ------
    Mapping
        The hidden file of each.
    """
    names: dict[Path, Path] = {}
    touched: set[Path] = set()
    try:
        for path, content in contents.items():
            with _name_in_errors(path):
                _demand_inside(path.parent)
                touched |= _make_folder(path.parent)
                names[path] = hidden(path)
                with names[path].open("wb") as file:
                    file.write(content)
                    file.flush()
                    os.fsync(file.fileno())
        for folder in touched:
            push_folder(folder)
        yield names
    finally:  # an interrupt, too, leaves nothing behind
        _remove(names.values())


def take_names(names: Mapping[Path, Path]) -> None:
    """Give files that lie under hidden names their own, and push those to the disk.

    Raises
    ------
    OSError
        If one cannot have it, with that name; those before it have theirs.
    """
    for path, aside in names.items():
        with _name_in_errors(path):
            aside.replace(path)
    for folder in {path.parent for path in names}:
        push_folder(folder)


def _take_places(names: Mapping[Path, Path]) -> None:
    """Give files their names; if one cannot have it, the others are as they were before."""
    new = [path for path in names if not os.path.lexists(path)]
    kept: dict[Path, Path] = {}
    try:
        if len(names) > 1:
            for path in names.keys() - new:
                with contextlib.suppress(OSError):  # a disk without second names for a file
                    kept[path] = names[path].with_name(f"{names[path].name}.old")
                    os.link(path, kept[path], follow_symlinks=False)
        take_names(names)
    except OSError:
        for path, aside in names.items():
            if not os.path.lexists(aside):
                with contextlib.suppress(OSError):
                    path.unlink() if path in new else kept[path].replace(path)
        raise
    finally:
        _remove(kept.values())


class Closable:
    """What is closed when it is left as a context manager."""

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_raised: object) -> None:
        self.close()

    def close(self) -> None:
        """Close it."""
        raise NotImplementedError


class Appended(Closable):
    """A file to which records are added where it lies; leave it as a context manager.

    `path`: The file; it and its folder are made if they are not there.

    Raises `OSError` if it cannot be written.
    """

    def __init__(self, path: Path) -> None:
        self._path = path
        with _name_in_errors(path):
            _demand_inside(path)
            folders = _make_folder(path.parent)
            self._handle = os.open(path, os.O_RDWR | os.O_CREAT | os.O_APPEND | _WITHOUT_WAITING, 0o666)
        try:
            for folder in folders:
                push_folder(folder)
        except OSError:
            self.close()
            raise

    def close(self) -> None:
        """Close it, and let others have it; nothing happens the second time."""
        if self._handle >= 0:
            handle, self._handle = self._handle, -1
            os.close(handle)

    def lock(self) -> None:
        """Keep others from having it as well; raise `OSError` if another has it."""
        import fcntl  # noqa: PLC0415 - not on every system

        fcntl.flock(self._handle, fcntl.LOCK_EX | fcntl.LOCK_NB)

    def append(self, record: bytes) -> None:
        """Add a record; when this returns, a power cut cannot take it away.

        Raises `OSError` if the disk does not take it; then nothing of it is there.
        """
        with _name_in_errors(self._path):
            before = os.fstat(self._handle).st_size
            try:
                while record:
                    record = record[os.write(self._handle, record) :]
                os.fsync(self._handle)
            except OSError:
                with contextlib.suppress(OSError):
                    os.ftruncate(self._handle, before)
                raise

    def cut(self, length: int) -> None:
        """Cut away what stands behind so many bytes."""
        with _name_in_errors(self._path):
            os.ftruncate(self._handle, length)
            os.fsync(self._handle)


def is_locked(path: Path) -> bool:
    """Return whether another writes a file that is added to."""
    try:
        import fcntl  # noqa: PLC0415 - not on every system

        with path.open("rb") as file:
            fcntl.flock(file, fcntl.LOCK_SH | fcntl.LOCK_NB)
    except BlockingIOError:
        return True
    except (ImportError, OSError):
        return False
    return False


class JournalFile(Appended):
    """The file of a journal: one writer has it, and what goes wrong is said to who can mend it.

    Parameters
    ----------
    path
        The file; it and its folder are made if they are not there.
    busy
        What to do when another has it.
    after
        What to do when a record cannot be written.

    Raises
    ------
    AccessError
        If it cannot be written, or another has it.
    """

    def __init__(self, path: Path, busy: str, after: str = "") -> None:
        self._after = after
        try:
            super().__init__(path)
        except OSError as error:
            raise make_unwritable(path, error) from error
        try:
            self.lock()
        except OSError as error:
            self.close()
            raise AccessError.at(Place(str(path)), busy) from error

    def append(self, record: bytes) -> None:
        """Add a record; raise `AccessError` if the disk does not take it."""
        try:
            super().append(record)
        except OSError as error:
            raise make_unwritable(self._path, error, self._after) from error


def write_new(documents: Sequence[Document]) -> tuple[Path, ...]:
    """Write files, as `write` does, but none over one that is there: somebody may have worked on it.

    Raises `InputError` with every file that is there.
    """
    problems = [
        Problem(Place(str(document.path)), "is there already; choose another folder, or remove it")
        for document in documents
        if document.path.exists()
    ]
    if problems:
        raise InputError(problems)
    return write(documents)


def make_unwritable(path: Path, error: OSError, remedy: str = "") -> AccessError:
    """Return the error of a file that cannot be written, for the reason that the system gave."""
    return AccessError([Problem(Place(str(path)), f"cannot be written: {say_reason(error)}{remedy}")])


def make_unreadable(path: Path, error: OSError) -> AccessError:
    """Return the error of a file that cannot be read, for the reason that the system gave."""
    return AccessError([Problem(Place(str(path)), f"cannot be read: {say_reason(error)}")])


def say_reason(error: OSError) -> str:
    """Return why the system could not: ``no space left on device``."""
    said = error.strerror or str(error)
    return said[:1].lower() + said[1:]


def push_folder(folder: Path) -> None:
    """Push the names in a folder to the disk, where the system has such a thing.

    Raises `OSError` if the disk refuses, with the folder.
    """
    try:
        handle = os.open(folder, os.O_RDONLY)
    except PermissionError:  # Windows opens no folders, and one may be for writing only
        return
    try:
        with _name_in_errors(folder):
            os.fsync(handle)
    except OSError as error:
        if error.errno not in _NO_FOLDERS:
            raise
    finally:
        os.close(handle)


@contextlib.contextmanager
def _name_in_errors(path: Path) -> Iterator[None]:
    """Let an error name the file that somebody asked for, and no hidden one."""
    try:
        yield
    except OSError as error:
        raise OSError(error.errno, error.strerror or str(error), str(path)) from error


def _hide_path(path: Path) -> Path:
    return path.with_name(f".{path.name[:_REPEATED]}.{os.urandom(4).hex()}")


def _make_folder(folder: Path) -> set[Path]:
    """Make a folder, and return it with those in which a folder was made for it."""
    missing = [each for each in (folder, *folder.parents) if not each.exists()]
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except (FileExistsError, NotADirectoryError) as error:
        in_the_way = next((each for each in (folder, *folder.parents) if each.is_file()), error.filename)
        raise OSError(error.errno, f"{in_the_way} is a file and no folder") from error
    return {folder, *(each.parent for each in missing)}


def _remove(paths: Iterable[Path]) -> None:
    for path in paths:
        with contextlib.suppress(OSError):
            path.unlink(missing_ok=True)
