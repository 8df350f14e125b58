"""The whole document, as text: every sentence that a customer reads."""

import os
from dataclasses import replace
from pathlib import Path

import pytest

from document.certificate.documents import COMPLETE, certificate, having, text_of
from zlmreport.document.certificate import results
from zlmreport.document.certificate.results import Evaluated
from zlmreport.evaluation.uncertainty.monte_carlo import TRIALS
from zlmreport.plugin import Language, same_in_all_languages
from zlmreport.plugin.renderer import NoBudget, Table, Writer

GOLDEN = Path(__file__).with_name("golden")
ALL_STANDARDS = [
    "iso230-2:1988",
    "iso230-2:1997",
    "iso230-2:2006",
    {"standard": "iso230-2:2014", "tolerances": {"A": 150, "E": 100}},
    {"standard": "vdi-dgq-3441", "tolerances": {"P": 150}},
    "vdi-vde-2617",
    "nmtba",
]
REPORT = having("certificate.kind", "report")


def in_language(language):
    return {
        **COMPLETE,
        "certificate": {**COMPLETE["certificate"], "language": language},
        "evaluate": ALL_STANDARDS,
    }


@pytest.mark.parametrize("language", ["en", "de"])
def test_the_text_of_the_document_is_what_was_read_and_approved(tmp_path, language):
    """Set ZLMREPORT_APPROVE=1 to take the present text as approved, and read the difference."""
    text = text_of(certificate(tmp_path, in_language(language), TRIALS))
    # The job is written by the test, and the program's version moves: neither is part of the wording.
    job_lines = [line for line in text.splitlines() if "job.yaml" in line or "zlmreport 0" in line]
    for line in job_lines:
        text = text.replace(f"{line}\n", "")
    approved = GOLDEN / f"certificate.{language}.txt"
    if os.environ.get("ZLMREPORT_APPROVE"):
        approved.write_text(text, encoding="utf-8")
    assert text == approved.read_text(encoding="utf-8")


def test_the_title_of_the_job_stands_instead_of_the_usual_one(tmp_path):
    keys = {**COMPLETE, "certificate": {**COMPLETE["certificate"], "title": "Factory Test"}}
    assert certificate(tmp_path, keys).title == "Factory Test"


def test_every_standard_has_a_section_of_its_own_in_the_order_of_the_job(tmp_path):
    full = having("certificate.layout", "full", in_language("en"))
    sections = [section.key for section in certificate(tmp_path, full).sections]
    standards = ["iso230-2-1988", "iso230-2-1997", "iso230-2-2006", "iso230-2-2014"]
    assert sections == [
        "conditions",
        *standards,
        "vdi-dgq-3441",
        "vdi-vde-2617",
        "nmtba",
        "uncertainty",
        "readings",
        "origin",
    ]


def test_single_readings_behind_the_graphs_can_be_left_out(tmp_path):
    keys = {**COMPLETE, "certificate": {**COMPLETE["certificate"], "readings_on_graphs": False}}
    shown = [panel.readings for figure in certificate(tmp_path).figures for panel in figure.panels]
    hidden = [panel.readings for figure in certificate(tmp_path, keys).figures for panel in figure.panels]
    assert any(shown)
    assert not any(hidden)


def test_a_standard_that_asks_for_nothing_has_no_table_of_requirements(tmp_path):
    evaluation = certificate(tmp_path).evaluations[0]
    writer = Writer.of(evaluation.measurements, Language.ENGLISH)
    captions = [
        [
            block.caption
            for block in results.lay_out_results(
                Evaluated(each, (), NoBudget(same_in_all_languages(""))), writer
            ).blocks
            if isinstance(block, Table)
        ]
        for each in (evaluation, replace(evaluation, findings=()))
    ]
    assert [any(caption.startswith("Requirements") for caption in each) for each in captions] == [True, False]


def test_a_rule_that_needs_an_uncertainty_decides_nothing_without_one(tmp_path):
    in_words = {**COMPLETE["instrument"], "expanded_uncertainty": "see its certificate"}
    keys = {**REPORT, "instrument": in_words, "decision_rule": "guard-band"}
    text = text_of(certificate(tmp_path, keys))
    assert "conformity is therefore not decided" in text
    assert "| conforms" not in text


def test_conditions_logged_beside_the_readings_are_printed_as_their_range(tmp_path):
    readings = tmp_path / "readings.csv"
    readings.write_text(
        "target,direction,run,deviation,air_temperature,air_pressure,relative_humidity\n"
        "0,+,1,0.5,20.10,1013.2,45\n10,+,1,1.5,20.35,1013.4,46\n"
    )
    keys = {
        **REPORT,
        "axis": {"name": "Y"},
        "measurement": {"date": "2022-01-01", "source": {"plugin": "laser-csv", "file": "readings.csv"}},
        "environment": {"remarks": "oil shower on"},
    }
    text = text_of(certificate(tmp_path, keys))
    assert "Air temperature: 20.10 … 20.35 °C" in text
    assert "Air pressure: 1013.2 … 1013.4 hPa" in text
    assert "Relative humidity: 45.0 … 46.0 %" in text
