"""Jobs that an assessor would write up: each is refused, marked where it is read, or right."""

from __future__ import annotations

import datetime as dt
import json
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from document.certificate import documents
from document.certificate.documents import text_of, without
from doubtful import doubtful_jobs
from doubtful.doubtful_jobs import (
    REPORT,
    SOUND,
    TARGETS,
    changed,
    composed,
    cover,
    order,
    parameter,
    readings,
    refusals,
    rising,
    write,
)
from installed import registry
from zlmreport.evaluation.uncertainty.monte_carlo import TRIALS
from zlmreport.plugin.table import moment

_RANGES = ("misalignment", "machine_temperature", "expansion_coefficient", "environmental_variation")
_SHOWN = "What readings, dates and calibrations show"


def test_a_sound_job_is_neither_refused_nor_marked(tmp_path: Path) -> None:
    document = composed(tmp_path, SOUND)

    assert document.doubts == document.evidence == ()
    assert _SHOWN not in cover(document)
    assert parameter(document, "A").conforms


# 1. Zero is not a statement.


@pytest.mark.parametrize("name", _RANGES)
def test_a_range_of_zero_states_nothing(name: str, tmp_path: Path) -> None:
    keys = changed((f"uncertainty.{name}", 0))

    assert f"uncertainty.{name} (0 states nothing)" in refusals(tmp_path, keys)
    budget = composed(tmp_path, changed(REPORT, of=keys)).budget
    assert budget.missing == (name,)


@pytest.mark.parametrize(
    "reason",
    [
        "-",
        "none",
        "n/a",
        "negligible",
        "...",
        "0",
        "0 µm",
        "no influence",
        "see above",
        "kein Einfluss",
        "klein",
    ],
)
def test_a_dash_is_no_reason(reason: str, tmp_path: Path) -> None:
    keys = changed(("uncertainty.negligible.device_temperature", reason))

    assert "is no reason why it should be negligible" in refusals(tmp_path, keys)
    document = composed(tmp_path, changed(REPORT, of=keys))
    assert "U incomplete: Temperature measurement, measuring device not considered" in cover(document)


def test_an_empty_reason_is_refused_outright(tmp_path: Path) -> None:
    assert refusals(tmp_path, changed(("uncertainty.negligible.device_temperature", "")))


def test_seven_contributors_waved_away_decide_nothing(tmp_path: Path) -> None:
    names = (*_RANGES, "device_temperature", "device_expansion_coefficient", "resolution")
    keys = changed(REPORT, ("decision_rule", "guard-band"))
    keys["uncertainty"] = {"negligible": dict.fromkeys(names, "-")}

    document = composed(tmp_path, keys)

    assert not document.budget.is_complete
    assert parameter(document, "R").conforms is None


def test_u_is_never_below_what_the_last_digit_allows(tmp_path: Path) -> None:
    quiet = dict.fromkeys(
        (*_RANGES, "device_temperature", "device_expansion_coefficient", "resolution"),
        "shown on 2026-11-17 to be below 1 nm",
    )
    document = composed(tmp_path, {**SOUND, "uncertainty": {"negligible": quiet}}, readings(decimals=1))

    for symbol in ("R", "R_fwd", "B", "B_mean"):
        # A difference of two means of five readings in steps of 0.1 µm; R has single readings in it.
        least = 0.9 * 0.1e-6 / np.sqrt(12) * np.sqrt(2 / 5) * 2 / np.sqrt(11)
        assert (parameter(document, symbol).expanded_uncertainty or 0.0) > least
    assert (parameter(document, "R").expanded_uncertainty or 0.0) > 0.02e-6


def test_the_sheet_lists_what_was_declared_negligible(tmp_path: Path) -> None:
    document = composed(tmp_path, changed(("certificate.layout", "sheet")))

    assert "laser, no length of its own" in text_of(document)


# 2. U holds it whole.

