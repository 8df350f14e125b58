"""``zlmreport fleet``: what people, logs and programs read of a night."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Callable
from io import StringIO
from pathlib import Path
from typing import Any

import pytest

from fleet.fleets import FLEET, Fleet, without_processes
from processes import PYTHON, run as run_program
from zlmreport.cli import main
from zlmreport.cli.fleet import NightProgress, TextLog, draw_bar
from zlmreport.fleet.issuing import Happened, What

OTHER_READINGS = "2 2 3 -1 -2 -3"
Run = Callable[..., tuple[int, str, str]]


@pytest.fixture
def fleet(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Fleet:
    """Return a fleet of three jobs in the current folder; one has no readings."""
    without_processes(monkeypatch)
    monkeypatch.chdir(tmp_path)
    fleet = Fleet.of(tmp_path, "x", "y", "z")
    (tmp_path / "jobs/z.txt").unlink()
    return fleet


@pytest.fixture
def run(capsys: pytest.CaptureFixture[str]) -> Run:
    """Return what runs a command and gives its exit code, output and messages."""

    def run(*arguments: str) -> tuple[int, str, str]:
        capsys.readouterr()
        code = main(arguments)
        return code, *capsys.readouterr()

    return run


def lines(text: str) -> list[str]:
    """Return a log without its times."""
    return [line.partition("  ")[2] for line in text.splitlines()]


def test_a_night_with_a_failed_job_ends_with_4_and_all_others_are_made(fleet: Fleet, run: Run) -> None:
    code, _, _ = run("fleet", "fleet.yaml")
    assert code == 4
    assert fleet.files() == {"CAL-X.txt", "CAL-Y.txt"}


@pytest.mark.usefixtures("fleet")
def test_the_log_says_what_happened_to_each_job_and_why(run: Run) -> None:
    _, output, messages = run("fleet", "fleet.yaml")
    assert lines(output)[:-1] == [
        "Hall North: 3 of 3 jobs are due",
        "issued    CAL-X  jobs/x.yaml: new",
        "issued    CAL-Y  jobs/y.yaml: new",
        "failed    CAL-Z  jobs/z.yaml: new",
        "            jobs/z.txt: cannot be read (named in jobs/z.yaml:12:11)",
    ]
    assert lines(output)[-1].endswith(": 2 issued, 1 failed")
    assert not messages


def test_what_is_made_again_for_a_new_release_alone_is_a_count() -> None:
    stream = StringIO()
    log = TextLog(stream)
    for number in range(3):
        log.write_happened(
            Happened(What.CONFIRMED, f"x{number}.yaml", f"CAL-{number}", is_upgrade=number > 0)
        )
    log.write_end(Counter({What.CONFIRMED: 3}), 2.0)
    lines = [line.partition("  ")[2] for line in stream.getvalue().splitlines()]
    assert lines == [
        "confirmed CAL-0  x0.yaml",
        "programs changed: 2 made again, and none of their values changed",
        "done in 2 s: 3 confirmed",
    ]


@pytest.mark.usefixtures("fleet")
def test_quiet_leaves_the_failures(run: Run) -> None:
    assert run("fleet", "fleet.yaml", "--quiet") == (
        4,
        "",
        "jobs/z.txt: cannot be read (named in jobs/z.yaml:12:11)\n",
    )


def test_the_second_night_counts_what_is_unchanged(fleet: Fleet, run: Run) -> None:
    fleet.job("z")
    assert run("fleet", "fleet.yaml", "--quiet") == (0, "", "")
    code, output, _ = run("fleet", "fleet.yaml")
    assert code == 0
    assert lines(output)[0] == "Hall North: 0 of 3 jobs are due"
    assert lines(output)[1].endswith(": 3 unchanged")


@pytest.mark.usefixtures("fleet")
def test_a_summary_for_programs(run: Run) -> None:
    code, output, _ = run("fleet", "fleet.yaml", "--json")
    summary = json.loads(output)
    assert (code, summary["exit_code"], summary["schema"]) == (4, 4, "zlmreport/night/1")
    assert {what: number for what, number in summary["counts"].items() if number} == {
        "issued": 2,
        "failed": 1,
    }
    first, *_, last = summary["jobs"]
    assert (first["what"], first["number"], first["files"]) == ("issued", "CAL-X", ["17/X/CAL-X.txt"])
    assert last["problems"] == [
        {
            "file": "jobs/z.txt",
            "line": None,
            "column": None,
            "message": "cannot be read (named in jobs/z.yaml:12:11)",
        }
    ]


@pytest.mark.usefixtures("fleet")
def test_a_summary_for_programs_says_what_concerned_the_whole_night(run: Run) -> None:
    _, output, _ = run("fleet", "fleet.yaml", "--json", "--max-time", "1e-9")
    (notice,) = json.loads(output)["notices"]
    assert notice == {
        "about": "left",
        "message": "the time of the night was over before 3 of 3 jobs; they are for the next night",
    }


@pytest.mark.usefixtures("fleet")
def test_a_log_for_programs(run: Run) -> None:
    _, output, _ = run("fleet", "fleet.yaml", "--log-json")
    events: list[dict[str, Any]] = [json.loads(line) for line in output.splitlines()]
    assert [each["event"] for each in events] == ["begun", "issued", "issued", "failed", "ended"]
    assert events[-1]["counts"]["failed"] == 1
    assert all(each["time"].endswith("+00:00") for each in events)


def test_a_log_in_a_file_goes_on_from_night_to_night(fleet: Fleet, run: Run) -> None:
    fleet.write("fleet.yaml", f"{FLEET}log: {{file: logs/fleet.log}}\n")
    run("fleet", "fleet.yaml", "--quiet")
    run("fleet", "fleet.yaml", "--quiet")
    begun = [each for each in lines((fleet.folder / "logs/fleet.log").read_text()) if "are due" in each]
    assert begun == ["Hall North: 3 of 3 jobs are due", "Hall North: 1 of 3 jobs are due"]


def test_a_dry_run_says_what_would_be_done_and_why(fleet: Fleet, run: Run) -> None:
    run("fleet", "fleet.yaml")
    fleet.readings("x", OTHER_READINGS)
    day = fleet.entries()[0].night[:10]
    code, output, _ = run("fleet", "fleet.yaml", "--dry-run")
    assert code == 0
    anew = "would be made anew, and be a draft if it differs from what was issued"
    assert output.splitlines() == [
        f"CAL-X  jobs/x.yaml: readings jobs/x.txt changed since {day}; {anew}",
        f"CAL-Z  jobs/z.yaml: failed on {day}; would be made",
        "2 of 3 jobs are due; nothing was made",
    ]
    assert fleet.files() == {"CAL-X.txt", "CAL-Y.txt"}


def test_a_dry_run_for_programs(fleet: Fleet, run: Run) -> None:
    fleet.write("jobs/y.yaml", "certificate: [")
    _, output, _ = run("fleet", "fleet.yaml", "--dry-run", "--json")
    due = json.loads(output)["due"]
    assert [each["due"] for each in due] == ["certificate", "refused", "certificate"]
    (problem,) = due[1]["problems"]
    assert problem["file"].endswith("jobs/y.yaml")
    assert (problem["line"], problem["column"]) == (1, 15)


@pytest.mark.usefixtures("fleet")
@pytest.mark.parametrize(
    ("number", "shown"), [("0", "'0'"), ("9" * 5000, f"'{'9' * 60}'… (5,000 characters)")]
)
def test_a_number_of_workers_that_is_none_is_refused(number: str, shown: str, run: Run) -> None:
    code, _, messages = run("fleet", "fleet.yaml", "--workers", number)
    assert code == 2
    assert f"--workers: {shown} is no number of processes; write 2" in messages


def test_a_number_of_workers_is_not_asked_of_a_scheduler(fleet: Fleet, run: Run) -> None:
    fleet.write("fleet.yaml", f"{FLEET}executor: {{kind: dask, scheduler: 'tcp://x:1'}}\n")
    code, _, messages = run("fleet", "fleet.yaml", "--workers", "2")
    assert code == 2
    assert "--workers: a scheduler has the workers that it has" in messages


def test_a_fleet_file_with_a_mistake_is_refused(fleet: Fleet, run: Run) -> None:
    fleet.write("fleet.yaml", f"{FLEET}jobz: x\n")
    code, _, messages = run("fleet", "fleet.yaml")
    assert code == 2
    assert messages.startswith("fleet.yaml:6:1: unknown key 'jobz'; did you mean 'jobs'?")


def test_a_night_in_which_nothing_is_due_loads_no_library_that_draws_or_sets_pages() -> None:
    heavy = "{'dask', 'distributed', 'jinja2', 'matplotlib', 'weasyprint'}"
    script = f"import sys, zlmreport.cli.fleet; print(sorted({heavy} & set(sys.modules)))"
    done = run_program(PYTHON, "-c", script, check=True)
    assert done.stdout == "[]\n"


class Terminal(StringIO):
    """A stream that is a terminal."""

    def isatty(self) -> bool:
        return True


def test_a_terminal_shows_a_bar_that_goes_when_all_is_done() -> None:
    terminal = Terminal()
    progress = NightProgress(terminal, 2)
    progress.advance(failed=False)
    progress.hide()
    *_, last, gone = terminal.getvalue().split("\r")
    assert "1/2 [###############...............]" in last
    assert gone == "\x1b[K"


def test_a_file_shows_no_bar() -> None:
    stream = StringIO()
    NightProgress(stream, 2).advance(failed=False)
    assert not stream.getvalue()


@pytest.mark.parametrize(
    ("done", "seconds", "text"),
    [
        (0, 0.0, "   0/1000 [..............................]"),
        (100, 20.0, " 100/1000 [###...........................]  5.0/s, 3 min left"),
        (1000, 200.0, "1000/1000 [##############################]  5.0/s, 0 s left"),
        (1, 30.0, "   1/1000 [..............................]  0.03/s, 8 h 20 min left"),
    ],
)
def test_the_bar_has_the_rate_and_the_time_that_is_left(done: int, seconds: float, text: str) -> None:
    assert draw_bar(done, 1000, 0, seconds).strip() == text.strip()
