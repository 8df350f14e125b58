"""A standard goes by the names of adoptions of which it is published that they are identical."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from document.certificate.documents import COMPLETE, certificate, having, job, text_of
from installed import registry
from zlmreport import pipeline
from zlmreport.plugin import InputError


def of(*standards: Any) -> dict[str, Any]:
    return having("certificate.kind", "report", {**COMPLETE, "evaluate": list(standards)})


@pytest.mark.parametrize(
    ("adoption", "standard"), [("BS ISO 230-2:2014", "iso230-2:2014"), ("JIS B 6190-1:2016", "iso230-1:2012")]
)
def test_an_identical_adoption_is_its_standard(adoption: str, standard: str) -> None:
    assert registry().standard(adoption).identifier == standard


@pytest.mark.parametrize("layout", ["sheet", "standard", "full"])
def test_a_certificate_names_it_beside_the_standard(tmp_path: Path, layout: str) -> None:
    keys = having("certificate.layout", layout, of("BS ISO 230-2:2014"))

    assert "ISO 230-2:2014 (BS ISO 230-2:2014)" in text_of(certificate(tmp_path, keys))


def test_the_numbers_are_those_of_the_standard(tmp_path: Path) -> None:
    values = []
    for name in ("BS ISO 230-2:2014", "iso230-2:2014"):
        checked = job(tmp_path, of({"standard": name, "tolerances": {"A": 150}}))
        (found,) = pipeline.evaluate_parameters(checked, pipeline.read(checked, registry()), registry())
        values.append([(each.quantity.symbol, each.value, each.limit) for each in found.parameters])
    assert values[0] == values[1]


def test_one_standard_has_one_name_in_a_job(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"iso230-2:2014 stands in line \d+ already"):
        job(tmp_path, of("iso230-2:2014", "BS ISO 230-2:2014"))


@pytest.mark.parametrize(
    "name",
    [
        "DIN ISO 230-2:2014",
        "GB/T 17421.2-2016",
        "BS ISO 230-2:2014+A1:2016",
        "ASME B5.54-2005",
        "JIS B 6196:2006",
    ],
)
def test_a_name_whose_identity_was_not_seen_published_is_refused(tmp_path: Path, name: str) -> None:
    with pytest.raises(InputError, match="no plugin provides"):
        job(tmp_path, of(name))
