"""The job of a second test that decides between effects in question (``plan --decide``)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import partial
from pathlib import PurePath
from typing import Any

import numpy as np

from zlmreport.errors import InputError, Place, did_you_mean
from zlmreport.job.effect_choices import EffectChoice
from zlmreport.job.job import Job
from zlmreport.job.yaml_text import write_group
from zlmreport.language import Language
from zlmreport.measurement.arrays import FloatArray
from zlmreport.measurement.units import SECONDS_PER_MINUTE
from zlmreport.model.diagnosis.candidate import EffectCandidate
from zlmreport.model.diagnosis.contest import Told, tell_nobody
from zlmreport.model.diagnosis.diagnosis import AxisDiagnosis
from zlmreport.model.diagnosis.finding import find_known_noise
from zlmreport.model.diagnosis.study import Study
from zlmreport.model.effects.axis_model import AxisModel
from zlmreport.model.effects.design import Design
from zlmreport.model.effects.effect import Dimension, Effect
from zlmreport.model.effects.model_error import ModelError
from zlmreport.model.fitting.fit import Fit, fit
from zlmreport.model.fitting.noise import list_noise_parts
from zlmreport.model.fitting.observations import Observations
from zlmreport.model.planning.experiment import Experiment, plan_next_experiment
from zlmreport.model.planning.plan import (
    ExpectedTest,
    PlannedStandard,
    find_measured_plan,
    make_seed_of,
    propose,
)
from zlmreport.model.planning.planned_test import choose_model_of
from zlmreport.model.planning.rivals import Question, Rival
from zlmreport.model.planning.targets import convert_to_users_unit
from zlmreport.model.planning.visibility import expect_design, find_determined

PLACE = Place("zlmreport plan --decide")
#: Of effects that nobody has measured: their root mean square value over the repeatability.
_UNMEASURED = 3.0
_DEGREES = 30
#: The data source whose table `zlmreport plan` writes as a form.
_FORM = "laser-csv"
_OF_THE_FORM: Mapping[str, Mapping[str, str]] = {
    "columns": {},
    "units": {"target": "mm", "deviation": "um", "time": "s"},
}


def plan_experiment_of_tie(
    study: Study, diagnosis: AxisDiagnosis, effects: Sequence[Effect], told: Told = tell_nobody
) -> Experiment | None:
    """Return the experiment that tells the first candidate of a diagnosis from its equals; None without any.

    `told`: Is told the share of the plans that are simulated.
    """
    question = find_question_of_tie(diagnosis)
    return None if question is None else _plan_of_study(study, diagnosis.fit, question, effects, told)


def find_question_of_tie(diagnosis: AxisDiagnosis) -> Question | None:
    """Return which of the first candidate and its equals it is; None without any."""
    leading = diagnosis.candidates[0] if diagnosis.candidates else None
    if leading is None or not leading.equals:
        return None
    base = diagnosis.fit
    tied = [each for each in diagnosis.candidates if each.identifier in {leading.identifier, *leading.equals}]
    fits = [_fit_with(base, each) for each in tied]
    rivals = [
        _make_rival(after, each.effect, each.probability, _estimate_size(base, after))
        for after, each in zip(fits, tied, strict=True)
    ]
    return make_question_of(base, rivals, fits)


def plan_deciding_experiment(
    names: Sequence[str],
    job: Job,
    study: Study | None,
    effects: Sequence[Effect],
    standards: Sequence[PlannedStandard],
) -> Experiment:
    """Return the experiment that tells effects apart that somebody names, or shows the one that is named.

    Where a diagnosis of the readings leaves just these open, it is the experiment that the diagnosis states.

    `study`: Of its readings; None if there are none yet: then the effects are taken to be three times as
        large as the repeatability that the plan expects.

    Raises `InputError` if none is named, one twice, or one that there is not.
    """
    known = {each.identifier: each for each in (study.list_tried(effects) if study else effects)}
    model = study.model if study else choose_model_of(job, effects)
    known |= {term.effect.identifier: term.effect for term in model.terms}
    _refuse_names(names, known)
    chosen = [known[name] for name in names]
    for name in names:
        model = model.without(name)
    if study is None:
        return _plan_unmeasured(job, model, chosen, effects, standards)
    stated = _plan_stated_tie(names, study, effects)
    if stated is not None:
        return stated
    base = replace(study, model=model).fit_whole().fit
    fits = [_fit_best_form(base, each) for each in chosen]
    sizes = [0.0 if each is None else _estimate_size(base, each) for each in fits]
    size = max(
        _UNMEASURED * min((each.noise.sigma for each in fits if each), default=base.noise.sigma), *sizes
    )
    rivals = [
        _make_rival(after, each, 1.0, size) if after else Rival.of_size(each, 1.0, size)
        for after, each in zip(fits, chosen, strict=True)
    ]
    return _plan_of_study(
        study, base, make_question_of(base, rivals, [each for each in fits if each]), effects
    )


def _plan_stated_tie(names: Sequence[str], study: Study, effects: Sequence[Effect]) -> Experiment | None:
    """Return the experiment that a diagnosis of the readings states for just these effects; None without."""
    if len(names) < 2 or {*names} & {*study.model.identifiers}:
        return None
    diagnosis = study.diagnose(effects)
    question = find_question_of_tie(diagnosis)
    if question is None or {*question.names} != {*names}:
        return None
    return _plan_of_study(study, diagnosis.fit, question, effects)


def _refuse_names(names: Sequence[str], known: Mapping[str, Effect]) -> None:
    if not names or len(set(names)) < len(names):
        example = "name an effect, or several once each, as screw-pitch,periodic"
        raise InputError.at(PLACE, example)
    for name in names:
        if name not in known:
            raise InputError.at(PLACE, f"there is no effect {name[:60]!r}; {did_you_mean(name, list(known))}")


def _fit_with(base: Fit, candidate: EffectCandidate) -> Fit:
    """Return the fit of a model with a candidate, where the diagnosis found it."""
    searched = [each.value for each in candidate.estimates if each.parameter in candidate.effect.searched]
    before = dict(zip(base.model.identifiers, base.solution.thetas, strict=True))
    model = base.model.with_effect(candidate.effect)
    start = tuple(before.get(term.effect.identifier, np.array(searched)) for term in model.terms[:-1])
    return fit(model, base.design, base.deviation, base.assumptions, (*start, np.array(searched)))


def _fit_best_form(base: Fit, effect: Effect) -> Fit | None:
    """Return the fit with an effect, in the form worth its parameters (G. Schwarz); None without any."""
    found: list[tuple[float, Fit]] = []
    for form in effect.forms():
        if form.untestable(base.design) is None:
            try:
                after = fit(base.model.with_effect(form), base.design, base.deviation, base.assumptions)
            except ModelError:
                continue
            count = len(after.deviation)
            squares = float(np.sum(after.residual**2)) or np.finfo(float).tiny
            found.append((count * np.log(squares) + (count - after.degrees) * np.log(count), after))
    return min(found, key=lambda each: each[0])[1] if found else None


def _estimate_size(base: Fit, after: Fit) -> float:
    """Return the root mean square value of what a further effect explains, m or rad."""
    return float(np.std(after.fitted - base.fitted))


def _make_rival(after: Fit, effect: Effect, probability: float, size: float) -> Rival:
    """Return an effect as fitted; of no more than a size where the readings do not tell its parameters."""
    parameters = (*effect.linear, *effect.searched)
    is_counted = after.design.time_is_counted and any(each.dimension is Dimension.TIME for each in parameters)
    found = Rival.of_fit(after, probability)
    if found.stands_out and not is_counted:
        return found
    return Rival.of_size(effect, probability, size, found.scatters)


def _plan_of_study(
    study: Study, base: Fit, question: Question, effects: Sequence[Effect], told: Told = tell_nobody
) -> Experiment:
    job = study.job
    scale = base.design.conditions.get("axis_temperature")
    rise = job.keys.plan.temperature_change if scale is None else float(np.ptp(scale))
    plan = find_measured_plan(job, study.measurements)
    seed = make_seed_of(job.keys.certificate.number)
    return plan_next_experiment(
        question, plan, ExpectedTest(question.sigma, rise), study.list_tried(effects), seed, told=told
    )


def make_question_of(base: Fit, rivals: Sequence[Rival], fits: Sequence[Fit]) -> Question:
    """Return the question which of some effects it is.

    `base`: The fitted model beside which they stand.
    `fits`: Of the model with one of them; the best one tells the noise.
    """
    best = min(fits, key=lambda each: each.rms, default=base)
    # What is larger than noise may be, the model lacks: another effect than those in question.
    largest = {part.source: part.ratios[-1] for part in list_noise_parts(base.design)}
    return Question(
        axis=base.design.axis,
        model=base.model,
        base=base.compute_base,
        rivals=tuple(rivals),
        sigma=best.noise.sigma,
        degrees=best.degrees,
        ratios={source: min(ratio, largest[source]) for source, ratio in best.noise.ratios.items()},
        known=find_known_noise(base),
        first=Observations(base.design, base.open_deviation, np.arange(len(base.deviation)), ()),
    )


def _plan_unmeasured(
    job: Job,
    model: AxisModel,
    chosen: Sequence[Effect],
    effects: Sequence[Effect],
    standards: Sequence[PlannedStandard],
) -> Experiment:
    proposal = propose(job, standards)
    expected = proposal.expected
    model = find_determined(model, expect_design(job.axis, proposal.plan, expected))
    size = _UNMEASURED * expected.sigma
    question = Question(
        axis=job.axis,
        model=model,
        base=partial(_make_columns, model),
        rivals=tuple(Rival.of_size(each, 1.0, size) for each in chosen),
        sigma=expected.sigma,
        degrees=_DEGREES,
        ratios={},
    )
    return plan_next_experiment(question, proposal.plan, expected, effects, proposal.seed)


def _make_columns(model: AxisModel, design: Design) -> FloatArray:
    columns = [term.compute_some_columns(design) for term in model.terms]
    return np.concatenate([np.empty((len(design.position), 0)), *columns], axis=1)


def collect_experiment(experiment: Experiment, job: Job, language: Language) -> dict[str, Any]:
    """Return an experiment as plain values for JSON; its job beside the one that left the question open."""
    plan = experiment.plan
    return {
        "effects": list(experiment.effects),
        "job": None if plan is None else make_deciding_job(experiment, job, PurePath(job.files[0].name).name),
        "minutes": experiment.minutes or None,
        "decides": experiment.decides,
        "log": list(experiment.logs),
        "statement": experiment.statement.in_language(language),
    }


def make_deciding_number(job: Job) -> str:
    """Return the number of the job that decides: the name of its file, too."""
    return f"{job.keys.certificate.number}-decide"


def write_deciding_text(experiment: Experiment, job: Job, extends: str) -> str:
    """Return the job of an experiment as the text of its file, ``<number>-decide.yaml``.

    `job`: The one that left the question open.
    `extends`: Its file, as the new one names it.
    """
    statement = experiment.statement.in_language(Language.ENGLISH)
    lines = [f"# {sentence.strip()}." for sentence in statement.rstrip(".").split(". ")]
    return "\n".join([*lines, *write_group(make_deciding_job(experiment, job, extends))]) + "\n"


def make_deciding_job(experiment: Experiment, job: Job, extends: str) -> dict[str, Any]:
    """Return the keys of the job of an experiment; parameters as `write_deciding_text` takes them."""
    plan, axis = experiment.plan, job.axis
    assert plan is not None  # noqa: S101 - the caller has seen to it
    overrun, feed = convert_to_users_unit(axis, np.array([plan.overrun, plan.feed * SECONDS_PER_MINUTE]))
    keys: dict[str, Any] = {
        "extends": extends,
        "certificate": {"number": make_deciding_number(job), "kind": "report"},
        "measurement": {
            "method": plan.method.value,
            "feed": feed,
            "dwell": plan.dwell,
            "source": _make_source_keys(job),
        },
        "plan": {
            "targets": {
                "count": None,
                "fractions_of": None,
                "positions": convert_to_users_unit(axis, plan.targets),
            },
            "runs": plan.runs,
            "overrun": overrun,
        },
    }
    if plan.pause:
        pause = plan.pause
        keys["plan"]["pause"] = {
            "minutes": pause.duration / SECONDS_PER_MINUTE,
            "change": pause.change,
            "of": pause.of,
        }
    model: dict[str, Any] = {"sessions": [extends]} if plan.after else {}
    kept = [each for each in job.effects if each.identifier not in experiment.effects]
    if len(kept) < len(job.effects):
        model["effects"] = [_write_effect(each) for each in kept]
    return {**keys, "model": model} if model else keys


def _write_effect(choice: EffectChoice) -> Any:
    """Return an effect as a job writes it."""
    limits = {name: each.model_dump(exclude_none=True) for name, each in choice.limits.items()}
    own = {**choice.settings.model_dump(mode="json", exclude_unset=True), **choice.values, **limits}
    return own if choice.is_formula else {choice.identifier: own} if own else choice.identifier


def _make_source_keys(job: Job) -> dict[str, Any]:
    """Return the data source of the new readings: the form of its plan, or another file of the same kind."""
    number, options = make_deciding_number(job), job.source.options
    stated = options.model_fields_set
    if job.source.identifier != _FORM:
        named = {key: getattr(options, key) for key in ("file", "journal") if key in stated}
        return {key: f"{number}{PurePath(str(name)).suffix}" for key, name in named.items()}
    fields = type(options).model_fields
    usual = {key: fields[key].get_default(call_default_factory=True) for key in sorted(stated - {"file"})}
    # Groups of keys are merged with those of the job, so that each of its own names has to be taken back.
    for key, value in _OF_THE_FORM.items():
        if key in stated:
            usual[key] = {name: value.get(name, name) for name in getattr(options, key)}
    return {"file": f"{number}-readings.csv", **usual}
