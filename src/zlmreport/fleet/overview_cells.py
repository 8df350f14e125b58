"""Cells of the overview's tables: values with their uncertainty, limits, states, drifts."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from datetime import date
from pathlib import Path
from urllib.parse import quote

from zlmreport.fleet import overview_words as words
from zlmreport.fleet.overview_graph import Period, small_graph
from zlmreport.fleet.overview_names import Names, with_unit
from zlmreport.fleet.records import Entry, RecordedParameter
from zlmreport.fleet.trend_fleet import LEAST_DATES, Trend
from zlmreport.fleet.trend_line import MOST_YEARS_AHEAD, Line
from zlmreport.language import Language, Words
from zlmreport.quantities.formatting import fixed_number, general_number, p_value
from zlmreport.quantities.notation import plain
from zlmreport.quantities.uncertain import rounded_pair
from zlmreport.typesetting.overview import LinkContext, OverviewCellContext, drawing
from zlmreport.typesetting.templates import symbol

_DECIMALS = 2
#: The test of a trend knows no tail beyond it.
_LEAST_P = 1e-4


@dataclass(frozen=True, slots=True)
class Cells:
    """Writes cells in one language.

    Attributes
    ----------
    language
        Of the page.
    names
        Of standards and symbols.
    period
        That all graphs show.
    files
        Folder of the certificates, as seen from the page.
    """

    language: Language
    names: Names
    period: Period
    files: str

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
        return OverviewCellContext(self._value_text(latest), style="number")

    def limit(self, trend: Trend) -> OverviewCellContext:
        """Return the limit."""
        latest = trend.series.latest
        if latest.limit is None:
            return OverviewCellContext("–", style="number")
        text = with_unit(general_number(latest.limit, self.language.decimal_sign), latest.unit)
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
            return OverviewCellContext(self.say(too_few), style="quiet")
        if not trend.drifts:
            return OverviewCellContext(self.say(words.STEADY), style="quiet")
        chance = words.CHANCE.given(
            p=p_value(trend.line.p_value, self.language.decimal_sign, least=_LEAST_P),
            number=len(series.calibrations),
        )
        return OverviewCellContext(
            self.say(self._change(trend.line, series.unit)),
            style="state drifts" if trend.line.slope > 0 else "state drifts falls",
            note=self.say(chance),
        )

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
            return OverviewCellContext(self.say(words.WITHOUT_LIMIT), style="quiet")
        if line is not None and line.slope * line.at(last.measured) < 0:
            return OverviewCellContext(self.say(words.GETS_SMALLER), style="quiet")
        far_away = words.FAR_AWAY.given(years=MOST_YEARS_AHEAD)
        return OverviewCellContext(self.say(far_away), style="quiet")

    def axis(self, trend: Trend) -> OverviewCellContext:
        """Return machine and axis."""
        series = trend.series
        return OverviewCellContext(series.axis, note=series.machine or self.say(words.NO_MACHINE))

    def certificate(self, entry: Entry) -> OverviewCellContext:
        """Return a certificate's number, with links to its files."""
        return OverviewCellContext(entry.number, note=entry.measured, links=self.links(entry))

    def links(self, entry: Entry) -> tuple[LinkContext, ...]:
        """Return a link to each file of a certificate, by the name of its format."""
        formats = [Path(file).suffix.removeprefix(".").upper() or file for file in entry.files]
        return tuple(
            LinkContext(text, f"{entry.number} {text}", self._address(file))
            for text, file in zip(formats, entry.files, strict=True)
        )

    def symbols(self, trends: Iterable[Trend]) -> str:
        """Return the symbols of trends as a plain line."""
        notations = [self.names.notation(each.series.standard, each.series.symbol) for each in trends]
        return ", ".join(dict.fromkeys(map(plain, notations)))

    def _address(self, file: str) -> str:
        return quote((Path(self.files) / file).as_posix())

    def _value_text(self, parameter: RecordedParameter) -> str:
        sign, uncertainty = self.language.decimal_sign, parameter.expanded_uncertainty
        if uncertainty is None:
            return with_unit(fixed_number(parameter.value, _DECIMALS, sign), parameter.unit)
        value, stated = rounded_pair(parameter.value, uncertainty, sign, _DECIMALS)
        return with_unit(f"{value} ± {stated}", parameter.unit)

    def _change(self, line: Line, unit: str) -> Words:
        change, uncertainty = rounded_pair(
            line.slope, line.expanded_slope_uncertainty, self.language.decimal_sign, _DECIMALS
        )
        rising = "+" if line.slope > 0 else ""
        return words.PER_YEAR.given(change=with_unit(f"{rising}{change} ± {uncertainty}", unit))

    def _alternative(self, trend: Trend) -> str:
        series = trend.series
        sign = self.language.decimal_sign

        def written(value: float) -> str:
            return with_unit(fixed_number(value, _DECIMALS, sign), series.unit)

        text = self.say(
            words.ALTERNATIVE.given(
                number=len(series.calibrations),
                symbol=plain(self.names.notation(series.standard, series.symbol)),
                first=series.calibrations[0].measured.isoformat(),
                last=series.calibrations[-1].measured.isoformat(),
                value=written(series.latest.value),
            )
        )
        if series.latest.limit is not None:
            text += self.say(words.ALTERNATIVE_LIMIT.given(limit=written(series.latest.limit)))
        if trend.drifts and trend.line:
            text += self.say(words.ALTERNATIVE_DRIFT.given(change=written(trend.line.slope)))
        return text


def _month(day: date) -> str:
    """Return year and month: a forecast knows no days."""
    return day.strftime("%Y-%m")
