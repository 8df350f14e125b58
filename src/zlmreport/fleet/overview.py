"""The overview of a fleet: one page of HTML that somebody opens each morning.

What needs somebody, worst first; every machine with its axes and their latest values; how to read it all.
"""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from datetime import date, timedelta
from itertools import groupby

from zlmreport.fleet import overview_words as words
from zlmreport.fleet.causes import LEAST_MACHINES, Shared, cause_of, shared
from zlmreport.fleet.drifts import FALSE_SHARE, LEAST_DATES, Trend
from zlmreport.fleet.overview_cells import Cells, Names, Period, small_graph
from zlmreport.fleet.records import Entry, Notice, RecordedParameter, State
from zlmreport.fleet.state import SOON, Failure, FleetState, Night, Term
from zlmreport.fleet.steps import LEAST_BEFORE, SEEN, SMALL
from zlmreport.fleet.trend import Calibration, Series, line_through
from zlmreport.language import Language, Words
from zlmreport.typesetting.overview import (
    OverviewCellContext,
    OverviewContext,
    OverviewGroupContext,
    OverviewLegendContext,
    OverviewSectionContext,
    OverviewTableContext,
    OverviewToolsContext,
    TileContext,
    drawing,
    overview_script,
    overview_style,
)
from zlmreport.typesetting.resources import fingerprint
from zlmreport.typesetting.templates import render
from zlmreport.version import __version__

_MINUTE = 60


def overview(state: FleetState, language: Language, names: Names, files: str) -> str:
    """Return the page; the same ledger gives the same page.

    Parameters
    ----------
    state
        Of the fleet.
    language
        Of the page.
    names
        Of standards and their symbols.
    files
        Folder of the certificates, relative to that of the page.
    """
    cells = Cells(language, names, _period(state), files)
    script = overview_script()
    printed = replace(state, trends=tuple(map(names.as_printed, state.trends)))
    return render(
        OverviewContext(
            language=language.value,
            title=cells.say(words.TITLE),
            subtitle=state.name,
            generator=f"zlmreport {__version__}",
            style=overview_style(),
            script=script,
            policy=fingerprint(script),
            facts=tuple(_facts(printed, cells)),
            tiles=tuple(_tiles(printed, cells)),
            tiles_title=cells.say(words.HEADLINE),
            sections=tuple(map(render, _sections(printed, cells))),
        )
    )


def _period(state: FleetState) -> Period:
    dates = [each.measured for trend in state.trends for each in trend.series.calibrations]
    return Period(min(dates, default=date.min), max(dates, default=date.min))


def _facts(state: FleetState, cells: Cells) -> Iterator[tuple[str, str]]:
    yield cells.say(words.LAST_RUN), cells.say(_run(state.night))
    yield cells.say(words.JOBS), cells.say(words.JOBS_DONE.given(jobs=state.jobs, **state.counts))
    yield cells.say(words.CERTIFICATES), str(len(state.certificates))


def _run(night: Night | None) -> Words:
    if night is None:
        return words.NEVER
    began = night.began.strftime("%Y-%m-%d %H:%M UTC")
    if night.seconds is None:
        return words.INTERRUPTED.given(began=began)
    minutes, seconds = divmod(round(night.seconds), _MINUTE)
    duration = words.MINUTES.given(minutes=minutes, seconds=seconds) if minutes else words.SECONDS
    return words.RAN.given(began=began, duration=duration.given(number=seconds))


def _tiles(state: FleetState, cells: Cells) -> Iterator[TileContext]:
    changed = {(each.series.machine, each.series.axis) for each in state.changed}
    drifting = {(each.series.machine, each.series.axis) for each in state.drifting}
    counted = (
        (len(state.notices), words.NOTICED, "noticed"),
        (len(state.failures), words.FAILED, "failed"),
        (len(state.not_met), words.NOT_MET, "not-met"),
        (len(state.undecided), words.UNDECIDED, "undecided"),
        (len(changed), words.CHANGED, "changed"),
        (len(drifting), words.DRIFTING, "drifting"),
        (len(state.overdue), words.OVERDUE, "overdue"),
        (len(state.soon), words.DUE_SOON, "due"),
        (len(state.drafts), words.DRAFTS, "drafts"),
    )
    for number, label, key in counted:
        style = f"raised {key}" if number and key != "due" else "calm"
        yield TileContext(str(number), cells.say(label), style, key if number else "")
    yield TileContext(str(len(state.axes)), cells.say(words.AXES), "calm", "machines")


