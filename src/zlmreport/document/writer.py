"""Writes values for one document: language, units of the axis, decimals, value with U, dates, marks.

Values and their uncertainties are rounded together, alike in every table.
"""

from __future__ import annotations

import datetime as dt
import math
from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from zlmreport.language import Language
from zlmreport.language.formatting import round_pair
from zlmreport.language.writer import LanguageWriter
from zlmreport.measurement.arrays import FloatArray, count_decimals_of
from zlmreport.measurement.measurement_set import MeasurementSet
from zlmreport.measurement.units import CELSIUS, Scale, Unit, with_unit

if TYPE_CHECKING:
    from zlmreport.evaluation.evaluation import EvaluatedParameter, Quantity
    from zlmreport.job.keys import JobKeys

#: Behind the name of what the customer supplied, and of what an external provider did.
BY_CUSTOMER = "†"
EXTERNAL = "‡"


@dataclass(frozen=True, slots=True)
class Marks:
    """Whose the values of a job are, where they are not the laboratory's own."""

    #: by_customer and external: Dotted job keys.
    by_customer: frozenset[str] = frozenset()
    external: frozenset[str] = frozenset()

    @classmethod
    def of(cls, keys: JobKeys) -> Marks:
        """Return the marks that a job asks for."""
        return cls(
            frozenset(keys.provided_by_customer),
            frozenset(key for each in keys.external for key in each.keys),
        )

    def write_after(self, *keys: str) -> str:
        """Return the marks behind the name of what comes from these keys: ``' †'``; empty for most.

        `keys`: Dotted. A group is marked if anything in it is somebody else's, and a key if its group is.
        """
        found = [
            mark
            for mark, named in ((BY_CUSTOMER, self.by_customer), (EXTERNAL, self.external))
            if any(_is_related(key, each) for key in keys for each in named)
        ]
        return f" {''.join(found)}" if found else ""


def _is_related(key: str, other: str) -> bool:
    """Whether two keys are one, or one of them is a group that the other is in."""
    return f"{key}.".startswith(f"{other}.") or f"{other}.".startswith(f"{key}.")


#: Of a document whose every value is the laboratory's own.
NO_MARKS = Marks()


#: What stands in a table where a value does not exist.
NOTHING = "–"

_MOST_DECIMALS = 3
#: Of a parameter in a unit that no reading has, where no uncertainty says how many it has.
_DECIMALS_OF_OTHER_UNITS = 2
_MOST_TARGET_DECIMALS = 6
_DECIMALS_OF_CELSIUS, _DECIMALS_OF_CONDITIONS = 2, 1


@dataclass(frozen=True, slots=True)
class Writer(LanguageWriter):
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

    position_unit: Unit
    deviation_unit: Unit
    position_decimals: int
    deviation_decimals: int
    marks: Marks = NO_MARKS

    @classmethod
    def of(cls, measurements: MeasurementSet, language: Language, marks: Marks = NO_MARKS) -> Writer:
        """Return the writer for a document on these measurements."""
        axis = measurements.axis
        of_readings = count_decimals_of(axis.deviation_unit.from_si(measurements.deviation), _MOST_DECIMALS)
        return cls(
            language,
            axis.position_unit,
            axis.deviation_unit,
            count_decimals_of(
                axis.position_unit.from_si(measurements.target_positions), _MOST_TARGET_DECIMALS
            ),
            _DECIMALS_OF_OTHER_UNITS if measurements.tests else of_readings,
            marks,
        )

    def of_quantity(self, quantity: Quantity) -> Writer:
        """Return the writer for the values of a quantity, which may have a unit of its own."""
        unit = quantity.unit_or(self.deviation_unit)
        if unit == self.deviation_unit:
            return self
        return replace(self, deviation_unit=unit, deviation_decimals=_DECIMALS_OF_OTHER_UNITS)

    def deviation(self, value: float) -> str:
        """Write a deviation or a parameter (m or rad), without its unit."""
        if math.isnan(value):
            return NOTHING
        return self.write_number(self.deviation_unit.from_si(value), self.deviation_decimals)

    def mean(self, value: float) -> str:
        """Write a mean or a standard deviation (m or rad): a mean of several says more than each of them."""
        if math.isnan(value):
            return NOTHING
        return self.write_number(self.deviation_unit.from_si(value), self.deviation_decimals + 1)

    def position(self, value: float) -> str:
        """Write a position (m or rad), without its unit."""
        return self.write_number(self.position_unit.from_si(value), self.position_decimals)

    def length(self, value: float) -> str:
        """Write a length or an angle along the axis with its unit, to its last stated digit."""
        return with_unit(self.number(self.position_unit.from_si(value)), self.position_unit.symbol)

    def number(self, value: float) -> str:
        """Write a number that is stated, to its last digit and with none added."""
        return self.write_stated(value)

    def date(self, value: dt.date) -> str:
        """Write a date as ISO 8601 does: alike in every language, and never mistaken."""
        return value.isoformat()

    def span(self, values: FloatArray, decimals: int) -> str:
        """Write the smallest and largest of logged values, or the one value that they share."""
        low, high = float(np.nanmin(values)), float(np.nanmax(values))
        first, last = self.write_number(low, decimals), self.write_number(high, decimals)
        return first if first == last else f"{first} … {last}"

    def condition_span(self, values: FloatArray, scale: Scale) -> str:
        """Write the range of a logged condition (SI) in the unit that is printed."""
        decimals = _DECIMALS_OF_CELSIUS if scale is CELSIUS else _DECIMALS_OF_CONDITIONS
        return f"{self.span(scale.from_si(values), decimals)} {scale.symbol}"


def is_mixed(parameters: Iterable[EvaluatedParameter], writer: Writer) -> bool:
    """Return whether parameters have units other than that of what was measured."""
    return any(each.quantity.unit_or(writer.deviation_unit) != writer.deviation_unit for each in parameters)


def add_unit(number: str, quantity: Quantity, writer: Writer) -> str:
    """Write the unit of a quantity behind a number, for columns without a unit; ``–`` has none."""
    return number if number == NOTHING else with_unit(number, quantity.unit_or(writer.deviation_unit).symbol)


#: An uncertainty that is none.
_NONE = "0"


def write_with_uncertainty(parameter: EvaluatedParameter, writer: Writer) -> tuple[str, str]:
    """Write a parameter and its U, without unit: rounded together to two significant digits of U.

    A value of which no uncertainty is known has the decimals of the readings (ILAC-P14:09/2020; EA-4/02
    M:2022).
    """
    expanded, writer = parameter.expanded_uncertainty, writer.of_quantity(parameter.quantity)
    if not expanded:
        return writer.deviation(parameter.printed_value), NOTHING if expanded is None else _NONE
    return write_rounded_together(parameter.printed_value, expanded, writer)


def write_uncertainty(expanded: float, writer: Writer) -> str:
    """Write an U (m or rad) by itself, without unit; NaN is nothing."""
    if math.isnan(expanded):
        return NOTHING
    return write_rounded_together(0.0, expanded, writer)[1] if expanded else _NONE


def write_rounded_together(value: float, expanded: float, writer: Writer) -> tuple[str, str]:
    """Write a value and an U that is not zero (m or rad), without unit, rounded together."""
    unit = writer.deviation_unit
    return round_pair(
        unit.from_si(value),
        unit.from_si(expanded),
        writer.language.decimal_sign,
    )
