"""``zlmreport model``: the error model of a job, from the first fit to the last effect."""

from __future__ import annotations

from argparse import Namespace
from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, TypeAlias

from zlmreport.cli.model_lines import (
    tell_build,
    tell_change,
    tell_diagnosis,
    tell_fit,
    tell_history,
    tell_points,
    tell_what_follows,
)
from zlmreport.cli.model_values import (
    ModelChange,
    collect_change,
    collect_fit,
    collect_history,
    collect_points,
    find_points_of,
)
from zlmreport.cli.terminal import lay_out_table, print_json, show_path, show_progress
from zlmreport.document.subjects.diagnosis import write_effect_argument
from zlmreport.document.subjects.forecast import StandardForecast, make_forecasts
from zlmreport.document.writer import Writer
from zlmreport.errors import (
    AccessError,
    InputError,
    Place,
    Problem,
    ZlmreportError,
    count_in_words,
    did_you_mean,
)
from zlmreport.files import Document, read, say_reason, write
from zlmreport.job.edit import Edit, WrittenEffect, edit_effects
from zlmreport.job.extends import JOB
from zlmreport.job.job import Job
from zlmreport.job.loading import load
from zlmreport.job.parse import LARGEST, is_named_as_yaml
from zlmreport.language import Language
from zlmreport.measurement.measurement_set import MeasurementSet
from zlmreport.model.diagnosis.building import Built
from zlmreport.model.diagnosis.diagnosis import DiagnosisVerdict
from zlmreport.model.diagnosis.report import build_values, report
from zlmreport.model.diagnosis.study import Fitted, Study, read_addition, refuse_useless
from zlmreport.model.effects.effect import Effect
from zlmreport.model.fitting.priors import Lesson, learn_priors, write_priors
from zlmreport.model.planning.deciding import collect_experiment, plan_experiment_of_tie
from zlmreport.pipeline import choose_standards, read as read_readings, read_sessions
from zlmreport.plugin.registry import Registry, find_plugins

_KEY = "model.effects"
#: The effect that a model begins with, where it acts on what was measured.
_FIRST = "offset"
#: Lines for a terminal, and what gives the same as JSON: one of the two is asked for.
_Answer: TypeAlias = tuple[Iterable[str], Callable[[], Any]]

_LEARN = Place("zlmreport model learn")


@dataclass(frozen=True, slots=True)
class _Session:
    """A job whose error model is worked on, with its readings."""

    path: Path
    job: Job
    measurements: MeasurementSet
    sessions: tuple[MeasurementSet, ...]
    registry: Registry

    @property
    def shown_path(self) -> str:
        """The job file, as the user would type it."""
        return show_path(self.path)

    @property
    def writer(self) -> Writer:
        """Writes values as the certificate does."""
        return Writer.of(self.measurements, Language.ENGLISH)

    def make_study(self, job: Job | None = None) -> Study:
        """Return the study of the job, or of what it is to become."""
        return Study.of(job or self.job, self.measurements, self.registry.effects, self.sessions)

    def make_forecasts(self, study: Study, history: Sequence[Fitted]) -> tuple[StandardForecast, ...]:
        """Return what the job's standards would say of a corrected axis."""
        return make_forecasts(choose_standards(self.job, self.registry), study, history)


def run(options: Namespace) -> int:
    """Do what the action says with a job's error model."""
    if options.action == "learn":
        return learn(options)
    registry = find_plugins(files=options.plugin)
    job = load(options.job, registry)
    session = _Session(options.job, job, read_readings(job, registry), read_sessions(job, registry), registry)
    lines, collect_values = _ACTIONS[options.action](session, options)
    if options.json:
        print_json(collect_values())
    else:
        print(*lines, sep="\n")
    return 0


def _fit(session: _Session, options: Namespace) -> _Answer:
    _demand_effects(session)
    fitted = session.make_study().fit_whole()
    points = find_points_of(fitted.fit, options.at)
    lines = (
        *tell_fit(fitted, session.job),
        *tell_points(points, session.job.axis),
        "",
        _say_next(session),
    )
    return lines, lambda: collect_fit(fitted) | collect_points(points, session.job.axis)


