"""Which of the 21 errors, which circle or diagonal a file holds, by its name.

People call their files ``X straightness vertical.csv`` or ``ballbar_XY_R150_F1000_ccw.csv``. What is taken
from a name is a proposal, and what it leaves open is said.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from itertools import pairwise

from zlmreport.machines.kinematics import ERRORS, SQUARENESS
from zlmreport.machines.volume import DIAGONALS
from zlmreport.measurement.error_symbol import find_error_named

_POSITIONING, _STRAIGHTNESS, _PITCH, _YAW, _ROLL = "positioning", "straightness", "pitch", "yaw", "roll"
#: Words of file names by how they begin, English and German.
_WORDS = {
    "pos": _POSITIONING, "lin": _POSITIONING,
    "straight": _STRAIGHTNESS, "str": _STRAIGHTNESS, "gerad": _STRAIGHTNESS,
    "pitch": _PITCH, "nick": _PITCH,
    "yaw": _YAW, "gier": _YAW,
    "roll": _ROLL,
}  # fmt: skip
#: In which direction a carriage is off that runs straight but for that; the first where a name is silent.
_ACROSS = {"X": ("Y", "Z"), "Y": ("X", "Z"), "Z": ("X", "Y")}
#: About which direction a horizontal axis tilts, turns and rolls; Z has no pitch that all mean alike.
_TURNS = {
    _PITCH: {"X": "B", "Y": "A", "Z": "A"},
    _YAW: {"X": "C", "Y": "C", "Z": "B"},
    _ROLL: {"X": "A", "Y": "B", "Z": "C"},
}
#: What stands before the axis that moves, in names that have it behind: "x straightness of y".
_OF = {"OF", "VON", "DER"}
_PLANES = {"XY": "XY", "YX": "XY", "YZ": "YZ", "ZY": "YZ", "ZX": "ZX", "XZ": "ZX"}
_AXIS = re.compile(r"([XYZ])\d?(?:AXIS|ACHSE)?")
_ROTARY = re.compile(r"([ABC])\d?(?:AXIS|ACHSE)?")
_POSITION_WORDS = tuple(word for word, kind in _WORDS.items() if kind == _POSITIONING)
_NUMBER = r"(\d+(?:\.\d+)?)(?:MM)?"


@dataclass(frozen=True, slots=True)
class NamedError:
    """Which error a file holds, as its name says."""

    symbol: str  #: By ISO 230-1; empty where the name tells no axis.
    doubt: str  #: What the name leaves open, in words; empty where it says all.


@dataclass(frozen=True, slots=True)
class NamedCircle:
    """What the name of a file says of a circle; None for what it does not say. Lengths in mm."""

    plane: str | None
    radius: float | None
    feed: float | None  #: mm/min.


def find_error_by_name(name: str) -> NamedError:
    """Return which of the 21 errors a file holds, as its name says.

    >>> find_error_by_name("X straightness vertical").symbol, find_error_by_name("C0Y").doubt
    ('EZX', 'which line of C0Y it is: EYX or EXY')
    >>> find_error_by_name("x-straightness-y").symbol, find_error_by_name("x-straightness-of-y").symbol
    ('EYX', 'EXY')
    """
    parts = _split(name)
    stated = next((each for each in parts if each in ERRORS), None)
    if stated in SQUARENESS:
        one, other = find_error_named(stated).lines  # a file holds one of the lines that it follows from
        return NamedError(one, f"which line of {stated} it is: {one} or {other}")
    if stated:
        return NamedError(stated, "")
    axes = list(_list_axes(parts))
    if not axes:
        return NamedError("", "which axis moved, and which error was measured")
    axis = axes[0]
    kind = next(
        (kind for each in parts for word, kind in _WORDS.items() if each.startswith(word.upper())), ""
    )
    if kind == _STRAIGHTNESS:
        return _find_straightness(axis, axes[1:], parts)
    if kind in _TURNS:
        doubt = "about which axis it tilts: EAZ or EBZ" if axis == "Z" and kind != _ROLL else ""
        return NamedError(f"E{_TURNS[kind][axis]}{axis}", doubt)
    return NamedError(f"E{axis}{axis}", "")  # positioning is what a job measures that says nothing else


def _list_axes(parts: list[str]) -> list[str]:
    """Return the axes that a name has, the moving one first: the one that is said to be it, or the first."""
    found = [
        (before in _OF, of[1]) for before, each in pairwise(["", *parts]) if (of := _AXIS.fullmatch(each))
    ]
    return [axis for _, axis in sorted(found, key=lambda each: not each[0])]


def _find_straightness(axis: str, others: list[str], parts: list[str]) -> NamedError:
    first, second = _ACROSS[axis]
    if others and others[0] != axis:
        return NamedError(f"E{others[0]}{axis}", "")
    if any(each.startswith("VERT") for each in parts) and axis != "Z":
        return NamedError(f"EZ{axis}", "")
    if any(each.startswith("HOR") for each in parts) and axis != "Z":
        return NamedError(f"E{first}{axis}", "")
    return NamedError(f"E{first}{axis}", f"across which axis it is: E{first}{axis} or E{second}{axis}")


def find_rotary_axis_by_name(name: str) -> str:
    """Return of which rotary axis a file holds the positions, as its name says; empty for other files.

    >>> find_rotary_axis_by_name("C position"), find_rotary_axis_by_name("x-pitch C")
    ('C', '')
    """
    parts = _split(name)
    found = [each[1] for part in parts if (each := _ROTARY.fullmatch(part))]
    is_position = any(part.startswith(word.upper()) for part in parts for word in _POSITION_WORDS)
    return found[0] if len(found) == 1 and is_position and not any(map(_AXIS.fullmatch, parts)) else ""


def find_circle_by_name(name: str) -> NamedCircle:
    """Return what the name of a file says of a circle.

    >>> find_circle_by_name("ballbar_XY_R150_F1000_ccw")
    NamedCircle(plane='XY', radius=150.0, feed=1000.0)
    """
    parts = _split(name)
    plane = next((_PLANES[each] for each in parts if each in _PLANES), None)

    def number(letter: str) -> float | None:
        found = (re.fullmatch(letter + _NUMBER, each) for each in parts)
        return next((float(each[1]) for each in found if each), None)

    return NamedCircle(plane, number("R"), number("F"))


def find_diagonal_by_name(name: str) -> str:
    """Return which body diagonal a file holds, by the signs of its directions; empty for other files.

    >>> find_diagonal_by_name("diagonal ppp"), find_diagonal_by_name("x-pitch")
    ('PPP', '')
    """
    return next((each for each in _split(name) if each in DIAGONALS), "")


def _split(name: str) -> list[str]:
    return [each for each in re.split(r"[^A-Z0-9.]+", name.upper()) if each]
