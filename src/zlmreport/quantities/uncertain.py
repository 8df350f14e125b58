"""Values with their expanded uncertainties: rounded to what is known, and no further."""

from __future__ import annotations

from math import ceil, floor, isfinite, log10

from zlmreport.quantities.formatting import DecimalSign, fixed_number

_DIGITS = 2
#: Of a value that is given exactly, or whose uncertainty is unknown.
_DECIMALS = 3


#: An uncertainty that would lose more by rounding down is rounded up (EA-4/02 M:2022, 6.3).
_MOST_LOST = 0.05


def rounded_pair(
    value: float,
    expanded_uncertainty: float,
    sign: DecimalSign = DecimalSign.POINT,
) -> tuple[str, str]:
    """Write a value and its uncertainty: the uncertainty with two significant digits, the value as far.

    Parameters
    ----------
    value, expanded_uncertainty
        In the unit that is printed.
    sign
        Decimal sign.

    >>> rounded_pair(-4.01187, 0.1319), rounded_pair(12.3456, 0.0996), rounded_pair(5678.9, 432.1)
    (('−4.01', '0.13'), ('12.35', '0.10'), ('5680', '430'))
    """
    decimals = _DECIMALS
    if isfinite(expanded_uncertainty) and expanded_uncertainty > 0:
        decimals = _decimals(expanded_uncertainty)
        # 0.0996 is 0.10 with two digits: rounding may have made one digit more of it.
        decimals = _decimals(round(expanded_uncertainty, decimals))
    if not isfinite(expanded_uncertainty):
        return fixed_number(value, decimals, sign), "∞"
    return fixed_number(value, decimals, sign), fixed_number(
        _not_much_less(expanded_uncertainty, decimals), decimals, sign
    )


def _not_much_less(value: float, decimals: int) -> float:
    """Return an uncertainty that rounding to these decimals makes hardly smaller."""
    if round(value, decimals) < (1 - _MOST_LOST) * value:
        return ceil(value * 10.0**decimals) / 10.0**decimals
    return value


def _decimals(value: float) -> int:
    return _DIGITS - 1 - floor(log10(value))
