"""A ledger made again from the certificates themselves: what they state, and how their files are."""

from __future__ import annotations

import contextlib
from collections import defaultdict
from collections.abc import Iterator, Mapping
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any

from zlmreport.document.certificate.results_file import RESULTS, read_results
from zlmreport.errors import InputError, Place, Problem, ZlmreportError, count_in_words
from zlmreport.fleet.basis import FileStamp, KnownFile, compute_sha256, write_path_in
from zlmreport.fleet.ledger import Ledger, Night, NumberTakenError
from zlmreport.fleet.making import MARK
from zlmreport.fleet.records import (
    LedgerEntry,
    RecordedParameter,
    State,
    Subject,
    list_parameters_by,
    list_parameters_of_model,
)
from zlmreport.job.fleet import FleetFile, list_job_files, number_of
from zlmreport.job.loading import load
from zlmreport.plugin.registry import Registry
from zlmreport.verification.attached import find_stated_by
from zlmreport.verification.carrier import open_pdf, read_file


@dataclass(frozen=True, slots=True)
class Rebuilt:
    """What a ledger was made of."""

    numbers: tuple[str, ...]  #: Of the certificates that it knows now.
    #: Of files that are named like a certificate of the fleet and could not be taken.
    problems: tuple[Problem, ...]


def rebuild(fleet: FleetFile, registry: Registry, now: str) -> Rebuilt:
    """Make the ledger of a fleet again; the next night makes each certificate anew, and compares.

    `now`: Date and time, ISO 8601 in UTC.

    Raises `InputError` if the ledger knows certificates of the fleet already; `AccessError` if it cannot be
    used, or a night is at work on it.
    """
    files = _group_by_number(fleet.output)
    numbers: list[str] = []
    problems: list[Problem] = []
    others = dict(files)
    with Ledger.open(fleet.ledger, fleet.name) as ledger:
        known = [each for each in ledger.list_certificates().values() if each.fleet == fleet.name]
        if known:
            certificates = count_in_words(len(known), "certificate")
            message = f"the ledger knows {certificates} of this fleet; move it away first"
            raise InputError.at(Place(str(fleet.ledger)), message)
        with ledger.hold_night(now, str(fleet.path)) as night:
            for job in list_job_files(fleet):
                number = ""
                with contextlib.suppress(ZlmreportError):  # the next night says what is wrong with it
                    number, _ = number_of(job, fleet.defaults)
                if number not in files:
                    continue
                others.pop(number, None)
                try:
                    _take(job, files[number], fleet, registry, night)
                    numbers.append(number)
                except ZlmreportError as error:
                    problems.extend(error.problems)
                except (OSError, ValueError, NumberTakenError) as error:
                    problems.append(Problem(Place(str(files[number][0])), f"cannot be taken: {error}"))
            night.end(now)
    problems.extend(_find_without_jobs(others))
    return Rebuilt(tuple(numbers), tuple(problems))


def _find_without_jobs(files: Mapping[str, list[Path]]) -> Iterator[Problem]:
    """Yield the certificates that are there, and of which no job has the number."""
    for number, paths in files.items():
        with contextlib.suppress(ZlmreportError, OSError, ValueError):  # of other files nothing is said
            _read_results(paths)
            yield Problem(Place(str(paths[0])), f"no job has the number {number}; it is not in the ledger")


def _group_by_number(folder: Path) -> Mapping[str, list[Path]]:
    """Return the files of certificates by the number that they are named after; drafts are none."""
    found: defaultdict[str, list[Path]] = defaultdict(list)
    for path in sorted(folder.rglob("*")):
        if path.is_file() and not path.name.startswith(".") and not path.stem.endswith(MARK):
            found[path.stem].append(path)
    return found


def _take(job: Path, files: list[Path], fleet: FleetFile, registry: Registry, night: Night) -> None:
    subject = Subject()
    with contextlib.suppress(ZlmreportError):
        subject = Subject.of(load(job, registry, defaults=fleet.defaults))
    known = tuple(
        KnownFile(
            path.suffix, path.relative_to(fleet.output).as_posix(), compute_sha256(path), FileStamp.at(path)
        )
        for path in files
    )
    entry = LedgerEntry(
        **asdict(replace(subject, number=files[0].stem)),
        job=write_path_in(fleet.path.parent, job),
        night=night.began,
        state=State.MADE,
        files=tuple(file.path for file in known),
        parameters=tuple(_read_parameters(_read_results(files))),
    )
    night.issue(entry, known, None)


def _read_results(files: list[Path]) -> Mapping[str, Any]:
    """Return what a certificate states: its results file, or the one that its PDF carries."""
    by_suffix = {path.suffix: path for path in files}
    if ".json" in by_suffix:
        results = read_results(by_suffix[".json"].read_bytes())
        if isinstance(results, dict) and results.get("schema") == RESULTS:
            return results
    if ".pdf" in by_suffix:
        path = by_suffix[".pdf"]
        stated = find_stated_by(open_pdf(read_file(path), Place(str(path))))
        if stated:
            return stated.tree
    raise ValueError("neither a results file nor a PDF that carries one says what it states")


def _read_parameters(results: Mapping[str, Any]) -> Iterator[RecordedParameter]:
    for evaluation in results["evaluations"]:
        yield from list_parameters_by(evaluation["standard"], evaluation["parameters"])
    yield from list_parameters_of_model(results.get("model", {}))
