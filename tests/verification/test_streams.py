"""Streams are unpacked as they are, and not further than is allowed."""

from __future__ import annotations

import zlib

import pytest
from pypdf.generic import ArrayObject, DecodedStreamObject, EncodedStreamObject, NameObject

from zlmreport.verification.carrier import DamagedError, TooLargeError, unpack

TEXT = b"0 0 m 10 10 l S\n" * 100


def packed(data: bytes, *filters: str) -> EncodedStreamObject:
    stream = EncodedStreamObject()
    stream._data = data
    names = [NameObject(each) for each in filters]
    stream[NameObject("/Filter")] = names[0] if len(names) == 1 else ArrayObject(names)
    return stream


def test_a_packed_stream_is_unpacked() -> None:
    assert unpack(packed(zlib.compress(TEXT), "/FlateDecode"), 10_000) == TEXT


def test_a_stream_that_is_not_packed_is_what_it_is() -> None:
    stream = DecodedStreamObject()
    stream.set_data(TEXT)
    assert unpack(stream, 10_000) == TEXT


def test_a_stream_that_is_packed_twice_is_unpacked_twice() -> None:
    twice = zlib.compress(zlib.compress(TEXT))
    assert unpack(packed(twice, "/FlateDecode", "/FlateDecode"), 10_000) == TEXT


@pytest.mark.parametrize(
    "data", [zlib.compress(TEXT)[:-1], zlib.compress(TEXT)[:-3] + b"\0\0\0", b"text", b""]
)
def test_a_damaged_stream_is_not_mended(data: bytes) -> None:
    with pytest.raises(DamagedError):
        unpack(packed(data, "/FlateDecode"), 10_000)


@pytest.mark.parametrize("most", [0, 1, len(TEXT) - 1])
def test_a_stream_that_is_too_large_is_refused(most: int) -> None:
    with pytest.raises(TooLargeError):
        unpack(packed(zlib.compress(TEXT), "/FlateDecode"), most)


def test_a_stream_may_be_as_large_as_is_allowed() -> None:
    assert len(unpack(packed(zlib.compress(TEXT), "/FlateDecode"), len(TEXT))) == len(TEXT)


def test_a_stream_that_is_packed_otherwise_is_bounded_too() -> None:
    run = b"\x81" + b"\0"  # 128 times the same byte
    with pytest.raises(TooLargeError):
        unpack(packed(run * 1000 + b"\x80", "/RunLengthDecode"), 1000)
