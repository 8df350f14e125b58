"""Graphs of a parameter over the years: small ones beside a value, and a large one for whoever asks.

Every line of a graph has a shape of its own, and a class by which a style sheet gives it its colour.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from datetime import date

from zlmreport.document.figures.canvas import Fill, Run, Segment, Stroke, SvgCanvas, TypeFace
from zlmreport.document.figures.metrics import measure_advance
from zlmreport.document.figures.scale import round_ticks
from zlmreport.fleet.drifts import Trend
from zlmreport.fleet.trend import Calibration
from zlmreport.language.formatting import DecimalSign, write_fixed_number
from zlmreport.measurement.units import find_printed_symbol

#: Of the time shown, kept free behind the last calibration: there a drift leads on.
_AHEAD = 0.2
#: Of the values' span, kept free above and below.
_ROOM = 0.08

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
class GraphSize:
    """How large a graph is, and how much of it stands beside what is drawn; all in points."""

    width: float
    height: float
    #: left and below: For the values and the dates of the scale.
    left: float
    below: float
    text: float  #: Size of their letters.
    point: float  #: Half the width of a point.
    ticks: int  #: At most so many values.

    @property
    def right(self) -> float:
        """Kept free at the right."""
        return 2 * self.point


SMALL = GraphSize(150.0, 42.0, 22.0, 9.5, 7.6, 1.8, 2)
LARGE = GraphSize(520.0, 210.0, 40.0, 18.0, 10.0, 3.2, 5)
#: Half the width of the last point, and of the band about a single calibration, in parts of a point.
_LAST, _SINGLE = 1.5, 1.7
_GAP = 3.0


@dataclass(frozen=True, slots=True)
class _Frame:
    """Where dates and values lie on the drawing."""

    size: GraphSize
    period: Period
    lower: float
    upper: float

    @property
    def bottom(self) -> float:
        return self.size.height - self.size.below

    @property
    def right(self) -> float:
        return self.size.width

    def place_x(self, day: float) -> float:
        part = (day - self.period.first.toordinal()) / (self.period.days * (1 + _AHEAD))
        first, last = self.size.left + self.size.right, self.size.width - self.size.right
        return first + part * (last - first)

    def place_y(self, value: float) -> float:
        part = (value - self.lower) / (self.upper - self.lower)
        return self.bottom * (1 - part)


def draw_trend(
    trend: Trend, period: Period, alternative: str, sign: DecimalSign, size: GraphSize = SMALL
) -> str:
    """Return the graph as SVG.

    `trend`: What is shown. With a limit the graph is as high as the limit, or the largest value.
    `sign`: Between whole and decimal digits.
    """
    calibrations = trend.series.calibrations
    frame = _Frame(size, period, *_find_span(calibrations))
    canvas = SvgCanvas(size.width, size.height, alternative)
    corners = (
        (size.left, 0.0),
        (frame.right, 0.0),
        (frame.right, frame.bottom),
        (size.left, frame.bottom),
    )
    canvas.outline("ground", _draw_line(*corners, closed=True), None, None)
    limit = trend.series.latest.limit
    if limit is not None:
        _draw_limit(canvas, frame, limit)
    _draw_scale(canvas, frame, trend, sign)
    if frame.lower <= 0:
        across = _draw_line((size.left, frame.place_y(0)), (frame.right, frame.place_y(0)))
        canvas.outline("zero", across, Stroke(_GREY, 0.6), None)
    _draw_band(canvas, frame, calibrations)
    _draw_steps(canvas, frame, trend)
    if trend.drifts:
        _draw_drift(canvas, frame, trend)
    _draw_values(canvas, frame, calibrations)
    return canvas.image()


def _find_span(calibrations: Sequence[Calibration]) -> tuple[float, float]:
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


def _draw_scale(canvas: SvgCanvas, frame: _Frame, trend: Trend, sign: DecimalSign) -> None:
    """Draw the scale: values with their unit at the left, years below."""
    size, unit = frame.size, find_printed_symbol(trend.series.unit)
    ticks, decimals = round_ticks(frame.lower, frame.upper, size.ticks)
    for value in ticks:
        y = frame.place_y(value)
        across = _draw_line((size.left, y), (frame.right, y))
        canvas.outline("grid", across, Stroke(_GREY, 0.3), None)
        is_top = value == ticks[-1]
        label = write_fixed_number(value, decimals, sign) + (f" {unit}" if is_top and size is LARGE else "")
        baseline = min(max(y + 0.35 * size.text, 0.8 * size.text), frame.bottom)
        _write(canvas, (size.left - _GAP, baseline), label, size.text, share=1.0)
    for day, label in _list_dates(frame):
        x, baseline = frame.place_x(day.toordinal()), size.height - 0.2 * size.text
        if size is LARGE:
            canvas.outline("grid", _draw_line((x, 0), (x, frame.bottom)), Stroke(_GREY, 0.3), None)
        share = 0.5 if size is LARGE else float(day > frame.period.first)
        _write(canvas, (x, baseline), label, size.text, share=share)


def _list_dates(frame: _Frame) -> Iterator[tuple[date, str]]:
    """Yield the dates of the scale: of a small graph the ends of its period, of a large one each new year."""
    period = frame.period
    if frame.size is SMALL:
        yield period.first, period.first.strftime("%Y-%m")
        if period.last > period.first:
            yield period.last, period.last.strftime("%Y-%m")
        return
    years = [date(year, 1, 1) for year in range(period.first.year + 1, period.last.year + 2)]
    last = period.last.toordinal() + _AHEAD * period.days
    inside = [each for each in years if each.toordinal() <= last]
    yield from ((each, str(each.year)) for each in inside or [period.first])


def _write(canvas: SvgCanvas, place: tuple[float, float], text: str, size: float, *, share: float) -> None:
    """Write a text, the share of its width before a place: 0 begins there, 1 ends there."""
    x, y = place
    start = x - share * measure_advance(text, TypeFace.REGULAR) * size
    canvas.text("scale", [Run(text, TypeFace.REGULAR, size, start, y)], _GREY, 0.0)


def _draw_limit(canvas: SvgCanvas, frame: _Frame, limit: float) -> None:
    left, right = frame.size.left, frame.right
    for bound, edge in ((limit, 0.0), (-limit, frame.bottom)):
        y = frame.place_y(bound)
        if 0 <= y < frame.bottom:
            beyond = _draw_line((left, edge), (right, edge), (right, y), (left, y), closed=True)
            canvas.outline("beyond", beyond, None, Fill(_ALARM, 0.1))
            canvas.outline("limit", _draw_line((left, y), (right, y)), Stroke(_ALARM, 0.9, (6.0, 2.0)), None)


def _draw_band(canvas: SvgCanvas, frame: _Frame, calibrations: Sequence[Calibration]) -> None:
    upper, lower = [], []
    for each in calibrations:
        uncertainty = each.parameter.expanded_uncertainty
        if uncertainty is None:
            continue
        x = frame.place_x(each.measured.toordinal())
        upper.append((x, frame.place_y(each.parameter.value + uncertainty)))
        lower.append((x, frame.place_y(each.parameter.value - uncertainty)))
    if len(upper) == 1:
        half = _SINGLE * frame.size.point
        upper = [(upper[0][0] + step, upper[0][1]) for step in (-half, half)]
        lower = [(lower[0][0] + step, lower[0][1]) for step in (-half, half)]
    if upper:
        canvas.outline("band", _draw_line(*upper, *reversed(lower), closed=True), None, Fill(_INK, 0.18))


def _draw_steps(canvas: SvgCanvas, frame: _Frame, trend: Trend) -> None:
    """Draw an upright line before the first test after each step."""
    steps = trend.course.steps if trend.course else ()
    calibrations = trend.series.calibrations
    for index in sorted({each.index for each in (*steps, *([trend.step] if trend.step else ()))}):
        days = [calibrations[each].measured.toordinal() for each in (index - 1, index)]
        x = frame.place_x(sum(days) / 2)
        canvas.outline("step", _draw_line((x, 0), (x, frame.bottom)), Stroke(_ALARM, 0.9, (1.5, 1.5)), None)


def _draw_drift(canvas: SvgCanvas, frame: _Frame, trend: Trend) -> None:
    line, calibrations = trend.line, trend.series.calibrations
    if line is None:
        return
    first = calibrations[0].measured
    last = date.fromordinal(frame.period.last.toordinal() + round(frame.period.days * _AHEAD))
    ends = [(frame.place_x(day.toordinal()), frame.place_y(line.at(day))) for day in (first, last)]
    canvas.outline("drift", _draw_line(*ends), Stroke(_ALARM, 1.2, (5.0, 1.6, 1.2, 1.6)), None)


def _draw_values(canvas: SvgCanvas, frame: _Frame, calibrations: Sequence[Calibration]) -> None:
    places = [
        (frame.place_x(each.measured.toordinal()), frame.place_y(each.parameter.value))
        for each in calibrations
    ]
    if len(places) > 1:
        canvas.outline("course", _draw_line(*places), Stroke(_INK, 0.9), None)
    for each, (x, y) in zip(calibrations, places, strict=True):
        half = frame.size.point * (_LAST if each is calibrations[-1] else 1.0)
        if each.parameter.conforms is False:
            cross = (
                *_draw_line((x - half, y - half), (x + half, y + half)),
                *_draw_line((x - half, y + half), (x + half, y - half)),
            )
            canvas.outline("point not-met", cross, Stroke(_ALARM, 1.4), None)
        else:
            diamond = _draw_line((x - half, y), (x, y - half), (x + half, y), (x, y + half), closed=True)
            canvas.outline("point", diamond, None, Fill(_INK))


def _draw_line(*points: tuple[float, float], closed: bool = False) -> tuple[Segment, ...]:
    first, *others = points
    rest = tuple(("L", point) for point in others)
    return (("M", first), *rest, *((("Z", ()),) if closed else ()))
