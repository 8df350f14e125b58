"""The line through a series, its chance, and when it meets a limit."""

from __future__ import annotations

import json
import math
from collections.abc import Sequence
from datetime import date, timedelta

import numpy as np
import pytest

from environments import ROOT
from fleet.histories import entry, history, parameter, quarters
from zlmreport.fleet.trend import (
    DAYS_PER_YEAR,
    Series,
    TrendLine,
    fit_line_through,
    forecast,
    list_series_of,
    select_standing,
)
from zlmreport.model.fitting.distributions import t_quantile

#: t(0.975; 4), from tables.
T_OF_FOUR = 2.776


def series(values: Sequence[float], uncertainties: Sequence[float | None] | None = None) -> Series:
    stated = uncertainties or [1.0] * len(values)
    entries = [
        entry(day, parameter(value, expanded_uncertainty=uncertainty))
        for day, value, uncertainty in zip(quarters(len(values)), values, stated, strict=True)
    ]
    (found,) = list_series_of(select_standing(entries))
    return found


def normal_equations(found: Series, weights: Sequence[float]) -> tuple[float, float, float]:
    """Return slope per year, its standard deviation and t, by matrices and about another origin."""
    days = np.array([each.measured.toordinal() for each in found.calibrations], dtype=float)
    design = np.stack([np.ones_like(days), (days - days[0]) / DAYS_PER_YEAR], axis=1)
    values = np.array([each.parameter.value for each in found.calibrations])
    weight = np.diag(weights)
    inverse = np.linalg.inv(design.T @ weight @ design)
    solution = inverse @ design.T @ weight @ values
    rest = values - design @ solution
    deviation = math.sqrt(rest @ weight @ rest / (len(values) - 2) * inverse[1, 1])
    return float(solution[1]), deviation, float(solution[1] / deviation)


VALUES = [8.1, 8.9, 8.6, 9.7, 9.4, 10.6]
UNCERTAINTIES = [1.0, 1.0, 3.0, 1.5, 1.0, 2.0]


def test_calibrations_weigh_by_the_inverse_square_of_their_uncertainty() -> None:
    found = series(VALUES, UNCERTAINTIES)
    line = fit_line_through(found)
    slope, deviation, _ = normal_equations(found, [1 / u**2 for u in UNCERTAINTIES])
    assert line.slope == pytest.approx(slope, rel=1e-9)
    assert math.sqrt(line.slope_variance) == pytest.approx(deviation, rel=1e-9)


def test_calibrations_weigh_alike_where_one_states_no_uncertainty() -> None:
    line = fit_line_through(series(VALUES, [None, *UNCERTAINTIES[1:]]))
    assert line.slope == pytest.approx(fit_line_through(series(VALUES)).slope, rel=1e-12)


def test_the_regression_is_that_of_the_certified_data_set_norris() -> None:
    norris = json.loads((ROOT / "tests" / "data" / "nist" / "reference_datasets.json").read_text())["sets"][
        "Norris"
    ]
    # Its abscissas, in tenths, are days here.
    start = date(2000, 1, 1)
    entries = [
        entry(
            start + timedelta(days=round(10 * x)),
            parameter(y, expanded_uncertainty=None),
            job=f"{index}.yaml",
        )
        for index, (x, y) in enumerate(zip(norris["x"], norris["y"], strict=True))
    ]
    (found,) = list_series_of(select_standing(entries))
    line = fit_line_through(found)
    per_unit = 10 / DAYS_PER_YEAR
    assert line.slope * per_unit == pytest.approx(float(norris["parameters"][1]), rel=1e-10)
    deviation = float(norris["standard_deviations"][1])
    assert math.sqrt(line.slope_variance) * per_unit == pytest.approx(deviation, rel=1e-9)


def test_the_chance_is_that_of_students_t() -> None:
    found = series(VALUES)
    _, _, t = normal_equations(found, [1.0] * len(VALUES))
    p_value = fit_line_through(found).p_value
    assert t_quantile(1 - p_value, len(VALUES) - 2) == pytest.approx(abs(t), rel=1e-9)


