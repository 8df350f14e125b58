"""The page of an effect: its equation, its look in the residuals, and what it cannot be told from."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from zlmreport.document.subjects.fit import make_parameter_rows
from zlmreport.job.types import list_keys_in
from zlmreport.language import Language, Words
from zlmreport.language.formatting import write_general_number
from zlmreport.measurement.approach import Approach
from zlmreport.measurement.arrays import FloatArray
from zlmreport.measurement.axis import Axis
from zlmreport.measurement.units import SECONDS_PER_MINUTE
from zlmreport.model.effects.design import Design, place_at_positions
from zlmreport.model.effects.effect import Effect, Parameter, Shape, find_unit_of
from zlmreport.model.fitting.curve import lay_effect_positions
from zlmreport.plugin.registry import Registry
from zlmreport.testing.measurements import full_designs
from zlmreport.web.bench import Bench, Loaded
from zlmreport.web.panels import collect_parameter, make_naming, split_symbol

_OVER_TIME = frozenset({Shape.TIME, Shape.RUN})
_POSITION = Words("Position")
_TIME = Words("Time")
_READING = Words("Reading")
_HERE = Words("As this test would see it: an effect of 1 {unit} rms, its mean taken away.")
_CONSTANT = Words("The same at every reading: here 1 {unit}.")
_ELSEWHERE = Words("As a complete test would see it; this one cannot show it: {reason}.")
_DECIMALS = 6
_ROUNDING = 1e-9
#: Of an effect that repeats along the axis, so many are drawn.
_PERIODS = 6.0


def make_effect_page(
    bench: Bench, loaded: Loaded, identifier: str, language: Language
) -> dict[str, Any] | None:
    """Return what there is to say of an effect; None if it is not installed."""
    whole = bench.fit_whole(loaded)
    fit = whole.fit
    known = (*bench.registry.effects, *(term.effect for term in fit.model.terms))
    effect = next((each for each in known if each.identifier == identifier), None)
    if effect is None:
        return None
    names = make_naming(whole, bench.registry.effects, language)
    return {
        "effect": identifier,
        "called": names.name_in(identifier),
        "title": effect.title.in_language(language),
        "equation": split_symbol(effect.equation),
        "look": names.name_in(effect.look.in_language(language)),
        "remedy": names.name_in(effect.remedy.in_language(language)) if effect.remedy else "",
        "parameters": [
            _describe(each, loaded.job.axis, language) for each in (*effect.linear, *effect.searched)
        ],
        "rangesFrom": effect.ranges_from.in_language(language),
        "keys": [
            {"name": name, "description": field.description}
            for name, field in list_keys_in(effect.options).items()
        ],
        "estimates": [
            collect_parameter(each, language)
            for each in make_parameter_rows(fit, language)
            if each.effect == identifier
        ],
        "confusions": [
            {
                "effect": each.effect,
                "called": names.name_in(each.effect),
                "title": _find_title(bench.registry, each.effect, language),
                "told": names.name_in(each.told_apart_by.in_language(language)),
            }
            for each in effect.confusions
        ],
        "containsNames": [names.name_in(each) for each in effect.contains],
        "present": identifier in fit.model.identifiers,
        "sketch": draw_sketch(effect, loaded.study.observed.design, language),
    }


def draw_sketch(effect: Effect, design: Design, language: Language) -> dict[str, Any] | None:
    """Return the effect alone as the residuals of a test show it: over position or time, by direction.

    `effect`: The effect; its searched parameters are in the middle of their values.
    `design`: Of the test at hand; a complete one is taken instead if that cannot show the effect.
    """
    reason = effect.untestable(design)
    words = _HERE.given(unit=design.axis.deviation_unit.symbol)
    if reason is not None:
        complete = [each for each in full_designs().values() if effect.untestable(each) is None]
        if not complete:
            return None
        design, words = complete[0], _ELSEWHERE.given(reason=reason)
    grid = effect.grid(design)
    theta = grid[len(grid) // 2]
    values = _draw_alone(effect, design, theta)
    mean, size = float(values.mean()), float(np.std(values))
    if size <= _ROUNDING * abs(mean):
        mean, size, words = 0.0, mean, _CONSTANT.given(unit=design.axis.deviation_unit.symbol)
    x, title, unit = _choose_along(effect.shape, design)
    span = _choose_shown(effect, theta, design)
    return {
        "x": _round_values(x),
        "y": _round_values((values - mean) / size),
        "direction": np.where(design.direction > 0, 1, -1).tolist(),
        "curves": [
            {
                "direction": int(approach),
                "x": _round_values(along),
                "y": _round_values((_draw_alone(effect, between, theta) - mean) / size),
            }
            for approach, along, between in _lay_between(effect, theta, design, span)
        ],
        "range": None if span == design.span else [design.axis.position_unit.from_si(end) for end in span],
        "title": title.in_language(language),
        "unit": unit,
        "deviation_unit": design.axis.deviation_unit.symbol,
        "words": words.in_language(language),
    }


def _draw_alone(effect: Effect, design: Design, theta: FloatArray) -> FloatArray:
    """Return what an effect makes of readings, all its linear parameters alike."""
    return np.asarray(effect.columns(design, theta) @ np.ones(len(effect.linear)), dtype=np.float64)


def _choose_shown(effect: Effect, theta: FloatArray, design: Design) -> tuple[float, float]:
    """Return the part of the travel that is drawn: a few periods of what repeats often."""
    first, last = design.span
    periods = [
        value for each, value in zip(effect.searched, theta.tolist(), strict=True) if each.name == "period"
    ]
    if effect.shape in _OVER_TIME or not periods:
        return first, last
    return first, min(last, first + _PERIODS * periods[0])


def _lay_between(
    effect: Effect, theta: FloatArray, design: Design, span: tuple[float, float]
) -> Iterator[tuple[Approach, FloatArray, Design]]:
    """Yield positions between the targets, by direction; nothing for an effect that changes with time."""
    if effect.shape in _OVER_TIME:
        return
    for approach in Approach:
        if np.any(design.direction == approach):
            positions = lay_effect_positions(effect, theta, design, approach, span)
            yield (
                approach,
                design.axis.position_unit.from_si(positions),
                place_at_positions(design, positions, approach),
            )


def _round_values(values: FloatArray) -> list[float]:
    return [float(each) for each in np.round(values, _DECIMALS)]


def _choose_along(shape: Shape, design: Design) -> tuple[FloatArray, Words, str]:
    """Return that along which an effect shows itself best."""
    if shape not in _OVER_TIME:
        unit = design.axis.position_unit
        return unit.from_si(design.position), _POSITION, unit.symbol
    if design.time_is_counted:
        return 1.0 + design.time, _READING, ""
    return design.time / SECONDS_PER_MINUTE, _TIME, "min"


def _describe(own: Parameter, axis: Axis, language: Language) -> dict[str, Any]:
    unit = find_unit_of(own.dimension, axis.kind)
    bounds = [
        None if bound is None else write_general_number(unit.from_si(bound), language.decimal_sign, 3)
        for bound in (own.smallest, own.largest)
    ]
    return {
        "name": own.name,
        "symbol": split_symbol(own.notation),
        "description": own.description.in_language(language),
        "low": bounds[0],
        "high": bounds[1],
        "unit": unit.symbol,
    }


def _find_title(registry: Registry, identifier: str, language: Language) -> str:
    titles = {each.identifier: each.title for each in registry.effects}
    return titles[identifier].in_language(language) if identifier in titles else ""
