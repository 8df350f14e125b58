"""A series holds each measurement once, as the certificate that stands says it."""

from __future__ import annotations

from dataclasses import replace
from datetime import date

from fleet.histories import entry, history, parameter
from zlmreport.fleet.records import State
from zlmreport.fleet.trend import list_series_of, select_standing

DAY = date(2026, 3, 1)


def test_a_series_runs_in_the_order_of_measurement_whatever_the_order_of_the_ledger() -> None:
    entries = history([1.0, 2.0, 3.0])
    (series,) = list_series_of(select_standing(reversed(entries)))
    assert [each.parameter.value for each in series.calibrations] == [1.0, 2.0, 3.0]


def test_the_ledger_s_order_counts_and_not_a_clock_that_was_set_back() -> None:
    first = entry(DAY, parameter(5.0))
    again = replace(first, night="2020-01-01T22:00:00+00:00", parameters=(parameter(5.5),))
    assert select_standing([first, again]) == (again,)


def test_an_amendment_replaces_what_its_job_said_of_the_measurement() -> None:
    first = entry(DAY, parameter(5.0))
    amendment = replace(
        first, number="CAL-1-A1", night="2026-05-01T22:00:00+00:00", parameters=(parameter(5.5),)
    )
    assert select_standing([first, amendment]) == (amendment,)


def test_a_job_that_comes_to_another_measurement_keeps_its_history() -> None:
    first = entry(DAY, parameter(5.0), job="x.yaml")
    later = entry(date(2026, 6, 1), parameter(6.0), job="x.yaml")
    assert select_standing([first, later]) == (first, later)


def test_drafts_and_failures_are_no_part_of_the_history() -> None:
    draft = entry(DAY, parameter(5.0), state=State.DRAFT)
    failure = entry(DAY, state=State.FAILED, measured="")
    assert select_standing([draft, failure]) == ()


def test_a_draft_leaves_the_issued_certificate_standing() -> None:
    issued = entry(DAY, parameter(5.0))
    draft = replace(issued, state=State.DRAFT, night="2026-05-01T22:00:00+00:00")
    assert select_standing([issued, draft]) == (issued,)


def test_each_axis_standard_and_symbol_has_a_series_of_its_own() -> None:
    certificate = entry(DAY, parameter(5.0), parameter(2.0, symbol="R"), parameter(7.0, standard="nmtba"))
    other = entry(DAY, parameter(4.0), axis="Y", job="y.yaml")
    found = [
        (each.axis, each.standard, each.symbol)
        for each in list_series_of(select_standing([certificate, other]))
    ]
    assert found == [
        ("X", "iso230-2:2014", "A"),
        ("X", "iso230-2:2014", "R"),
        ("X", "nmtba", "A"),
        ("Y", "iso230-2:2014", "A"),
    ]
