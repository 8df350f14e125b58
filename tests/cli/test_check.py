"""``zlmreport check``."""

from __future__ import annotations

import datetime as dt
from pathlib import Path

import pytest

from cli.commands import Shop
from testing.exemplary import ExemplaryStandard
from zlmreport.cli import main
from zlmreport.job import days
from zlmreport.plugin import Words
from zlmreport.plugin.standard import Finding


def test_sound_job_is_told_with_every_requirement(shop: Shop) -> None:
    shop.job()
    run = shop.run("check", "job.yaml")
    assert (run.code, run.messages) == (0, "")
    assert run.output.splitlines() == [
        "job.yaml  the job and its data are sound",
        "  EX 1",
        "    not met  At least 5 positions: 3 positions",
    ]


MEASURED = """instrument: {name: Laser, expanded_uncertainty: 0.4}
environment: {axis_temperature: 68.2, expansion_coefficient: 11.5}
"""


def test_nothing_is_called_sound_above_a_doubt_or_an_incomplete_uncertainty(shop: Shop) -> None:
    shop.job(("evaluate:", f"{MEASURED}evaluate:"))
    checked = shop.run("check", "job.yaml").output.splitlines()
    made = shop.run("job.yaml").output.splitlines()
    assert checked[0] == "job.yaml  can be evaluated, with reservations"
    notices = checked[1 : checked.index("  EX 1")]
    assert notices[0].startswith("  open     U incomplete: Misalignment of the measuring line; Temperature")
    assert " ".join(" ".join(notices).split()).endswith("68.2 °F would be 20.1 °C")
    assert set(notices) <= set(made)


def test_of_a_budget_that_gives_no_u_it_is_told_why(shop: Shop) -> None:
    shop.job(("evaluate:", "uncertainty: {misalignment: 0.2}\nevaluate:"))
    notice = "  open     no U: the uncertainty of the measuring instrument is not stated"
    assert notice in shop.run("check", "job.yaml").output.splitlines()
    assert notice in shop.run("job.yaml").output.splitlines()


def test_a_requirement_stays_in_a_line_where_there_is_room_and_else_says_below_what_was_found(
    shop: Shop, monkeypatch: pytest.MonkeyPatch
) -> None:
    temperatures = Words("Temperatures reported, and where they were measured")
    expansion = Words("Results for 20 °C: measured there, corrected to it, or within 1 K of it, with U")
    found = [
        Finding(Words("At least 5 runs"), Words("5 runs"), met=True),
        Finding(temperatures, Words("not stated: temperature of the air"), met=None),
        Finding(expansion, Words("the temperature or the coefficient is not known"), met=False),
    ]
    monkeypatch.setattr(ExemplaryStandard, "requirements", lambda *_: found)
    monkeypatch.setenv("COLUMNS", "80")
    shop.job()
    assert shop.run("check", "job.yaml").output.splitlines()[1:] == [
        "  EX 1",
        "    met      At least 5 runs: 5 runs",
        "    open     Temperatures reported, and where they were measured:",
        "             not stated: temperature of the air",
        "    not met  Results for 20 °C: measured there, corrected to it, or within 1 K",
        "               of it, with U:",
        "             the temperature or the coefficient is not known",
    ]
    monkeypatch.delenv("COLUMNS")  # as in a pipe
    del found[2]
    assert shop.run("check", "job.yaml").output.splitlines()[2:] == [
        "    met   At least 5 runs: 5 runs",
        f"    open  {temperatures.en}: not stated: temperature of the air",
    ]


def test_nothing_is_written(shop: Shop) -> None:
    shop.job()
    before = sorted(shop.folder.rglob("*"))
    shop.run("check", "job.yaml")
    assert sorted(shop.folder.rglob("*")) == before


