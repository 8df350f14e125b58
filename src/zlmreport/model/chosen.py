"""From the effects that a file names to terms of a model, their values in SI."""

from __future__ import annotations

from collections.abc import Callable, Iterable

from zlmreport.job.effects import EffectChoice
from zlmreport.measurement.axis import AxisKind
from zlmreport.model.axis_model import Term
from zlmreport.model.effect import Effect
from zlmreport.model.parameter import unit_of


def chosen_terms(
    choices: Iterable[EffectChoice], find: Callable[[str], Effect], kind: AxisKind
) -> tuple[Term, ...]:
    """Return the effects that a file names, in the forms that it asks for.

    Parameters
    ----------
    choices
        As the file was loaded.
    find
        Returns an installed effect by its identifier.
    kind
        Of the axis, for the units.
    """
    return tuple(_term(choice, find(choice.identifier), kind) for choice in choices)


def _term(choice: EffectChoice, effect: Effect, kind: AxisKind) -> Term:
    term = Term(effect.with_settings(choice.settings))
    units = {parameter.name: unit_of(parameter.dimension, kind) for parameter in term.parameters}
    return Term(term.effect, {name: value / units[name].per_si for name, value in choice.values.items()})