def _diagnose(session: _Session, _: Namespace) -> _Answer:
    study, effects = session.make_study(), session.registry.effects
    with show_progress("diagnosing") as told:
        diagnosis = study.diagnose(effects, told)
    with show_progress("simulating plans") as told:
        experiment = plan_experiment_of_tie(study, diagnosis, effects, told)
    lines = tell_diagnosis(diagnosis, study, session.shown_path, experiment, effects)

    def collect_values() -> dict[str, Any]:
        values = collect_experiment(experiment, session.job, Language.ENGLISH) if experiment else None
        return report(diagnosis, experiment=values)

    return lines, collect_values


def _tell_history(session: _Session, _: Namespace) -> _Answer:
    _demand_effects(session)
    study = session.make_study()
    history = study.fit_history()
    forecasts = session.make_forecasts(study, history)
    lines = (
        *tell_history(history, forecasts, session.job, session.writer),
        "",
        _say_next(session),
    )
    return lines, lambda: collect_history(history, forecasts)


def _add(session: _Session, options: Namespace) -> _Answer:
    """Add an effect to the job's model, in place of those that it contains."""
    registry = session.registry
    named, removed = read_addition(
        options.effect, session.job, registry, registry.effects, Place("zlmreport model add")
    )
    change = _try_change(session, named, removed)
    refuse_useless(change.added, change.before, change.history[-1], session.job)
    return _write_change(session, change)


def _remove(session: _Session, options: Namespace) -> _Answer:
    text, present = options.effect, [choice.identifier for choice in session.job.effects]
    if text not in present:
        raise InputError.at(
            session.job.place_of(_KEY),
            f"{text[:60]!r} does not stand in the model; {did_you_mean(text, present)}",
        )
    return _write_change(session, _try_change(session, None, (text,)))


def _build(session: _Session, options: Namespace) -> _Answer:
    """Build the job's model step by step, and write it into the job at the end."""
    effects = session.registry.effects
    with show_progress("building") as told:
        built = session.make_study().build(effects, told)
    edit = _edit_of(session, built)
    if edit is not None and not options.dry_run:
        edit.write()
    job = edit.job if edit else session.job
    path, is_tried = session.shown_path, options.dry_run
    lines = (
        *tell_build(built, job, path, edit, is_tried=is_tried),
        *tell_what_follows(built.last, path, effects, is_to_be_written=is_tried and edit is not None),
    )
    return lines, lambda: build_values(built)


def _edit_of(session: _Session, built: Built) -> Edit | None:
    """Return the change of the job that a build comes to; None if it changes nothing."""
    named = [_name_as_in_a_job(each, session) for each in built.added]
    added = {each.choice.identifier for each in named}
    removed = tuple({*built.removed, *added})
    if not named and not built.removed:
        return None
    return edit_effects(session.path, session.job, session.registry, add=named, remove=removed)


def _name_as_in_a_job(effect: Effect, session: _Session) -> WrittenEffect:
    """Return an effect as a job names it: a formula of its candidates as it stands there."""
    job, registry = session.job, session.registry
    place = Place("zlmreport model build")
    listed = {each.identifier for each in job.candidates}
    text = effect.identifier if effect.identifier in listed else write_effect_argument(effect)
    return read_addition(text, job, registry, registry.effects, place)[0]


_ACTIONS = {
    "fit": _fit,
    "diagnose": _diagnose,
    "build": _build,
    "add": _add,
    "remove": _remove,
    "history": _tell_history,
}


def _try_change(session: _Session, named: WrittenEffect | None, removed: tuple[str, ...]) -> ModelChange:
    """Return a change of the model with what it does; nothing is written."""
    edit = edit_effects(
        session.path, session.job, session.registry, add=[named] if named else [], remove=removed
    )
    before = session.make_study().fit_whole()
    study = session.make_study(edit.job)
    try:
        history = study.fit_history()
    except InputError as error:  # its places are those of the job as it would be
        place = session.job.place_of(_KEY)
        raise InputError(Problem(place, each.message) for each in error.problems) from error
    added = named.choice.identifier if named else ""
    return ModelChange(edit, added, removed, before, history, session.make_forecasts(study, history))


def _write_change(session: _Session, change: ModelChange) -> _Answer:
    change.edit.write()
    lines = tell_change(session.path, change, session.writer)
    return lines, lambda: collect_change(session.path, change)


def _say_next(session: _Session) -> str:
    return f"next: zlmreport model diagnose {session.shown_path}"


