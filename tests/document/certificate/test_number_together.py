"""No line parts the number of a document, also where its column is narrower than the number."""

from __future__ import annotations

import io
import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pypdf
import pytest

from document.certificate.documents import certificate, having
from installed import registry
from zlmreport.document.typesetting.templates import FactsContext, render
from zlmreport.plugin.renderer import Certificate, Facts

#: Numbers as laboratories give them, wider than a column of facts at its usual size.
NUMBERS = {
    "instrument.certificate": "15133-01-00-D-K-2026-0347",
    "instrument.serial": "XL80-2026-11-000-4711-88-A",
    "machine.serial": "SN-2026-11-000-4711-88",
    "certificate.amends.number": "CAL-2026-0117-REV-A-2026",
    "environment.sensors": "4711-D-K-15133-01-00-2026-03",
}


def stating(layout: str) -> Mapping[str, Any]:
    keys: Mapping[str, Any] = having("certificate.layout", layout)
    for dotted, number in {**NUMBERS, "certificate.amends.reason": "Wrong."}.items():
        keys = having(dotted, number, keys)
    return keys


def text_of(document: Certificate, renderer: str) -> str:
    reader = pypdf.PdfReader(io.BytesIO(registry().renderer(renderer).render(document)))
    return "\n".join(page.extract_text() for page in reader.pages)


@pytest.mark.parametrize("renderer", ["pdf", "pdf-typst"])
@pytest.mark.parametrize("layout", ["sheet", "full"])
def test_a_number_that_is_wider_than_its_column_is_set_smaller_and_stays_whole(
    tmp_path: Path, layout: str, renderer: str
) -> None:
    text = text_of(certificate(tmp_path, stating(layout)), renderer)
    for number in NUMBERS.values():
        parted_or_not = re.findall(r"\s*".join(map(re.escape, number)), text)
        assert parted_or_not
        assert set(parted_or_not) == {number}


def test_only_what_is_wider_than_its_column_is_smaller() -> None:
    short, long = "4711-D-K-2026", "4711-D-K-15133-01-00-2026-03"
    both = Facts((("Certificate", short), ("Certificate", long)))
    beside, alone = (render(FactsContext(columns)) for columns in (((both,), (both,)), ((both,),)))
    assert f'<span class="held">{short}</span>' in beside
    assert f'<span class="held smaller">{long}</span>' in beside
    assert f'<span class="held">{long}</span>' in alone


def test_in_a_link_a_name_is_held_by_its_blanks_for_it_is_one_place_to_click(tmp_path: Path) -> None:
    document = certificate(tmp_path, having("evaluate", ["iso230-2:2014", "vdi-vde-2617"]))
    page = registry().renderer("html").render(document).decode()
    assert ">ISO\N{NO-BREAK SPACE}230-2:2014</a>" in page
    assert "\N{WORD JOINER}" not in page
    printed = pypdf.PdfReader(io.BytesIO(registry().renderer("pdf").render(document)))
    links = [
        each.get_object()["/Dest"]
        for sheet in printed.pages
        for each in sheet.get("/Annots", [])
        if each.get_object()["/Subtype"] == "/Link"
    ]
    assert len(links) == len(set(links)) > 0
