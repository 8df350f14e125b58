"""What the tests of a fleet teach of noise and sizes of effects: priors for the next tests."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from zlmreport.certificate.document import Certificate
from zlmreport.files import Document
from zlmreport.fleet.ledger import Taught
from zlmreport.fleet.records import file_name
from zlmreport.job.job import Job
from zlmreport.model.effect import Effect


def lesson_of(certificate: Certificate, job: Job, effects: Sequence[Effect]) -> Mapping[str, Any] | None:
    """Return what the readings of a certificate teach; None without a model that describes them.

    A job that knows of earlier tests, or of further ones, is diagnosed once more without them: each test
    teaches by its own readings, or what one taught would come back with the next.
    """
    diagnosis = certificate.diagnosis
    if diagnosis is None:
        return None
    from zlmreport.model.diagnosis import Verdict  # noqa: PLC0415 - only where there is a model
    from zlmreport.model.priors import Lesson  # noqa: PLC0415
    from zlmreport.model.study import Study  # noqa: PLC0415

    if job.sessions or job.priors:
        alone = replace(job, sessions=(), priors=None)
        diagnosis = Study.of(alone, certificate.measurements, effects).diagnosis(effects)
    return Lesson.of(diagnosis.fit).as_json() if diagnosis.verdict is Verdict.ADEQUATE else None


def priors(taught: Iterable[Taught], folder: Path) -> Iterator[Document]:
    """Yield the files of priors that are not there yet: of each type of machine, for each kind of axis.

    A file is named after the last day of whose tests it knows, and stays as it is: certificates are made with
    it. The same ledger gives the same bytes.

    Parameters
    ----------
    taught
        In the order of measurement; a test of a machine without a manufacturer and model teaches nobody.
    folder
        Of the files.
    """
    from zlmreport.model.priors import Lesson, as_text, learned  # noqa: PLC0415 - only where there is a model

    groups: defaultdict[tuple[str, str], list[Taught]] = defaultdict(list)
    seen: set[frozenset[str]] = set()
    for each in taught:
        if each.subject.type and each.readings not in seen:
            groups[file_name(each.subject.type), each.lesson["kind"]].append(each)
            seen.add(each.readings)
    for (type_, kind), tests in sorted(groups.items()):
        last = tests[-1].subject.measured
        path = folder / f"{type_}.{kind}.{last}.yaml"
        if not path.exists():
            found = learned([Lesson.from_json(each.lesson) for each in tests])
            origin = f"the fleet, of {tests[-1].subject.type} and until {last},"
            yield Document(path, as_text(found, origin).encode())
