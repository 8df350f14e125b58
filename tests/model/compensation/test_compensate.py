"""A table from readings of a real control's run, its forecast, and what a second run says of it."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from pypdf import PdfReader

from environments import ROOT
from replacing import replace_in
from zlmreport.cli import main

DATA = ROOT / "tests" / "data" / "linuxcnc"
Capture = pytest.CaptureFixture[str]
JOB = """\
schema: zlmreport/job/1
certificate: {{number: LOOP-1, kind: report}}
axis: {{name: X{table}}}
measurement:
  source: {{plugin: laser-csv, file: "{file}"}}
evaluate: ["iso230-2:2014"]
{more}
"""


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def job(
    folder: Path, name: str, readings: str, table: str = ", compensation_table: none", more: str = ""
) -> str:
    text = JOB.format(table=table, file=DATA / f"captured_{readings}.csv", more=more)
    (folder / name).write_text(text, encoding="utf-8")
    return name


def run(capsys: Capture, *arguments: str) -> tuple[int, Any]:
    code = main(["compensate", *arguments, "--json"])
    return code, json.loads(capsys.readouterr().out)


def test_the_table_is_the_one_that_the_control_ran(folder: Path) -> None:
    name = job(folder, "job.yaml", "without")
    for kind, loaded in (("0", "loop.comp"), ("1", "loop.comp1")):
        code = main(
            ["compensate", name, "--controller", "linuxcnc", "--set", f"type={kind}", "-o", f"out{kind}"]
        )
        assert code == 0
        written = np.loadtxt(folder / f"out{kind}" / "LOOP-1.comp")
        assert written == pytest.approx(np.loadtxt(DATA / loaded), abs=1.1e-6)
        sheet = PdfReader(folder / f"out{kind}" / "LOOP-1-compensation.pdf")
        text = " ".join(" ".join(page.extract_text() for page in sheet.pages).split())
        assert "Worked row: at 300 mm the axis without a table is off by +50.39" in text
        assert "which leaves +0.000 ↑, +0.00" in text
        assert "Rows 11 (0 mm … 300 mm)" in text
        assert "If the deviation doubles, the sign is wrong" in text
        assert "The format was tried on LinuxCNC 2.9" in text
        assert "they must be the control's machine coordinates" in text


def test_a_table_for_no_control_was_tried_on_none(folder: Path) -> None:
    assert main(["compensate", job(folder, "job.yaml", "without"), "--controller", "csv", "-o", "out"]) == 0
    assert "tried" not in PdfReader(folder / "out" / "LOOP-1-compensation.pdf").pages[0].extract_text()


@pytest.mark.parametrize(("sign", "drawn", "missing"), [("-", "C↓", "C↑"), ("+", "C↑", "C↓")])
def test_one_direction_is_drawn_by_its_own_arrow(folder: Path, sign: str, drawn: str, missing: str) -> None:
    remark, header, *rows = (DATA / "captured_without.csv").read_text("utf-8").splitlines()
    kept = [row for row in rows if row.split(",")[1] == sign]
    (folder / "one.csv").write_text("\n".join([remark, header, *kept]) + "\n", "utf-8")
    text = JOB.format(table=", compensation_table: none", file=folder / "one.csv", more="")
    (folder / "job.yaml").write_text(text, "utf-8")
    assert main(["compensate", "job.yaml", "--controller", "linuxcnc", "-o", "out"]) == 0
    page = PdfReader(folder / "out" / "LOOP-1-compensation.pdf").pages[0].extract_text()
    assert drawn in page
    assert missing not in page


def test_json_states_the_forecast_and_writes_nothing(folder: Path, capsys: Capture) -> None:
    name = job(folder, "job.yaml", "without", more="compensation: {controller: linuxcnc, type: 1}")
    code, values = run(capsys, name)
    assert code == 0
    assert values["schema"] == "zlmreport/compensation/1"
    assert (values["controller"], values["confidence"], values["unit"]) == ("linuxcnc", "verified", "um")
    assert values["forecast"]["before"]["E"] == pytest.approx(65.4, abs=0.01)
    assert values["forecast"]["after"]["E"] < 0.1
    assert values["forecast"]["between_grid_points"]["largest"] < 0.1
    assert [path.name for path in folder.iterdir()] == ["job.yaml"]


def test_a_coarser_grid_states_what_it_leaves_between_its_rows(folder: Path, capsys: Capture) -> None:
    _, values = run(capsys, job(folder, "job.yaml", "without"), "--controller", "csv", "--step", "60")
    assert values["rows"] == 6
    assert values["forecast"]["between_grid_points"]["largest"] > 1


MODELLED = """\
schema: zlmreport/simulation/1
seed: 3
axis: {name: X, travel: [0, 400], screw_pitch: 10}
targets: {count: 21}
runs: 5
effects:
  - scale-error: {slope: 20}
  - backlash: {lost_motion: 5}
  - screw-pitch: {sine: 4}
