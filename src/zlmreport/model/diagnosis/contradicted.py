"""Values that the job gives and the readings contradict.

What a wrong value leaves has the shape of its own effect. That stands in the model already, so that no
contest names it: what is left would be taken for something unknown, or for other effects that are like it.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

from zlmreport.language import Words
from zlmreport.model.diagnosis.candidate import say_other_value
from zlmreport.model.diagnosis.error_numbers import compute_schwarz_criterion
from zlmreport.model.effects.axis_model import AxisModel, Term
from zlmreport.model.effects.effect import Effect
from zlmreport.model.effects.model_error import ModelError
from zlmreport.model.fitting.fit import Fit, fit

#: By how many of its own U the readings' value differs from the given one before they contradict it.
_CONTRADICTS = 2.0


def list_contradicted(complete: Fit, together: Sequence[Effect]) -> tuple[Words, ...]:
    """Return of each value that is given, and that the readings contradict, what they say instead.

    Where effects are named, the right value has to do what some of them do: an effect that explains more may
    be what pulls at the given value.

    `complete`: The model with all effects that are named, `together`.
    """
    if not any(_list_given(term) for term in complete.model.terms):
        return ()
    freed = _free_without(complete, together) if together else _fit_freed(complete, complete.model)
    return () if freed is None else tuple(_find_contradictions(complete, freed))


def _free_without(complete: Fit, together: Sequence[Effect]) -> Fit | None:
    """Return the best fit with free values and fewer named effects; None where these explain more."""
    best, least, model = None, compute_schwarz_criterion(complete), complete.model
    for _ in together:
        left = [each.identifier for each in together if each.identifier in model.identifiers]
        tried = (_fit_freed(complete, model.without(each)) for each in left)
        smaller = min((each for each in tried if each), key=compute_schwarz_criterion, default=None)
        if smaller is None:
            break
        model = smaller.model
        if compute_schwarz_criterion(smaller) <= least:
            best, least = smaller, compute_schwarz_criterion(smaller)
    return best


def _fit_freed(fitted: Fit, model: AxisModel) -> Fit | None:
    """Return the fit of a model without given values, to the readings of another one.

    None where the readings do not determine it: a value may be given for that.
    """
    terms = tuple(_free(term) for term in model.terms)
    try:
        return fit(AxisModel(terms), fitted.design, fitted.deviation, fitted.assumptions)
    except ModelError:
        return None


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