_WARM = changed(("environment.axis_temperature", 26), ("uncertainty.resolution", 0.01))
#: A slope that the expansion of 6 K (69 µm) hides but for 2 µm.
_HIDING = readings(slope=0.5)


def test_a_certificate_of_a_machine_at_26_degrees_is_refused_with_the_remedy(tmp_path: Path) -> None:
    said = refusals(tmp_path, _WARM, _HIDING)

    assert "68.5 µm longer than at 20 °C (+6 K)" in said
    assert "corrections: {material:" in said


def test_a_report_of_it_is_not_said_to_conform_by_a_value_that_is_known_to_be_wrong(tmp_path: Path) -> None:
    warm = composed(tmp_path, changed(REPORT, of=_WARM), _HIDING)
    a = parameter(warm, "A")
    corrected = composed(
        tmp_path,
        changed(("corrections", {"material": {"temperature": "axis_temperature"}}), of=_WARM),
        _HIDING,
    )
    right = parameter(corrected, "A").value

    assert a.value < 10e-6 < right
    assert a.conforms is None
    assert a.value + a.known_error == pytest.approx(right, abs=0.02e-6)
    assert abs(right - a.value) < (a.expanded_uncertainty or 0.0)
    assert 1.6 < (a.coverage_factor or 0.0) < 2.4  # biases are in no k
    text = text_of(warm)
    assert "Where a known error that is not corrected would turn the statement, nothing is decided." in text
    assert "Results for 20 °C" in text
    (finding,) = (
        each for each in warm.evaluations[0].findings if each.requirement.en.startswith("Results for 20")
    )
    assert finding.met is False


def test_a_temperature_that_moves_is_taken_reading_by_reading(tmp_path: Path) -> None:
    """The readings of the last run stand 4 K higher than those of the first: R shows it, and U holds it."""
    warming = np.linspace(20, 24, len(order()))
    right = readings()
    warm = right.copy()
    for number, (target, direction, run) in enumerate(order()):
        length = (TARGETS[0] - TARGETS[target]) / 1e3
        warm[target, direction, run] -= 11.5 * (warming[number] - 20) * length
    keys = changed(REPORT)

    document = composed(tmp_path, keys, warm, axis_temperature=warming)
    truth = composed(tmp_path, keys, right)

    for each in truth.evaluations[0].parameters:
        found = parameter(document, each.quantity.symbol)
        assert abs(found.value - each.value) < (found.expanded_uncertainty or 0.0), each.quantity.symbol
    assert refusals(tmp_path, SOUND, warm, axis_temperature=warming)


@pytest.mark.parametrize("is_corrected", [True, False])
def test_a_wrong_coefficient_of_a_machine_that_warms_up_is_in_r_too(
    is_corrected: bool,
    tmp_path: Path,
) -> None:
    """α is 11.95 µm/(m·K), and 11.5 ± 0.5 is stated: from 20 to 24 °C that opens R by some 1.5 µm."""
    warming = np.linspace(20, 24, len(order()))
    right = readings()
    warm = right.copy()
    for number, (target, direction, run) in enumerate(order()):
        warm[target, direction, run] += 11.95 * (warming[number] - 20) * (TARGETS[target] - TARGETS[0]) / 1e3
    correct = {"material": {"temperature": "axis_temperature"}} if is_corrected else {}
    keys = changed(
        REPORT,
        ("corrections", correct),
        ("uncertainty.resolution", 0.01),
        ("uncertainty.negligible.environmental_variation", "none in this world"),
    )
    keys["uncertainty"].pop("environmental_variation")

    document = composed(tmp_path, keys, warm, axis_temperature=warming)
    truth = composed(tmp_path, changed(REPORT), right)

    for symbol in ("R", "R_fwd", "R_bwd", "B"):
        found = parameter(document, symbol)
        assert abs(found.value - parameter(truth, symbol).value) < (found.expanded_uncertainty or 0.0), symbol
    assert "reading by reading" in text_of(document)


