"""What page and news of a fleet print alike: symbols and signs as standards print them, values, changes."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

from zlmreport.evaluation.evaluation import Quantity
from zlmreport.fleet.drifts import Trend
from zlmreport.fleet.records import RecordedParameter
from zlmreport.fleet.trend import Series
from zlmreport.language.formatting import (
    DecimalSign,
    round_pair,
    write_fixed_number,
    write_plain,
    write_stated_number,
)
from zlmreport.measurement.units import find_printed_symbol, with_unit
from zlmreport.plugin.protocols import Standard

#: Of a value without U.
_DECIMALS = 2


@dataclass(frozen=True, slots=True)
class Names:
    """The standards that are installed; of one that no longer is, the ledger's own words are printed."""

    standards: Sequence[Standard]

    def name_standard(self, standard: str) -> str:
        """Return a standard as printed: ``ISO 230-2:2014``."""
        found = self._find_standard(standard)
        return found.designation if found else standard

    def name_symbol(self, series: Series) -> str:
        """Return the symbol of a parameter as printed, in notation."""
        quantity = self._find_quantity(series)
        return quantity.notation if quantity else series.symbol

    def write_symbol(self, series: Series) -> str:
        """Return the same as a plain line."""
        return write_plain(self.name_symbol(series))

    def as_printed(self, trend: Trend) -> Trend:
        """Return a trend with the sign that the standard prints."""
        quantity = self._find_quantity(trend.series)
        if quantity is None or quantity.printed_sign > 0:
            return trend
        calibrations = tuple(
            replace(each, parameter=replace(each.parameter, value=-each.parameter.value))
            for each in trend.series.calibrations
        )
        line = trend.line and replace(trend.line, level=-trend.line.level, slope=-trend.line.slope)
        step = trend.step and replace(trend.step, change=-trend.step.change)
        return replace(trend, series=replace(trend.series, calibrations=calibrations), line=line, step=step)

    def _find_standard(self, identifier: str) -> Standard | None:
        return next((each for each in self.standards if each.identifier == identifier), None)

    def _find_quantity(self, series: Series) -> Quantity | None:
        found = self._find_standard(series.standard)
        quantities = found.quantities if found else ()
        return next((each for each in quantities if each.symbol == series.symbol), None)


def write_value(parameter: RecordedParameter, sign: DecimalSign) -> str:
    """Return a value with its U and unit, ``6.7 ± 1.8 µm``; alone where none is stated."""
    if parameter.expanded_uncertainty is None:
        text = write_fixed_number(parameter.value, _DECIMALS, sign)
    else:
        text = " ± ".join(round_pair(parameter.value, parameter.expanded_uncertainty, sign))
    return with_unit(text, find_printed_symbol(parameter.unit))


def write_limit(parameter: RecordedParameter, sign: DecimalSign) -> str:
    """Return the limit of a value with its unit; that of one without any is zero."""
    return with_unit(write_stated_number(parameter.limit or 0.0, sign), find_printed_symbol(parameter.unit))


def write_change(change: float, unit: str, sign: DecimalSign) -> str:
    """Return a change with its sign and unit: to one decimal, or as many as its first digit needs.

    >>> write_change(10.42, "um", DecimalSign.POINT), write_change(-0.034, "um", DecimalSign.POINT)
    ('+ 10.4 µm', '− 0.03 µm')
    """
    decimals = max(1, -math.floor(math.log10(abs(change)))) if change else 1
    number = write_fixed_number(abs(change), decimals, sign)
    return f"{'+' if change > 0 else '−'} {with_unit(number, find_printed_symbol(unit))}"
