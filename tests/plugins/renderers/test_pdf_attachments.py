"""The files that a PDF carries."""

from __future__ import annotations

from dataclasses import replace
from datetime import date
from hashlib import md5
from io import BytesIO

import pytest
from pypdf import PdfReader
from pypdf.generic import DictionaryObject

from document.typesetting import samples
from installed import registry
from zlmreport.plugin.renderer import Attachment, Relationship

ATTACHED = (
    Attachment("CAL-1.json", b"{}\n", "application/json", Relationship.DATA, "Results file"),
    Attachment("CAL-1.xml", b"<dcc/>\n", "application/xml", Relationship.ALTERNATIVE, "DCC"),
    Attachment("job.yaml", b"axis: {}\n", "application/yaml", Relationship.SOURCE, "Job: job.yaml"),
    Attachment("Prüfung ↑.csv", b"\x00\xff", "text/csv", Relationship.SOURCE, "Messwerte: Prüfung ↑.csv"),
)


def printed(issued: date | None = date(2026, 11, 20)) -> PdfReader:
    certificate = replace(samples.certificate(standards=0), attachments=ATTACHED, issued=issued)
    return PdfReader(BytesIO(registry().renderer("pdf").render(certificate)))


@pytest.fixture(scope="module")
def reader() -> PdfReader:
    return printed()


def specifications(reader: PdfReader) -> dict[str, DictionaryObject]:
    listed = reader.root_object["/Names"]["/EmbeddedFiles"]["/Names"]
    return {each.get_object()["/UF"]: each.get_object() for each in listed[1::2]}


@pytest.mark.parametrize("attached", ATTACHED, ids=lambda each: each.name)
def test_a_file_is_carried_byte_for_byte_and_described(reader: PdfReader, attached: Attachment) -> None:
    entry = specifications(reader)[attached.name]
    stream = entry["/EF"]["/F"]
    assert stream.get_data() == attached.content
    assert stream["/Subtype"] == f"/{attached.media_type}"
    assert entry["/AFRelationship"] == f"/{attached.relationship.value}"
    assert entry["/Desc"] == attached.description


def test_a_file_has_its_size_and_checksum(reader: PdfReader) -> None:
    parameters = specifications(reader)["job.yaml"]["/EF"]["/F"]["/Params"]
    assert parameters["/Size"] == len(b"axis: {}\n")
    assert parameters["/CheckSum"].original_bytes == md5(b"axis: {}\n", usedforsecurity=False).digest()


def test_each_file_is_associated_with_the_document_once(reader: PdfReader) -> None:
    associated = [each.get_object()["/UF"] for each in reader.root_object["/AF"]]
    assert sorted(associated) == sorted(each.name for each in ATTACHED)


@pytest.mark.parametrize(
    ("issued", "moment"), [(date(2026, 11, 20), "D:20261120000000Z"), (None, "D:19700101000000Z")]
)
def test_dates_of_files_come_from_the_certificate_and_not_from_the_clock(
    issued: date | None, moment: str
) -> None:
    for entry in specifications(printed(issued)).values():
        parameters = entry["/EF"]["/F"]["/Params"]
        assert (parameters["/CreationDate"], parameters["/ModDate"]) == (moment, moment)


def test_without_files_there_is_no_list_of_them() -> None:
    reader = PdfReader(BytesIO(registry().renderer("pdf").render(samples.certificate(standards=0))))
    assert "/AF" not in reader.root_object
    assert "/EmbeddedFiles" not in reader.root_object.get("/Names", {})
