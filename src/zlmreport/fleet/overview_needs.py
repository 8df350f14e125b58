"""What needs somebody this morning, worst first."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from zlmreport.fleet import overview_words as words
from zlmreport.fleet.overview_cells import Cells
from zlmreport.fleet.overview_state import Failure, FleetState
from zlmreport.fleet.records import Entry
from zlmreport.fleet.trend_fleet import Trend
from zlmreport.language import Words
from zlmreport.typesetting.overview import (
    OverviewCellContext,
    OverviewGroupContext,
    OverviewTableContext,
)


@dataclass(frozen=True, slots=True)
class _Kind:
    """A kind of thing that needs somebody: its anchor, and the words and columns of its table."""

    key: str
    title: Words
    caption: Words
    columns: tuple[Words, ...]


_FAILED = _Kind("failed", words.FAILED, words.FAILED_CAPTION, (words.JOB, words.MESSAGE, words.SINCE))
_LIMIT_COLUMNS = (
    *(words.AXIS, words.PARAMETER, words.VALUE, words.LIMIT),
    *(words.COURSE, words.CERTIFICATE),
)
_NOT_MET = _Kind("not-met", words.NOT_MET, words.NOT_MET_CAPTION, _LIMIT_COLUMNS)
_UNDECIDED = _Kind("undecided", words.UNDECIDED, words.UNDECIDED_CAPTION, _LIMIT_COLUMNS)
_DRIFTING = _Kind(
    "drifting",
    words.DRIFTING,
    words.DRIFTING_CAPTION,
    (
        *(words.AXIS, words.PARAMETER, words.VALUE, words.LIMIT),
        *(words.COURSE, words.DRIFT, words.REACHED),
    ),
)
_DRAFTS = _Kind(
    "drafts",
    words.DRAFTS,
    words.DRAFTS_CAPTION,
    (words.CERTIFICATE, words.REASON, words.JOB, words.SINCE),
)


def needs(state: FleetState, cells: Cells) -> Iterator[OverviewTableContext]:
    """Yield a table of each kind of thing that needs somebody; none where there is nothing of the kind."""
    if state.failures:
        yield _failures(state.failures, cells)
    if state.not_met:
        yield _limits(_NOT_MET, state.not_met, cells)
    if state.undecided:
        yield _limits(_UNDECIDED, state.undecided, cells)
    if state.drifting:
        yield _drifts(state.drifting, cells)
    if state.drafts:
        yield _drafts(state.drafts, cells)


def _failures(failures: Sequence[Failure], cells: Cells) -> OverviewTableContext:
    groups = [
        OverviewGroupContext(
            OverviewCellContext(failure.entry.job, note=_subject(failure.entry)),
            (
                (
                    OverviewCellContext(failure.entry.message, style="message"),
                    OverviewCellContext(failure.since[:10], style="date"),
                ),
            ),
        )
        for failure in failures
    ]
    return _table(_FAILED, groups, cells)


def _limits(kind: _Kind, trends: Sequence[Trend], cells: Cells) -> OverviewTableContext:
    groups = [
        OverviewGroupContext(
            cells.axis(each[0]),
            tuple(
                (
                    cells.parameter(trend),
                    cells.value(trend),
                    cells.limit(trend),
                    cells.course(trend),
                    cells.certificate(trend.series.calibrations[-1].entry),
                )
                for trend in each
            ),
        )
        for each in _by_axis(trends)
    ]
    return _table(kind, groups, cells)


def _drifts(trends: Sequence[Trend], cells: Cells) -> OverviewTableContext:
    groups = []
    for of_axis in _by_axis(trends):
        limited = [each for each in of_axis if each.series.latest.limit is not None]
        others = [each for each in of_axis if each.series.latest.limit is None]
        # An axis of which nothing is limited still shows its first parameter.
        shown = limited or of_axis[:1]
        head = cells.axis(of_axis[0])
        also = cells.symbols(each for each in others if each not in shown)
        if also:
            note = cells.say(words.ALSO.given(symbols=also))
            head = OverviewCellContext(head.content, note=f"{head.note}; {note}")
        rows = tuple(
            (
                cells.parameter(trend),
                cells.value(trend),
                cells.limit(trend),
                cells.course(trend),
                cells.drift(trend),
                cells.reached(trend),
            )
            for trend in shown
        )
        groups.append(OverviewGroupContext(head, rows))
    return _table(_DRIFTING, groups, cells)


def _drafts(drafts: Sequence[Entry], cells: Cells) -> OverviewTableContext:
    groups = [
        OverviewGroupContext(
            OverviewCellContext(entry.number, note=_subject(entry), links=cells.links(entry)),
            (
                (
                    OverviewCellContext(entry.message, style="message"),
                    OverviewCellContext(entry.job),
                    OverviewCellContext(entry.night[:10], style="date"),
                ),
            ),
        )
        for entry in drafts
    ]
    return _table(_DRAFTS, groups, cells)


def _by_axis(trends: Sequence[Trend]) -> list[list[Trend]]:
    """Return trends by their axes, in the order in which the axes come first."""
    found: defaultdict[tuple[str, str], list[Trend]] = defaultdict(list)
    for each in trends:
        found[each.series.machine, each.series.axis].append(each)
    return list(found.values())


def _subject(entry: Entry) -> str:
    return ", ".join(each for each in (entry.machine, entry.axis) if each)


def _table(kind: _Kind, groups: Sequence[OverviewGroupContext], cells: Cells) -> OverviewTableContext:
    return OverviewTableContext(
        key=kind.key,
        style=kind.key,
        title=cells.say(kind.title),
        count=str(len(groups)),
        caption=cells.say(kind.caption),
        headings=tuple(OverviewCellContext(cells.say(column)) for column in kind.columns),
        groups=tuple(groups),
    )
