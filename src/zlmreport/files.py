"""Writing files whole or not at all: the one place where the program opens a file to write it.

A file is written under a hidden name in its own folder and pushed to the disk; then it takes the place of
the one that is there, and the folder is pushed to the disk, so that a power cut leaves either the old file
or the new one. Only journals, to which each reading is added as it comes, are written where they lie.
"""

from __future__ import annotations

import contextlib
import errno
import os
import shutil
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from zlmreport.errors import AccessError, InputError, Place, Problem

#: Characters of a file's name that its hidden name repeats: a long name shall not become too long by that.
_REPEATED = 40
#: What a file system answers that knows no pushing of folders.
_NO_FOLDERS = {errno.EINVAL, errno.ENOTSUP}


@dataclass(frozen=True, slots=True)
class Document:
    """A finished file that has not been written yet."""

    path: Path
    content: bytes


def write(documents: Iterable[Document]) -> tuple[Path, ...]:
    """Write files: all of them, or none; folders are made for them, and files of their names replaced.

    Raises
    ------
    AccessError
        If one cannot be written, with its path; then all are as they were.
    """
    contents = {document.path: document.content for document in documents}
    try:
        for path in contents:
            with _naming(path):
                if path.is_dir():
                    raise IsADirectoryError(errno.EISDIR, "a folder of this name is in the way")
        with beside(contents, _hidden) as names:
            _take_places(names)
    except OSError as error:
        raise unwritable(Path(error.filename), error) from error
    return tuple(contents)


def rewrite(path: Path, content: bytes, check: Callable[[bytes], None]) -> None:
    """Write a file anew that is there: a link to it stays a link, and its rights stay.

    Parameters
    ----------
    path
        The file.
    content
        What it is to hold.
    check
        Gets what the file holds, last of all before it is replaced, and may refuse by an exception.

    Raises
    ------
    AccessError
        If it is not there or cannot be written.
    """
    try:
        real = path.resolve(strict=True)
        with beside({real: content}, _hidden) as names:
            shutil.copymode(real, names[real])
            check(real.read_bytes())
            take_names(names)
    except OSError as error:
        raise unwritable(path, error) from error


def cache_folder(environment: Mapping[str, str] = os.environ) -> Path | None:
    """Return the folder of this program among those that the user's system keeps for what can be made again.

    None where the user has no such folder.
    """
    folders = (Path(environment.get("XDG_CACHE_HOME", "")), Path(environment.get("HOME", ""), ".cache"))
    return next((each / "zlmreport" for each in folders if each.is_absolute()), None)


@contextlib.contextmanager
def beside(contents: Mapping[Path, bytes], hidden: Callable[[Path], Path]) -> Iterator[Mapping[Path, Path]]:
    """Write files under hidden names, and push them to the disk; what gets no name within is removed.

    Parameters
    ----------
    contents
        What each file is to hold.
    hidden
        The name of each until then, in the same folder.

    Yields
    ------
    Mapping
        The hidden file of each.

    Raises
    ------
    OSError
        If one cannot be written, with the name that it should have got.
    """
    names: dict[Path, Path] = {}
    touched: set[Path] = set()
    try:
        for path, content in contents.items():
            with _naming(path):
                touched |= _made(path.parent)
                names[path] = hidden(path)
                with names[path].open("wb") as file:
                    file.write(content)
                    file.flush()
                    os.fsync(file.fileno())
        for folder in touched:
            sync_folder(folder)
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
        with _naming(path):
            aside.replace(path)
    for folder in {path.parent for path in names}:
        sync_folder(folder)


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


def demand_free(paths: Iterable[Path]) -> None:
    """Refuse to write where there are files that somebody may have worked on.

    Raises
    ------
    InputError
        With every file that is there.
    """
    problems = [
        Problem(Place(str(path)), "is there already; choose another folder, or remove it")
        for path in paths
        if path.exists()
    ]
    if problems:
        raise InputError(problems)


def unwritable(path: Path, error: OSError, remedy: str = "") -> AccessError:
    """Return the error of a file that cannot be written, for the reason that the system gave."""
    return AccessError([Problem(Place(str(path)), f"cannot be written: {reason(error)}{remedy}")])


def unreadable(path: Path, error: OSError) -> AccessError:
    """Return the error of a file that cannot be read, for the reason that the system gave."""
    return AccessError([Problem(Place(str(path)), f"cannot be read: {reason(error)}")])


def reason(error: OSError) -> str:
    """Return why the system could not: ``no space left on device``."""
    said = error.strerror or str(error)
    return said[:1].lower() + said[1:]


def sync_folder(folder: Path) -> None:
    """Push the names in a folder to the disk, where the system has such a thing.

    Raises
    ------
    OSError
        If the disk refuses, with the folder.
    """
    try:
        handle = os.open(folder, os.O_RDONLY)
    except PermissionError:  # Windows opens no folders, and one may be for writing only
        return
    try:
        with _naming(folder):
            os.fsync(handle)
    except OSError as error:
        if error.errno not in _NO_FOLDERS:
            raise
    finally:
        os.close(handle)


@contextlib.contextmanager
def _naming(path: Path) -> Iterator[None]:
    """Let an error name the file that somebody asked for, and no hidden one."""
    try:
        yield
    except OSError as error:
        raise OSError(error.errno, error.strerror or str(error), str(path)) from error


def _hidden(path: Path) -> Path:
    return path.with_name(f".{path.name[:_REPEATED]}.{os.urandom(4).hex()}")


def _made(folder: Path) -> set[Path]:
    """Make a folder, and return it with those in which a folder was made for it."""
    missing = [each for each in (folder, *folder.parents) if not each.exists()]
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except (FileExistsError, NotADirectoryError) as error:
        raise OSError(error.errno, f"{error.filename} is a file and no folder") from error
    return {folder, *(each.parent for each in missing)}


def _remove(paths: Iterable[Path]) -> None:
    for path in paths:
        with contextlib.suppress(OSError):
            path.unlink(missing_ok=True)
