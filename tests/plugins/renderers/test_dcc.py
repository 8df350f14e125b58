"""The digital calibration certificate: valid, and with the numbers of the results file."""

from __future__ import annotations

import json
import os
import re
from collections.abc import Iterator, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any
from xml.etree import ElementTree as ET

import pytest

from document.certificate.documents import COMPLETE, certificate
from installed import registry
from refusals import messages
from zlmreport.plugin.renderer import Certificate, Decision
from zlmreport.plugin.standard import Conformity

NAMES = {"dcc": "https://ptb.de/dcc", "si": "https://ptb.de/si"}
#: PTB's schema is not part of this project: who has its folder names it here (dcc.xsd, DCC 3.3.0).
SCHEMA = os.environ.get("ZLMREPORT_DCC_SCHEMA")

KEYS: Mapping[str, Any] = {
    **COMPLETE,
    "laboratory": {**COMPLETE["laboratory"], "country": "DE"},
    "decision_rule": "guard-band",
    "environment": {
        "air_temperature": 20.5,
        "axis_temperature": 20,
        "air_pressure": "about 1013 hPa",
        "remarks": "sun & wind <calm>",
    },
}
GERMAN: Mapping[str, Any] = {**KEYS, "certificate": {**KEYS["certificate"], "language": "de"}}
REPLACING: Mapping[str, Any] = {
    **KEYS,
    "certificate": {
        **KEYS["certificate"],
        "amends": {"number": "CAL-0", "reason": "Wrong serial number.", "kind": "replacement"},
    },
}
REPAIRED: Mapping[str, Any] = {
    **KEYS,
    "as_found": {"work": "repair", "adjustment": "New nut.", "measurement": KEYS["measurement"]},
}
ROTARY: Mapping[str, Any] = {**KEYS, "axis": {"name": "C", "kind": "rotary"}}


def document(folder: Path, keys: Mapping[str, Any] = KEYS) -> ET.Element:
    return ET.fromstring(registry().renderer("dcc").render(certificate(folder, keys)))


def text(root: ET.Element, path: str) -> str:
    found = root.find(path, NAMES)
    assert found is not None, path
    return "".join(found.itertext()).strip()


def values(root: ET.Element) -> Iterator[tuple[str, float, str]]:
    """The labelled values of the first standard: symbol, value, unit."""
    result = root.find(".//dcc:measurementResult/dcc:results/dcc:result", NAMES)
    for real in result.iterfind("dcc:data/dcc:list/dcc:quantity/si:real", NAMES):
        yield text(real, "si:label"), float(text(real, "si:value")), text(real, "si:unit")


@pytest.mark.parametrize(
    "keys",
    [KEYS, GERMAN, REPLACING, ROTARY, REPAIRED],
    ids=["english", "german", "replacement", "rotary", "repaired"],
)
class TestValid:
    """Against the independent checks of PTB."""

    def test_by_the_schematron_rules(self, keys, tmp_path):
        from dcclib.validation.schematron import SchematronValidator

        written = ET.tostring(document(tmp_path, keys), encoding="unicode")
        found = SchematronValidator.for_dcc().validate_str(written)

        errors = [each.text for each in found.successful_reports if each.role == "error"]
        assert found.failed_assertions == []
        assert errors == []

    @pytest.mark.skipif(SCHEMA is None, reason="ZLMREPORT_DCC_SCHEMA names no folder with PTB's schema")
    def test_by_the_schema(self, keys, tmp_path):
        from lxml import etree

        schema = etree.XMLSchema(etree.parse(str(Path(str(SCHEMA)) / "dcc.xsd")))
        schema.assertValid(etree.fromstring(ET.tostring(document(tmp_path, keys))))


def test_a_document_that_lacks_its_identifier_is_not_valid(tmp_path):
    """The checks above can fail."""
    from dcclib.validation.schematron import SchematronValidator

    root = document(tmp_path)
    end = root.find(".//dcc:endPerformanceDate", NAMES)
    end.text = "1999-01-01"
    found = SchematronValidator.for_dcc().validate_str(ET.tostring(root, encoding="unicode"))

    assert found.failed_assertions or [each for each in found.successful_reports if each.role == "error"]


