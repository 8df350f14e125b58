"""Every format carries a circle: as a circle, in the units of one, and so that it can be read again."""

from __future__ import annotations

import io
from pathlib import Path
from typing import Any
from xml.etree import ElementTree as ET

import numpy as np
import openpyxl
import pytest
from dcclib.validation.schematron import SchematronValidator

from document.certificate.circles import CIRCLE, document, report
from installed import registry
from plugins.renderers.results import VALIDATOR, is_verified, parameters_of, results_of
from zlmreport import pipeline
from zlmreport.plugin.renderer import Certificate

TURNS = {"ccw": 1, "cw": 1}
SYMBOLS = ["G_ccw", "G_cw", "G_b", "F_max_ccw", "F_min_ccw", "F_max_cw", "F_min_cw", "D"]
NAMES = {"dcc": "https://ptb.de/dcc", "si": "https://ptb.de/si"}


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Certificate:
    return document(tmp_path_factory.mktemp("circle"), TURNS)


@pytest.fixture(scope="module")
def results(made: Certificate) -> Any:
    return results_of(made)


def test_the_results_file_is_as_promised(results: Any) -> None:
    assert not list(VALIDATOR.iter_errors(results))
    assert results["measurements"]["measurand"] == "circle"
    assert results["measurements"]["units"] == {"position": "deg", "deviation": "um"}
    assert results["measurements"]["circle"] == CIRCLE
    assert [each["symbol"] for each in results["evaluations"][0]["parameters"]] == SYMBOLS


def test_a_table_has_every_parameter(made: Certificate, results: Any) -> None:
    assert parameters_of(made) == {
        each["symbol"]: repr(each["value"]) for each in results["evaluations"][0]["parameters"]
    }


def test_a_workbook_speaks_of_angles_and_senses(made: Certificate) -> None:
    book = openpyxl.load_workbook(io.BytesIO(registry().renderer("xlsx").render(made)))
    headings, first, *_ = book["Readings"].iter_rows(values_only=True)
    assert headings == ("Run", "Direction", "Angle / deg", "Deviation / um")
    assert first == (1, "counter-clockwise", 0, 0)
    assert book["Positions"].cell(1, 2).value == "Angle / deg"


def test_a_digital_certificate_is_valid_and_speaks_of_angles_and_senses(made: Certificate) -> None:
    content = registry().renderer("dcc").render(made)
    assert SchematronValidator.for_dcc().validate_str(content.decode()).failed_assertions == []
    root = ET.fromstring(content)
    named = {"".join(each.itertext()).strip() for each in root.iterfind(".//dcc:results//dcc:name", NAMES)}
    assert {
        "Angle",
        "Mean deviation, counter-clockwise",
        "Mean deviation, clockwise",
        "Sense of motion: 1 is counter-clockwise",
    } <= named
    assert not [each for each in named if "approach" in each or "axis" in each or "position" in each]
    units = {
        each.text.split()[0] for each in root.iterfind(".//dcc:result[2]//si:unitXMLList", NAMES) if each.text
    }
    assert units == {r"\degree", r"\micro\metre"}


def test_its_readings_come_out_of_a_digital_certificate_as_they_went_in(tmp_path: Path) -> None:
    stated = report(tmp_path, TURNS)
    before = pipeline.read(stated, registry())
    (tmp_path / "circle.xml").write_bytes(
        registry().renderer("dcc").render(pipeline.compose(stated, registry(), trials=100))
    )
    of_file = {"date": "2022-04-07", "source": {"plugin": "dcc", "file": "circle.xml"}}

    after = pipeline.read(report(tmp_path, TURNS, measurement=of_file), registry())

    for name in ("target_positions", "approach", "run", "deviation"):
        assert getattr(after, name) == pytest.approx(getattr(before, name), abs=1e-15), name
    assert np.array_equal(after.target, before.target)


@pytest.mark.long
@pytest.mark.parametrize("press", ["pdf", "pdf-typst"])
def test_its_pages_hold(tmp_path: Path, press: str) -> None:
    output = {"directory": str(tmp_path), "formats": [press, "json"]}
    assert is_verified(report(tmp_path, TURNS, output=output))
