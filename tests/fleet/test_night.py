"""What a night makes, and what it leaves alone."""

from __future__ import annotations

import datetime as dt
import os
import shutil
from dataclasses import replace
from pathlib import Path
from typing import Any

import matplotlib as mpl
import pytest

from fleet.fleets import FLEET, REGISTRY, VERSIONS, Fleet, without_processes
from zlmreport import pipeline
from zlmreport.fleet import making, night as nights
from zlmreport.fleet.issuing import What
from zlmreport.fleet.ledger import Ledger
from zlmreport.fleet.making import Failed, MadeCertificate, Task
from zlmreport.fleet.plan import Due
from zlmreport.fleet.records import State
from zlmreport.job import days
from zlmreport.plugin import AccessError, InputError, Language
from zlmreport.plugin.extension import Job

FONTS = Path(mpl.get_data_path(), "fonts", "ttf")
OTHER_READINGS = "2 2 3 -1 -2 -3"


@pytest.fixture
def fleet(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Fleet:
    """Return a fleet of two jobs."""
    without_processes(monkeypatch)
    return Fleet.of(tmp_path, "x", "y")


def test_the_first_night_issues_every_certificate(fleet: Fleet) -> None:
    assert fleet.spend().what == {"x": What.ISSUED, "y": What.ISSUED}
    assert fleet.files() == {"CAL-X.txt", "CAL-Y.txt"}


def test_files_lie_where_the_layout_puts_them(fleet: Fleet) -> None:
    fleet.spend()
    assert fleet.certificate("x").is_file()


def test_the_ledger_keeps_what_a_certificate_states(fleet: Fleet) -> None:
    fleet.spend()
    entry = fleet.entries()[0]
    assert (entry.job, entry.number, entry.machine) == ("jobs/x.yaml", "CAL-X", "17")
    assert (entry.axis, entry.measured, entry.state) == ("X", "2026-11-18", State.MADE)
    (parameter,) = entry.parameters
    assert (parameter.standard, parameter.symbol, parameter.unit) == ("exemplary:1", "E", "um")
    assert (parameter.value, parameter.limit) == pytest.approx((2.0, 20.0))
    assert parameter.conforms is True
    assert entry.files == ("17/X/CAL-X.txt",)


def test_what_is_unchanged_is_not_made_again(fleet: Fleet, monkeypatch: pytest.MonkeyPatch) -> None:
    fleet.spend()
    monkeypatch.setattr(making, "make_certificate", lambda _: pytest.fail("nothing is due"))
    assert fleet.spend().what == {"x": What.UNCHANGED, "y": What.UNCHANGED}
    assert len(fleet.entries()) == 2


def test_a_file_that_was_only_touched_is_unchanged(fleet: Fleet) -> None:
    fleet.spend()
    os.utime(fleet.folder / "jobs/x.txt", (1, 1))
    assert fleet.spend().what["x"] is What.UNCHANGED


def test_a_file_of_the_same_size_and_time_that_was_put_in_its_place_is_noticed(fleet: Fleet) -> None:
    readings = fleet.folder / "jobs/x.txt"
    os.utime(readings, (1, 1))
    fleet.spend()
    other = fleet.write("other.txt", OTHER_READINGS)
    other.replace(readings)
    os.utime(readings, (1, 1))
    assert fleet.spend().what["x"] is What.DRAFT


def test_changed_readings_become_a_draft_beside_the_certificate(fleet: Fleet) -> None:
    fleet.spend()
    issued = fleet.certificate("x").read_bytes()
    fleet.readings("x", OTHER_READINGS)
    happened = fleet.spend().of("x")
    assert (happened.what, happened.files) == (What.DRAFT, ("17/X/CAL-X.draft.txt",))
    assert fleet.certificate("x").read_bytes() == issued
    assert "Draft, not issued" in fleet.certificate("x", ".draft.txt").read_text(encoding="utf-8")


def _look(fleet: Fleet) -> None:
    """Give `x` a look of the laboratory's own: two fonts and a folder of templates."""
    fonts = [FONTS / "DejaVuSerif.ttf", FONTS / "DejaVuSerif-Bold.ttf"]
    names = [Path(shutil.copy(font, fleet.folder / "jobs")).name for font in fonts]
    fleet.write("jobs/look/style.css", "h2 { letter-spacing: 0 }")
    style = f"  style: {{typeface: {{regular: {names[0]}, semibold: {names[1]}}}, templates: look}}\n"
    fleet.job("x", ("  language: en\n", f"  language: en\n{style}"))


@pytest.mark.parametrize(
    ("name", "why"),
    [
        ("DejaVuSerif.ttf", "file jobs/DejaVuSerif.ttf changed"),
        ("DejaVuSerif-Bold.ttf", "file jobs/DejaVuSerif-Bold.ttf changed"),
        ("look/style.css", "templates jobs/look changed"),
        ("look/notice.html", "templates jobs/look changed"),  # a new one
        ("look/.hidden", ""),  # no template
    ],
)
def test_a_certificate_is_made_again_when_only_its_look_changes(fleet: Fleet, name: str, why: str) -> None:
    _look(fleet)
    assert fleet.spend().what["x"] is What.ISSUED
    assert fleet.foretold()["x"].due is Due.NOTHING
    with (fleet.folder / "jobs" / name).open("ab") as file:
        file.write(b" ")
    assert fleet.foretold()["x"].why.partition(" since")[0] == why


@pytest.mark.parametrize(
    ("name", "why"),
    [
        ("x.yaml", "job jobs/x.yaml changed"),
        ("x.txt", "readings jobs/x.txt changed"),
        ("DejaVuSerif.ttf", "file jobs/DejaVuSerif.ttf changed"),
        ("look/style.css", "templates jobs/look changed"),
    ],
)
def test_what_is_written_while_its_certificate_is_made_makes_it_due_again(
    fleet: Fleet, name: str, why: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    _look(fleet)
    run = making.pipeline.run

    def run_and_write(*given: object) -> object:
        outcome = run(*given)  # type: ignore[arg-type]  # as it was called
        with (fleet.folder / "jobs" / name).open("ab") as file:
            file.write(b" ")
        return outcome

    with monkeypatch.context() as patched:
        patched.setattr(making.pipeline, "run", run_and_write)
        fleet.spend()
    assert fleet.foretold()["x"].why.partition(" since")[0] == why


def test_a_draft_says_what_changed_since_when(fleet: Fleet) -> None:
    fleet.spend()
    fleet.readings("x", OTHER_READINGS)
    fleet.spend()
    first, *_, draft = fleet.entries()
    assert draft.message == f"readings jobs/x.txt changed since {first.night[:10]}"


def test_a_draft_that_is_unchanged_is_not_made_again(fleet: Fleet) -> None:
    fleet.spend()
    fleet.readings("x", OTHER_READINGS)
    fleet.spend()
    assert fleet.spend().what["x"] is What.UNCHANGED


def test_a_draft_goes_when_everything_is_as_it_was_issued(fleet: Fleet) -> None:
    fleet.spend()
    fleet.readings("x", OTHER_READINGS)
    fleet.spend()
    fleet.job("x")
    assert fleet.spend().what["x"] is What.CONFIRMED
    assert fleet.files() == {"CAL-X.txt", "CAL-Y.txt"}


def test_an_amendment_has_a_number_of_its_own_and_leaves_the_certificate(fleet: Fleet) -> None:
    fleet.spend()
    amends = "{number: CAL-X, reason: A reading was wrong}"
    fleet.job("x", ("CAL-X", f"CAL-X-1\n  amends: {amends}"), readings=OTHER_READINGS)
    assert fleet.spend().what["x"] is What.ISSUED
    assert {"CAL-X.txt", "CAL-X-1.txt"} <= fleet.files()


def test_a_certificate_that_is_gone_is_restored(fleet: Fleet) -> None:
    fleet.spend()
    issued = fleet.certificate("x").read_bytes()
    fleet.certificate("x").unlink()
    assert fleet.spend().what["x"] is What.RESTORED
    assert fleet.certificate("x").read_bytes() == issued


def test_a_certificate_that_somebody_changed_is_left_and_named(fleet: Fleet) -> None:
    fleet.spend()
    fleet.certificate("x").write_bytes(b"changed")
    happened = fleet.spend().of("x")
    assert happened.what is What.FAILED
    assert "CAL-X.txt is not as it was issued" in happened.problems[0].message
    assert fleet.certificate("x").read_bytes() == b"changed"


def test_a_file_that_no_ledger_knows_is_never_overwritten(fleet: Fleet) -> None:
    fleet.write("certificates/17/X/CAL-X.txt", "of last year")
    assert fleet.spend().what["x"] is What.DRAFT
    assert fleet.certificate("x").read_text(encoding="utf-8") == "of last year"


def test_a_lost_ledger_takes_over_certificates_that_are_the_same(fleet: Fleet) -> None:
    fleet.spend()
    for path in fleet.folder.glob("ledger.db*"):
        path.unlink()
    assert fleet.spend().what == {"x": What.ISSUED, "y": What.ISSUED}
    assert fleet.spend().what == {"x": What.UNCHANGED, "y": What.UNCHANGED}


def test_a_job_with_unreadable_data_fails_alone_with_its_message(fleet: Fleet) -> None:
    (fleet.folder / "jobs/x.txt").unlink()
    night = fleet.spend()
    assert night.what == {"x": What.FAILED, "y": What.ISSUED}
    assert night.of("x").problems[0].place.file.endswith("jobs/x.txt")
    entry = next(each for each in fleet.entries() if each.state is State.FAILED)
    assert (entry.number, entry.axis) == ("CAL-X", "X")
    assert entry.message == "\n".join(map(str, night.of("x").problems))


def test_a_measurement_of_a_day_that_has_not_come_fails_alone(
    fleet: Fleet, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(days, "read_clock", lambda: dt.date(2031, 3, 1))
    fleet.job("x", ("date: 2026-11-18", "date: 2031-04-18"))
    night = fleet.spend()
    assert night.what == {"x": What.FAILED, "y": What.ISSUED}
    assert "2031-04-18 lies in the future" in str(night.of("x").problems[0])


def test_what_failed_is_tried_again_the_next_night(fleet: Fleet) -> None:
    (fleet.folder / "jobs/x.txt").unlink()
    fleet.spend()
    fleet.job("x")
    happened = fleet.spend().of("x")
    assert happened.what is What.ISSUED
    assert happened.why.startswith("failed on ")


def test_a_job_that_is_no_yaml_fails_alone(fleet: Fleet) -> None:
    fleet.write("jobs/x.yaml", "certificate: [")
    assert fleet.spend().what == {"x": What.FAILED, "y": What.ISSUED}


def test_a_job_with_two_files_of_one_suffix_is_refused_alone(fleet: Fleet) -> None:
    fleet.job("x", ("[exemplary]", "[exemplary, exemplary-sheet, exemplary-again]"))
    night = fleet.spend()
    assert night.what == {"x": What.FAILED, "y": What.ISSUED}
    assert night.of("x").problems[0].message == (
        "a fleet keeps one .txt file of a certificate; choose exemplary or exemplary-again (output.formats)"
    )


def test_a_plugin_that_raises_fails_its_job_alone(fleet: Fleet, monkeypatch: pytest.MonkeyPatch) -> None:
    def raising(job: Job, *others: Any) -> pipeline.Outcome:
        if job.files[0].name == "x.yaml":
            raise ZeroDivisionError
        return run(job, *others)

    run = pipeline.run
    monkeypatch.setattr(pipeline, "run", raising)
    night = fleet.spend()
    assert night.what == {"x": What.FAILED, "y": What.ISSUED}
    assert "ZeroDivisionError" in night.of("x").problems[0].message


@pytest.mark.parametrize("written", ["CAL-X", "' CAL-X '"])
def test_two_new_jobs_of_one_number_are_both_refused_with_both_places(fleet: Fleet, written: str) -> None:
    fleet.job("y", ("CAL-Y", written))
    night = fleet.spend()
    assert night.what == {"x": What.FAILED, "y": What.FAILED}
    problem = night.of("x").problems[0]
    assert (problem.place.line, problem.place.column) == (3, 11)
    assert "jobs/y.yaml:3:11" in problem.message
    assert "CAL-X" in problem.message


def test_a_copied_number_is_refused_and_the_certificate_that_has_it_stays(fleet: Fleet) -> None:
    fleet.spend()
    fleet.job("z", ("CAL-Z", "CAL-X"))
    assert fleet.spend().what == {"x": What.UNCHANGED, "y": What.UNCHANGED, "z": What.FAILED}


@pytest.mark.parametrize("is_issued", [True, False], ids=["issued before", "of the same night"])
def test_a_number_that_is_changed_while_the_night_works_is_given_to_nobody(
    fleet: Fleet, monkeypatch: pytest.MonkeyPatch, *, is_issued: bool
) -> None:
    if is_issued:
        fleet.spend()
    fleet.job("a")
    make = making.make_certificate

    def make_late(task: Task) -> MadeCertificate | Failed:
        if task.job.name == "a.yaml":
            fleet.job("a", ("CAL-A", "CAL-X"))
        return make(task)

    monkeypatch.setattr(making, "make_certificate", make_late)
    night = fleet.spend()
    assert night.what["a"] is What.FAILED
    assert night.of("a").problems[0].message.startswith("its number was CAL-A when the night began")
    with Ledger.open(str(fleet.folder / "ledger.db"), "Hall North") as ledger:
        assert {number: issued.job for number, issued in ledger.list_certificates().items()} == {
            "CAL-X": "jobs/x.yaml",
            "CAL-Y": "jobs/y.yaml",
        }
    assert "jobs/x.yaml:3:11 too" in fleet.spend().of("a").problems[0].message


def test_what_a_certificate_leaves_doubtful_is_in_the_ledger(fleet: Fleet) -> None:
    fleet.readings("x", "0.001 0.002 0.003 0.004 0.005 0.006")
    (doubt, *_) = fleet.spend().of("x").doubts
    kept = next(each.doubts for each in fleet.entries() if each.number == "CAL-X")
    assert kept[0].in_language(Language.GERMAN) == doubt.in_language(Language.GERMAN)


def test_two_new_numbers_that_differ_in_case_alone_are_both_refused(fleet: Fleet) -> None:
    fleet.job("y", ("CAL-Y", "cal-X"))
    night = fleet.spend()
    assert night.what == {"x": What.FAILED, "y": What.FAILED}
    assert "jobs/y.yaml:3:11 (as cal-X) too" in night.of("x").problems[0].message


def test_a_number_that_differs_in_case_alone_from_an_issued_one_is_refused(fleet: Fleet) -> None:
    fleet.spend()
    fleet.job("z", ("CAL-Z", "Cal-x"))
    night = fleet.spend()
    assert night.what == {"x": What.UNCHANGED, "y": What.UNCHANGED, "z": What.FAILED}
    fleet.job("z")
    fleet.job("x", ("CAL-X", "CAL-x"))
    night = fleet.spend()
    assert night.what == {"x": What.FAILED, "y": What.UNCHANGED, "z": What.ISSUED}
    assert "differs in case alone from CAL-X" in night.of("x").problems[0].message
    assert fleet.certificate("x").is_file()


def test_a_number_that_another_fleet_issued_is_refused(fleet: Fleet) -> None:
    fleet.spend()
    fleet.write("fleet.yaml", FLEET.replace("Hall North", "Hall South"))
    happened = fleet.spend().of("x")
    assert happened.what is What.FAILED
    assert "the fleet 'Hall North'" in happened.problems[0].message


def test_defaults_stand_under_every_job(fleet: Fleet) -> None:
    fleet.write("fleet.yaml", f"{FLEET}defaults: {{machine: {{model: HMC 500}}}}\n")
    fleet.spend()
    assert {each.machine for each in fleet.entries()} == {"HMC 500 17"}


def test_a_certificate_carries_the_defaults_and_a_job_that_extends_them(fleet: Fleet) -> None:
    fleet.write("fleet.yaml", f"{FLEET}defaults: {{machine: {{model: HMC 500}}}}\n")
    fleet.spend()
    files = [line.split()[0] for line in fleet.certificate("x").read_text(encoding="utf-8").splitlines()[2:]]
    assert files == ["fleet.x.yaml", "x.yaml", "fleet.defaults.yaml", "x.txt"]


def test_changed_defaults_make_drafts(fleet: Fleet) -> None:
    fleet.spend()
    fleet.write("fleet.yaml", f"{FLEET}defaults: {{machine: {{model: HMC 500}}}}\n")
    happened = fleet.spend().of("x")
    assert (happened.what, happened.why.rpartition(" since ")[0]) == (
        What.DRAFT,
        "the defaults of the fleet changed",
    )


def test_a_file_that_the_job_extends_is_watched(fleet: Fleet) -> None:
    fleet.write("shared.yaml", "machine: {model: HMC 500}\n")
    fleet.job("x", ("certificate:\n", "extends: ../shared.yaml\ncertificate:\n"))
    fleet.spend()
    fleet.write("shared.yaml", "machine: {model: HMC 501}\n")
    night = fleet.spend()
    assert night.what == {"x": What.DRAFT, "y": What.UNCHANGED}
    assert night.of("x").why.startswith("extended jobs/../shared.yaml changed since ")


def test_a_new_release_of_a_plugin_is_named(fleet: Fleet, monkeypatch: pytest.MonkeyPatch) -> None:
    fleet.spend()
    newer = VERSIONS | {"exemplary-plugins": "1.3 code"}
    monkeypatch.setattr(nights, "find_program_versions", lambda **_: newer)
    monkeypatch.setattr(making, "find_versions_once", lambda _: newer)
    happened = fleet.spend().of("x")
    assert happened.why.startswith("exemplary-plugins changed from 1.2 to 1.3 since ")
    assert happened.what is What.CONFIRMED
    assert happened.is_upgrade


def with_another_page(monkeypatch: pytest.MonkeyPatch, factor: float = 1.0) -> None:
    """Let a new release print another page, and come to other values by a factor."""
    newer = VERSIONS | {"exemplary-plugins": "1.3 code"}
    monkeypatch.setattr(nights, "find_program_versions", lambda **_: newer)
    monkeypatch.setattr(making, "find_versions_once", lambda _: newer)
    page = REGISTRY.renderer("exemplary")
    monkeypatch.setattr(page, "render", lambda certificate: f"1.3: {certificate.title}".encode())
    states = making.list_parameters_of
    monkeypatch.setattr(
        making,
        "list_parameters_of",
        lambda certificate: (replace(each, value=factor * each.value) for each in states(certificate)),
    )


def test_a_new_release_that_prints_another_page_of_the_same_values_is_no_news(
    fleet: Fleet, monkeypatch: pytest.MonkeyPatch
) -> None:
    fleet.spend()
    before = fleet.certificate("x").read_bytes()
    with_another_page(monkeypatch)
    assert fleet.spend().what == {"x": What.CONFIRMED, "y": What.CONFIRMED}
    assert fleet.certificate("x").read_bytes() == before
    assert fleet.files() == {"CAL-X.txt", "CAL-Y.txt"}
    assert fleet.spend().what == {"x": What.UNCHANGED, "y": What.UNCHANGED}


def test_a_new_release_that_comes_to_other_values_makes_drafts(
    fleet: Fleet, monkeypatch: pytest.MonkeyPatch
) -> None:
    fleet.spend()
    with_another_page(monkeypatch, factor=1.001)
    assert fleet.spend().what == {"x": What.DRAFT, "y": What.DRAFT}


def test_a_new_release_does_not_hide_that_a_reading_changed(
    fleet: Fleet, monkeypatch: pytest.MonkeyPatch
) -> None:
    fleet.spend()
    fleet.readings("x", "1 2 3 -1 -2 -3 ")
    with_another_page(monkeypatch)
    assert fleet.spend().what == {"x": What.DRAFT, "y": What.CONFIRMED}


def test_a_plugin_that_no_job_uses_changes_nothing(fleet: Fleet, monkeypatch: pytest.MonkeyPatch) -> None:
    fleet.spend()
    monkeypatch.setattr(nights, "find_program_versions", lambda **_: VERSIONS | {"another": "1.0 code"})
    assert fleet.spend().what["x"] is What.UNCHANGED


def test_a_worker_with_another_release_is_refused(fleet: Fleet, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(making, "find_versions_once", lambda _: VERSIONS | {"zlmreport": "0.0.9 code"})
    happened = fleet.spend().of("x")
    assert "this worker has zlmreport 0.0.9, and the night began with 0.1.0" in happened.problems[0].message


def test_a_folder_that_cannot_be_written_fails_the_job_and_issues_nothing(fleet: Fleet) -> None:
    fleet.write("certificates/17", "a file where a folder belongs")
    night = fleet.spend()
    assert night.what == {"x": What.FAILED, "y": What.FAILED}
    with Ledger.open(fleet.file.ledger, fleet.file.name) as ledger:
        assert not ledger.list_certificates()


def test_a_dry_run_says_what_is_due_and_writes_nothing(fleet: Fleet) -> None:
    assert {stem: each.due for stem, each in fleet.foretold().items()} == {
        "x": Due.CERTIFICATE,
        "y": Due.CERTIFICATE,
    }
    assert not (fleet.folder / "ledger.db").exists()
    assert not (fleet.folder / "certificates").exists()


def test_a_dry_run_says_why(fleet: Fleet) -> None:
    fleet.spend()
    fleet.readings("x", OTHER_READINGS)
    planned = fleet.foretold()
    assert planned["x"].why.startswith("readings jobs/x.txt changed since 2")
    assert (planned["x"].due, planned["y"].due) == (Due.COMPARISON, Due.NOTHING)


def test_two_nights_at_once_on_one_ledger_are_excluded(fleet: Fleet) -> None:
    with (
        Ledger.open(fleet.file.ledger, "Hall South") as ledger,
        ledger.hold_night("2026-11-21T02:00:00+00:00", "south.yaml"),
        pytest.raises(
            AccessError, match=r"another night is at work on this ledger \(south.yaml on .*, since"
        ),
    ):
        fleet.spend()


def test_a_pattern_without_a_job_ends_the_night_before_it_begins(fleet: Fleet) -> None:
    fleet.write("fleet.yaml", FLEET.replace("jobs/*.yaml", "[jobs/*.yaml, machines/*.yaml]"))
    with pytest.raises(InputError, match=r"fleet.yaml:3:21: jobs: no file is called 'machines/\*.yaml'"):
        fleet.spend()
    assert not (fleet.folder / "ledger.db").exists()


def test_a_certificate_stays_where_it_was_issued_when_the_layout_changes(fleet: Fleet) -> None:
    fleet.spend()
    fleet.write("fleet.yaml", FLEET.replace("{serial}/{axis}", "{axis}"))
    assert fleet.spend().what["x"] is What.UNCHANGED
    fleet.certificate("x").unlink()
    fleet.spend()
    assert fleet.certificate("x").is_file()
