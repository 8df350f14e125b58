"""The main job on the command line."""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import Any

import pytest

from cli.commands import Shop, use
from offers import offering
from testing.exemplary import ExemplaryRenderer, ExemplarySource, ExemplaryStandard
from zlmreport.plugin.registry import Plugin, collect


def test_files_are_written_where_the_job_says(shop: Shop) -> None:
    shop.job()
    run = shop.run("job.yaml")
    assert (run.code, run.messages) == (0, "")
    assert shop.files() == ["CAL-1.json"]


def test_result_is_told_with_its_files_values_limits_and_verdicts(shop: Shop) -> None:
    shop.job()
    assert shop.run("job.yaml").output.splitlines() == [
        "CAL-1  axis X, serial 17",
        "  out/CAL-1.json",
        "",
        "  EX 1        µm  limit",
        "    E  range   2     20  conforms",
        "",
        "  not met  EX 1: At least 5 positions: 3 positions",
    ]


def test_exceeded_limit_is_told_and_is_no_failure(shop: Shop) -> None:
    shop.job(("{E: 20}", "{E: 1.5}"))
    run = shop.run("job.yaml")
    assert run.code == 0
    assert "    E  range   2    1.5  does not conform" in run.output


def test_exceeded_limit_fails_if_asked_for(shop: Shop) -> None:
    shop.job(("{E: 20}", "{E: 1.5}"))
    assert shop.run("job.yaml", "--fail-on-nonconformity").code == 1
    assert shop.files() == ["CAL-1.json"]


@pytest.mark.parametrize("tolerances", ["{E: 2.5}", "{}"])
def test_kept_limit_or_none_does_not_fail(tolerances: str, shop: Shop) -> None:
    shop.job(("{E: 20}", tolerances))
    assert shop.run("job.yaml", "--fail-on-nonconformity").code == 0


def test_limit_that_is_not_decided_does_not_fail(shop: Shop) -> None:
    shop.job(("evaluate:", "decision_rule: guard-band\nevaluate:"), ("{E: 20}", "{E: 1.5}"))
    run = shop.run("job.yaml", "--fail-on-nonconformity")
    assert run.code == 0
    assert "not decided" in run.output


def test_missing_readings_are_told(shop: Shop) -> None:
    shop.job()
    shop.write("six.txt", "1 nan 3 -1 -2 -3")
    run = shop.run("job.yaml")
    assert run.code == 0
    assert "  missing  1 of 6 readings is missing; nothing was filled in" in run.output
    assert "target 100 mm ↑, run 1" in run.output


def test_model_that_cannot_be_fitted_is_refused_at_its_place_and_nothing_is_written(shop: Shop) -> None:
    shop.job(("evaluate:", "model: {effects: [exemplary-wave]}\nevaluate:"))
    run = shop.run("job.yaml")
    assert run.code == 2
    assert run.messages == (
        "job.yaml:13:19: exemplary-wave cannot be fitted to these readings: it needs four targets\n"
    )


def test_output_goes_to_another_folder(shop: Shop) -> None:
    shop.job()
    assert shop.run("job.yaml", "--output", "deep/below").code == 0
    assert (shop.folder / "deep/below/CAL-1.json").is_file()
    assert shop.files() == []


def test_short_option_for_the_folder(shop: Shop) -> None:
    shop.job()
    assert shop.run("-o", "here", "job.yaml").code == 0
    assert (shop.folder / "here/CAL-1.json").is_file()


def test_quiet_prints_nothing(shop: Shop) -> None:
    shop.job()
    run = shop.run("job.yaml", "--quiet")
    assert (run.code, run.output, run.messages) == (0, "", "")


def test_quiet_still_prints_mistakes(shop: Shop) -> None:
    shop.job(("kind: report", "kind: repor"))
    run = shop.run("job.yaml", "--quiet")
    assert run.code == 2
    assert "did you mean 'report'?" in run.messages


def test_formats_of_the_command_line_stand_instead_of_the_jobs(shop: Shop) -> None:
    shop.job(("[exemplary]", "[no-such-format]"))
    assert shop.run("job.yaml", "--format", "exemplary").code == 0
    assert shop.files() == ["CAL-1.json"]


def test_unknown_format_of_the_command_line_is_answered_with_the_nearest(shop: Shop) -> None:
    shop.job()
    run = shop.run("job.yaml", "--format", "exemplary, exemplar")
    assert run.code == 2
    assert run.messages == (
        "zlmreport --format: no plugin provides format 'exemplar'; "
        "did you mean 'exemplary'? (known: exemplary)\n"
    )
    assert shop.files() == []


