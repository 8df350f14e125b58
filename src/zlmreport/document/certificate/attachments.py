"""The files that travel inside a certificate: sources and results; how many, how large, their names.

With them anyone can evaluate it again; `zlmreport verify` does.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path, PurePosixPath
from typing import TYPE_CHECKING

from zlmreport.errors import InputError, Place, count_in_words
from zlmreport.job.tree import Keys, walk_scalars
from zlmreport.job.types import find_path_from_job
from zlmreport.language import Language, Words, named

if TYPE_CHECKING:
    from zlmreport.job.job import Job
    from zlmreport.measurement.provenance import SourceFile

#: Of the files in one certificate, and in bytes of all of them together.
MOST_ATTACHMENTS = 64
LARGEST_TOTAL = 64 * 1024 * 1024

#: By suffix, and the same on every machine: a system's own list of media types is not.
_MEDIA_TYPES = {
    ".csv": "text/csv",
    ".dat": "text/plain",
    ".jpeg": "image/jpeg",
    ".jpg": "image/jpeg",
    ".json": "application/json",
    ".png": "image/png",
    ".rta": "text/plain",
    ".rtl": "text/plain",
    ".txt": "text/plain",
    ".xml": "application/xml",
    ".yaml": "application/yaml",
    ".yml": "application/yaml",
}
_UNKNOWN = "application/octet-stream"
#: What some systems do not take in the name of a file.
_NOT_IN_NAMES = frozenset('\\/:*?"<>|')
_LONGEST_NAME = 100


class Relationship(StrEnum):
    """What an attached file is to the document, in the words of the PDF standard (AFRelationship)."""

    SOURCE = "Source"
    DATA = "Data"
    ALTERNATIVE = "Alternative"
    SUPPLEMENT = "Supplement"


@dataclass(frozen=True, slots=True)
class Attachment:
    """A file inside a document.

    Attributes
    ----------
    name
        Unique among the attachments of a document, and no path.
    content
        Its bytes.
    media_type
        ``text/csv``.
    relationship
        To the document.
    description
        What it is, in the document's language.
    """

    name: str
    content: bytes
    media_type: str
    relationship: Relationship
    description: str


class SourceRole(StrEnum):
    """What a source is to the job, as the results file says it."""

    JOB = "job"
    EXTENDED = "extended"
    TABLE = "table"
    READINGS = "readings"
    SESSION = "session"
    PRIORS = "priors"
    TEST = "test"
    LOGO = "logo"


_TITLES = {
    SourceRole.JOB: Words("Job"),
    SourceRole.EXTENDED: Words("Extended by the job"),
    SourceRole.TABLE: Words("Table of the axis"),
    SourceRole.READINGS: Words("Readings"),
    SourceRole.SESSION: Words("Further test of the axis"),
    SourceRole.PRIORS: Words("What earlier tests taught"),
    SourceRole.TEST: Words("Part of what was measured"),
    SourceRole.LOGO: Words("Logo of the laboratory"),
}


@dataclass(frozen=True, slots=True)
class Source:
    """A file that a certificate was made from.

    Attributes
    ----------
    role
        What it is to the job.
    name
        Its name as an attachment.
    path
        From the job's folder, as the job comes to it: ``../laboratory.yaml``; or from the root, where the
        job itself says so. It tells nothing of the folders of a laboratory that the job does not.
    file
        Its digest and bytes.
    """

    role: SourceRole
    name: str
    path: str
    file: SourceFile


def list_sources(job: Job, readings: Iterable[SourceFile], logo: SourceFile | None) -> tuple[Source, ...]:
    """Return every file that a certificate is made from, the job file first."""
    read = tuple(readings)
    trees = (job.tree, *(part.tree for part in job.parts))
    first, from_root = job.files[0].path, _FromRoot.of((*job.files, *read), *trees)
    found: dict[tuple[str, str], tuple[SourceRole, SourceFile]] = {}

    def add(role: SourceRole, file: SourceFile) -> None:
        found.setdefault((from_root.find_path(file, first), file.sha256), (role, file))

    known: dict[SourceFile, SourceRole] = {}
    for part in job.parts:
        known |= dict.fromkeys((file for each in part.sessions for file in each.files), SourceRole.SESSION)
        known |= dict.fromkeys(part.files[-1:] if part.priors else (), SourceRole.PRIORS)
        known |= dict.fromkeys(part.axis.files, SourceRole.TABLE)
    known |= {each.files[0]: SourceRole.TEST for each in job.measurements.values()}
    for number, file in enumerate(job.files):
        add(known.get(file, SourceRole.EXTENDED) if number else SourceRole.JOB, file)
    for file in read:
        add(SourceRole.READINGS, file)
    if logo:
        add(SourceRole.LOGO, logo)
    return _name_sources(found, job.keys.certificate.number)


def list_sources_of_several(files: Sequence[SourceFile], tree: Keys, number: str) -> tuple[Source, ...]:
    """Return every file that a document of several jobs is made from; the first names the others.

    `tree`: What stands in the first.
    `number`: Of the document.
    """
    from_root = _FromRoot.of(files, tree)
    found: dict[tuple[str, str], tuple[SourceRole, SourceFile]] = {}
    first = files[0].path
    for file in files:
        path = from_root.find_path(file, first)
        found.setdefault((path, file.sha256), (SourceRole.TEST if found else SourceRole.JOB, file))
    return _name_sources(found, number)


def _name_sources(
    found: Mapping[tuple[str, str], tuple[SourceRole, SourceFile]], number: str
) -> tuple[Source, ...]:
    """Return files, by path and digest, each with a name of its own."""
    taken: set[str] = set()
    return tuple(
        Source(role, _make_unique(_clean(file.name), taken, number), path, file)
        for (path, _), (role, file) in found.items()
    )


def attach_sources(sources: Iterable[Source], language: Language) -> Iterator[Attachment]:
    """Yield the sources as attachments; one whose reader did not keep its bytes cannot be attached."""
    for source in sources:
        if source.file.content is not None:
            description = named(_TITLES[source.role], _clean(source.path, kept="/")).in_language(language)
            yield Attachment(
                source.name,
                source.file.content,
                find_media_type(source.name),
                Relationship.SOURCE,
                description,
            )


def arrange_attachments(attachments: Iterable[Attachment], number: str) -> tuple[Attachment, ...]:
    """Return the attachments of the certificate of this number in the order in which a PDF lists them.

    Raises `InputError` if they are more, or larger, than a certificate carries.
    """
    found = sorted(attachments, key=lambda each: each.name.encode())
    size = sum(len(each.content) for each in found)
    if len(found) > MOST_ATTACHMENTS or size > LARGEST_TOTAL:
        raise InputError.at(
            Place(number),
            f"its {count_in_words(len(found), 'file')} would be {size} bytes in all, and a PDF certificate "
            f"carries its files: {MOST_ATTACHMENTS} with {LARGEST_TOTAL} bytes (64 MiB) at most",
        )
    return tuple(found)


def find_media_type(name: str) -> str:
    """Return the media type of a file by the suffix of its name."""
    return _MEDIA_TYPES.get(PurePosixPath(name).suffix.lower(), _UNKNOWN)


@dataclass(frozen=True, slots=True)
class _FromRoot:
    """What is told from the root of the file system."""

    stated: tuple[Path, ...]  #: The files that jobs name so.
    ambiguous: frozenset[str]  #: Names that several files have: a name alone would not lead to one of them.

    @classmethod
    def of(cls, files: Sequence[SourceFile], *trees: Keys) -> _FromRoot:
        """Return it for the files of jobs with these keys."""
        texts = frozenset(each.text for tree in trees for each in walk_scalars(tree))
        places = (each.path for each in files if each.path is not None)
        digests = {(each.name, each.sha256) for each in files}
        count = Counter(name for name, _ in digests)
        return cls(
            tuple(each for each in places if each.is_absolute() and str(each) in texts),
            frozenset(name for name, number in count.items() if number > 1),
        )

    def find_path(self, file: SourceFile, job: Path | None) -> str:
        """Return the path by which a job comes to a file; only its name where the job does not state one.

        It is told from the root if it is stated so, or if nothing else leads to it.
        """
        path = file.path
        if path is None or job is None:
            return file.name
        is_elsewhere = path.name in self.ambiguous and not path.is_relative_to(job.parent)
        is_told = path in self.stated or (
            is_elsewhere and any(each.parent in path.parents for each in self.stated)
        )
        return find_path_from_job(path, job, str(path) if is_told else None) or file.name


def _make_unique(name: str, taken: set[str], number: str) -> str:
    """Return a name that no file before has; names that begin like the certificate's own files are kept."""
    stem, dot, suffix = name.partition(".")
    count, candidate = 1, name
    while candidate.casefold() in taken or candidate.startswith(f"{number}."):
        count += 1
        candidate = f"{stem}-{count}{dot}{suffix}"
    taken.add(candidate.casefold())
    return candidate


def _clean(text: str, kept: str = "") -> str:
    """Return a text without what is not seen, or not taken by every system."""
    allowed = _NOT_IN_NAMES - set(kept)
    shown = "".join("_" if each in allowed or not each.isprintable() else each for each in text)
    return shown[-_LONGEST_NAME:]
