"""Makes the files of a job in their order (read, evaluate, fit, compose, render), named by its number.

Each step takes what the step before it made and hands on something new; nothing points back.
"""

from __future__ import annotations

import contextlib
import gc
from collections.abc import Callable, Iterator, Sequence
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass, replace
from functools import partial
from typing import TYPE_CHECKING, Any, TypeAlias

from zlmreport.document.certificate.attachments import (
    Attachment,
    arrange_attachments,
    attach_sources,
    find_media_type,
)
from zlmreport.document.certificate.build import GENERATOR, Programs, build, lay_out, make_writer
from zlmreport.document.certificate.clauses import find_missing_items
from zlmreport.document.certificate.information import check_information
from zlmreport.document.certificate.material import Material
from zlmreport.document.certificate.measured_lines import say_of_each
from zlmreport.document.certificate.results import Evaluated, Tested
from zlmreport.errors import AccessError, InputError, Problem
from zlmreport.evaluation import traceability
from zlmreport.evaluation.correction.corrections import correct, drop_excluded, find_corrections_of
from zlmreport.evaluation.decision import make_decision_rule, with_decisions
from zlmreport.evaluation.evaluate import evaluate, name_adoption
from zlmreport.evaluation.evaluation import Evaluation
from zlmreport.evaluation.likely_units import find_doubts, find_unlikely_limits
from zlmreport.evaluation.uncertainty.budget import Budget, NoBudget, join_budgets
from zlmreport.evaluation.uncertainty.expanded import add_uncertainty
from zlmreport.evaluation.uncertainty.job_budget import make_budget_of
from zlmreport.evaluation.uncertainty.monte_carlo import TRIALS
from zlmreport.evaluation.uncertainty.reasons import is_placeholder
from zlmreport.evaluation.uncertainty.unstated import find_unstated
from zlmreport.files import Document
from zlmreport.job.days import demand_days_past
from zlmreport.language import Language, Words
from zlmreport.measurement.error_symbol import evaluate_for_error
from zlmreport.measurement.measurement_set import join_lines
from zlmreport.plugin.kinds import RENDERER
from zlmreport.plugin.protocols import (
    Renderer,
    SourceContext,
    Standard,
    carries_attachments,
    find_contributions_of,
    find_information_asked_by,
    find_relationship_of,
    needs_layout,
)

if TYPE_CHECKING:
    from zlmreport.document.certificate.document import Certificate
    from zlmreport.document.signing.signer import Signer
    from zlmreport.document.subjects.annex import Modelled
    from zlmreport.job.job import Job
    from zlmreport.measurement.measurement_set import MeasurementSet
    from zlmreport.plugin.registry import Registry

#: Shows some work by its name, while it is told the share that is done.
Showing: TypeAlias = Callable[[str], AbstractContextManager[Callable[[float], object]]]
#: The format that every document with attachments carries.
RESULTS = "json"

#: Files that can be signed.
PDF = ".pdf"
_SIGNATURE = Words("Electronic signature")


@dataclass(frozen=True, slots=True)
class Outcome:
    """What a job came to."""

    certificate: Certificate  #: The document without a layout, with its evaluations.
    documents: tuple[Document, ...]  #: The files, one for each output format.


def _show_nothing(_doing: str) -> AbstractContextManager[Callable[[float], object]]:
    return nullcontext(lambda _share: None)


def read(job: Job, registry: Registry) -> MeasurementSet:
    """Read the measurements that the job names, correct them and set aside what it says."""
    if job.tests:
        return join_lines(job.axis, {name: read(each, registry) for name, each in job.tests.items()})
    measurements = read_whole(job, registry)
    return drop_excluded(measurements, job) if job.keys.measurement.excluded else measurements


def read_whole(job: Job, registry: Registry) -> MeasurementSet:
    """Read the measurements that the job names and correct them; none is set aside."""
    if job.tests:
        return join_lines(job.axis, {name: read_whole(each, registry) for name, each in job.tests.items()})
    source = registry.source(job.source.identifier)
    set_ups = {
        each.identifier: registry.extension(each.identifier).set_up(job, each.options)
        for each in job.extensions
    }
    context = SourceContext(job.axis, job.source.place, set_ups)
    try:
        measurements = source.read(job.source.options, context)
    except AccessError as error:
        named_in = job.place_of("measurement.source.file")
        raise AccessError(
            replace(each, message=f"{each.message} (named in {named_in})") for each in error.problems
        ) from error
    corrections = find_corrections_of(job, measurements) if job.keys.corrections else None
    return correct(measurements, corrections) if corrections else measurements