def test_its_parameters_are_those_of_the_results_file(tmp_path):
    made = certificate(tmp_path, KEYS)
    results = json.loads(registry().renderer("json").render(made))["evaluations"][0]["parameters"]
    written = list(values(ET.fromstring(registry().renderer("dcc").render(made))))

    assert written == [(each["symbol"], each["value"], r"\micro\metre") for each in results]


def test_its_deviations_by_target_are_those_of_the_results_file(tmp_path):
    made = certificate(tmp_path, KEYS)
    rows = json.loads(registry().renderer("json").render(made))["evaluations"][0]["positions"]
    root = ET.fromstring(registry().renderer("dcc").render(made))
    lists = [
        [float(value) for value in each.text.split()]
        for each in root.iterfind(".//dcc:measurementResult[1]//si:realListXMLList/si:valueXMLList", NAMES)
    ]

    assert lists[1] == [row["mean_fwd"] for row in rows]
    assert lists[2] == [row["mean_bwd"] for row in rows]
    assert lists[0] == pytest.approx([row["target"] for row in rows], rel=1e-15)


def test_the_mean_deviations_have_the_uncertainties_of_the_results_file(tmp_path):
    made = certificate(tmp_path, KEYS)
    unit = made.measurements.axis.deviation_unit
    uncertain = made.evaluations[0].mean_uncertainty
    root = ET.fromstring(registry().renderer("dcc").render(made))
    first = root.find(".//dcc:measurementResult[1]//si:valueExpandedMUXMLList", NAMES)

    written = [float(each) for each in (first.text or "").split()]
    assert written == unit.from_si(uncertain.by_approach[0]).tolist()


def test_the_uncertainty_stands_with_its_factor_and_its_probability(tmp_path):
    made = certificate(tmp_path, KEYS)
    first, *others = made.evaluations[0].parameters
    known = replace(first, expanded_uncertainty=1.5e-6, coverage_factor=2.0)
    root = ET.fromstring(registry().renderer("dcc").render(_with_parameters(made, (known, *others))))

    stated = root.find(".//si:measurementUncertaintyUnivariate/si:expandedMU", NAMES)
    assert stated is not None
    assert [float(each.text or "") for each in stated] == pytest.approx([1.5, 2.0, 0.9545], rel=1e-12)


@pytest.mark.parametrize(
    ("conformity", "word"),
    [
        (Conformity.MET, "pass"),
        (Conformity.CONDITIONALLY_MET, "conditionalPass"),
        (Conformity.CONDITIONALLY_FAILED, "conditionalFail"),
        (Conformity.FAILED, "fail"),
    ],
)
def test_what_is_stated_of_a_limit(conformity, word, tmp_path):
    made = certificate(tmp_path, KEYS)
    first, *others = made.evaluations[0].parameters
    decided = replace(first, limit=10e-6, decision=Decision(conformity, 8e-6, 8e-6, 0.01))
    root = ET.fromstring(registry().renderer("dcc").render(_with_parameters(made, (decided, *others))))

    assert text(root, ".//dcc:metaData/dcc:conformity") == word
    limits = root.findall(".//dcc:metaData[@refType='basic_conformity']/dcc:data//si:value", NAMES)
    assert [float(each.text or "") for each in limits[:2]] == pytest.approx([10.0, 8.0], rel=1e-12)


def test_what_is_not_decided_is_neither_pass_nor_fail(tmp_path):
    made = certificate(tmp_path, KEYS)
    first, *_ = made.evaluations[0].parameters
    undecided = replace(first, limit=10e-6, decision=Decision(Conformity.UNDECIDED, None, None, None))
    root = ET.fromstring(registry().renderer("dcc").render(_with_parameters(made, (undecided,))))

    assert root.find(".//dcc:measurementResult/dcc:results//dcc:conformity", NAMES) is None
    assert text(root, ".//dcc:metaData[@refType='basic_conformity']/dcc:declaration") == "not decided"


