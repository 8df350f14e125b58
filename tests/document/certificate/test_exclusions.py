"""A document names what was set aside: on its first page, and with the value beside the readings."""

from __future__ import annotations

from document.certificate.documents import COMPLETE, certificate, having, text_of

ONE = {"target": 5, "direction": "-", "run": 2, "reason": "Air hose touched the reflector."}
KEY = "measurement.excluded"


def test_the_first_page_says_what_was_set_aside_and_why(tmp_path):
    text = text_of(certificate(tmp_path, having(KEY, [ONE])))
    notice = "! Additions to, deviations and exclusions from the method\n"
    assert f"{notice}  - Set aside: target 5 mm ↓, run 2: Air hose touched the reflector.\n" in text


def test_it_stands_behind_what_the_job_says_of_the_method(tmp_path):
    keys = having("measurement.deviations_from_method", "Three runs.", having(KEY, [ONE]))
    text = text_of(certificate(tmp_path, keys))
    assert "  - Three runs.\n  - Set aside: target 5 mm" in text


def test_the_readings_name_it_with_its_value(tmp_path):
    whole = certificate(tmp_path, COMPLETE).measurements
    text = text_of(certificate(tmp_path, having(KEY, [ONE])))
    (value,) = (
        1e6 * float(deviation)
        for deviation, target, approach, run in zip(
            whole.deviation, whole.target_positions[whole.target], whole.approach, whole.run, strict=True
        )
        if (round(1e3 * target), approach, run) == (5, -1, 2)
    )
    shown = f"{value:.3f}".rstrip("0").replace("-", "−")
    assert "! 1 reading was set aside and did not enter the results\n" in text
    assert f"  - target 5 mm ↓, run 2, read {shown}" in text


def test_what_was_set_aside_is_not_counted_among_the_missing(tmp_path):
    text = text_of(certificate(tmp_path, having(KEY, [ONE])))
    assert "nothing was filled in" not in text


def test_a_long_list_is_shortened_on_the_first_page_alone(tmp_path):
    several = [{**ONE, "target": target} for target in (-20, -15, -10, -5, 0, 5, 10, 15)]
    text = text_of(certificate(tmp_path, having(KEY, several)))
    assert "  - Set aside besides: 2 more, see the section on the readings\n" in text
    assert text.count("  - Set aside: target") == 6
    assert text.count(", run 2, read ") == 8


def test_a_german_document_says_it_in_german(tmp_path):
    keys = having("certificate.language", "de", having(KEY, [ONE]))
    text = text_of(certificate(tmp_path, keys))
    assert "  - Beiseite gelegt: Sollposition 5 mm ↓, Durchlauf 2: Air hose" in text
    assert "! 1 Messwert wurde beiseite gelegt und ging nicht in die Ergebnisse ein\n" in text
