"""Confidence intervals of parameters from the profile of the likelihood.

A parameter is held at a value and the others are fitted anew; the deviance rises by what the readings are
then described worse. The interval ends where it has risen by k², k the coverage factor of the parameter: at
±U in a linear model, and at unequal distances where the model bends (D. M. Bates and D. G. Watts, Nonlinear
Regression Analysis and Its Applications, 1988, chapter 6). What scatters is taken as the fit found it. It is
the interval about the best value: another period that fits as well is no part of it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from math import hypot, inf

import numpy as np

from zlmreport.model.effects.axis_model import AxisModel
from zlmreport.model.effects.effect import Parameter
from zlmreport.model.fitting.contrasts import make_root
from zlmreport.model.fitting.estimate import ParameterEstimate, find_scanned_ends
from zlmreport.model.fitting.fit import Fit
from zlmreport.model.fitting.noise import list_noise_parts
from zlmreport.model.fitting.search import FitProblem, descend

#: Fits with a parameter held, to find one end of its interval, and how near the rise must come.
_FITS, _NEAR = 12, 1e-4
#: Variances of a reading: a fit that another step changes less is good enough.
_SETTLED = 1e-5
_LARGEST_STEP, _SMALLEST_SHARE = 2.0, 0.05


@dataclass(frozen=True, slots=True)
class Interval:
    """The values of a parameter that the readings do not exclude."""

    #: effect and parameter: Of what: the identifier of the effect.
    effect: str
    parameter: Parameter
    #: low and high: Ends, SI; infinite where the readings exclude nothing and there is no bound.
    low: float
    high: float
    #: low_is_open and high_is_open: Whether the end is the bound of what is searched or allowed, and the
    #: readings do not exclude it.
    low_is_open: bool = False
    high_is_open: bool = False


def find_intervals(fitted: Fit) -> tuple[Interval, ...]:
    """Return the interval of every parameter that is estimated for itself, in the order of the model.

    One that lies at its bound is among them. The instrument's error, which no readings show, widens each side
    as it does U; bounds of other parameters that are solved are not held. An end takes twelve fits at most.
    """
    parts = fitted.assumptions.parts
    parts = list_noise_parts(fitted.design) if parts is None else parts
    problem = FitProblem(fitted.model, fitted.design, fitted.deviation, make_root(parts, fitted.noise))
    return tuple(_list_intervals(fitted, problem))


def _list_intervals(fitted: Fit, problem: FitProblem) -> Iterator[Interval]:
    at_places = {(place.term, place.column): (place.least, place.most) for place in fitted.places}
    identifiers = fitted.model.identifiers
    for each in fitted.estimates:
        index = identifiers.index(each.effect)
        term = fitted.model.terms[index]
        name = each.parameter.name
        if not (each.is_free or each.at_bound):
            continue
        if each.is_scanned:
            yield _scan_interval(fitted, problem, index, each)
            continue
        bounds = term.bounds.get(name, (-inf, inf))
        if each.parameter in term.effect.searched:
            bounds = at_places[index, term.effect.searched.index(each.parameter)]
        usual, widening = _find_usual_reach(fitted, problem, index, each)
        ends, are_open = [], []
        for sign, bound in zip((-1.0, 1.0), bounds, strict=True):
            most = abs(bound - each.value)
            rise = _make_rise(fitted, problem, index, each, sign)
            # Readings that scatter by nothing leave one value.
            reach = _find_reach(rise, usual, most, each.coverage_factor) if usual else 0.0
            are_open.append(reach is None)
            ends.append(bound if reach is None else each.value + sign * min(hypot(reach, widening), most))
        yield Interval(each.effect, each.parameter, ends[0], ends[1], are_open[0], are_open[1])


def _scan_interval(fitted: Fit, problem: FitProblem, index: int, estimate: ParameterEstimate) -> Interval:
    """Return the interval of a parameter of which only the values of a grid are known."""
    term = fitted.model.terms[index]
    column = term.effect.searched.index(estimate.parameter)
    low, high = find_scanned_ends(problem, fitted.solution, index, column, fitted.uncertainties.sigma)
    values = term.make_grid(fitted.design)[:, column]
    return Interval(estimate.effect, estimate.parameter, low, high, low <= values.min(), high >= values.max())


def _find_usual_reach(
    fitted: Fit, problem: FitProblem, index: int, estimate: ParameterEstimate
) -> tuple[float, float]:
    """Return k·u of a parameter: what the readings leave, and what the instrument adds."""
    known, own = fitted.uncertainties, (estimate.effect, estimate.parameter)
    if own in fitted.columns:
        place = fitted.columns.index(own)
        standard = float(np.sqrt(known.inverse[place, place]))
        systematic = float(np.linalg.norm(known.systematic[place]))
    else:  # it lies at a bound, and no column is its own
        term = fitted.model.terms[index]
        columns = term.effect.columns(fitted.design, fitted.solution.thetas[index])
        column = problem.whiten(columns[:, [term.effect.linear.index(estimate.parameter)]])
        standard, systematic = 1.0 / float(np.linalg.norm(column)), 0.0
    return estimate.coverage_factor * known.sigma * standard, estimate.coverage_factor * systematic


def _make_rise(
    fitted: Fit, problem: FitProblem, index: int, estimate: ParameterEstimate, sign: float
) -> Callable[[float], float]:
    """Return the root of the rise of the deviance over the distance of a parameter from its best value."""
    terms, thetas = fitted.model.terms, fitted.solution.thetas
    least, sigma = problem.solve_at(thetas).squares, fitted.uncertainties.sigma
    term = terms[index]

    def rise(distance: float) -> float:
        nonlocal thetas  # the others follow from step to step
        value = estimate.value + sign * distance
        held = replace(term, fixed={**term.fixed, estimate.parameter.name: value})
        start = [np.array(theta) for theta in thetas]
        if estimate.parameter in term.effect.searched:
            start[index][term.effect.searched.index(estimate.parameter)] = value
        constrained = replace(problem, model=AxisModel((*terms[:index], held, *terms[index + 1 :])))
        found = descend(constrained, constrained.solve_at(tuple(start)), _SETTLED * sigma**2)
        thetas = found.thetas
        return float(np.sqrt(max(found.squares - least, 0.0))) / sigma

    return rise


def _find_reach(rise: Callable[[float], float], first: float, most: float, level: float) -> float | None:
    """Return the distance at which a rise comes to a level; None where it does not, as far as it may go.

    The root of the deviance is nearly a straight line: steps follow the chord, within what is known.
    """
    low, low_rise, high, high_rise = 0.0, 0.0, inf, inf
    distance = min(first, most)
    for _ in range(_FITS if most > 0 else 0):
        found = rise(distance)
        if abs(found - level) <= _NEAR * level:
            return distance
        if found > level:
            high, high_rise = distance, found
        elif distance >= most:
            return None
        else:
            low, low_rise = distance, found
        if high == inf:
            wanted = distance * level / found if found > 0 else inf
            distance = min(max(wanted, 1.1 * distance), _LARGEST_STEP * distance, most)
        else:
            share = (level - low_rise) / (high_rise - low_rise)
            distance = low + (high - low) * min(max(share, _SMALLEST_SHARE), 1 - _SMALLEST_SHARE)
    return low if high < inf else None
