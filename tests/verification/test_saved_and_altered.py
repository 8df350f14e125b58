"""What somebody alters in the files of a certificate is told; what programs on its way do is not."""

from __future__ import annotations

import json
from collections.abc import Callable
from io import BytesIO
from typing import Any

import pikepdf
import pytest
from pypdf import PdfWriter
from pypdf.generic import BooleanObject, NameObject, TextStringObject

from verification.issued import (
    NUMBER,
    altered,
    content_of,
    specification,
    with_attachment,
    with_results,
    with_source,
)
from zlmreport.verification.findings import CheckedCertificate, VerificationOutcome, VerificationVerdict

Verify = Callable[[bytes], CheckedCertificate]
Change = Callable[[bytes], bytes]
RESULTS = f"{NUMBER}.json"


def state(**changes: Any) -> Change:
    """Return what states something else of the first parameter."""
    return lambda pdf: with_results(pdf, lambda results: _find_parameters(results)[0].update(changes))


def change_results(change: Callable[[dict[str, Any]], object]) -> Change:
    return lambda pdf: with_results(pdf, lambda results: (change(results), None)[1])


def encode(write: Callable[[bytes], bytes]) -> Change:
    return lambda pdf: with_attachment(pdf, RESULTS, write(content_of(pdf, RESULTS)))


def rewrite(name: str, write: Callable[[bytes], bytes]) -> Change:
    """Return what changes a file, and states its new digest."""
    return lambda pdf: with_source(pdf, name, write(content_of(pdf, name)))


def describe(change: Callable[[Any], object]) -> Change:
    """Return what changes the entry of the readings."""
    return lambda pdf: altered(pdf, lambda writer: (change(specification(writer, "x-axis.csv")), None)[1])


def _find_parameters(results: dict[str, Any]) -> list[dict[str, Any]]:
    found: list[dict[str, Any]] = results["evaluations"][0]["parameters"]
    return found


def _raise_a_mean(results: dict[str, Any]) -> None:
    position = results["evaluations"][0]["positions"][1]
    position["mean"] *= 1 + 1e-8


ALTERED: dict[str, Change] = {
    "a remark among the results": change_results(lambda results: results.update(note="passed")),
    "a remark on a parameter": state(remark="good"),
    "a key that differs by a capital": state(Value=0.1),
    "a unit": state(unit="mm"),
    "a name": state(name="Best accuracy"),
    "a limit by a millionth": state(limit=20.000001),
    "a one for true": state(conforms=1),
    "no uncertainty": change_results(
        lambda results: [each.pop("expanded_uncertainty", None) for each in _find_parameters(results)]
    ),
    "another order": change_results(lambda results: _find_parameters(results).reverse()),
    "an evaluation twice": change_results(
        lambda results: results["evaluations"].append(results["evaluations"][0])
    ),
    "a mean by its eighth digit": change_results(_raise_a_mean),
    "an uncertainty that is called complete": change_results(
        lambda results: results["uncertainty"].update(state="complete", missing=[])
    ),
    "the day of issue": change_results(lambda results: results["certificate"].update(issued="2026-11-21")),
    "another schema": change_results(lambda results: results.update(schema="zlmreport/results/2")),
    "other blanks": encode(lambda content: json.dumps(json.loads(content), indent=3).encode()),
    "something behind the results": encode(lambda content: content + b" {}"),
    "a mark of the order of bytes": encode(lambda content: b"\xef\xbb\xbf" + content),
    "another encoding": encode(lambda content: content.decode().encode("utf-16")),
    "a comment in the readings": rewrite("x-axis.csv", lambda content: b"# by PTB\n" + content),
    "other ends of lines": rewrite("x-axis.csv", lambda content: content.replace(b"\n", b"\r\n")),
    "a comment in the job": rewrite("job.yaml", lambda content: content + b"# approved\n"),
    "a relationship": describe(
        lambda entry: entry.update({NameObject("/AFRelationship"): NameObject("/Alternative")})
    ),
    "a media type": describe(
        lambda entry: entry["/EF"]["/F"].update({NameObject("/Subtype"): NameObject("/text#2Fplain")})
    ),
    "a day of the readings": describe(
        lambda entry: entry["/EF"]["/F"]["/Params"].update(
            {NameObject("/ModDate"): TextStringObject("D:20200101000000Z")}
        )
    ),
    "a file that may change": describe(
        lambda entry: entry.update({NameObject("/V"): BooleanObject(value=True)})
    ),
    "files that belong to nothing": lambda pdf: altered(
        pdf, lambda writer: (writer.root_object.pop("/AF"), None)[1]
    ),
}


@pytest.mark.long
@pytest.mark.parametrize("name", ALTERED)
def test_what_somebody_alters_in_results_and_files_is_told(
    name: str, issued: bytes, verified: Verify
) -> None:
    found = verified(ALTERED[name](issued))
    assert found.outcome is VerificationOutcome.DOES_NOT_HOLD
    told = (*found.files, *found.values, *found.pages, *found.document)
    assert any(each.verdict is VerificationVerdict.DIFFERS for each in told)


def save(**options: Any) -> Change:
    """Return what saves a file as qpdf does."""

    def saved(pdf: bytes) -> bytes:
        kept = BytesIO()
        with pikepdf.open(BytesIO(pdf)) as opened:
            opened.save(kept, **options)
        return kept.getvalue()

    return saved


def _append_nothing(pdf: bytes) -> bytes:
    writer, saved = PdfWriter(BytesIO(pdf), incremental=True), BytesIO()
    writer.write(saved)
    return saved.getvalue()


HARMLESS: dict[str, Change] = {
    "an end of line by a mail": lambda pdf: pdf + b"\r\n",
    "zeros that fill a block of a transfer": lambda pdf: pdf + bytes(512),
    "no last end of line": lambda pdf: pdf.rstrip(b"\n"),
    "packed objects": save(object_stream_mode=pikepdf.ObjectStreamMode.generate),
    "nothing packed": save(
        object_stream_mode=pikepdf.ObjectStreamMode.disable,
        compress_streams=False,
        stream_decode_level=pikepdf.StreamDecodeLevel.generalized,
    ),
    "packed anew": save(recompress_flate=True),
    "an identifier of its bytes": save(deterministic_id=True),
    "a later version": save(min_version="2.0"),
    "an earlier version": save(force_version="1.4"),
    "saved by pypdf": lambda pdf: altered(pdf, lambda _: None),
    "nothing appended": _append_nothing,
}


@pytest.mark.long
@pytest.mark.parametrize("name", HARMLESS)
def test_what_programs_on_its_way_do_to_a_certificate_changes_nothing(
    name: str, issued: bytes, verified: Verify
) -> None:
    assert verified(HARMLESS[name](issued)).outcome is VerificationOutcome.HOLDS
