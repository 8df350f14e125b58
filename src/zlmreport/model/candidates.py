"""Which effects stand in a contest, and which cannot be tried and why."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from zlmreport.language import Words
from zlmreport.model.axis_model import AxisModel, ModelError, refuse_collisions
from zlmreport.model.design import Design
from zlmreport.model.effect import Effect

_IMITATED = Words(
    en="at these targets the model imitates it entirely",
    de="an diesen Zielpositionen ahmt das Modell ihn vollständig nach",
)


@dataclass(frozen=True, slots=True)
class NotTestable:
    """An effect that the test cannot show.

    Attributes
    ----------
    effect
        Its identifier.
    reason
        What it needs, or that the model imitates it.
    """

    effect: str
    reason: Words


@dataclass(frozen=True, slots=True)
class Entrants:
    """The effects that can be tried beside a model.

    Attributes
    ----------
    forms
        Every form of every effect.
    not_testable
        Effects that the test cannot show in any form.
    """

    forms: tuple[Effect, ...]
    not_testable: tuple[NotTestable, ...]


def entrants(model: AxisModel, design: Design, effects: Iterable[Effect]) -> Entrants:
    """Return the effects that can be tried beside a model.

    An effect that is in the model already enters only with forms that have more parameters: a polynomial
    of higher order.
    """
    present = {term.effect.identifier: len(term.effect.linear) for term in model.terms}
    forms: list[Effect] = []
    not_testable = []
    for effect in effects:
        least = present.get(effect.identifier, 0)
        listed = [form for form in effect.forms() if len(form.linear) > least]
        reasons = [form.untestable(design) or _collision(model, design, form) for form in listed]
        forms.extend(form for form, reason in zip(listed, reasons, strict=True) if reason is None)
        if listed and None not in reasons:
            not_testable.append(NotTestable(effect.identifier, reasons[0] or _IMITATED))
    return Entrants(tuple(forms), tuple(not_testable))


def _collision(model: AxisModel, design: Design, effect: Effect) -> Words | None:
    """Return that the model would not be determined with the effect in it; None if it is."""
    extended = model.with_effect(effect)
    columns = [term.columns(design, term.grid(design)[0])[0] for term in extended.terms]
    try:
        refuse_collisions(extended, columns)
    except ModelError:
        return _IMITATED
    return None
