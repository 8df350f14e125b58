"""A document on what several instruments measured names the certificate of each, or claims nothing."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from document.certificate.documents import COMPLETE, job
from zlmreport.plugin import Language
from zlmreport.plugin.renderer import traceable_through

READINGS = "target,direction,run,deviation\n" + "".join(
    f"{at},{way},1,{at * 0.01}\n" for way in "+-" for at in range(0, 500, 100)
)


def said(folder: Path, first: dict[str, Any], second: dict[str, Any], **others: Any) -> str:
    (folder / "line.csv").write_text(READINGS, encoding="utf-8")
    source = {"plugin": "laser-csv", "file": "line.csv"}
    keys = {name: each for name, each in COMPLETE.items() if name not in {"axis", "instrument"}}
    tests = {
        "x": {"error": "EYX", "source": source, "instrument": {"name": "A", **first}},
        "y": {"error": "EXY", "source": source, "instrument": {"name": "B", **second}},
    }
    measurement = {"date": "2022-04-18", "error": "C0Y", "tests": tests}
    report = {**COMPLETE["certificate"], "kind": "report"}
    whole = {**keys, "certificate": report, "measurement": measurement, "evaluate": ["iso230-1:2012"]}
    whole |= others
    found = traceable_through(job(folder, whole))
    return found.in_language(Language.ENGLISH) if found else ""


@pytest.mark.parametrize(
    ("first", "second", "ending"),
    [
        ("C-1", "C-2", "instruments (calibration certificates C-1, C-2)."),
        ("C-1", "C-1", "instrument (calibration certificate C-1)."),
    ],
)
def test_each_certificate_is_named_once(tmp_path: Path, first: str, second: str, ending: str) -> None:
    assert said(tmp_path, {"certificate": first}, {"certificate": second}).endswith(ending)


def test_one_instrument_without_a_certificate_leaves_the_whole_unshown(tmp_path: Path) -> None:
    assert said(tmp_path, {"certificate": "C-1"}, {}) == ""


@pytest.mark.parametrize(
    ("square", "ending"),
    [
        ({"certificate": "S-3", "expanded_uncertainty": 0.5}, "(calibration certificates C-1, S-3)."),
        ({"error": 0.2}, "(calibration certificate C-1)."),
        ({"expanded_uncertainty": 0.5}, ""),
    ],
)
def test_a_square_that_enters_u_is_in_the_chain(tmp_path: Path, square: dict[str, Any], ending: str) -> None:
    of_both = {"certificate": "C-1"}
    found = said(tmp_path, of_both, of_both, square=square)
    assert found.endswith(ending)
    assert bool(found) == bool(ending)


def test_a_straightedge_is_in_the_chain_by_the_contribution_that_it_causes(tmp_path: Path) -> None:
    edge = {
        "name": "Straightedge",
        "expanded_uncertainty": 0.3,
        "acts": "at-each-position",
        "certificate": "E-5",
    }
    of_both = {"certificate": "C-1"}
    budget = {**COMPLETE["uncertainty"], "contributions": [edge]}
    assert "C-1, E-5" in said(tmp_path, of_both, of_both, uncertainty=budget)
