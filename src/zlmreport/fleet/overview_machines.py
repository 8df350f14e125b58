"""Every machine of the fleet: its axes, their latest values, and how they came about."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import groupby

from zlmreport.fleet import overview_words as words
from zlmreport.fleet.overview_cells import Cells
from zlmreport.fleet.overview_state import FleetState
from zlmreport.fleet.trend_fleet import Trend
from zlmreport.typesetting.overview import (
    OverviewCellContext,
    OverviewGroupContext,
    OverviewTableContext,
)

_COLUMNS = (
    *(words.AXIS, words.PARAMETER, words.VALUE, words.LIMIT),
    *(words.STATE, words.COURSE, words.DRIFT),
)


def machines(state: FleetState, cells: Cells) -> Iterator[OverviewTableContext]:
    """Yield a table of each machine."""
    by_machine = groupby(state.trends, key=lambda trend: trend.series.machine)
    for number, (machine, of_machine) in enumerate(by_machine, start=1):
        by_axis = groupby(of_machine, key=lambda trend: trend.series.axis)
        yield OverviewTableContext(
            key=f"machine-{number}",
            style="machine",
            title=machine or cells.say(words.NO_MACHINE),
            count="",
            caption=cells.say(words.MACHINE_CAPTION.given(first=cells.period.first.isoformat())),
            headings=tuple(OverviewCellContext(cells.say(column)) for column in _COLUMNS),
            groups=tuple(_axis(list(of_axis), cells) for _, of_axis in by_axis),
        )


def _axis(trends: Sequence[Trend], cells: Cells) -> OverviewGroupContext:
    latest = max((trend.series.calibrations[-1] for trend in trends), key=lambda each: each.measured)
    measured = words.MEASURED.given(date=latest.measured.isoformat())
    return OverviewGroupContext(
        OverviewCellContext(trends[0].series.axis, note=cells.say(measured), links=cells.links(latest.entry)),
        tuple(
            (
                cells.parameter(trend),
                cells.value(trend),
                cells.limit(trend),
                cells.state(trend),
                cells.course(trend),
                cells.drift(trend),
            )
            for trend in _shown(trends)
        ),
    )


def _shown(trends: Sequence[Trend]) -> tuple[Trend, ...]:
    """Return the parameters with a limit, and the first of each standard that limits none."""
    limited = {each.series.standard for each in trends if each.series.latest.limit is not None}
    first = {
        standard: next(of_standard)
        for standard, of_standard in groupby(trends, key=lambda each: each.series.standard)
    }
    return tuple(
        each
        for each in trends
        if each.series.latest.limit is not None
        or (each.series.standard not in limited and each is first[each.series.standard])
    )
