"""The raw bytes of a PDF against its tables: what is sound is read, and nothing else."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path
from time import process_time
from types import SimpleNamespace

import pytest
from pikepdf import String
from pypdf.generic import DictionaryObject, NameObject, NumberObject

from verification.altering import rewritten
from verification.forgeries import plain
from verification.issued import altered
from verification.raw_forgeries import objects, together, with_packed_table
from verification.test_trust import signed
from zlmreport.verification import table
from zlmreport.verification.findings import VerificationVerdict
from zlmreport.verification.shape import find_strangers
from zlmreport.verification.table import check_table, scan
from zlmreport.verification.tokens import OddError, PdfName, Reference, read_object, read_value


@pytest.mark.parametrize("printed", ["issued", "by_typst"])
@pytest.mark.parametrize(
    "saved",
    [
        lambda pdf: pdf,
        plain,
        lambda pdf: rewritten(pdf, lambda _: None),
        lambda pdf: altered(pdf, lambda _: None),
        lambda pdf: with_packed_table(pdf, repeated=False),
    ],
    ids=["as issued", "plain", "packed", "by pypdf", "table packed by hand"],
)
def test_a_sound_file_is_read_from_its_first_to_its_last_byte(
    printed: str, saved: Callable[[bytes], bytes], request: pytest.FixtureRequest
) -> None:
    assert (
        check_table(saved(request.getfixturevalue(printed)), is_signed=False).verdict
        is VerificationVerdict.HOLDS
    )


@pytest.mark.parametrize("printed", ["issued", "by_typst"])
def test_a_signature_may_add_a_revision_and_nothing_else_may(
    printed: str, request: pytest.FixtureRequest, tmp_path: Path
) -> None:
    pdf = signed(request.getfixturevalue(printed), tmp_path)
    assert check_table(pdf, is_signed=True).verdict is VerificationVerdict.HOLDS
    assert "no signature" in str(check_table(pdf, is_signed=False).detail)


def with_free_numbers(pdf: bytes, *numbers: int) -> bytes:
    """Return a PDF whose table has sections of one free number each behind its own."""
    whole = plain(pdf)
    at = whole.rindex(b"trailer")
    sections = b"".join(b"%d 1\n0000000000 65535 f \n" % each for each in numbers)
    end = re.sub(rb"/Size \d+", b"/Size %d" % (numbers[-1] + 1), whole[at:])
    return whole[:at] + sections + end


def test_a_number_that_is_far_off_takes_no_memory_for_those_before_it(issued: bytes) -> None:
    found = check_table(with_free_numbers(issued, 9_999_999_998), is_signed=False)
    assert found.detail == "its table leaves numbers out"


def test_many_sections_take_no_more_time_than_their_bytes(issued: bytes) -> None:
    size = int(re.findall(rb"/Size (\d+)", plain(issued))[-1])
    forged = with_free_numbers(issued, *range(size, size + 50_000))
    begun = process_time()
    assert check_table(forged, is_signed=False).verdict is VerificationVerdict.HOLDS
    assert process_time() - begun < 5  # it took ten times as long when each was held against all before it


def test_a_packed_table_of_more_objects_than_any_certificate_is_not_unpacked(
    issued: bytes, monkeypatch: pytest.MonkeyPatch
) -> None:
    packed = with_packed_table(issued, repeated=False)
    monkeypatch.setattr(table, "_MOST_OBJECTS", len(re.findall(rb"\d+ 0 obj\b", packed)) - 1)
    found = check_table(packed, is_signed=False)
    assert found.detail == "it holds more objects than any certificate"


def _with_producer(whole: bytes, text: str) -> bytes:
    return plain(rewritten(whole, lambda pdf: pdf.docinfo.__setitem__("/Producer", String(text))))


@pytest.mark.parametrize(
    ("change", "told"),
    [
        (
            lambda whole: together(whole, trailer=lambda end: re.sub(rb"/Size \d+", b"/Size 9", end)),
            "its table states another number of objects than there are",
        ),
        (
            lambda whole: whole.replace(b" 00000 n \n", b" 00000 f \n", 1),
            "object 1 is free by the table, and stands there",
        ),
        (
            lambda whole: re.sub(rb"\d{10} 00000 n ", b"0000000007 00000 n ", whole, count=1),
            "object 1 is not where the table says",
        ),
        (
            lambda whole: whole.replace(b"\n1 0 obj", b"\n1 1 obj", 1),
            "object 1 stands there in another generation",
        ),
        (
            lambda whole: together(whole, objects(whole)[1]),
            "object 1 (the catalog) stands there twice, and",
        ),
        (lambda whole: _with_producer(whole, "endobj"), "endobj stands there where it marks nothing"),
        (lambda whole: _with_producer(whole, "%PDF-"), "%PDF- stands there where it marks nothing"),
        (lambda whole: _with_producer(whole, "\n9 0 obj"), "an object that is none begins at byte "),
    ],
)
def test_a_table_that_is_not_that_of_the_objects_is_told(
    change: Callable[[bytes], bytes], told: str, issued: bytes
) -> None:
    assert str(check_table(change(plain(issued)), is_signed=False).detail).startswith(told)


@pytest.mark.long
def test_every_byte_between_objects_counts(issued: bytes) -> None:
    """A byte that is put anywhere into the file is found: by its place, or by the place of what follows."""
    whole = plain(issued)
    step = len(whole) // 97
    for at in range(0, len(whole), step):
        with pytest.raises(OddError):
            scan(whole[:at] + b"%" + whole[at:], is_signed=False)


@pytest.mark.parametrize(
    ("text", "value"),
    [
        (b"<< /A 1 /B [ 2 0 R (a\\)b(c)) ] >>", {b"A": 1, b"B": [Reference(2, 0), b"(a\\)b(c))"]}),
        (b"/A#42", PdfName(b"AB")),
        (b"[-.5 +3 true null <41 42>]", [-0.5, 3, True, None, b"<41 42>"]),
    ],
)
def test_objects_are_read_as_the_standard_writes_them(text: bytes, value: object) -> None:
    assert read_value(text, 0) == (value, len(text))


@pytest.mark.parametrize(
    "text",
    [
        b"<< /A 1 /A 2 >>",
        b"<< /A 1 /#41 2 >>",
        b"<< (A) 1 >>",
        b"[1 2",
        b"(a",
        b"--1",
        b"1e5",
        b"% a comment\n1",
        b"[" * 5000,
        b"<4G>",
        b"",
    ],
)
def test_what_two_readers_might_take_differently_is_no_object(text: bytes) -> None:
    with pytest.raises(OddError):
        read_value(text, 0)


_NO_END = "object 1 has no end, or data of a length that it does not state"


@pytest.mark.parametrize(
    ("text", "told"),
    [
        (b"1 0 obj 5 6 endobj", _NO_END),
        (
            b"1 0 obj << /Length 3 >> stream\nabcd\nendstream endobj",
            "the data of object 1 are not as long as it states",
        ),
        (b"1 0 obj << /Length 2 0 R >> stream\nabcd\nendstream\nendobj", _NO_END),
        (b"1 0 obj << >> stream\nabcd\nendstream\nendobj", _NO_END),
        (b"01 0 obj 5 endobj", "no object begins at byte 0"),
        (b"1 0 obj 5", _NO_END),
    ],
)
def test_an_object_ends_where_it_says(text: bytes, told: str) -> None:
    with pytest.raises(OddError, match=f"^{told}$"):
        read_object(text, 0)


def told(key: str, *, is_signed: bool) -> list[str]:
    """Return what is said of a catalog with an entry that is none of a signature."""
    value = DictionaryObject({NameObject("/Other"): NumberObject(1)})
    reader = SimpleNamespace(trailer={"/Root": DictionaryObject({NameObject(key): value})})
    return list(find_strangers(reader, is_signed=is_signed))


@pytest.mark.parametrize("key", ["/AcroForm", "/DSS", "/Perms", "/Extensions", "/Version"])
def test_what_only_a_signature_brings_is_strange_without_one(key: str) -> None:
    assert told(key, is_signed=False) == [f"the catalog has {key}, and the file is not signed"]


@pytest.mark.parametrize("key", ["/AcroForm", "/DSS", "/Perms"])
def test_what_no_signature_brings_is_strange_beside_one(key: str) -> None:
    assert told(key, is_signed=True) == [f"the catalog's {key} is none of a signature"]
