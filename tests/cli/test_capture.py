"""``zlmreport capture``: what an operator sees, and what is left behind."""

from __future__ import annotations

import fcntl
import json
import os
import pty
import select
import struct
import termios
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

import pytest

from cli.commands import Run
from environments import ROOT
from live.capture.virtual import InStep
from processes import PATIENCE, ZLMREPORT, group
from replacing import replaced
from zlmreport.cli import main
from zlmreport.live.capture.journal import Journal
from zlmreport.plugin.instrument import JournalHistory, ReadingRecorded, read_journal

PLUGIN = Path(__file__).with_name("scripted.py")
WHOLE = "0 20 t25 20 0 -5"
JOB = """\
schema: zlmreport/job/1
certificate: {number: CAP-1, kind: report}
axis: {name: X, travel: [-10, 30]}
measurement:
  feed: 6000
  dwell: 3
  source:
    plugin: serial-interferometer
    journal: x.journal
    instrument: {plugin: scripted, moves: MOVES}
plan: {targets: {positions: [0, 20]}, runs: 1, overrun: 5}
evaluate: [iso230-2:2014]
output: {formats: [json]}
"""


class Bench:
    """A folder with a job, and a command line in it."""

    def __init__(self, capture: pytest.CaptureFixture[str]) -> None:
        self._capture = capture
        self.journal = Path("x.journal")

    def job(self, moves: str, *changes: tuple[str, str]) -> None:
        Path("job.yaml").write_text(replaced(JOB, ("MOVES", moves), *changes), encoding="utf-8")

    def run(self, *arguments: str) -> Run:
        self._capture.readouterr()
        code = main([*arguments, "--plugin", str(PLUGIN)])
        return Run(code, *self._capture.readouterr())

    def visits(self) -> list[int]:
        entries = self.history().entries
        return [entry.event.visit.number for entry in entries if isinstance(entry.event, ReadingRecorded)]

    def taken(self) -> int:
        return self.history().progress.taken

    def history(self) -> JournalHistory:
        history = read_journal(self.journal)
        assert history is not None
        return history