# 3. Another test.


@pytest.mark.parametrize("layout", ["sheet", "standard", "full"])
@pytest.mark.parametrize(
    ("language", "said"),
    [("en", "with the same set-up left in place"), ("de", "mit derselben, unveränderten Messeinrichtung")],
)
def test_the_interval_of_the_axis_says_for_which_set_up_it_holds(
    language: str, said: str, layout: str, tmp_path: Path
) -> None:
    keys = changed(("certificate.language", language), ("certificate.layout", layout))

    assert said in text_of(composed(tmp_path, keys))


# 4. Risks agree.


def test_the_first_page_tells_the_risk_that_the_table_has(tmp_path: Path) -> None:
    tight = [{"standard": "iso230-2:2014", "tolerances": {"A": 6.2}}]
    document = composed(tmp_path, changed(("evaluate", tight)))

    risk = parameter(document, "A").decision.risk  # type: ignore[union-attr]
    assert f"the largest here is {100 * risk:.1f} %, of A" in cover(document)


def test_a_guard_band_of_u_has_the_risk_of_95_percent(tmp_path: Path) -> None:
    keys = changed(("decision_rule", "guard-band"), ("environment.axis_temperature", 20.6))
    document = composed(tmp_path, keys, trials=TRIALS)

    assert "The risk of a wrong acceptance is at most 2.3 %." in cover(document)


def test_an_uncertainty_larger_than_the_limit_is_said_under_simple_acceptance(tmp_path: Path) -> None:
    tight = changed(("evaluate", [{"standard": "iso230-2:2014", "tolerances": {"B": 0.3}}]))

    assert "U of B is larger than the limit" in text_of(composed(tmp_path, tight, trials=TRIALS))


# 5. A laser that does not look at the air, and one that has corrected the material.

_AIR = {"air_temperature": 20, "air_pressure": 900, "relative_humidity": 50}


def _blind(*more: tuple[str, object]) -> dict[str, object]:
    environment = {**SOUND["environment"], **_AIR}
    return changed(("instrument.compensation", "none"), ("environment", environment), *more)


def test_a_laser_that_compensates_nothing_has_the_air_in_its_budget(tmp_path: Path) -> None:
    stated = {**SOUND["uncertainty"], "air_temperature": 1, "air_pressure": 1, "relative_humidity": 10}
    document = composed(tmp_path, _blind(("uncertainty", stated)))

    # 113.25 hPa at 0.268 µm/m each over 0.9933 m.
    found = parameter(document, "E").expanded_uncertainty or 0.0
    assert abs(parameter(document, "E").known_error) > 20e-6
    assert 25e-6 < found < 36e-6
    assert "Refractive index of the air, not compensated" in text_of(document)


def test_its_sensors_are_demanded(tmp_path: Path) -> None:
    assert "uncertainty.air_pressure" in refusals(tmp_path, _blind())


@pytest.mark.parametrize(
    "said",
    [
        "not compensated",
        "No compensation",
        "keine Kompensation",
        "uncompensated",
        "off (sensor broken)",
        "none; air pressure 900 hPa",
        "fixed wavelength 632.8 nm",
        "material only",
        "nur Werkstoff",
        "nicht kompensiert",
    ],
)
def test_a_denial_in_other_words_is_one(said: str, tmp_path: Path) -> None:
    assert "uncertainty.air_pressure" in refusals(tmp_path, _blind(("instrument.compensation", said)))


def test_what_was_said_instead_stands_in_the_question(tmp_path: Path) -> None:
    asked = refusals(tmp_path, changed(("instrument.compensation", "automatic")))

    assert "(instrument.compensation, 'automatic', does not say)" in asked


def test_the_air_of_a_compensation_is_true_or_false(tmp_path: Path) -> None:
    asked = refusals(tmp_path, changed(("instrument.compensates", {"air": "automatic"})))

    assert "instrument.compensates.air" in asked


