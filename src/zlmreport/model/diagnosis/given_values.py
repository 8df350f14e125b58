"""Values that the job gives to parameters, held against what the readings say of them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from zlmreport.language import Words
from zlmreport.model.diagnosis.candidate import say_other_value
from zlmreport.model.effects.axis_model import AxisModel, Term
from zlmreport.model.effects.model_error import ModelError
from zlmreport.model.fitting.fit import Fit, fit

#: By how many of its own U the readings' value differs from the given one before they contradict it.
_CONTRADICTS = 2.0


def list_contradicted(fitted: Fit) -> tuple[Words, ...]:
    """Return of each value that is given, and that the readings contradict, what they say instead.

    What a given value leaves has the shape of its own effect. That stands in the model already, so that no
    contest names it: what is left would be taken for something unknown.
    """
    if not any(_list_given(term) for term in fitted.model.terms):
        return ()
    model = AxisModel(tuple(_free(term) for term in fitted.model.terms))
    try:
        freed = fit(model, fitted.design, fitted.deviation, fitted.assumptions)
    except ModelError:  # it is given because the readings do not tell it from another
        return ()
    return tuple(_find_contradictions(fitted, freed))


def _list_given(term: Term) -> set[str]:
    """Return the parameters whose values are given, and not only held at a bound."""
    return {each.name for each in term.parameters if each.name in term.fixed and not term.find_bound(each)}


def _free(term: Term) -> Term:
    given = _list_given(term)
    return replace(term, fixed={name: value for name, value in term.fixed.items() if name not in given})


def _find_contradictions(fitted: Fit, freed: Fit) -> Iterator[Words]:
    said = {(each.effect, each.parameter.name): each for each in freed.estimates}
    for term in fitted.model.terms:
        for name in sorted(_list_given(term)):
            stated, found = term.fixed[name], said[term.effect.identifier, name]
            if abs(found.value - stated) > _CONTRADICTS * found.expanded_uncertainty:
                yield say_other_value(found, stated, fitted.design)
