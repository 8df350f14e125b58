"""Numbers by which instruments write that they have no reading: 9999.999, -999.25, 1E+30, 32767."""

from __future__ import annotations

import re
from collections.abc import Iterable

from zlmreport.language.formatting import DecimalSign
from zlmreport.measurement.text_file import parse_number

#: Nines and nothing else, but for zeros behind the decimal sign: four of them, or three and a minus.
_NINES = re.compile(r"[+-]?9{4,}(?:[.,]9*0*)?|[+-]?9{1,3}[.,](?:9+)0*|-999(?:[.,]0*)?")
_FEWEST_NINES = 4
#: What counters of 16 and 32 bits show that have run over.
_COUNTERS = frozenset({32767.0, -32767.0, -32768.0, 65535.0, 2147483647.0, -2147483648.0, 4294967295.0})
#: What the logs of bore holes, and loggers after them, have for nothing.
_OF_LOGS = frozenset({-999.25, -9999.25})
#: No quantity of a measurement is so large in any unit.
_HUGE = 1e12
#: How many times as large as any other number of its column such a number is.
_FAR = 3.0


def find_sentinels(cells: Iterable[str], sign: DecimalSign) -> frozenset[str]:
    """Return those cells of a column that stand for no reading: far from all others, and of such digits.

    `sign`: The decimal sign of the column.

    >>> sorted(find_sentinels(["1.2", "-0.8", "9999.999", "2.0"], DecimalSign.POINT))
    ['9999.999']
    >>> sorted(find_sentinels(["8888", "9999", "7777"], DecimalSign.POINT))
    []
    """
    numbers = {cell: number for cell in {*cells} if (number := _read(cell, sign)) is not None}
    suspects = {cell for cell, number in numbers.items() if _is_suspect(cell, number)}
    others = [abs(number) for cell, number in numbers.items() if cell not in suspects]
    if not others:  # a column without a single reading; a target may be 9999
        return frozenset(cell for cell in suspects if numbers[cell] < 0 or abs(numbers[cell]) >= _HUGE)
    return frozenset(cell for cell in suspects if abs(numbers[cell]) > _FAR * max(others))


def _read(cell: str, sign: DecimalSign) -> float | None:
    try:
        return parse_number(cell, sign)
    except ValueError:
        return None


def _is_suspect(cell: str, number: float) -> bool:
    is_nines = _NINES.fullmatch(cell.replace("−", "-")) is not None
    return (
        (is_nines and (cell.count("9") >= _FEWEST_NINES or number <= -999.0))
        or number in _COUNTERS
        or number in _OF_LOGS
        or abs(number) >= _HUGE
    )
