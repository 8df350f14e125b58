"""What a job asks to be captured."""

from __future__ import annotations

import datetime as dt
from pathlib import Path

import pytest

from installed import registry
from refusals import refused
from replacing import replaced
from zlmreport import pipeline
from zlmreport.job.loading import load
from zlmreport.job.schema import make_job_schema
from zlmreport.live.capture.journal import Journal, read_history
from zlmreport.live.capture.of_job import (
    Assignment,
    demand_same_test,
    find_instrument_of,
    make_assignment_of,
    make_header_of,
)
from zlmreport.model.planning.plan import propose
from zlmreport.plugin import AccessError, InputError, Place
from zlmreport.plugin.extension import Job

REGISTRY = registry()
JOB = """\
schema: zlmreport/job/1
certificate: {number: CAP-1, kind: report}
axis: {name: X, travel: [-10, 210]}
measurement:
  feed: 3000
  dwell: 3
  source:
    plugin: serial-interferometer
    journal: x.journal
    instrument: {plugin: umd1, port: /dev/ttyACM0}
plan: {targets: {positions: [0, 2, 200]}, runs: 2, overrun: 6}
evaluate: [iso230-2:2014]
"""


def loaded(folder: Path, *changes: tuple[str, str]) -> Job:
    path = folder / "job.yaml"
    path.write_text(replaced(JOB, *changes))
    return load(path, REGISTRY)


def asked(job: Job) -> Assignment:
    return make_assignment_of(job, propose(job, pipeline.choose_standards(job, REGISTRY)).plan)


def problems(folder: Path, *changes: tuple[str, str]) -> list[str]:
    return [
        f"{each.place.line}:{each.place.column} {each.message}"
        for each in refused(lambda: asked(loaded(folder, *changes))).problems
    ]


def test_the_usual_tolerance_keeps_targets_apart(tmp_path: Path) -> None:
    assert asked(loaded(tmp_path)).settings.tolerance == pytest.approx(0.4 * 2e-3)


def test_the_usual_tolerance_keeps_a_target_and_its_turning_point_apart(tmp_path: Path) -> None:
    settings = asked(loaded(tmp_path, ("overrun: 6", "overrun: 0.9"))).settings
    assert settings.tolerance == pytest.approx(0.3e-3)


def test_a_wide_plan_has_a_tolerance_of_a_millimetre(tmp_path: Path) -> None:
    assert asked(loaded(tmp_path, ("[0, 2, 200]", "[0, 100, 200]"))).settings.tolerance == pytest.approx(1e-3)


def test_the_datum_is_at_the_start_of_the_path_unless_the_job_says_otherwise(tmp_path: Path) -> None:
    assert asked(loaded(tmp_path)).datum == pytest.approx(-6e-3)
    with_key = ("journal: x", "datum: 12.5\n    journal: x")
    assert asked(loaded(tmp_path, with_key)).datum == pytest.approx(12.5e-3)
    assert asked(loaded(tmp_path, ("journal: x", "datum: instrument\n    journal: x"))).datum is None


def test_a_turn_at_one_and_a_half_times_the_feed_is_not_to_be_missed(tmp_path: Path) -> None:
    assert asked(loaded(tmp_path)).settings.turn == pytest.approx(2 * 6 / (1.5 * 50))


def test_the_time_that_is_left_is_that_of_the_plan(tmp_path: Path) -> None:
    assignment = asked(loaded(tmp_path))
    one = assignment.visits[-1]
    assert assignment.estimate_remaining_time(len(assignment.visits) - 1) == pytest.approx(
        one.travelled / 0.05 + 3
    )


def test_a_tolerance_that_covers_two_targets_is_refused(tmp_path: Path) -> None:
    (problem,) = problems(tmp_path, ("journal: x", "tolerance: 0.9\n    journal: x"))
    assert problem.startswith("9:16 measurement.source.tolerance: 0.9 mm is too much")
    assert "state 0.8 or less" in problem


def test_a_stability_range_that_hides_motion_is_refused(tmp_path: Path) -> None:
    (problem,) = problems(tmp_path, ("journal: x", "stability: 100\n    journal: x"))
    assert "motion counts from ten times that" in problem
    assert "state 80 or less" in problem


