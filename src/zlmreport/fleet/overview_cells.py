"""Cells of the overview's tables: names, values with their uncertainty, limits, states, drifts, small graphs.

Every line of a graph has a shape of its own, and a class by which a style sheet gives it its colour.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from datetime import date
from pathlib import Path
from urllib.parse import quote

from zlmreport.evaluation.evaluation import Quantity
from zlmreport.figures.canvas import Fill, Segment, Stroke, SvgCanvas
from zlmreport.fleet import overview_words as words
from zlmreport.fleet.causes import cause_of
from zlmreport.fleet.drifts import LEAST_DATES, Trend
from zlmreport.fleet.records import Entry
from zlmreport.fleet.trend import MOST_YEARS_AHEAD, Calibration, Series
from zlmreport.language import Language, Words
from zlmreport.plugin.protocols import Standard
from zlmreport.quantities.formatting import fixed_number, general_number, p_value, plain, rounded_pair
from zlmreport.quantities.units import printed_symbol, with_unit
from zlmreport.typesetting.overview import LinkContext, OverviewCellContext, drawing
from zlmreport.typesetting.templates import symbol


@dataclass(frozen=True, slots=True)
class Names:
    """The standards that are installed; of one that no longer is, the ledger's own words are printed."""

    standards: Sequence[Standard]

    def designation(self, standard: str) -> str:
        """Return a standard as printed: ``ISO 230-2:2014``."""
        found = self._standard(standard)
        return found.designation if found else standard

    def notation(self, standard: str, symbol: str) -> str:
        """Return a symbol as printed, in notation."""
        quantity = self._quantity(standard, symbol)
        return quantity.notation if quantity else symbol

    def as_printed(self, trend: Trend) -> Trend:
        """Return a trend with the sign that the standard prints."""
        quantity = self._quantity(trend.series.standard, trend.series.symbol)
        if quantity is None or quantity.printed_sign > 0:
            return trend
        calibrations = tuple(
            replace(each, parameter=replace(each.parameter, value=-each.parameter.value))
            for each in trend.series.calibrations
        )
        line = trend.line and replace(trend.line, level=-trend.line.level, slope=-trend.line.slope)
        step = trend.step and replace(trend.step, change=-trend.step.change)
        return replace(trend, series=replace(trend.series, calibrations=calibrations), line=line, step=step)

    def _standard(self, identifier: str) -> Standard | None:
        return next((each for each in self.standards if each.identifier == identifier), None)

    def _quantity(self, standard: str, symbol: str) -> Quantity | None:
        found = self._standard(standard)
        quantities = found.quantities if found else ()
        return next((each for each in quantities if each.symbol == symbol), None)


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

    `trend`: What is shown. With a limit the graph is as high as the limit, or the largest value.
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
    _draw_steps(canvas, frame, trend)
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


def _draw_steps(canvas: SvgCanvas, frame: _Frame, trend: Trend) -> None:
    """Draw an upright line before the first test after each step."""
    steps = trend.course.steps if trend.course else ()
    calibrations = trend.series.calibrations
    for index in sorted({each.index for each in (*steps, *([trend.step] if trend.step else ()))}):
        days = [calibrations[each].measured.toordinal() for each in (index - 1, index)]
        x = frame.x(sum(days) / 2)
        canvas.outline("step", _line((x, 0), (x, HEIGHT)), Stroke(_ALARM, 0.9, (1.5, 1.5)), None)


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


_DECIMALS = 2
#: The test of a trend knows no tail beyond it.
_LEAST_P = 1e-4


