"""From a job to files: the only page that knows the whole order.

Each step takes what the step before it made and hands on something new; nothing points back.
"""

from __future__ import annotations

import contextlib
import gc
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import AbstractContextManager, nullcontext
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, Any, TypeAlias

from zlmreport.certificate.attachments import Attachment, arranged, media_type, source_attachments
from zlmreport.certificate.build import GENERATOR, build
from zlmreport.certificate.clauses import missing_items
from zlmreport.certificate.information import findings
from zlmreport.certificate.results import Evaluated
from zlmreport.correction.corrections import corrected, corrections_of, without_excluded
from zlmreport.errors import InputError
from zlmreport.evaluation.decision import decided, decision_rule
from zlmreport.evaluation.evaluate import evaluate
from zlmreport.evaluation.evaluation import Evaluation
from zlmreport.files import Document
from zlmreport.language import Words
from zlmreport.plugin.kinds import RENDERER
from zlmreport.plugin.protocols import (
    Renderer,
    SourceContext,
    Standard,
    carries_attachments,
    information_asked_by,
    relationship_of,
)
from zlmreport.uncertainty.budget import Budget, NoBudget
from zlmreport.uncertainty.expanded import with_uncertainty
from zlmreport.uncertainty.job_budget import budget_of, refusals
from zlmreport.uncertainty.monte_carlo import TRIALS
from zlmreport.values import dataclass

if TYPE_CHECKING:
    from zlmreport.certificate.conditions import Described
    from zlmreport.certificate.document import Certificate
    from zlmreport.certificate.model_annex import Modelled
    from zlmreport.job.job import Job
    from zlmreport.measurement.measurement_set import MeasurementSet
    from zlmreport.plugins import Registry
    from zlmreport.presenting.writer import Writer
    from zlmreport.signing.signer import Signer

#: This program, and each plugin by its identifier, with their releases.
Programs: TypeAlias = tuple[str, Mapping[str, str]]
#: Shows some work by its name, while it is told the share that is done.
Showing: TypeAlias = Callable[[str], AbstractContextManager[Callable[[float], object]]]
#: The format that every document with attachments carries.
RESULTS = "json"

#: Files that can be signed.
PDF = ".pdf"
_SIGNATURE = Words(en="Electronic signature", de="Elektronische Signatur")


@dataclass(frozen=True, slots=True)
class Outcome:
    """What a job came to."""

    certificate: Certificate  #: The document without a layout, with its evaluations.
    documents: tuple[Document, ...]  #: The files, one for each output format.


def _unseen(_doing: str) -> AbstractContextManager[Callable[[float], object]]:
    return nullcontext(lambda _share: None)


def read(job: Job, registry: Registry) -> MeasurementSet:
    """Read the measurements that the job names, correct them and set aside what it says."""
    return without_excluded(read_whole(job, registry), job)


def read_whole(job: Job, registry: Registry) -> MeasurementSet:
    """Read the measurements that the job names and correct them; none is set aside."""
    source = registry.source(job.source.identifier)
    set_ups = {
        choice.identifier: extension.set_up(job, choice.options)
        for extension, choice in registry.extensions_of(job)
    }
    context = SourceContext(job.axis, job.source.place, set_ups)
    measurements = source.read(job.source.options, context)
    corrections = corrections_of(job, measurements)
    if corrections:
        measurements = corrected(measurements, corrections)
    return measurements


def read_sessions(job: Job, registry: Registry) -> tuple[MeasurementSet, ...]:
    """Read the further tests of the axis against which the job's error model is held."""
    return tuple(read(each, registry) for each in job.sessions)


def compose(
    job: Job,
    registry: Registry,
    made_by: Programs | None = None,
    showing: Showing = _unseen,
    trials: int = TRIALS,
) -> Certificate:
    """Read, evaluate by every standard that the job names, and compose the document; nothing is rendered.

    `made_by` are the programs that the document names; those that make it if they are left out. `trials` are
    the tests that are simulated for its uncertainties.
    """
    missing = list(missing_items(job))
    try:
        measurements = read(job, registry)
        for each, readings in ((job, measurements), (job.as_found, None)):
            if each:
                missing += refusals(each, budget_of_job(each, readings or read(each, registry), registry))
    except InputError as error:
        raise InputError([*missing, *error.problems]) from error
    if missing:
        raise InputError(missing)
    evaluations = evaluated(job, measurements, registry, trials)
    studied = modelled(job, measurements, registry, showing) if job.effects else None
    found = job.as_found
    as_found = evaluated(found, read(found, registry), registry, trials) if found else ()

    def describe(writer: Writer) -> list[Described]:
        said = [
            extension.described(job, choice.options, writer)
            for extension, choice in registry.extensions_of(job)
        ]
        return [each for each in said if each]

    generator, plugins = made_by or programs(job, registry)
    return build(job, evaluations, plugins, studied, as_found, describe, generator)


def programs(job: Job, registry: Registry) -> Programs:
    """Return the programs that make the document of a job."""
    return GENERATOR, registry.versions(job)


def budget_of_job(job: Job, measurements: MeasurementSet, registry: Registry) -> Budget | NoBudget:
    """Return the uncertainty budget of the set-up, with what its extensions contribute."""
    own = tuple(
        contribution
        for extension, choice in registry.extensions_of(job)
        for contribution in extension.contributions(job, choice.options, measurements)
    )
    return budget_of(job, measurements, own)


