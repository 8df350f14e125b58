"""The files of ``zlmreport simulate``: a table, and a job beside it."""

from __future__ import annotations

from collections.abc import Iterator

from zlmreport.cli.terminal import shown_path
from zlmreport.files import Document, write
from zlmreport.job.simulation import SimulationFile


def written(table: Document, job: Document) -> Iterator[str]:
    """Write a table anew, and a job unless it is there, for somebody may have worked on it.

    Yields
    ------
    str
        What is printed of each.
    """
    is_new = not job.path.exists()
    yield from (str(shown_path(path)) for path in write([table, job] if is_new else [table]))
    if not is_new:
        yield f"{shown_path(job.path)} is there already and was left as it is"


def remarks(file: SimulationFile, kind: str) -> tuple[str, ...]:
    """Return what the head of a table says of its origin.

    Parameters
    ----------
    file
        The simulation.
    kind
        What the table holds, in a sentence.
    """
    origin = f"sha256 {file.source.sha256[:16]}…, seed {file.keys.seed}"
    return kind, f"Source: zlmreport simulate {file.source.name} ({origin})"