@dataclass(frozen=True, slots=True)
class Cells:
    """Writes cells in one language."""

    language: Language  #: Of the page.
    names: Names  #: Of standards and symbols.
    period: Period  #: That all graphs show.
    files: str  #: Folder of the certificates, as seen from the page.
    effects: Sequence[Series]  #: Parameters of the error models of all axes over time.

    def say(self, phrase: Words) -> str:
        """Return a phrase in the page's language."""
        return phrase.in_language(self.language)

    def parameter(self, trend: Trend) -> OverviewCellContext:
        """Return the symbol, with the standard below."""
        series = trend.series
        notation = self.names.notation(series.standard, series.symbol)
        return OverviewCellContext(
            symbol(notation), style="parameter", note=self.names.designation(series.standard)
        )

    def value(self, trend: Trend) -> OverviewCellContext:
        """Return the latest value with its expanded uncertainty."""
        latest = trend.series.latest
        if latest.expanded_uncertainty is None:
            return OverviewCellContext(self._number(latest.value, _DECIMALS, latest.unit), style="number")
        return self.mean(latest.value, latest.expanded_uncertainty, latest.unit)

    def limit(self, trend: Trend) -> OverviewCellContext:
        """Return the limit."""
        latest = trend.series.latest
        if latest.limit is None:
            return OverviewCellContext("–", style="number")
        text = with_unit(
            general_number(latest.limit, self.language.decimal_sign), printed_symbol(latest.unit)
        )
        return OverviewCellContext(text, style="number")

    def state(self, trend: Trend) -> OverviewCellContext:
        """Return whether the limit is met: a shape and a word."""
        latest = trend.series.latest
        if latest.limit is None:
            return OverviewCellContext(self.say(words.NO_LIMIT), style="state none")
        word, style = {
            True: (words.MET, "met"),
            False: (words.IS_NOT_MET, "not-met"),
            None: (words.IS_OPEN, "open"),
        }[latest.conforms]
        return OverviewCellContext(self.say(word), style=f"state {style}")

    def course(self, trend: Trend) -> OverviewCellContext:
        """Return the small graph."""
        image = small_graph(trend, self.period, self._alternative(trend))
        return OverviewCellContext(drawing=drawing(image), style="course")

    def drift(self, trend: Trend) -> OverviewCellContext:
        """Return the drift of a parameter that drifts, and else why none is stated."""
        series = trend.series
        dates = len({each.measured for each in series.calibrations})
        if trend.line is None:
            too_few = words.TOO_FEW.given(number=dates, least=LEAST_DATES)
            return self._quiet(too_few, self._visible(trend))
        if not trend.drifts:
            return self._quiet(words.STEADY, self._visible(trend))
        chance = words.CHANCE.given(
            p=p_value(trend.line.p_value, self.language.decimal_sign, least=_LEAST_P),
            number=len(series.calibrations),
        )
        slope, rises = trend.line.slope, trend.line.slope > 0
        pair = self._pair(slope, trend.line.expanded_slope_uncertainty, series.unit, "+" if rises else "")
        said, style = words.PER_YEAR.given(change=pair), "state drifts" if rises else "state drifts falls"
        return OverviewCellContext(self.say(said), style=style, note=self.say(chance))

    def _visible(self, trend: Trend) -> str:
        """Say how large a step would have to be; nothing where that is not known, or not asked."""
        if trend.smallest is None:
            return ""
        return self.say(words.VISIBLE.given(size=self._number(trend.smallest, 1, trend.series.unit)))

    def change(self, trend: Trend) -> OverviewCellContext:
        """Return by how much a parameter changed, since when, and how likely that is a step."""
        step = trend.step
        if step is None:
            return OverviewCellContext(self.say(words.WILDER), style="state drifts")
        since = trend.series.calibrations[step.index].measured.isoformat()
        note = words.STEP_SINCE.given(since=since, percent=min(99, round(100 * step.probability)))
        style = "state drifts" if step.change > 0 else "state drifts falls"
        return OverviewCellContext(
            self._signed(step.change, trend.series.unit), style=style, note=self.say(note)
        )

    def change_or_drift(self, trend: Trend) -> OverviewCellContext:
        """Return the change of a parameter that changed, and else its drift."""
        return self.change(trend) if trend.step or trend.is_wilder else self.drift(trend)

    def came_with(self, trend: Trend) -> OverviewCellContext:
        """Return what else changed: a parameter of the error model, the instrument."""
        cause = cause_of(trend, self.effects)
        if cause is None:
            return OverviewCellContext("–", style="quiet")
        effect = f"{cause.effect} {self._signed(cause.change, cause.unit)}" if cause.effect else ""
        instrument = words.INSTRUMENT.given(before=cause.before, after=cause.after) if cause.after else None
        note = self.say(instrument) if instrument else ""
        return OverviewCellContext(effect or ("" if note else "–"), note=note)

    def mean(self, value: float, expanded_uncertainty: float, unit: str) -> OverviewCellContext:
        """Return a mean of several machines, or a single value, with its uncertainty."""
        return OverviewCellContext(self._pair(value, expanded_uncertainty, unit), style="number")

    def _signed(self, value: float, unit: str) -> str:
        return f"{'+' if value > 0 else '−'} {self._number(abs(value), 1, unit)}"

    def _number(self, value: float, decimals: int, unit: str) -> str:
        return with_unit(fixed_number(value, decimals, self.language.decimal_sign), printed_symbol(unit))

    def _pair(self, value: float, expanded_uncertainty: float, unit: str, sign: str = "") -> str:
        number, stated = rounded_pair(value, expanded_uncertainty, self.language.decimal_sign)
        return with_unit(f"{sign}{number} ± {stated}", printed_symbol(unit))

    def _quiet(self, said: Words, note: str = "") -> OverviewCellContext:
        return OverviewCellContext(self.say(said), style="quiet", note=note)

    def reached(self, trend: Trend) -> OverviewCellContext:
        """Return when the limit is met."""
        line, last = trend.line, trend.series.calibrations[-1]
        if trend.forecast:
            bounds = {"earliest": _month(trend.forecast.earliest)}
            interval = words.NOT_BEFORE
            if trend.forecast.latest:
                bounds["latest"] = _month(trend.forecast.latest)
                interval = words.BETWEEN
            note = self.say(interval.given(**bounds))
            return OverviewCellContext(_month(trend.forecast.expected), style="due", note=note)
        if trend.series.latest.limit is None:
            return self._quiet(words.WITHOUT_LIMIT)
        if line is not None and line.slope * line.at(last.measured) < 0:
            return self._quiet(words.GETS_SMALLER)
        return self._quiet(words.FAR_AWAY.given(years=MOST_YEARS_AHEAD))

    def axis(self, trend: Trend) -> OverviewCellContext:
        """Return machine and axis."""
        series = trend.series
        return OverviewCellContext(series.axis, note=series.machine or self.say(words.NO_MACHINE))

    def latest(self, trend: Trend) -> OverviewCellContext:
        """Return the number and the date of the latest certificate, with links to its files."""
        entry = trend.series.calibrations[-1].entry
        return OverviewCellContext(entry.number, note=entry.measured, links=self.links(entry))

    def issued(self, entry: Entry) -> OverviewCellContext:
        """Return the number and the axis of a certificate, with links to its files."""
        return OverviewCellContext(entry.number, note=entry.of_axis, links=self.links(entry))

    def links(self, entry: Entry) -> tuple[LinkContext, ...]:
        """Return a link to each file of a certificate, by the name of its format."""
        formats = [Path(file).suffix.removeprefix(".").upper() or file for file in entry.files]
        return tuple(
            LinkContext(text, f"{entry.number} {text}", quote((Path(self.files) / file).as_posix()))
            for text, file in zip(formats, entry.files, strict=True)
        )

    def symbols(self, trends: Iterable[Trend]) -> str:
        """Return the symbols of trends as a plain line."""
        notations = [self.names.notation(each.series.standard, each.series.symbol) for each in trends]
        return ", ".join(dict.fromkeys(map(plain, notations)))

    def _alternative(self, trend: Trend) -> str:
        series = trend.series
        text = self.say(
            words.ALTERNATIVE.given(
                number=len(series.calibrations),
                symbol=plain(self.names.notation(series.standard, series.symbol)),
                first=series.calibrations[0].measured.isoformat(),
                last=series.calibrations[-1].measured.isoformat(),
                value=self._number(series.latest.value, _DECIMALS, series.unit),
            )
        )
        if series.latest.limit is not None:
            limit = self._number(series.latest.limit, _DECIMALS, series.unit)
            text += self.say(words.ALTERNATIVE_LIMIT.given(limit=limit))
        if trend.drifts and trend.line:
            change = self._number(trend.line.slope, _DECIMALS, series.unit)
            text += self.say(words.ALTERNATIVE_DRIFT.given(change=change))
        return text


def _month(day: date) -> str:
    """Return year and month: a forecast knows no days."""
    return day.strftime("%Y-%m")
