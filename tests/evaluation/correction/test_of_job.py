"""Corrections as a job asks for them, from its file to the page."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from document.certificate.documents import COMPLETE, certificate, job, text_of
from installed import registry
from refusals import messages
from zlmreport.evaluation.correction.corrections import find_corrections_of
from zlmreport.pipeline import read
from zlmreport.plugin import InputError
from zlmreport.plugin.instrument import refractive_index

HEAD = "target,direction,run,deviation,air_temperature,air_pressure,relative_humidity,material_temperature\n"
#: Two readings, 1 m apart, in the same air and on a warm machine.
ROWS = "0,+,1,0,22,1005,40,23\n1000,+,1,5,22,1005,40,23\n"


def keys(folder: Path, corrections: Any, head: str = HEAD, rows: str = ROWS) -> Mapping[str, Any]:
    (folder / "readings.csv").write_text(head + rows)
    return {
        **COMPLETE,
        "axis": {"name": "X"},
        "measurement": {"date": "2022-01-01", "source": {"plugin": "laser-csv", "file": "readings.csv"}},
        "evaluate": ["iso230-2:2014"],
        "environment": {"remarks": "none"},
        "certificate": {"number": "R-1", "kind": "report"},
        "corrections": corrections,
    }


def end(folder: Path, corrections: Any, **given: str) -> float:
    """The deviation at 1 m, µm."""
    measured = certificate(folder, keys(folder, corrections, **given)).measurements
    return float(measured.deviation[1] * 1e6)


INDEX = float(refractive_index(295.15, 100_500.0, 0.4))
STANDARD = float(refractive_index(293.15, 101_325.0, 0.5))
#: 1 m is a double to 2.2e-10 µm, and so is each of four steps.
EXACT = 1e-9


@pytest.mark.parametrize(
    ("assumed", "index"), [("vacuum", 1.0), ("standard air", STANDARD), (1.0002712, 1.0002712)]
)
def test_a_metre_is_corrected_by_the_index_that_the_instrument_assumed(tmp_path, assumed, index):
    found = end(tmp_path, {"air": {"assumed": assumed}})

    assert found == pytest.approx(1e6 * ((1 + 5e-6) * index / INDEX - 1), abs=EXACT)


@pytest.mark.parametrize(("told", "datum"), [(None, 0.0), (-0.005, -0.005)])
def test_the_datum_is_where_the_readings_tell_or_else_the_first_target(tmp_path, told, datum):
    chosen = job(tmp_path, keys(tmp_path, {"material": {"expansion_coefficient": 11.5}}))
    measured = replace(read(chosen, registry()), datum=told)

    assert find_corrections_of(chosen, measured).datum == datum


def test_a_metre_of_steel_three_kelvin_too_warm_is_corrected_by_its_expansion(tmp_path):
    found = end(tmp_path, {"material": {"expansion_coefficient": 11.5}})

    assert found == pytest.approx(5 - 34.5 * (1 + 5e-6), abs=EXACT)


def test_a_condition_that_is_not_logged_is_taken_from_the_job(tmp_path):
    given = keys(tmp_path, {"material": {}}, "target,direction,run,deviation\n", "0,+,1,0\n1000,+,1,5\n")
    stated = {**given, "environment": {"material_temperature": 23, "expansion_coefficient": 11.5}}
    measured = certificate(tmp_path, stated).measurements

    assert float(measured.deviation[1]) * 1e6 == pytest.approx(5 - 34.5 * (1 + 5e-6), abs=EXACT)


def test_what_was_corrected_stands_on_the_page_with_its_inputs(tmp_path):
    asked = {"air": {"assumed": "standard air"}, "material": {"expansion_coefficient": 11.5}}
    text = text_of(certificate(tmp_path, keys(tmp_path, asked)))

    assert "Corrections applied to the readings" in text
    assert "T − 20 °C from 3 to 3 K | −34.5" in text
    assert "Every deviation in this document is a corrected one." in text


def test_readings_that_are_not_corrected_say_nothing_of_corrections(tmp_path):
    bare = {name: value for name, value in keys(tmp_path, None).items() if name != "corrections"}

    assert "Corrections applied" not in text_of(certificate(tmp_path, bare))


@pytest.mark.parametrize(
    ("corrections", "message"),
    [
        ({"air": {"assumed": "vacuum"}}, "corrections.air needs air_pressure: log it beside the readings"),
        ({"material": {"expansion_coefficient": 11.5}}, "corrections.material needs material_temperature"),
        ({"material": {}}, "corrections.material needs the expansion coefficient"),
        ({"dead_path": {"length": 100}}, "corrections.dead_path needs the index of the air"),
    ],
)
def test_what_a_correction_needs_and_nobody_tells_is_refused(tmp_path, corrections, message):
    bare = {"head": "target,direction,run,deviation\n", "rows": "0,+,1,0\n1000,+,1,5\n"}
    assert any(message in each for each in messages(end, tmp_path, corrections, **bare))


def test_a_gap_in_a_log_is_refused_and_not_filled(tmp_path):
    with pytest.raises(InputError, match=r"material_temperature was not logged at 1 of 2 .* number 2"):
        end(
            tmp_path,
            {"material": {"expansion_coefficient": 11.5}},
            rows="0,+,1,0,22,1005,40,23\n1000,+,1,5,22,1005,40,\n",
        )


def test_lengths_of_a_rotary_axis_are_not_corrected(tmp_path):
    rotary = {**keys(tmp_path, {"air": {"assumed": "vacuum"}}), "axis": {"name": "C", "kind": "rotary"}}
    with pytest.raises(InputError, match="do not apply to a rotary axis"):
        certificate(tmp_path, rotary)
