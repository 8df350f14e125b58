"""Values are written in the language of the document; what others supplied is marked wherever it stands."""

import numpy as np
import pytest

from document.certificate.circles import document
from document.certificate.documents import COMPLETE, certificate, text_of
from document.certificate.everything import EVERYTHING, write_tables
from zlmreport.document.writer import NOTHING, Marks
from zlmreport.job.contradictions import list_markable_keys
from zlmreport.plugin import CELSIUS, DEGREE, MILLIMETRE, Axis, AxisKind, Language, MeasurementSet
from zlmreport.plugin.renderer import Writer


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


DISCLAIMER = (
    "† Provided by the customer. The laboratory is not responsible for these data, which can affect the "
    "validity of the results."
)


@pytest.mark.parametrize(
    ("keys", "mark"),
    [
        (("environment.air_temperature",), " †"),
        (("environment.remarks", "environment.air_temperature"), " †"),
        (("machine.serial",), " ‡"),
        (("machine.model",), " †‡"),
        (("environment",), " †"),
        (("environment.air_temperature_2",), ""),
        (("environ",), ""),
        ((), ""),
    ],
)
def test_a_key_is_marked_by_itself_or_its_group_and_a_group_by_what_is_in_it(keys, mark):
    marks = Marks(frozenset({"environment.air_temperature", "machine.model"}), frozenset({"machine"}))
    assert marks.write_after(*keys) == mark


def test_what_the_customer_supplied_is_marked_on_every_page_that_has_it(tmp_path):
    keys = {**COMPLETE, "provided_by_customer": ["machine.serial"]}
    text = text_of(certificate(tmp_path, keys))
    assert "Serial number †: S-1" in text
    assert "Serial number: S-1" not in text


def test_data_of_the_customer_are_disclaimed(tmp_path):
    keys = {**COMPLETE, "provided_by_customer": ["environment.air_temperature"]}
    assert DISCLAIMER in text_of(certificate(tmp_path, keys))


def test_nothing_is_marked_or_disclaimed_where_all_is_the_laboratorys(tmp_path):
    assert "†" not in text_of(certificate(tmp_path, COMPLETE))


def test_limits_of_the_customer_are_marked_at_the_head_of_their_column(tmp_path):
    text = text_of(certificate(tmp_path, {**COMPLETE, "provided_by_customer": ["evaluate.tolerances"]}))
    assert text.count("Limit † µm") == 2


def test_readings_of_the_customer_are_marked(tmp_path):
    keys = {**COMPLETE, "provided_by_customer": ["measurement.source"]}
    assert "# Readings †" in text_of(certificate(tmp_path, keys))


def test_results_of_external_providers_are_named_and_marked(tmp_path):
    external = {
        "results": "Air temperature",
        "provider": "Thermometry Ltd",
        "reference": "Report 8",
        "keys": ["environment.air_temperature"],
    }
    text = text_of(certificate(tmp_path, {**COMPLETE, "external": [external]}))
    assert "! ‡ Results from external providers\n  - Air temperature: Thermometry Ltd, Report 8\n" in text
    assert "Air temperature ‡: 20.5 °C" in text


def test_every_key_that_others_may_supply_is_marked_where_it_is_printed(tmp_path, monkeypatch):
    """Each key is printed by one that asks for its mark: itself, its group, or what it is a group of."""
    asked = set()
    usual = Marks.write_after

    def noting(marks, *keys):
        asked.update(keys)
        return usual(marks, *keys)

    write_tables(tmp_path)
    monkeypatch.setattr(Marks, "write_after", noting)
    certificate(tmp_path, EVERYTHING)
    document(tmp_path, {"ccw": 1, "cw": 1})
    monkeypatch.undo()
    assert [key for key in list_markable_keys() if not Marks(frozenset({key})).write_after(*asked)] == []


def test_what_is_stated_is_written_to_its_last_digit():
    writer = Writer.of(measured([1.0], [0.0]), Language.GERMAN)
    assert writer.number(2543.175) == "2543,175"
    assert writer.number(250.0) == "250"
    assert writer.length(MILLIMETRE.to_si(1234.5678)) == "1234,5678 mm"


@pytest.mark.parametrize("degrees", [0.1, 0.3, 5.0, 7.5, 359.999])
def test_a_conversion_adds_no_digits(degrees):
    writer = Writer.of(measured([1.0], [0.0], Axis("C", AxisKind.ROTARY)), Language.ENGLISH)
    assert writer.length(DEGREE.to_si(degrees)) == f"{degrees:g}°"
