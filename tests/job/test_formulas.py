"""Effects that a file writes as formulas: parsed, held against their units, never executed."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from pydantic import ValidationError

from zlmreport.job.formula import FormulaError, compute, parse_formula
from zlmreport.job.formula_keys import UNITS_OF_PARAMETERS, FormulaKeys
from zlmreport.job.formula_parts import UNITS, Formula, refuse_unsound
from zlmreport.model.effects.effect import find_unit_of
from zlmreport.plugin import AxisKind
from zlmreport.plugin.effect import Dimension

_UM: dict[str, Any] = {"unit": "um", "range": [-20, 20]}
_FROM_ZERO: dict[str, Any] = {"unit": "mm", "range": [0, 1000]}
_TOO_FINE: dict[str, Any] = {"unit": "mm", "range": [1, 1000], "step": 1e-9}


def _keys(formula: str, **parameters: dict[str, Any]) -> FormulaKeys:
    return FormulaKeys(name="own", formula=formula, parameters=parameters or {"a": _UM})


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("1 + 2*3", 7.0),
        ("-2^2", -4.0),
        ("2^-1", 0.5),
        ("2**3**2", 512.0),
        ("(1 - 2) - 3/4/5", -1.15),
        ("max(0, -1) + min(2, 3)", 2.0),
        ("sin(pi/2) + step(0) + abs(-.5e1)", 7.0),
    ],
)
def test_formula_means_what_arithmetic_says(text: str, value: float) -> None:
    assert float(compute(parse_formula(text), {})) == pytest.approx(value, rel=1e-15)


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("a*(P", "a bracket is not closed"),
        ("a*", "it ends where a number"),
        ("a P", "'P' cannot stand there"),
        ("a*sine(P)", "there is no function 'sine'; did you mean 'sin'"),
        ("max(a)", "max takes 2 arguments, not 1"),
        ("a['x']", "'[' means nothing in a formula"),
        ("a.real", "'.' means nothing in a formula"),
        ("(" * 200 + "a", "nested deeper"),
        ("a" * 501, "at most 500 characters"),
        ("a*²", "'²' cannot stand there"),
        ("a*٣", "'٣' means nothing in a formula"),
    ],
)
def test_what_is_no_formula_is_refused(text: str, sentence: str) -> None:
    with pytest.raises(FormulaError, match=sentence.replace("[", r"\[").replace(".", r"\.")):
        parse_formula(text)


@pytest.mark.parametrize(
    ("formula", "parameters", "sentence"),
    [
        ("a*P", {"a": _UM}, "its value must be a deviation"),
        ("a*sin(P)", {"a": _UM}, "sin takes a number, not travel"),
        ("a + P/L", {"a": _UM, "L": {"unit": "mm", "range": [1, 2]}}, "travel and a number cannot be joined"),
        ("P*P/L", {"L": {"unit": "mm", "range": [1, 2]}}, "each term must have a size"),
        ("a*sin(P/L)", {"a": _UM, "L": {"unit": "mm"}}, "L is no factor of a whole term"),
        ("a", {"a": _UM, "b": _UM}, "the parameter b does not stand in it"),
        ("a*k", {"a": _UM, "k": {"unit": "1", "range": [1, 2]}}, "no readings could tell a, k apart"),
        ("a + 0*b", {"a": _UM, "b": _UM}, "b changes nothing in it"),
        ("a", {"a": {"unit": "furlong"}}, "'furlong' is no unit"),
        ("P", {"P": {"unit": "mm"}}, "cannot be called 'P'"),
        ("a*P^(1/0)", {"a": _UM}, "a power of travel must be written as a number"),
        ("a*P^(log(-1))", {"a": _UM}, "a power of travel must be written as a number"),
        ("a*sin(P/L)", {"a": _UM, "L": _FROM_ZERO}, "no value where L is 0, an end of its range"),
        ("a*exp(-P/L)", {"a": _UM, "L": _FROM_ZERO}, "no value where L is 0, an end of its range"),
        ("a*sin(P/L)", {"a": _UM, "L": _TOO_FINE}, r"steps of 1e-09 are 9.99e\+11 values from 1 to 1000"),
    ],
)
def test_formula_that_cannot_be_meant_is_refused(
    formula: str, parameters: dict[str, Any], sentence: str
) -> None:
    with pytest.raises((ValidationError, FormulaError), match=sentence):
        refuse_unsound(_keys(formula, **parameters))


@pytest.mark.parametrize("formula", ["a*tanh((P - L)/travel_last)", "a*sin(2*pi*(P - L)/travel_last)"])
def test_a_range_may_begin_at_zero_where_the_formula_has_a_value(formula: str) -> None:
    refuse_unsound(_keys(formula, a=_UM, L=_FROM_ZERO))


_PLACE, _MOMENT = ({"unit": unit, "range": [310, 730]} for unit in ("mm", "s"))
_BRIEF, _NARROW = ({"unit": unit, "range": [0.02, 0.05]} for unit in ("s", "mm"))


@pytest.mark.parametrize(
    ("formula", "parameters"),
    [
        ("a*exp(-((P - c)/w)^2)", {"c": _PLACE, "w": _NARROW}),
        ("a*exp(-((t - c)/w)^2)", {"c": _MOMENT, "w": _BRIEF}),
        (
            "a*exp(-((P - c)/w)^2) + b*exp(-((t - d)/u)^2)",
            {"b": _UM, "c": _PLACE, "w": _NARROW, "d": _MOMENT, "u": _BRIEF},
        ),
    ],
)
def test_a_form_that_shows_at_one_place_or_moment_only_is_tried_there(
    formula: str, parameters: dict[str, Any]
) -> None:
    """A bump of 0.05 mm on an axis of a metre lies between all readings that were drawn anywhere."""
    refuse_unsound(_keys(formula, a=_UM, **parameters))


@pytest.mark.parametrize(
    ("formula", "parameters"),
    [
        ("a*step(P - 1777)", {"a": _UM}),
        ("a*step(P + 500)*step(-P)", {"a": _UM}),
        ("a*step(P - L)", {"a": _UM, "L": {"unit": "mm", "range": [100, 500]}}),
        ("a*exp(P/L)", {"a": _UM, "L": {"unit": "mm", "range": [10, 50]}}),
    ],
)
def test_effect_may_show_on_a_part_of_some_axes_only(formula: str, parameters: dict[str, Any]) -> None:
    assert Formula.of(_keys(formula, **parameters), AxisKind.LINEAR).linear == ("a",)


@pytest.mark.parametrize(
    ("formula", "length", "place"),
    [
        ("a*sin(P/L)", {"unit": "mmm", "range": [5, 50]}, ("parameters", "L", "unit")),
        ("a*sin(P/L)", {"unit": "mm", "range": [50, 5]}, ("parameters", "L", "range")),
    ],
)
def test_a_mistake_is_told_at_its_own_key(
    formula: str, length: dict[str, Any], place: tuple[str, ...]
) -> None:
    with pytest.raises(ValidationError) as refused:
        _keys(formula, a=_UM, L=length)
    assert [each["loc"] for each in refused.value.errors()] == [place]


def test_bare_number_is_in_the_unit_of_the_name_beside_it() -> None:
    formula = Formula.of(
        _keys("k*(P - 300)*(axis_temperature - 20)", k={"unit": "um/(m K)"}), AxisKind.LINEAR
    )
    readings = {"P": np.array([0.5]), "axis_temperature": np.array([23.0])}
    assert formula.compute_values(readings, {}) == pytest.approx(0.2 * 3.0)


def test_factors_of_whole_terms_are_solved_and_the_rest_is_searched() -> None:
    keys = _keys(
        "a*sin(2*pi*P/L) - D*(b*P + a*cos(2*pi*P/L))",
        a=_UM,
        b={"unit": "um/m"},
        L={"unit": "mm", "range": [5, 50]},
    )
    formula = Formula.of(keys, AxisKind.LINEAR)
    assert (formula.linear, formula.searched) == (("a", "b"), ("L",))
    place, sign = np.array([0.1, 0.203]), np.array([1.0, -1.0])
    angle = 2 * np.pi * place / 0.01
    expected = np.column_stack([np.sin(angle) - sign * np.cos(angle), -sign * place])
    np.testing.assert_allclose(
        formula.compute_values({"P": place, "D": sign}, {"L": 0.01}), expected, rtol=1e-12
    )


def test_formula_of_a_rotary_axis_is_in_angles() -> None:
    keys = _keys("a*sin(2*pi*P/L)", a={"unit": "arcsec"}, L={"unit": "deg", "range": [5, 90]})
    assert Formula.of(keys, AxisKind.ROTARY).linear == ("a",)
    with pytest.raises(FormulaError, match="does not belong to a linear axis"):
        Formula.of(keys, AxisKind.LINEAR)


@pytest.mark.parametrize(
    ("kind", "size", "length", "middle", "width"),
    [
        (AxisKind.ROTARY, "arcsec", "deg", 129, 18),
        (AxisKind.ROTARY, "arcsec", "deg", 256, 6),
        (AxisKind.LINEAR, "um", "mm", 236, 9),
        (AxisKind.LINEAR, "um", "mm", 2574, 150),
    ],
)
def test_a_stretch_may_end_between_two_targets(
    kind: AxisKind, size: str, length: str, middle: float, width: float
) -> None:
    """Its edges move within an interval of the targets: so a diagnosis offers a stretch without a name."""
    edges = {"c": [middle - width, middle], "e": [middle, middle + width]}
    keys = _keys(
        "a*step(P - c)*step(e - P)",
        a={"unit": size},
        **{name: {"unit": length, "range": ends} for name, ends in edges.items()},
    )
    refuse_unsound(keys)
    Formula.of(keys, kind).refuse_undetermined()


def test_every_unit_is_one_that_results_print() -> None:
    for kind, units in UNITS.items():
        printed = {find_unit_of(each, kind).ascii: find_unit_of(each, kind).per_si for each in Dimension}
        assert {name: unit.per_si for name, unit in units.items()} == {name: printed[name] for name in units}


def test_unit_on_a_linear_axis_has_its_like_on_a_rotary_one() -> None:
    for linear, rotary in UNITS_OF_PARAMETERS.items():
        like = {each for each in Dimension if find_unit_of(each, AxisKind.LINEAR).ascii == linear}
        assert rotary in {find_unit_of(each, AxisKind.ROTARY).ascii for each in like}
        assert (
            UNITS[AxisKind.LINEAR][linear].extent == UNITS[AxisKind.ROTARY][rotary].extent or linear == "deg"
        )