@pytest.mark.parametrize(
    "said", ["automatic", "yes", "on", "active", "ja", "full", "ein", "compensated", "standard"]
)
def test_a_compensation_without_a_word_on_the_air_is_asked_about(said: str, tmp_path: Path) -> None:
    asked = refusals(tmp_path, changed(("instrument.compensation", said)))

    assert "instrument.compensates: {air: true} is enough" in asked


@pytest.mark.parametrize(
    "said",
    [
        "air",
        "Umweltkompensation",
        "refractive index of the air; no material temperature",
        "Edlén, by the weather station",
        "automatic, by the XC-80",
        "indice de réfraction de l’air",
        "indice di rifrazione dell’aria",
        "índice de refracción del aire",
        "Brechzahl der Luft, kein Werkstoff",
    ],
)
def test_an_instrument_that_looks_at_the_air_is_believed(said: str, tmp_path: Path) -> None:
    assert not refusals(tmp_path, _blind(("instrument.compensation", said)))


def test_a_triangulating_sensor_needs_no_air(tmp_path: Path) -> None:
    assert not refusals(tmp_path, _blind(("instrument.name", "Laser triangulation sensor")))


def test_a_laser_that_corrected_the_material_has_no_expansion_left(tmp_path: Path) -> None:
    keys = changed(("instrument.compensates", {"material": 11.5, "air": True}), of=_WARM)
    document = composed(tmp_path, keys)

    a = parameter(document, "A")
    assert a.known_error == 0.0
    # Coefficient: 1 µm/(m·K) · 6 K · 0.9933 m /√12 = 1.72 µm; sensor: 11.5 · 0.1 · 0.9933/√12 = 0.33 µm.
    named = {each.contributor: each.standard_uncertainty for each in document.budget.contributions}  # type: ignore[union-attr]
    assert named["expansion_coefficient"] == pytest.approx(0.9933 * 6 * 1e-6 / np.sqrt(12), rel=1e-3)
    assert named["machine_temperature"] == pytest.approx(0.9933 * 11.5e-6 * 0.1 / np.sqrt(12), rel=1e-3)
    assert "longer than at 20 °C" not in cover(document)
    assert "corrected by the instrument" in text_of(document)


def test_another_coefficient_than_the_machines_leaves_the_difference(tmp_path: Path) -> None:
    keys = changed(("instrument.compensates", {"material": 10.5, "air": True}), of=_WARM)

    assert abs(parameter(composed(tmp_path, keys), "E").known_error) == pytest.approx(2.5e-6, rel=0.3)


def test_nothing_is_corrected_twice(tmp_path: Path) -> None:
    keys = changed(
        ("instrument.compensates", {"material": 11.5}),
        ("corrections", {"material": {"temperature": "axis_temperature"}}),
        of=_WARM,
    )

    assert "says that the instrument has done this" in refusals(tmp_path, keys)


# 6. Evidence in the readings.


def _fall(deviations: np.ndarray) -> np.ndarray:
    return deviations + np.linspace(7.5, -5.2, 5)


def _copied(deviations: np.ndarray) -> np.ndarray:
    return np.repeat(deviations[..., :1], 5, axis=-1)


def _millimetres(deviations: np.ndarray) -> np.ndarray:
    return deviations / 1e3


def _nanometres(deviations: np.ndarray) -> np.ndarray:
    return deviations * 1e3


@pytest.mark.parametrize(
    ("spoil", "said"),
    [
        (_fall, "Run means fall from "),
        (
            _fall,
            "1 µm is stated of drift at rest: what exceeds it is counted as the axis's own, and not in U",
        ),
        (rising, "Run means rise from −"),
        (_nanometres, "if the file has another unit"),
        (_copied, "Runs 1, 2, 3, 4, 5 are identical in every digit"),
        (_millimetres, "state measurement.source.units: {deviation: mm}"),
    ],
)
def test_what_the_readings_show_is_said_on_the_first_page(spoil, said: str, tmp_path: Path) -> None:
    document = composed(tmp_path, SOUND, spoil(readings()))

    assert said in cover(document)
    assert any(said in each.en or said in each.in_language(document.language) for each in document.evidence)


