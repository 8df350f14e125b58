"""The overview of a fleet as a page of HTML: its sections, tables, tiles and what needs somebody.

What needs somebody, worst first; every machine with its axes and their latest values; how to read it all.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from datetime import date, timedelta
from itertools import groupby, islice
from typing import Generic, TypeVar

from zlmreport.document.typesetting.overview import (
    OverviewCellContext,
    OverviewChoicesContext,
    OverviewContext,
    OverviewGroupContext,
    OverviewLegendContext,
    OverviewMachineContext,
    OverviewMachinesContext,
    OverviewRowContext,
    OverviewSearchContext,
    OverviewSectionContext,
    OverviewTableContext,
    TileContext,
    make_drawing,
    make_overview_style,
    read_overview_script,
)
from zlmreport.document.typesetting.resources import digest_script
from zlmreport.document.typesetting.templates import render
from zlmreport.fleet import overview_words as words
from zlmreport.fleet.causes import LEAST_MACHINES, Shared, find_shared
from zlmreport.fleet.drifts import FALSE_SHARE, LEAST_DATES, Trend, group_by_axis
from zlmreport.fleet.overview_cells import CellWriter, TrendKey, make_key_of
from zlmreport.fleet.overview_trend import pack_trends, show_trend_in_full
from zlmreport.fleet.printing import Names
from zlmreport.fleet.records import LedgerEntry, NightNotice, PastNight, RecordedParameter, State
from zlmreport.fleet.state import DueDate, FailingJob, FleetState
from zlmreport.fleet.steps import LEAST_BEFORE, SEEN, SMALL, compute_level_of
from zlmreport.fleet.trend import Calibration, Series, fit_line_through
from zlmreport.fleet.trend_graph import Period, draw_trend
from zlmreport.job.days import SOON
from zlmreport.language import Language, Words, join_parts
from zlmreport.version import __version__

_MINUTE = 60
#: So many graphs a page has as they are; where there are more, those of what needs nobody are packed.
MOST_DRAWN = 100


def make_overview(state: FleetState, language: Language, names: Names, files: str) -> str:
    """Return the page; the same ledger gives the same page.

    `files`: Folder of the certificates, relative to that of the page.
    """
    dates = [each.measured for trend in state.trends for each in trend.series.calibrations]
    period = Period(min(dates, default=date.min), max(dates, default=date.min))
    printed = replace(state, trends=tuple(map(names.as_printed, state.trends)))
    chosen = _choose_shown_in_full(printed)
    keys = [make_key_of(each.series) for each in chosen]
    anchors = {key: f"trend-{number}" for number, key in enumerate(keys, 1)}
    drawn = _choose_drawn(printed, keys)
    packed = {key: number for number, key in enumerate(keys, 1) if key not in drawn}
    effects: defaultdict[tuple[str, str], list[Series]] = defaultdict(list)
    for series in state.effects:
        effects[series.axis_key].append(series)
    cells = CellWriter(language, names, period, files, effects, anchors, packed)
    script = read_overview_script()
    return render(
        OverviewContext(
            language=language.value,
            title=cells.say(words.TITLE),
            subtitle=state.name,
            generator=f"zlmreport {__version__}",
            style=make_overview_style(),
            script=script,
            policy=digest_script(script),
            facts=tuple(_list_facts(printed, cells)),
            tiles=tuple(_make_tiles(printed, cells)),
            tiles_title=cells.say(words.HEADLINE),
            search=tuple(map(render, _make_search(printed, cells))),
            sections=tuple(map(render, _make_sections(printed, cells))),
            trends=tuple(
                render(show_trend_in_full(each, cells))
                for each, key in zip(chosen, keys, strict=True)
                if key in drawn
            ),
            packs=tuple(pack_trends(chosen, cells)),
        )
    )


def _list_facts(state: FleetState, cells: CellWriter) -> Iterator[tuple[str, str]]:
    yield cells.say(words.LAST_RUN), cells.say(_run(state.night))
    yield cells.say(words.JOBS), cells.say(_say_jobs_done(state))
    yield cells.say(words.CERTIFICATES), str(len(state.certificates))


def _run(night: PastNight | None) -> Words:
    if night is None:
        return words.NEVER
    began = night.began.strftime("%Y-%m-%d %H:%M UTC")
    if night.is_at_work:
        return words.AT_WORK.given(began=began, number=night.done)
    if night.seconds is None:
        return words.INTERRUPTED.given(began=began)
    minutes, seconds = divmod(round(night.seconds), _MINUTE)
    duration = words.MINUTES.given(minutes=minutes, seconds=seconds) if minutes else words.SECONDS
    return words.RAN.given(began=began, duration=duration.given(number=seconds))


def _say_jobs_done(state: FleetState) -> Words:
    counts = state.counts
    drafts = words.AS_DRAFTS.given(number=counts["draft"])
    done = words.JOBS_DONE.given(jobs=state.jobs, drafts=drafts, **counts)
    left = counts["left"]
    return words.JOBS_LEFT.given(done=done, number=left) if left else done


def _make_tiles(state: FleetState, cells: CellWriter) -> Iterator[TileContext]:
    counted = (
        (len(state.notices), words.NOTICED, "noticed"),
        (len(state.failures), words.FAILED, "failed"),
        (len(group_by_axis(state.not_met)), words.NOT_MET, "not-met"),
        (len(group_by_axis(state.undecided)), words.UNDECIDED, "undecided"),
        (len(state.doubtful), words.DOUBTFUL, "doubtful"),
        (len(group_by_axis(state.changed)), words.CHANGED, "changed"),
        (len(group_by_axis(state.drifting)), words.DRIFTING, "drifting"),
        (len(state.overdue), words.OVERDUE, "overdue"),
        (len(state.soon), words.DUE_SOON, "due"),
        (len(state.drafts), words.DRAFTS, "drafts"),
    )
    for number, label, key in counted:
        if key == "noticed" and not number:
            continue  # a run as a whole is no number of things that may be none
        style = f"raised {key}" if number and key != "due" else "calm"
        yield TileContext(str(number), cells.say(label), style, key if number else "")
    yield TileContext(str(len(state.axes)), cells.say(words.AXES), "calm", "machines")


def _make_sections(state: FleetState, cells: CellWriter) -> Iterator[OverviewSectionContext]:
    needed = tuple(map(render, _list_needs(state, cells)))
    nothing = "" if needed else cells.say(words.NOTHING if state.jobs else words.NO_NIGHT)
    yield OverviewSectionContext("needs", cells.say(words.NEEDS), nothing, "calm", needed)
    if state.terms:
        soon = _DUE.lay_out(_list_terms(state.soon, cells), cells)
        nothing = "" if state.soon else cells.say(words.NOTHING_DUE.given(days=SOON.days))
        tables = (render(soon),) if state.soon else ()
        yield OverviewSectionContext("due", cells.say(words.DUE_SOON), nothing, "calm", tables)
    common = find_shared(state.effects)
    if common:
        found = [(OverviewCellContext(each.axis, note=each.type), [each]) for each in common]
        tables = (render(_SHARED.lay_out(found, cells)),)
        yield OverviewSectionContext("shared", cells.say(words.SHARED), "", "", tables)
    all_axes = (_make_choices(state, cells), _list_machines(state, cells)) if state.trends else ()
    shown = tuple(map(render, all_axes))
    yield OverviewSectionContext("machines", cells.say(words.MACHINES), "", "", shown)
    reading = (render(_make_legend(cells)),)
    yield OverviewSectionContext("reading", cells.say(words.READING), "", "", reading)


T = TypeVar("T")


@dataclass(frozen=True, slots=True)
class _Table(Generic[T]):
    """A table: its anchor and its words, the heading of what rows share, and each column with its cells."""

    key: str
    title: Words
    caption: Words
    heading: Words
    columns: tuple[tuple[Words, Callable[[CellWriter, T], OverviewCellContext]], ...]
    style: str = ""

    def lay_out(
        self, groups: Iterable[tuple[OverviewCellContext, Iterable[T]]], cells: CellWriter
    ) -> OverviewTableContext:
        """Return the table of groups, each with its first cell and what its rows are about."""
        made = tuple(
            OverviewGroupContext(
                head, tuple(tuple(cell(cells, each) for _, cell in self.columns) for each in rows)
            )
            for head, rows in groups
        )
        headings = (self.heading, *(heading for heading, _ in self.columns))
        return OverviewTableContext(
            key=self.key,
            style=self.style or self.key,
            title=cells.say(self.title),
            count=str(len(made)),
            caption=cells.say(self.caption),
            headings=tuple(OverviewCellContext(cells.say(each)) for each in headings),
            groups=made,
        )


def _make_message(text: str) -> OverviewCellContext:
    return OverviewCellContext(text, style="message")


def _make_date(moment: str) -> OverviewCellContext:
    return OverviewCellContext(moment[:10], style="date")


_VALUES = (
    (words.PARAMETER, CellWriter.write_parameter),
    (words.VALUE, CellWriter.write_value),
    (words.LIMIT, CellWriter.write_limit),
)
_COURSE = (words.COURSE, CellWriter.write_course)
_OF_LIMITS = (*_VALUES, _COURSE, (words.CERTIFICATE, CellWriter.write_latest))
_OF_TERMS: tuple[tuple[Words, Callable[[CellWriter, DueDate], OverviewCellContext]], ...] = (
    (words.MEASURED_ON, lambda _, term: _make_date(term.entry.measured)),
    (words.DUE, lambda _, term: _make_date(term.due.isoformat())),
)
_NOTICED: _Table[NightNotice] = _Table(
    "noticed",
    words.NOTICED,
    words.NOTICED_CAPTION,
    words.ABOUT,
    ((words.MESSAGE, lambda cells, notice: _make_message(cells.say(notice.text))),),
)
_FAILED: _Table[FailingJob] = _Table(
    "failed",
    words.FAILED,
    words.FAILED_CAPTION,
    words.JOB,
    (
        (words.MESSAGE, lambda _, failure: _make_message(failure.entry.message)),
        (words.SINCE, lambda _, failure: _make_date(failure.since)),
    ),
)
_NOT_MET = _Table("not-met", words.NOT_MET, words.NOT_MET_CAPTION, words.AXIS, _OF_LIMITS)
_UNDECIDED = _Table("undecided", words.UNDECIDED, words.UNDECIDED_CAPTION, words.AXIS, _OF_LIMITS)
_DOUBTFUL: _Table[Words] = _Table(
    "doubtful",
    words.DOUBTFUL,
    words.DOUBTFUL_CAPTION,
    words.AXIS,
    ((words.DOUBT, lambda cells, doubt: _make_message(cells.say(doubt))),),
)
_CHANGED = _Table(
    "changed",
    words.CHANGED,
    words.CHANGED_CAPTION,
    words.AXIS,
    (
        *_VALUES,
        _COURSE,
        (words.CHANGE, CellWriter.write_change),
        (words.CAME_WITH, CellWriter.write_what_came_with),
    ),
)
_DRIFTING = _Table(
    "drifting",
    words.DRIFTING,
    words.DRIFTING_CAPTION,
    words.AXIS,
    (*_VALUES, _COURSE, (words.DRIFT, CellWriter.write_drift), (words.REACHED, CellWriter.write_day_reached)),
)
_OVERDUE = _Table("overdue", words.OVERDUE, words.OVERDUE_CAPTION, words.CERTIFICATE, _OF_TERMS)
_DUE = _Table(
    "due-soon", words.DUE_SOON, words.DUE_CAPTION.given(days=SOON.days), words.CERTIFICATE, _OF_TERMS
)
_DRAFTS: _Table[LedgerEntry] = _Table(
    "drafts",
    words.DRAFTS,
    words.DRAFTS_CAPTION,
    words.CERTIFICATE,
    (
        (words.REASON, lambda _, entry: _make_message(entry.message)),
        (words.JOB, lambda _, entry: OverviewCellContext(entry.job)),
        (words.SINCE, lambda _, entry: _make_date(entry.night)),
    ),
)
_SHARED: _Table[Shared] = _Table(
    "shared-by-type",
    words.SHARED,
    words.SHARED_CAPTION.given(least=LEAST_MACHINES),
    words.TYPE,
    (
        (words.EFFECT, lambda _, each: OverviewCellContext(each.effect, note=each.name.replace("_", " "))),
        (words.MEAN, lambda cells, each: cells.write_mean(each.mean, each.expanded_uncertainty, each.unit)),
        (
            words.MACHINES_OF_TYPE,
            lambda _, each: OverviewCellContext(str(len(each.machines)), note=", ".join(each.machines)),
        ),
    ),
)


def _list_needs(state: FleetState, cells: CellWriter) -> Iterator[OverviewTableContext]:
    """Yield a table of each kind of thing that needs somebody; none where there is nothing of the kind."""
    noticed = [(OverviewCellContext(cells.say(words.ABOUTS[each.about])), [each]) for each in state.notices]
    failed = [
        (OverviewCellContext(each.entry.job, note=each.entry.of_axis), [each]) for each in state.failures
    ]
    doubtful = [(cells.write_axis_of(each), each.doubts) for each in state.doubtful]
    tables = (
        _NOTICED.lay_out(noticed, cells),
        _FAILED.lay_out(failed, cells),
        _NOT_MET.lay_out(_list_axes(state.not_met, cells), cells),
        _UNDECIDED.lay_out(_list_axes(state.undecided, cells), cells),
        _DOUBTFUL.lay_out(doubtful, cells),
        _CHANGED.lay_out(_list_axes(state.changed, cells), cells),
        _DRIFTING.lay_out(_list_drifts(state.drifting, cells), cells),
        _OVERDUE.lay_out(_list_terms(state.overdue, cells), cells),
        _DRAFTS.lay_out([(cells.write_issued(each), [each]) for each in state.drafts], cells),
    )
    return (each for each in tables if each.groups)


def _list_axes(
    trends: Sequence[Trend], cells: CellWriter
) -> Iterator[tuple[OverviewCellContext, list[Trend]]]:
    return ((cells.write_axis(each[0]), each) for each in group_by_axis(trends).values())


def _list_terms(
    terms: Sequence[DueDate], cells: CellWriter
) -> Iterator[tuple[OverviewCellContext, list[DueDate]]]:
    return ((cells.write_issued(each.entry), [each]) for each in terms)


def _list_drifts(
    trends: Sequence[Trend], cells: CellWriter
) -> Iterator[tuple[OverviewCellContext, list[Trend]]]:
    for head, of_axis in _list_axes(trends, cells):
        # An axis of which nothing is limited still shows its first parameter.
        shown = [each for each in of_axis if each.series.latest.limit is not None] or of_axis[:1]
        also = cells.join_symbols(each for each in of_axis if each not in shown)
        more = (head.note, cells.say(words.ALSO.given(symbols=also)))
        note = join_parts(more, cells.language) if also else head.note
        yield replace(head, note=note), shown


def _list_machines(state: FleetState, cells: CellWriter) -> OverviewMachinesContext:
    """Return all axes, machine by machine: of each its parameters, a row each."""
    marks, due = _list_marks(state), {term.entry.axis_key: term.due for term in state.terms}
    axes = group_by_axis(state.trends)
    of_machine = groupby(axes.items(), key=lambda item: item[0][0])
    headings = (words.AXIS, *(heading for heading, _ in _OF_AXES), words.MEASURED_ON)
    return OverviewMachinesContext(
        title=cells.say(words.AXES),
        count=str(len(axes)),
        caption=cells.say(
            (words.LARGE_CAPTION if cells.packed else words.MACHINE_CAPTION).given(
                first=cells.period.first.isoformat()
            )
        ),
        headings=tuple(map(cells.say, headings)),
        machines=tuple(_make_machine(dict(its_axes), marks, due, cells) for _, its_axes in of_machine),
    )


_OF_AXES: tuple[tuple[Words, Callable[[CellWriter, Trend], OverviewCellContext]], ...] = (
    (words.PARAMETER, CellWriter.write_in_brief),
    (words.VALUE, CellWriter.write_value),
    (words.LIMIT, CellWriter.write_limit),
    (words.STATE, CellWriter.write_state),
    _COURSE,
    (words.CHANGE_OR_DRIFT, CellWriter.write_change_in_brief),
)


def _make_machine(
    axes: Mapping[tuple[str, str], Sequence[Trend]],
    marks: Sequence[tuple[str, Words, frozenset[tuple[str, str]]]],
    due: Mapping[tuple[str, str], date],
    cells: CellWriter,
) -> OverviewMachineContext:
    rows = []
    for key, trends in axes.items():
        shown = _choose_shown(trends)
        facts = _list_facts_of(trends, [mark for mark, _, marked in marks if key in marked], due.get(key))
        for number, trend in enumerate(shown):
            beside = tuple(cell(cells, trend) for _, cell in _OF_AXES)
            head = None if number else cells.write_quantity(trend)
            measured = OverviewCellContext() if number else cells.write_day_measured(trend, due.get(key))
            rows.append(OverviewRowContext(head, len(shown), () if number else facts, (*beside, measured)))
    counted = words.COUNTED_AXES.given(number=len(axes))
    name = cells.name_machine(next(iter(axes.values()))[0].series)
    return OverviewMachineContext(name, cells.say(counted), tuple(rows))


def _choose_shown_in_full(state: FleetState) -> tuple[Trend, ...]:
    """Return the trends whose small graphs stand anywhere, in the order of the ledger."""
    of_axes = [each for trends in group_by_axis(state.trends).values() for each in _choose_shown(trends)]
    drifting = [each for trends in group_by_axis(state.drifting).values() for each in trends]
    named = (*of_axes, *state.not_met, *state.undecided, *state.changed, *drifting)
    keys = {make_key_of(each.series) for each in named}
    return tuple(each for each in state.trends if make_key_of(each.series) in keys)


def _choose_drawn(state: FleetState, keys: Sequence[TrendKey]) -> frozenset[TrendKey]:
    """Return the trends whose graphs a page has as they are: of many those alone of what needs somebody."""
    if len(keys) <= MOST_DRAWN:
        return frozenset(keys)
    needing = (*state.not_met, *state.undecided, *state.changed, *state.drifting)
    return frozenset(islice(dict.fromkeys(make_key_of(each.series) for each in needing), MOST_DRAWN))


def _make_search(state: FleetState, cells: CellWriter) -> Iterator[OverviewSearchContext]:
    """Yield the search where there is something to be searched."""
    if state.trends:
        yield OverviewSearchContext(
            search=cells.say(words.SEARCH),
            example=state.trends[0].series.machine,
            # How many are shown the page says itself, whenever somebody searches.
            found=cells.say(words.FOUND.given(shown="{shown}", number=len(group_by_axis(state.trends)))),
        )


def _make_choices(state: FleetState, cells: CellWriter) -> OverviewChoicesContext:
    """Return what a reader chooses and orders the axes by: only what there is can be chosen."""
    choices = [(key, f"{cells.say(label)} ({len(axes)})") for key, label, axes in _list_marks(state) if axes]
    orders = (
        *(("machine", words.BY_MACHINE), ("used", words.BY_USE)),
        *((("due", words.BY_DUE),) if state.terms else ()),
        ("measured", words.BY_MEASURED),
    )
    return OverviewChoicesContext(
        choices=(
            ("choice", cells.say(words.CHOICE), (("", cells.say(words.ALL_AXES)), *choices)),
            ("order", cells.say(words.ORDER), tuple((key, cells.say(label)) for key, label in orders)),
        )
    )


def _list_marks(state: FleetState) -> Sequence[tuple[str, Words, frozenset[tuple[str, str]]]]:
    """Return what an axis may be chosen by, named as the tables of what needs somebody, with these axes."""
    return (
        ("not-met", words.NOT_MET, frozenset(group_by_axis(state.not_met))),
        ("undecided", words.UNDECIDED, frozenset(group_by_axis(state.undecided))),
        ("doubtful", words.DOUBTFUL, frozenset(each.axis_key for each in state.doubtful)),
        ("changed", words.CHANGED, frozenset(group_by_axis(state.changed))),
        ("drifting", words.DRIFTING, frozenset(group_by_axis(state.drifting))),
        ("overdue", words.OVERDUE, frozenset(term.entry.axis_key for term in state.overdue)),
        ("due", words.DUE_SOON, frozenset(term.entry.axis_key for term in state.soon)),
    )


def _list_facts_of(
    trends: Sequence[Trend], marks: Sequence[str], due: date | None
) -> tuple[tuple[str, str], ...]:
    """Return by what a reader chooses and orders an axis."""
    latest = [trend.series.latest for trend in trends]
    used = [abs(each.value) / each.limit for each in latest if each.limit]
    return (
        ("marks", " ".join(marks)),
        ("used", f"{max(used):.3f}" if used else ""),
        ("measured", max(each.series.calibrations[-1].measured for each in trends).isoformat()),
        ("due", due.isoformat() if due else ""),
    )


def _choose_shown(trends: Sequence[Trend]) -> tuple[Trend, ...]:
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


def _make_legend(cells: CellWriter) -> OverviewLegendContext:
    terms = (
        (words.TERM_VALUE, words.MEANING_VALUE),
        (words.TERM_BAND, words.MEANING_BAND),
        (words.TERM_LIMIT, words.MEANING_LIMIT),
        (words.TERM_STEP, words.MEANING_STEP),
        (words.TERM_DRIFT, words.MEANING_DRIFT),
    )
    steps = words.STEP_METHOD.given(
        scatters=round(SEEN),
        least=LEAST_BEFORE,
        alarms=round(1 / compute_level_of(LEAST_BEFORE)),
        small=round(100 * SMALL),
    )
    method = words.DRIFT_METHOD.given(least=LEAST_DATES, share=round(100 * FALSE_SHARE))
    sample = _sample()
    calibrations = sample.series.calibrations
    period = Period(calibrations[0].measured, calibrations[-1].measured)
    return OverviewLegendContext(
        drawing=make_drawing(
            draw_trend(sample, period, cells.say(words.SAMPLE), cells.language.decimal_sign)
        ),
        terms=tuple((cells.say(term), cells.say(meaning)) for term, meaning in terms),
        paragraphs=(cells.say(steps), cells.say(method), cells.say(words.FORECAST_METHOD)),
    )


def _sample() -> Trend:
    entry = LedgerEntry(job="", night="", state=State.MADE)
    calibrations = tuple(
        Calibration(
            _FIRST + timedelta(days=91 * quarter),
            entry,
            RecordedParameter("", "", value, "um", _UNCERTAINTY, _LIMIT, value <= _LIMIT),
        )
        for quarter, value in enumerate(_SAMPLE)
    )
    series = Series("", "", "", "", "um", calibrations)
    return Trend(series, fit_line_through(series), drifts=True)
