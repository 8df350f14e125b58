"""The files that a PDF carries."""

from __future__ import annotations

from dataclasses import replace
from datetime import date
from hashlib import md5

import pytest
from pypdf import PdfReader

from document.typesetting import samples
from plugins.renderers.pdf_pages import ATTACHED, read, specifications


def printed(issued: date | None = date(2026, 11, 20)) -> PdfReader:
    return read(replace(samples.certificate(standards=0), attachments=ATTACHED, issued=issued))


@pytest.fixture(scope="module")
def reader() -> PdfReader:
    return printed()


def test_a_file_has_its_size_and_checksum(reader: PdfReader) -> None:
    parameters = specifications(reader)["job.yaml"]["/EF"]["/F"]["/Params"]
    assert parameters["/Size"] == len(b"axis: {}\n")
    assert parameters["/CheckSum"].original_bytes == md5(b"axis: {}\n", usedforsecurity=False).digest()


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
    reader = read(samples.certificate(standards=0))
    assert "/AF" not in reader.root_object
    assert "/EmbeddedFiles" not in reader.root_object.get("/Names", {})
