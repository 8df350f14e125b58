"""What adding an effect to a job's model comes to: what goes out for it, and whether it explains anything."""

from __future__ import annotations

from collections.abc import Sequence

from zlmreport.errors import InputError, Place
from zlmreport.job.edit import NamedEffect, named_effect
from zlmreport.job.effects import EffectChoice
from zlmreport.job.installed import Installed
from zlmreport.job.job import Job
from zlmreport.language import Language
from zlmreport.model import wording
from zlmreport.model.effect import Effect
from zlmreport.model.study import Fitted

_KEY = "model.effects"


def addition(
    text: str, job: Job, registry: Installed, effects: Sequence[Effect], place: Place
) -> tuple[NamedEffect, tuple[str, ...]]:
    """Return an effect that a person names, and the effects of the model that it takes the place of.

    Parameters
    ----------
    text
        ``backlash``, or ``polynomial: {order: 5}`` as in a job.
    job
        To whose model it is to be added.
    registry, effects
        What is installed.
    place
        Where the person names it, for messages.

    Raises
    ------
    InputError
        If there is no such effect, or it stands in the model already.
    """
    named = named_effect(text, registry, place)
    identifier = named.choice.identifier
    for choice in job.effects:
        if _meaning(choice) == _meaning(named.choice):
            raise InputError.at(choice.place, f"{identifier} stands in the model already")
    contains = next(each.contains for each in effects if each.identifier == identifier)
    replaced = {identifier, *contains}
    return named, tuple(each.identifier for each in job.effects if each.identifier in replaced)


def refuse_useless(added: str, before: Fitted, after: Fitted, job: Job) -> None:
    """Refuse an effect that does not lower the error.

    Raises
    ------
    InputError
        With both errors.
    """
    if after.error.rms >= before.error.rms:
        raise InputError.at(
            job.place_of(_KEY),
            f"{added} explains nothing here: the error would be {_rms(after)} with it and is "
            f"{_rms(before)} without; the job was left as it is",
        )


def _rms(fitted: Fitted) -> str:
    """Write an error with so many digits that a slight change shows."""
    unit = fitted.fit.design.axis.deviation_unit
    digits = wording.significant(unit.from_si(fitted.error.rms), 4)
    return f"{digits.in_language(Language.ENGLISH)} {unit.symbol}"


def _meaning(choice: EffectChoice) -> tuple[object, ...]:
    return choice.identifier, choice.settings, dict(choice.values)