def test_what_spans_too_much_is_not_said_to_have_been_read_in_the_unit_of_the_page(tmp_path: Path) -> None:
    """The job, or the file itself, may name another, and only their size is known here."""
    document = composed(tmp_path, SOUND, _nanometres(readings()))

    assert "read as" not in next(each.en for each in document.evidence if "together span" in each.en)


def test_drift_is_said_where_nothing_is_stated_of_it(tmp_path: Path) -> None:
    keys = without("uncertainty.environmental_variation", keys=changed(REPORT))

    assert "nothing is stated of drift at rest" in cover(composed(tmp_path, keys, rising(readings())))


def test_nothing_says_that_drift_is_out_of_sight_where_run_means_show_it(tmp_path: Path) -> None:
    text = text_of(composed(tmp_path, SOUND, _fall(readings())))

    assert "drift and warm-up can only be judged by the order of the readings" in text


@pytest.mark.parametrize(
    ("alpha", "said"),
    [
        (0, "0 µm/(m·K) is unusual"),
        (115, "115 µm/(m·K) is unusual"),
        (0.0115, "0.0115 mm/(m·K)"),
        (-11.5, "−11.5 µm/(m·K) is unusual"),
    ],
)
def test_an_expansion_coefficient_that_no_machine_has_is_marked(
    alpha: float, said: str, tmp_path: Path
) -> None:
    assert said in cover(composed(tmp_path, changed(("environment.expansion_coefficient", alpha))))


@pytest.mark.parametrize("alpha", [1.2, -0.5, 23.8])
def test_invar_carbon_fibre_and_aluminium_are_not(alpha: float, tmp_path: Path) -> None:
    assert not composed(tmp_path, changed(("environment.expansion_coefficient", alpha))).doubts


def test_a_temperature_stated_otherwise_than_logged_is_said(tmp_path: Path) -> None:
    document = composed(tmp_path, changed(REPORT), axis_temperature=np.full(len(order()), 23.0))

    assert "20 °C is stated, and 23 °C was logged" in cover(document)


def test_a_resolution_finer_than_the_readings_is_not_believed(tmp_path: Path) -> None:
    document = composed(tmp_path, changed(("uncertainty.resolution", 0.001)), readings(decimals=0))

    assert "the readings were given in steps of 1 µm" in cover(document)


# 7. Traceability.


def test_a_calibration_without_a_date_is_marked(tmp_path: Path) -> None:
    document = composed(tmp_path, without("instrument.calibrated", keys=SOUND))

    assert "Measuring instrument: date of calibration not stated" in cover(document)


def test_one_of_2009_is_marked(tmp_path: Path) -> None:
    document = composed(tmp_path, changed(("instrument.calibrated", "2009-05-04")))

    assert "calibrated on 2009-05-04, 17 years before the measurement" in cover(document)


@pytest.mark.parametrize(
    ("key", "value"),
    [
        ("instrument.calibrated", "2026-11-19"),
        ("instrument.due", "2026-10-01"),
        ("instrument.certificate", "none"),
        ("instrument.certificate", "-"),
        ("instrument.certificate", "not calibrated yet"),
        ("instrument.certificate", "keiner vorhanden"),
        ("environment.thermometers", [{"name": "T 1", "certificate": "T-1", "due": "2026-10-01"}]),
    ],
)
def test_a_broken_chain_is_refused_and_marked_in_a_report(key: str, value: str, tmp_path: Path) -> None:
    keys = changed((key, value))

    assert key in refusals(tmp_path, keys)
    assert _SHOWN in cover(composed(tmp_path, changed(REPORT, of=keys)))


