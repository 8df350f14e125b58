"""A size that no machine has is asked for, one that physics forbids is told, and some values have a name."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from model.axis_tests import AXIS, EFFECTS, linear_test
from zlmreport.model.effects.sizes import ask_of, compute_times_usual, find_usual_range, name_of
from zlmreport.plugin import AxisKind, Language, Words
from zlmreport.plugin.effect import Dimension, Effect, Parameter

_DESIGN = linear_test(11, 3)


def _parameter(identifier: str, name: str) -> Parameter:
    effect: Effect = EFFECTS[identifier]
    return next(
        each for form in effect.forms() for each in (*form.linear, *form.searched) if each.name == name
    )


def _said(words: Words | None, language: Language = Language.ENGLISH) -> str | None:
    return words.in_language(language) if words else None


@pytest.mark.parametrize(
    ("identifier", "name", "value", "sentence"),
    [
        (
            "backlash",
            "lost_motion",
            -800e-6,
            "−800 µm: 20 times what is usual for a screw; a belt, a loose coupling, or millimetres?",
        ),
        (
            "air-index",
            "factor",
            -0.93,
            "−0.93: was the air corrected twice, by the instrument and once more?",
        ),
        ("dead-path", "dead_path", 3.1, "dead path 3100 mm: measured so?"),
        (
            "scale-expansion",
            "expansion",
            -4e-6,
            "−4.0 µm/(m·K): is the expansion of the scale compensated twice, or too much?",
        ),
        (
            "screw-expansion",
            "expansion",
            2e-6,
            "2.0 µm/(m·K): less than any steel; does the control compensate the screw already?",
        ),
        (
            "time-periodic",
            "period",
            60.0,
            "period in time 60 s, where 180 s or more is usual: measured so, and in the right unit?",
        ),
        ("screw-expansion", "expansion", 5e-6, None),
        (
            "scale-joint",
            "step",
            50e-6,
            "height of the step 50 µm: 10 times what is usual; measured so, and in the right unit?",
        ),
        ("backlash", "lost_motion", -8e-6, None),
        ("offset", "offset", 1.0, None),
    ],
)
def test_what_is_far_beyond_the_usual_is_asked(
    identifier: str, name: str, value: float, sentence: str | None
) -> None:
    assert _said(ask_of(_parameter(identifier, name), value, AXIS)) == sentence


def test_it_is_asked_in_german_too() -> None:
    said = _said(ask_of(_parameter("backlash", "lost_motion"), 800e-6, AXIS), Language.GERMAN)
    assert said is not None
    assert said.startswith("800 µm: das 20-fache des bei einer Spindel Üblichen; ein Riemen,")
    said = _said(ask_of(_parameter("thermal-growth", "time_constant"), 113.0, AXIS), Language.GERMAN)
    assert (
        said
        == "Zeitkonstante 113 s, wo 300 s oder mehr üblich ist: so gemessen, und in der richtigen Einheit?"
    )


@pytest.mark.parametrize(("value", "times"), [(100e-6, "2,5-fache"), (6000e-6, "150-fache")])
def test_how_far_it_is_beyond_the_usual_is_written_as_other_numbers(value: float, times: str) -> None:
    said = _said(ask_of(_parameter("backlash", "lost_motion"), value, AXIS), Language.GERMAN)
    assert said is not None
    assert times in said


def test_usual_is_the_range_where_nothing_else_is_said() -> None:
    size = Parameter("a", "a", Dimension.DEVIATION, Words(en="a", de="a"), -5e-6, 10e-6)
    assert find_usual_range(size) == (-5e-6, 10e-6)
    assert [compute_times_usual(size, each) for each in (20e-6, -10e-6, 0.0)] == [2.0, 2.0, 1.0]
    assert compute_times_usual(replace(size, smallest=0.0), -1e-6) == np.inf
    assert find_usual_range(replace(size, smallest=None, largest=None)) == (-np.inf, np.inf)


def test_usual_is_another_on_a_rotary_axis() -> None:
    lost_motion = _parameter("backlash", "lost_motion")
    assert find_usual_range(lost_motion, AxisKind.LINEAR) == pytest.approx((-40e-6, 40e-6))
    assert find_usual_range(lost_motion, AxisKind.ROTARY) == pytest.approx(
        tuple(np.radians([-20, 20]) / 3600)
    )


@pytest.mark.parametrize(
    ("identifier", "name", "value", "said"),
    [
        ("air-index", "factor", -0.93, "corrected twice"),
        ("air-index", "factor", 1.02, "not corrected"),
        ("air-index", "factor", 2.0, "corrected with the wrong sign"),
        ("air-index", "factor", 0.3, None),
        ("compensation-sign", "factor", 2.0, "wrong sign"),
        ("compensation-sign", "factor", 0.5, "half of it acts"),
        ("compensation-sign", "factor", -1.0, "applied twice"),
        ("material-expansion", "expansion", -11.5e-6, "that of steel, corrected twice"),
        ("backlash", "lost_motion", -8e-6, None),
    ],
)
def test_corrections_that_were_made_wrongly_have_names(
    identifier: str, name: str, value: float, said: str | None
) -> None:
    assert _said(name_of(_parameter(identifier, name), value)) == said


def _rising(kelvin: float) -> Effect:
    return replace(
        _DESIGN, conditions={"axis_temperature": 293.15 + kelvin * _DESIGN.time / _DESIGN.duration}
    )


@pytest.mark.parametrize(
    ("effect", "values", "kelvin", "is_forbidden"),
    [
        ("thermal-growth", {"growth": 330e-6}, 3.0, True),
        ("thermal-growth", {"growth": -330e-6}, 3.0, True),
        ("thermal-growth", {"growth": 100e-6}, 3.0, False),
        ("thermal-growth", {"growth": 330e-6}, 12.0, False),
        ("growth-from-bearing", {"growth": 330e-6}, 3.0, True),
        ("cosine-error", {"shortening": -1e-6}, 3.0, True),
        ("cosine-error", {"shortening": 300e-6}, 3.0, False),
        ("backlash", {"lost_motion": 0.8e-3}, 3.0, False),
    ],
)
def test_only_what_physics_and_the_log_exclude_is_forbidden(
    effect: str, values: dict[str, float], kelvin: float, *, is_forbidden: bool
) -> None:
    assert (EFFECTS[effect].forbids(_rising(kelvin), values) is not None) is is_forbidden


def test_growth_of_any_size_is_allowed_where_no_temperature_was_logged() -> None:
    bare = replace(_DESIGN, conditions={})
    assert EFFECTS["thermal-growth"].forbids(bare, {"growth": 330e-6}) is None


def test_why_it_is_forbidden_is_said() -> None:
    said = _said(EFFECTS["thermal-growth"].forbids(_rising(3.0), {"growth": 330e-6}))
    assert said is not None
    assert said.startswith("nothing of an axis grows more than 24 µm/(m·K)")
