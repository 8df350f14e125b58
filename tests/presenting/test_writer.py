"""Values are written in the language of the document and with the decimals of the readings."""

import numpy as np
import pytest

from zlmreport.language import Language
from zlmreport.measurement.axis import Axis, AxisKind
from zlmreport.measurement.measurement_set import MeasurementSet
from zlmreport.presenting.writer import NOTHING, Writer
from zlmreport.quantities.units import CELSIUS


def measured(deviations_um, targets_mm, axis=None):
    count = len(deviations_um)
    return MeasurementSet(
        axis=axis or Axis("X"),
        target_positions=np.array(targets_mm) / 1e3,
        target=np.arange(count),
        approach=np.ones(count, dtype=np.int64),
        run=np.ones(count, dtype=np.int64),
        deviation=np.array(deviations_um) / 1e6,
    )


@pytest.mark.parametrize(
    ("readings_um", "decimals"),
    [
        ([1.0, -2.0], 0),
        ([1.5, -2.0], 1),
        ([13.23, -12.92], 2),
        ([0.001, 5.0], 3),
        ([0.00049, 5.0], 3),
        ([np.nan, 2.5], 1),
    ],
)
def test_deviations_are_printed_with_the_decimals_of_the_readings_up_to_three(readings_um, decimals):
    writer = Writer.of(measured(readings_um, [0.0, 10.0]), Language.ENGLISH)
    assert writer.deviation_decimals == decimals


def test_a_deviation_taken_from_positions_keeps_its_decimals_in_spite_of_rounding():
    targets = np.array([2000.0, 9999.9999])
    actual = np.array([2000.01234, 10000.00012])
    writer = Writer.of(measured((actual - targets) * 1e3, targets), Language.ENGLISH)
    assert writer.deviation_decimals == 2


def test_the_decimal_sign_and_the_minus_follow_the_language():
    measurements = measured([-1.25, 3.5], [0.0, 10.0])
    assert Writer.of(measurements, Language.ENGLISH).deviation(-1.25e-6) == "−1.25"
    assert Writer.of(measurements, Language.GERMAN).deviation(-1.25e-6) == "−1,25"


def test_a_value_that_does_not_exist_is_a_dash_and_not_a_zero():
    writer = Writer.of(measured([1.0], [0.0]), Language.ENGLISH)
    assert writer.deviation(float("nan")) == NOTHING


def test_a_rotary_axis_is_written_in_degrees_and_arc_seconds():
    axis = Axis("C", AxisKind.ROTARY)
    measurements = MeasurementSet(
        axis=axis,
        target_positions=np.radians([0.0, 22.5]),
        target=np.array([0, 1]),
        approach=np.array([1, 1]),
        run=np.array([1, 1]),
        deviation=np.radians(np.array([1.5, -2.0]) / 3600),
    )
    writer = Writer.of(measurements, Language.ENGLISH)
    assert writer.position(measurements.target_positions[1]) == "22.5"
    assert writer.deviation(measurements.deviation[0]) == "1.5"
    assert (writer.position_unit.symbol, writer.deviation_unit.symbol) == ("°", "″")


def test_logged_temperatures_are_written_as_their_range():
    writer = Writer.of(measured([1.0], [0.0]), Language.GERMAN)
    assert writer.condition_span(np.array([293.15, np.nan, 293.655]), CELSIUS) == "20,00 … 20,50 °C"
    assert writer.condition_span(np.array([293.15, 293.15]), CELSIUS) == "20,00 °C"
