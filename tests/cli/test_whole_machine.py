"""One document of several measurements of a machine."""

from __future__ import annotations

import csv
import json
from pathlib import Path
from typing import Any

import pytest

from cli.commands import Shop
from cli.test_measured_lines import job as square, readings

POSITIONING = """\
schema: zlmreport/job/1
certificate: {number: X-1, kind: report, language: de}
machine: {serial: 00123}
axis: {name: X, travel: [0, 900]}
measurement: {date: 2026-11-17, source: {plugin: laser-csv, file: x.csv}}
instrument: {name: Laser interferometer, expanded_uncertainty: 0.3}
uncertainty: {environmental_variation: 0.2}
evaluate: [{standard: "iso230-2:2014", tolerances: {A: 30}}]
"""
YAW = """\
schema: zlmreport/job/1
certificate: {number: X-2, kind: report}
axis: {name: X, travel: [0, 900]}
measurement: {date: 2026-11-19, error: ECX, source: {plugin: laser-csv, file: x.csv}}
instrument: {name: Angular interferometer, expanded_uncertainty: 0.2}
uncertainty: {environmental_variation: 0.2}
evaluate: ["iso230-1:2012", "iso230-2:2014"]
"""
WHOLE = """\
schema: zlmreport/job/1
certificate:
  {number: MACHINE-1, kind: report, issued: 2026-11-20, authorised_by: {name: Erika}, layout: LAYOUT}
laboratory: {name: Example, address: "A 1, B", country: DE}
customer: {name: Customer, address: "C 2, D"}
machine: {manufacturer: Sample Works, model: MT 500, serial: 00123}
location: customer
decision_rule: guard-band
measurements: [positioning.yaml, parts/yaw.yaml, square.yaml]
output: {formats: [FORMATS]}
"""


def whole(formats: str = "json", layout: str = "standard") -> str:
    return WHOLE.replace("FORMATS", formats).replace("LAYOUT", layout)


