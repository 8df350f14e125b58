"""``zlmreport model add`` and ``remove``: the model is tried first, and only then the job is written."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from zlmreport.cli.model_fall import change_lines
from zlmreport.cli.model_json import change_values
from zlmreport.cli.model_session import Change, Session
from zlmreport.errors import InputError, Place, Problem, did_you_mean
from zlmreport.job.edit import NamedEffect, edit_effects, named_effect
from zlmreport.job.effects import EffectChoice
from zlmreport.language import Language
from zlmreport.model import wording
from zlmreport.model.study import Fitted

_KEY = "model.effects"


def add(session: Session, text: str) -> tuple[Iterable[str], Any]:
    """Add an effect to the job's model, in place of those that it contains."""
    named = named_effect(text, session.registry, Place("zlmreport model add"))
    identifier = named.choice.identifier
    replaced = {identifier, *session.registry.effect(identifier).contains}
    for choice in session.job.effects:
        if _meaning(choice) == _meaning(named.choice):
            raise InputError.at(choice.place, f"{identifier} stands in the model already")
    removed = tuple(choice.identifier for choice in session.job.effects if choice.identifier in replaced)
    change = _tried(session, named, removed)
    _refuse_useless(session, change)
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


def _refuse_useless(session: Session, change: Change) -> None:
    """Refuse an effect that does not lower the error."""
    after = change.history[-1]
    if after.error.rms >= change.before.error.rms:
        raise InputError.at(
            session.job.place_of(_KEY),
            f"{change.added} explains nothing here: the error would be {_rms(after)} with it and is "
            f"{_rms(change.before)} without; the job was left as it is",
        )


def _rms(fitted: Fitted) -> str:
    """Write an error with so many digits that a slight change shows."""
    unit = fitted.fit.design.axis.deviation_unit
    digits = wording.significant(unit.from_si(fitted.error.rms), 4)
    return f"{digits.in_language(Language.ENGLISH)} {unit.symbol}"


def _written(session: Session, change: Change) -> tuple[Iterable[str], Any]:
    change.edit.write()
    return change_lines(session, change), change_values(session, change)


def _meaning(choice: EffectChoice) -> tuple[object, ...]:
    return choice.identifier, choice.settings, dict(choice.values)