def _demand_effects(session: _Session) -> None:
    if not session.job.effects:
        tried = [each.identifier for each in session.make_study().list_tried(session.registry.effects)]
        raise InputError.at(
            session.job.place_of(_KEY),
            "the job names no effect in model.effects; begin with: zlmreport model add "
            f"{session.shown_path} {_FIRST if _FIRST in tried else tried[0]}",
        )


def learn(options: Namespace) -> int:
    """Learn from every test in a folder whose model describes its readings."""
    registry, folder = find_plugins(files=options.plugin), options.job
    if not folder.is_dir():
        raise AccessError.at(_LEARN, f"{show_path(folder)} is no folder of jobs")
    lessons, told = _collect_lessons(sorted(filter(is_named_as_yaml, folder.rglob("*"))), registry)
    if not lessons:
        reasons = "".join(f"\n  {name}: {why}" for name, why in told)
        raise InputError.at(
            _LEARN,
            f"no job in {show_path(folder)} has an error model that describes its readings{reasons}",
        )
    found = learn_priors(lessons)
    if options.output:
        write([Document(options.output, write_priors(found, folder.resolve().name).encode())])
    if options.json:
        print_json(found.model_dump(mode="json", by_alias=True))
        return 0
    if not options.output:
        print(write_priors(found, folder.resolve().name), end="")
        return 0
    print(*lay_out_table(told, indent="  ", wrapping=1), sep="\n")
    print(f"\n{count_in_words(found.tests, 'test')} taught {show_path(options.output)}")
    print(f"next: name it in a job: model: {{priors: {options.output.name}}}")
    return 0


def _collect_lessons(paths: list[Path], registry: Registry) -> tuple[list[Lesson], list[tuple[str, str]]]:
    """Return what tests teach whose models describe their readings, and what is to be said of each job.

    They teach together what they have in common: most of them say on which axes, and what was measured.
    """
    jobs = [(show_path(path), _load_lesson(path, registry)) for path in paths]
    measured = Counter(_list_measured(job) for _, job in jobs if isinstance(job, Job))
    (usual, _), *_others = measured.most_common() or [(("", ""), 0)]
    lessons: list[Lesson] = []
    told: list[tuple[str, str]] = []
    seen: dict[tuple[str, ...], str] = {}
    for name, job in jobs:
        if job is None:
            continue
        found = job if isinstance(job, str) else _find_lesson(job, name, usual, seen, registry)
        if isinstance(found, Lesson):
            lessons.append(found)
        told.append((name, "learned" if isinstance(found, Lesson) else f"left out: {found}"))
    return lessons, told


def _load_lesson(path: Path, registry: Registry) -> Job | str | None:
    """Return a job that may teach, or why it cannot; None for a file that is no job."""
    try:
        if JOB.schema.encode() not in read(path, LARGEST):
            return None  # what jobs extend, a simulation, a fleet
        job = load(path, registry)
    except ZlmreportError as error:
        return error.problems[0].message
    except OSError as error:  # of the file itself: a pipe, a folder of this name, nobody's to read
        return f"it cannot be read: {say_reason(error)}"
    return replace(job, sessions=(), priors=None) if job.effects else "it has no error model"


def _list_measured(job: Job) -> tuple[str, str]:
    """Return what tests must share that teach together: the kind of axis, and what was measured."""
    return job.axis.kind, job.axis.measurand.identifier


def _find_lesson(
    job: Job, name: str, usual: tuple[str, str], seen: dict[tuple[str, ...], str], registry: Registry
) -> Lesson | str:
    """Return what a job teaches, or why it does not.

    `usual`: The kind of axis, and what was measured, of most of the jobs.
    `seen`: By the readings of jobs that taught, their names; this one's is added.
    """
    own = _list_measured(job)
    if own != usual:
        of, here = (f"{measurand} of a {kind} axis" for kind, measurand in (own, usual))
        return f"it is a test of {of}, and those of {here} teach here; give it a folder of its own"
    try:
        measurements = read_readings(job, registry)
        readings = tuple(each.sha256 for each in measurements.provenance.files)
        if readings in seen:
            return f"the readings of {seen[readings]}"
        diagnosis = Study.of(job, measurements, registry.effects).diagnose(registry.effects)
    except ZlmreportError as error:
        return error.problems[0].message
    except OSError as error:
        return f"it cannot be read: {say_reason(error)}"
    if diagnosis.verdict is not DiagnosisVerdict.ADEQUATE:
        return f"its model is not adequate ({diagnosis.verdict})"
    seen[readings] = name
    return Lesson.of(diagnosis.fit)
