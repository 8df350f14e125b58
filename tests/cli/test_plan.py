"""``zlmreport plan``: a test before it is done."""

from __future__ import annotations

import csv
import json
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from model.planning.planned import REGISTRY, WHOLE_PITCHES, job_text
from plugins.part_programs.controls import linuxcnc
from zlmreport.cli import main
from zlmreport.model.planning.planned_test import PlannedTest, describe_planned_test
from zlmreport.plugin.extension import Job

Capture = pytest.CaptureFixture[str]
#: What was planned for a job file of this content: most tests plan the same test and look at another thing.
_KNOWN: dict[bytes, PlannedTest] = {}


def _describe_once(job: Job, *others: Any) -> PlannedTest:
    content = job.files[0].content or b""
    if content not in _KNOWN:
        _KNOWN[content] = describe_planned_test(job, *others)
    return _KNOWN[content]


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return a folder with a job whose readings do not exist yet, in which commands work."""
    for command in ("plan", "report"):
        monkeypatch.setattr(f"zlmreport.cli.{command}.find_plugins", lambda **_: REGISTRY)
    monkeypatch.setattr("zlmreport.cli.plan.describe_planned_test", _describe_once)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "100")
    (tmp_path / "job.yaml").write_text(job_text(), encoding="utf-8")
    return tmp_path


@pytest.fixture
def values(folder: Path, capsys: Capture) -> Callable[..., Any]:
    """Return a function from changes of the job to what ``--json`` prints of its plan."""

    def planned(*changes: tuple[str, str]) -> Any:
        (folder / "job.yaml").write_text(job_text(*changes), encoding="utf-8")
        assert main(["plan", "job.yaml", "--json"]) == 0
        return json.loads(capsys.readouterr().out)

    return planned


@pytest.fixture
def lines(folder: Path, capsys: Capture) -> Callable[..., str]:
    """Return a function from changes of the job to what is printed of its plan."""

    def planned(*changes: tuple[str, str]) -> str:
        (folder / "job.yaml").write_text(job_text(*changes), encoding="utf-8")
        assert main(["plan", "job.yaml"]) == 0
        return capsys.readouterr().out

    return planned


def test_json_has_targets_in_mm_and_visits_by_target_direction_and_run(values: Callable[..., Any]) -> None:
    plan = values()
    assert plan["schema"] == "zlmreport/plan/1"
    assert len(plan["targets"]) == 11
    first, *_, last = plan["visits"]
    assert (first["target"], first["direction"], first["run"]) == (plan["targets"][0], "+", 1)
    assert (last["target"], last["direction"], last["run"]) == (plan["targets"][0], "-", 5)
    assert len(plan["visits"]) == 110


def test_visits_follow_the_method_of_the_job(values: Callable[..., Any]) -> None:
    plan = values(("method: linear", "method: pendulum"))
    begin = [(visit["direction"], visit["run"]) for visit in plan["visits"][:4]]
    assert begin == [("+", 1), ("-", 1), ("+", 2), ("-", 2)]
    assert {visit["target"] for visit in plan["visits"][:10]} == {plan["targets"][0]}


def test_times_of_visits_are_those_of_motion_and_rest(values: Callable[..., Any]) -> None:
    plan = values()
    one, other = plan["visits"][:2]
    assert other["time"] - one["time"] == pytest.approx((other["target"] - one["target"]) / 50 + 4)


def test_the_same_job_gives_the_same_plan(values: Callable[..., Any]) -> None:
    first = values()
    _KNOWN.clear()
    assert values() == first


def test_json_says_of_each_effect_what_is_visible_and_from_which_size(values: Callable[..., Any]) -> None:
    by_effect = {each["effect"]: each for each in values()["visibility"]}
    assert by_effect["screw-pitch"]["share"] > 0.7
    assert by_effect["backlash-gradient"]["smallest"]["unit"] == "um/m"
    assert by_effect["scale-expansion"]["log"] == ["axis_temperature"]
    assert by_effect["abbe"]["reason"] == "the job does not state axis.angular_errors"
    assert by_effect["abbe"]["smallest_rms"] is None


def test_json_has_the_requirements_of_each_standard(values: Callable[..., Any]) -> None:
    requirements = values(("plan: {}", "plan: {runs: 3}"))["requirements"]
    unmet = [each["requirement"] for each in requirements if each["met"] is False]
    assert unmet == ["At least 5 runs in each direction"]


def test_lines_say_what_is_hidden_why_and_what_to_change(lines: Callable[..., str]) -> None:
    text = " ".join(lines(("plan: {}", WHOLE_PITCHES)).split())
    hidden = text.partition("What it cannot see")[2]
    reason, _, effects = hidden.partition("choose targets with a random fraction: ")
    assert reason.endswith("all targets lie at the same phase of the pitch of 10 mm; ")
    assert re.search(r"screw-pitch: 0 % visible, then \d\d % ", effects)


def test_lines_warn_of_targets_at_half_pitches(lines: Callable[..., str]) -> None:
    half = "plan: {targets: {positions: [0, 55, 110, 165, 220, 275, 330, 385, 440, 495, 550]}}"
    text = " ".join(lines(("plan: {}", half)).split())
    assert (
        "check: all targets lie at two phases of the pitch of 10 mm: of what repeats with it, a part" in text
    )


def test_lines_say_what_is_hidden_by_the_sequence(lines: Callable[..., str]) -> None:
    text = " ".join(lines(("method: linear", "method: pendulum")).split())
    assert "in this sequence time runs along with the position; measure by the linear method" in text


def test_lines_name_the_columns_to_log(lines: Callable[..., str]) -> None:
    logs = lines().partition("What to log beside the readings\n")[2]
    assert "  axis_temperature: to be able to tell " in logs
    assert "scale-expansion" in logs
    assert "face" not in logs


def test_lines_warn_of_turning_round_beyond_the_travel(lines: Callable[..., str]) -> None:
    text = lines(("plan: {}", WHOLE_PITCHES))
    assert "check: it turns round at −5 mm and 605 mm; the travel is 0 mm to 600 mm" in text


def test_lines_mark_what_the_job_does_not_state(lines: Callable[..., str]) -> None:
    text = lines(("  feed: 3000\n", ""), ("plan: {}", "plan: {repeatability: 0.5}"))
    assert "2000 mm/min (assumed), 4 s at rest\n" in text
    assert "scatter by 0.50 µm (standard deviation)" in text


@pytest.mark.parametrize(
    ("method", "begin"),
    [
        ("linear", "  1↑ … 3↑  3↓ … 1↓  1↑ … 3↑  3↓ … 1↓  1↑ … 3↑  3↓ … 1↓\n"),
        ("unidirectional", "  1↑ … 3↑  1↑ … 3↑  1↑ … 3↑\n"),
        ("pendulum", "  1↑  1↓  1↑  1↓  1↑  1↓  …\n"),
        ("quasi-pilgrim", "  1↑  1↑  1↑  2↑  1↓  2↑  …\n"),
    ],
)
def test_sequence_is_shown_as_it_begins(lines: Callable[..., str], method: str, begin: str) -> None:
    few = ("plan: {}", "plan: {targets: {positions: [100, 250, 512]}, runs: 3}")
    assert begin in lines(few, ("method: linear", f"method: {method}"))


def test_targets_and_a_form_are_written(folder: Path, capsys: Capture) -> None:
    assert main(["plan", "job.yaml", "--output", "plan"]) == 0
    assert "plan/PLAN-1-targets.csv\nplan/PLAN-1-readings.csv\n" in capsys.readouterr().out
    rows = list(csv.reader((folder / "plan/PLAN-1-targets.csv").read_text("utf-8").splitlines()))
    assert rows[0] == ["number", "target"]
    assert len(rows) == 12


def test_form_that_is_filled_in_is_a_measurement(folder: Path, capsys: Capture) -> None:
    main(["plan", "job.yaml", "--output", "."])
    remark, header, *rows = (folder / "PLAN-1-readings.csv").read_text("utf-8").splitlines()
    filled = []
    for number, row in enumerate(rows):
        cells = row.split(",")
        cells[3] = str(number % 7)
        filled.append(",".join(cells))
    (folder / "not-measured-yet.csv").write_text("\n".join([remark, header, *filled]), encoding="utf-8")
    capsys.readouterr()
    assert main(["job.yaml"]) == 0
    assert "not met" not in capsys.readouterr().out


def test_form_that_is_there_is_never_written_over(folder: Path, capsys: Capture) -> None:
    (folder / "PLAN-1-readings.csv").write_text("filled in\n", encoding="utf-8")
    assert main(["plan", "job.yaml", "--output", "."]) == 2
    assert capsys.readouterr().err == (
        "PLAN-1-readings.csv: is there already; choose another folder, or remove it\n"
    )
    assert (folder / "PLAN-1-readings.csv").read_text("utf-8") == "filled in\n"
    assert not (folder / "PLAN-1-targets.csv").exists()


@pytest.mark.usefixtures("folder")
def test_files_that_were_written_stand_in_the_json(capsys: Capture) -> None:
    assert main(["plan", "job.yaml", "--output", "plan", "--json"]) == 0
    files = json.loads(capsys.readouterr().out)["files"]
    assert files == ["plan/PLAN-1-targets.csv", "plan/PLAN-1-readings.csv", "plan/PLAN-1-sequence.svg"]


def test_picture_of_the_sequence_has_a_mark_for_each_reading(folder: Path) -> None:
    assert main(["plan", "job.yaml", "--output", "plan"]) == 0
    picture = (folder / "plan/PLAN-1-sequence.svg").read_text("utf-8")
    assert 'aria-label="110 readings, 10 at each of 11 positions' in picture


def test_part_programs_of_the_job_are_written_with_its_keys(folder: Path, capsys: Capture) -> None:
    programs = "plan: {programs: [linuxcnc, {program: fanuc, number: 12}]}"
    (folder / "job.yaml").write_text(job_text(("plan: {}", programs)), encoding="utf-8")
    assert main(["plan", "job.yaml", "--output", "plan"]) == 0
    assert "plan/PLAN-1.ngc\nplan/PLAN-1.nc\n" in capsys.readouterr().out
    assert len(linuxcnc((folder / "plan/PLAN-1.ngc").read_text("ascii")).stops) == 121
    assert (folder / "plan/PLAN-1.nc").read_text("ascii").startswith("%\nO0012\n")


def test_part_programs_of_the_command_line_stand_instead_of_the_jobs(folder: Path) -> None:
    programs = "plan: {programs: [linuxcnc, {program: fanuc, number: 12}]}"
    (folder / "job.yaml").write_text(job_text(("plan: {}", programs)), encoding="utf-8")
    assert main(["plan", "job.yaml", "--output", "plan", "--program", "fanuc, heidenhain"]) == 0
    assert sorted(path.suffix for path in folder.glob("plan/*")) == [".csv", ".csv", ".h", ".nc", ".svg"]
    assert "\nO0012\n" in (folder / "plan/PLAN-1.nc").read_text("ascii")


@pytest.mark.usefixtures("folder")
def test_the_program_of_a_run_that_is_taken_again_stands_alone(folder: Path, capsys: Capture) -> None:
    (folder / "job.yaml").write_text(job_text(), encoding="utf-8")
    command = ["plan", "job.yaml", "--program", "linuxcnc", "--output", "plan"]
    assert main(command) == 0
    assert main([*command, "--run", "2"]) == 0
    program = next((folder / "plan").glob("*-run-2.ngc")).read_text(encoding="ascii")
    assert " run 2)" in program
    assert " run 1)" not in program
    capsys.readouterr()
    assert main([*command, "--run", "9"]) == 2
    assert "there is no run 9: state 1 to 5" in capsys.readouterr().err
    assert main(["plan", "job.yaml", "--run", "2"]) == 2
    assert "state --program NAME and --output DIR" in capsys.readouterr().err


def test_part_programs_that_wait_for_a_folder_are_told(lines: Callable[..., str]) -> None:
    text = lines(("plan: {}", "plan: {programs: [linuxcnc, fanuc]}"))
    assert "part programs for linuxcnc, fanuc: state a folder, --output DIR" in text


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--program", "fanuc"], "a program is a file; state its folder, too: --output DIR\n"),
        (["--program", ",", "-o", "plan"], "there is no program in the list; for example fanuc,heidenhain\n"),
        (["--program", "fanuc,fanuc", "-o", "plan"], "fanuc is listed twice; remove one of them\n"),
        (
            ["--program", "fanux", "-o", "plan"],
            "no plugin provides part program 'fanux'; did you mean 'fanuc'?",
        ),
    ],
)
def test_wrong_part_program_is_told(
    folder: Path, capsys: Capture, arguments: list[str], message: str
) -> None:
    assert main(["plan", "job.yaml", *arguments]) == 2
    assert capsys.readouterr().err.startswith(f"zlmreport plan --program: {message}")
    assert not (folder / "plan").exists()


def test_everything_that_controls_cannot_be_told_is_told_at_once(folder: Path, capsys: Capture) -> None:
    fine = "plan: {targets: {positions: [0, 100.00012, 300]}, programs: [linuxcnc, fanuc]}"
    (folder / "job.yaml").write_text(job_text(("plan: {}", fine)), encoding="utf-8")
    assert main(["plan", "job.yaml", "--output", "plan"]) == 2
    one, other = capsys.readouterr().err.splitlines()
    assert one.startswith("job.yaml:9:62: target 2, 100.00012 mm, has more than the 4 digits after the point")
    assert other.startswith(
        "job.yaml:9:72: target 2, 100.00012 mm, has more than the 3 digits after the point"
    )
    assert not (folder / "plan").exists()


def test_part_program_that_is_there_is_never_written_over(folder: Path, capsys: Capture) -> None:
    (folder / "PLAN-1.ngc").write_text("edited\n", encoding="utf-8")
    assert main(["plan", "job.yaml", "--output", ".", "--program", "linuxcnc"]) == 2
    assert capsys.readouterr().err.startswith("PLAN-1.ngc: is there already")
    assert (folder / "PLAN-1.ngc").read_text("utf-8") == "edited\n"


def test_mistake_of_the_job_is_told_at_its_place(folder: Path, capsys: Capture) -> None:
    (folder / "job.yaml").write_text(job_text((", travel: [0, 600]", "")), encoding="utf-8")
    assert main(["plan", "job.yaml"]) == 2
    assert capsys.readouterr().err == (
        "job.yaml:3:1: axis.travel is missing: targets are spread over it; for example [0, 1000]\n"
    )


def test_job_without_a_file_of_its_own_cannot_be_planned(folder: Path, capsys: Capture) -> None:
    assert main(["plan", str(folder / "none.yaml")]) == 3
    assert "cannot be read" in capsys.readouterr().err


def test_job_that_decides_is_printed_or_written(folder: Path, capsys: Capture) -> None:
    cool = ("plan: {}", "plan: {temperature_change: 0.01}")
    (folder / "job.yaml").write_text(job_text(cool), encoding="utf-8")
    asked = ["plan", "job.yaml", "--decide", "scale-error,scale-expansion"]
    assert main(asked) == 0
    printed = capsys.readouterr().out
    assert "extends: job.yaml\n" in printed
    assert main([*asked, "--output", "next"]) == 0
    written = (folder / "next" / "PLAN-1-decide.yaml").read_text(encoding="utf-8")
    assert written == printed.replace("job.yaml", '"../job.yaml"')
    assert "next: zlmreport plan next/PLAN-1-decide.yaml" in capsys.readouterr().out
    assert main(["plan", "next/PLAN-1-decide.yaml", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["certificate"]["number"] == "PLAN-1-decide"
    assert main([*asked, "--json", "--output", "again"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["schema"] == "zlmreport/decision/1"
    assert found["files"] == ["again/PLAN-1-decide.yaml"]
    assert found["decides"] >= 0.95
    assert found["minutes"] > found["job"]["plan"]["pause"]["minutes"]


def test_deciding_needs_readings_that_are_sound_or_none(folder: Path, capsys: Capture) -> None:
    (folder / "not-measured-yet.csv").write_text(
        "target,direction,run,deviation\n0,+,1,x\n", encoding="utf-8"
    )
    assert main(["plan", "job.yaml", "--decide", "scale-error,scale-expansion"]) == 2
    assert "not-measured-yet.csv:2:7" in capsys.readouterr().err