@pytest.fixture
def shop(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Shop:
    """A folder with three measurements of a machine."""
    monkeypatch.chdir(tmp_path)
    shop = Shop(tmp_path, capsys)
    shop.write("x.csv", readings(8.0, 10, 100.0))
    shop.write("y.csv", readings(-30.0, 10, 50.0))
    shop.write("parts/x.csv", readings(5.0, 10, 100.0))
    shop.write("positioning.yaml", POSITIONING)
    shop.write("parts/yaw.yaml", YAW)
    shop.write("square.yaml", square())
    return shop


def results(shop: Shop, text: str) -> dict[str, Any]:
    run = shop.run(str(shop.write("whole.yaml", text)))
    assert run.code == 0, run.messages
    found: dict[str, Any] = json.loads((shop.folder / "MACHINE-1.json").read_text(encoding="utf-8"))
    return found


def test_every_measurement_has_its_results_under_its_own_name(shop: Shop) -> None:
    found = results(shop, whole())
    named = [(each["measurement"], each["standard"]) for each in found["evaluations"]]
    assert named == [
        ("EXX", "iso230-2:2014"),
        ("ECX", "iso230-1:2012"),
        ("ECX", "iso230-2:2014"),
        ("C0Y", "iso230-1:2012"),
    ]
    assert list(found["parts"]) == ["EXX", "ECX", "C0Y"]
    assert list(found["parts"]["C0Y"]["tests"]) == ["x", "y"]
    assert [each["role"] for each in found["provenance"]["sources"]].count("test") == 3


def test_each_has_the_numbers_and_the_unit_that_it_has_alone(shop: Shop) -> None:
    found = results(shop, whole())["parts"]
    for name, file, number in (("EXX", "positioning.yaml", "X-1"), ("ECX", "parts/yaw.yaml", "X-2")):
        assert shop.run(file, "--format", "json", "-o", "alone").code == 0
        alone = json.loads((shop.folder / "alone" / f"{number}.json").read_text(encoding="utf-8"))
        numbers = [
            [
                (each["symbol"], each["value"], each["unit"], each["expanded_uncertainty"])
                for each in of["parameters"]
            ]
            for of in (alone["evaluations"][0], found[name]["evaluations"][0])
        ]
        assert numbers[0] == numbers[1]


@pytest.mark.long
def test_what_the_document_says_holds_for_all_of_them(shop: Shop) -> None:
    decided = results(shop, whole())["parts"]["EXX"]["evaluations"][0]["parameters"][0]["decision"]
    assert decided["statement"] == "undecided"  # by guard-band, the document's rule; its own is simple
    run = shop.run("whole.yaml")
    assert "3 measurements, Sample Works MT 500" in run.output
    assert "Angular error ECX of axis X" in run.output


def test_the_numbers_of_each_are_told_apart_in_a_table(shop: Shop) -> None:
    results(shop, whole("json, csv, xlsx"))
    with (shop.folder / "MACHINE-1.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    units = {
        (each["quantity"], each["symbol"]): each["unit"]
        for each in rows
        if each["quantity"].endswith(".value")
    }
    assert units["EXX.value", "A"] == "um"
    assert units["ECX.value", "A"] == "arcsec"
    assert units["C0Y.x.value", "slope"] == "um/m"
    assert (shop.folder / "MACHINE-1.xlsx").stat().st_size > 0


def test_what_was_found_of_one_that_was_adjusted_is_read_from_the_digital_certificate(shop: Shop) -> None:
    shop.write("found.csv", readings(20.0, 10, 100.0))
    adjusted = (
        "as_found: {work: repair, adjustment: New nut., measurement: {date: 2026-11-16, source: FOUND}}\n"
    )
    shop.write(
        "positioning.yaml", POSITIONING + adjusted.replace("FOUND", "{plugin: laser-csv, file: found.csv}")
    )
    part = results(shop, whole("dcc, json"))["parts"]["EXX"]
    (shop.folder / "MACHINE-1.xml").rename(shop.folder / "given.xml")

    def read(test: str, state: str) -> str:
        source = f"{{plugin: dcc, file: given.xml, test: {test}, state: {state}}}"
        return POSITIONING.replace("{plugin: laser-csv, file: x.csv}", source)

    for state, expected in (("as left", part), ("as found", part["as_found"])):
        assert shop.run(str(shop.write("again.yaml", read("EXX", state))), "--format", "json").code == 0
        again = json.loads((shop.folder / "X-1.json").read_text(encoding="utf-8"))
        values = [[each["value"] for each in of["evaluations"][0]["parameters"]] for of in (again, expected)]
        assert values[0] == pytest.approx(values[1])
        (shop.folder / "X-1.json").unlink()
    refused = shop.run("check", str(shop.write("again.yaml", read("ECX", "as found"))))
    assert refused.code == 2
    assert "'ECX' has readings of one measurement only, and none as found" in refused.messages


@pytest.mark.long
@pytest.mark.parametrize(
    ("formats", "layout"), [("pdf, json, dcc", "standard"), ("pdf-typst, json", "sheet")]
)
def test_it_is_verified_from_what_it_carries_alone(shop: Shop, formats: str, layout: str) -> None:
    results(shop, whole(formats, layout))
    elsewhere = shop.folder / "elsewhere"
    elsewhere.mkdir()
    (shop.folder / "MACHINE-1.pdf").rename(elsewhere / "MACHINE-1.pdf")
    for each in (*shop.folder.glob("*.csv"), *shop.folder.glob("*.yaml"), *shop.folder.glob("parts/*")):
        each.unlink()
    run = shop.run("verify", str(elsewhere / "MACHINE-1.pdf"))
    assert run.code == 0, run.output
    assert "ECX iso230-2:2014" in run.output


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("square.yaml]", "square.yaml, square.yaml]", "this job stands there already"),
        ("square.yaml]", "none.yaml]", "none.yaml"),
        ("square.yaml]", "whole.yaml]", "a document of several itself"),
        ("measurements: [positioning.yaml, parts/yaw.yaml, square.yaml]", "measurements: []", "1 to 60 jobs"),
        ("location: customer", "axis: {name: X}", "axis belongs to one measurement"),
        ("location: customer", "evaluate: [nmtba]", "evaluate belongs to one measurement"),
        ("serial: 00123", "serial: 00124", "the document on '00124'"),
    ],
)
def test_what_makes_no_document_is_told_with_its_place(shop: Shop, old: str, new: str, said: str) -> None:
    assert old in whole()
    run = shop.run("check", str(shop.write("whole.yaml", whole().replace(old, new))))
    assert run.code in {2, 3}
    assert said in run.messages
    assert "Traceback" not in run.messages


def test_a_serial_number_in_capitals_is_the_same_machine(shop: Shop) -> None:
    alone = whole().replace("parts/yaw.yaml, square.yaml", "parts/yaw.yaml").replace("00123", "VM-7A")
    shop.write("positioning.yaml", POSITIONING.replace("00123", "vm-7a"))
    run = shop.run("check", str(shop.write("whole.yaml", alone)))
    assert run.code == 0, run.messages


@pytest.mark.parametrize("command", [("plan",), ("model", "diagnose"), ("capture",)])
def test_commands_of_one_measurement_ask_for_one(shop: Shop, command: tuple[str, ...]) -> None:
    run = shop.run(*command, str(shop.write("whole.yaml", whole())))
    assert run.code == 2
    assert "this document has several; take one of their jobs" in run.messages


def test_a_part_states_each_fact_once_in_the_full_layout(shop: Shop) -> None:
    pages = shop.folder / "MACHINE-1.html"
    run = shop.run(str(shop.write("whole.yaml", whole("html", "full"))))
    assert run.code == 0, run.messages
    assert pages.read_text(encoding="utf-8").count("Angular interferometer") == 1
