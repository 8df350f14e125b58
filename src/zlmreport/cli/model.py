"""``zlmreport model``: the error model of a job, from the first fit to the last effect."""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Iterable
from typing import Any

from zlmreport import pipeline
from zlmreport.cli.model_changes import add, remove
from zlmreport.cli.model_diagnosis import diagnosis_lines
from zlmreport.cli.model_fall import history_lines
from zlmreport.cli.model_json import fit_values, history_values
from zlmreport.cli.model_lines import fit_lines
from zlmreport.cli.model_points import point_lines, point_values, points_of
from zlmreport.cli.model_session import Session
from zlmreport.cli.summary import print_json
from zlmreport.errors import InputError
from zlmreport.job.loading import load
from zlmreport.model.report import report
from zlmreport.plugins import find_plugins


def run(options: Namespace) -> int:
    """Do what the action says with a job's error model."""
    registry = find_plugins(files=options.plugin)
    job = load(options.job, registry)
    session = Session(options.job, job, pipeline.read(job, registry), registry)
    lines, values = _ACTIONS[options.action](session, options)
    if options.json:
        print_json(values)
    else:
        print(*lines, sep="\n")
    return 0


def _fit(session: Session, options: Namespace) -> tuple[Iterable[str], Any]:
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


def _diagnose(session: Session, _: Namespace) -> tuple[Iterable[str], Any]:
    diagnosis = session.study().diagnosis(session.registry.effects)
    return diagnosis_lines(diagnosis, session.job, session.shown_path), report(diagnosis)


def _history(session: Session, _: Namespace) -> tuple[Iterable[str], Any]:
    _demand_effects(session)
    study = session.study()
    history = study.history()
    forecasts = session.forecasts(study, history)
    lines = (*history_lines(history, forecasts, session.job), "", _next("diagnose", session))
    return lines, history_values(history, forecasts)


def _add(session: Session, options: Namespace) -> tuple[Iterable[str], Any]:
    return add(session, options.effect)


def _remove(session: Session, options: Namespace) -> tuple[Iterable[str], Any]:
    return remove(session, options.effect)


_ACTIONS = {"fit": _fit, "diagnose": _diagnose, "add": _add, "remove": _remove, "history": _history}


def _next(action: str, session: Session) -> str:
    return f"next: zlmreport model {action} {session.shown_path}"


def _demand_effects(session: Session) -> None:
    if not session.job.effects:
        raise InputError.at(
            session.job.place_of("model.effects"),
            "the job names no effect in model.effects; begin with: zlmreport model add "
            f"{session.shown_path} offset",
        )
