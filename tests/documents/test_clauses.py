"""The page on certificates names every mandatory item."""

from __future__ import annotations

import pytest

from documents.pages import DOCS
from zlmreport.document.certificate.clauses import MANDATORY_ITEMS, MandatoryItem

_ROWS = [
    line.split("|")
    for line in (DOCS / "how-to" / "issue-a-certificate.md").read_text(encoding="utf-8").splitlines()
    if line.startswith("| 7.8.")
]


@pytest.mark.parametrize("item", MANDATORY_ITEMS, ids=lambda item: f"{item.clause} {item.key}")
def test_each_mandatory_item_has_its_row_with_clause_and_key(item: MandatoryItem) -> None:
    assert any(row[1].strip() == item.clause and f"`{item.key}`" in row[3] for row in _ROWS)
