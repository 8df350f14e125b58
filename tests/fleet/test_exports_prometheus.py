"""What monitoring is told, read back as strictly as the format is documented."""

from __future__ import annotations

import re
from collections.abc import Sequence
from datetime import UTC, datetime, timedelta

import pytest

from environments import ROOT
from fleet.exposition import Family, parse
from fleet.histories import entry, history, parameter, quarters
from zlmreport.fleet.exports import write_heartbeat, write_metrics
from zlmreport.fleet.records import About, LedgerEntry, NightNotice, PastNight, State
from zlmreport.fleet.state import Rules, describe_state
from zlmreport.plugin import same_in_all_languages as same

NIGHT = PastNight(
    datetime(2026, 11, 21, 2, tzinfo=UTC), datetime(2026, 11, 21, 2, tzinfo=UTC) + timedelta(seconds=94.5)
)
(DAY,) = quarters(1)
DRIFT = history([8.0, 9.12, 10.18, 11.31, 12.4, 13.49])


def told(
    entries: Sequence[LedgerEntry], name: str = "Hall North", night: PastNight | None = NIGHT
) -> dict[str, Family]:
    rules = Rules(interval=365)
    return parse(write_metrics(describe_state(name, entries, [each.job for each in entries], night, rules)))


def only(families: dict[str, Family], name: str) -> float:
    (value,) = families[f"zlmreport_{name}"].samples.values()
    return value


def test_the_last_run_is_told_in_seconds() -> None:
    families = told(DRIFT)
    assert only(families, "fleet_last_run_timestamp_seconds") == NIGHT.began.timestamp()
    assert only(families, "fleet_last_run_duration_seconds") == 94.5


def test_a_run_that_was_interrupted_has_no_duration() -> None:
    families = told(DRIFT, night=PastNight(NIGHT.began, None))
    assert "zlmreport_fleet_last_run_duration_seconds" not in families


def test_a_fleet_that_never_ran_has_no_run() -> None:
    assert "zlmreport_fleet_last_run_timestamp_seconds" not in told([], night=None)


def test_jobs_are_counted_by_their_state() -> None:
    entries = [
        entry(DAY, parameter(8.0), job="a", night=NIGHT.began.isoformat()),
        entry(DAY, parameter(8.0), job="b"),
        entry(DAY, job="c", state=State.FAILED),
        entry(DAY, job="d", state=State.DRAFT),
        entry(DAY, job="e", state=State.FAILED),
    ]
    counts = {
        dict(labels)["state"]: count
        for labels, count in told(entries)["zlmreport_fleet_jobs"].samples.items()
    }
    assert counts == {"made": 1, "unchanged": 1, "left": 0, "draft": 1, "failed": 2, "vanished": 0}


def test_what_concerns_the_whole_night_is_one_and_all_else_zero() -> None:
    noticed = PastNight(NIGHT.began, NIGHT.ended, (NightNotice(About.FOLDER, same("the folder is empty")),))
    samples = told(DRIFT, night=noticed)["zlmreport_fleet_notice"].samples
    assert {dict(labels)["about"]: value for labels, value in samples.items()} == {
        "jobs": 0,
        "folder": 1,
        "ledger": 0,
        "clock": 0,
        "stuck": 0,
        "untold": 0,
        "priors": 0,
        "broken": 0,
        "left": 0,
        "documents": 0,
    }


def test_a_parameter_is_told_in_metres() -> None:
    families = told([entry(DAY, parameter(8.0, expanded_uncertainty=0.5, limit=20.0))])
    assert only(families, "parameter_value_meters") == pytest.approx(8e-6, rel=1e-12)
    assert only(families, "parameter_expanded_uncertainty_meters") == pytest.approx(0.5e-6, rel=1e-12)
    assert only(families, "parameter_limit_meters") == pytest.approx(20e-6, rel=1e-12)


def test_a_parameter_of_a_rotary_axis_is_told_in_radians() -> None:
    families = told([entry(DAY, parameter(1.0, unit="arcsec"))])
    assert only(families, "parameter_value_radians") == pytest.approx(4.84813681109536e-6, rel=1e-12)
    assert "zlmreport_parameter_value_meters" not in families


def test_a_parameter_is_known_by_machine_axis_standard_and_symbol() -> None:
    families = told([entry(DAY, parameter(8.0))])
    (labels,) = families["zlmreport_parameter_value_meters"].samples
    assert dict(labels) == {
        "fleet": "Hall North",
        "machine": "Example Works MT 500, serial 1",
        "axis": "X",
        "standard": "iso230-2:2014",
        "symbol": "A",
    }


@pytest.mark.parametrize(("conforms", "told_as"), [(True, 1.0), (False, 0.0)])
def test_conformity_is_one_or_zero(*, conforms: bool, told_as: float) -> None:
    families = told([entry(DAY, parameter(8.0, conforms=conforms))])
    assert only(families, "parameter_conforms") == told_as


def test_what_is_not_decided_is_absent() -> None:
    assert "zlmreport_parameter_conforms" not in told([entry(DAY, parameter(8.0, conforms=None))])


def test_a_drift_is_told_with_its_chance_and_its_date() -> None:
    families = told(DRIFT)
    assert only(families, "parameter_drifts") == 1.0
    assert only(families, "parameter_drift_p_value") < 1e-4
    reached = datetime.fromtimestamp(only(families, "parameter_limit_reached_timestamp_seconds"), UTC)
    assert reached.year == 2027


def test_a_slope_is_told_per_year() -> None:
    # 1.098 µm a quarter of 91 days.
    expected = 1.098e-6 * 365.25 / 91
    assert only(told(DRIFT), "parameter_change_per_year_meters") == pytest.approx(expected, rel=0.01)


def test_too_few_calibrations_are_no_drift_and_no_calm() -> None:
    assert "zlmreport_parameter_drifts" not in told(DRIFT[:4])


def test_an_axis_has_the_date_of_its_last_measurement() -> None:
    measured = datetime.fromtimestamp(only(told(DRIFT), "axis_measured_timestamp_seconds"), UTC)
    assert measured.date() == quarters(6)[-1]


@pytest.mark.parametrize(
    "name", ['Hall "North"', "Hall\\North", "Hall\nNorth", "Hall {North},x=1", "Halle Süd"]
)
def test_any_name_comes_through(name: str) -> None:
    (labels,) = told([entry(DAY, parameter(8.0), machine=name)], name)["zlmreport_parameter_conforms"].samples
    assert (dict(labels)["fleet"], dict(labels)["machine"]) == (name, name)


def test_every_family_is_a_gauge_and_says_what_it_is() -> None:
    families = told([*DRIFT, entry(DAY, parameter(1.0, unit="arcsec"), axis="C", job="c")])
    assert {family.kind for family in families.values()} == {"gauge"}
    assert all(family.about.endswith(".") for family in families.values())


def test_the_documentation_lists_every_metric() -> None:
    page = (ROOT / "docs" / "how-to" / "watch-a-fleet.md").read_text(encoding="utf-8")
    listed = set(re.findall(r"^\| `(zlmreport_\w+)`", page, re.MULTILINE))
    families = told([*DRIFT, entry(DAY, parameter(1.0), axis="Y", job="y")])
    of_night = parse(write_heartbeat("Hall North", datetime(2026, 11, 21, tzinfo=UTC), is_at_work=True))
    assert listed == {*families, *of_night}
