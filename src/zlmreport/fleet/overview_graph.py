"""The small graph of a series: its values with their uncertainty, the limit, and the line of a drift.

Every line has a shape of its own, and a class by which a style sheet gives it the colour of the page.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from datetime import date

from zlmreport.figures.canvas import Fill, Segment, Stroke
from zlmreport.figures.svg import SvgCanvas
from zlmreport.fleet.trend import Calibration
from zlmreport.fleet.trend_fleet import Trend

#: In points.
WIDTH, HEIGHT = 150.0, 42.0
_MARGIN = 4.0
#: Of the time shown, kept free behind the last calibration: there a drift leads on.
_AHEAD = 0.2
#: Of the values' span, kept free above and below.
_ROOM = 0.08
#: Half the width of a point; of the last one; of the band about a single calibration.
_POINT, _LAST, _SINGLE = 1.8, 2.7, 3.0

_INK = (0.05, 0.29, 0.39)
_ALARM = (0.63, 0.09, 0.09)
_GREY = (0.55, 0.6, 0.64)


@dataclass(frozen=True, slots=True)
class Period:
    """The time that all graphs of an overview show, so that they compare."""

    first: date
    last: date

    @property
    def days(self) -> int:
        """How long it is; one day at the least."""
        return max(1, (self.last - self.first).days)


@dataclass(frozen=True, slots=True)
class _Frame:
    """Where dates and values lie on the drawing."""

    period: Period
    lower: float
    upper: float

    def x(self, day: float) -> float:
        part = (day - self.period.first.toordinal()) / (self.period.days * (1 + _AHEAD))
        return _MARGIN + part * (WIDTH - 2 * _MARGIN)

    def y(self, value: float) -> float:
        part = (value - self.lower) / (self.upper - self.lower)
        return HEIGHT - part * HEIGHT


def small_graph(trend: Trend, period: Period, alternative: str) -> str:
    """Return the graph as SVG.

    Parameters
    ----------
    trend
        What is shown. With a limit the graph is as high as the limit, or the largest value.
    period
        The time shown.
    alternative
        What the graph says, in words.
    """
    calibrations = trend.series.calibrations
    frame = _Frame(period, *_span(calibrations))
    canvas = SvgCanvas(WIDTH, HEIGHT, alternative)
    canvas.outline("ground", _line((0, 0), (WIDTH, 0), (WIDTH, HEIGHT), (0, HEIGHT), closed=True), None, None)
    limit = trend.series.latest.limit
    if limit is not None:
        _draw_limit(canvas, frame, limit)
    if frame.lower <= 0:
        canvas.outline("zero", _line((0, frame.y(0)), (WIDTH, frame.y(0))), Stroke(_GREY, 0.6), None)
    _draw_band(canvas, frame, calibrations)
    if trend.drifts:
        _draw_drift(canvas, frame, trend)
    _draw_values(canvas, frame, calibrations)
    return canvas.image()


def _span(calibrations: Sequence[Calibration]) -> tuple[float, float]:
    """Return the least and the largest value shown: zero, the limit, every value with its uncertainty."""
    reached = [
        each.parameter.value + sign * (each.parameter.expanded_uncertainty or 0.0)
        for each in calibrations
        for sign in (-1, 1)
    ]
    limit = calibrations[-1].parameter.limit
    lower, upper = min(0.0, *reached), max(0.0, *reached)
    if min(each.parameter.value for each in calibrations) >= 0:
        lower = 0.0
    if limit is not None:
        lower, upper = (min(lower, -limit) if lower < 0 else lower), max(upper, limit)
    room = _ROOM * ((upper - lower) or 1.0)
    return lower - (room if lower < 0 else 0.0), upper + room


def _draw_limit(canvas: SvgCanvas, frame: _Frame, limit: float) -> None:
    for bound, edge in ((limit, 0.0), (-limit, HEIGHT)):
        y = frame.y(bound)
        if 0 <= y < HEIGHT:
            beyond = _line((0, edge), (WIDTH, edge), (WIDTH, y), (0, y), closed=True)
            canvas.outline("beyond", beyond, None, Fill(_ALARM, 0.1))
            canvas.outline("limit", _line((0, y), (WIDTH, y)), Stroke(_ALARM, 0.9, (6.0, 2.0)), None)


def _draw_band(canvas: SvgCanvas, frame: _Frame, calibrations: Sequence[Calibration]) -> None:
    upper, lower = [], []
    for each in calibrations:
        uncertainty = each.parameter.expanded_uncertainty
        if uncertainty is None:
            continue
        x = frame.x(each.measured.toordinal())
        upper.append((x, frame.y(each.parameter.value + uncertainty)))
        lower.append((x, frame.y(each.parameter.value - uncertainty)))
    if len(upper) == 1:
        upper = [(upper[0][0] + step, upper[0][1]) for step in (-_SINGLE, _SINGLE)]
        lower = [(lower[0][0] + step, lower[0][1]) for step in (-_SINGLE, _SINGLE)]
    if upper:
        canvas.outline("band", _line(*upper, *reversed(lower), closed=True), None, Fill(_INK, 0.18))


def _draw_drift(canvas: SvgCanvas, frame: _Frame, trend: Trend) -> None:
    line, calibrations = trend.line, trend.series.calibrations
    if line is None:
        return
    first = calibrations[0].measured
    last = date.fromordinal(frame.period.last.toordinal() + round(frame.period.days * _AHEAD))
    ends = [(frame.x(day.toordinal()), frame.y(line.at(day))) for day in (first, last)]
    canvas.outline("drift", _line(*ends), Stroke(_ALARM, 1.2, (5.0, 1.6, 1.2, 1.6)), None)


def _draw_values(canvas: SvgCanvas, frame: _Frame, calibrations: Sequence[Calibration]) -> None:
    places = [(frame.x(each.measured.toordinal()), frame.y(each.parameter.value)) for each in calibrations]
    if len(places) > 1:
        canvas.outline("course", _line(*places), Stroke(_INK, 0.9), None)
    for each, (x, y) in zip(calibrations, places, strict=True):
        half = _LAST if each is calibrations[-1] else _POINT
        if each.parameter.conforms is False:
            cross = (
                *_line((x - half, y - half), (x + half, y + half)),
                *_line((x - half, y + half), (x + half, y - half)),
            )
            canvas.outline("point not-met", cross, Stroke(_ALARM, 1.4), None)
        else:
            diamond = _line((x - half, y), (x, y - half), (x + half, y), (x, y + half), closed=True)
            canvas.outline("point", diamond, None, Fill(_INK))


def _line(*points: tuple[float, float], closed: bool = False) -> tuple[Segment, ...]:
    first, *others = points
    rest = tuple(("L", point) for point in others)
    return (("M", first), *rest, *((("Z", ()),) if closed else ()))
