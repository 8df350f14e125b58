"""What a certificate would lack is asked for, field by field, and then nothing stands against it."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from starlette.testclient import TestClient

from installed import registry
from zlmreport import pipeline
from zlmreport.job.loading import load

_GROUPS = ("laboratory:", "customer:", "machine:", "authorised_by:")
_REASON = "laser, no length of its own"
_STATED = {"text": "As on the order: no. 7", "date": "2026-11-20", "number": 0.5}
_OF_ITS_OWN = {"environment.axis_temperature": 20.4, "environment.expansion_coefficient": 11.5}


@pytest.fixture
def certificate(job: Path) -> Path:
    """Make the job one of a certificate, which it cannot be yet, and take away what it states of people."""
    lines = job.read_text(encoding="utf-8").splitlines(keepends=True)
    kept = [each for each in lines if not each.lstrip().startswith(_GROUPS)]
    job.write_text("".join(kept).replace("kind: report", "kind: certificate"), encoding="utf-8")
    return job


def _lacking(browser: TestClient) -> list[dict[str, Any]]:
    found: list[dict[str, Any]] = browser.get("/api/results?lang=en").json()["lacking"]
    return found


def _value(field: dict[str, Any]) -> dict[str, Any]:
    if field["form"] == "place":
        return {f"{field['key']}.kind": "customer"}
    if "device" in field["key"]:
        return {field["reason"]: _REASON}
    return {field["key"]: _OF_ITS_OWN.get(field["key"], _STATED[field["form"]])}


def test_a_report_lacks_nothing(browser: TestClient) -> None:
    assert _lacking(browser) == []


@pytest.mark.long
def test_what_is_asked_for_makes_the_job_a_certificate(certificate: Path, browser: TestClient) -> None:
    fields = {each["key"]: each for each in _lacking(browser)}
    assert fields["customer.name"]["name"] == "Customer"
    assert fields["uncertainty.misalignment"]["unit"] == "mm"
    assert fields["environment.axis_temperature"]["unit"] == "°C"
    assert {"laboratory.name", "location", "certificate.issued", "instrument.certificate"} <= set(fields)
    stated: dict[str, Any] = {}
    for each in fields.values():
        stated |= _value(each)
    digest = browser.get("/api/job").json()["digest"]
    answer = browser.post("/api/change", json={"based_on": digest, "action": "state", "stated": stated})
    assert answer.status_code == 200, answer.text
    assert _lacking(browser) == []
    assert pipeline.compose(load(certificate, registry()), registry()), "which refuses what lacks anything"


def test_a_part_can_be_stated_first(certificate: Path, browser: TestClient) -> None:
    before = {each["key"] for each in _lacking(browser)}
    digest = browser.get("/api/job").json()["digest"]
    stated = {"customer.name": "Example Customer Ltd", "location.kind": "laboratory"}
    assert browser.post(
        "/api/change", json={"based_on": digest, "action": "state", "stated": stated}
    ).is_success
    assert {each["key"] for each in _lacking(browser)} == before - {"customer.name", "location"}
    assert "location: {kind: laboratory}" in certificate.read_text(encoding="utf-8")


def test_what_makes_no_sense_is_refused_with_its_key(certificate: Path, browser: TestClient) -> None:
    kept = certificate.read_bytes()
    digest = browser.get("/api/job").json()["digest"]
    stated = {"certificate.issued": "last Tuesday", "uncertainty.misalignment": -1}
    answer = browser.post("/api/change", json={"based_on": digest, "action": "state", "stated": stated})
    problems = " ".join(answer.json()["problems"])
    assert answer.status_code == 422
    assert "issued" in problems
    assert "misalignment" in problems
    assert certificate.read_bytes() == kept
