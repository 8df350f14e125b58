"""Entries of a ledger, as a fleet's nights leave them."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from datetime import date, timedelta

from zlmreport.fleet.drifts import Trend, judge_trends
from zlmreport.fleet.records import LedgerEntry, RecordedParameter, State
from zlmreport.fleet.trend import list_series_of, select_standing

FIRST = date(2025, 1, 15)


def quarters(number: int) -> list[date]:
    """Return dates a quarter of a year apart."""
    return [FIRST + timedelta(days=91 * quarter) for quarter in range(number)]


def parameter(value: float, **changes: object) -> RecordedParameter:
    known: dict[str, object] = {
        "standard": "iso230-2:2014",
        "symbol": "A",
        "unit": "um",
        "expanded_uncertainty": 1.0,
        "limit": 20.0,
        "conforms": True,
    }
    return RecordedParameter(value=value, **{**known, **changes})  # type: ignore[arg-type]


def entry(day: date, *parameters: RecordedParameter, **changes: object) -> LedgerEntry:
    """Return the entry of a calibration of a day."""
    known: dict[str, object] = {
        "job": f"x/{day}.yaml",
        "number": f"CAL-{day}",
        "machine": "Example Works MT 500, serial 1",
        "axis": "X",
        "measured": day.isoformat(),
        "night": f"{day}T22:00:00+00:00",
        "digest": "d1",
        "state": State.MADE,
        "files": (f"x/CAL-{day}.json",),
        "parameters": parameters,
    }
    return LedgerEntry(**{**known, **changes})  # type: ignore[arg-type]


def history(values: Sequence[float], *, axis: str = "X", limit: float | None = 20.0) -> list[LedgerEntry]:
    """Return quarterly calibrations of one axis that state A."""
    return [
        entry(day, parameter(value, limit=limit), axis=axis, job=f"{axis}/{day}.yaml")
        for day, value in zip(quarters(len(values)), values, strict=True)
    ]


def judged(entries: Iterable[LedgerEntry]) -> tuple[Trend, ...]:
    """Return what is said of each series of a ledger."""
    return judge_trends(list_series_of(select_standing(entries)))
