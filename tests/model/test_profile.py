"""The interval of a parameter ends where no fit with it held there describes the readings well enough."""

from __future__ import annotations

import numpy as np
import pytest

from model.axis_tests import USUAL, formula, linear_test, model_of, noise
from zlmreport.model.effects.axis_model import AxisModel, Term
from zlmreport.model.effects.formula import FormulaEffect
from zlmreport.model.fitting import profile
from zlmreport.model.fitting.distributions import t_quantile
from zlmreport.model.fitting.estimate import COVERAGE, InstrumentError
from zlmreport.model.fitting.fit import Assumptions, Fit, fit
from zlmreport.model.fitting.profile import find_intervals
from zlmreport.plugin import FloatArray

_DESIGN = linear_test(15, 3)
#: Readings that scatter alike and independently: what a plain sum of squares describes.
_PLAIN = Assumptions(parts=(), weights=np.ones(len(_DESIGN.position)))
_UM = {"unit": "um", "range": [-50, 50]}


def _fading(longest: float) -> FormulaEffect:
    return formula("a*exp(-P/L)", a=_UM, L={"unit": "mm", "range": [20, longest]})


def _fitted(model: AxisModel, deviation: FloatArray) -> Fit:
    return fit(model, _DESIGN, deviation, _PLAIN)


@pytest.mark.parametrize("instrument", [InstrumentError(), InstrumentError(common=1e-6, proportional=3e-6)])
def test_interval_of_a_linear_model_is_value_plus_and_minus_u(instrument: InstrumentError) -> None:
    fitted = fit(USUAL, _DESIGN, noise(_DESIGN, sigma=1e-6), Assumptions(instrument))
    found = find_intervals(fitted)
    assert [each.parameter for each in found] == [each.parameter for each in fitted.estimates]
    for each, estimate in zip(found, fitted.estimates, strict=True):
        half = estimate.expanded_uncertainty
        assert (each.low, each.high) == pytest.approx(
            (estimate.value - half, estimate.value + half), rel=1e-6
        )


@pytest.mark.parametrize("parameter", ["a", "L"])
def test_interval_of_a_fading_is_that_of_a_grid_of_sums_of_squares(parameter: str) -> None:
    """Few and noisy readings bend it: the sides differ."""
    position = _DESIGN.position
    deviation = 4e-6 * np.exp(-position / 0.15) + noise(_DESIGN, sigma=1.5e-6)
    fitted = _fitted(model_of(_fading(3000)), deviation)
    sizes, lengths = np.linspace(0.5e-6, 9e-6, 2001), np.geomspace(0.02, 1.5, 4001)
    waves = np.exp(-position[:, np.newaxis] / lengths)
    squares = (
        deviation @ deviation
        - 2 * sizes[:, np.newaxis] * (deviation @ waves)
        + sizes[:, np.newaxis] ** 2 * np.sum(waves**2, axis=0)
    )
    degrees = len(position) - 2
    limit = squares.min() * (1 + t_quantile(COVERAGE, degrees) ** 2 / degrees)
    inside = (squares <= limit).any(axis=1 if parameter == "a" else 0)
    values = (sizes if parameter == "a" else lengths)[inside]
    (found,) = [each for each in find_intervals(fitted) if each.parameter.name == parameter]
    (estimate,) = [each for each in fitted.estimates if each.parameter.name == parameter]
    assert (found.low, found.high) == pytest.approx((values[0], values[-1]), rel=3e-3)
    sides = (estimate.value - found.low) / (found.high - estimate.value)
    assert not 0.95 < sides < 1.05


def test_interval_is_open_where_the_search_ends_before_the_readings_exclude_anything() -> None:
    deviation = 4e-6 * np.exp(-_DESIGN.position / 0.15) + noise(_DESIGN, sigma=1.5e-6)
    _, length = find_intervals(_fitted(model_of(_fading(200)), deviation))
    assert (length.low_is_open, length.high_is_open, length.high) == (False, True, pytest.approx(0.2))


def test_interval_of_a_parameter_held_at_its_bound_begins_there() -> None:
    """A slope of 4 µm/m that may be 3 at most: the rise from there on is that of a parabola about 4."""
    effect = formula("k*P", k={"unit": "um/m"})
    deviation = 4e-6 * _DESIGN.position + noise(_DESIGN, sigma=1e-6)
    free = _fitted(AxisModel((Term(effect),)), deviation)
    held = _fitted(AxisModel((Term(effect, bounds={"k": (-np.inf, 3e-6)}),)), deviation)
    (found,) = find_intervals(held)
    best, squares = free.estimates[0].value, float(np.sum(_DESIGN.position**2))
    rise = 4.0 * held.noise.sigma**2 / squares
    expected = best - np.sqrt((best - 3e-6) ** 2 + rise)
    assert (found.high, found.high_is_open) == (3e-6, True)
    assert found.low == pytest.approx(expected, rel=1e-4)


def test_an_end_takes_twelve_fits_at_most(monkeypatch: pytest.MonkeyPatch) -> None:
    fits: list[object] = []
    descend = profile.descend
    monkeypatch.setattr(profile, "descend", lambda *given: fits.append(given) or descend(*given))
    wave = formula("a*sin(2*pi*P/L)", a=_UM, L={"unit": "mm", "range": [50, 900]})
    deviation = 2e-6 * np.sin(2 * np.pi * _DESIGN.position / 0.3) + noise(_DESIGN, sigma=2e-6)
    found = find_intervals(_fitted(model_of("offset", wave), deviation))
    assert 0 < len(fits) <= 24 * len(found)


def test_scanned_place_has_the_ends_of_the_grid_that_are_possible() -> None:
    deviation = 5e-6 * (_DESIGN.position > 0.5) + noise(_DESIGN, sigma=1e-6)
    fitted = _fitted(model_of("offset", "scale-joint"), deviation)
    (joint,) = [each for each in find_intervals(fitted) if each.parameter.name == "joint"]
    (estimate,) = [each for each in fitted.estimates if each.parameter.name == "joint"]
    farther = max(estimate.value - joint.low, joint.high - estimate.value)
    assert farther == pytest.approx(estimate.expanded_uncertainty)
    assert joint.low < 0.5 < joint.high


def test_readings_without_scatter_leave_one_value() -> None:
    for each in find_intervals(fit(USUAL, _DESIGN, np.zeros(len(_DESIGN.position)))):
        assert (each.low, each.high) == (0.0, 0.0)
