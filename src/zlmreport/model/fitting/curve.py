"""At which positions the curve of a model is drawn, so that no wave or joint is lost.

A wave that is sampled at fewer positions than it has periods is drawn as another wave. So a curve has several
positions in each period, and one on either side of a joint; where the travel holds more periods than a page
can show, it runs through the least and the largest value of each stretch, and shows how far the wave reaches.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial

import numpy as np

from zlmreport.measurement.approach import Approach
from zlmreport.measurement.arrays import FloatArray
from zlmreport.model.effects.axis_model import Term
from zlmreport.model.effects.design import Design, place_at_positions
from zlmreport.model.effects.effect import Dimension, Effect
from zlmreport.model.effects.formula import FormulaEffect
from zlmreport.model.fitting.fit import Fit

#: Positions where nothing repeats and nothing jumps.
_POSITIONS = 480
_PER_PERIOD = 16
#: Beyond so many positions a page cannot part the periods; stretches that it can, and probes in each.
_MOST = 10_000
_STRETCHES, _PROBES = 600, 32
#: Distance of the two positions at a joint, as a share of the travel.
_BESIDE = 1e-9
_GOLDEN = (5.0**0.5 - 1.0) / 2.0


def lay_curve_positions(
    fitted: Fit, approach: Approach, span: tuple[float, float] | None = None
) -> FloatArray:
    """Return the positions of the curve of a model, rising, m or rad, shape (M,).

    `span`: The part of the travel that is drawn, m or rad; without it all that was measured.
    """
    design = fitted.design
    pairs = list(zip(fitted.model.terms, fitted.solution.thetas, strict=True))
    at = partial(place_at_positions, design, approach=approach)
    return _lay_positions(pairs, at, span or design.span, fitted.compute_value_at)


def shows_reach_only(fitted: Fit, span: tuple[float, float] | None) -> bool:
    """Return whether the travel holds more waves than a page can part: a curve then shows how far they reach.

    `span`: As of `lay_curve_positions`.
    """
    first, last = span or fitted.design.span
    shortest = min(find_waves_along(fitted).values(), default=np.inf)
    return bool(_PER_PERIOD * (last - first) / shortest > _MOST)


def lay_effect_positions(
    effect: Effect, theta: FloatArray, design: Design, approach: Approach, span: tuple[float, float]
) -> FloatArray:
    """Return the positions of the curve of one effect alone, all its linear parameters one, shape (M,).

    `span`: The part of the travel that is drawn, m or rad.
    """
    at = partial(place_at_positions, design, approach=approach)
    return _lay_positions(
        [(Term(effect), theta)], at, span, lambda asked: effect.columns(asked, theta).sum(axis=1)
    )


def _lay_positions(
    pairs: Sequence[tuple[Term, FloatArray]],
    at: Callable[[FloatArray], Design],
    span: tuple[float, float],
    value: Callable[[Design], FloatArray],
) -> FloatArray:
    first, last = span
    along = at(np.linspace(first, last, _MOST))
    shortest = min((_find_shortest_length(term, theta, along) for term, theta in pairs), default=np.inf)
    joints = [
        place for term, theta in pairs for place in _list_joints(term, theta, along) if first <= place <= last
    ]
    wanted = _PER_PERIOD * (last - first) / shortest
    if wanted <= _POSITIONS:
        found = np.linspace(first, last, _POSITIONS)
    elif wanted <= _MOST:
        found = np.linspace(first, last, int(np.ceil(wanted)) + 1)
    else:
        found = _find_extremes(lambda places: value(at(places)), span, shortest)
    if not joints:
        return np.asarray(found, dtype=np.float64)
    beside = np.add.outer(np.array(joints), np.array([-_BESIDE, _BESIDE]) * (last - first)).ravel()
    return np.unique(np.clip(np.concatenate([found, beside]), first, last))


def _find_extremes(
    value: Callable[[FloatArray], FloatArray], span: tuple[float, float], period: float
) -> FloatArray:
    """Return where a curve is least and largest in each stretch, and the ends of the travel."""
    first, last = span
    edges = np.linspace(first, last, _STRETCHES + 1)
    length = edges[1] - edges[0]
    # Probes of a stretch cover whole periods at uneven phases: a row that beats with the wave misses it.
    phases = (np.arange(_PROBES) * _GOLDEN) % 1.0
    reach = min(length, max(1.0, np.floor(length / period)) * period)
    probes = np.sort(edges[:-1, np.newaxis] + reach * phases, axis=1)
    values = value(probes.ravel()).reshape(probes.shape)
    rows = np.arange(_STRETCHES)
    chosen = [probes[rows, values.argmin(axis=1)], probes[rows, values.argmax(axis=1)]]
    return np.unique(np.concatenate([[first, last], *chosen]))


def _find_shortest_length(term: Term, theta: FloatArray, along: Design) -> float:
    """Return the shortest length over which an effect repeats or fades, m or rad; infinite if over none."""
    if isinstance(term.effect, FormulaEffect):
        fading = [term.effect.find_shortest_fading(along, theta)]
    else:
        named = zip(term.effect.searched, theta.tolist(), strict=True)
        fading = [abs(value) for parameter, value in named if parameter.name == "relaxation_length"]
    return min([_find_shortest_wave(term, theta, along), *fading]) or np.inf


def find_waves_along(fitted: Fit) -> dict[str, float]:
    """Return the length of the shortest wave of each effect of a model, m or rad; infinite if it has none."""
    design = fitted.design
    approach = Approach.POSITIVE if np.any(design.direction > 0) else Approach.NEGATIVE
    along = place_at_positions(design, np.linspace(*design.span, _MOST), approach)
    pairs = zip(fitted.model.terms, fitted.solution.thetas, strict=True)
    return {term.effect.identifier: _find_shortest_wave(term, theta, along) for term, theta in pairs}


def _find_shortest_wave(term: Term, theta: FloatArray, along: Design) -> float:
    if isinstance(term.effect, FormulaEffect):
        return term.effect.find_shortest_wave(along, theta)
    periods = [np.inf]
    orders = [int(each.name.partition("_")[2] or 1) for each in term.effect.linear if "sine" in each.name]
    for parameter, value in zip(term.effect.searched, theta.tolist(), strict=True):
        if parameter.dimension is Dimension.POSITION and parameter.name == "period":
            periods.append(abs(value))
        elif parameter.name == "teeth" and value:
            periods.append(2 * np.pi / abs(value))
    return float(min(periods)) / max(orders, default=1) or np.inf


def _list_joints(term: Term, theta: FloatArray, along: Design) -> list[float]:
    """Return positions at which an effect jumps or bends: its joints, and the rows of a table."""
    if isinstance(term.effect, FormulaEffect):
        return term.effect.find_joints(along, theta)
    named = zip(term.effect.searched, theta.tolist(), strict=True)
    found = [value for parameter, value in named if parameter.name in {"joint", "kink"}]
    tables = {"compensation": along.axis.compensation_table, "abbe": along.axis.angular_errors}
    for name, table in tables.items():
        if table is not None and term.effect.identifier.startswith(name):
            found.extend(table.positions)
    return found
