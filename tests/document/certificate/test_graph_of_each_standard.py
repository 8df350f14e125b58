"""Every layout of a certificate shows a graph of every standard, whatever it evaluates."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from document.certificate.documents import COMPLETE, ROOT, certificate
from installed import registry
from zlmreport.plugin import POSITIONING, measurands_of
from zlmreport.plugin.renderer import Graph

LAYOUTS = ("sheet", "standard", "full")
#: What has measurements of each measurand; positioning is that of an axis.
EXAMPLES = {
    "positioning": "",
    "straightness": "machine/x-straightness.yaml",
    "angle": "whole-machine/x-pitch.yaml",
    "squareness": "machine/xy-squareness.yaml",
    "circle": "machine/circle-xy.yaml",
    "diagonals": "whole-machine/diagonals.yaml",
    "drift": "drift/certificate.yaml",
    "flatness": "flatness/certificate.yaml",
}
#: Evaluated from both lines as squareness is.
WITHOUT_EXAMPLE = {"parallelism"}
OF_EACH = [
    (standard.identifier, each.identifier)
    for standard in registry().standards
    for each in measurands_of(standard)
    if each.identifier not in WITHOUT_EXAMPLE
]


def keys(standard: str, measurand: str) -> dict[str, Any]:
    if measurand == POSITIONING.identifier:
        return {**COMPLETE, "evaluate": [standard]}
    return {
        "extends": str(ROOT / "configs" / EXAMPLES[measurand]),
        "schema": "zlmreport/job/1",
        "evaluate": [standard],
    }


@pytest.mark.parametrize("layout", LAYOUTS)
@pytest.mark.parametrize(("standard", "measurand"), OF_EACH)
def test_each_layout_shows_a_graph(tmp_path: Path, standard: str, measurand: str, layout: str) -> None:
    stated = keys(standard, measurand)
    stated["certificate"] = {**stated.get("certificate", {}), "kind": "report", "layout": layout}

    sections = certificate(tmp_path, stated).sections
    if layout == "sheet":  # its first page is that of the standard
        sections = sections[:1]

    assert any(isinstance(block, Graph) for section in sections for block in section.blocks)
