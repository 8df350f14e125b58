"""Lists the effects that can be tried beside a model; those that cannot, with what they say of it."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from zlmreport.language import Words
from zlmreport.model.effects.axis_model import AxisModel, refuse_collisions
from zlmreport.model.effects.design import Design
from zlmreport.model.effects.effect import Effect, is_against
from zlmreport.model.effects.model_error import ModelError

_IMITATED = Words("at these targets {effect} imitates it entirely")
_THE_MODEL = Words("the model")
_DENIED = Words("{effect} has another value than the job states under axis.{key}")
_SHOWN_BY = Words("{imitated}; what would show it: {measurement}")


@dataclass(frozen=True, slots=True)
class NotTestable:
    """An effect that the test cannot show."""

    effect: str  #: Its identifier.
    reason: Words  #: What it needs, or that the model imitates it.


@dataclass(frozen=True, slots=True)
class EffectsToTry:
    """The effects that can be tried beside a model."""

    forms: tuple[Effect, ...]  #: Every form of every effect.
    not_testable: tuple[NotTestable, ...]  #: Effects that the test cannot show in any form.


def list_effects_to_try(model: AxisModel, design: Design, effects: Iterable[Effect]) -> EffectsToTry:
    """Return the effects that can be tried beside a model.

    An effect that is in the model already enters only with forms that have more parameters: a polynomial
    of higher order.
    """
    present = {term.effect.identifier: term.effect for term in model.terms}
    forms: list[Effect] = []
    not_testable = []
    for effect in map(model.take_next_of, effects):
        plainer = present.get(effect.identifier)
        least, further = (len(plainer.linear), plainer.further_forms()) if plainer else (0, ())
        listed = [form for form in (*effect.forms(), *further) if len(form.linear) > least]
        reasons = [
            form.untestable(design) or _say_denied(model, form) or _say_collision(model, design, form)
            for form in listed
        ]
        forms.extend(form for form, reason in zip(listed, reasons, strict=True) if reason is None)
        if listed and None not in reasons:
            not_testable.append(
                NotTestable(effect.identifier, reasons[0] or _say_imitated(model, design, effect))
            )
    return EffectsToTry(tuple(forms), tuple(not_testable))


def _say_denied(model: AxisModel, effect: Effect) -> Words | None:
    """Return that an effect takes what the job states where one of the model denies it, or the reverse."""
    for each in (term.effect for term in model.terms):
        if each.identifier != effect.identifier and is_against(each, effect):
            denying, taking = (each, effect) if each.denies & effect.takes else (effect, each)
            key = min(denying.denies & taking.takes)
            return _DENIED.given(effect=denying.identifier, key=key)
    return None


def _say_collision(model: AxisModel, design: Design, effect: Effect) -> Words | None:
    """Return that the model would not be determined with the effect in it; None if it is."""
    return _say_imitated(model, design, effect) if _collides(model, design, effect) else None


def _collides(model: AxisModel, design: Design, effect: Effect) -> bool:
    """Return whether a model with an effect would not be determined."""
    extended = model.with_effect(effect)
    try:
        refuse_collisions(extended, [term.compute_some_columns(design) for term in extended.terms])
    except ModelError:
        return True
    return False


def _say_imitated(model: AxisModel, design: Design, effect: Effect) -> Words:
    """Return what imitates an effect entirely, and the measurement that would show it."""
    for term in model.terms:
        if effect.identifier in term.effect.contains:
            return _IMITATED.given(effect=term.effect.identifier)
    alone = [each.effect for each in model.terms if _collides(AxisModel((each,)), design, effect)]
    alike = [each for each in effect.confusions if each.effect in (other.identifier for other in alone)]
    names = [*(each.effect for each in alike), *(each.identifier for each in alone)]
    words = _IMITATED.given(effect=names[0] if names else _THE_MODEL)
    known = (*alike, *effect.confusions)
    return _SHOWN_BY.given(imitated=words, measurement=known[0].told_apart_by) if known else words
