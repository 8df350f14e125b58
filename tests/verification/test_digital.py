"""Attached digital certificates against PTB's rules and a schema that the user names."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from document.certificate.documents import certificate
from installed import registry
from plugins.renderers.test_dcc import KEYS
from zlmreport.plugin import AccessError
from zlmreport.verification.attached import check_digital_certificates
from zlmreport.verification.findings import VerificationVerdict

#: Stands for PTB's schema, which is not part of this project: it lets everything in the root element pass.
LENIENT = """<schema xmlns="http://www.w3.org/2001/XMLSchema" targetNamespace="https://ptb.de/dcc">
<element name="digitalCalibrationCertificate"><complexType>
<sequence><any processContents="skip" maxOccurs="unbounded"/></sequence>
<attribute name="schemaVersion" fixed="{version}"/></complexType></element></schema>
"""


@pytest.fixture
def schema(tmp_path: Path) -> Path:
    return written(tmp_path, "3.3.0")


def written(folder: Path, version: str) -> Path:
    (folder / "dcc.xsd").write_text(LENIENT.format(version=version))
    return folder


def carried(folder: Path, **altered: str) -> dict[str, Any]:
    """One attached digital certificate, with passages of it replaced."""
    content = registry().renderer("dcc").render(certificate(folder, KEYS)).decode()
    for old, new in altered.items():
        content = content.replace(old, new)
    return {"CAL-1.xml": SimpleNamespace(content=content.encode(errors="surrogateescape"))}


def test_a_sound_one_holds_by_the_rules_and_by_the_schema(tmp_path, schema):
    found = list(check_digital_certificates(carried(tmp_path), schema))

    assert [(each.subject, each.verdict) for each in found] == [("CAL-1.xml", VerificationVerdict.HOLDS)] * 2


def test_one_that_breaks_a_rule_of_ptb_does_not_hold(tmp_path, schema):
    """Its measurement ends before it begins."""
    end = "<dcc:endPerformanceDate>2022-04-07"
    broken = carried(tmp_path, **{end: "<dcc:endPerformanceDate>1999-04-07"})
    rules, _ = check_digital_certificates(broken, schema)

    assert rules.verdict is VerificationVerdict.DIFFERS
    assert "not valid by PTB's rules" in rules.detail


def test_one_that_the_rules_cannot_be_held_against_does_not_hold(tmp_path, schema):
    """They calculate with a date that is none."""
    end = "<dcc:endPerformanceDate>2022-04-07"
    broken = carried(tmp_path, **{end: "<dcc:endPerformanceDate>2022-04-1e308"})
    rules, _ = check_digital_certificates(broken, schema)

    assert rules.verdict is VerificationVerdict.DIFFERS
    assert "not valid by PTB's rules: Invalid date" in rules.detail


def test_one_that_breaks_the_schema_does_not_hold_and_the_line_is_named(tmp_path):
    _, by_schema = check_digital_certificates(carried(tmp_path), written(tmp_path, "9.9.9"))

    assert by_schema.verdict is VerificationVerdict.DIFFERS
    assert "line 2" in by_schema.detail


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("</dcc:coreData>", "", "is not XML: "),
        ("<dcc:coreData>", "<dcc:coreData>\udcff", "is not XML: "),
        ("?>", '?><!DOCTYPE x [<!ENTITY e SYSTEM "file:///etc/hostname">]>', "declares a document type"),
    ],
)
def test_what_is_no_certificate_at_all_does_not_hold(old, new, said, tmp_path, schema):
    """No library gets it: one would end with an error of its own, or read what an entity names."""
    broken = carried(tmp_path, **{old: new})
    (found,) = check_digital_certificates(broken, schema)

    assert found.verdict is VerificationVerdict.DIFFERS
    assert found.detail.startswith(said)


def test_a_certificate_without_one_leaves_the_question_open(schema):
    (found,) = check_digital_certificates({"CAL-1.json": SimpleNamespace(content=b"{}")}, schema)

    assert found.verdict is VerificationVerdict.OPEN


def test_a_folder_without_the_schema_is_named(tmp_path):
    with pytest.raises(AccessError, match=r"holds no dcc\.xsd"):
        list(check_digital_certificates({}, tmp_path))
