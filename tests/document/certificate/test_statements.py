"""What a certificate states beside its results."""

import pytest

from document.certificate.documents import COMPLETE, certificate, having, lines_of, text_of, without


def cover(document):
    return [line.strip() for block in document.cover for line in lines_of(block)]


@pytest.mark.parametrize(
    ("language", "statement"),
    [
        (
            "en",
            (
                "The results relate only to the item calibrated, in its condition at the time of the "
                "measurement."
            ),
        ),
        (
            "de",
            ("Die Ergebnisse gelten nur für den Kalibriergegenstand in seinem Zustand zur Zeit der Messung."),
        ),
    ],
)
def test_results_relate_only_to_the_item_calibrated(tmp_path, language, statement):
    document = certificate(tmp_path, having("certificate.language", language, COMPLETE))
    assert statement in cover(document)


def test_a_certificate_is_reproduced_only_in_full(tmp_path):
    assert any("reproduced only in full" in line for line in cover(certificate(tmp_path, COMPLETE)))


def test_results_are_traceable_through_the_certificate_of_the_instrument(tmp_path):
    lines = cover(certificate(tmp_path, COMPLETE))
    assert any(
        "metrologically traceable" in line and "(calibration certificate C-1)" in line for line in lines
    )


def test_a_report_without_such_a_certificate_claims_no_traceability(tmp_path):
    keys = having("certificate.kind", "report", without("instrument.certificate", keys=COMPLETE))
    assert "traceable" not in text_of(certificate(tmp_path, keys))


def test_deviations_from_the_method_stand_on_the_first_page(tmp_path):
    keys = having("measurement.deviations_from_method", "Three runs, not five.", COMPLETE)
    lines = cover(certificate(tmp_path, keys))
    at = lines.index("! Additions to, deviations and exclusions from the method")
    assert lines[at + 1] == "- Three runs, not five."


def test_a_simplified_certificate_has_no_readings_and_says_by_whose_agreement(tmp_path):
    keys = {**COMPLETE, "agreement": {"simplified": True, "reference": "Order 4711"}}
    document = certificate(tmp_path, keys)
    assert "readings" not in [section.key for section in document.sections]
    assert any(line.startswith("By agreement with the customer (Order 4711)") for line in cover(document))


def test_an_agreement_alone_leaves_nothing_out(tmp_path):
    document = certificate(tmp_path, {**COMPLETE, "agreement": {"reference": "Order 4711"}})
    assert "readings" in [section.key for section in document.sections]


@pytest.mark.parametrize(
    ("key", "value", "fact"),
    [
        ("measurement.end", "2022-04-09", "Date of measurement: 2022-04-07 to 2022-04-09"),
        ("measurement.end", "2022-04-07", "Date of measurement: 2022-04-07"),
        ("dates.received", "2022-04-01", "Received: 2022-04-01"),
        ("location", "Hall 3", "Place of the work: Hall 3"),
        (
            "next_due",
            {"date": "2027-04-07", "agreed": True},
            "Next calibration due, as agreed with the customer: 2027-04-07",
        ),
    ],
)
def test_facts_of_the_work_stand_at_the_head_of_the_first_page(tmp_path, key, value, fact):
    assert fact in cover(certificate(tmp_path, having(key, value, COMPLETE)))


@pytest.mark.parametrize(
    ("key", "value", "fact"),
    [
        ("procedure", "QP 17, issue 4", "Procedure: QP 17, issue 4"),
        ("sampling", "One axis of three.", "Sampling: One axis of three."),
        ("dates.sampled", "2022-04-02", "Date of sampling: 2022-04-02"),
        ("machine.condition", "used", "Condition: used"),
        ("axis.abbe_offset", 120, "Distance of the measuring line from the scale: 120 mm"),
        (
            "instrument.expanded_uncertainty_per_metre",
            0.5,
            "Expanded uncertainty: U = 2 µm + 0.5 µm/m · L (k = 2)",
        ),
    ],
)
def test_facts_of_item_and_method_stand_in_their_section(tmp_path, key, value, fact):
    assert f"  {fact}" in text_of(certificate(tmp_path, having(key, value, COMPLETE)))


def test_a_certificate_without_any_condition_says_that_none_is_named(tmp_path):
    rotary = {"name": "C", "kind": "rotary"}
    negligible = {"negligible": {"environmental_variation": "a quiet room"}}
    text = text_of(
        certificate(tmp_path, {**COMPLETE, "axis": rotary, "uncertainty": negligible, "environment": {}})
    )
    assert "The laboratory names no environmental condition that influenced the results." in text
