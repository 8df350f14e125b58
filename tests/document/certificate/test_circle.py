"""What a document says of a circular test: which circle, how it was run, and no table of its angles."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import pytest

from document.certificate.circles import document
from zlmreport.plugin import Figure
from zlmreport.plugin.renderer import Certificate, Facts, Graph, Table


def blocks(of: Certificate, kind: type) -> Iterator[Any]:
    for block in (*of.cover, *(each for section in of.sections for each in section.blocks)):
        if isinstance(block, kind):
            yield block


def facts(of: Certificate) -> dict[str, str]:
    return {name: value for block in blocks(of, Facts) for name, value in block.pairs}


@pytest.fixture(scope="module")
def both(tmp_path_factory: pytest.TempPathFactory) -> Certificate:
    return document(tmp_path_factory.mktemp("both"), {"ccw": 2, "cw": 2})


def test_it_says_which_circle_was_run(both: Certificate) -> None:
    found = facts(both)
    assert {
        "Plane": "ZX",
        "Nominal radius": "100 mm",
        "Feed along the path": "500 mm/min",
        "Centre at X / Y / Z": "250 / 200 / 120 mm",
        "Length of the instrument": "calibrated",
    }.items() <= found.items()


def test_it_says_how_it_was_run(both: Certificate) -> None:
    found = facts(both)
    assert found["Senses and turns"] == "counter-clockwise and clockwise, 2 turns each"
    assert found["Evaluated from"] == "counter-clockwise at 0°; clockwise at 352°"
    assert found["Angles"] == "45, from 0 to 352° from +Z towards +X"


@pytest.mark.parametrize(
    ("turns", "said"),
    [
        ({"ccw": 3}, "counter-clockwise only, 3 turns"),
        ({"cw": 1}, "clockwise only, 1 turn"),
        ({"ccw": 2, "cw": 1}, "counter-clockwise, 2 turns; clockwise, 1 turn"),
    ],
)
def test_it_says_which_senses_were_run(tmp_path: Path, turns: Mapping[str, int], said: str) -> None:
    assert facts(document(tmp_path, turns))["Senses and turns"] == said


def test_it_says_so_in_german(tmp_path: Path) -> None:
    found = facts(document(tmp_path, {"ccw": 1, "cw": 1}, {"radius": 100, "feed": 500}, language="de"))
    assert found["Bahnvorschub"] == "500 mm/min"
    assert found["Länge des Messgeräts"] == "nicht kalibriert: über Radien ist nichts gesagt"
    assert found["Winkel"] == "45, von 0 bis 352°, von +X nach +Y"


def test_its_title_names_the_plane(both: Certificate) -> None:
    assert "Circular accuracy in the plane ZX" in both.subtitle


def test_no_table_lists_its_angles(both: Certificate) -> None:
    rows = [sum(len(group.rows) for group in table.groups) for table in blocks(both, Table)]
    assert max(rows) < 45


def test_its_graphs_are_one_about_the_circle_and_one_over_the_angle(both: Certificate) -> None:
    figures: list[Figure] = [
        block.figure for block in blocks(both, Graph) if block.figure.key != "conformity"
    ]
    assert [figure.panels[0].is_polar for figure in figures if figure.key != "budget"] == [True, False]


def test_nobody_reads_of_an_axis(both: Certificate) -> None:
    assert not [name for name in facts(both) if "axis" in name.lower() and name != "Other axes at"]