def test_an_axis_that_rests_no_longer_than_a_reading_takes_is_refused(tmp_path: Path) -> None:
    (problem,) = problems(tmp_path, ("dwell: 3", "dwell: 1"))
    assert problem == (
        "6:10 measurement.dwell: the axis rests 1 s, and a reading takes 1 s (measurement.source.dwell); "
        "let it rest 3 s or more"
    )


def test_a_job_whose_readings_are_in_a_file_is_not_captured(tmp_path: Path) -> None:
    source = (
        "serial-interferometer\n    journal: x.journal\n    instrument: {plugin: umd1, port: /dev/ttyACM0}",
        "laser-csv\n    file: x.csv",
    )
    (problem,) = problems(tmp_path, source)
    assert problem.startswith("8:13 the data source laser-csv is not captured")


def test_a_capture_needs_an_instrument(tmp_path: Path) -> None:
    job = loaded(tmp_path, ("    instrument: {plugin: umd1, port: /dev/ttyACM0}\n", ""))
    with pytest.raises(InputError, match=r"measurement\.source\.instrument is missing"):
        find_instrument_of(job)


@pytest.mark.parametrize(
    ("change", "expected"),
    [
        (("umd1", "umd3"), "10:26 no plugin provides instrument 'umd3'; did you mean 'umd2'?"),
        ((", port: /dev/ttyACM0", ""), "10:26 measurement.source.instrument.port is missing"),
        (
            ("port:", "prot: x, port:"),
            "10:32 unknown key 'prot' in measurement.source.instrument; did you mean 'port'?",
        ),
        (("ttyACM0}", "ttyACM0, sign: up}"), "measurement.source.instrument.sign: 'up' is unknown"),
        *(
            (
                ("/dev/ttyACM0", address),
                f"10:38 measurement.source.instrument.port: '{address}' does not lead",
            )
            for address in ("socket://10.0.0.7", "socket://10.0.0.7:x", "socket://:90", "10.0.0.7:9090")
        ),
        (("/dev/ttyACM0", "'spy:///dev/ttyACM0?file=x'"), "writes what passes into a file"),
    ],
)
def test_the_instruments_own_keys_are_checked_with_their_places(
    tmp_path: Path, change: tuple[str, str], expected: str
) -> None:
    assert any(expected in problem for problem in problems(tmp_path, change)), problems(tmp_path, change)


def test_editors_know_the_keys_of_every_instrument() -> None:
    schema = make_job_schema(REGISTRY)
    keys = schema["$defs"]["serial-interferometer.LiveInstrumentKeys"]["oneOf"]
    assert {each["properties"]["plugin"]["const"] for each in keys} == {
        instrument.identifier for instrument in REGISTRY.instruments
    }


@pytest.mark.parametrize(
    ("change", "expected"),
    [
        (("CAP-1", "CAP-2"), "is the journal of CAP-1, and the job is CAP-2"),
        (("name: X", "name: Y"), "is the journal of axis X, and the job is on axis Y"),
        (("runs: 2", "runs: 3"), "holds another plan: 12 visits, linear, and the job's is 18, linear"),
        (("journal: x", "dwell: 0.5\n    journal: x"), "was begun with other limits"),
        (("plugin: umd1", "plugin: umd2"), "was begun with the instrument umd1, and the job names umd2"),
    ],
)
def test_a_journal_of_another_test_is_not_gone_on_with(
    tmp_path: Path, change: tuple[str, str], expected: str
) -> None:
    job = loaded(tmp_path)

    path = tmp_path / "x.journal"
    with Journal.begin(path, make_header_of(job, asked(job), dt.datetime(2026, 11, 20, 8, tzinfo=dt.UTC))):
        pass
    other, history = loaded(tmp_path, change), read_history(path)
    assert history is not None
    demand_same_test(history, job, asked(job), Place(str(path)))
    with pytest.raises(AccessError, match=expected):
        demand_same_test(history, other, asked(other), Place(str(path)))
