"""Telling decimal point and decimal comma apart."""

from __future__ import annotations

import re
from collections.abc import Sequence

from zlmreport.plugin import DecimalSign, InputError, Place, quoted
from zlmreport_plugins.sources.laser_csv.table import Table

_ONE_SIGN = re.compile(r"[+\-−]?([0-9]*)([.,])([0-9]*)([eE][+-]?[0-9]+)?")


def decimal_sign(table: Table, indices: Sequence[int]) -> DecimalSign:
    """Return the decimal sign in which the cells of some columns are written.

    ``12,5`` has a decimal comma; ``1,234`` may as well have a thousands separator. A point is taken for a
    decimal point wherever nothing speaks against it; a comma only where a cell proves it. Cells that are no
    numbers tell nothing.

    Raises
    ------
    InputError
        If the cells leave it open, or speak for both: the job must say it.
    """
    proof: dict[str, tuple[str, Place]] = {}
    doubt: dict[str, tuple[str, Place]] = {}
    for row in table.rows:
        for index in indices:
            match = _ONE_SIGN.fullmatch(row.cells[index])
            if match:
                whole, sign, decimals, exponent = match.groups()
                groups = 1 <= len(whole) <= 3 and whole[0] != "0" and len(decimals) == 3 and not exponent
                told = doubt if groups else proof
                if sign not in told:
                    told[sign] = (match[0], table.place(row, index))
    if len(proof) == 2:
        (point, point_place), (comma, comma_place) = proof["."], proof[","]
        later, earlier = sorted([point_place, comma_place], reverse=True)
        raise InputError.at(
            later,
            f"both decimal signs occur, {quoted(point)} and {quoted(comma)}, one here and one in line "
            f"{earlier.line}; correct the file, or say 'decimal: point' or 'decimal: comma' in the job",
        )
    if proof:
        return DecimalSign(next(iter(proof)))
    if DecimalSign.COMMA in doubt:
        text, place = doubt[DecimalSign.COMMA]
        raise InputError.at(
            place,
            f"{quoted(text)} may have a decimal comma or a thousands separator, and no other number tells; "
            "say 'decimal: comma' or 'decimal: point' in the job",
        )
    return DecimalSign.POINT
