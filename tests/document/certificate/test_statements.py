"""What a certificate states beside its results: place, amendment, opinions."""

from __future__ import annotations

import pytest

from document.certificate.documents import COMPLETE, certificate, having, job, lines_of, text_of, without
from zlmreport.plugin import InputError, Language
from zlmreport.plugin.renderer import Notice, place_of_work


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


AMENDS = {"number": "CAL-0", "reason": "Wrong serial number.", "changes": ["Serial number: S-1, not S-2"]}


@pytest.fixture
def document(tmp_path):
    """Compose a document that changes CAL-0, with other keys of its certificate."""
    return lambda **keys: certificate(
        tmp_path, {**COMPLETE, "certificate": {**COMPLETE["certificate"], "amends": AMENDS, **keys}}
    )


@pytest.mark.parametrize(
    ("keys", "title"),
    [
        ({}, "Amendment to Calibration Certificate CAL-0"),
        ({"language": "de"}, "Änderung zum Kalibrierschein CAL-0"),
        ({"kind": "report"}, "Amendment to Measuring Report CAL-0"),
        ({"kind": "report", "language": "de"}, "Änderung zum Messbericht CAL-0"),
        ({"title": "Factory Test"}, "Amendment to Factory Test CAL-0"),
    ],
)
def test_an_amendment_is_titled_by_what_it_amends(document, keys, title):
    assert document(**keys).title == title


def test_every_page_of_an_amendment_has_its_own_number(document):
    assert document().page_words.number == "Amendment CAL-1"


def test_a_replacement_is_a_whole_certificate_by_title_and_on_every_page(document):
    replacing = document(amends={**AMENDS, "kind": "replacement"})
    assert replacing.title == "Calibration Certificate"
    assert replacing.page_words.number == "Calibration Certificate CAL-1"


@pytest.mark.parametrize(
    ("kind", "heading"),
    [
        ("amendment", "This document amends CAL-0, which remains valid in all that is not changed here"),
        ("replacement", "This document replaces CAL-0, which is no longer valid"),
    ],
)
def test_the_first_page_begins_with_what_is_changed_and_why(document, kind, heading):
    first = document(amends={**AMENDS, "kind": kind}).cover[0]
    assert first == Notice(heading, ("Reason: Wrong serial number.", "Changed: Serial number: S-1, not S-2"))


def test_a_document_that_changes_none_speaks_of_none(document):
    text = "\n".join(line for block in document(amends=None).cover for line in lines_of(block))
    assert "amends" not in text
    assert "replaces" not in text


CUSTOMER = COMPLETE["customer"]["address"]
LABORATORY = COMPLETE["laboratory"]["address"]


def place(folder, keys):
    return place_of_work(job(folder, keys).keys)


@pytest.mark.parametrize(
    ("location", "kind", "words"),
    [
        ("Hall 3, Village", "other", "Hall 3, Village"),
        ({"kind": "laboratory"}, "laboratory", f"in the laboratory: {LABORATORY}"),
        ({"kind": "customer"}, "customer", f"at the customer's: {CUSTOMER}"),
        ({"kind": "customer", "address": "Hall 3"}, "customer", "at the customer's: Hall 3"),
        ({"kind": "other", "address": "Fair, stand 7"}, "other", "Fair, stand 7"),
        (
            {"kind": "laboratory branch", "address": "Lane 9\n12345 Town"},
            "laboratory branch",
            "at a branch of the laboratory: Lane 9, 12345 Town",
        ),
        (
            {"kind": "customer branch", "address": "Works 2"},
            "customer branch",
            "at a branch of the customer: Works 2",
        ),
    ],
)
def test_the_page_says_whose_place_it_was_and_its_address(tmp_path, location, kind, words):
    found = place(tmp_path, {**COMPLETE, "location": location})
    assert (found.kind, found.words.in_language(Language.ENGLISH)) == (kind, words)


def test_a_machine_is_calibrated_where_it_stands_if_nothing_else_is_said(tmp_path):
    found = place(tmp_path, having("machine.location", "Hall 3", without("location")))
    assert found.words.in_language(Language.GERMAN) == "am Aufstellort der Maschine: Hall 3"


def test_the_place_that_is_stated_goes_before_that_of_the_machine(tmp_path):
    keys = having("machine.location", "Hall 3", {**COMPLETE, "location": {"kind": "laboratory"}})
    assert place(tmp_path, keys).kind == "laboratory"


def test_certificate_without_a_place_is_refused(tmp_path):
    with pytest.raises(InputError, match=r"where the work was done .*7\.8\.2\.1 c"):
        certificate(tmp_path, without("location"))


OPINIONS = [
    {"statement": "There is play in the nut.", "basis": "The reversal value is alike everywhere."},
    {"statement": "It will grow.", "basis": "Three years.", "by": {"name": "B. Other", "function": "Fitter"}},
]


def test_an_opinion_is_marked_and_has_its_basis_and_its_author(tmp_path):
    document = certificate(tmp_path, {**COMPLETE, "opinions": OPINIONS})
    lines = [line for block in document.sections[-1].blocks for line in lines_of(block)]
    assert lines[0] == (
        "! Opinion and interpretation (ISO/IEC 17025:2017, 7.8.7), not a result of the measurement"
    )
    assert lines[-2:] == [
        "  There is play in the nut. | The reversal value is alike everywhere. | A. Person, Head",
        "  It will grow. | Three years. | B. Other, Fitter",
    ]


def test_a_certificate_without_opinions_has_no_section_for_them(tmp_path):
    assert "opinions" not in [section.key for section in certificate(tmp_path, COMPLETE).sections]


def test_opinions_are_not_on_the_first_page(tmp_path):
    document = certificate(tmp_path, {**COMPLETE, "opinions": OPINIONS})
    assert not any("play" in line for block in document.cover for line in lines_of(block))
