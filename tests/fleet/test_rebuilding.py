"""A lost ledger is made again from the certificates."""

from __future__ import annotations

from pathlib import Path

import pytest

from replacing import replace_in
from zlmreport.cli import main
from zlmreport.fleet.ledger import Ledger

FLEET = "schema: zlmreport/fleet/1\nname: Hall\njobs: x.yaml\nledger: hall.db\n"
JOB = """\
schema: zlmreport/job/1
certificate: {number: R-1, kind: report}
machine: {serial: 17}
axis: {name: X, travel: [0, 200]}
measurement: {date: 2026-11-18, source: {plugin: laser-csv, file: x.csv}}
evaluate: [{standard: "iso230-2:2014", tolerances: {E: 10}}]
output: {formats: [FORMAT]}
"""
READINGS = """\
target,direction,run,deviation
0,+,1,0.2
100,+,1,1.3
200,+,1,2.9
200,-,1,1.8
100,-,1,0.1
0,-,1,-1.1
"""


@pytest.fixture(params=["json", "pdf"])
def fleet(request: pytest.FixtureRequest, tmp_path: Path) -> Path:
    """Return the file of a fleet with one certificate."""
    (tmp_path / "x.csv").write_text(READINGS, encoding="utf-8")
    (tmp_path / "x.yaml").write_text(JOB.replace("FORMAT", request.param), encoding="utf-8")
    file = tmp_path / "fleet.yaml"
    file.write_text(FLEET, encoding="utf-8")
    assert main(["fleet", str(file), "--quiet", "--workers", "1"]) == 0
    return file


def test_certificates_whose_number_no_job_has_are_named(
    fleet: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for file in fleet.parent.glob("hall.db*"):
        file.unlink()
    job = fleet.parent / "x.yaml"
    replace_in(job, ("R-1", "R-2"))
    (fleet.parent / "certificates/note.json").write_text("{}", encoding="utf-8")
    (fleet.parent / "certificates/list.json").write_text("[]", encoding="utf-8")
    assert main(["fleet", "rebuild", str(fleet)]) == 4
    (said,) = capsys.readouterr().err.splitlines()
    assert "no job has the number R-1; it is not in the ledger" in said


def test_it_knows_what_they_state_and_the_next_night_finds_them_unchanged(
    fleet: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    ledger = fleet.parent / "hall.db"
    with Ledger.open(str(ledger), "Hall") as before:
        (stated,) = before.list_entries()
    assert main(["fleet", "rebuild", str(fleet)]) == 2
    assert "the ledger knows 1 certificate of this fleet" in capsys.readouterr().err
    for file in fleet.parent.glob("hall.db*"):
        file.unlink()
    assert main(["fleet", "rebuild", str(fleet)]) == 0
    with Ledger.open(str(ledger), "Hall") as after:
        (rebuilt,) = after.list_entries()
    assert (rebuilt.number, rebuilt.machine, rebuilt.measured) == ("R-1", "17", "2026-11-18")
    assert rebuilt.parameters == stated.parameters
    assert rebuilt.files == stated.files
    assert main(["fleet", str(fleet), "--workers", "1"]) == 0
    assert "confirmed R-1" in capsys.readouterr().out
