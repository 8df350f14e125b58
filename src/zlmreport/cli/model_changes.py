"""``zlmreport model add`` and ``remove``: the model is tried first, and only then the job is written."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from zlmreport.cli.model_fall import change_lines
from zlmreport.cli.model_json import change_values
from zlmreport.cli.model_session import Change, Session
from zlmreport.errors import InputError, Place, Problem, did_you_mean
from zlmreport.job.edit import NamedEffect, edit_effects
from zlmreport.model.study import addition, refuse_useless

_KEY = "model.effects"


def add(session: Session, text: str) -> tuple[Iterable[str], Any]:
    """Add an effect to the job's model, in place of those that it contains."""
    registry = session.registry
    named, removed = addition(text, session.job, registry, registry.effects, Place("zlmreport model add"))
    change = _tried(session, named, removed)
    refuse_useless(change.added, change.before, change.history[-1], session.job)
    return _written(session, change)


def remove(session: Session, text: str) -> tuple[Iterable[str], Any]:
    """Take an effect out of the job's model."""
    present = [choice.identifier for choice in session.job.effects]
    if text not in present:
        raise InputError.at(
            session.job.place_of(_KEY),
            f"{text[:60]!r} does not stand in the model; {did_you_mean(text, present)}",
        )
    return _written(session, _tried(session, None, (text,)))


def _tried(session: Session, named: NamedEffect | None, removed: tuple[str, ...]) -> Change:
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


def _written(session: Session, change: Change) -> tuple[Iterable[str], Any]:
    change.edit.write()
    return change_lines(session, change), change_values(session, change)
