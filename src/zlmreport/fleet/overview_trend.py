"""A parameter of an axis over the years, in full: its graph, its tests, what changed, effects beside it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

from zlmreport.document.typesetting.overview import (
    OverviewCellContext,
    OverviewGroupContext,
    OverviewPackedContext,
    OverviewTableContext,
    OverviewTrendContext,
    PackContext,
    make_drawing,
    pack,
)
from zlmreport.document.typesetting.templates import render
from zlmreport.fleet import overview_words as words
from zlmreport.fleet.drifts import Trend
from zlmreport.fleet.overview_cells import CellWriter, make_key_of
from zlmreport.fleet.trend import Series
from zlmreport.fleet.trend_graph import LARGE, draw_trend
from zlmreport.language import join_parts

#: So many trends, of neighbours, are unpacked at once.
_TOGETHER = 60


def show_trend_in_full(trend: Trend, cells: CellWriter) -> OverviewTrendContext:
    """Return what is shown of a trend when its small graph is chosen."""
    series = trend.series
    key = cells.anchors[make_key_of(series)]
    image = draw_trend(trend, cells.period, cells.describe_graph(trend), cells.language.decimal_sign, LARGE)
    title = words.TREND.given(axis=series.axis, machine=cells.name_machine(series))
    effects = cells.effects.get(series.axis_key, ())
    return OverviewTrendContext(
        key=key,
        title=cells.say(title),
        subtitle=f"{cells.join_symbols([trend])}, {cells.names.name_standard(series.standard)}",
        close=cells.say(words.CLOSE),
        drawing=make_drawing(image),
        facts=tuple(_list_facts(trend, cells)),
        tables=tuple(
            map(
                render,
                filter(None, (_lay_out_tests(key, series, cells), _lay_out_effects(key, effects, cells))),
            )
        ),
    )


def pack_trends(trends: Sequence[Trend], cells: CellWriter) -> Iterator[PackContext]:
    """Yield the small graphs and what is behind them, of those that are packed."""
    packed = [each for each in trends if make_key_of(each.series) in cells.packed]
    drawing = replace(cells, packed={})
    for start in range(0, len(packed), _TOGETHER):
        together = packed[start : start + _TOGETHER]
        shown = (
            OverviewPackedContext(drawing.write_course(each), render(show_trend_in_full(each, drawing)))
            for each in together
        )
        yield PackContext(str(cells.packed[make_key_of(together[0].series)]), pack(map(render, shown)))


def _list_facts(trend: Trend, cells: CellWriter) -> Iterator[tuple[str, str]]:
    """Yield what the tests say of a change and of a drift, and when the limit is reached."""
    if trend.step or trend.is_wilder:
        changed, came_with = cells.write_change(trend), cells.write_what_came_with(trend)
        yield cells.say(words.CHANGE_FACT), _write_in_a_line(changed, cells)
        yield cells.say(words.CAME_WITH), _write_in_a_line(came_with, cells)
    yield cells.say(words.DRIFT_FACT), _write_in_a_line(cells.write_drift(trend), cells)
    if trend.drifts:
        yield cells.say(words.REACHED), _write_in_a_line(cells.write_day_reached(trend), cells)


def _write_in_a_line(cell: OverviewCellContext, cells: CellWriter) -> str:
    return join_parts(filter(None, (cell.content, cell.note)), cells.language)


def _lay_out_tests(key: str, series: Series, cells: CellWriter) -> OverviewTableContext:
    """Return every test, the latest first."""
    rows = []
    for each in reversed(series.calibrations):
        alone = Trend(replace(series, calibrations=(each,)))
        certificate = OverviewCellContext(each.entry.number, links=cells.list_links(each.entry))
        instrument = OverviewCellContext(each.entry.instrument or "–")
        value = (cells.write_value(alone), cells.write_limit(alone), cells.write_state(alone))
        head = OverviewCellContext(each.measured.isoformat())
        rows.append(OverviewGroupContext(head, ((*value, certificate, instrument),)))
    headings = (words.MEASURED_ON, words.VALUE, words.LIMIT, words.STATE, words.CERTIFICATE)
    return OverviewTableContext(
        key=f"{key}-tests",
        style="tests",
        title=cells.say(words.TESTS),
        count="",
        caption=cells.say(words.TESTS_CAPTION),
        headings=tuple(OverviewCellContext(cells.say(each)) for each in (*headings, words.INSTRUMENT_USED)),
        groups=tuple(rows),
    )


def _lay_out_effects(key: str, effects: Sequence[Series], cells: CellWriter) -> OverviewTableContext | None:
    """Return the parameters of the error model of an axis; None where it has none."""
    if not effects:
        return None
    rows = []
    for each in effects:
        effect, _, name = each.symbol.partition(".")
        trend = Trend(each)
        head = OverviewCellContext(effect, note=name.replace("_", " "))
        rows.append(OverviewGroupContext(head, ((cells.write_value(trend), cells.write_course(trend)),)))
    return OverviewTableContext(
        key=f"{key}-effects",
        style="effects",
        title=cells.say(words.EFFECTS),
        count="",
        caption=cells.say(words.EFFECTS_CAPTION),
        headings=tuple(
            OverviewCellContext(cells.say(each)) for each in (words.EFFECT, words.VALUE, words.COURSE)
        ),
        groups=tuple(rows),
    )