def test_a_value_of_a_condition_has_its_unit_and_words_stay_words(tmp_path):
    root = document(tmp_path)
    conditions = {
        text(each, "dcc:name"): each
        for each in root.iterfind(".//dcc:measurementResult[1]//dcc:influenceCondition", NAMES)
    }

    assert text(conditions["Air temperature"], ".//si:value") == "20.5"
    assert text(conditions["Air temperature"], ".//si:unit") == r"\degreecelsius"
    assert text(conditions["Air pressure"], "dcc:data/dcc:text") == "about 1013 hPa"
    assert text(conditions["Remarks on the environment"], "dcc:data/dcc:text") == "sun & wind <calm>"


def test_a_rotary_axis_is_in_degrees_and_seconds_of_arc(tmp_path):
    root = document(tmp_path, ROTARY)
    results = root.findall(".//dcc:results/dcc:result", NAMES)[:2]
    units = {each.text for one in results for each in one.iterfind(".//si:unitXMLList", NAMES)}

    assert units == {r"\degree", r"\arcsecond"}
    assert {unit for _, _, unit in values(root)} == {r"\arcsecond"}


def test_a_replacement_names_the_document_that_it_replaces(tmp_path):
    root = document(tmp_path, REPLACING)

    assert text(root, ".//dcc:typeOfChange") == "substituted"
    assert text(root, ".//dcc:replacedUniqueIdentifier") == "CAL-0"


def test_its_language_is_that_of_the_certificate(tmp_path):
    root = document(tmp_path, GERMAN)

    assert text(root, ".//dcc:usedLangCodeISO639_1") == "de"
    assert {each.get("lang") for each in root.iterfind(".//dcc:content", NAMES)} == {"de", None}


def test_an_axis_as_found_and_as_left_is_told_apart_by_its_state(tmp_path):
    root = document(tmp_path, REPAIRED)
    states = [
        text(each, "dcc:influenceConditions/dcc:influenceCondition/dcc:status")
        for each in root.iterfind(".//dcc:measurementResult", NAMES)
    ]

    assert states == ["beforeRepair", "afterRepair"]


def test_the_place_of_work_is_the_one_on_the_cover(tmp_path):
    inside = {**KEYS, "location": {"kind": "laboratory"}}

    assert text(document(tmp_path), ".//dcc:performanceLocation") == "customer"
    assert text(document(tmp_path, inside), ".//dcc:performanceLocation") == "laboratory"


def test_everything_that_a_dcc_must_state_is_demanded_at_once(tmp_path):
    keys = {name: value for name, value in KEYS.items() if name not in {"laboratory", "customer", "machine"}}
    keys["certificate"] = {"number": "R-1", "kind": "report"}
    made = certificate(tmp_path, keys)
    said = messages(registry().renderer("dcc").render, made)
    for key in (
        "laboratory.name",
        "laboratory.country",
        "customer.name",
        "machine.serial",
        "certificate.authorised_by",
    ):
        assert any(f"must state {key}" in message for message in said), key


def test_characters_that_xml_cannot_hold_become_visible(tmp_path):
    made = certificate(tmp_path, KEYS)
    machine = made.job.keys.machine.model_copy(update={"model": "M\x00\x1b1"})
    keys = made.job.keys.model_copy(update={"machine": machine})
    root = ET.fromstring(registry().renderer("dcc").render(replace(made, job=replace(made.job, keys=keys))))

    assert text(root, ".//dcc:item/dcc:model") == "M\ufffd\ufffd1"


def _with_parameters(made: Certificate, parameters: tuple[Any, ...]) -> Certificate:
    return replace(made, evaluations=(replace(made.evaluations[0], parameters=parameters),))


def test_in_french_a_space_stands_before_a_colon_and_a_semicolon(tmp_path):
    french = {**KEYS, "certificate": {**KEYS["certificate"], "language": "fr"}}
    statements = document(tmp_path, french).findall(".//dcc:statement//dcc:content", NAMES)
    texts = ["".join(each.itertext()) for each in statements]
    # In formulas semicolons part arguments: max(a; b).
    bare = [each for each in texts if re.search(r"\S[:;?!](?= |$)", each) and "max(" not in each]

    assert bare == []
    assert any(each.startswith("Axe : Y") for each in texts)
    assert any(" ; Résultat : " in each for each in texts)