def test_a_refusal_says_which_device_and_which_dates(tmp_path: Path) -> None:
    said = refusals(tmp_path, changed(("instrument.calibrated", "2026-11-19")))

    assert "Measuring instrument: calibrated on 2026-11-19, after the measurement of 2026-11-18" in said


@pytest.mark.parametrize("layout", ["full", "standard", "sheet"])
@pytest.mark.parametrize(
    ("key", "value"), [("instrument.calibrated", "2026-11-19"), ("instrument.due", "2026-10-01")]
)
def test_a_report_does_not_call_results_traceable_by_a_chain_that_it_says_is_broken(
    key: str, value: str, layout: str, tmp_path: Path
) -> None:
    keys = changed(REPORT, (key, value), ("certificate.layout", layout))

    assert "metrologically traceable" not in text_of(composed(tmp_path, keys))


def test_the_results_file_has_what_the_first_page_marks(tmp_path: Path) -> None:
    document = composed(tmp_path, changed(("instrument.calibrated", "2009-05-04")), _fall(readings()))
    said = json.loads(registry().renderer("json").render(document))["doubtful"]

    assert [each.partition(" ")[0] for each in said] == ["Run", "Measuring"]
    assert "doubtful" not in json.loads(registry().renderer("json").render(composed(tmp_path, SOUND)))


def test_the_measurement_before_an_adjustment_is_looked_at_too(tmp_path: Path) -> None:
    write(tmp_path, _fall(readings()))
    (tmp_path / "x.csv").rename(tmp_path / "before.csv")
    before = {
        "adjustment": "table of pitch errors loaded",
        "measurement": {"date": "2026-11-17", "source": {"plugin": "laser-csv", "file": "before.csv"}},
    }
    document = composed(tmp_path, changed(("as_found", before)))

    assert "as found, before the adjustment: Run means fall from" in cover(document)


def test_a_date_of_issue_before_the_end_of_the_measurement_is_refused(tmp_path: Path) -> None:
    keys = changed(("measurement.end", "2026-11-19"), ("certificate.issued", "2026-11-18"))

    assert "2026-11-18 lies before the measurement of 2026-11-19" in refusals(tmp_path, keys)


def test_a_document_without_a_certificate_of_the_instrument_claims_no_traceability(tmp_path: Path) -> None:
    document = composed(tmp_path, changed(REPORT, ("instrument.certificate", "none")))

    assert "metrologically traceable" not in text_of(document)


def test_the_thermometer_is_asked_for_where_a_length_is_not_at_20_degrees(tmp_path: Path) -> None:
    warm = changed(("environment.axis_temperature", 20.6), of=without("environment.thermometers", keys=SOUND))

    assert "no thermometer is named" in cover(composed(tmp_path, warm))


def test_the_thermometer_of_a_correction_is_asked_for(tmp_path: Path) -> None:
    corrected = changed(("corrections", {"material": {"temperature": "axis_temperature"}}), of=_WARM)
    keys = without("environment.thermometers", keys=corrected)

    assert "no thermometer is named" in cover(composed(tmp_path, keys))
    assert "no thermometer is named" not in cover(composed(tmp_path, corrected))


@pytest.mark.parametrize(
    ("scope", "said"),
    [
        ({"length": 500}, "results over 993.3 mm (the scope ends at 500 mm)"),
        ({"kind": "rotary"}, "results of a linear axis"),
        ({"standards": ["vdi-dgq-3441"]}, "results by iso230-2:2014"),
        (
            {"quantity": "angle"},
            "Positioning accuracy. The capability that the laboratory states is for Angular",
        ),
    ],
)
def test_results_outside_the_accredited_scope_are_marked(scope, said: str, tmp_path: Path) -> None:
    keys = changed(("laboratory.cmc", {"constant": 0.3, **scope}))

    assert f"Outside the accredited scope: {said}" in cover(composed(tmp_path, keys))


_NARROW = [{"name": "T 1", "certificate": "T-1", "calibrated": "2026-02-01", "calibrated_range": [15, 19.5]}]


