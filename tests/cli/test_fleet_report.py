"""``zlmreport fleet report`` before there is anything to report, and when the fleet file is wrong."""

from __future__ import annotations

from pathlib import Path

import pytest

from fleet.exposition import parse
from zlmreport.cli import main

FLEET = 'schema: zlmreport/fleet/1\nname: Hall "North"\nlanguage: de\njobs: jobs/*.yaml\n'


@pytest.fixture
def fleet(tmp_path: Path) -> Path:
    (tmp_path / "jobs").mkdir()
    (tmp_path / "jobs" / "x.yaml").write_text("schema: zlmreport/job/1\n", encoding="utf-8")
    file = tmp_path / "hall.yaml"
    file.write_text(FLEET, encoding="utf-8")
    return file


def test_a_fleet_that_has_not_run_has_an_overview_in_its_language(fleet: Path) -> None:
    assert main(["fleet", "report", str(fleet)]) == 0
    page = (fleet.parent / "certificates" / "hall.html").read_text(encoding="utf-8")
    assert '<html lang="de">' in page
    assert "noch keiner" in page


def test_a_fleet_that_has_not_run_tells_monitoring_that_all_is_to_be_done(fleet: Path) -> None:
    main(["fleet", "report", str(fleet)])
    told = parse((fleet.parent / "certificates" / "hall.prom").read_text(encoding="utf-8"))
    assert "zlmreport_fleet_last_run_timestamp_seconds" not in told


def test_the_ledger_is_only_read(fleet: Path) -> None:
    main(["fleet", "report", str(fleet)])
    assert [path.name for path in fleet.parent.iterdir() if "ledger" in path.name] == []


def test_the_files_that_were_written_are_told(fleet: Path, capsys: pytest.CaptureFixture[str]) -> None:
    main(["fleet", "report", str(fleet), "-o", str(fleet.parent / "overview")])
    told = [Path(line).name for line in capsys.readouterr().out.splitlines()]
    assert told == ["hall.html", "hall.prom", "hall.ics"]


def test_a_language_that_there_is_not_is_refused_with_its_place(
    fleet: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    fleet.write_text(FLEET.replace("language: de", "language: pl"), encoding="utf-8")
    assert main(["fleet", "report", str(fleet)]) == 2
    assert f"{fleet}:3:11: " in capsys.readouterr().err


def test_a_backup_is_a_ledger_of_its_own(fleet: Path, capsys: pytest.CaptureFixture[str]) -> None:
    copy = fleet.parent / "safe" / "copy.db"
    assert main(["fleet", "backup", str(fleet), "-o", str(copy)]) == 0
    assert "copy.db" in capsys.readouterr().out
    assert copy.read_bytes().startswith(b"SQLite format 3")
