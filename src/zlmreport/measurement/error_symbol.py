"""The symbols of ISO 230-1 for the errors of an axis, and those of VDI/VDE 2617 part 3.

``E``, the letter of the error, that of the moving axis: ``EYX`` is the displacement along Y of a motion along
X. With ``0`` in the middle the error is one number between two axes: ``C0Y`` is the squareness of Y to X.
The symbols of ISO 230-1 are published (a control's parameter list takes them from it); those of VDI/VDE 2617
part 3 are this program's reading.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeVar

from zlmreport.errors import did_you_mean, quoted
from zlmreport.measurement.measurand import (
    ANGLE,
    POSITIONING,
    ROTARY_POSITIONING,
    SQUARENESS,
    STRAIGHTNESS,
    Measurand,
    list_measurands_of,
)

LINEAR_AXES = "XYZUVW"
ROTARY_AXES = "ABC"
#: The direction about which each rotation turns.
TURNS_ABOUT = dict(zip(ROTARY_AXES, "XYZ", strict=True))
#: Axes parallel to X, Y and Z.
_DIRECTIONS = dict(zip(LINEAR_AXES, "XYZXYZ", strict=True))
_ROTATIONS = {direction: rotation for rotation, direction in TURNS_ABOUT.items()}


@dataclass(frozen=True, slots=True)
class ErrorSymbol:
    """An error of an axis, or of one axis against another."""

    symbol: str  #: As ISO 230-1 writes it: ``EYX``.
    letter: str  #: The direction of the error, or the rotation: ``Y``, ``C``.
    axis: str  #: The letter of the moving axis.
    measurand: Measurand
    reference: str = ""  #: Of a location, the letter of the axis that it is held against; else empty.

    @property
    def lines(self) -> tuple[str, ...]:
        """Of a squareness error, the straightness errors that it follows from; of any other none."""
        if not self.reference:
            return ()
        return f"E{self.axis}{self.reference}", f"E{self.reference}{self.axis}"

    @property
    def vdi(self) -> str:
        """The symbol of VDI/VDE 2617 part 3: axis of motion, kind, direction."""
        if self.reference:
            return f"{self.reference}w{self.axis}".lower()
        kinds = {STRAIGHTNESS.identifier: "t", ANGLE.identifier: "r", POSITIONING.identifier: "p"}
        letter = self.letter if self.measurand.is_position else TURNS_ABOUT.get(self.letter, self.letter)
        return f"{self.axis}{kinds[self.measurand.identifier]}{letter}".lower()


def find_error_named(text: str) -> ErrorSymbol:
    """Return the error of a symbol; raise `ValueError` for one that names none that is measured.

    >>> find_error_named("eyx").measurand.identifier, find_error_named("C0Y").reference
    ('straightness', 'X')
    """
    symbol = text.strip().upper().replace("O", "0")
    found = _KNOWN.get(symbol)
    if found is None:
        near = did_you_mean(symbol[:10], list(_KNOWN))
        raise ValueError(
            f"{quoted(text)} is no error of ISO 230-1 that is measured: E, its letter and that of the moving "
            f"axis, such as EYX, or C0Y for the squareness of Y to X; {near}"
        )
    return found


_Standard = TypeVar("_Standard")


def evaluate_for_error(standard: _Standard, stated: str) -> _Standard:
    """Return a standard as it evaluates an error; as it is, if it does not tell errors apart.

    `stated`: The symbol of the error, or one of the standard's measurands by its identifier; empty for none.
    """
    of_error: Callable[[ErrorSymbol | Measurand], _Standard] | None = getattr(standard, "of_error", None)
    own = {each.identifier: each for each in list_measurands_of(standard)}
    if of_error is None or not stated:
        return standard
    try:
        return of_error(own.get(stated) or find_error_named(stated))
    except ValueError:  # a job's mistake, which is told where the job is checked
        return standard


def find_symbol_of_positioning(axis: str) -> str:
    """Return the symbol of positioning of an axis, ``EXX``; empty where no letter begins its name."""
    letter = find_letter_of(axis)
    return f"E{letter}{letter}" if letter else ""


def find_letter_of(axis: str) -> str:
    """Return the letter of an axis by its name, ``X`` for ``x1``; empty for a name that has none."""
    letter = axis.strip()[:1].upper()
    return letter if letter and letter in LINEAR_AXES + ROTARY_AXES else ""


def _list_known() -> dict[str, ErrorSymbol]:
    """Return every error of a linear axis, the positioning of rotary ones, and the squareness of two axes."""
    found = []
    for axis in LINEAR_AXES:
        for letter in "XYZ":
            along = _DIRECTIONS[axis] == letter
            found.append((axis if along else letter, axis, POSITIONING if along else STRAIGHTNESS))
        found.extend((letter, axis, ANGLE) for letter in ROTARY_AXES)
    found.extend((axis, axis, ROTARY_POSITIONING) for axis in ROTARY_AXES)
    symbols = {
        f"E{letter}{axis}": ErrorSymbol(f"E{letter}{axis}", letter, axis, measurand)
        for letter, axis, measurand in found
    }
    for axis, reference in (("Y", "X"), ("Z", "X"), ("Z", "Y")):
        (across,) = set("XYZ") - {axis, reference}
        symbol = f"{_ROTATIONS[across]}0{axis}"
        symbols[symbol] = ErrorSymbol(symbol, _ROTATIONS[across], axis, SQUARENESS, reference)
    return symbols


_KNOWN = _list_known()