def _sections(state: FleetState, cells: Cells) -> Iterator[OverviewSectionContext]:
    needed = tuple(map(render, needs(state, cells)))
    nothing = "" if needed else cells.say(words.NOTHING if state.jobs else words.NO_NIGHT)
    yield OverviewSectionContext("needs", cells.say(words.NEEDS), nothing, "calm", needed)
    if state.terms:
        soon = _terms(_DUE, state.soon, cells)
        nothing = "" if state.soon else cells.say(words.NOTHING_DUE.given(days=SOON.days))
        tables = (render(soon),) if state.soon else ()
        yield OverviewSectionContext("due", cells.say(words.DUE_SOON), nothing, "calm", tables)
    common = shared(state.effects)
    if common:
        tables = (render(_common(common, cells)),)
        yield OverviewSectionContext("shared", cells.say(words.SHARED), "", "", tables)
    shown = (render(tools(state, cells)), render(machines(state, cells))) if state.trends else ()
    yield OverviewSectionContext("machines", cells.say(words.MACHINES), "", "", shown)
    reading = (render(legend(cells)),)
    yield OverviewSectionContext("reading", cells.say(words.READING), "", "", reading)


@dataclass(frozen=True, slots=True)
class _Kind:
    """A kind of thing that needs somebody: its anchor, and the words and columns of its table."""

    key: str
    title: Words
    caption: Words
    columns: tuple[Words, ...]


_NOTICED = _Kind("noticed", words.NOTICED, words.NOTICED_CAPTION, (words.ABOUT, words.MESSAGE))
_FAILED = _Kind("failed", words.FAILED, words.FAILED_CAPTION, (words.JOB, words.MESSAGE, words.SINCE))
_LIMIT_COLUMNS = (
    *(words.AXIS, words.PARAMETER, words.VALUE, words.LIMIT),
    *(words.COURSE, words.CERTIFICATE),
)
_NOT_MET = _Kind("not-met", words.NOT_MET, words.NOT_MET_CAPTION, _LIMIT_COLUMNS)
_UNDECIDED = _Kind("undecided", words.UNDECIDED, words.UNDECIDED_CAPTION, _LIMIT_COLUMNS)
_CHANGED = _Kind(
    "changed",
    words.CHANGED,
    words.CHANGED_CAPTION,
    (
        *(words.AXIS, words.PARAMETER, words.VALUE, words.LIMIT),
        *(words.COURSE, words.CHANGE, words.CAME_WITH),
    ),
)
_DRIFTING = _Kind(
    "drifting",
    words.DRIFTING,
    words.DRIFTING_CAPTION,
    (
        *(words.AXIS, words.PARAMETER, words.VALUE, words.LIMIT),
        *(words.COURSE, words.DRIFT, words.REACHED),
    ),
)
_OVERDUE = _Kind(
    "overdue", words.OVERDUE, words.OVERDUE_CAPTION, (words.CERTIFICATE, words.MEASURED_ON, words.DUE)
)
_SHARED = _Kind(
    "shared-by-type",
    words.SHARED,
    words.SHARED_CAPTION.given(least=LEAST_MACHINES),
    (words.TYPE, words.EFFECT, words.MEAN, words.MACHINES_OF_TYPE),
)
_DUE = _Kind("due-soon", words.DUE_SOON, words.DUE_CAPTION.given(days=SOON.days), _OVERDUE.columns)
_DRAFTS = _Kind(
    "drafts",
    words.DRAFTS,
    words.DRAFTS_CAPTION,
    (words.CERTIFICATE, words.REASON, words.JOB, words.SINCE),
)


def needs(state: FleetState, cells: Cells) -> Iterator[OverviewTableContext]:
    """Yield a table of each kind of thing that needs somebody; none where there is nothing of the kind."""
    if state.notices:
        yield _noticed(state.notices, cells)
    if state.failures:
        yield _failures(state.failures, cells)
    if state.not_met:
        yield _limits(_NOT_MET, state.not_met, cells)
    if state.undecided:
        yield _limits(_UNDECIDED, state.undecided, cells)
    if state.changed:
        yield _changes(state, cells)
    if state.drifting:
        yield _drifts(state.drifting, cells)
    if state.overdue:
        yield _terms(_OVERDUE, state.overdue, cells)
    if state.drafts:
        yield _drafts(state.drafts, cells)


