"""``zlmreport plan`` of a job with a step gauge: its path, its picture, its probing programs."""

from __future__ import annotations

import csv
import json
from pathlib import Path

import pytest

from step_gauge.jobs import write_job
from step_gauge.languages import LANGUAGES
from zlmreport.cli import main

Capture = pytest.CaptureFixture[str]
PROGRAMS = ("safe_position: [0, 0, 400]", "safe_position: [0, 0, 400], programs: [mv-ms, dmis, ippdme]")


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "100")
    return tmp_path


def test_lines_say_what_is_probed_and_how(folder: Path, capsys: Capture) -> None:
    write_job(folder)
    assert main(["plan", "job.yaml"]) == 0
    text = " ".join(capsys.readouterr().out.split())
    assert "CMM-7 gauge.csv: 6 faces, 2 cycles, 12 points" in text
    assert "from (300.000, 195.000, 200.000) to (300.000, 245.000, 200.000)" in text
    assert "direction (0.000000, 1.000000, 0.000000)" in text
    assert "vertical, over the top of the blocks" in text
    assert "free of collisions: the tip stays 2.50 mm from block" in text
    assert "62 moves" in text
    assert "a picture of the path: state a folder, --output DIR" in text
    assert text.endswith("next: look at the picture, probe the gauge, then zlmreport job.yaml")


def test_json_has_every_move_in_mm(folder: Path, capsys: Capture) -> None:
    write_job(folder)
    assert main(["plan", "job.yaml", "--json"]) == 0
    plan = json.loads(capsys.readouterr().out)
    assert plan["schema"] == "zlmreport/probing-path/1"
    assert (plan["kind"], plan["cycles"], plan["faces"]) == ("vertical", 2, [1, 2, 3, 4, 5, 6])
    first, *_, last = plan["moves"]
    assert first == last == {"kind": "move", "face": None, "cycle": None, "to": [0, 0, 400], "normal": None}
    measured = [move for move in plan["moves"] if move["kind"] == "measure"]
    assert len(measured) == 12
    assert measured[0]["to"] == pytest.approx([300, 195, 200])
    assert measured[0]["normal"] == pytest.approx([0, -1, 0])
    assert plan["least_gap"]["value"] == pytest.approx(2.5)
    assert plan["files"] == []


def test_output_has_the_picture_the_moves_and_the_programs_of_the_job(folder: Path, capsys: Capture) -> None:
    write_job(folder, PROGRAMS)
    assert main(["plan", "job.yaml", "--output", "plan"]) == 0
    written = ["path.svg", "path.csv"]
    names = [f"CMM-7-{name}" for name in written] + ["CMM-7.mvms", "CMM-7.dmi", "CMM-7.prg"]
    assert sorted(path.name for path in (folder / "plan").iterdir()) == sorted(names)
    printed = capsys.readouterr().out
    assert all(f"plan/{name}\n" in printed for name in names)
    for identifier, name in (("mv-ms", "CMM-7.mvms"), ("dmis", "CMM-7.dmi"), ("ippdme", "CMM-7.prg")):
        text = (folder / "plan" / name).read_bytes().decode("ascii")
        assert len(LANGUAGES[identifier](text)) == 62


def test_the_table_of_moves_has_the_points_and_normals(folder: Path) -> None:
    write_job(folder)
    assert main(["plan", "job.yaml", "-o", "plan"]) == 0
    lines = (folder / "plan/CMM-7-path.csv").read_text("utf-8").splitlines()
    rows = list(csv.DictReader(line for line in lines if not line.startswith("#")))
    assert [int(row["move"]) for row in rows] == list(range(1, 63))
    measured = [row for row in rows if row["kind"] == "measure"]
    assert [int(row["face"]) for row in measured[:6]] == [1, 3, 5, 6, 4, 2]
    assert (measured[0]["y"], measured[0]["j"]) == ("195.00000", "-1.0000000")


def test_programs_of_the_command_line_stand_instead_of_the_jobs(folder: Path) -> None:
    write_job(folder, PROGRAMS)
    assert main(["plan", "job.yaml", "-o", "plan", "--program", "dmis"]) == 0
    assert sorted(path.suffix for path in (folder / "plan").iterdir()) == [".csv", ".dmi", ".svg"]