noise: {reading: 0.5}
output: {job: made.yaml, number: MADE-1}
"""


@pytest.fixture
def modelled(folder: Path) -> str:
    """A job with a model whose screw turns many times between two targets."""
    (folder / "made.sim.yaml").write_text(MODELLED, encoding="utf-8")
    assert main(["simulate", "made.sim.yaml"]) == 0
    text = (folder / "made.yaml").read_text(encoding="utf-8")
    text = text.replace("axis: {", "axis: {compensation_table: none, ", 1)
    text = text.replace("- backlash", "- backlash\n    - screw-pitch")
    (folder / "made.yaml").write_text(text, encoding="utf-8")
    return "made.yaml"


def test_the_model_parts_what_is_periodic_from_the_rest(modelled: str, capsys: Capture) -> None:
    capsys.readouterr()
    model = ["--controller", "csv", "--from", "model"]
    _, coarse = run(capsys, modelled, *model)
    assert coarse["left_out"] == ["screw-pitch"]
    assert coarse["forecast"]["left_out"] == pytest.approx(4.0, abs=0.6)
    _, fine = run(capsys, modelled, *model, "--step", "1.25")
    assert fine["left_out"] == []
    assert fine["forecast"]["between_grid_points"]["largest"] < 1
    expected = fine["forecast"]["second_test"]["E"]
    assert expected["low"] < expected["value"] < expected["high"] < 3
    _, means = run(capsys, modelled, "--controller", "csv")
    assert means["forecast"]["between_grid_points"]["largest"] > 5  # the wave goes on between the targets


@pytest.mark.parametrize(
    ("readings", "code", "verdict"),
    [("type0", 0, "held"), ("wrong_sign", 1, "wrong-sign"), ("without", 1, "other")],
)
def test_a_second_run_is_held_against_the_forecast(
    folder: Path, capsys: Capture, readings: str, code: int, verdict: str
) -> None:
    before = job(folder, "before.yaml", "without", more="compensation: {controller: linuxcnc}")
    after = job(folder, "after.yaml", readings)
    found, values = run(capsys, "--confirm", before, after)
    assert (found, values["verdict"]) == (code, verdict)
    if verdict != "other":
        assert values["ratio"] == pytest.approx({"held": 0.0, "wrong-sign": 2.0}[verdict], abs=0.01)


def test_the_forecast_is_named_beside_what_the_second_test_shows(folder: Path, capsys: Capture) -> None:
    before = job(folder, "before.yaml", "without", more="compensation: {controller: linuxcnc}")
    after = job(folder, "after.yaml", "type0")
    _, values = run(capsys, "--confirm", before, after)
    assert values["before"]["E"] == pytest.approx(65.4, abs=0.01)
    assert values["after"]["E"] == pytest.approx(0.08, abs=0.01)
    assert values["forecast"]["E"]["low"] < values["forecast"]["E"]["high"]
    assert main(["compensate", "--confirm", before, after]) == 0
    lines = capsys.readouterr().out.splitlines()
    row = r"  E +Systematic deviation +65\.40 +0\.\d\d … 0\.\d\d +0\.08  (within|below|above)"
    assert any(re.fullmatch(row, line) for line in lines)
    assert lines[-1] == "the certificate of both tests, as found and as left: --output DIR writes the job"


def test_both_tests_make_one_certificate(folder: Path, capsys: Capture) -> None:
    more = "environment: {air_temperature: 21.5}\ncompensation: {controller: linuxcnc}"
    before = job(folder, "before.yaml", "without", more=more)
    after = job(folder, "after.yaml", "type0", more="output: {formats: [json]}")
    replace_in(Path("before.yaml"), (str(DATA), "readings"))
    (folder / "readings").symlink_to(DATA)
    assert main(["compensate", "--confirm", before, after, "-o", "both"]) == 0
    assert capsys.readouterr().out.endswith("as found and as left:\n  zlmreport both/LOOP-1-as-left.yaml\n")
    assert main(["both/LOOP-1-as-left.yaml"]) == 0
    results = json.loads((folder / "both" / "LOOP-1.json").read_text(encoding="utf-8"))
    found, left = (
        {each["symbol"]: each["value"] for each in evaluations[0]["parameters"]}
        for evaluations in (results["as_found"]["evaluations"], results["evaluations"])
    )
    assert (found["E"], left["E"]) == (pytest.approx(65.4, abs=0.01), pytest.approx(0.08, abs=0.01))
    assert (
        main(["compensate", "--confirm", before, after, "-o", "both"]) == 2
    )  # nobody's work is written over
    assert main(["compensate", "--confirm", before, "both/LOOP-1-as-left.yaml"]) == 0
    assert capsys.readouterr().out.endswith("as found and as left:\n  zlmreport both/LOOP-1-as-left.yaml\n")


def test_a_table_that_was_active_is_part_of_the_new_one(folder: Path) -> None:
    (folder / "old.csv").write_text("position,deviation\n0,10\n300,10\n", encoding="utf-8")
    name = job(folder, "job.yaml", "without", table=", compensation_table: old.csv")
    assert main(["compensate", name, "--controller", "linuxcnc", "-o", "out"]) == 0
    written, without = np.loadtxt(folder / "out" / "LOOP-1.comp"), np.loadtxt(DATA / "loop.comp")
    assert written[:, 1:] - without[:, 1:] == pytest.approx(np.full((11, 2), 0.010), abs=1.1e-6)


def test_a_table_that_csv_wrote_was_active_in_both_directions(folder: Path) -> None:
    first = job(folder, "job.yaml", "without")
    assert main(["compensate", first, "--controller", "csv", "--set", "decimals=6", "-o", "old"]) == 0
    second = job(folder, "second.yaml", "type0", table=", compensation_table: old/LOOP-1-compensation.csv")
    assert main(["compensate", second, "--controller", "linuxcnc", "-o", "new"]) == 0
    written, without = np.loadtxt(folder / "new" / "LOOP-1.comp"), np.loadtxt(DATA / "loop.comp")
    assert written[:, 1:] == pytest.approx(without[:, 1:], abs=0.1e-3)


@pytest.mark.parametrize(
    ("table", "arguments", "message"),
    [
        ("", ["--controller", "linuxcnc"], "axis.compensation_table is missing"),
        (", compensation_table: none", [], "which control?"),
        (", compensation_table: none", ["--controller", "linuxcncc"], "did you mean 'linuxcnc'?"),
        (
            ", compensation_table: none",
            ["--controller", "linuxcnc", "--set", "tipe=1"],
            "did you mean 'type'?",
        ),
        (", compensation_table: none", ["--controller", "linuxcnc", "--set", "type"], "write KEY=VALUE"),
        (", compensation_table: none", ["--controller", "linuxcnc", "--step", "1"], "takes 256 rows"),
        (", compensation_table: none", ["--controller", "isg"], "--unconfirmed writes it all the same"),
        (
            ", compensation_table: none",
            ["--controller", "fanuc", "--unconfirmed"],
            "raise magnification (3623)",
        ),
        (", compensation_table: none", ["--controller", "csv", "--confirm"], "--confirm takes two jobs"),
        (", compensation_table: none", ["--controller", "csv", "--step", "0"], "the step is not more than 0"),
        (
            ", compensation_table: none",
            ["--controller", "csv", "--step", "-5"],
            "the step is not more than 0",
        ),
        (", compensation_table: none", ["--controller", "csv", "--step", "1e-5"], "more than 10000 rows"),
        (", compensation_table: none", ["--controller", "csv", "--step", "1e5"], "the step is longer than"),
    ],
)
def test_a_mistake_ends_with_2_and_writes_nothing(
    folder: Path, capsys: Capture, table: str, arguments: list[str], message: str
) -> None:
    name = job(folder, "job.yaml", "without", table=table)
    assert main(["compensate", name, *arguments, "-o", "out"]) == 2
    assert message in capsys.readouterr().err
    assert not (folder / "out").exists()


def test_before_the_table_u_is_that_of_the_certificate(folder: Path, capsys: Capture) -> None:
    more = "instrument: {name: Laser, expanded_uncertainty: 1.0}\ncompensation: {controller: csv}"
    name = job(folder, "job.yaml", "without", more=f"{more}\noutput: {{formats: [json]}}")
    _, values = run(capsys, name)
    assert main([name, "--quiet"]) == 0
    evaluation = json.loads((folder / "LOOP-1.json").read_text(encoding="utf-8"))["evaluations"][0]
    certified = {each["symbol"]: each["expanded_uncertainty"] for each in evaluation["parameters"]}
    stated = values["forecast"]["expanded_uncertainty"]
    assert stated["before"] == {symbol: pytest.approx(certified[symbol]) for symbol in "EMBA"}
    assert stated["after"]["E"] > 0
    _, without = run(capsys, job(folder, "no-budget.yaml", "without"), "--controller", "csv")
    assert without["forecast"]["expanded_uncertainty"] == {"before": {}, "after": {}}
    low, high = (each["forecast"]["second_test"]["E"]["high"] for each in (without, values))
    assert high > low  # the errors of two set-ups widen what a second test may show


def test_rows_of_a_rotary_axis_are_told_in_its_degrees(folder: Path, capsys: Capture) -> None:
    readings = ROOT / "configs" / "rotary-axis" / "c-axis.csv"
    (folder / "c.yaml").write_text(
        "schema: zlmreport/job/1\ncertificate: {number: C-1, kind: report}\n"
        "axis: {name: C, kind: rotary, compensation_table: none}\n"
        f"measurement: {{source: {{plugin: laser-csv, file: {readings}}}}}\n"
        'evaluate: ["iso230-2:2014"]\n',
        encoding="utf-8",
    )
    for step, rows in (("0.5", 81), ("5", 9)):
        main(["compensate", "c.yaml", "--controller", "linuxcnc", "--step", step, "-o", f"out{rows}"])
        assert f"{rows} rows, {step}° apart, as stated" in capsys.readouterr().out


def readings_of(folder: Path, name: str, left: float, directions: str) -> str:
    """Write a test of an axis with 4 µm of play, and so much of its bow, and return its job."""
    places = np.arange(0, 301, 30)
    rows = [
        f"{place},{way},{run},{left * 10 * np.sin(place / 60) - (2 if way == '+' else -2) + run / 100:.3f}"
        for run in (1, 2, 3)
        for way in directions
        for place in (places if way == "+" else places[::-1]).tolist()
    ]
    (folder / f"{name}.csv").write_text(
        "target,direction,run,deviation\n" + "\n".join(rows), encoding="utf-8"
    )
    text = JOB.format(
        table=", compensation_table: none",
        file=f"{name}.csv",
        more="compensation: {controller: siemens-840d}",
    )
    (folder / f"{name}.yaml").write_text(text, encoding="utf-8")
    return f"{name}.yaml"


@pytest.mark.parametrize(
    ("first", "second"), [("+-", "+"), ("+-", "-"), ("+", "+-"), ("-", "-"), ("+-", "+-")]
)
def test_a_second_test_is_held_against_the_first_in_the_directions_of_both(
    folder: Path, capsys: Capture, first: str, second: str
) -> None:
    before, after = readings_of(folder, "before", 1.0, first), readings_of(folder, "after", 0.0, second)
    found, values = run(capsys, "--unconfirmed", "--confirm", before, after)
    assert (found, values["verdict"]) == (0, "held")
    assert main(["compensate", "--unconfirmed", "--confirm", before, after]) == 0
    row = next(line for line in capsys.readouterr().out.splitlines() if "Systematic" in line)
    is_alike = len(first) == len(second)
    assert row.endswith(("within", "below", "above")) == is_alike
    assert ("…" in row) == is_alike


@pytest.mark.parametrize(
    ("first", "second", "message"),
    [
        ("name: X", "name: Y", "it is a test of axis Y (linear), and the table is of axis X (linear)"),
        ("name: X", "name: X, kind: rotary", "it is a test of axis X (rotary), and the table is of"),
        ("3,+", "3,-", "was approached from the other side only"),
    ],
)
def test_a_test_that_says_nothing_of_the_table_is_refused(
    folder: Path, capsys: Capture, first: str, second: str, message: str
) -> None:
    before = readings_of(folder, "before", 1.0, "+")
    after = readings_of(folder, "after", 0.0, "+" if first.startswith("name") else "-")
    job = (folder / after).read_text(encoding="utf-8").replace(first, second)
    (folder / after).write_text(job, encoding="utf-8")
    assert main(["compensate", "--unconfirmed", "--confirm", before, after]) == 2
    assert message in capsys.readouterr().err


def test_a_test_of_another_machine_is_refused(folder: Path, capsys: Capture) -> None:
    jobs = [readings_of(folder, name, 1.0, "+") for name in ("before", "after")]
    for number, name in enumerate(jobs, start=1):
        text = (folder / name).read_text(encoding="utf-8")
        (folder / name).write_text(f"{text}machine: {{serial: M-{number}}}\n", encoding="utf-8")
    assert main(["compensate", "--unconfirmed", "--confirm", *jobs]) == 2
    message = "it is a test of machine 'M-2', and the table is of machine 'M-1'"
    assert message in capsys.readouterr().err


@pytest.mark.parametrize(
    ("last", "travel", "said"),
    [
        (330, "", "From 330° to 360°, where the turn is closed, nothing was measured"),
        (360, "", "0° and 360° are one place: the table has the mean of both there"),
        (300, "", "From 300° to 360°, where the turn would be closed, nothing was measured"),
        (330, ", travel: [0, 330]", ""),
        (330, ", travel: [0, 340]", "The axis goes from 0° to 340°: beyond the targets nothing was measured"),
    ],
)
def test_what_a_table_does_over_the_rest_of_a_turn_is_said(
    folder: Path, capsys: Capture, last: int, travel: str, said: str
) -> None:
    rows = [
        f"{place},+,{run},{5 * np.sin(np.radians(place)) + run / 10:.3f}"
        for run in (1, 2)
        for place in range(0, last + 1, 30)
    ]
    (folder / "c.csv").write_text("target,direction,run,deviation\n" + "\n".join(rows), encoding="utf-8")
    (folder / "c.yaml").write_text(
        "schema: zlmreport/job/1\ncertificate: {number: C-1, kind: report}\n"
        f"axis: {{name: C, kind: rotary, compensation_table: none{travel}}}\n"
        'measurement: {source: {plugin: laser-csv, file: c.csv}}\nevaluate: ["iso230-2:2014"]\n',
        encoding="utf-8",
    )
    assert main(["compensate", "c.yaml", "--controller", "linuxcnc", "-o", "out"]) == 0
    text = " ".join(capsys.readouterr().out.split())
    assert said in text
    assert ("the turn" in text or "one place" in text) == (bool(said) and "travel" not in travel)
    closed = {330: 360.0, 360: 360.0, 300: 300.0}[last] if not travel else float(last)
    assert np.loadtxt(folder / "out" / "C-1.comp")[-1, 0] == pytest.approx(closed)
