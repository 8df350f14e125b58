"""Values with their expanded uncertainties: rounded to what is known, and no further."""

from __future__ import annotations

from math import floor, isfinite, log10

from zlmreport.quantities.formatting import DecimalSign, fixed_number

_DIGITS = 2
#: Of a value that is given exactly, or whose uncertainty is unknown.
_DECIMALS = 3


def rounded_pair(
    value: float, expanded_uncertainty: float, sign: DecimalSign = DecimalSign.POINT
) -> tuple[str, str]:
    """Write a value and its uncertainty: the uncertainty with two significant digits, the value as far.

    >>> rounded_pair(-4.01187, 0.1319), rounded_pair(12.3456, 0.0996), rounded_pair(5678.9, 432.1)
    (('−4.01', '0.13'), ('12.35', '0.10'), ('5679', '432'))
    """
    decimals = _DECIMALS
    if isfinite(expanded_uncertainty) and expanded_uncertainty > 0:
        decimals = _decimals(expanded_uncertainty)
        # 0.0996 is 0.10 with two digits: rounding may have made one digit more of it.
        decimals = max(0, _decimals(round(expanded_uncertainty, decimals)))
    if not isfinite(expanded_uncertainty):
        return fixed_number(value, decimals, sign), "∞"
    return fixed_number(value, decimals, sign), fixed_number(expanded_uncertainty, decimals, sign)


def _decimals(value: float) -> int:
    return _DIGITS - 1 - floor(log10(value))