@pytest.mark.parametrize("command", [("check", "job.yaml"), ("job.yaml",)])
def test_a_measurement_of_a_day_that_has_not_come_is_refused(
    command: tuple[str, ...], shop: Shop, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(days, "read_clock", lambda: dt.date(2031, 3, 1))
    shop.job(("date: 2026-11-18", "date: 2031-04-18"))
    before = sorted(shop.folder.rglob("*"))
    run = shop.run(*command)
    assert run.code == 2
    assert "job.yaml:9:9: measurement.date: 2031-04-18 lies in the future" in run.messages
    assert sorted(shop.folder.rglob("*")) == before


def test_missing_readings_are_told(shop: Shop) -> None:
    shop.job()
    shop.write("six.txt", "1 nan 3 -1 -2 -3")
    assert "1 of 6 readings is missing" in shop.run("check", "job.yaml").output


def test_mistakes_of_all_jobs_are_told(shop: Shop) -> None:
    shop.job(("name: X", "nam: X"), name="a.yaml")
    shop.job(("kind: report", "kind: rapport"), name="b.yaml")
    run = shop.run("check", "a.yaml", "b.yaml")
    assert run.code == 2
    assert "a.yaml:7:8: " in run.messages
    assert "b.yaml:4:9: " in run.messages


def test_wrong_readings_are_a_mistake(shop: Shop) -> None:
    shop.job()
    shop.write("six.txt", "1 2")
    run = shop.run("check", "job.yaml")
    assert (run.code, run.output, run.messages) == (2, "", "six.txt: must hold 6 numbers, not 2\n")


def test_what_a_certificate_must_state_is_checked(shop: Shop) -> None:
    shop.job(("  kind: report\n", ""))
    run = shop.run("check", "job.yaml")
    assert run.code == 2
    assert "customer.name" in run.messages


def test_limit_that_is_not_met_is_no_mistake(shop: Shop) -> None:
    shop.job(("{E: 20}", "{E: 1}"))
    assert shop.run("check", "job.yaml").code == 0


def test_quiet_prints_nothing_on_a_sound_job(shop: Shop) -> None:
    shop.job()
    assert shop.run("check", "--quiet", "job.yaml").output == ""


def test_summary_has_requirements_and_no_files(shop: Shop) -> None:
    shop.job()
    (job,) = shop.run("check", "--json", "job.yaml").summary["jobs"]
    assert job["files"] == []
    assert job["evaluations"][0]["requirements"] == [
        {"requirement": "At least 5 positions", "found": "3 positions", "met": False}
    ]


def test_check_states_the_uncertainties_of_the_run(shop: Shop) -> None:
    shop.job(("evaluate:", f"{MEASURED}evaluate:"))
    checked, made = (shop.run(*words, "--json", "job.yaml").summary for words in (["check"], []))
    of_check, of_run = (each["jobs"][0]["evaluations"][0]["parameters"] for each in (checked, made))
    assert of_check[0]["expanded_uncertainty"]
    assert of_check == of_run


def test_of_readings_that_give_nothing_terminal_and_page_say_the_same(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """One reading at one target has no parameter, and so no uncertainty of one that could be incomplete."""
    (tmp_path / "one.csv").write_text("target,direction,run,deviation\n10,+,1,1.5\n", encoding="utf-8")
    (tmp_path / "job.yaml").write_text(
        "schema: zlmreport/job/1\ncertificate: {number: ONE-1, kind: report}\naxis: {name: X}\n"
        "measurement: {source: {plugin: laser-csv, file: one.csv}}\n"
        "instrument: {name: Laser, expanded_uncertainty: 0.4}\n"
        'evaluate: ["iso230-2:2014"]\noutput: {formats: [html]}\n',
        encoding="utf-8",
    )
    assert main([str(tmp_path / "job.yaml"), "-o", str(tmp_path)]) == 0
    page = (tmp_path / "ONE-1.html").read_text(encoding="utf-8")
    assert "and so there is no uncertainty of one" in page
    assert "U incomplete" not in page
    told = capsys.readouterr().out
    assert "U incomplete" not in told
    assert "  ISO 230-2:2014\n    This test defines none of the parameters.\n" in told
