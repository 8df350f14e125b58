"""The names of the eight lines of a union jack, and where they lie on a plate.

The corners and the middles of the edges are called by the points of the compass; a line is called by the
points at which it begins and ends, so that NW-SE is a diagonal from one corner to the other.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import TypeVar

from zlmreport.plugin import ARCSECOND, Measurand, Words

#: Of a plate whose sides are 1: towards the east, and towards the north.
PLACES: Mapping[str, tuple[float, float]] = {
    "NW": (0.0, 1.0),
    "N": (0.5, 1.0),
    "NE": (1.0, 1.0),
    "E": (1.0, 0.5),
    "SE": (1.0, 0.0),
    "S": (0.5, 0.0),
    "SW": (0.0, 0.0),
    "W": (0.0, 0.5),
}
DIAGONALS = ("NW-SE", "NE-SW")
#: The edges that run from west to east, and those that run from north to south.
ALONG, ACROSS = ("NW-NE", "SW-SE"), ("NW-SW", "NE-SE")
EDGES = (*ALONG, *ACROSS)
CENTRE_LINES = ("W-E", "N-S")
LINES = (*DIAGONALS, *EDGES, *CENTRE_LINES)

_Line = TypeVar("_Line")


def reverse_name(name: str) -> str:
    """Return what a line is called that is measured the other way.

    >>> reverse_name("NW-SE")
    'SE-NW'
    """
    first, last = name.split("-")
    return f"{last}-{first}"


def put_in_one_order(lines: Mapping[str, _Line]) -> dict[str, tuple[str, _Line]]:
    """Return the lines by the eight names, each with the name by which it was measured.

    A line that was measured both ways counts by its usual name.
    """
    return {
        name: (called, lines[called])
        for name in LINES
        for called in (reverse_name(name), name)
        if called in lines
    }


def list_lacking(lines: Iterable[str]) -> list[str]:
    """Return which of the eight lines are not among some."""
    there = set(lines)
    return [name for name in LINES if not {name, reverse_name(name)} & there]


#: Of one line: the slope of the surface under the carriage, and no height yet.
LINE = Measurand(
    identifier="plate-line",
    title=Words("Slope of a surface"),
    definition=Words("the inclination of the carriage that stands on the surface with two feet"),
    unit=ARCSECOND,
    sign=Words("positive where the foot in front stands higher than the one behind it"),
    subject=Words("{name} along the line {axis}"),
    bearer=Words("Line {axis}"),
    target=Words("Front foot at"),
)
#: Of all of them.
FLATNESS = Measurand(
    identifier="flatness",
    title=Words("Flatness deviation"),
    definition=Words("the heights of a surface above a plane, along eight lines"),
    sign=Words("heights, positive upwards"),
    joins_tests=True,
    of_lines=LINE,
    contributors=("foot_spacing",),
    test_names=tuple(called for name in LINES for called in (name, reverse_name(name))),
    subject=Words("{name}"),
    bearer=Words("Lines {axis}"),
    item=Words("surface plate"),
)