@pytest.fixture
def bench(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Bench:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("NO_COLOR", "1")
    return Bench(capsys)


def test_a_test_is_captured_and_evaluated(bench: Bench) -> None:
    bench.job(WHOLE)
    done = bench.run("capture", "job.yaml")
    assert (done.code, done.messages) == (0, "")
    assert done.output == (
        "CAP-1  axis X, linear, 4 visits, about 13 s\n"
        "1. let the axis stand still at −5.000 mm, for the datum\n"
        "2. start the program at visit 1: 0.000 mm from below, run 1\n"
        "datum    the reading is taken for −5.000 mm\n"
        "1/4      run 1 ↑     0.000 mm      +0.00 µm  range 0.00 µm\n"
        "2/4      run 1 ↑    20.000 mm      +3.00 µm  range 0.00 µm\n"
        "3/4      run 1 ↓    20.000 mm      +3.00 µm  range 0.00 µm\n"
        "4/4      run 1 ↓     0.000 mm      +0.00 µm  range 0.00 µm\n"
        "closure  +0.00 µm at the datum\n"
        "next: zlmreport job.yaml\n"
    )
    assert bench.run("job.yaml").code == 0
    results = json.loads(Path("CAP-1.json").read_text(encoding="utf-8"))
    assert results["evaluations"][0]["positions"][1]["mean_fwd"] == pytest.approx(3.0, abs=1e-6)


def test_before_the_capture_the_job_can_be_checked_and_planned(bench: Bench) -> None:
    bench.job(WHOLE)
    checked = bench.run("check", "job.yaml")
    assert (checked.code, checked.messages) == (0, "")
    assert "the job is sound; its readings are still to be captured" in checked.output
    assert "At least 5 runs in each direction: 1 run" in checked.output
    assert checked.output.endswith("next: zlmreport capture job.yaml\n")
    bench.job(WHOLE, ("runs: 1", "runs: 5"))
    assert bench.run("plan", "job.yaml").code == 0


def test_a_check_before_the_capture_asks_for_an_instrument(bench: Bench) -> None:
    bench.job(WHOLE, ("    instrument: {plugin: scripted, moves: " + WHOLE + "}\n", ""))
    checked = bench.run("check", "job.yaml")
    assert (checked.code, "measurement.source.instrument is missing" in checked.messages) == (2, True)


def test_after_an_interruption_the_check_says_how_to_go_on(bench: Bench) -> None:
    bench.job("0 lost")
    bench.run("capture", "job.yaml")
    assert bench.run("check", "job.yaml").output.endswith("next: zlmreport capture job.yaml --resume\n")


def test_a_check_before_the_capture_finds_limits_that_make_no_sense(bench: Bench) -> None:
    bench.job(WHOLE, ("dwell: 3", "dwell: 1"))
    checked = bench.run("check", "job.yaml")
    assert checked.code == 2
    assert "job.yaml:6:10: measurement.dwell: the axis rests 1 s" in checked.messages


def test_without_a_terminal_the_main_job_names_the_command(bench: Bench) -> None:
    bench.job(WHOLE)
    done = bench.run("job.yaml")
    assert done.code == 3
    assert (
        "x.journal: there is no such journal: nothing was captured yet; 'zlmreport capture" in done.messages
    )


def test_an_unfinished_journal_makes_no_certificate(bench: Bench) -> None:
    bench.job("0 20")
    bench.run("capture", "job.yaml")
    done = bench.run("job.yaml")
    assert done.code == 3
    assert "the capture is not finished: 2 of 4 visits" in done.messages


def test_an_instrument_that_goes_leaves_what_was_taken_and_says_how_to_go_on(bench: Bench) -> None:
    bench.job("0 20")
    done = bench.run("capture", "job.yaml")
    assert done.code == 3
    assert done.messages == (
        "the port: the instrument is gone; look at its cable; go on with: zlmreport capture job.yaml "
        "--resume\n"
    )
    assert bench.taken() == 2


def test_where_nothing_was_read_there_is_nothing_to_resume(bench: Bench) -> None:
    bench.job("-5")
    done = bench.run("capture", "job.yaml")
    assert done.messages.endswith("; go on with: zlmreport capture job.yaml\n")
    bench.job(WHOLE)
    assert bench.run("capture", "job.yaml").code == 0


def test_the_capture_goes_on_after_the_datum_was_checked(bench: Bench) -> None:
    bench.job("0 20")
    bench.run("capture", "job.yaml")
    bench.job("t15 20 t25 20 0 -5")
    done = bench.run("capture", "job.yaml", "--resume")
    assert done.code == 0
    assert done.output.splitlines()[1:5] == [
        "1. let the axis come once more to 20.000 mm from below, to check the datum",
        "2. go on with the program at visit 3: 20.000 mm from above, run 1",
        "datum    holds: +0.00 µm against visit 2",
        "3/4      run 1 ↓    20.000 mm      +3.00 µm  range 0.00 µm",
    ]


def test_beside_a_capture_that_is_at_work_none_is_said_to_be_there_to_resume(bench: Bench) -> None:
    bench.job("0 20")
    bench.run("capture", "job.yaml")
    before = bench.journal.read_bytes()
    with Journal.resume(bench.journal):
        for arguments in ((), ("--resume",), ("--end",), ("--resume", "--retake", "1")):
            done = bench.run("capture", "job.yaml", *arguments)
            assert (done.code, done.messages) == (
                3,
                "x.journal: is being written by another capture; end that first, or name another journal\n",
            )
        checked = bench.run("check", "job.yaml").output
        assert checked.endswith("  a capture is at work on it: 2 of 4 visits\n")
        made = bench.run("job.yaml")
        assert made.code == 3
        assert "not finished: 2 of 4 visits, and it is at work; wait for its end (" in made.messages
    assert bench.journal.read_bytes() == before
    assert bench.run("check", "job.yaml").output.endswith("next: zlmreport capture job.yaml --resume\n")


def test_ctrl_c_leaves_a_journal_and_says_how_to_go_on(bench: Bench) -> None:
    bench.job("0 interrupt")
    done = bench.run("capture", "job.yaml")
    assert done.code == 130
    assert done.output.endswith("ended; go on with: zlmreport capture job.yaml --resume\n")
    assert bench.taken() == 1


def test_a_lost_beam_says_what_is_void_and_what_to_do(bench: Bench) -> None:
    bench.job("0 20 lost t25 20 0")
    done = bench.run("capture", "job.yaml")
    assert done.code == 3
    assert done.messages == (
        "zlmreport capture: the beam is broken. The datum is gone: visits 3 to 4 are void, from 20.000 mm ↓ "
        "of run 1 on. What was taken before stays; let the axis stand still at −5.000 mm, for the datum, "
        "then start the program at visit 1: 0.000 mm from below, run 1, attempt 2; go on with: zlmreport "
        "capture job.yaml --resume\n"
    )


def test_a_run_whose_zero_was_lost_is_taken_again(bench: Bench) -> None:
    bench.job("0 20 lost")
    bench.run("capture", "job.yaml")
    bench.job(WHOLE)
    assert bench.run("capture", "job.yaml", "--resume").code == 0
    done = bench.run("job.yaml")
    assert done.code == 0


def test_readings_that_come_too_seldom_are_refused_with_what_helps(bench: Bench) -> None:
    bench.job("slow")
    done = bench.run("capture", "job.yaml")
    assert done.code == 3
    assert "let the instrument send more often (its key rate)" in done.messages


def test_a_long_silence_is_named_and_the_capture_goes_on(bench: Bench) -> None:
    bench.job("0 silent")
    done = bench.run("capture", "job.yaml")
    assert "SILENT   no sound reading came for 100.0 s; visits may have gone unseen\n" in done.output


def test_a_lost_place_is_asked_for_and_files_nothing_without_a_terminal(bench: Bench) -> None:
    bench.job("0 20 t-5 0", ("runs: 1", "runs: 2"))
    done = bench.run("capture", "job.yaml", "--json")
    assert done.code == 3
    question = json.loads(done.output.splitlines()[-1])
    assert question["record"] == "unclear"
    assert {visit for visit, share in question["candidates"] if share > 0.1} == {1, 5}
    assert "state --answer with the number of the visit, or none" in done.messages
    assert bench.taken() == 2


def test_the_answer_files_the_reading_that_was_asked_about(bench: Bench) -> None:
    bench.job("0 20 t-5 0", ("runs: 1", "runs: 2"))
    bench.run("capture", "job.yaml")
    bench.job("t15 20 t25 20 0 -5", ("runs: 1", "runs: 2"))
    bench.run("capture", "job.yaml", "--resume", "--answer", "5")
    assert bench.visits()[:3] == [1, 2, 5]


@pytest.mark.parametrize(
    ("answer", "message"),
    [
        ("2", "is at another target"),
        ("9", "'9' is no visit: state a number from 1 to 8, or none"),
        ("9" * 5000, f"'{'9' * 60}' is no visit"),
    ],
)
def test_an_answer_that_cannot_be_is_refused(answer: str, message: str, bench: Bench) -> None:
    bench.job("0 20 t-5 0", ("runs: 1", "runs: 2"))
    bench.run("capture", "job.yaml")
    done = bench.run("capture", "job.yaml", "--resume", "--answer", answer)
    assert (done.code, message in done.messages) == (2, True)


def test_an_answer_without_a_question_is_refused(bench: Bench) -> None:
    bench.job("0 20")
    bench.run("capture", "job.yaml")
    done = bench.run("capture", "job.yaml", "--resume", "--answer", "1")
    assert (done.code, "no question is open" in done.messages) == (2, True)


def test_a_capture_that_is_closed_has_missing_readings(bench: Bench) -> None:
    bench.job("0 20 t25 20")
    bench.run("capture", "job.yaml")
    done = bench.run("capture", "job.yaml", "--end")
    assert (done.code, done.output.splitlines()[0]) == (
        0,
        "closed after 3 of 4 visits; what was not taken is missing",
    )
    done = bench.run("job.yaml")
    assert done.code == 0
    assert "missing" in done.output


def test_a_second_capture_does_not_write_over_the_first(bench: Bench) -> None:
    bench.job(WHOLE)
    bench.run("capture", "job.yaml")
    before = bench.journal.read_bytes()
    done = bench.run("capture", "job.yaml")
    assert done.code == 3
    assert "x.journal: holds the finished capture of CAP-1; name another journal" in done.messages
    assert bench.journal.read_bytes() == before


def test_a_finished_capture_is_not_gone_on_with(bench: Bench) -> None:
    bench.job(WHOLE)
    bench.run("capture", "job.yaml")
    for option in ("--resume", "--end"):
        done = bench.run("capture", "job.yaml", option)
        assert (done.code, "the capture is finished" in done.messages) == (3, True)


def test_the_command_line_may_name_another_journal(bench: Bench) -> None:
    bench.job(WHOLE)
    assert bench.run("capture", "job.yaml", "--journal", "again.journal").code == 0
    assert Path("again.journal").exists()
    assert not bench.journal.exists()


def test_another_program_reads_what_happens_as_the_journal_has_it(bench: Bench) -> None:
    bench.job(WHOLE)
    done = bench.run("capture", "job.yaml", "--json")
    lines = [json.loads(line) for line in done.output.splitlines()]
    assert [line["record"] for line in lines] == ["datum", *["reading"] * 4, "closed", "finished"]
    assert lines[2]["deviation"] == pytest.approx(3e-6)


def test_a_damaged_journal_names_its_line(bench: Bench) -> None:
    bench.job("0 20")
    bench.run("capture", "job.yaml")
    lines = bench.journal.read_text().splitlines(keepends=True)
    lines[2] = lines[2].replace("reading", "missed ")
    bench.journal.write_text("".join(lines))
    done = bench.run("capture", "job.yaml", "--resume")
    assert done.code == 3
    assert done.messages.startswith("x.journal:3:1: the journal was altered or damaged from this line on;")


def test_a_port_that_is_not_there_leaves_no_journal(bench: Bench) -> None:
    bench.job(WHOLE, ("{plugin: scripted, moves: " + WHOLE + "}", "{plugin: umd1, port: /dev/nothing}"))
    done = bench.run("capture", "job.yaml")
    assert done.code == 3
    assert done.messages.startswith("/dev/nothing: there is no such port")
    assert not bench.journal.exists()


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--end", "--resume"], "--resume goes on and --end closes the capture: take one of them"),
        (["--end", "--retake", "1"], "--retake goes on and --end closes the capture: take one of them"),
        (["--answer", "1"], "--answer belongs to --resume: state both"),
    ],
)
def test_options_that_do_not_go_together_are_refused(options: list[str], message: str, bench: Bench) -> None:
    bench.job(WHOLE)
    done = bench.run("capture", "job.yaml", *options)
    assert (done.code, done.messages) == (2, f"zlmreport capture: {message}\n")


