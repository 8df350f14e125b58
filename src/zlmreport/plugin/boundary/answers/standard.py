"""Checks what the methods of a standard answer."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import asdict
from typing import TYPE_CHECKING, Any

import numpy as np

from zlmreport.document.figures.figure import Arrow, Bracket, Figure, Panel
from zlmreport.evaluation.evaluation import Arithmetic, Finding
from zlmreport.evaluation.uncertainty.budget import Contribution
from zlmreport.measurement.measurement_set import MeasurementSet
from zlmreport.measurement.units import find_printed_symbol
from zlmreport.plugin.boundary import Guarded, Unacceptable
from zlmreport.plugin.boundary.answers.required import (
    name_answer,
    require_all_of,
    require_finite,
    require_kind,
    require_numbers,
    require_real,
    require_sayable,
)

if TYPE_CHECKING:
    from zlmreport.evaluation.statistics import PositionStatistics


def arithmetic(
    standard: Guarded, answer: Any, statistics: PositionStatistics, *_: Any, **__: Any
) -> Arithmetic:
    """Refuse values that the standard does not declare, and such as are no lengths or angles."""
    of = require_kind(Arithmetic, answer)
    *batch, _, positions = statistics.mean.shape
    for owner, given, declared, shape in (
        ("quantities", of.parameters, standard.quantities, tuple(batch)),
        ("position_quantities", of.positions, standard.position_quantities, (*batch, positions)),
    ):
        require_kind(Mapping, given)
        symbols = [each.symbol for each in declared]
        if list(given) != symbols and (len(given) != len(symbols) or given.keys() != set(symbols)):
            wrong = [f"no {name}" for name in symbols if name not in given]
            wrong += [f"{name}, which is not declared" for name in given if name not in symbols]
            wrong += [f"{name} twice" for name in dict.fromkeys(symbols) if symbols.count(name) > 1]
            raise Unacceptable(f"gives {', '.join(map(str, wrong))} (see {owner})")
        for symbol, value in given.items():
            require_real(value, shape, symbol)
    return of  # type: ignore[no-any-return]


def requirements(_standard: Guarded, answer: Any, *_: Any, **__: Any) -> tuple[Any, ...]:
    """Take every finding; refuse one that is not said in words."""
    findings = require_all_of(Finding, answer)
    for each in findings:
        require_sayable(each.requirement, "a requirement")
        require_sayable(each.found, "what was found")
        if each.met is not None and not isinstance(each.met, bool | np.bool_):
            raise Unacceptable(f"returns a finding whose met is {each.met!r}, not True, False or None")
    return findings


def figures(_standard: Guarded, answer: Any, *_: Any, **__: Any) -> tuple[Figure, ...]:
    """Take every graph; refuse one that cannot be drawn, or whose words cannot be said."""
    found = require_all_of(Figure, answer)
    for each in found:
        for name in ("title", "alternative", "x_title", "y_title"):
            require_sayable(getattr(each, name), f"{name} of figure {each.key!r}")
        for name in ("x_unit", "y_unit"):
            _require_printed(getattr(each, name), f"{name} of figure {each.key!r}")
        for panel in require_all_of(Panel, each.panels):
            _require_printed(panel.y_unit, f"y_unit of a panel of figure {each.key!r}")
            _require_drawable(panel, f"of figure {each.key!r}")
    return found


def _require_printed(unit: Any, of: str) -> None:
    """Refuse a unit that is no text, or as a results file has it and no page."""
    if not isinstance(unit, str):
        raise Unacceptable(
            f"returns {name_answer(unit)} as {of}; what is printed is expected, such as "
            "axis.deviation_unit.symbol"
        )
    if (printed := find_printed_symbol(unit)) != unit:
        raise Unacceptable(f"returns {unit!r} as {of}; what is printed is expected, {printed!r}")


def _require_drawable(panel: Panel, of: str) -> None:
    """Refuse lines whose places and values are not as many, and marks with an end that is no number."""
    for curve in panel.curves:
        _require_as_many(curve.x, {"y": curve.y}, f"curve {curve.notation!r} {of}")
    for band in panel.bands:
        _require_as_many(band.x, {"lower": band.lower, "upper": band.upper}, f"band {band.notation!r} {of}")
    for readings in panel.readings:
        _require_as_many(readings.x, {"y": readings.y}, f"readings {of}")
    marks: tuple[Arrow | Bracket, ...] = (*panel.arrows, *panel.brackets)
    for mark in marks:
        for name, value in asdict(mark).items():
            if name != "notation":
                require_finite(value, (), f"{name} of {type(mark).__name__} {mark.notation!r} {of}")


def _require_as_many(places: Any, values: Mapping[str, Any], of: str) -> None:
    number = len(require_numbers(places, f"x of {of}"))
    for name, each in values.items():
        require_real(each, (number,), f"{name} of {of}")


def of_error(standard: Guarded, answer: Any, *_: Any) -> Any:
    """Hand on the standard as it evaluates an error, behind the boundary too."""
    if getattr(answer, "identifier", None) != standard.identifier:
        raise Unacceptable(f"returns {name_answer(answer)}; itself for that error is expected")
    return standard.guard_another(answer)


def of_lines(_standard: Guarded, answer: Any, measurements: MeasurementSet, *_: Any) -> Mapping[str, Any]:
    """Refuse contributions of lines that there are not."""
    found = {name: require_all_of(Contribution, each) for name, each in require_kind(Mapping, answer).items()}
    if unknown := found.keys() - measurements.tests.keys():
        raise Unacceptable(
            f"gives contributions of {', '.join(map(repr, sorted(unknown)))}, which is no test"
        )
    return found


#: What is made of an answer, by method.
ACCEPTED: Mapping[str, Callable[..., Any]] = {
    "arithmetic": arithmetic,
    "requirements": requirements,
    "figures": figures,
    "of_error": of_error,
    "contributions": of_lines,
}