def _noticed(notices: Sequence[Notice], cells: Cells) -> OverviewTableContext:
    groups = [
        OverviewGroupContext(
            OverviewCellContext(cells.say(words.ABOUTS[each.about])),
            ((OverviewCellContext(each.text, style="message"),),),
        )
        for each in notices
    ]
    return _table(_NOTICED, groups, cells)


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


def _changes(state: FleetState, cells: Cells) -> OverviewTableContext:
    groups = [
        OverviewGroupContext(
            cells.axis(each[0]),
            tuple(
                (
                    cells.parameter(trend),
                    cells.value(trend),
                    cells.limit(trend),
                    cells.course(trend),
                    cells.change(trend),
                    cells.came_with(cause_of(trend, state.effects)),
                )
                for trend in each
            ),
        )
        for each in _by_axis(state.changed)
    ]
    return _table(_CHANGED, groups, cells)


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


def _terms(kind: _Kind, terms: Sequence[Term], cells: Cells) -> OverviewTableContext:
    groups = [
        OverviewGroupContext(
            OverviewCellContext(term.entry.number, note=_subject(term.entry), links=cells.links(term.entry)),
            (
                (
                    OverviewCellContext(term.entry.measured, style="date"),
                    OverviewCellContext(term.due.isoformat(), style="date"),
                ),
            ),
        )
        for term in terms
    ]
    return _table(kind, groups, cells)


def _common(common: Sequence[Shared], cells: Cells) -> OverviewTableContext:
    groups = [
        OverviewGroupContext(
            OverviewCellContext(each.axis, note=each.type),
            (
                (
                    OverviewCellContext(each.effect, note=each.name.replace("_", " ")),
                    cells.mean(each.mean, each.expanded_uncertainty, each.unit),
                    OverviewCellContext(str(len(each.machines)), note=", ".join(each.machines)),
                ),
            ),
        )
        for each in common
    ]
    return _table(_SHARED, groups, cells)


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
        found[_key(each)].append(each)
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


_COLUMNS = (
    *(words.AXIS, words.PARAMETER, words.VALUE, words.LIMIT),
    *(words.STATE, words.COURSE, words.CHANGE_OR_DRIFT),
)


def machines(state: FleetState, cells: Cells) -> OverviewTableContext:
    """Return the table of all axes, machine by machine."""
    marks, due = _marks(state), {_axis_of(term.entry): term.due for term in state.terms}
    groups = [
        _axis(of_axis, cells, marks[_key(of_axis[0])], due.get(_key(of_axis[0])))
        for of_axis in _by_axis(state.trends)
    ]
    return OverviewTableContext(
        key="axes",
        style="machine",
        title=cells.say(words.AXES),
        count=str(len(groups)),
        caption=cells.say(words.MACHINE_CAPTION.given(first=cells.period.first.isoformat())),
        headings=tuple(OverviewCellContext(cells.say(column)) for column in _COLUMNS),
        groups=tuple(groups),
    )


def tools(state: FleetState, cells: Cells) -> OverviewToolsContext:
    """Return what a reader searches, chooses and orders the axes by: only what there is can be chosen."""
    counted = Counter(mark for marks in _marks(state).values() for mark in marks)
    choices = [(key, f"{cells.say(label)} ({counted[key]})") for key, label in _MARKS.items() if counted[key]]
    orders = (
        *(("machine", words.BY_MACHINE), ("used", words.BY_USE)),
        *((("due", words.BY_DUE),) if state.terms else ()),
        ("measured", words.BY_MEASURED),
    )
    return OverviewToolsContext(
        search=cells.say(words.SEARCH),
        example=state.trends[0].series.machine,
        choices=(
            ("choice", cells.say(words.CHOICE), (("", cells.say(words.ALL_AXES)), *choices)),
            ("order", cells.say(words.ORDER), tuple((key, cells.say(label)) for key, label in orders)),
        ),
        found=cells.say(words.FOUND),
    )