def read_sessions(job: Job, registry: Registry) -> tuple[MeasurementSet, ...]:
    """Read the further tests of the axis against which the job's error model is held."""
    return tuple(read(each, registry) for each in job.sessions)


def compose(  # noqa: PLR0913 - what a document is made of
    job: Job,
    registry: Registry,
    made_by: Programs | None = None,
    showing: Showing = _show_nothing,
    trials: int = TRIALS,
    *,
    is_part: bool = False,
    is_laid_out: bool = True,
) -> Certificate:
    """Read, evaluate by every standard that the job names, and compose the document; nothing is rendered.

    `made_by` are the programs that the document names; those that make it if they are left out. `trials` are
    the tests that are simulated for its uncertainties. `is_part`: Whether it is one of several measurements
    that make one document. `is_laid_out`: Whether its pages and graphs are wanted, and not its data alone.
    """
    if job.measurements:
        return _compose_parts(job, registry, made_by, showing, trials, is_laid_out=is_laid_out)
    found = job.as_found
    states = (job, found) if found else (job,)
    missing = [
        *find_missing_items(job),
        *(one for each in (*states, *job.tests.values()) for one in traceability.find_broken_chain(each)),
    ]
    measured: list[tuple[Job, MeasurementSet, Budget | NoBudget]] = []
    try:
        for each in states:
            readings = read(each, registry)
            budget = make_budget_of_job(each, readings, registry)
            measured.append((each, readings, budget))
            missing += _find_refusals(each, budget)
    except InputError as error:
        raise InputError([*missing, *error.problems]) from error
    if missing:
        raise InputError(dict.fromkeys(missing))
    evaluated = [
        evaluate_all(each, readings, registry, trials, budget) for each, readings, budget in measured
    ]
    measurements = measured[0][1]
    evaluations, as_found = evaluated[0], evaluated[1] if found else ()
    studied = fit_model(job, measurements, registry, showing) if job.effects else None
    tests = _evaluate_tests(job, measurements, evaluations[0].budget, registry, trials) if job.tests else ()
    lines = [(each.name, each.job, each.measurements, each.evaluated) for each in tests]
    _demand_results(job, [*evaluations, *(each for test in tests for each in test.evaluated)])
    if is_laid_out:
        evaluations = draw_graphs(job, evaluations, registry)
        as_found = draw_graphs(found, as_found, registry) if found else ()
        tests = tuple(
            replace(each, evaluated=draw_graphs(each.job, each.evaluated, registry)) for each in tests
        )
    of_lines = say_of_each(
        (name, _find_doubts_of(line, of_line, by, registry))
        for name, line, of_line, by in lines or [("", job, measurements, evaluations)]
    )
    joint = (words for each in evaluations for words in find_unlikely_limits(each.evaluation))
    doubtful = (*of_lines, *(joint if tests else ()))
    document = build(
        job, evaluations, made_by or find_programs(job, registry), doubtful, studied, as_found, tests
    )
    if not is_laid_out:
        return document
    writer = make_writer(job, measurements)
    described = [
        registry.extension(each.identifier).described(job, each.options, writer) for each in job.extensions
    ]
    return lay_out(
        Material(
            document,
            job,
            evaluations,
            as_found,
            studied,
            [each for each in described if each],
            writer,
            tests,
            is_part,
        )
    )


def _compose_parts(  # noqa: PLR0913 - what documents are made of
    job: Job,
    registry: Registry,
    made_by: Programs | None,
    showing: Showing,
    trials: int,
    *,
    is_laid_out: bool,
) -> Certificate:
    """Compose one document of several measurements; whatever is wrong with any of them is told at once."""
    from zlmreport.document.certificate.collection import collect_certificates  # noqa: PLC0415 - of several only

    parts: dict[str, Certificate] = {}
    problems: list[Problem] = []
    for name, part in job.measurements.items():
        try:
            parts[name] = compose(
                part, registry, made_by, showing, trials, is_part=True, is_laid_out=is_laid_out
            )
        except InputError as error:
            problems.extend(error.problems)
    if problems:
        raise InputError(dict.fromkeys(problems))
    made_by = made_by or find_programs(job, registry)
    return collect_certificates(job, parts, made_by, is_laid_out=is_laid_out)


