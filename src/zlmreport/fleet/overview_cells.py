"""Cells of the overview's tables: names, values with their uncertainty, limits, states, drifts, graphs."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from datetime import date
from pathlib import Path
from typing import TypeAlias
from urllib.parse import quote

from zlmreport.document.typesetting.overview import LinkContext, OverviewCellContext, make_drawing
from zlmreport.document.typesetting.templates import set_symbol
from zlmreport.fleet import overview_words as words
from zlmreport.fleet.causes import find_cause_of
from zlmreport.fleet.drifts import LEAST_DATES, Trend
from zlmreport.fleet.printing import Names, write_change, write_limit, write_value
from zlmreport.fleet.records import LedgerEntry
from zlmreport.fleet.trend import MOST_YEARS_AHEAD, Series
from zlmreport.fleet.trend_graph import Period, draw_trend
from zlmreport.language import Words
from zlmreport.language.formatting import round_pair, write_p_value
from zlmreport.language.writer import LanguageWriter
from zlmreport.measurement.error_symbol import find_error_named
from zlmreport.measurement.units import find_printed_symbol, with_unit

#: Machine, axis, standard and symbol.
TrendKey: TypeAlias = tuple[str, str, str, str]

#: Of numbers in the description of a graph.
_DECIMALS = 2
#: The test of a trend knows no tail beyond it.
_LEAST_P = 1e-4


@dataclass(frozen=True, slots=True)
class CellWriter(LanguageWriter):
    """Writes cells in one language."""

    names: Names  #: Of standards and symbols.
    period: Period  #: That all graphs show.
    files: str  #: Folder of the certificates, as seen from the page.
    #: Parameters of the error models over time, by machine and axis.
    effects: Mapping[tuple[str, str], Sequence[Series]]
    #: Of the trends that are shown in full.
    anchors: Mapping[TrendKey, str] = field(default_factory=dict)
    packed: Mapping[TrendKey, int] = field(default_factory=dict)  #: Numbers of those that the script unpacks.

    def write_parameter(self, trend: Trend) -> OverviewCellContext:
        """Return the symbol, with the standard below."""
        series = trend.series
        symbol, standard = self.names.name_symbol(series), self.names.name_standard(series.standard)
        return OverviewCellContext(set_symbol(symbol), style="parameter", note=standard)

    def write_value(self, trend: Trend) -> OverviewCellContext:
        """Return the latest value with its expanded uncertainty."""
        text = write_value(trend.series.latest, self.language.decimal_sign)
        return OverviewCellContext(text, style="number")

    def write_limit(self, trend: Trend) -> OverviewCellContext:
        """Return the limit."""
        latest = trend.series.latest
        if latest.limit is None:
            return OverviewCellContext("–", style="number")
        return OverviewCellContext(write_limit(latest, self.language.decimal_sign), style="number")

    def write_state(self, trend: Trend) -> OverviewCellContext:
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

    def write_course(self, trend: Trend) -> OverviewCellContext:
        """Return the small graph, which leads to the trend in full, or the place of one that is packed."""
        if number := self.packed.get(make_key_of(trend.series)):
            return OverviewCellContext(style="course", packed=str(number))
        alternative = self.describe_graph(trend)
        image = draw_trend(trend, self.period, alternative, self.language.decimal_sign)
        anchor = self.anchors.get(make_key_of(trend.series), "")
        return OverviewCellContext(
            drawing=make_drawing(image),
            style="course",
            address=f"#{anchor}" if anchor else "",
            title=alternative,
        )

    def write_drift(self, trend: Trend) -> OverviewCellContext:
        """Return the drift of a parameter that drifts, and else why none is stated."""
        series = trend.series
        dates = len({each.measured for each in series.calibrations})
        if trend.line is None:
            too_few = words.TOO_FEW.given(number=dates, least=LEAST_DATES)
            return self._write_quietly(too_few, self._say_visible_step(trend))
        if not trend.drifts:
            return self._write_quietly(words.STEADY, self._say_visible_step(trend))
        chance = words.CHANCE.given(
            p=write_p_value(trend.line.p_value, self.language.decimal_sign, least=_LEAST_P),
            number=len(series.calibrations),
        )
        slope, rises = trend.line.slope, trend.line.slope > 0
        pair = self._write_pair(
            slope, trend.line.expanded_slope_uncertainty, series.unit, "+" if rises else ""
        )
        said, style = words.PER_YEAR.given(change=pair), "state drifts" if rises else "state drifts falls"
        return OverviewCellContext(self.say(said), style=style, note=self.say(chance))

    def _say_visible_step(self, trend: Trend) -> str:
        """Say how large a step would have to be; nothing where that is not known, or not asked."""
        smallest = trend.smallest
        if smallest is None:
            return ""
        return self.say(words.VISIBLE.given(size=self._write_number(smallest, 1, trend.series.unit)))

    def write_change(self, trend: Trend) -> OverviewCellContext:
        """Return by how much a parameter changed, since when, and how likely that is a step."""
        step = trend.step
        if step is None:
            return OverviewCellContext(self.say(words.WILDER), style="state drifts")
        since = trend.series.calibrations[step.index].measured.isoformat()
        note = words.STEP_SINCE.given(since=since, percent=min(99, round(100 * step.probability)))
        style = "state drifts" if step.change > 0 else "state drifts falls"
        return OverviewCellContext(
            self._write_signed(step.change, trend.series.unit), style=style, note=self.say(note)
        )

    def write_what_came_with(self, trend: Trend) -> OverviewCellContext:
        """Return what else changed: a parameter of the error model, the instrument."""
        cause = find_cause_of(trend, self.effects.get(trend.series.axis_key, ()))
        if cause is None:
            return OverviewCellContext("–", style="quiet")
        effect = f"{cause.effect} {self._write_signed(cause.change, cause.unit)}" if cause.effect else ""
        instrument = words.INSTRUMENT.given(before=cause.before, after=cause.after) if cause.after else None
        note = self.say(instrument) if instrument else ""
        return OverviewCellContext(effect or ("" if note else "–"), note=note)

    def write_mean(self, value: float, expanded_uncertainty: float, unit: str) -> OverviewCellContext:
        """Return a mean of several machines, or a single value, with its uncertainty."""
        return OverviewCellContext(self._write_pair(value, expanded_uncertainty, unit), style="number")

    def _write_signed(self, value: float, unit: str) -> str:
        return write_change(value, unit, self.language.decimal_sign)

    def _write_number(self, value: float, decimals: int, unit: str) -> str:
        return with_unit(self.write_number(value, decimals), find_printed_symbol(unit))

    def _write_pair(self, value: float, expanded_uncertainty: float, unit: str, sign: str = "") -> str:
        number, stated = round_pair(value, expanded_uncertainty, self.language.decimal_sign)
        return with_unit(f"{sign}{number} ± {stated}", find_printed_symbol(unit))

    def _write_quietly(self, said: Words, note: str = "") -> OverviewCellContext:
        return OverviewCellContext(self.say(said), style="quiet", note=note)

    def write_day_reached(self, trend: Trend) -> OverviewCellContext:
        """Return when the limit is met."""
        line, last = trend.line, trend.series.calibrations[-1]
        if trend.was_beyond:
            return OverviewCellContext(self.say(words.EARLIER), style="due")
        if trend.forecast:
            bounds = {"earliest": _write_month(trend.forecast.earliest)}
            interval = words.NOT_BEFORE
            if trend.forecast.latest:
                bounds["latest"] = _write_month(trend.forecast.latest)
                interval = words.BETWEEN
            note = self.say(interval.given(**bounds))
            return OverviewCellContext(_write_month(trend.forecast.expected), style="due", note=note)
        if trend.series.latest.limit is None:
            return self._write_quietly(words.WITHOUT_LIMIT)
        if line is not None and line.slope * line.at(last.measured) < 0:
            return self._write_quietly(words.GETS_SMALLER)
        return self._write_quietly(words.FAR_AWAY.given(years=MOST_YEARS_AHEAD))

    def write_axis(self, trend: Trend) -> OverviewCellContext:
        """Return machine and axis."""
        return OverviewCellContext(trend.series.axis, note=self.name_machine(trend.series))

    def name_machine(self, series: Series) -> str:
        """Return the machine, or that it is not named."""
        return series.machine or self.say(words.NO_MACHINE)

    def write_quantity(self, trend: Trend) -> OverviewCellContext:
        """Return the axis; of an error that is not its positioning the symbol, with what it is."""
        axis = trend.series.axis
        try:
            found = find_error_named(axis)
        except ValueError:
            return OverviewCellContext(axis)
        return OverviewCellContext(axis, note=self.say(found.measurand.title))

    def write_in_brief(self, trend: Trend) -> OverviewCellContext:
        """Return the symbol and its standard on one line."""
        cell = self.write_parameter(trend)
        return replace(cell, style="parameter brief")

    def write_change_in_brief(self, trend: Trend) -> OverviewCellContext:
        """Return the change of a parameter that changed, and else its drift, without what stands below it."""
        cell = self.write_change(trend) if trend.step or trend.is_wilder else self.write_drift(trend)
        return replace(cell, note="")

    def write_day_measured(self, trend: Trend, due: date | None) -> OverviewCellContext:
        """Return when it was measured last, with the certificate behind it, and when it is due."""
        latest = trend.series.calibrations[-1]
        links = self.list_links(latest.entry)[:1]
        day = latest.measured.isoformat()
        shown = tuple(replace(each, text=day) for each in links)
        note = self.say(words.DUE_ON.given(due=due.isoformat())) if due else ""
        return OverviewCellContext("" if shown else day, style="date", note=note, links=shown)

    def write_latest(self, trend: Trend) -> OverviewCellContext:
        """Return the number and the date of the latest certificate, with links to its files."""
        entry = trend.series.calibrations[-1].entry
        return OverviewCellContext(entry.number, note=entry.measured, links=self.list_links(entry))

    def write_axis_of(self, entry: LedgerEntry) -> OverviewCellContext:
        """Return the axis, its machine and the number of a certificate, with links to its files."""
        note = f"{entry.machine or self.say(words.NO_MACHINE)}\n{entry.number}"
        return OverviewCellContext(entry.axis, note=note, links=self.list_links(entry))

    def write_issued(self, entry: LedgerEntry) -> OverviewCellContext:
        """Return the number and the axis of a certificate, with links to its files."""
        return OverviewCellContext(entry.number, note=entry.of_axis, links=self.list_links(entry))

    def list_links(self, entry: LedgerEntry) -> tuple[LinkContext, ...]:
        """Return a link to each file of a certificate, by the name of its format."""
        formats = [Path(file).suffix.removeprefix(".").upper() or file for file in entry.files]
        return tuple(
            LinkContext(text, f"{entry.number} {text}", quote((Path(self.files) / file).as_posix()))
            for text, file in zip(formats, entry.files, strict=True)
        )

    def join_symbols(self, trends: Iterable[Trend]) -> str:
        """Return the symbols of trends as a plain line."""
        return ", ".join(dict.fromkeys(self.names.write_symbol(each.series) for each in trends))

    def describe_graph(self, trend: Trend) -> str:
        """Return what a graph of a trend shows, in a sentence or two."""
        series = trend.series
        text = self.say(
            words.ALTERNATIVE.given(
                number=len(series.calibrations),
                symbol=self.names.write_symbol(series),
                first=series.calibrations[0].measured.isoformat(),
                last=series.calibrations[-1].measured.isoformat(),
                value=self._write_number(series.latest.value, _DECIMALS, series.unit),
            )
        )
        if series.latest.limit is not None:
            limit = self._write_number(series.latest.limit, _DECIMALS, series.unit)
            text += self.say(words.ALTERNATIVE_LIMIT.given(limit=limit))
        if trend.drifts and trend.line:
            change = self._write_number(trend.line.slope, _DECIMALS, series.unit)
            text += self.say(words.ALTERNATIVE_DRIFT.given(change=change))
        return text


def make_key_of(series: Series) -> TrendKey:
    """Return what tells a parameter of an axis from every other."""
    return series.machine, series.axis, series.standard, series.symbol


def _write_month(day: date) -> str:
    """Return year and month: a forecast knows no days."""
    return day.strftime("%Y-%m")
