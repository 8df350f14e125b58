"""Every format carries the flatness of a plate: one result of eight lines, each with its readings."""

from __future__ import annotations

import io
from pathlib import Path

import openpyxl
import pytest

from document.certificate.documents import ROOT, certificate
from installed import registry
from zlmreport import pipeline
from zlmreport.evaluation.uncertainty.monte_carlo import TRIALS
from zlmreport.plugin.renderer import Certificate
from zlmreport.verification.verify import verify
from zlmreport_plugins.union_jack_lines import LINES

KEYS = {
    "schema": "zlmreport/job/1",
    "extends": str(ROOT / "configs" / "flatness" / "certificate.yaml"),
    "laboratory": {"country": "DE"},
}
SYMBOLS = ("t", "t_LS", "t_MZ", "closure_WE", "closure_NS")


@pytest.fixture(scope="module")
def plate(tmp_path_factory: pytest.TempPathFactory) -> Certificate:
    return certificate(tmp_path_factory.mktemp("plate"), KEYS)


def rendered(of: Certificate, identifier: str) -> bytes:
    return pipeline.render(of, [registry().renderer(identifier)], registry())[identifier]


def test_a_workbook_has_the_parameters_and_the_readings_and_no_empty_sheet(plate: Certificate) -> None:
    book = openpyxl.load_workbook(io.BytesIO(rendered(plate, "xlsx")))
    assert book.sheetnames == ["Parameters", *(f"Readings {name}" for name in LINES)]
    assert [row[2].value for row in book["Parameters"].iter_rows(min_row=2)] == list(SYMBOLS)
    assert all(sheet.max_row > 1 for sheet in book)


def test_a_dcc_states_slopes_and_no_end_of_a_length(plate: Certificate) -> None:
    text = rendered(plate, "dcc").decode()
    assert text.count("Uncertainty budget: standard uncertainties of a reading") == len(LINES)
    assert "at the end of the measured length" not in text
    assert all(f"Slope of a surface along the line {name}" in text for name in LINES)


def test_a_plate_is_no_linear_axis(plate: Certificate) -> None:
    text = rendered(plate, "html").decode()
    assert "linear axis" not in text
    assert text.count("<svg") >= 2


@pytest.mark.long
@pytest.mark.parametrize("renderer", ["pdf", "pdf-typst"])
def test_a_pdf_is_evaluated_again_from_what_it_carries(renderer: str, tmp_path: Path) -> None:
    path = tmp_path / "plate.pdf"
    path.write_bytes(rendered(certificate(tmp_path, KEYS, trials=TRIALS), renderer))
    assert verify(path, registry()).holds
