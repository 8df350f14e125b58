"""What the symbols of the ledger are called on a page."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from zlmreport.evaluation.quantity import Quantity
from zlmreport.fleet.trend_fleet import Trend
from zlmreport.plugin.protocols import Standard
from zlmreport.quantities.units import printed_symbol

#: Units that stand at the number without a blank.
_TOUCHING = "°″"


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
        return replace(trend, series=replace(trend.series, calibrations=calibrations), line=line)

    def _standard(self, identifier: str) -> Standard | None:
        return next((each for each in self.standards if each.identifier == identifier), None)

    def _quantity(self, standard: str, symbol: str) -> Quantity | None:
        found = self._standard(standard)
        quantities = found.quantities if found else ()
        return next((each for each in quantities if each.symbol == symbol), None)


def with_unit(number: str, ascii_name: str) -> str:
    """Return a number with its unit as printed: ``4.2 ± 0.3 µm``, ``(4.2 ± 0.3)″``, ``20″``."""
    symbol = printed_symbol(ascii_name)
    if symbol not in _TOUCHING:
        return f"{number} {symbol}"
    return f"({number}){symbol}" if "±" in number else f"{number}{symbol}"