def _in_a_terminal(*arguments: str, columns: int = 80) -> str:
    """Run a command in a terminal, press Enter when asked; return all that it wrote there."""
    ours, theirs = pty.openpty()
    fcntl.ioctl(theirs, termios.TIOCSWINSZ, struct.pack("HHHH", 24, columns, 0, 0))
    with group(
        *(*ZLMREPORT, *arguments, "--plugin", PLUGIN),
        env={**os.environ, "TERM": "xterm", "COLUMNS": str(columns), "PYTHONPATH": str(ROOT / "tests")},
        stdin=theirs,
        stdout=theirs,
        stderr=theirs,
    ):
        os.close(theirs)
        written, prompts = b"", 0
        with suppress(OSError):  # the other end is closed
            while select.select([ours], [], [], PATIENCE)[0]:
                written += os.read(ours, 65536)
                if written.count(b"to stop: ") > prompts:
                    prompts += 1
                    os.write(ours, b"\n")
    os.close(ours)
    return written.decode()


def test_at_a_terminal_the_main_job_captures_first_and_the_operator_sees_to_troubles(bench: Bench) -> None:
    bench.job(f"0 lost wait {WHOLE}")
    screen = _in_a_terminal("job.yaml")
    assert "Press Enter when that is done" in screen
    assert screen.count("\a") == 5
    assert "CAP-1.json" in screen
    shown = [
        line for line in screen.replace("\x1b[J", "").split("\n") if line.startswith(("next", "now", "done"))
    ]
    assert shown
    assert max(map(len, shown)) <= 80


