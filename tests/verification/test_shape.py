"""What stands in a file beside its pages, from the catalog alone."""

from __future__ import annotations

from types import SimpleNamespace

import pytest
from pypdf.generic import DictionaryObject, NameObject, NumberObject

from zlmreport.verification.shape import find_strangers


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