def test_what_all_calibrations_have_in_common_leaves_slope_and_chance_alone() -> None:
    line = fit_line_through(series(VALUES))
    shifted = fit_line_through(series([value + 3.0 for value in VALUES]))
    assert (shifted.slope, shifted.p_value) == pytest.approx((line.slope, line.p_value), rel=1e-9)


def test_larger_stated_uncertainties_of_all_calibrations_make_no_scatter() -> None:
    line = fit_line_through(series(VALUES, [0.1] * len(VALUES)))
    other = fit_line_through(series(VALUES, [10.0] * len(VALUES)))
    assert other.p_value == pytest.approx(line.p_value, rel=1e-9)


@pytest.mark.parametrize("value", [0.0, 5.0])
def test_values_that_never_change_do_not_drift(value: float) -> None:
    assert fit_line_through(series([value] * 6)).p_value == 1.0


def test_a_line_without_scatter_is_no_accident() -> None:
    assert fit_line_through(series([1.0, 2.0, 3.0, 4.0, 5.0])).p_value < 1e-12


# Worked by hand: 10 µm at the mean date, which is day 10000; +2 µm a year; u(a) = 0.1, u(b) = 0.2.
LINE = TrendLine(10_000.0, 10.0, 2.0, 0.01, 0.04, 4)
LAST = date.fromordinal(10_365)


def years_after_mean(day: date) -> float:
    return (day.toordinal() - 10_000) / DAYS_PER_YEAR


HALF_A_DAY = 0.5 / DAYS_PER_YEAR


def test_the_limit_is_expected_where_the_line_meets_it() -> None:
    found = forecast(LINE, 20.0, LAST)
    assert found
    assert years_after_mean(found.expected) == pytest.approx(5.0, abs=HALF_A_DAY)


def test_the_interval_holds_the_dates_at_which_the_limit_is_within_t_times_u_of_the_line() -> None:
    found = forecast(LINE, 20.0, LAST)
    assert found
    assert found.latest
    assert found.earliest < found.expected < found.latest
    for day in (found.earliest, found.latest):
        years = years_after_mean(day)
        distance = abs(10.0 + 2.0 * years - 20.0)
        reach = T_OF_FOUR * math.sqrt(0.01 + 0.04 * years**2)
        # Half a day of rounding moves the distance by 2 µm/a, and the reach by less than t·u(b).
        assert distance == pytest.approx(reach, abs=(2.0 + T_OF_FOUR * 0.2) * HALF_A_DAY + 1e-3)


def test_a_negative_value_that_falls_comes_to_the_negative_limit() -> None:
    falling = TrendLine(10_000.0, -10.0, -2.0, 0.01, 0.04, 4)
    assert forecast(falling, 20.0, LAST) == forecast(LINE, 20.0, LAST)


def test_an_amount_that_gets_smaller_comes_to_no_limit() -> None:
    assert forecast(TrendLine(10_000.0, 10.0, -2.0, 0.01, 0.04, 4), 20.0, LAST) is None


def test_a_slope_that_may_be_none_has_no_interval() -> None:
    assert forecast(TrendLine(10_000.0, 10.0, 2.0, 0.01, 1.0, 4), 20.0, LAST) is None


def test_a_limit_that_is_generations_away_is_no_forecast() -> None:
    assert forecast(LINE, 200.0, LAST) is None


def test_an_interval_that_reaches_beyond_sight_is_open() -> None:
    found = forecast(TrendLine(10_000.0, 10.0, 2.0, 0.01, 0.36, 4), 30.0, LAST)
    assert found
    assert found.latest is None


def test_a_limit_that_was_passed_has_its_date_in_the_past() -> None:
    found = forecast(LINE, 11.0, LAST)
    assert found
    assert found.expected < LAST


def test_every_forecast_of_a_history_is_a_date() -> None:
    line = fit_line_through(series([1.0, 1.0, 1.0, 1.0, 1.0 + 1e-6]))
    assert forecast(line, 1e9, date(2026, 1, 1)) is None


def test_a_history_is_read_from_the_ledger_as_it_stands() -> None:
    (found,) = list_series_of(select_standing(history([1.0, 2.0, 3.0])))
    assert fit_line_through(found).at(found.calibrations[1].measured) == pytest.approx(2.0, rel=1e-12)
