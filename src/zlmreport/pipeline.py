"""From a job to files: the only page that knows the whole order.

Each step takes what the step before it made and hands on something new; nothing points back.
"""

from __future__ import annotations

import contextlib
import gc
import os
import tempfile
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from zlmreport.certificate.build import build
from zlmreport.certificate.clauses import demand_mandatory_items
from zlmreport.certificate.document import Certificate
from zlmreport.certificate.forecast import forecasts
from zlmreport.certificate.model_annex import Modelled
from zlmreport.certificate.results import Evaluated
from zlmreport.errors import AccessError, Place
from zlmreport.evaluation.evaluate import evaluate
from zlmreport.job.job import Job
from zlmreport.measurement.measurement_set import MeasurementSet
from zlmreport.model.study import Fitted, Study
from zlmreport.plugins import Registry
from zlmreport.protocols import SourceContext, Standard


@dataclass(frozen=True, slots=True)
class Document:
    """A finished file that has not been written yet."""

    path: Path
    content: bytes


@dataclass(frozen=True, slots=True)
class Outcome:
    """What a job came to.

    Attributes
    ----------
    certificate
        The document without a layout, with its evaluations.
    documents
        The files, one for each output format.
    """

    certificate: Certificate
    documents: tuple[Document, ...]


def read(job: Job, registry: Registry) -> MeasurementSet:
    """Read the measurements that the job names."""
    source = registry.source(job.source.identifier)
    return source.read(job.source.options, SourceContext(job.axis, job.source.place))


def compose(job: Job, registry: Registry) -> Certificate:
    """Read, evaluate by every standard that the job names, and compose the document; nothing is rendered."""
    demand_mandatory_items(job)
    measurements = read(job, registry)
    evaluated = _evaluated(job, measurements, registry)
    studied = modelled(job, measurements, registry) if job.effects else None
    return build(job, evaluated, registry.versions(job), studied)


def _evaluated(job: Job, measurements: MeasurementSet, registry: Registry) -> tuple[Evaluated, ...]:
    evaluated = []
    for choice in job.standards:
        standard = registry.standard(choice.identifier)
        evaluation = evaluate(
            standard,
            measurements,
            choice.options,
            choice.tolerances,
            decides_without_uncertainty=job.keys.decision_rule == "simple",
        )
        evaluated.append(Evaluated(evaluation, tuple(standard.figures(evaluation, choice.options))))
    return tuple(evaluated)


def modelled(job: Job, measurements: MeasurementSet, registry: Registry) -> Modelled:
    """Hold the job's error model against the readings, and ask its standards about a corrected axis."""
    study = Study.of(job, measurements, registry.effects)
    diagnosis = study.diagnosis(registry.effects)
    history = study.history(Fitted(diagnosis.fit, diagnosis.error))
    return Modelled(
        history,
        diagnosis,
        forecasts(standards(job, registry), study, history),
        {effect.identifier: effect.title for effect in registry.effects},
    )


def standards(job: Job, registry: Registry) -> list[tuple[Standard, Any]]:
    """Return the standards that a job names, each with its own keys."""
    return [(registry.standard(choice.identifier), choice.options) for choice in job.standards]


def run(job: Job, registry: Registry) -> Outcome:
    """Make every file of a job, in memory: a failure at any step leaves nothing behind."""
    renderers = [registry.renderer(identifier) for identifier in job.formats]
    with _garbage_collected_once():
        certificate = compose(job, registry)
        documents = tuple(
            Document(job.directory / f"{certificate.number}{renderer.suffix}", renderer.render(certificate))
            for renderer in renderers
        )
    return Outcome(certificate, documents)


@contextlib.contextmanager
def _garbage_collected_once() -> Iterator[None]:
    """Collect garbage once, after a document, among what the document made.

    Laying out pages makes a growing heap of objects that the collector would walk again and again for
    nothing: about a fifth of the time of a certificate.
    """
    was_enabled = gc.isenabled()
    gc.freeze()
    gc.disable()
    try:
        yield
    finally:
        if was_enabled:
            gc.enable()
        gc.collect()
        gc.unfreeze()


def write(documents: Iterable[Document]) -> tuple[Path, ...]:
    """Write the files so that each appears whole or not at all, and none before all are on the disk."""
    documents = tuple(documents)
    written: list[Path] = []
    place = Place(str(documents[0].path.parent)) if documents else Place("")
    try:
        for document in documents:
            place = Place(str(document.path))
            document.path.parent.mkdir(parents=True, exist_ok=True)
            if document.path.is_dir():
                raise IsADirectoryError(None, "a folder of this name is in the way")
            written.append(_written_aside(document))
        for document, aside in zip(documents, written, strict=True):
            place = Place(str(document.path))
            aside.replace(document.path)
    except OSError as error:
        raise AccessError.at(place, f"cannot be written: {error.strerror or error}") from error
    finally:
        for aside in written:
            with contextlib.suppress(OSError):
                aside.unlink(missing_ok=True)
    return tuple(document.path for document in documents)


def _written_aside(document: Document) -> Path:
    """Write a document under a temporary name in its own folder, and push it to the disk."""
    handle, name = tempfile.mkstemp(dir=document.path.parent, prefix=f".{document.path.name}.")
    aside = Path(name)
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(document.content)
            file.flush()
            os.fsync(file.fileno())
        aside.chmod(0o666 & ~_umask())
    except BaseException:  # an interrupt, too, leaves nothing behind
        aside.unlink(missing_ok=True)
        raise
    return aside


def _umask() -> int:
    """Return the process's file mode mask, which can only be read by setting it."""
    mask = os.umask(0o022)
    os.umask(mask)
    return mask
