"""``zlmreport compensate --confirm … -o DIR``: the job of an axis as found and as left."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from environments import ROOT
from zlmreport.cli import main

_READINGS = ROOT / "tests" / "data" / "linuxcnc"
_JOB = """schema: zlmreport/job/1
certificate: {{number: LOOP-1, kind: report}}
axis: {{name: X, compensation_table: none}}
measurement:
  {stated}
  source: {{plugin: laser-csv, file: "{file}"}}
evaluate: ["iso230-2:2014"]
compensation: {{controller: linuxcnc}}
output: {{formats: [json]}}
"""
_SET_ASIDE = """date: 2026-03-02
  end: 2026-03-03
  feed: 1000
  excluded: [{target: 60, direction: "+", run: 1, reason: a chip was under the mirror}]"""


def test_readings_that_were_set_aside_stay_aside_in_the_job_of_both_tests(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    for name, stated, file in (
        ("before", _SET_ASIDE, "captured_without"),
        ("after", "date: 2026-03-04", "captured_type0"),
    ):
        text = _JOB.format(stated=stated, file=_READINGS / f"{file}.csv")
        Path(f"{name}.yaml").write_text(text, encoding="utf-8")
    assert main(["compensate", "--confirm", "before.yaml", "after.yaml", "-o", "both"]) == 0
    assert main(["before.yaml", "-o", "alone"]) == 0
    assert main(["both/LOOP-1-as-left.yaml", "-o", "together"]) == 0
    alone, together = (
        json.loads(Path(folder, "LOOP-1.json").read_text(encoding="utf-8"))
        for folder in ("alone", "together")
    )
    assert together["as_found"]["evaluations"][0]["parameters"] == alone["evaluations"][0]["parameters"]
    job = Path("both/LOOP-1-as-left.yaml").read_text(encoding="utf-8")
    assert all(each in job for each in ('end: "2026-03-03"', "feed: 1000"))


def test_the_job_of_both_tests_states_the_adjustment_in_its_language(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    for name, file, language in (("before", "captured_without", "en"), ("after", "captured_type0", "de")):
        text = _JOB.format(stated="date: 2026-03-02", file=_READINGS / f"{file}.csv")
        text = text.replace("kind: report", f"kind: report, language: {language}")
        Path(f"{name}.yaml").write_text(text, encoding="utf-8")
    assert main(["compensate", "--confirm", "before.yaml", "after.yaml", "-o", "both"]) == 0
    said = " ".join(capsys.readouterr().out.split())
    assert "the job of the second test says that no table was active" in said
    job = Path("both/LOOP-1-as-left.yaml").read_text(encoding="utf-8")
    assert "Kompensationstabelle mit 11 Zeilen in der Steuerung: LinuxCNC (COMP_FILE)." in job


@pytest.mark.parametrize(("model", "times"), [("", 1), ("model: {effects: [offset, backlash]}\n", 0)])
def test_between_targets_lines_are_said_to_be_taken_where_no_model_says_what_is_there(
    model: str,
    times: int,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    text = _JOB.format(stated="date: 2026-03-02", file=_READINGS / "captured_without.csv") + model
    Path("job.yaml").write_text(text, encoding="utf-8")
    assert main(["compensate", "job.yaml", "-o", "table"]) == 0
    said = " ".join(capsys.readouterr().out.split())
    assert said.count("Between the targets nothing was measured") == times