def test_two_formats_of_one_suffix_are_both_written(shop: Shop, monkeypatch: pytest.MonkeyPatch) -> None:
    class Namesake(ExemplaryRenderer):
        identifier = "namesake"

    offers = offering([ExemplaryStandard()], [ExemplarySource()], [ExemplaryRenderer(), Namesake()])
    use(monkeypatch, collect([(Plugin("both"), offers)]))
    shop.job()
    run = shop.run("job.yaml", "--format", "exemplary,namesake")
    assert run.code == 0
    assert shop.files() == ["CAL-1-namesake.json", "CAL-1.json"]


def test_wrong_job_writes_nothing(shop: Shop) -> None:
    shop.job(("name: X", "nam: X"))
    run = shop.run("job.yaml")
    assert run.code == 2
    assert run.output == ""
    assert "job.yaml:7:8: unknown key 'nam' in axis; did you mean 'name'?" in run.messages
    assert shop.files() == []


def test_wrong_readings_write_nothing(shop: Shop) -> None:
    shop.job()
    shop.write("six.txt", "1 2 three 4 5 6")
    run = shop.run("job.yaml")
    assert (run.code, run.messages) == (2, "six.txt: must hold numbers\n")
    assert shop.files() == []


def test_missing_readings_file_is_an_access_error(shop: Shop) -> None:
    shop.job()
    (shop.folder / "six.txt").unlink()
    run = shop.run("job.yaml")
    assert (run.code, run.messages) == (3, "six.txt: cannot be read (named in job.yaml:12:11)\n")


def test_missing_job_is_an_access_error(shop: Shop) -> None:
    run = shop.run("none.yaml")
    assert (run.code, run.messages) == (3, "none.yaml: cannot be read: no such file or directory\n")


def test_certificate_that_lacks_what_it_must_state_is_refused_at_once(shop: Shop) -> None:
    shop.job(("  kind: report\n", ""))
    run = shop.run("job.yaml")
    assert run.code == 2
    assert run.messages.count("a calibration certificate must state") > 5
    assert shop.files() == []


def test_every_wrong_job_is_told_and_the_sound_ones_are_done(shop: Shop) -> None:
    shop.job(name="sound.yaml")
    shop.job(("name: X", "nam: X"), name="typo.yaml", number="CAL-2")
    shop.job(("exemplary:1", "exemplary:2"), name="unknown.yaml", number="CAL-3")
    run = shop.run("typo.yaml", "sound.yaml", "unknown.yaml")
    assert run.code == 2
    assert "typo.yaml:7:8: " in run.messages
    assert "unknown.yaml:14:16: " in run.messages
    assert shop.files() == ["CAL-1.json"]


def test_exit_code_is_the_worst(shop: Shop) -> None:
    shop.job(("{E: 20}", "{E: 1}"), name="exceeded.yaml")
    shop.job(("name: X", "nam: X"), name="typo.yaml", number="CAL-2")
    assert shop.run("exceeded.yaml", "typo.yaml", "none.yaml", "--fail-on-nonconformity").code == 3
    assert shop.run("exceeded.yaml", "typo.yaml", "--fail-on-nonconformity").code == 2
    assert shop.run("exceeded.yaml", "--fail-on-nonconformity").code == 1


def test_jobs_that_write_the_same_files_are_refused(shop: Shop) -> None:
    shop.job(name="one.yaml")
    shop.job(name="two.yaml")
    run = shop.run("one.yaml", "two.yaml")
    assert run.code == 2
    assert run.messages == "two.yaml:3:11: one.yaml writes files of the number CAL-1 to the same folder\n"
    assert shop.files() == ["CAL-1.json"]


def test_numbers_that_differ_in_case_alone_name_the_same_files(shop: Shop) -> None:
    shop.job(name="one.yaml")
    shop.job(name="two.yaml", number="cal-1")
    run = shop.run("one.yaml", "two.yaml")
    assert run.code == 2
    assert run.messages == (
        "two.yaml:3:11: one.yaml writes files of the number CAL-1 to the same folder; "
        "cal-1 differs from it in case alone\n"
    )
    assert shop.files() == ["CAL-1.json"]


def test_same_number_in_another_folder_is_no_clash(shop: Shop) -> None:
    shop.job(name="a/one.yaml")
    shop.job(name="b/two.yaml")
    for folder in "ab":
        shop.write(f"{folder}/six.txt", "1 2 3 4 5 6")
    assert shop.run("a/one.yaml", "b/two.yaml").code == 0
    assert shop.files() == ["CAL-1.json", "CAL-1.json"]


