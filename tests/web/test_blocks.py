"""Blocks as a page has them."""

from __future__ import annotations

from zlmreport.plugin import Language
from zlmreport.plugin.renderer import Column, RowGroup, Table
from zlmreport.web.blocks import collect_blocks
from zlmreport.web.naming import Naming


def test_a_group_of_rows_keeps_its_heading() -> None:
    groups = (RowGroup((("A", "1"),), "ISO 230-2:2014"), RowGroup((("P", "2"),), "VDI/DGQ 3441"))
    table = Table("Left", (Column("Symbol"), Column("Value")), groups)
    (made,) = collect_blocks([table], Naming.of((), Language.ENGLISH))
    assert [(each["heading"], each["rows"][0][1]["text"]) for each in made["groups"]] == [
        ("ISO 230-2:2014", "1"),
        ("VDI/DGQ 3441", "2"),
    ]