def test_a_narrow_terminal_ends_no_line_within_a_word_and_shows_the_way_to_the_datum(bench: Bench) -> None:
    bench.job(WHOLE)
    screen = _in_a_terminal("capture", "job.yaml", columns=50)
    lines = [line.rpartition("\r")[2] for line in screen.replace("\x1b[J", "").split("\r\n")]
    assert "2. start the program at visit 1: 0.000 mm from" in " ".join(lines)
    assert any(line.startswith("   below, run 1") for line in lines)
    assert any(line.startswith("next   −5.000 mm, the datum once more") for line in lines)


@pytest.fixture
def keyboard(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """A terminal at which the story of the instrument presses keys; its time is that of the story."""
    ours, theirs = pty.openpty()
    monkeypatch.setenv("KEYBOARD", str(ours))
    with os.fdopen(theirs) as stdin:
        monkeypatch.setattr("sys.stdin", stdin)
        for module in ("capture", "capture_display"):
            monkeypatch.setattr(f"zlmreport.cli.{module}.is_watched", lambda: True)
        monkeypatch.setattr(
            "zlmreport.cli.capture.ReadAhead", InStep
        )  # a story that is told waits for its keys
        before = termios.tcgetattr(stdin)
        yield
        assert termios.tcgetattr(stdin) == before
    os.close(ours)


@pytest.mark.usefixtures("keyboard")
@pytest.mark.parametrize(
    ("moves", "lines", "taken"),
    [
        ("0 20 press:r_1 t-5 0 press:r_run_1 t-5 " + WHOLE, ["RETAKE   visit 1:"], [1, 2, 1, 1, 2, 3, 4]),
        ("0 20 press:b t15 20 t25 20 0 -5", ["RETAKE   visit 2:"], [1, 2, 2, 3, 4]),
        ("0 press:s 20 t25 20 0 -5", ["skipped  run 1 ↑    20.000 mm", "passed   run 1 ↑"], [1, 3, 4]),
        ("0 20 press:c_coolant_on t25 20 0 -5", ["comment  coolant on"], [1, 2, 3, 4]),
        (
            "0 press:b_2 press:r_9 press:r_2 20 t25 20 0 -5",
            ["'b 2' is no order", "'9' is nothing"],
            [1, 2, 3, 4],
        ),
    ],
    ids=["retake", "back", "skip", "comment", "not understood"],
)
def test_the_operator_orders_from_the_keyboard(
    moves: str, lines: list[str], taken: list, bench: Bench
) -> None:
    bench.job(moves)
    done = bench.run("capture", "job.yaml")
    assert (done.code, done.messages) == (0, "")
    for line in lines:
        assert line in done.output
    assert bench.visits() == taken


@pytest.mark.usefixtures("keyboard")
def test_what_was_ordered_stands_with_the_results(bench: Bench) -> None:
    bench.job("0 press:s t25 20 press:c_coolant_on press:r_3 t25 20 0 -5")
    assert bench.run("capture", "job.yaml").code == 0
    bench.job(WHOLE, ("formats: [json]", "formats: [html]"))
    assert bench.run("job.yaml").code == 0
    page = Path("CAP-1.html").read_text(encoding="utf-8")
    for sentence in (
        "The operator left out visit 2.",
        "The operator after visit 3: coolant on",
        "Taken again as the operator ordered: visits 3; of each the last reading counts",
        "1 of 4 visits of the plan has no reading",
    ):
        assert sentence in page


def test_a_beam_that_is_lost_after_the_last_visit_voids_nothing(bench: Bench) -> None:
    bench.job("0 20 t25 20 0 lost")
    done = bench.run("capture", "job.yaml")
    assert (done.code, bench.visits()) == (0, [1, 2, 3, 4])
    assert "the datum is gone; all visits were taken before, and their readings stay" in done.output
    assert bench.run("job.yaml").code == 0


def test_a_visit_is_taken_again_after_the_end(bench: Bench) -> None:
    bench.job(WHOLE)
    bench.run("capture", "job.yaml")
    bench.job("t5 0 t-5 20")
    done = bench.run("capture", "job.yaml", "--retake", "2")
    assert (done.code, done.messages) == (0, "")
    assert bench.visits() == [1, 2, 3, 4, 2]
    assert bench.taken() == 4
    assert bench.run("job.yaml").code == 0


@pytest.mark.parametrize(
    ("retake", "message"),
    [
        ("4", "--retake: 4: the capture has not come so far; next is visit 3"),
        ("9", "--retake: '9' is nothing to take again: state a visit, 1 to 4, or a run, 'run 1' to 'run 1'"),
        ("walk 1", "--retake: 'walk 1' is nothing to take again"),
        ("9" * 5000, f"--retake: '{'9' * 60}' is nothing to take again"),
    ],
)
def test_what_cannot_be_taken_again_is_refused(retake: str, message: str, bench: Bench) -> None:
    bench.job("0 20")
    bench.run("capture", "job.yaml")
    before = bench.journal.read_bytes()
    done = bench.run("capture", "job.yaml", "--retake", retake)
    assert (done.code, done.messages.startswith(message)) == (2, True)
    assert bench.journal.read_bytes() == before


def test_a_run_under_another_datum_is_taken_again_as_a_whole_only(bench: Bench) -> None:
    two = ("runs: 1", "runs: 2")
    bench.job(f"{WHOLE} lost", two)
    bench.run("capture", "job.yaml")
    bench.job(WHOLE, two)
    done = bench.run("capture", "job.yaml", "--retake", "2")
    assert (done.code, "the datum is gone under which it was read" in done.messages) == (2, True)
    assert bench.run("capture", "job.yaml", "--retake", "run 1").code == 3  # then the story is over
    assert bench.visits() == [1, 2, 3, 4, 1, 2, 3, 4]
    progress = bench.history().progress
    assert progress.attempts[1] == 2
    assert progress.next.number == 5
