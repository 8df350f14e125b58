"""A file of keys that is not a job: read, checked, with the place of each key."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Generic, TypeVar

from pydantic import BaseModel

from zlmreport.errors import InputError, Place, Problem
from zlmreport.job.contradictions import validate
from zlmreport.job.extends import FileFormat, read_composition, refuse_other_format
from zlmreport.job.tree import Keys, place_of
from zlmreport.measurement.provenance import SourceFile

Model = TypeVar("Model", bound=BaseModel)


@dataclass(frozen=True, slots=True)
class KeysFile(Generic[Model]):
    """A checked file of keys.

    Attributes
    ----------
    keys
        What it says, in users' units.
    file
        Its name, digest and bytes.
    tree
        What it says, value by value, with the places.
    extended
        The files that it extends.
    """

    keys: Model
    file: SourceFile
    tree: Keys
    extended: tuple[SourceFile, ...] = ()

    def place_of(self, *steps: str | int) -> Place:
        """Return where a key stands; of one that is missing, its nearest parent's place."""
        return place_of(self.tree, steps)


def read_keys_file(path: Path, model: type[Model], file_format: FileFormat) -> KeysFile[Model]:
    """Read a file of keys; it may extend others, as a job does.

    Raises
    ------
    InputError
        With every mistake, in the order of their places; with one for a file of another format.
    AccessError
        If it cannot be read.
    """
    composition = read_composition(path)
    refuse_other_format(composition.keys, file_format)
    problems: list[Problem] = []
    keys = validate(model, composition.keys, problems)
    if problems or keys is None:
        raise InputError(sorted(set(problems)))
    first, *others = composition.files
    return KeysFile(keys, first, composition.keys, tuple(others))
