"""The grid of values from which a searched parameter starts: periods, places, time constants."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from itertools import product
from types import MappingProxyType

import numpy as np

from zlmreport.job.formula_keys import Search
from zlmreport.measurement.arrays import FloatArray
from zlmreport.model.effects.design import Design
from zlmreport.model.effects.effect import Dimension, Parameter, list_moments_after_pauses

#: Values of searched parameters that are tried: at most all together, of one alone, in each of its periods.
_MOST, _FEWEST, _PER_PERIOD = 400, 12, 4
#: Of the travel: a shorter length ends before the second target, a longer one is a straight line.
_FADING = np.geomspace(0.01, 0.2, 10)
#: Of the duration: a shorter one ends with the first readings, a longer one is a straight line.
_WARMING = np.geomspace(0.05, 1.5, 12)
#: The same of a drift, and a time constant over which it is straight.
_DRIFTING = np.append(_WARMING, 5.0)
#: Fewer waves in the travel are a bow; steps by which a wave shifts a quarter of a period over the travel.
_FEWEST_WAVES, _STEPS_PER_WAVE = 1.3, 4
#: Waves within the test: fewer are a drift, more are taken for noise; how many more where each has how many
#: readings: a cooler switches often while an axis is measured for an hour.
_WAVES_IN_TIME, _MOST_WAVES_IN_TIME, _READINGS_PER_WAVE = (1.3, 9.0), 24.0, 8
#: Closer to the ends a kink is hardly more than a single target that stands off.
_KINKS = np.linspace(0.12, 0.88, 20) - 0.5
#: Of the travel or the time, about the middle: where a hump may lie, and how wide it may be. What is narrower
#: has many causes, and none of them is worth a name without a look at the place.
_PLACES, _WIDTHS, _SPELLS = np.linspace(-0.5, 0.5, 11), np.array([0.2, 0.3, 0.45]), np.array([0.3, 0.5, 0.8])
_LAGS = np.geomspace(0.02, 0.5, 6)
_FIXED_POINTS, _AT_ZERO = np.linspace(-0.5, 0.5, 5), 0.05
_MOST_MOMENTS = 200
#: How much alike a wave and its image on the grid of the mean interval are, where targets lie evenly.
_EVEN = 0.8
#: One and two waves a turn have names of their own.
_FEWEST_TEETH = 3
_TURN = 2 * math.pi


def search_grid(
    design: Design,
    searched: Sequence[Parameter],
    known: Mapping[str, float] = MappingProxyType({}),
    ways: Mapping[str, Search | FloatArray] = MappingProxyType({}),
) -> FloatArray:
    """Return values of parameters that a search begins with, shape (g, len(searched)).

    They lie between the ends of the ranges, which must be stated, lengths and times as close as waves of them
    ask for; or follow from the test.

    Parameters
    ----------
    design
        The test.
    searched
        The parameters.
    known
        Values, SI, of those that are not searched, by name.
    ways
        What is searched for, of those whose values follow from the test, or the only values that make sense,
        by name.
    """
    each = [
        np.array([known[parameter.name]])
        if parameter.name in known
        else _choose_starts(parameter, design, ways)
        for parameter in searched
    ]
    several = sum(len(one) > 1 for one in each)
    if several > 1:
        share = int(_MOST ** (1.0 / several))
        each = [one[np.linspace(0, len(one) - 1, min(len(one), share)).astype(int)] for one in each]
    rows = list(product(*each))
    return np.array(rows, dtype=np.float64).reshape(len(rows), len(each))


def _choose_starts(
    parameter: Parameter, design: Design, ways: Mapping[str, Search | FloatArray]
) -> FloatArray:
    if parameter.name in ways:
        return choose_values_of(ways[parameter.name], design)
    low, high = parameter.smallest or 0.0, parameter.largest or 0.0
    if low <= 0:
        return np.linspace(low, high, 2 * _FEWEST)
    extent = design.duration if parameter.dimension is Dimension.TIME else design.length
    wanted = _FEWEST + _PER_PERIOD * extent * (1.0 / low - 1.0 / high)
    return 1.0 / np.linspace(1.0 / high, 1.0 / low, int(min(wanted, _MOST)))


def choose_values_of(way: Search | FloatArray, design: Design) -> FloatArray:
    """Return the values with which a search begins, SI: those that follow from the test, or those given."""
    return _WAYS[way](design) if isinstance(way, Search) else way


def count_waves_told(design: Design) -> float:
    """Return how many waves in the travel the targets can tell: half as many as there are targets.

    Where these lie irregularly, as many: only on an even grid a shorter period looks like a longer one.
    """
    targets = design.target_positions
    turns = np.exp(2j * np.pi * targets * (len(targets) - 1) / design.length)
    return len(targets) / (1 if abs(turns.mean()) < _EVEN else 2)


def _list_waves_along(design: Design) -> FloatArray:
    """Return periods, even in their inverse."""
    most = count_waves_told(design)
    return design.length / np.arange(_FEWEST_WAVES, most + 1e-9, 1 / _STEPS_PER_WAVE)


def _list_waves_in_time(design: Design) -> FloatArray:
    """Return periods in time, even in their inverse."""
    fewest, most = _WAVES_IN_TIME
    most = float(np.clip(len(design.time) / _READINGS_PER_WAVE, most, _MOST_WAVES_IN_TIME))
    waves = np.linspace(fewest, most, 1 + round(_STEPS_PER_WAVE * (most - fewest)))
    return np.asarray(design.duration / waves, dtype=np.float64)


def _list_gaps(design: Design) -> FloatArray:
    """Return the middle of every gap between targets but the outer ones."""
    targets = design.target_positions
    return (targets[1:-2] + targets[2:-1]) / 2


def _list_moments(design: Design) -> FloatArray:
    """Return moments between readings, spread evenly over them, but for the first and the last gap."""
    moments = np.unique(design.time)
    between = (moments[1:-2] + moments[2:-1]) / 2
    chosen = np.linspace(0, len(between) - 1, min(_MOST_MOMENTS, len(between))).round().astype(int)
    return np.asarray(between[chosen], dtype=np.float64)


def _list_teeth(design: Design) -> FloatArray:
    """Return whole numbers of waves a turn that the targets can tell."""
    turns = design.length / _TURN
    fewest = max(_FEWEST_TEETH, math.ceil(_FEWEST_WAVES / turns))
    most = max(fewest, math.floor(len(design.target_positions) / (2 * turns)))
    return np.arange(fewest, most + 1, dtype=np.float64)


def _list_fixed_points(design: Design) -> FloatArray:
    """Return places in the travel but the zero of the axis, from which another effect grows."""
    places = design.middle + _FIXED_POINTS * design.length
    return np.asarray(places[np.abs(places) > _AT_ZERO * design.length], dtype=np.float64)


_WAYS: Mapping[Search, Callable[[Design], FloatArray]] = {
    Search.FADING_LENGTH: lambda design: design.length * _FADING,
    Search.TIME_CONSTANT: lambda design: design.duration * _WARMING,
    Search.DRIFT_TIME: lambda design: design.duration * _DRIFTING,
    Search.WAVE_LENGTH: _list_waves_along,
    Search.WAVE_TIME: _list_waves_in_time,
    Search.JOINT: _list_gaps,
    Search.MOMENT: _list_moments,
    Search.KINK: lambda design: design.middle + _KINKS * design.length,
    Search.WHOLE_NUMBER: _list_teeth,
    Search.RUN: lambda design: np.unique(design.run)[1:].astype(np.float64),
    Search.PAUSE: list_moments_after_pauses,
    Search.PLACE: lambda design: design.middle + _PLACES * design.length,
    Search.WIDTH: lambda design: design.length * _WIDTHS,
    Search.PEAK: lambda design: float(design.time.min()) + (_PLACES + 0.5) * design.duration,
    Search.SPELL: lambda design: design.duration * _SPELLS,
    Search.LAG: lambda design: design.duration * _LAGS,
    Search.FIXED_POINT: _list_fixed_points,
}
#: Between whose values a search finds nothing: only these make sense, or nothing changes between them.
NOT_REFINED = frozenset({Search.JOINT, Search.MOMENT, Search.WHOLE_NUMBER, Search.RUN, Search.PAUSE})
#: Whose values are whole numbers.
COUNTED = frozenset({Search.WHOLE_NUMBER, Search.RUN})