def _demand_results(job: Job, evaluations: Sequence[Evaluated]) -> None:
    """Refuse a calibration certificate in which no standard gives a result; a report may say so."""
    if job.keys.certificate.kind != "certificate" or any(each.evaluation.parameters for each in evaluations):
        return
    why = "; ".join(
        f"{finding.requirement.in_language(Language.ENGLISH)}: {finding.found.in_language(Language.ENGLISH)}"
        for each in evaluations
        for finding in each.evaluation.findings
        if finding.met is False
    )
    raise InputError.at(
        job.place_of("evaluate"),
        f"a calibration certificate states results, and these readings give none ({why}); measure what is "
        "missing, or write a report: certificate.kind: report",
    )


def _find_doubts_of(
    job: Job, measurements: MeasurementSet, evaluated: Sequence[Evaluated], registry: Registry
) -> Iterator[Words]:
    """Yield what of a job and its readings seems to be in another unit, and what its extensions doubt."""
    yield from find_doubts(job, measurements, [each.evaluation for each in evaluated])
    for each in job.extensions:
        yield from registry.extension(each.identifier).doubts(job, each.options, measurements)


def _find_refusals(job: Job, budget: Budget | NoBudget) -> Iterator[Problem]:
    """Yield what a certificate must state of its uncertainty and does not; of several lines, of each too."""
    yield from find_unstated(job, budget)
    for name, of_line in budget.tests.items() if isinstance(budget, Budget) else ():
        yield from find_unstated(job.tests[name], of_line)


def _evaluate_tests(
    job: Job,
    measurements: MeasurementSet,
    budget: Budget | NoBudget,
    registry: Registry,
    trials: int,
) -> tuple[Tested, ...]:
    """Evaluate each of several measured lines by those standards of the job that evaluate it alone.

    `budget`: Of what follows from them together, with that of each line.
    """
    found = []
    for name, line in job.tests.items():
        of_line = budget.tests[name] if isinstance(budget, Budget) else budget
        readings = measurements.tests[name]
        evaluations = evaluate_all(line, readings, registry, trials, of_line)
        found.append(Tested(name, line, readings, of_line, evaluations))
    return tuple(found)


def find_programs(job: Job, registry: Registry) -> Programs:
    """Return the programs that make the document of a job."""
    return GENERATOR, registry.list_versions(job)


def make_budget_of_job(job: Job, measurements: MeasurementSet, registry: Registry) -> Budget | NoBudget:
    """Return the uncertainty budget of the set-up, with what its extensions contribute."""
    if job.tests:
        budgets = {
            name: make_budget_of_job(each, measurements.tests[name], registry)
            for name, each in job.tests.items()
        }
        brought = [
            find_contributions_of(standard, measurements, options)
            for standard, options in choose_standards(job, registry)
        ]
        negligible = [(str(key), said) for key, said in job.keys.uncertainty.negligible.items()]
        return join_budgets(budgets, brought, job.axis.measurand.contributors, negligible)
    own = tuple(
        contribution
        for each in job.extensions
        for contribution in registry.extension(each.identifier).contributions(job, each.options, measurements)
    )
    return make_budget_of(job, measurements, own)


def evaluate_parameters(job: Job, measurements: MeasurementSet, registry: Registry) -> tuple[Evaluation, ...]:
    """Evaluate readings by every standard that the job names; uncertainties and decisions are left out."""
    found = []
    for (standard, options), choice in zip(choose_standards(job, registry), job.standards, strict=True):
        evaluation = evaluate(standard, measurements, options, choice.tolerances)
        if choice.adoption:
            evaluation = name_adoption(evaluation, choice.adoption)
        specification = "" if is_placeholder(choice.specification) else choice.specification
        found.append(replace(evaluation, specification=specification))
    return tuple(found)


def evaluate_all(
    job: Job,
    measurements: MeasurementSet,
    registry: Registry,
    trials: int = TRIALS,
    budget: Budget | NoBudget | None = None,
) -> tuple[Evaluated, ...]:
    """Evaluate readings by every standard that the job names, with uncertainties and decisions; no graphs.

    `budget`: Of the set-up; without it the job's own.
    """
    stated = job.keys.decision_rule
    rule = make_decision_rule(stated.rule, stated.guard_band_factor)
    budget = budget or make_budget_of_job(job, measurements, registry)
    chosen = choose_standards(job, registry)
    bare = [
        (evaluation, partial(standard.arithmetic, options=options))
        for (standard, options), evaluation in zip(
            chosen, evaluate_parameters(job, measurements, registry), strict=True
        )
    ]
    complete: list[Evaluated] = []
    for (standard, _), evaluation in zip(chosen, add_uncertainty(bare, budget, trials), strict=True):
        reported = check_information(find_information_asked_by(standard), job, measurements, budget)
        with_verdicts = with_decisions(replace(evaluation, findings=(*evaluation.findings, *reported)), rule)
        complete.append(Evaluated(with_verdicts, (), budget))
    return tuple(complete)