@pytest.mark.parametrize(
    ("key", "value", "said"),
    [
        (
            "instrument.calibrated_range",
            [0, 500],
            "of the measuring instrument: results over 993.3 mm (it is calibrated over 500 mm)",
        ),
        (
            "environment.thermometers",
            _NARROW,
            "of the thermometers: Air temperature 20.1 °C (they are calibrated from 15 to 19.5 °C)",
        ),
    ],
)
def test_results_outside_a_calibrated_range_are_marked(
    key: str, value: object, said: str, tmp_path: Path
) -> None:
    assert f"Outside the calibrated range {said}" in cover(composed(tmp_path, changed((key, value))))


def test_beyond_its_calibrated_range_nothing_is_traceable_through_an_instrument(tmp_path: Path) -> None:
    within, beyond = (
        text_of(composed(tmp_path, changed(("instrument.calibrated_range", [0, end])))) for end in (1000, 500)
    )
    assert "0 … 1000 mm" in within
    assert "Outside the calibrated range" not in within
    assert "metrologically traceable" in within
    assert "metrologically traceable" not in beyond


def test_the_readings_of_a_straightness_are_held_against_the_range_of_the_indicator(tmp_path: Path) -> None:
    straight = ("evaluate", ["iso230-1:2012"]), ("measurement.error", "EYX")
    without_lengths = without("environment.expansion_coefficient", "uncertainty", keys=SOUND)
    keys = changed(REPORT, *straight, ("instrument.calibrated_range", [-1, 1]), of=without_lengths)

    assert "µm (it is calibrated over 2 µm)" in cover(composed(tmp_path, keys))


def test_a_range_that_ends_before_it_begins_is_refused(tmp_path: Path) -> None:
    turned = refusals(tmp_path, changed(("instrument.calibrated_range", [500, 0])))

    assert "instrument.calibrated_range: the first value of the range must be less than the last" in turned


@pytest.mark.parametrize(
    ("first", "said"),
    [
        ("2026-11-17T08:00:00", "The times of the readings are of 2026-11-17, and"),
        ("18.11.2026 23:59:30", ""),  # a night that ends on the next day
        ("2026-11-18T08:00:00", ""),
        ("2026-11-19T00:30:00Z", ""),  # where it was measured, it was still the 18th
        ("2026-11-20T00:30:00Z", "The times of the readings are of 2026-11-20, and"),
    ],
)
def test_readings_of_another_day_than_the_measurement_are_marked(
    first: str, said: str, tmp_path: Path
) -> None:
    written = moment(first)
    write(tmp_path, readings())
    head, *rows = (tmp_path / "x.csv").read_text(encoding="utf-8").splitlines()
    times = [(written + dt.timedelta(seconds=20 * number)).isoformat() for number in range(len(rows))]
    lines = [f"{head},time", *(f"{row},{time}" for row, time in zip(rows, times, strict=True))]
    (tmp_path / "x.csv").write_text("\n".join(lines) + "\n", encoding="utf-8")

    document = documents.certificate(tmp_path, SOUND)

    assert (said in cover(document)) if said else document.evidence == ()


def test_a_certificate_that_names_no_document_is_open_where_the_standard_wants_it(tmp_path: Path) -> None:
    document = composed(tmp_path, changed(REPORT, ("instrument.certificate", "pending")))

    assert (
        "Measuring instrument, its calibration and its compensation reported\N{NO-BREAK SPACE}* | not stated"
        in text_of(document)
    )


def test_the_source_of_limits_is_printed_or_said_to_be_missing(tmp_path: Path) -> None:
    named = [{"standard": "iso230-2:2014", "tolerances": {"A": 10}, "specification": "Protocol 4711"}]

    assert "Protocol 4711" in cover(composed(tmp_path, changed(("evaluate", named))))
    assert "Limits as ordered; their source is not stated." in cover(composed(tmp_path, SOUND))


