"""Each check of an effect passes the exemplary one, and finds the sin it is there for."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from itertools import count
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from pydantic import Field

from refusals import failed_checks
from testing.exemplary_effect import ExemplaryEffect, ExemplaryOptions
from testing.sinning import make_sinner, make_tests
from zlmreport.job.formula_keys import FormulaKeys
from zlmreport.job.formula_parts import Formula
from zlmreport.plugin import AxisKind, Options, Words, same_in_all_languages as same
from zlmreport.plugin.effect import Confusion, Design, Shape
from zlmreport.testing import EFFECT_CHECKS, check_effect, effects, full_designs

DESIGNS = full_designs()
(HEIGHT,) = ExemplaryEffect.linear
RECTIFIED = ExemplaryOptions(rectified=True)


class UndescribedOptions(Options):
    rectified: bool = False


class GreedyOptions(ExemplaryOptions):
    height: float = Field(1.0, description="Taken.")


def _columns(change: Callable[..., Any]) -> dict[str, Any]:
    """Return the sin of an effect whose columns are made into something else."""

    def columns(self: Any, design: Design, theta: Any) -> Any:
        return change(ExemplaryEffect.columns(self, design, theta), design)

    return {"columns": columns}


def _raising(_self: object, _design: Design) -> Words | None:
    raise KeyError("oil_temperature")


_ANSWERS = count(1)


TOO_MANY = Formula.of(
    FormulaKeys.model_validate(
        {"name": "own", "formula": "a*k", "parameters": {"a": {"unit": "um"}, "k": {"range": [1, 2]}}}
    ),
    AxisKind.LINEAR,
)
OF_DIRECTION: dict[str, Any] = {
    "untestable": lambda *_: None,
    "grid": lambda *_: np.empty((1, 0)),
    "columns": lambda _, design, __: design.direction[:, np.newaxis] / 2,
}
SINS: list[tuple[str, dict[str, Any], str]] = [
    ("is_described", {"identifier": "Wave!"}, "identifier 'Wave!' must be lower-case"),
    ("is_described", {"title": same("")}, "title says nothing"),
    ("is_described", {"equation": " "}, "equation must be what is printed"),
    ("is_described", {"shape": "position"}, "shape must be a Shape"),
    ("is_described", {"look": "a wave"}, "look must be Words"),
    ("says_what_to_do", {"remedy": None}, "remedy must be Words"),
    (
        "names_what_it_is_taken_for",
        {"confusions": (Confusion("exemplary-wave", same("x")),)},
        "an effect is not taken for itself",
    ),
    (
        "names_what_it_is_taken_for",
        {"confusions": (Confusion("periodic", same("x")), Confusion("periodic", same("y")))},
        "confusions name periodic twice",
    ),
    ("names_what_it_is_taken_for", {"confusions": (Confusion("periodic", same("")),)}, "says nothing"),
    (
        "names_what_it_is_taken_for",
        {"confusions": (Confusion("periodical", same("x")),)},
        "no effect is called 'periodical'; did you mean 'periodic'",
    ),
    (
        "cannot_be_tested_where_it_is_not_seen",
        {"untestable": lambda *_: None},
        "on a test of two targets no readings could tell its parameters apart from a constant",
    ),
    (
        "cannot_be_tested_where_it_is_not_seen",
        {"searched": (), **OF_DIRECTION},
        "on a test in one direction no readings could tell its parameters apart from a constant",
    ),
    ("shape_is_what_it_follows", {"shape": Shape.TIME}, "shape is TIME, and its columns follow position"),
    ("shape_is_what_it_follows", {"shape": Shape.DIRECTION}, "shape is DIRECTION"),
    (
        "shape_is_what_it_follows",
        _columns(lambda columns, design: columns * design.time[:, np.newaxis] * 1e-4),
        "shape is POSITION, and its columns follow position, time, too",
    ),
    (
        "grid_stays_in_range",
        {"grid": lambda *_: np.array([[1.5], [20.0]])},
        "the grid of 'wavelength' leaves its range of 0 to 10 (SI) on every test: it begins at [1.5]",
    ),
    ("parameters_are_described", {"linear": ()}, "linear is empty"),
    ("parameters_are_described", {"searched": (HEIGHT,)}, "names of parameters must be unique"),
    ("parameters_are_described", {"linear": (replace(HEIGHT, name="höhe"),)}, "must be an ASCII name"),
    ("parameters_are_described", {"linear": (replace(HEIGHT, notation=""),)}, "notation must be what"),
    ("parameters_are_described", {"linear": (replace(HEIGHT, dimension="um"),)}, "must be a Dimension"),
    ("parameters_are_described", {"linear": (replace(HEIGHT, description=same("")),)}, "says nothing"),
    ("parameters_are_described", {"linear": (replace(HEIGHT, smallest=1.0),)}, "must be less than largest"),
    ("keys_are_described", {"options": UndescribedOptions}, "job key 'rectified' needs a description"),
    ("keys_are_described", {"options": GreedyOptions}, "settings must be the options of this form"),
    (
        "keys_are_described",
        {"options": GreedyOptions, "__init__": lambda self: setattr(self, "settings", GreedyOptions())},
        "height is a key and a parameter",
    ),
    (
        "settings_make_the_form",
        {"with_settings": lambda self, _: self, "forms": lambda self: (type(self)(RECTIFIED),)},
        "form ExemplaryOptions(rectified=True): with_settings makes ExemplaryOptions(rectified=False)",
    ),
    ("says_what_it_lacks", {"untestable": _raising}, "raised KeyError('oil_temperature')"),
    ("says_what_it_lacks", {"untestable": lambda *_: "no"}, "must be Words"),
    ("says_what_it_lacks", {"untestable": lambda *_: same("no")}, "can be tested on none of"),
    ("grid_is_one", {"grid": lambda *_: np.array([1.0, 2.0])}, "of the shape (2,); (2, 1) is expected"),
    ("grid_is_one", {"grid": lambda *_: np.empty((0, 1))}, "an empty grid"),
    ("grid_is_one", {"grid": lambda *_: np.array([[np.inf]])}, "a grid that is infinite"),
    (
        "columns_are_readings_by_parameters",
        _columns(lambda columns, _: columns[:, 0]),
        "of the shape (210,); (210, 1) is expected",
    ),
    ("columns_are_readings_by_parameters", _columns(lambda columns, _: columns > 0), "no number"),
    (
        "columns_are_readings_by_parameters",
        _columns(lambda columns, _: columns + np.nan),
        "columns that is NaN",
    ),
    (
        "columns_are_readings_by_parameters",
        _columns(lambda columns, _: columns * next(_ANSWERS)),
        "the second answer differs",
    ),
    (
        "rows_stand_alone",
        _columns(lambda columns, design: columns + 1e3 * design.position.min()),
        "(those above the lowest target stay)",
    ),
    (
        "rows_stand_alone",
        _columns(lambda columns, _: columns - columns.mean()),
        "change when other readings are left out",
    ),
    ("plausible_sizes_are_metres", _columns(lambda columns, _: 1e6 * columns), "columns and ranges are SI"),
    ("is_seen_somewhere", _columns(lambda columns, _: 0.0 * columns), "its columns are zero, or alike"),
    (
        "every_parameter_matters",
        {"columns": lambda _, design, __: np.sin(design.position)[:, np.newaxis]},
        "parameter 'wavelength' changes no column on any test",
    ),
    ("formula_determines_its_parameters", {"formula": TOO_MANY}, "no readings could tell a, k apart"),
    (
        "expected_values_are_of_parameters",
        {"expected": lambda *_: {"depth": 1.0}},
        "'depth', which is none of its parameters",
    ),
    ("expected_values_are_of_parameters", {"expected": lambda *_: {"height": np.nan}}, "height that is NaN"),
]


test_exemplary_passes, test_a_check_finds_its_sin, test_every_check_has_a_sin = make_tests(
    EFFECT_CHECKS,
    ExemplaryEffect,
    [(getattr(effects, name), sin, sentence) for name, sin, sentence in SINS],
    lambda *_: (DESIGNS,),
)


def test_what_is_no_effect_is_told_what_it_lacks() -> None:
    with pytest.raises(AssertionError, match="has no title, equation, linear, searched"):
        check_effect(SimpleNamespace(identifier="half"))  # type: ignore[arg-type]  # the sin


def test_what_installation_would_refuse_the_kit_refuses() -> None:
    has_what_the_kit_uses = {name: getattr(ExemplaryEffect(), name) for name in dir(ExemplaryEffect())}
    del has_what_the_kit_uses["forbids"]
    with pytest.raises(AssertionError, match=r"has no forbids \(see zlmreport.plugin.effect.Effect\)"):
        check_effect(SimpleNamespace(**has_what_the_kit_uses))  # type: ignore[arg-type]  # the sin


def test_all_sins_are_told_at_once() -> None:
    sinner = make_sinner(ExemplaryEffect, {"identifier": "Wave!", "confusions": (None,)})
    checks = failed_checks(check_effect, sinner)
    assert checks == ["is_described", "names_what_it_is_taken_for"]


def test_effect_with_a_log_of_its_own_brings_a_test_that_has_it() -> None:
    class Hydraulic(ExemplaryEffect):
        def untestable(self, design: Design) -> Words | None:
            return None if "oil_pressure" in design.conditions else same("no oil_pressure")

    with pytest.raises(AssertionError, match="can be tested on none of"):
        check_effect(Hydraulic())
    design = DESIGNS["a complete linear test"]
    check_effect(Hydraulic(), {"a test with oil": replace(design, conditions={"oil_pressure": design.time})})


@pytest.mark.filterwarnings("error")
def test_columns_that_are_infinite_are_told_as_such() -> None:
    def columns(_self: object, design: Design, *_: object) -> object:
        return np.full((len(design.position), 1), np.inf)

    sinner = make_sinner(ExemplaryEffect, {"columns": columns})
    assert "is_seen_somewhere" not in (told := failed_checks(check_effect, sinner))
    assert {"columns_are_readings_by_parameters", "plausible_sizes_are_metres"} <= {*told}