def test_file_where_the_folder_should_be_is_an_access_error(shop: Shop) -> None:
    shop.job()
    shop.write("out", "a file")
    run = shop.run("job.yaml")
    assert run.code == 3
    assert "out/CAL-1.json: cannot be written: " in run.messages


def test_folder_where_the_file_should_be_is_an_access_error(shop: Shop) -> None:
    shop.job()
    (shop.folder / "out" / "CAL-1.json").mkdir(parents=True)
    run = shop.run("job.yaml")
    assert run.code == 3
    assert "out/CAL-1.json: cannot be written: " in run.messages
    assert shop.files() == ["CAL-1.json"]


@pytest.mark.skipif(os.geteuid() == 0, reason="root may write everywhere")
def test_folder_without_leave_to_write_is_an_access_error(shop: Shop) -> None:
    shop.job()
    (shop.folder / "out").mkdir(mode=0o500)
    assert shop.run("job.yaml").code == 3


def test_special_file_is_not_replaced_by_a_result(shop: Shop) -> None:
    shop.job()
    run = shop.run("job.yaml", "-o", "/proc")
    assert run.code == 3
    assert "/proc/CAL-1.json: cannot be written: " in run.messages


def test_trouble_of_a_plugin_is_told_without_a_traceback(shop: Shop, monkeypatch: pytest.MonkeyPatch) -> None:
    class Faulty(ExemplaryStandard):
        def arithmetic(self, *_: Any) -> Any:
            raise KeyError("A")

    offers = offering([Faulty()], [ExemplarySource()], [ExemplaryRenderer()])
    use(monkeypatch, collect([(Plugin("faulty"), offers)]))
    shop.job()
    run = shop.run("job.yaml")
    assert run.code == 2
    assert run.messages.startswith(
        "job.yaml: standard 'exemplary:1' of plugin faulty: arithmetic raised KeyError: 'A' (test_report.py, "
    )
    assert "Traceback" not in run.messages


def test_missing_library_of_a_renderer_is_an_access_error(
    shop: Shop, monkeypatch: pytest.MonkeyPatch
) -> None:
    class Libraryless(ExemplaryRenderer):
        def render(self, *_: Any) -> bytes:
            raise OSError("cannot load library 'libpango-1.0-0'")

    offers = offering([ExemplaryStandard()], [ExemplarySource()], [Libraryless()])
    use(monkeypatch, collect([(Plugin("pdf"), offers)]))
    shop.job()
    run = shop.run("job.yaml")
    assert (run.code, run.messages) == (3, "job.yaml: cannot load library 'libpango-1.0-0'\n")


def test_what_a_name_would_tell_a_terminal_is_printed_as_an_escape(shop: Shop) -> None:
    run = shop.run("no\x1b[31msuch.yaml")
    assert "no\\x1b[31msuch.yaml: cannot be read" in run.messages


def test_paths_outside_the_current_folder_are_told_in_full(shop: Shop, tmp_path_factory: Any) -> None:
    other = tmp_path_factory.mktemp("other")
    shop.job()
    assert f"  {other}/CAL-1.json" in shop.run("job.yaml", "-o", str(other)).output


def test_extended_mistake_is_told_at_its_own_file(shop: Shop) -> None:
    shop.write("shared/lab.yaml", "laboratory:\n  nam: L\n")
    shop.job(("certificate:", "extends: shared/lab.yaml\ncertificate:"))
    run = shop.run("job.yaml")
    assert run.code == 2
    assert "shared/lab.yaml:2:3: unknown key 'nam' in laboratory; did you mean 'name'?" in run.messages


def test_same_job_gives_the_same_bytes(shop: Shop) -> None:
    shop.job()
    shop.run("job.yaml", "-o", "one")
    shop.run("job.yaml", "-o", "two")
    one, two = (Path(folder, "CAL-1.json").read_bytes() for folder in ("one", "two"))
    assert one == two


def test_colours_are_for_terminals(shop: Shop, monkeypatch: pytest.MonkeyPatch) -> None:
    shop.job()
    assert "\x1b[" not in shop.run("job.yaml").output
    monkeypatch.delenv("NO_COLOR", raising=False)
    monkeypatch.setattr(type(sys.stdout), "isatty", lambda _: True, raising=False)
    run = shop.run("job.yaml")
    assert "\x1b[32mconforms\x1b[0m" in run.output
    monkeypatch.setenv("NO_COLOR", "1")
    assert "\x1b[" not in shop.run("job.yaml").output
