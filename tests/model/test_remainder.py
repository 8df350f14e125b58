"""What is left beside a model is proposed as the plainest formula that follows it, and fits when tried."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from model.axis_tests import SIGMA, known, linear_test, model_of, noise, pendulum_test
from zlmreport.job.formula_keys import FormulaKeys
from zlmreport.model.diagnosis.contest import Contest
from zlmreport.model.diagnosis.forms import list_unnamed_forms
from zlmreport.model.diagnosis.random_curves import Course
from zlmreport.model.diagnosis.remainder import (
    Remainder,
    find_irregular_remainder,
    find_remainder_of,
    make_remainder_of_run,
)
from zlmreport.model.diagnosis.sets import SetSearch
from zlmreport.model.diagnosis.single_run import find_single_run
from zlmreport.model.effects.axis_model import AxisModel
from zlmreport.model.effects.formula import FormulaEffect
from zlmreport.model.fitting.fit import Assumptions, fit
from zlmreport.model.fitting.observations import select_readings
from zlmreport.plugin import Axis, AxisKind, FloatArray, Language
from zlmreport.plugin.effect import Design

BASE = model_of("offset", "scale-error", "backlash")
DESIGN = linear_test()
UM = 1e-6


def _find_left(added: FloatArray | float, design: Design = DESIGN, seed: int = 2) -> Remainder | None:
    return _remainder(1e-6 * (2.0 + 10.0 * design.position - 1.5 * design.direction) + added, design, seed)


def _left(added: FloatArray | float, design: Design = DESIGN) -> Remainder:
    found = _find_left(added, design)
    assert found is not None
    return found


def _remainder(
    true: FloatArray, design: Design, seed: int = 2, model: AxisModel = BASE, sigma: float = SIGMA
) -> Remainder | None:
    """Return what is left where nothing is installed."""
    deviation = true + noise(design, seed, sigma)
    fitted = fit(model, design, deviation, Assumptions(parts=()))
    search = SetSearch(
        Contest.of(design, fitted.compute_base(), (), deviation, forms=list_unnamed_forms(design))
    )
    return find_remainder_of(search, search.find_best(), fitted)


def _formula(left: Remainder) -> FormulaKeys:
    assert left.formula is not None
    return left.formula


def _bump(at: float, width: float) -> FloatArray:
    return np.asarray(np.exp(-4 * np.log(2) * ((DESIGN.position - at) / width) ** 2))


def _saw(period: float) -> FloatArray:
    return np.asarray(DESIGN.position / period % 1 - 0.5)


@pytest.mark.parametrize(
    ("at", "width", "size"), [(0.42, 0.1, 5.0), (0.42, 0.2, -4.0), (0.7, 0.1, -4.0), (0.7, 0.2, 5.0)]
)
def test_a_bump_is_found_at_its_place_with_its_width(at: float, width: float, size: float) -> None:
    left = _left(size * UM * _bump(at, width))
    assert _formula(left).name.startswith("bump-")
    assert left.low == pytest.approx(at - width / 2, abs=0.25 * width)
    assert left.high == pytest.approx(at + width / 2, abs=0.25 * width)
    assert left.size == pytest.approx(size * UM, rel=0.3)
    assert left.share > 0.4
    assert re.fullmatch(r"around \d+ mm", left.where.in_language(Language.ENGLISH))


CASES: dict[str, Callable[[], FloatArray]] = {
    "bump-up": lambda: 8 * UM * _bump(0.42, 0.15) * (DESIGN.direction > 0),
    "saw": lambda: 5 * UM * _saw(0.24),
    "wave-d": lambda: 2 * UM * DESIGN.direction * np.sin(2 * np.pi * DESIGN.position / 0.333),
    "wave": lambda: 2 * UM * np.sin(2 * np.pi * DESIGN.position / 0.25 + 1),
    "step-d": lambda: 3 * UM * DESIGN.direction * (DESIGN.position > 0.5),
    "kink-up": lambda: 30 * UM * np.maximum(0, DESIGN.position - 0.6) * (DESIGN.direction > 0),
    "fading": lambda: 8 * UM * np.exp(-DESIGN.position / 0.15),
    "bow-d": lambda: 3 * UM * DESIGN.direction * (1 - (2 * DESIGN.position - 1) ** 2),
    "bump-time": lambda: 4 * UM * np.exp(-4 * np.log(2) * ((DESIGN.time - 900) / 300) ** 2),
    "wave-time": lambda: 2 * UM * np.sin(2 * np.pi * DESIGN.time / 240),
}


@cache
def _left_of(name: str) -> Remainder:
    """Return what is left in a case: searched once for all that is asked of it."""
    return _left(CASES[name]())


@pytest.mark.parametrize("name", CASES)
def test_a_form_is_named_with_its_carrier(name: str) -> None:
    left = _left_of(name)
    assert re.sub(r"(-[0-9]+-(mm|s))?$", "", _formula(left).name) == name


@pytest.mark.parametrize("name", CASES)
def test_the_formula_takes_it_away_when_it_is_tried(name: str) -> None:
    left = _left_of(name)
    tried = FormulaEffect(_formula(left), AxisKind.LINEAR)
    deviation = known(DESIGN) + noise(DESIGN) + CASES[name]()
    fitted = fit(model_of("polynomial", "backlash", tried), DESIGN, deviation, Assumptions(parts=()))
    assert fitted.rms < 1.15 * SIGMA


@pytest.mark.parametrize(
    ("name", "period"), [("saw", 0.24), ("wave-d", 0.333), ("wave", 0.25), ("wave-time", 240.0)]
)
def test_a_period_is_in_the_words_in_both_languages(name: str, period: float) -> None:
    left = _left_of(name)
    assert re.search(r"with a period of [0-9.]+ (mm|s)", left.shape.in_language(Language.ENGLISH))
    assert re.search(r"mit [0-9,]+ (mm|s) Periode", left.shape.in_language(Language.GERMAN))
    low, high = _formula(left).parameters["L"].range or (0.0, 0.0)
    assert low / (1e3 if period < 1 else 1) < period < high / (1e3 if period < 1 else 1)
    assert (low * high) ** 0.5 == pytest.approx(period * (1e3 if period < 1 else 1), rel=0.06)


@pytest.mark.long
def test_noise_alone_is_rarely_given_a_form() -> None:
    assert sum(_find_left(0.0, seed=100 + seed) is not None for seed in range(20)) <= 1


def test_a_bump_of_the_pendulum_method_is_one_of_position() -> None:
    design = pendulum_test()
    bump = 6 * UM * np.exp(-4 * np.log(2) * ((design.position - 0.42) / 0.15) ** 2)
    left = _left(bump, design)
    assert _formula(left).name.startswith("bump-4")


def test_a_rotary_axis_has_its_units() -> None:
    axis = Axis("C", kind=AxisKind.ROTARY, travel=(0.0, 2 * np.pi))
    turned = replace(DESIGN, axis=axis, position=2 * np.pi * DESIGN.position, span=(0.0, 2 * np.pi))
    wave = 2e-6 * np.sin(2 * turned.position)
    left = _remainder(wave, turned, 2, model_of("offset"), 0.3e-6)
    assert left is not None
    assert re.fullmatch(r"wave-1(79|80|81)-deg", _formula(left).name)
    assert _formula(left).parameters["a"].unit == "arcsec"
    assert _formula(left).parameters["L"].unit == "deg"


def test_one_direction_has_no_form_of_the_reversal() -> None:
    up = select_readings(DESIGN, np.flatnonzero(DESIGN.direction > 0))
    bump = 6 * UM * np.exp(-4 * np.log(2) * ((up.position - 0.42) / 0.15) ** 2)
    left = _remainder(bump, up, model=model_of("offset"))
    assert left is not None
    assert _formula(left).name.startswith("bump-4")


def test_the_formula_is_accepted_by_a_job_at_any_place_and_time() -> None:
    late = replace(DESIGN, time=DESIGN.time + 80_000.0)
    left = _left(4 * UM * np.exp(-4 * np.log(2) * ((late.time - 80_900) / 300) ** 2), late)
    assert FormulaKeys.model_validate(_formula(left).model_dump()) == left.formula


def test_a_lever_that_comes_and_goes_is_placed_over_the_time_in_which_it_does() -> None:
    moment = (DESIGN.time - DESIGN.time.min()) / DESIGN.duration
    lever = 2.0 * (DESIGN.position - DESIGN.middle) / DESIGN.length
    first, second = (
        np.exp(-4 * np.log(2) * ((moment - at) / width) ** 2) for at, width in ((0.25, 0.17), (0.7, 0.33))
    )
    left = _left(6 * UM * lever * (first - 3.0 * second))
    # At the middle of the travel it is nothing, and there the stretch does not end.
    assert left.low == pytest.approx(0.53 * DESIGN.duration, abs=0.06 * DESIGN.duration)
    assert left.high == pytest.approx(0.87 * DESIGN.duration, abs=0.06 * DESIGN.duration)


def test_what_moves_with_time_lies_at_no_target() -> None:
    """It passed for noise, and was told as "most at 622.8 mm"."""
    design = linear_test(21, 4)
    drift = -4e-6 * (1.0 - np.exp(-design.time / 1500.0))
    fitted = fit(BASE, design, drift + noise(design, sigma=1e-6), Assumptions(parts=()))
    left = find_irregular_remainder(fitted, 1e-6, fitted)
    assert left.course is Course.TIME
    assert left.shape.in_language(Language.ENGLISH) == "slow irregular drift"
    assert re.search(r" (s|min)\b", left.where.in_language(Language.ENGLISH))


def test_what_lies_at_one_target_is_told_there() -> None:
    at_one = 6 * SIGMA * (DESIGN.target == 7)
    fitted = fit(BASE, DESIGN, at_one + noise(DESIGN), Assumptions(parts=()))
    left = find_irregular_remainder(fitted, SIGMA, fitted)
    place = float(DESIGN.target_positions[7]) * 1e3
    assert left.where.in_language(Language.ENGLISH) == f"most at {place:.1f} mm"


def test_a_place_in_time_is_in_readings_where_there_are_no_times() -> None:
    counted = replace(DESIGN, time=np.arange(float(len(DESIGN.time))), time_is_counted=True)
    for design, unit in ((DESIGN, "s"), (counted, "readings")):
        fitted = fit(model_of("offset"), design, 20 * UM * (design.cycle == 3) + noise(design))
        run = find_single_run(design, fitted.residual, SIGMA)
        assert run is not None
        assert make_remainder_of_run(fitted, run).unit.ascii == unit
