"""Target positions against the periods of an axis."""

from __future__ import annotations

import numpy as np
import pytest

from evaluation.checks.findings import said
from zlmreport.evaluation.checks.readings import mean_interval, random_fractions, spacing_against_periods
from zlmreport.evaluation.requirements import Basis
from zlmreport.measurement.axis import Axis
from zlmreport.measurement.measurement_set import MeasurementSet
from zlmreport.testing import bidirectional_test

FORMULA = "P = N·p + r"
HIDDEN = "all targets at the same phase: a deviation of this period stays hidden"


def measured_at(*targets: float, pitch: float | None = None, signal: float | None = None) -> MeasurementSet:
    readings = np.zeros((len(targets), 1))
    axis = Axis("X", screw_pitch=pitch, signal_period=signal)
    return bidirectional_test(targets, readings, readings, axis=axis)


@pytest.mark.parametrize(
    ("targets", "met"),
    [
        ([0, 50, 100, 150], False),  # 5 pitches each
        ([3, 53, 103, 153], False),  # the same phase, though not zero
        ([0, 30, 100, 110], False),  # uneven, and yet at one phase
        ([0, 52, 104, 156], True),
        ([0, 50.3, 100.1, 149.6], True),
    ],
)
def test_spacing_of_whole_pitches_hides_the_deviation_of_the_pitch(targets: list[float], met: bool) -> None:  # noqa: FBT001 - a column of a table
    (found,) = spacing_against_periods(measured_at(*targets, pitch=0.01), Basis.APPLIED)

    assert said(found)[0] == "Spacing no integer multiple of the pitch (10 mm)"
    assert found.met is met
    assert (said(found)[1] == HIDDEN) is not met


def test_each_stated_period_is_held_against_the_spacing() -> None:
    pitch, signal = spacing_against_periods(
        measured_at(0, 25.01, 50.02, 75.03, pitch=0.01, signal=20e-6), Basis.APPLIED
    )

    assert (said(pitch)[0], pitch.met) == ("Spacing no integer multiple of the pitch (10 mm)", True)
    assert (said(signal)[0], signal.met) == (
        "Spacing no integer multiple of the signal period (0.02 mm)",
        True,
    )


def test_rounding_of_decimal_positions_does_not_pass_for_another_phase() -> None:
    (found,) = spacing_against_periods(
        measured_at(0.1, 200.1, 700.1, 1100.1, 1999.7, signal=20e-6), Basis.APPLIED
    )

    assert found.met is False


def test_spacing_is_open_where_no_period_is_stated() -> None:
    (found,) = spacing_against_periods(measured_at(0, 50, 100), Basis.APPLIED)

    assert said(found)[1:] == ("no period stated", None)


def test_spacing_is_open_at_a_single_position() -> None:
    (found,) = spacing_against_periods(measured_at(50, pitch=0.01), Basis.APPLIED)

    assert found.met is None


def test_equal_intervals_carry_no_random_fraction() -> None:
    found = random_fractions(measured_at(0.3, 10.5, 20.7, 30.9), FORMULA, Basis.PUBLISHED)

    assert said(found) == (
        "Targets P = N·p + r with a random fraction r at each",
        "all intervals alike: 10.2 mm",
        False,
    )


def test_differing_intervals_can_carry_a_random_fraction() -> None:
    found = random_fractions(measured_at(0, 10.21, 19.87, 30.4), FORMULA, Basis.PUBLISHED)

    assert said(found)[1:] == ("intervals from 9.66 mm to 10.53 mm", True)


def test_two_positions_do_not_tell_whether_there_is_a_random_fraction() -> None:
    assert random_fractions(measured_at(0, 10), FORMULA, Basis.PUBLISHED).met is None


@pytest.mark.parametrize(("number", "met"), [(13, True), (12, False)])
def test_mean_interval(number: int, met: bool) -> None:  # noqa: FBT001 - a column of a table
    measurements = measured_at(*np.linspace(0, 3000, number))

    assert mean_interval(measurements, 0.25, Basis.APPLIED).met is met