def test_programs_that_wait_for_a_folder_are_told(folder: Path, capsys: Capture) -> None:
    write_job(folder, PROGRAMS)
    assert main(["plan", "job.yaml"]) == 0
    out = capsys.readouterr().out
    assert "a picture of the path, part programs for mv-ms, dmis, ippdme: state a folder" in out


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (
            ("clearance: 3", "approach: 6"),
            "job.yaml:11:3: move 8 at face 3, to (300.000, 207.000, 200.000) mm: the tip runs into block 1",
        ),
        (("  tip_radius: 2\n", ""), "job.yaml:7:1: the tip is not stated; state step_gauge.tip_radius"),
        (
            ("  initial_points: points.csv\n", ""),
            "job.yaml:7:1: where the gauge lies is not stated; state step_gauge.initial_points",
        ),
        (
            ("cycles: 2", "retract: 3"),
            "job.yaml:11:3: step_gauge.path: retract: 3 mm is farther than the approach, 2.5 mm",
        ),
        (("cycles: 2", "cycle: 2"), "job.yaml:11:10: unknown key 'cycle' in step_gauge.path; did you mean"),
        (
            ("cycles: 2", "programs: [dmiss]"),
            "job.yaml:11:21: no plugin provides part program 'dmiss'; did you mean 'dmis'?",
        ),
        (
            ("evaluate:", "plan: {runs: 3}\nevaluate:"),
            "job.yaml:6:1: plan is about a test of target positions, and this job has a step gauge",
        ),
    ],
)
def test_what_cannot_be_planned_is_told_at_its_place(
    folder: Path, capsys: Capture, change: tuple[str, str], message: str
) -> None:
    write_job(folder, change)
    assert main(["plan", "job.yaml", "-o", "plan"]) == 2
    assert message in capsys.readouterr().err
    assert not (folder / "plan").exists()


def test_a_program_for_an_axis_takes_no_path(folder: Path, capsys: Capture) -> None:
    write_job(folder)
    assert main(["plan", "job.yaml", "-o", "plan", "--program", "linuxcnc"]) == 2
    assert "no plugin provides part program 'linuxcnc'; known: dmis, ippdme, mv-ms" in capsys.readouterr().err


def test_everything_that_languages_cannot_say_is_told_at_once(folder: Path, capsys: Capture) -> None:
    corrected = ("  tip_radius: 2\n", "  tip_radius: 2\n  radius_correction: true\n")
    points = ("initial_points: points.csv", "initial_points: surface.csv")
    write_job(folder, PROGRAMS, corrected, points)
    # with the radius corrected, the initial points are those of the surface
    text = (folder / "points.csv").read_text("ascii")
    surface = [_onto_the_surface(line) for line in text.splitlines()]
    (folder / "surface.csv").write_text("\n".join(surface) + "\n", encoding="ascii")
    assert main(["plan", "job.yaml", "-o", "plan"]) == 2
    assert "I++ DME reports centres of the tip" in capsys.readouterr().err
    assert not (folder / "plan").exists()


def _onto_the_surface(line: str) -> str:
    """Return a row of points with its point two millimetres nearer to the block."""
    cells = line.split(",")
    moves = {1: "y+", 2: "y+", 3: "y+", 4: "x-", 5: "x+", 6: "z-", 7: "z-", 8: "y-"}
    if not cells[1].isdigit():
        return line
    axis, sign = moves[int(cells[1])]
    index = 2 + "xyz".index(axis)
    cells[index] = f"{float(cells[index]) + (2 if sign == '+' else -2):.6f}"
    return ",".join(cells)


def test_files_that_are_there_are_never_written_over(folder: Path, capsys: Capture) -> None:
    write_job(folder)
    (folder / "CMM-7-path.csv").write_text("mine\n", encoding="ascii")
    assert main(["plan", "job.yaml", "-o", "."]) == 2
    assert "CMM-7-path.csv: is there already" in capsys.readouterr().err
    assert (folder / "CMM-7-path.csv").read_text("ascii") == "mine\n"