#: What an axis may be chosen by, as the tables of what needs somebody are named.
_MARKS = {
    "not-met": words.NOT_MET,
    "undecided": words.UNDECIDED,
    "changed": words.CHANGED,
    "drifting": words.DRIFTING,
    "overdue": words.OVERDUE,
    "due": words.DUE_SOON,
}


def _marks(state: FleetState) -> Mapping[tuple[str, str], list[str]]:
    found: defaultdict[tuple[str, str], list[str]] = defaultdict(list)
    by_mark = {
        "not-met": map(_key, state.not_met),
        "undecided": map(_key, state.undecided),
        "changed": map(_key, state.changed),
        "drifting": map(_key, state.drifting),
        "overdue": (_axis_of(term.entry) for term in state.overdue),
        "due": (_axis_of(term.entry) for term in state.soon),
    }
    for mark, axes in by_mark.items():
        for axis in dict.fromkeys(axes):
            found[axis].append(mark)
    return found


def _key(trend: Trend) -> tuple[str, str]:
    return trend.series.machine, trend.series.axis


def _axis_of(entry: Entry) -> tuple[str, str]:
    return entry.machine, entry.axis


def _axis(
    trends: Sequence[Trend], cells: Cells, marks: Sequence[str], due: date | None
) -> OverviewGroupContext:
    latest = max((trend.series.calibrations[-1] for trend in trends), key=lambda each: each.measured)
    measured = latest.measured.isoformat()
    said = (
        words.MEASURED_DUE.given(date=measured, due=str(due)) if due else words.MEASURED.given(date=measured)
    )
    named = trends[0].series.machine or cells.say(words.NO_MACHINE)
    used = [
        abs(trend.series.latest.value) / trend.series.latest.limit
        for trend in trends
        if trend.series.latest.limit
    ]
    head = OverviewCellContext(
        trends[0].series.axis, note=f"{named}\n{cells.say(said)}", links=cells.links(latest.entry)
    )
    rows = tuple(
        (
            cells.parameter(trend),
            cells.value(trend),
            cells.limit(trend),
            cells.state(trend),
            cells.course(trend),
            cells.change(trend) if trend.step or trend.is_wilder else cells.drift(trend),
        )
        for trend in _shown(trends)
    )
    facts = (
        ("marks", " ".join(marks)),
        ("used", f"{max(used):.3f}" if used else ""),
        ("measured", measured),
        ("due", due.isoformat() if due else ""),
    )
    return OverviewGroupContext(head, rows, facts)


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


_FIRST = date(2000, 1, 1)
_SAMPLE = (8.4, 9.9, 11.2, 13.5, 14.6, 17.0, 18.4, 20.6)
_UNCERTAINTY, _LIMIT = 1.5, 20.0


def legend(cells: Cells) -> OverviewLegendContext:
    """Return the legend."""
    terms = (
        (words.TERM_VALUE, words.MEANING_VALUE),
        (words.TERM_BAND, words.MEANING_BAND),
        (words.TERM_LIMIT, words.MEANING_LIMIT),
        (words.TERM_STEP, words.MEANING_STEP),
        (words.TERM_DRIFT, words.MEANING_DRIFT),
    )
    steps = words.STEP_METHOD.given(scatters=round(SEEN), least=LEAST_BEFORE, small=round(100 * SMALL))
    method = words.DRIFT_METHOD.given(least=LEAST_DATES, share=round(100 * FALSE_SHARE))
    sample = _sample()
    calibrations = sample.series.calibrations
    period = Period(calibrations[0].measured, calibrations[-1].measured)
    return OverviewLegendContext(
        drawing=drawing(small_graph(sample, period, cells.say(words.SAMPLE))),
        terms=tuple((cells.say(term), cells.say(meaning)) for term, meaning in terms),
        paragraphs=(cells.say(steps), cells.say(method), cells.say(words.FORECAST_METHOD)),
    )


def _sample() -> Trend:
    entry = Entry(job="", night="", state=State.MADE)
    calibrations = tuple(
        Calibration(
            _FIRST + timedelta(days=91 * quarter),
            entry,
            RecordedParameter("", "", value, "um", _UNCERTAINTY, _LIMIT, value <= _LIMIT),
        )
        for quarter, value in enumerate(_SAMPLE)
    )
    series = Series("", "", "", "", "um", calibrations)
    return Trend(series, line_through(series), drifts=True)
