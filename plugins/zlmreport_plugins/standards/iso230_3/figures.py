"""The graphs of ISO 230-3: displacements, tilts and temperatures over one axis of time."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np

from zlmreport.plugin import (
    ARCSECOND,
    CELSIUS,
    HOUR,
    Evaluation,
    Figure,
    FloatArray,
    MeasurementSet,
    Unit,
    Words,
    same_in_all_languages,
)
from zlmreport.plugin.standard import Bracket, Curve, Panel, PositionStatistics, Role, deviation_in_words
from zlmreport_plugins.standards.iso230_3.hours import Hours, compute_tilt_over_time
from zlmreport_plugins.standards.iso230_3.quantities import PAIRS, write_shown
from zlmreport_plugins.standards.iso230_3.requirements import list_temperatures

_ROLES = (Role.CHANNEL_1, Role.CHANNEL_2, Role.CHANNEL_3, Role.CHANNEL_4, Role.CHANNEL_5, Role.CHANNEL_6)
#: Brackets beside a graph; more would leave it no room.
_MOST_BRACKETS = 5
_ENDING = "_temperature"


def draw_figures(evaluation: Evaluation, hours: Hours, distances: Mapping[str, float]) -> Iterator[Figure]:
    """Yield the one figure: displacements, tilts where there are any, temperatures where they were logged.

    `distances`: Of both sensors of a direction, m, by its letter.
    """
    tests, statistics = evaluation.measurements.tests, evaluation.statistics.tests
    if not tests:
        return
    unit = evaluation.measurements.axis.deviation_unit
    panels = [_draw_displacements(statistics, evaluation, hours, unit)]
    panels += _draw_tilts(statistics, evaluation, hours, distances)
    panels += _draw_temperatures(tests)
    yield Figure(
        key="drift",
        title=_TITLE,
        alternative=_SEEN.given(
            sensors=same_in_all_languages(", ".join(tests)), largest=_say_largest(evaluation)
        ),
        x_title=_TIME,
        y_title=Words("Displacement"),
        x_unit=HOUR.symbol,
        y_unit=unit.symbol,
        panels=tuple(panels),
        spans_are_alike=False,
    )


def _choose_role(number: int) -> Role:
    return _ROLES[number % len(_ROLES)]


def _draw_displacements(
    statistics: Mapping[str, PositionStatistics], evaluation: Evaluation, hours: Hours, unit: Unit
) -> Panel:
    curves: list[Curve] = []
    brackets: list[Bracket] = []
    for number, (name, line) in enumerate(statistics.items()):
        values = unit.from_si(_from_the_first(line.mean_positive))
        at = HOUR.from_si(line.positions)
        curves.append(Curve(write_shown(name), _choose_role(number), at, values))
        if evaluation.value(f"E_{name}") is not None:
            brackets.append(_make_bracket(f"E_{{{name}}}", line.positions, values, hours))
    return Panel(
        heading=Words("Displacements"),
        curves=tuple(curves),
        brackets=tuple(brackets) if len(brackets) <= _MOST_BRACKETS else (),
    )


def _draw_tilts(
    statistics: Mapping[str, PositionStatistics],
    evaluation: Evaluation,
    hours: Hours,
    distances: Mapping[str, float],
) -> Iterator[Panel]:
    curves: list[Curve] = []
    brackets: list[Bracket] = []
    for letter, (first, second) in PAIRS.items():
        if letter not in distances or first not in statistics or second not in statistics:
            continue
        one = statistics[first]
        tilt = compute_tilt_over_time(one, statistics[second], distances[letter])
        values = ARCSECOND.from_si(_from_the_first(tilt))
        curves.append(
            Curve(f"φ_{{{letter}}}", _choose_role(len(curves)), HOUR.from_si(one.positions), values)
        )
        if evaluation.value(f"tilt_{letter}") is not None:
            brackets.append(_make_bracket(f"φ_{{{letter}}}", one.positions, values, hours))
    if curves:
        yield Panel(
            heading=Words("Tilts"),
            curves=tuple(curves),
            brackets=tuple(brackets),
            y_title=_TILT,
            y_unit=ARCSECOND.symbol,
        )


def _draw_temperatures(tests: Mapping[str, MeasurementSet]) -> Iterator[Panel]:
    """Yield the temperatures; what several sensors have beside them was logged once."""
    found: dict[str, tuple[FloatArray, FloatArray]] = {}
    for each in tests.values():
        at = HOUR.from_si(each.target_positions[np.sort(each.target, kind="stable")])
        for name, values in list_temperatures(each):
            if np.isfinite(values).any():
                found.setdefault(name, (at, values))
    if found:
        yield Panel(
            heading=Words("Temperatures"),
            curves=tuple(
                Curve(_write_theta(name), _choose_role(number), at, values)
                for number, (name, (at, values)) in enumerate(found.items())
            ),
            y_title=_TEMPERATURE,
            y_unit=CELSIUS.symbol,
        )


def _write_theta(name: str) -> str:
    return f"θ_{{{name.removesuffix(_ENDING).replace('_', ' ')}}}"


def _from_the_first(values: FloatArray) -> FloatArray:
    """Return values over time against the first that is there: sensors need no common zero."""
    there = values[np.isfinite(values)]
    return values - there[0] if there.size else values


def _make_bracket(notation: str, times: FloatArray, values: FloatArray, hours: Hours) -> Bracket:
    """Return the range of values in the hours, with the times at which its ends arise."""
    inside = np.where(hours.select(times), values, np.nan)
    low, high = int(np.nanargmin(inside)), int(np.nanargmax(inside))
    at = HOUR.from_si(times)
    return Bracket(notation, float(values[low]), float(values[high]), float(at[low]), float(at[high]))


def _say_largest(evaluation: Evaluation) -> Words:
    found = [each for each in evaluation.parameters if each.quantity.unit is None]
    if not found:
        return _NOT_DEFINED
    largest = max(found, key=lambda each: each.value)
    value = deviation_in_words(evaluation.measurements.axis, float(f"{largest.value:.4g}"))
    return Words("{symbol} = {value}").given(
        symbol=same_in_all_languages(largest.quantity.symbol), value=value
    )


_TITLE = Words("Displacements against the first reading, and temperatures, over one axis of time")
_SEEN = Words(
    "Graphs of the displacements of the sensors {sensors}, and of what else was recorded, over time; largest "
    "drift: {largest}."
)
_NOT_DEFINED = Words("not defined")
_TIME = Words("Time")
_TILT = Words("Tilt")
_TEMPERATURE = Words("Temperature")
