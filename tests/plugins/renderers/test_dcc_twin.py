"""The digital certificate says all that the pages say, and its readings are those that were evaluated."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from io import BytesIO
from pathlib import Path
from typing import Any
from xml.etree import ElementTree as ET

import numpy as np
import pytest
from pypdf import PdfReader

from document.certificate.documents import certificate, having
from document.certificate.everything import EVERYTHING, write_tables
from installed import registry
from plugins.renderers.test_dcc import KEYS, NAMES, ROTARY
from plugins.sources.reading import File
from zlmreport.plugin import Axis, AxisKind, InputError, MeasurementSet
from zlmreport.plugin.renderer import (
    Certificate,
    Facts,
    Notice,
    Paragraph,
    Table,
    changes,
)

STATED: Mapping[str, Any] = {
    **EVERYTHING,
    "laboratory": {**KEYS["laboratory"], "accreditation": "D-K-00000-00-00"},
    "certificate": {
        **EVERYTHING["certificate"],
        "amends": {"number": "CAL-0", "reason": "Wrong serial number.", "changes": ["S-1, not S-2"]},
    },
    "decision_rule": "guard-band",
    "agreement": {},
}
#: What clause 7.8 of ISO/IEC 17025:2017 asks for, as the job above states it.
CLAUSE_7_8 = {
    "7.8.2.1 a": "Amendment to Calibration Certificate CAL-0",
    "7.8.2.1 b": "Some Laboratory",
    "7.8.2.1 c": "at the customer's: Hall 3",
    "7.8.2.1 d": "CAL-1",
    "7.8.2.1 e": "A Customer",
    "7.8.2.1 f": "QP 17, issue 4",
    "7.8.2.1 g": "used",
    "7.8.2.1 h": "2022-04-05",
    "7.8.2.1 i": "2022-04-06 to 2022-04-07",
    "7.8.2.1 j": "2022-04-20",
    "7.8.2.1 k": "One axis of three.",
    "7.8.2.1 l": "The results relate only to the item calibrated",
    "7.8.2.1 n": "Air hose touched the reflector.",
    "7.8.2.1 o": "A. Person",
    "7.8.2.1 p": "Air temperature: Thermometry Ltd, Report 8",
    "7.8.2.2": "† Provided by the customer.",
    "7.8.4.1 a": "U = k·u is the expanded uncertainty of this test",
    "7.8.4.1 b": "20.5 °C",
    "7.8.4.1 c": "metrologically traceable through the calibration of the measuring instrument",
    "7.8.4.1 d": "New nut.",
    "7.8.4.1 e": "conforms",
    "7.8.6.1": "Decision rule: guarded acceptance with the guard band w = U.",
    "7.8.7": "There is play in the nut.",
    "7.8.8": "Reason: Wrong serial number.",
    "accreditation": "D-K-00000-00-00",
    "negligible": "40 mm at 20 °C",
}


#: What stands at the edges of each page: a sentence may go on beyond it.
_RUNNING = re.compile(r"\nSome Laboratory · [^\n]*\nAmendment CAL-1 page \d+ of \d+$")


@pytest.fixture(scope="module")
def both(tmp_path_factory: pytest.TempPathFactory) -> tuple[Certificate, str, str]:
    """A certificate that states everything; its DCC and its pages as text."""
    folder = tmp_path_factory.mktemp("twin")
    write_tables(folder)
    made = certificate(folder, STATED)
    digital = " ".join(ET.fromstring(registry().renderer("dcc").render(made)).itertext())
    pages = PdfReader(BytesIO(registry().renderer("pdf").render(made))).pages
    return made, solid(digital), solid(" ".join(_RUNNING.sub("", page.extract_text()) for page in pages))


def solid(text: str) -> str:
    """A text without what the setting of lines adds and takes away."""
    return re.sub(r"[\s\u00ad\u200b\u2060-]+", "", text)


def said(made: Certificate) -> Iterator[str]:
    """Each sentence of the document, each fact, and each cell of its tables of words."""
    for block in (*made.cover, *(each for section in made.sections for each in section.blocks)):
        match block:
            case Paragraph(text):
                yield text
            case Notice(heading, items):
                yield from (heading, *items)
            case Facts(pairs):
                yield from (part for pair in pairs for part in pair)
            case Table(_, columns, groups) if not any(column.unit for column in columns):
                yield from (
                    cell for group in groups for row in group.rows for cell in row if isinstance(cell, str)
                )


@pytest.mark.long
def test_every_statement_of_the_document_stands_in_the_dcc_and_on_the_pages(both):
    made, digital, pages = both
    stated = list(said(made))

    assert len(stated) > 100
    assert [each for each in stated if solid(each) not in digital] == []
    assert [each for each in stated if solid(each) not in pages] == []


@pytest.mark.parametrize("clause", CLAUSE_7_8)
def test_what_clause_7_8_asks_for_stands_in_both(clause, both):
    _, digital, pages = both

    assert solid(CLAUSE_7_8[clause]) in digital
    assert solid(CLAUSE_7_8[clause]) in pages


def test_a_statement_that_is_not_made_is_not_found(both):
    _, digital, pages = both

    assert solid("Decision rule: simple acceptance") not in digital + pages


def test_its_dates_span_the_measurement_as_found_too(tmp_path):
    write_tables(tmp_path)
    earlier = {
        **STATED["as_found"],
        "measurement": {**STATED["as_found"]["measurement"], "date": "2022-04-01"},
    }
    root = ET.fromstring(
        registry().renderer("dcc").render(certificate(tmp_path, {**STATED, "as_found": earlier, "dates": {}}))
    )

    assert root.findtext(".//dcc:beginPerformanceDate", "", NAMES) == "2022-04-01"
    assert root.findtext(".//dcc:endPerformanceDate", "", NAMES) == "2022-04-07"


def test_the_contributions_stand_with_their_standard_uncertainties(both):
    made, *_ = both
    unit = made.measurements.axis.deviation_unit
    written = [
        [float(each.text or "") for each in budget.iterfind(".//si:real/si:value", NAMES)]
        for budget in ET.fromstring(registry().renderer("dcc").render(made)).iterfind(
            ".//dcc:measurementResult/dcc:measurementMetaData/dcc:metaData", NAMES
        )
        if budget.find("dcc:data", NAMES) is not None
    ]
    of_each_test = [
        [each.standard_uncertainty for each in budget.contributions] + [budget.standard_uncertainty]
        for budget in (made.budget_as_found, made.budget)
    ]

    assert written == [[unit.from_si(each) for each in budget] for budget in of_each_test]


def test_the_changes_from_as_found_to_as_left_stand_with_their_uncertainty(both):
    made, *_ = both
    unit = made.measurements.axis.deviation_unit
    root = ET.fromstring(registry().renderer("dcc").render(made))
    (changed,) = [
        each
        for each in root.iterfind(".//dcc:results/dcc:result", NAMES)
        if "as left − as found" in "".join(each.find("dcc:name", NAMES).itertext())
    ]
    expected = changes(made.evaluations_as_found[0], made.evaluations[0])

    for path, values in (
        ("si:value", [each.value for each in expected]),
        (".//si:valueExpandedMU", [each.expanded_uncertainty for each in expected]),
    ):
        found = [
            float(each.text or "")
            for real in changed.iterfind(".//si:real", NAMES)
            for each in real.iterfind(path, NAMES)
        ]
        assert found == [unit.from_si(each) for each in values]


def test_a_parameter_has_the_interval_of_the_axis(tmp_path):
    made = certificate(tmp_path, KEYS)
    first = made.evaluations[0].parameters[0]
    root = ET.fromstring(registry().renderer("dcc").render(made))
    ends = root.findall(
        ".//dcc:results/dcc:result[1]//dcc:quantity[1]/dcc:measurementMetaData/dcc:metaData[2]//si:value",
        NAMES,
    )

    assert [float(each.text or "") for each in ends[:2]] == [each * 1e6 for each in first.axis_interval]


def read_back(
    made: Certificate, folder: Path, state: str = "as left", kind: str = "linear"
) -> MeasurementSet:
    content = registry().renderer("dcc").render(made)
    return File("dcc", folder / "x.xml").read(content, Axis("Y", AxisKind(kind)), state=state)


@pytest.mark.parametrize("keys", [KEYS, ROTARY], ids=["linear", "rotary"])
def test_its_readings_are_read_again_in_their_order(keys, tmp_path):
    made = certificate(tmp_path, keys)
    again = read_back(made, tmp_path, kind=made.measurements.axis.kind.value)

    for name in ("target", "approach", "run"):
        assert np.array_equal(getattr(again, name), getattr(made.measurements, name)), name
    np.testing.assert_allclose(again.deviation, made.measurements.deviation, rtol=1e-15)
    np.testing.assert_allclose(again.target_positions, made.measurements.target_positions, rtol=1e-15)


def test_times_conditions_and_missing_readings_come_back(tmp_path):
    table = tmp_path / "logged.csv"
    table.write_text(
        "target,direction,run,deviation,time,air_temperature,spindle load\n"
        "0,+,1,0.5,0,20.5,3\n10,+,1,,4,20.6,4\n10,-,1,1.5,8,20.7,5\n0,-,1,0.25,12,,6\n"
        "0,+,2,0.5,16,20.5,3\n10,+,2,0.75,20,20.6,4\n10,-,2,1.5,24,20.7,5\n0,-,2,0.25,28,20.8,6\n"
    )
    keys = having("measurement.source", {"plugin": "laser-csv", "file": str(table)}, KEYS)
    made = certificate(tmp_path, having("axis.travel", [0, 10], keys))
    again = read_back(made, tmp_path)

    assert again.missing() == made.measurements.missing() != ()
    assert again.time.tolist() == [0, 4, 8, 12, 16, 20, 24, 28]
    assert again.conditions.keys() == made.measurements.conditions.keys()
    for name, values in again.conditions.items():
        np.testing.assert_allclose(values, made.measurements.conditions[name], rtol=1e-15)


def test_readings_as_found_are_those_before_the_adjustment(both, tmp_path):
    made, *_ = both
    before = made.evaluations_as_found[0].measurements
    again = read_back(made, tmp_path, "as found")

    np.testing.assert_allclose(again.deviation, before.deviation, rtol=1e-15)


def test_a_dcc_without_readings_says_so(tmp_path):
    made = certificate(tmp_path, {**KEYS, "agreement": {"simplified": True}})
    with pytest.raises(InputError, match="carries no readings"):
        read_back(made, tmp_path)


def test_a_dcc_of_one_measurement_has_none_as_found(tmp_path):
    with pytest.raises(InputError, match="none as found"):
        read_back(certificate(tmp_path, KEYS), tmp_path, "as found")


def test_an_axis_of_another_kind_is_refused_with_the_cure(tmp_path):
    with pytest.raises(InputError, match=r"\\milli\\metre, this axis has \\degree; is axis\.kind right\?"):
        read_back(certificate(tmp_path, KEYS), tmp_path, kind="rotary")


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ("target,direction\n", "is no XML"),
        ("<page/>", "is no digital calibration certificate"),
        ('<!DOCTYPE a [<!ENTITY b "c">]><a>&b;</a>', "declares a document type"),
        ("<dcc:a", "is no XML"),
    ],
)
def test_what_is_no_dcc_is_refused(content, message, tmp_path):
    assert message in File("dcc", tmp_path / "x.xml").complaint(content)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("<si:valueXMLList>1.0 ", "<si:valueXMLList>2.0 ", "2 is no direction of approach"),
        ("zlmreport_run", "other", "lack the column zlmreport_run"),
        ("<si:valueXMLList>1.0 1.0", "<si:valueXMLList>1.0", "has 89 values for 90 readings"),
        ("<si:valueXMLList>1.0 1.0", "<si:valueXMLList>one 1.0", "could not convert string to float"),
    ],
)
def test_columns_that_do_not_fit_are_named(old, new, message, tmp_path):
    made = certificate(tmp_path, KEYS)
    content = registry().renderer("dcc").render(made).decode()
    assert old in content
    assert message in File("dcc", tmp_path / "x.xml").complaints(content.replace(old, new))[0]
