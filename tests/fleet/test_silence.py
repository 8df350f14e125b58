"""What should be there and is not has a word of its own, and is no silence."""

from __future__ import annotations

import datetime as dt
import itertools
import shutil
import sqlite3
import sys
import time
from collections.abc import Iterable, Iterator
from contextlib import AbstractContextManager, closing, contextmanager
from pathlib import Path
from signal import SIGKILL
from subprocess import Popen
from threading import Timer
from typing import NoReturn

import pytest

from fleet.fleets import FLEET, Fleet, Here, Witness, without_processes
from processes import PATIENCE, PYTHON, started
from zlmreport.fleet import ledger as ledger_module, night
from zlmreport.fleet.database import TakenError
from zlmreport.fleet.issuing import What
from zlmreport.fleet.ledger import Ledger, Night
from zlmreport.fleet.making import Task
from zlmreport.fleet.night import MissingError
from zlmreport.fleet.records import About, PastNight, State
from zlmreport.fleet.state import Rules, describe_state
from zlmreport.plugin import InputError, Language


@pytest.fixture
def fleet(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Fleet:
    """Return a fleet of five certificates, made in November 2026."""
    without_processes(monkeypatch)
    fleet = Fleet.of(tmp_path, "v", "w", "x", "y", "z")
    on_a_day("2026-11-20", monkeypatch)
    fleet.spend()
    return fleet


def on_a_day(day: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(night, "read_clock", lambda: f"{day}T02:00:00+00:00")


def test_a_job_that_is_gone_is_told_every_night_until_it_is_retired(fleet: Fleet) -> None:
    (fleet.folder / "jobs/x.yaml").unlink()
    for _ in range(2):
        assert fleet.spend().what["x"] is What.VANISHED
    assert [each.state for each in fleet.entries()].count(State.VANISHED) == 1
    fleet.write("fleet.yaml", f"{FLEET}retired: [jobs/x.yaml]\n")
    assert "x" not in fleet.spend().what


def test_a_job_that_was_renamed_is_told_with_its_new_name(fleet: Fleet) -> None:
    (fleet.folder / "jobs/x.yaml").rename(fleet.folder / "jobs/new.yaml")
    expected = "jobs/x.yaml: the job is gone, and jobs/new.yaml has its number CAL-X; name the old one"
    for _ in range(2):
        witness = fleet.spend()
        (problem,) = witness.of("x").problems
        assert expected in problem.message
    kept = next(each for each in fleet.entries() if each.state is State.VANISHED)
    assert "jobs/new.yaml has its number" in kept.message


def test_a_job_with_the_number_of_another_says_for_which_it_was_issued(fleet: Fleet) -> None:
    (fleet.folder / "jobs/x.yaml").rename(fleet.folder / "jobs/new.yaml")
    fleet.readings("x", "1 2 4 -1 -2 -3")
    draft = fleet.spend().of("new")
    assert (draft.what, draft.why) == (What.DRAFT, "new; CAL-X was issued on 2026-11-20 for jobs/x.yaml")


def test_a_file_where_the_folder_should_be_is_told(fleet: Fleet) -> None:
    output = fleet.folder / "certificates"
    shutil.rmtree(output)
    output.touch()
    with pytest.raises(MissingError, match="is no folder, and the certificates of the fleet belong into one"):
        fleet.spend()


def test_a_retired_job_is_left_alone_though_its_file_is_there(fleet: Fleet) -> None:
    fleet.write("fleet.yaml", f"{FLEET}retired: [jobs/x.yaml]\n")
    fleet.write("jobs/x.yaml", "no job any more")
    assert set(fleet.spend().what) == set("vwyz")


def test_a_job_that_is_there_again_is_made(fleet: Fleet) -> None:
    text = (fleet.folder / "jobs/x.yaml").read_text(encoding="utf-8")
    (fleet.folder / "jobs/x.yaml").unlink()
    fleet.spend()
    fleet.write("jobs/x.yaml", text)
    assert fleet.spend().what["x"] is What.CONFIRMED


def test_the_overview_counts_what_is_gone(fleet: Fleet) -> None:
    (fleet.folder / "jobs/x.yaml").unlink()
    fleet.spend()
    jobs = [f"jobs/{stem}.yaml" for stem in "vwyz"]
    state = describe_state("Hall North", fleet.entries(), jobs, None)
    assert state.counts == {"made": 0, "unchanged": 4, "left": 0, "draft": 0, "failed": 0, "vanished": 1}
    retired = describe_state("Hall North", fleet.entries(), jobs, None, Rules(None, lambda job: "x" in job))
    assert retired.counts["vanished"] == 0


def test_when_most_jobs_are_gone_nothing_is_done(fleet: Fleet) -> None:
    for stem in "wxyz":
        (fleet.folder / f"jobs/{stem}.yaml").unlink()
    with pytest.raises(
        MissingError, match="4 of 5 jobs are gone since the last night; look whether their folder"
    ):
        fleet.spend()
    assert noticed(fleet) == [About.JOBS]
    assert len(fleet.entries()) == 5


def test_an_empty_folder_of_certificates_is_not_filled_again(fleet: Fleet) -> None:
    shutil.rmtree(fleet.folder / "certificates")
    (fleet.folder / "certificates").mkdir()
    with pytest.raises(MissingError, match="the folder is empty, and 5 certificates were issued into it"):
        fleet.spend()
    assert noticed(fleet) == [About.FOLDER]
    assert MissingError.exit_code == 4


def test_a_ledger_that_knows_nothing_of_the_certificates_is_refused(fleet: Fleet) -> None:
    (fleet.folder / "ledger.db").unlink()
    with pytest.raises(MissingError, match="the ledger knows none of the certificates"):
        fleet.spend()
    assert noticed(fleet) == [About.LEDGER]
    assert (fleet.folder / "certificates/17/X/CAL-X.txt").exists()


def test_a_clock_that_was_set_back_is_noticed(fleet: Fleet, monkeypatch: pytest.MonkeyPatch) -> None:
    on_a_day("2026-10-01", monkeypatch)
    text = "the clock stands at 2026-10-01T02:00:00+00:00, before the last night: 2026-11-20T02:00:00+00:00"
    (notice,) = fleet.spend().notices
    assert (notice.about, notice.english) == (About.CLOCK, text)
    assert noticed(fleet) == [About.CLOCK]
    on_a_day("2026-10-02", monkeypatch)
    assert fleet.spend().notices == []


def noticed(fleet: Fleet) -> list[About]:
    """Return what the ledger keeps of the last night, for the overview and for Prometheus."""
    with Ledger.open(fleet.file.ledger, "Hall North") as ledger:
        last = ledger.find_last_night()
    assert last is not None
    assert last.ended is not None
    return [each.about for each in last.notices]


def test_a_night_in_which_the_clock_is_set_back_took_no_negative_time(
    fleet: Fleet, monkeypatch: pytest.MonkeyPatch
) -> None:
    times = iter(["2026-11-21T02:00:00+00:00"])
    monkeypatch.setattr(night, "read_clock", lambda: next(times, "2026-11-21T01:00:00+00:00"))
    fleet.spend()
    with Ledger.open(str(fleet.folder / "ledger.db"), "Hall North") as ledger:
        last = ledger.find_last_night()
    assert last is not None
    assert last.began.hour == 2
    assert 0 <= (last.seconds or 0) < 3600


@pytest.mark.parametrize(("minutes", "is_at_work"), [(-1440, False), (-1, True), (1, True), (1440, False)])
def test_a_sign_of_life_of_another_day_is_none_whatever_way_the_clock_was_set(
    minutes: int, *, is_at_work: bool
) -> None:
    beat = dt.datetime(2026, 11, 21, 2, tzinfo=dt.UTC)
    broken = PastNight(beat, None, beat=beat)
    assert broken.see_at(beat + dt.timedelta(minutes=minutes)).is_at_work is is_at_work


def test_many_jobs_that_are_gone_at_once_are_told_as_one_thing_too(fleet: Fleet) -> None:
    for stem in "klmno":
        fleet.job(stem)
    fleet.spend()
    for stem in "klmn":
        (fleet.folder / f"jobs/{stem}.yaml").unlink()
    witness = fleet.spend()
    assert [each.english for each in witness.notices] == [
        "4 of 10 jobs are gone since the last night; look whether that is meant"
    ]
    assert {witness.what[stem] for stem in "klmn"} == {What.VANISHED}
    assert fleet.spend().notices == []


def test_a_refusal_does_not_hide_that_the_night_before_was_interrupted(
    fleet: Fleet, monkeypatch: pytest.MonkeyPatch
) -> None:
    class Interrupted(Here):
        def make_all(self, _: Iterable[Task]) -> NoReturn:
            raise KeyboardInterrupt

    fleet.job("u")
    monkeypatch.setattr(night, "make_executor", lambda *_: Interrupted())
    with pytest.raises(KeyboardInterrupt):
        fleet.spend()
    monkeypatch.undo()
    without_processes(monkeypatch)
    (fleet.folder / "certificates").rename(fleet.folder / "elsewhere")
    with pytest.raises(MissingError):
        fleet.spend()
    with (
        Ledger.open(fleet.file.ledger, "Hall North") as ledger,
        ledger.hold_night("2026-11-23T02:00:00+00:00", "fleet.yaml") as third,
    ):
        assert third.was_interrupted


def test_a_night_that_was_broken_off_is_told_once_with_what_it_came_to(
    fleet: Fleet, monkeypatch: pytest.MonkeyPatch
) -> None:
    on_a_day("2026-11-21", monkeypatch)
    fleet.readings("x", "2 2 3 -1 -2 -3")
    with monkeypatch.context() as patched:
        patched.setattr(night, "find_left_documents", lambda *_: (_ for _ in ()).throw(KeyboardInterrupt))
        with pytest.raises(KeyboardInterrupt):
            fleet.spend()
    on_a_day("2026-11-22", monkeypatch)
    (fleet.folder / "certificates").rename(fleet.folder / "elsewhere")
    with pytest.raises(MissingError):
        fleet.spend()
    (fleet.folder / "elsewhere").rename(fleet.folder / "certificates")
    with Ledger.open(fleet.file.ledger, "Hall North") as ledger:
        last = ledger.find_last_night()
    assert last is not None
    assert [each.about for each in last.notices] == [About.BROKEN, About.FOLDER]
    moment = "2026-11-21T02:00:00+00:00"
    assert last.notices[0].english == (
        f"the night of {moment} was broken off, with its last sign of life at {moment}; it had come to "
        "1 as a draft. This one makes good what it left"
    )
    assert "der Lauf vom" in last.notices[0].text.in_language(Language.GERMAN)
    assert fleet.spend().notices == []


def test_jobs_whose_folder_is_not_mounted_are_missed_and_no_mistake(fleet: Fleet) -> None:
    (fleet.folder / "jobs").rename(fleet.folder / "elsewhere")
    with pytest.raises(
        MissingError, match="5 of 5 jobs are gone since the last night; look whether their folder"
    ):
        fleet.spend()
    assert noticed(fleet) == [About.JOBS]


def test_a_pattern_that_matches_no_more_is_named_and_the_others_are_made(fleet: Fleet) -> None:
    fleet.write("fleet.yaml", FLEET.replace("jobs/*.yaml", "[jobs/x.yaml, 'jobs/[vwyz].yaml']"))
    (fleet.folder / "jobs/x.yaml").unlink()
    fleet.readings("y", "2 2 3 -1 -2 -3")
    witness = fleet.spend()
    assert (witness.what["x"], witness.what["y"]) == (What.VANISHED, What.DRAFT)
    assert "no file is called 'jobs/x.yaml'" in witness.notices[0].english


def test_a_pattern_that_never_matched_is_a_mistake_and_makes_no_ledger(tmp_path: Path) -> None:
    fleet = Fleet.of(tmp_path)
    with pytest.raises(InputError, match="no file is called"):
        fleet.spend()
    assert not (tmp_path / "ledger.db").exists()


@pytest.mark.parametrize("retired", ["", "retired: [jobs/x.yaml]\n"])
def test_certificates_that_no_job_makes_any_more_are_still_watched(fleet: Fleet, retired: str) -> None:
    fleet.write("fleet.yaml", FLEET + retired)
    if not retired:
        fleet.job("x", ("CAL-X", "CAL-X-1"))
    assert fleet.spend().notices == []
    fleet.certificate("x").write_bytes(b"changed")
    for _ in range(2):
        assert [each.english.partition(";")[0] for each in fleet.spend().notices] == [
            "CAL-X: issued, gone or changed since, and made again by no job"
        ]
    assert noticed(fleet) == [About.DOCUMENTS]
    fleet.write("fleet.yaml", f"{FLEET}retired: [jobs/x.yaml, CAL-X]\n")
    assert fleet.spend().notices == []


def test_a_draft_that_is_made_again_says_what_made_it_differ(fleet: Fleet) -> None:
    fleet.readings("x", "2 2 3 -1 -2 -3")
    fleet.spend()
    fleet.write("fleet.yaml", f"{FLEET}defaults: {{decision_rule: simple}}\n")
    assert fleet.spend().what["x"] is What.DRAFT
    assert fleet.entries()[-3].message == "readings jobs/x.txt changed since 2026-11-20"


def test_a_certificate_that_is_gone_while_its_job_gives_a_draft_is_missed(fleet: Fleet) -> None:
    fleet.readings("x", "2 2 3 -1 -2 -3")
    fleet.spend()
    fleet.certificate("x").unlink()
    assert [each.about for each in fleet.spend().notices] == [About.DOCUMENTS]


def test_a_job_that_says_so_itself_is_no_second_news(fleet: Fleet) -> None:
    fleet.certificate("x").write_bytes(b"changed")
    witness = fleet.spend()
    assert witness.what["x"] is What.FAILED
    assert witness.notices == []


def test_an_axis_that_was_not_measured_again_is_told_once(
    fleet: Fleet, monkeypatch: pytest.MonkeyPatch
) -> None:
    fleet.write("fleet.yaml", f"{FLEET}interval: 365\n")
    fleet.job("u", ("name: X", "name: U"), ("certificate:\n", "fleet: {interval: 30}\ncertificate:\n"))
    told = []
    for day in ("2026-11-21", "2026-12-17", "2026-12-20", "2027-11-17", "2027-11-19", "2027-11-20"):
        on_a_day(day, monkeypatch)
        told.append([each.number for each in fleet.spend().seen if each.what is What.OVERDUE])
    assert told == [[], [], ["CAL-U"], [], ["CAL-Z"], []]


def test_an_axis_is_told_to_be_overdue_also_after_a_night_that_did_nothing(
    fleet: Fleet, monkeypatch: pytest.MonkeyPatch
) -> None:
    fleet.write("fleet.yaml", f"{FLEET}interval: 365\n")
    on_a_day("2027-11-18", monkeypatch)
    (fleet.folder / "certificates").rename(fleet.folder / "elsewhere")
    with pytest.raises(MissingError):
        fleet.spend()
    (fleet.folder / "elsewhere").rename(fleet.folder / "certificates")
    on_a_day("2027-11-19", monkeypatch)
    told = [sum(each.what is What.OVERDUE for each in fleet.spend().seen) for _ in range(2)]
    assert told == [1, 0]


def test_an_interval_that_comes_late_is_told_at_once(fleet: Fleet, monkeypatch: pytest.MonkeyPatch) -> None:
    on_a_day("2028-01-01", monkeypatch)
    fleet.spend()
    fleet.write("fleet.yaml", f"{FLEET}interval: 365\n")
    on_a_day("2028-01-02", monkeypatch)
    assert [sum(each.what is What.OVERDUE for each in fleet.spend().seen) for _ in range(2)] == [1, 0]


def test_the_overview_lists_by_when_axes_are_to_be_measured(fleet: Fleet) -> None:
    now = night_of("2027-12-01")
    state = describe_state("Hall North", fleet.entries(), ["jobs/x.yaml"], now, Rules(365))
    assert [(term.due.isoformat(), term.is_over) for term in state.terms] == [("2027-11-18", True)]


def test_an_axis_is_overdue_once_its_day_is_over(fleet: Fleet, monkeypatch: pytest.MonkeyPatch) -> None:
    on_that_day = night_of("2027-11-18")
    state = describe_state("Hall North", fleet.entries(), ["jobs/x.yaml"], on_that_day, Rules(365))
    assert (state.overdue, [term.due.isoformat() for term in state.soon]) == ((), ["2027-11-18"])
    fleet.write("fleet.yaml", f"{FLEET}interval: 365\n")
    told = []
    for day in ("2027-11-18", "2027-11-19"):
        on_a_day(day, monkeypatch)
        told.append(sum(each.what is What.OVERDUE for each in fleet.spend().seen))
    assert told == [0, 1]


def test_an_axis_that_was_measured_for_days_is_due_from_the_last_of_them(fleet: Fleet) -> None:
    fleet.job("u", ("date: 2026-11-18", "date: 2026-11-18\n  end: 2026-11-20"))
    fleet.spend()
    assert {each.number: each.measured for each in fleet.entries()}["CAL-U"] == "2026-11-20"


def night_of(day: str) -> PastNight:
    return PastNight(dt.datetime.fromisoformat(f"{day}T02:00:00+00:00"), None)


_AT_WORK = """
import sys, time
from zlmreport.fleet.ledger import Ledger

with Ledger.open(sys.argv[1], "Hall North") as ledger:
    with ledger.hold_night("2026-11-21T02:00:00+00:00", "fleet.yaml") as night:
        for now in sys.argv[2:]:
            night.beat(now)
        print("at work", flush=True)
        time.sleep(600)
"""


@contextmanager
def night_at_work(address: str, *beats: str) -> Iterator[Popen[bytes]]:
    """Let another process be at work on a ledger since 2 o'clock, with some signs of life."""
    with started(PYTHON, "-c", _AT_WORK, address, *beats) as program:
        program.until("at work")
        yield program.process


def _beat(address: str, now: str) -> None:
    with closing(sqlite3.connect(address)) as ledger, ledger:
        ledger.execute("UPDATE nights SET beat = ? WHERE ended IS NULL", [now])


@pytest.mark.parametrize(
    "beats",
    [(), ("2026-11-22T02:00:00+00:00",)],
    ids=["silent for half an hour", "the clock was set back by a day since"],
)
def test_a_night_that_gives_no_sign_of_life_is_killed_and_its_place_taken(
    fleet: Fleet, beats: tuple[str, ...], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(ledger_module, "WATCHED", 0.3)
    address = str(fleet.folder / "ledger.db")
    with (
        night_at_work(address, *beats) as stuck,
        Ledger.open(address, "Hall North") as ledger,
        ledger.hold_night("2026-11-21T02:30:00+00:00", "fleet.yaml") as second,
    ):
        assert stuck.wait(PATIENCE) == -SIGKILL
        assert second.took_over == "2026-11-21T02:00:00+00:00"


def test_a_night_that_lives_is_left_alone(fleet: Fleet) -> None:
    address = str(fleet.folder / "ledger.db")
    with (
        night_at_work(address, "2026-11-21T02:29:00+00:00") as at_work,
        Ledger.open(address, "Hall North") as ledger,
    ):
        with pytest.raises(TakenError), ledger.hold_night("2026-11-21T02:30:00+00:00", "fleet.yaml"):
            pass
        assert at_work.poll() is None


def test_a_night_that_lives_on_after_the_computer_slept_is_left_alone(fleet: Fleet) -> None:
    address, morning = str(fleet.folder / "ledger.db"), "2026-11-21T08:00:00+00:00"
    with night_at_work(address) as at_work, Ledger.open(address, "Hall North") as ledger:
        beating = Timer(1.0, _beat, [address, morning])
        beating.start()
        with pytest.raises(TakenError), ledger.hold_night(morning, "fleet.yaml"):
            pass
        assert at_work.poll() is None


def test_a_night_takes_the_time_that_the_computer_slept(
    fleet: Fleet, monkeypatch: pytest.MonkeyPatch
) -> None:
    times = itertools.chain([100.0], itertools.repeat(100.0 + 6 * 3600))
    monkeypatch.setattr(night, "read_steady_clock", lambda: next(times))
    fleet.job("a")
    witness = Witness()
    night.spend_night(fleet.file, night.Order(seconds=4 * 3600), witness)
    assert witness.what["a"] is What.LEFT
    with Ledger.open(str(fleet.folder / "ledger.db"), "Hall North") as ledger:
        last = ledger.find_last_night()
    assert last is not None
    assert last.seconds == 6 * 3600


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="this clock is Linux's")
def test_the_clock_of_a_night_goes_on_while_the_computer_sleeps() -> None:
    assert night.read_steady_clock() == pytest.approx(time.clock_gettime(time.CLOCK_BOOTTIME), abs=1.0)


def test_a_night_that_ends_while_the_next_begins_hides_nothing_from_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    without_processes(monkeypatch)
    fleet = Fleet.of(tmp_path, "a", "b", "c", "d", "e")
    usual, others = Ledger.hold_night, [fleet.spend]

    def hold(ledger: Ledger, began: str, fleet_file: str) -> AbstractContextManager[Night]:
        if others:
            assert others.pop()().what["a"] is What.ISSUED
        return usual(ledger, began, fleet_file)

    monkeypatch.setattr(Ledger, "hold_night", hold)
    witness = fleet.spend()
    assert set(witness.what.values()) == {What.UNCHANGED}
    assert witness.notices == []


def test_an_overview_alone_in_the_folder_of_certificates_does_not_make_it_mounted(fleet: Fleet) -> None:
    fleet.spend()
    (fleet.folder / "certificates").rename(fleet.folder / "elsewhere")
    (fleet.folder / "certificates").mkdir()
    for name in fleet.file.reports:
        fleet.write(f"certificates/{name}", "")
    with pytest.raises(MissingError):
        fleet.spend()
