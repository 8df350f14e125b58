"""Which effects stand in a contest, and which cannot be tried and why."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from zlmreport.language import Words
from zlmreport.model.axis_model import AxisModel
from zlmreport.model.design import Design
from zlmreport.model.effect import Effect


@dataclass(frozen=True, slots=True)
class NotTestable:
    """An effect that the test cannot show.

    Attributes
    ----------
    effect
        Its identifier.
    reason
        What it needs.
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
        reasons = [(form, form.untestable(design)) for form in effect.forms()]
        testable = [form for form, reason in reasons if reason is None]
        if not testable:
            reason = next(reason for _, reason in reasons if reason is not None)
            not_testable.append(NotTestable(effect.identifier, reason))
        least = present.get(effect.identifier, 0)
        forms.extend(form for form in testable if len(form.linear) > least)
    return Entrants(tuple(forms), tuple(not_testable))