# 9. Sentences.

_LAYOUTS = ("full", "standard", "sheet")


@pytest.fixture
def long_axis(monkeypatch: pytest.MonkeyPatch) -> dict[str, Any]:
    """Return a job on an axis of 2.5 m; its readings are written so, too."""
    monkeypatch.setattr(doubtful_jobs, "TARGETS", 2.5 * TARGETS)
    return changed(REPORT, ("axis.travel", [0, 2500]))


def _runs(monkeypatch: pytest.MonkeyPatch, number: int) -> np.ndarray:
    monkeypatch.setattr(doubtful_jobs, "RUNS", number)
    return readings()


@pytest.mark.parametrize("rule", ["simple", "guard-band", "iso14253-1", "non-binary"])
def test_what_goes_beyond_the_standard_conforms_to_no_limit(
    rule: str, long_axis: dict[str, Any], tmp_path: Path
) -> None:
    limits = [{"standard": "iso230-2:2014", "tolerances": {"A": 10, "R_fwd": 5, "E": 20}}]
    document = composed(tmp_path, changed(("decision_rule", rule), ("evaluate", limits), of=long_axis))

    assert {each: parameter(document, each).conforms for each in ("A", "R_fwd", "E")} == {
        "A": None,
        "R_fwd": None,
        "E": True,
    }
    assert "nothing is decided on their limits" in text_of(document)


def test_a_standard_that_knows_no_such_limit_decides_on_a_long_axis(
    long_axis: dict[str, Any], tmp_path: Path
) -> None:
    limits = [{"standard": "vdi-dgq-3441", "tolerances": {"P": 20}}]

    assert parameter(composed(tmp_path, changed(("evaluate", limits), of=long_axis)), "P").conforms


@pytest.mark.parametrize("language", ["en", "de"])
@pytest.mark.parametrize("layout", _LAYOUTS)
def test_one_run_is_one_and_has_no_interval_of_the_axis(
    layout: str, language: str, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    keys = changed(REPORT, ("certificate.layout", layout), ("certificate.language", language))
    text = text_of(composed(tmp_path, keys, _runs(monkeypatch, 1)))

    assert not re.search(r"(?<![\d.,])1 (?:runs|Durchläufe|readings|Messwerte)\b", text)
    assert "interval of the axis" not in text
    assert "Intervall der Achse" not in text
    assert "which the parameters state" not in text


@pytest.mark.parametrize("layout", _LAYOUTS)
def test_a_measuring_report_calibrates_nothing(layout: str, tmp_path: Path) -> None:
    keys = changed(
        REPORT,
        ("certificate.layout", layout),
        ("certificate.language", "de"),
        ("next_due", {"date": "2027-11-18", "agreed": True}),
        ("opinions", [{"statement": "Die Achse ist gut.", "basis": "A"}]),
    )
    text = text_of(composed(tmp_path, keys))

    said = [line for line in text.splitlines() if re.search("alibrier", line)]
    of_instrument = re.compile(
        "Kalibrierschein: C-1|Kalibriert am|Kalibrierschein C-1|T-1, kalibriert|seine Kalibrierung"
    )
    assert [line for line in said if not of_instrument.search(line)] == []
    assert "Messgegenstand" in text


@pytest.mark.parametrize("layout", _LAYOUTS)
def test_german_has_the_words_of_the_field(layout: str, tmp_path: Path) -> None:
    keys = changed(("certificate.layout", layout), ("certificate.language", "de"))
    text = text_of(composed(tmp_path, keys))

    assert "Kalibriergegenstand" in text
    assert "Formelzeichen" in text
    assert not re.search(r"\bZeichen\b|kalibrierten Gegenstand", text)


def test_no_sentence_calls_a_mean_with_a_sign_a_full_width(tmp_path: Path) -> None:
    assert "All parameters are full widths" not in text_of(composed(tmp_path, SOUND))
