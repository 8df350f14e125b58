"""Where readings come from, and what was done to them."""

from __future__ import annotations

from dataclasses import dataclass

from zlmreport.language import Words


@dataclass(frozen=True, slots=True)
class SourceFile:
    """A file that readings were taken from.

    Attributes
    ----------
    name
        The file's name without its folder: the folder is nobody's business but the laboratory's.
    sha256
        Digest of its bytes, hexadecimal.
    size
        Its length in bytes.
    """

    name: str
    sha256: str
    size: int


@dataclass(frozen=True, slots=True)
class Provenance:
    """The origin of a measurement set.

    Attributes
    ----------
    source
        Identifier of the data source that read it.
    files
        The files read.
    remarks
        What the reader has to say of them: units taken, columns mapped, what the file left open.
    """

    source: str
    files: tuple[SourceFile, ...] = ()
    remarks: tuple[Words, ...] = ()
