"""A job that evaluates several measured lines together: read, budgeted, attached and verified one by one."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from cli.commands import Shop

SQUARE = """\
schema: zlmreport/job/1
certificate: {number: SQUARE-1, kind: report, layout: LAYOUT, language: LANGUAGE}
machine: {manufacturer: Sample Works, model: MT 500, serial: 00123}
measurement:
  error: C0Y
  date: 2026-11-18
  tests:
    x: {error: EYX, at: {Z: 80}, source: {plugin: laser-csv, file: x.csv}}
    y: {error: EXY, at: {Z: 80}, source: {plugin: laser-csv, file: y.csv}, uncertainty: {resolution: 0.2}}
square: {error: 0.4, expanded_uncertainty: 0.5, certificate: G-17}
instrument: {name: Laser interferometer, expanded_uncertainty: 0.3}
uncertainty: {environmental_variation: 0.2}
evaluate: [{standard: "iso230-1:2012", tolerances: {C0Y: 6}}]
output: {formats: [FORMATS]}
"""
ARCSECOND = np.pi / 180 / 3600


def job(formats: str = "json", layout: str = "standard", language: str = "en") -> str:
    return SQUARE.replace("FORMATS", formats).replace("LAYOUT", layout).replace("LANGUAGE", language)


def readings(slope: float, number: int, step: float) -> str:
    """Return a table of two runs in both directions: a slope (µm/m) with a bow and some scatter."""
    positions = np.arange(number) * step
    scatter = np.random.default_rng(7).normal(0, 0.05, (2, 2, number))
    curve = slope * positions / 1e3 + 1e-5 * positions * (positions[-1] - positions)
    rows = ["target,direction,run,deviation"]
    for run in range(2):
        for way, sign in enumerate("+-"):
            rows += [
                f"{positions[each]:g},{sign},{run + 1},{curve[each] + scatter[run, way, each]:.3f}"
                for each in (range(number) if sign == "+" else reversed(range(number)))
            ]
    return "\n".join(rows) + "\n"


@pytest.fixture
def shop(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Shop:
    """A folder with two measured lines."""
    monkeypatch.chdir(tmp_path)
    shop = Shop(tmp_path, capsys)
    shop.write("x.csv", readings(8.0, 10, 100.0))
    shop.write("y.csv", readings(-30.0, 10, 50.0))
    return shop


def results(shop: Shop, text: str) -> dict[str, Any]:
    shop.write("job.yaml", text)
    run = shop.run("job.yaml")
    assert run.code == 0, run.messages
    found: dict[str, Any] = json.loads((shop.folder / "SQUARE-1.json").read_text(encoding="utf-8"))
    return found


def test_the_angle_follows_from_both_lines_and_the_square(shop: Shop) -> None:
    found = results(shop, job())
    (evaluation,) = found["evaluations"]
    by_symbol = {each["symbol"]: each for each in evaluation["parameters"]}
    slopes = by_symbol["slope_1"]["value"] + by_symbol["slope_2"]["value"]
    assert by_symbol["C0Y"]["value"] == pytest.approx(-slopes * 1e-6 / ARCSECOND + 0.4)
    assert by_symbol["C0Y"]["unit"] == "arcsec"
    assert by_symbol["C0Y"]["value"] == pytest.approx(22e-6 / ARCSECOND + 0.4, abs=0.05)
    assert by_symbol["C0Y"]["limit"] == 6
    assert found["measurements"]["error"] == "C0Y"


def test_each_line_has_results_budget_and_place_of_its_own(shop: Shop) -> None:
    found = results(shop, job())["tests"]
    assert list(found) == ["x", "y"]
    assert found["x"]["measurements"]["error"] == "EYX"
    assert found["x"]["measurements"]["at"] == {"Z": 80}
    assert [each["name"] for each in found["y"]["files"]] == ["y.csv"]
    assert found["x"]["evaluations"][0]["parameters"][0]["symbol"] == "EYX"
    names = [each["name"] for each in found["y"]["uncertainty"]["contributions"]]
    assert "Square" in names
    stated = {each["name"]: each["stated"] for each in found["y"]["uncertainty"]["contributions"]}
    assert stated["Resolution of the readings"] == "R = 0.2 µm"
    assert "Square" not in [each["name"] for each in found["x"]["uncertainty"]["contributions"]]


@pytest.mark.long
def test_a_larger_uncertainty_of_the_square_is_one_of_the_angle(shop: Shop) -> None:
    small = results(shop, job())["evaluations"][0]["parameters"][0]["expanded_uncertainty"]
    coarse = job().replace("expanded_uncertainty: 0.5", "expanded_uncertainty: 5")
    large = results(shop, coarse)["evaluations"][0]["parameters"][0]["expanded_uncertainty"]
    assert small < 1.0
    assert large == pytest.approx(5.0, rel=0.05)


@pytest.mark.long
@pytest.mark.parametrize("layout", ["sheet", "full"])
def test_a_certificate_of_several_lines_is_verified_from_what_it_carries_alone(
    shop: Shop, layout: str
) -> None:
    results(shop, job("pdf, json", layout, "de"))
    elsewhere = shop.folder / "elsewhere"
    elsewhere.mkdir()
    (shop.folder / "SQUARE-1.pdf").rename(elsewhere / "SQUARE-1.pdf")
    for each in ("x.csv", "y.csv", "job.yaml"):
        (shop.folder / each).unlink()
    assert shop.run("verify", str(elsewhere / "SQUARE-1.pdf")).code == 0


def test_readings_of_one_line_can_be_read_from_the_digital_certificate(shop: Shop) -> None:
    header = (
        "laboratory: {name: Example, address: 'A, B', country: DE}\ncustomer: {name: C, address: 'D, E'}\n"
    )
    stated = job("dcc, json").replace(
        "kind: report", "kind: report, issued: 2026-11-20, authorised_by: {name: Erika}"
    )
    before = results(shop, stated + header + "location: customer\n")["tests"]["y"]["evaluations"][0][
        "parameters"
    ]
    alone = (
        "schema: zlmreport/job/1\ncertificate: {number: SQUARE-1, kind: report}\naxis: {name: Y}\n"
        "measurement: {error: EXY, source: {plugin: dcc, file: given.xml, test: y}}\n"
        "evaluate: ['iso230-1:2012']\noutput: {formats: [json]}\n"
    )
    (shop.folder / "SQUARE-1.xml").rename(shop.folder / "given.xml")
    after = results(shop, alone)["evaluations"][0]["parameters"]
    assert after[0]["value"] == pytest.approx(before[0]["value"])
    refused = shop.run("check", str(shop.write("job.yaml", alone.replace(", test: y", ""))))
    assert refused.code == 2
    assert "it has: x, y" in refused.messages


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        (
            "    x: {error: EYX,",
            "    x: {error: EZX,",
            "C0Y follows from EYX and EXY; EYX is not among the tests",
        ),
        (
            "    x: {error: EYX, at: {Z: 80}, source: {plugin: laser-csv, file: x.csv}}\n",
            "",
            "C0Y follows from EYX and EXY; EYX is not among the tests",
        ),
        ("  error: C0Y", "  error: squareness", "name the error by its symbol, as C0Y for squareness"),
        ("file: y.csv", "file: none.csv", "none.csv"),
        ("{C0Y: 6}", "{EYX: 6}", "'EYX' is no parameter of iso230-1:2012"),
        (
            "  date: 2026-11-18",
            "  source: {plugin: laser-csv, file: x.csv}",
            "each of the tests has a source",
        ),
    ],
)
def test_what_does_not_go_together_is_told_with_its_place(shop: Shop, old: str, new: str, said: str) -> None:
    assert old in job()
    run = shop.run("check", str(shop.write("job.yaml", job().replace(old, new))))
    assert run.code in {2, 3}
    assert said in run.messages
    assert "Traceback" not in run.messages
