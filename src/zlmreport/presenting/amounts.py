"""Values and their uncertainties, rounded together: alike in every table of a document."""

from __future__ import annotations

import math

from zlmreport.evaluation.evaluation import Parameter
from zlmreport.presenting.writer import NOTHING, Writer
from zlmreport.quantities.formatting import rounded_pair

#: An uncertainty that is none.
_NONE = "0"


def written(parameter: Parameter, writer: Writer) -> tuple[str, str]:
    """Write a parameter and its U, without unit: rounded together to two significant digits of U.

    A value of which no uncertainty is known has the decimals of the readings (ILAC-P14:09/2020; EA-4/02
    M:2022).
    """
    expanded = parameter.expanded_uncertainty
    if not expanded:
        return writer.deviation(parameter.printed_value), NOTHING if expanded is None else _NONE
    return with_uncertainty(parameter.printed_value, expanded, writer)


def written_uncertainty(expanded: float, writer: Writer) -> str:
    """Write an U (m or rad) by itself, without unit; NaN is nothing."""
    if math.isnan(expanded):
        return NOTHING
    return with_uncertainty(0.0, expanded, writer)[1] if expanded else _NONE


def with_uncertainty(value: float, expanded: float, writer: Writer) -> tuple[str, str]:
    """Write a value and an U that is not zero (m or rad), without unit, rounded together."""
    unit = writer.deviation_unit
    return rounded_pair(
        unit.from_si(value),
        unit.from_si(expanded),
        writer.language.decimal_sign,
    )
