"""Checks what the methods of a standard answer."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from zlmreport.document.figures.figure import Figure
from zlmreport.evaluation.evaluation import Arithmetic, Finding
from zlmreport.evaluation.uncertainty.budget import Contribution
from zlmreport.language import Words
from zlmreport.measurement.measurement_set import MeasurementSet
from zlmreport.plugin.boundary import Guarded, Unacceptable
from zlmreport.plugin.boundary.answers.required import (
    accept_all_of,
    name_answer,
    require_all_of,
    require_kind,
    require_real,
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
        require_kind(Words, each.requirement)
        require_kind(Words, each.found)
        if each.met is not None and not isinstance(each.met, bool | np.bool_):
            raise Unacceptable(f"returns a finding whose met is {each.met!r}, not True, False or None")
    return findings


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
    "figures": accept_all_of(Figure),
    "of_error": of_error,
    "contributions": of_lines,
}
