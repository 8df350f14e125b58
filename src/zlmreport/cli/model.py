"""``zlmreport model``: the error model of a job, from the first fit to the last effect."""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from zlmreport import pipeline
from zlmreport.certificate.forecast import Forecast, forecasts
from zlmreport.cli import model_learn
from zlmreport.cli.model_lines import change_lines, diagnosis_lines, fit_lines, history_lines, point_lines
from zlmreport.cli.model_values import (
    Change,
    change_values,
    fit_values,
    history_values,
    point_values,
    points_of,
)
from zlmreport.cli.terminal import print_json, progress, shown_path
from zlmreport.errors import InputError, Place, Problem, did_you_mean
from zlmreport.job.edit import NamedEffect, edit_effects
from zlmreport.job.job import Job
from zlmreport.job.loading import load
from zlmreport.language import Language
from zlmreport.measurement.measurement_set import MeasurementSet
from zlmreport.model.report import report
from zlmreport.model.study import Fitted, Study, addition, refuse_useless
from zlmreport.planning.deciding import experiment_of_tie, experiment_values
from zlmreport.plugins import Registry, find_plugins
from zlmreport.presenting.writer import Writer

_KEY = "model.effects"


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
        return shown_path(self.path)

    @property
    def writer(self) -> Writer:
        """Writes values as the certificate does."""
        return Writer.of(self.measurements, Language.ENGLISH)

    def study(self, job: Job | None = None) -> Study:
        """Return the study of the job, or of what it is to become."""
        return Study.of(job or self.job, self.measurements, self.registry.effects, self.sessions)

    def forecasts(self, study: Study, history: Sequence[Fitted]) -> tuple[Forecast, ...]:
        """Return what the job's standards would say of a corrected axis."""
        return forecasts(pipeline.standards(self.job, self.registry), study, history)


def run(options: Namespace) -> int:
    """Do what the action says with a job's error model."""
    if options.action == "learn":
        return model_learn.run(options)
    registry = find_plugins(files=options.plugin)
    job = load(options.job, registry)
    session = _Session(
        options.job, job, pipeline.read(job, registry), pipeline.read_sessions(job, registry), registry
    )
    lines, values = _ACTIONS[options.action](session, options)
    if options.json:
        print_json(values)
    else:
        print(*lines, sep="\n")
    return 0


def _fit(session: _Session, options: Namespace) -> tuple[Iterable[str], Any]:
    _demand_effects(session)
    fitted = session.study().fitted()
    points = points_of(fitted.fit, options.at)
    lines = (
        *fit_lines(fitted, session.job),
        *point_lines(points, session.job.axis),
        "",
        _next("diagnose", session),
    )
    return lines, fit_values(fitted) | point_values(points, session.job.axis)


def _diagnose(session: _Session, _: Namespace) -> tuple[Iterable[str], Any]:
    study, effects = session.study(), session.registry.effects
    with progress("diagnosing") as told:
        diagnosis = study.diagnosis(effects, told)
    with progress("simulating plans") as told:
        experiment = experiment_of_tie(study, diagnosis, effects, told)
    lines = diagnosis_lines(diagnosis, session.job, session.shown_path, experiment)
    values = experiment_values(experiment, session.job, Language.ENGLISH) if experiment else None
    return lines, report(diagnosis, experiment=values)


def _history(session: _Session, _: Namespace) -> tuple[Iterable[str], Any]:
    _demand_effects(session)
    study = session.study()
    history = study.history()
    forecasts = session.forecasts(study, history)
    lines = (*history_lines(history, forecasts, session.job, session.writer), "", _next("diagnose", session))
    return lines, history_values(history, forecasts)


def _add(session: _Session, options: Namespace) -> tuple[Iterable[str], Any]:
    """Add an effect to the job's model, in place of those that it contains."""
    registry = session.registry
    named, removed = addition(
        options.effect, session.job, registry, registry.effects, Place("zlmreport model add")
    )
    change = _tried(session, named, removed)
    refuse_useless(change.added, change.before, change.history[-1], session.job)
    return _written(session, change)


def _remove(session: _Session, options: Namespace) -> tuple[Iterable[str], Any]:
    """Take an effect out of the job's model."""
    text, present = options.effect, [choice.identifier for choice in session.job.effects]
    if text not in present:
        raise InputError.at(
            session.job.place_of(_KEY),
            f"{text[:60]!r} does not stand in the model; {did_you_mean(text, present)}",
        )
    return _written(session, _tried(session, None, (text,)))


_ACTIONS = {"fit": _fit, "diagnose": _diagnose, "add": _add, "remove": _remove, "history": _history}


def _tried(session: _Session, named: NamedEffect | None, removed: tuple[str, ...]) -> Change:
    """Return a change of the model with what it does; nothing is written."""
    edit = edit_effects(session.path, session.job, session.registry, add=named, remove=removed)
    before = session.study().fitted()
    study = session.study(edit.job)
    try:
        history = study.history()
    except InputError as error:  # its places are those of the job as it would be
        place = session.job.place_of(_KEY)
        raise InputError(Problem(place, each.message) for each in error.problems) from error
    added = named.choice.identifier if named else ""
    return Change(edit, added, removed, before, history, session.forecasts(study, history))


def _written(session: _Session, change: Change) -> tuple[Iterable[str], Any]:
    change.edit.write()
    return change_lines(session.path, change, session.writer), change_values(session.path, change)


def _next(action: str, session: _Session) -> str:
    return f"next: zlmreport model {action} {session.shown_path}"


def _demand_effects(session: _Session) -> None:
    if not session.job.effects:
        raise InputError.at(
            session.job.place_of(_KEY),
            "the job names no effect in model.effects; begin with: zlmreport model add "
            f"{session.shown_path} offset",
        )
