"""Nobody has measured, calibrated or issued anything on a day that has not come yet."""

from __future__ import annotations

import datetime as dt
from pathlib import Path

import pytest

from job.jobs import SOUND, loaded, with_line, with_lines
from zlmreport.job.days import demand_days_past, find_days_to_come
from zlmreport.plugin import InputError
from zlmreport.version import RELEASED

TODAY = dt.date(2031, 3, 1)


def refusals(text: str, folder: Path, today: dt.date = TODAY) -> list[str]:
    try:
        demand_days_past(loaded(text, folder), today)
    except InputError as error:
        return [str(each) for each in error.problems]
    return []


def test_a_measurement_in_the_future_is_refused_at_its_line(tmp_path: Path) -> None:
    (found,) = refusals(with_line(9, "  date: 2031-04-18"), tmp_path)
    assert f"{tmp_path / 'job.yaml'}:9:9: measurement.date: 2031-04-18 lies in the future" in found
    assert "by the clock of this computer it is 2031-03-01" in found


def test_all_days_to_come_are_told_at_once(tmp_path: Path) -> None:
    text = with_line(9, "  date: 2031-04-18").replace("language: en", "language: en\n  issued: 2031-04-20")
    text += "instrument: {name: Laser, calibrated: 2031-04-01}\n"
    keys = [each.key for each in find_days_to_come(loaded(text, tmp_path), TODAY)]
    assert keys == ["certificate.issued", "measurement.date", "instrument.calibrated"]
    assert len(refusals(text, tmp_path)) == 3


@pytest.mark.parametrize(
    "line", ["next_due: {date: 2032-11-18, agreed: true}", "instrument: {name: Laser, due: 2032-01-01}"]
)
def test_what_is_due_may_lie_in_the_future(line: str, tmp_path: Path) -> None:
    assert not refusals(with_lines(line), tmp_path)


def test_where_it_is_tomorrow_already_it_may_have_been_measured(tmp_path: Path) -> None:
    assert not refusals(with_line(9, "  date: 2031-03-02"), tmp_path)
    assert refusals(with_line(9, "  date: 2031-03-03"), tmp_path)


def test_a_clock_behind_this_program_is_not_believed(tmp_path: Path) -> None:
    assert dt.date(2026, 11, 18) < RELEASED  # the day that the sound job states
    assert not refusals(SOUND, tmp_path, today=dt.date(1970, 1, 1))
    assert refusals(with_line(9, "  date: 2031-04-18"), tmp_path, today=RELEASED)
