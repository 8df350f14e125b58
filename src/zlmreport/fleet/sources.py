"""The files that a certificate was made from, so that the next night can tell whether they are the same."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator
from pathlib import Path

from pydantic import BaseModel

from zlmreport.certificate.document import Certificate
from zlmreport.fleet.basis import KnownFile, Look, path_in
from zlmreport.job.fleet import FleetFile
from zlmreport.job.job import Job


def files_behind(certificate: Certificate, job: Job, fleet: FleetFile, begun: float) -> Iterator[KnownFile]:
    """Yield every file that a certificate was made from, once; those that nobody wrote are none.

    Parameters
    ----------
    certificate
        It names what its readers say that they read.
    job
        It names files, too, whose reader may not say that it read them.
    fleet
        The fleet file.
    begun
        When the work on it began, s: a file written after that may be another than the one that was read.
    """
    folder = fleet.path.parent
    own = job.files[
        1 if fleet.defaults else 0
    ].path  # the first extends the defaults, too, and nobody wrote it
    seen: set[str] = set()
    stated = [(each.role.key, each.file.path, each.file.sha256) for each in certificate.sources]
    for role, path, sha256 in (*stated, *(("file", path, "") for path in _named(job))):
        if path is None or not path.is_file() or path_in(folder, path) in seen:
            continue
        seen.add(path_in(folder, path))
        look = Look.at(path)
        digest = sha256 or hashlib.sha256(path.read_bytes()).hexdigest()
        kind = "job" if path == own else role
        yield KnownFile(kind, path_in(folder, path), digest, look if look.is_settled(begun) else None)


def _named(job: Job) -> Iterator[Path]:
    """Yield every path among the values of a job."""
    options = [each.options for each in (job.source, job.source_as_found, *job.standards) if each]
    for group in (job.keys, *options):
        yield from _paths(group)


def _paths(value: object) -> Iterator[Path]:
    if isinstance(value, Path):
        yield value
    elif isinstance(value, BaseModel):
        for name in type(value).model_fields:
            yield from _paths(getattr(value, name))
    elif isinstance(value, list | tuple):
        for each in value:
            yield from _paths(each)
