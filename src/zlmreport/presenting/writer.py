"""Writing words and values for one document: its language, its axis's units, its decimals."""

from __future__ import annotations

import datetime as dt
import math
from dataclasses import dataclass

import numpy as np

from zlmreport.language import Language, Words
from zlmreport.measurement.measurement_set import MeasurementSet
from zlmreport.presenting.marks import NO_MARKS, Marks
from zlmreport.quantities.arrays import FloatArray, decimals_of
from zlmreport.quantities.formatting import fixed_number, general_number
from zlmreport.quantities.units import CELSIUS, Scale, Unit

#: What stands in a table where a value does not exist.
NOTHING = "–"

_MOST_DECIMALS = 3
_MOST_TARGET_DECIMALS = 6
_DECIMALS_OF_CELSIUS, _DECIMALS_OF_CONDITIONS = 2, 1


@dataclass(frozen=True, slots=True)
class Writer:
    """Writes for one document.

    Attributes
    ----------
    language
        Of the document.
    position_unit, deviation_unit
        Of the axis: mm and µm, or ° and ″.
    position_decimals, deviation_decimals
        Decimals in which the readings were given. Results are printed to the same decimals, for more
        would claim more than was read.
    marks
        Which values are the customer's, or an external provider's.
    """

    language: Language
    position_unit: Unit
    deviation_unit: Unit
    position_decimals: int
    deviation_decimals: int
    marks: Marks = NO_MARKS

    @classmethod
    def of(cls, measurements: MeasurementSet, language: Language, marks: Marks = NO_MARKS) -> Writer:
        """Return the writer for a document on these measurements."""
        axis = measurements.axis
        return cls(
            language,
            axis.position_unit,
            axis.deviation_unit,
            decimals_of(axis.position_unit.from_si(measurements.target_positions), _MOST_TARGET_DECIMALS),
            decimals_of(axis.deviation_unit.from_si(measurements.deviation), _MOST_DECIMALS),
            marks,
        )

    def say(self, words: Words) -> str:
        """Return the words in the document's language."""
        return words.in_language(self.language)

    def deviation(self, value: float) -> str:
        """Write a deviation or a parameter (m or rad), without its unit."""
        if math.isnan(value):
            return NOTHING
        return fixed_number(
            self.deviation_unit.from_si(value), self.deviation_decimals, self.language.decimal_sign
        )

    def mean(self, value: float) -> str:
        """Write a mean or a standard deviation (m or rad): a mean of several says more than each of them."""
        if math.isnan(value):
            return NOTHING
        return fixed_number(
            self.deviation_unit.from_si(value), self.deviation_decimals + 1, self.language.decimal_sign
        )

    def position(self, value: float) -> str:
        """Write a position (m or rad), without its unit."""
        return fixed_number(
            self.position_unit.from_si(value), self.position_decimals, self.language.decimal_sign
        )

    def length(self, value: float) -> str:
        """Write a length or an angle along the axis with its unit and no needless digits."""
        number = general_number(self.position_unit.from_si(value), self.language.decimal_sign)
        return f"{number} {self.position_unit.symbol}"

    def number(self, value: float) -> str:
        """Write a number with no needless digits."""
        return general_number(value, self.language.decimal_sign)

    def date(self, value: dt.date) -> str:
        """Write a date as ISO 8601 does: alike in every language, and never mistaken."""
        return value.isoformat()

    def span(self, values: FloatArray, decimals: int) -> str:
        """Write the smallest and largest of logged values, or the one value that they share."""
        low, high = float(np.nanmin(values)), float(np.nanmax(values))
        first = fixed_number(low, decimals, self.language.decimal_sign)
        last = fixed_number(high, decimals, self.language.decimal_sign)
        return first if first == last else f"{first} … {last}"

    def condition_span(self, values: FloatArray, scale: Scale) -> str:
        """Write the range of a logged condition (SI) in the unit that is printed."""
        decimals = _DECIMALS_OF_CELSIUS if scale is CELSIUS else _DECIMALS_OF_CONDITIONS
        return f"{self.span(scale.from_si(values), decimals)} {scale.symbol}"