def parameters(job: Job, measurements: MeasurementSet, registry: Registry) -> tuple[Evaluation, ...]:
    """Evaluate readings by every standard that the job names; uncertainties and decisions are left out."""
    return tuple(
        evaluate(standard, measurements, options, choice.tolerances)
        for (standard, options), choice in zip(standards(job, registry), job.standards, strict=True)
    )


def evaluated(
    job: Job, measurements: MeasurementSet, registry: Registry, trials: int = TRIALS
) -> tuple[Evaluated, ...]:
    """Evaluate readings by every standard that the job names, with uncertainties and decisions."""
    stated = job.keys.decision_rule
    rule = decision_rule(stated.rule, stated.guard_band_factor)
    budget = budget_of_job(job, measurements, registry)
    chosen = standards(job, registry)
    bare = [
        (evaluation, partial(standard.arithmetic, options=options))
        for (standard, options), evaluation in zip(
            chosen, parameters(job, measurements, registry), strict=True
        )
    ]
    complete: list[Evaluated] = []
    for (standard, options), evaluation in zip(chosen, with_uncertainty(bare, budget, trials), strict=True):
        reported = findings(information_asked_by(standard), job, measurements, budget)
        with_verdicts = decided(replace(evaluation, findings=(*evaluation.findings, *reported)), rule)
        figures = tuple(standard.figures(with_verdicts, options))
        complete.append(Evaluated(with_verdicts, figures, budget))
    return tuple(complete)


def modelled(
    job: Job, measurements: MeasurementSet, registry: Registry, showing: Showing = _unseen
) -> Modelled:
    """Hold the job's error model against the readings, and ask its standards about a corrected axis."""
    from zlmreport.certificate.forecast import forecasts  # noqa: PLC0415 - only for a job with a model
    from zlmreport.certificate.model_annex import Modelled  # noqa: PLC0415
    from zlmreport.model.study import Fitted, Study  # noqa: PLC0415
    from zlmreport.planning.deciding import experiment_of_tie  # noqa: PLC0415

    study = Study.of(job, measurements, registry.effects, read_sessions(job, registry))
    with showing("diagnosing") as told:
        diagnosis = study.diagnosis(registry.effects, told)
    with showing("simulating plans") as told:
        experiment = experiment_of_tie(study, diagnosis, registry.effects, told)
    history = study.history(Fitted(diagnosis.fit, diagnosis.error))
    return Modelled(
        history,
        diagnosis,
        forecasts(standards(job, registry), study, history),
        study.titles(registry.effects),
        study,
        experiment,
    )


def standards(job: Job, registry: Registry) -> list[tuple[Standard, Any]]:
    """Return the standards that a job names, each with its own keys."""
    return [(registry.standard(choice.identifier), choice.options) for choice in job.standards]


def run(job: Job, registry: Registry, signer: Signer | None = None, showing: Showing = _unseen) -> Outcome:
    """Make every file of a job, in memory: a failure at any step leaves nothing behind."""
    renderers = [registry.renderer(identifier) for identifier in job.formats]
    with _garbage_collected_once():
        certificate = compose(job, registry, showing=showing)
        contents = render(certificate, renderers, registry)
        if signer:
            signature, called = job.keys.certificate.signature, _SIGNATURE.in_language(certificate.language)
            stamp_url = signature.timestamp if signature else None
            contents |= {
                each.identifier: signer(contents[each.identifier], called, stamp_url)
                for each in renderers
                if each.suffix == PDF
            }
        documents = tuple(
            Document(job.directory / file_name(certificate, renderer), contents[renderer.identifier])
            for renderer in renderers
        )
    return Outcome(certificate, documents)


def render(certificate: Certificate, renderers: Sequence[Renderer], registry: Registry) -> dict[str, bytes]:
    """Return the content of each file by its renderer's identifier.

    Files that others carry come first. A document that carries files carries the results file, whether or
    not that is asked for; one that cannot be made because its renderer is switched off is left out.
    """
    carriers = [each for each in renderers if carries_attachments(each)]
    others = [each for each in renderers if each not in carriers]
    is_asked_for = any(each.identifier == RESULTS for each in others)
    if carriers and not is_asked_for and RESULTS in registry.identifiers(RENDERER):
        others.append(registry.renderer(RESULTS))
    contents = {each.identifier: each.render(certificate) for each in others}
    if carriers:
        attached = [
            Attachment(
                file_name(certificate, each),
                contents[each.identifier],
                media_type(file_name(certificate, each)),
                relationship,
                each.title.in_language(certificate.language),
            )
            for each in others
            if (relationship := relationship_of(each))
        ]
        attached += source_attachments(certificate.sources, certificate.language)
        complete = replace(certificate, attachments=arranged(attached, certificate.number))
        contents |= {each.identifier: each.render(complete) for each in carriers}
    return contents


def file_name(certificate: Certificate, renderer: Renderer) -> str:
    """Return the name of a certificate's file."""
    return f"{certificate.number}{renderer.suffix}"


@contextlib.contextmanager
def _garbage_collected_once() -> Iterator[None]:
    """Collect no garbage while a document is made: the collector walks the youngest objects once, after it.

    Laying out pages makes a growing heap of objects that it would walk again and again for nothing: about
    a fifth of the time of a certificate.
    """
    was_enabled = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if was_enabled:
            gc.enable()
