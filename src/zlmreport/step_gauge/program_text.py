"""What probing programs share whatever the machine: coordinates and directions as text."""

from __future__ import annotations

import re

from zlmreport.quantities.units import MILLIMETRE
from zlmreport.step_gauge.path import Point

#: Digits after the decimal point of a unit vector: 10⁻⁷ rad is 0.1 µm over a metre.
_DIRECTION_DIGITS = 7
_LONGEST_NAME = 32
#: What no language takes for the end of a text or for a word of its own.
_NOT_PLAIN = re.compile(r"[^A-Za-z0-9 ._+-]")


def coordinates(point: Point, decimals: int) -> tuple[str, str, str]:
    """Write a point, m, in mm; zero has no sign.

    >>> coordinates((0.290865, -1e-9, 0.4), 3)
    ('290.865', '0.000', '400.000')
    """
    x, y, z = (_fixed(MILLIMETRE.from_si(at), decimals) for at in point)
    return x, y, z


def direction(vector: Point) -> tuple[str, str, str]:
    """Write a unit vector.

    >>> direction((0.0006, -0.99999982, 0.0))
    ('0.0006000', '-0.9999998', '0.0000000')
    """
    i, j, k = (_fixed(each, _DIRECTION_DIGITS) for each in vector)
    return i, j, k


def plain(text: str) -> str:
    """Return a user's text as every language takes it: short, ASCII, without quotes.

    >>> plain("CAL-2026's")
    'CAL-2026_s'
    """
    return _NOT_PLAIN.sub("_", text)[:_LONGEST_NAME]


def _fixed(value: float, decimals: int) -> str:
    return f"{round(value, decimals) + 0.0:.{decimals}f}"