def draw_graphs(job: Job, evaluated: Sequence[Evaluated], registry: Registry) -> tuple[Evaluated, ...]:
    """Return evaluations by the standards of a job with the graphs that these prescribe."""
    return tuple(
        replace(each, figures=tuple(standard.figures(each.evaluation, options)))
        for (standard, options), each in zip(choose_standards(job, registry), evaluated, strict=True)
    )


def fit_model(
    job: Job, measurements: MeasurementSet, registry: Registry, showing: Showing = _show_nothing
) -> Modelled:
    """Hold the job's error model against the readings, and ask its standards about a corrected axis."""
    from zlmreport.document.subjects.annex import Modelled  # noqa: PLC0415
    from zlmreport.document.subjects.forecast import make_forecasts  # noqa: PLC0415 - only for a job with a model
    from zlmreport.model.diagnosis.study import Fitted, Study  # noqa: PLC0415
    from zlmreport.model.planning.deciding import plan_experiment_of_tie  # noqa: PLC0415

    study = Study.of(job, measurements, registry.effects, read_sessions(job, registry))
    with showing("diagnosing") as told:
        diagnosis = study.diagnose(registry.effects, told)
    with showing("simulating plans") as told:
        experiment = plan_experiment_of_tie(study, diagnosis, registry.effects, told)
    history = study.fit_history(Fitted(diagnosis.fit, diagnosis.error))
    return Modelled(
        history,
        diagnosis,
        make_forecasts(choose_standards(job, registry), study, history),
        study.list_titles(registry.effects),
        study,
        experiment,
    )


def choose_standards(job: Job, registry: Registry) -> list[tuple[Standard, Any]]:
    """Return the standards that a job names, as they evaluate what was measured, each with its own keys."""
    stated = job.axis.error or job.axis.measurand.identifier
    return [
        (evaluate_for_error(registry.standard(choice.identifier), stated), choice.options)
        for choice in job.standards
    ]


def run(
    job: Job, registry: Registry, signer: Signer | None = None, showing: Showing = _show_nothing
) -> Outcome:
    """Make every file of a job, in memory: a failure at any step leaves nothing behind."""
    demand_days_past(job)
    renderers = [registry.renderer(identifier) for identifier in job.formats]
    with _collect_garbage_once():
        is_laid_out = any(map(needs_layout, renderers))
        certificate = compose(job, registry, showing=showing, is_laid_out=is_laid_out)
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
            Document(job.directory / name, contents[renderer.identifier])
            for name, renderer in zip(name_files(certificate.number, renderers), renderers, strict=True)
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
    if carriers and not is_asked_for and RESULTS in registry.list_identifiers(RENDERER):
        others.append(registry.renderer(RESULTS))
    contents = {each.identifier: each.render(certificate) for each in others}
    if carriers:
        attached = [
            Attachment(
                name,
                contents[each.identifier],
                find_media_type(name),
                relationship,
                each.title.in_language(certificate.language),
            )
            for name, each in zip(name_files(certificate.number, others), others, strict=True)
            if (relationship := find_relationship_of(each))
        ]
        attached += attach_sources(certificate.sources, certificate.language)
        complete = replace(certificate, attachments=arrange_attachments(attached, certificate.number))
        contents |= {each.identifier: each.render(complete) for each in carriers}
    return contents


def name_files(number: str, renderers: Sequence[Renderer]) -> tuple[str, ...]:
    """Return the names of a certificate's files: ``CAL-1.pdf``.

    Where several write files of one suffix, those after the first have their identifiers in their names:
    ``CAL-1-pdf-typst.pdf``.
    """
    first = {each.suffix: each.identifier for each in reversed(renderers)}
    return tuple(
        f"{number}{'' if first[each.suffix] == each.identifier else f'-{each.identifier}'}{each.suffix}"
        for each in renderers
    )


@contextlib.contextmanager
def _collect_garbage_once() -> Iterator[None]:
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
