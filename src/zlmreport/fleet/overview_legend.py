"""How to read the overview, with a graph that shows everything a graph can show."""

from __future__ import annotations

from datetime import date, timedelta

from zlmreport.fleet import overview_words as words
from zlmreport.fleet.overview_cells import Cells
from zlmreport.fleet.overview_graph import Period, small_graph
from zlmreport.fleet.records import Entry, RecordedParameter, State
from zlmreport.fleet.trend import Calibration, Series
from zlmreport.fleet.trend_fleet import FALSE_SHARE, LEAST_DATES, Trend
from zlmreport.fleet.trend_line import line_through
from zlmreport.typesetting.overview import OverviewLegendContext, drawing

_FIRST = date(2000, 1, 1)
_SAMPLE = (8.4, 9.9, 11.2, 13.5, 14.6, 17.0, 18.4, 20.6)
_UNCERTAINTY, _LIMIT = 1.5, 20.0


def legend(cells: Cells) -> OverviewLegendContext:
    """Return the legend."""
    terms = (
        (words.TERM_VALUE, words.MEANING_VALUE),
        (words.TERM_BAND, words.MEANING_BAND),
        (words.TERM_LIMIT, words.MEANING_LIMIT),
        (words.TERM_DRIFT, words.MEANING_DRIFT),
    )
    method = words.DRIFT_METHOD.given(least=LEAST_DATES, share=round(100 * FALSE_SHARE))
    sample = _sample()
    calibrations = sample.series.calibrations
    period = Period(calibrations[0].measured, calibrations[-1].measured)
    return OverviewLegendContext(
        drawing=drawing(small_graph(sample, period, cells.say(words.SAMPLE))),
        terms=tuple((cells.say(term), cells.say(meaning)) for term, meaning in terms),
        paragraphs=(cells.say(method), cells.say(words.FORECAST_METHOD)),
    )


def _sample() -> Trend:
    entry = Entry("", "", "", "", "", "", "", State.MADE)
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
