"""What was measured: a deviation over one coordinate, and what tells one kind of deviation from another.

Everything that holds for positions along a length only (compensation, expansion, a forecast) asks the
measurand, and is refused with its reason where it does not hold.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from enum import StrEnum
from types import MappingProxyType
from typing import Any

from zlmreport.language import Words
from zlmreport.measurement.units import (
    ANGLE_UNITS,
    ANGLES,
    ARCSECOND,
    DEGREE,
    HOUR,
    LENGTH_UNITS,
    MICROMETRE,
    MILLIMETRE,
    TIMES,
    Unit,
)


class Coordinate(StrEnum):
    """What a deviation is measured over."""

    LENGTH = "length"
    ANGLE = "angle"
    TIME = "time"

    @property
    def unit(self) -> Unit:
        """The unit in which it is read and printed."""
        return _UNITS[self]

    @property
    def units(self) -> Mapping[str, Unit]:
        """The units in which files may give it, by their spellings."""
        return _SPELLINGS[self]


_UNITS = {Coordinate.LENGTH: MILLIMETRE, Coordinate.ANGLE: DEGREE, Coordinate.TIME: HOUR}
_SPELLINGS = {Coordinate.LENGTH: LENGTH_UNITS, Coordinate.ANGLE: ANGLE_UNITS, Coordinate.TIME: TIMES}

_OF_AXIS = Words("{name} of axis {axis}")
_AXIS = Words("Axis {axis}")
_TARGET = Words("Target position")
_ACTUAL = Words("actual − target position")
_REVERSAL = Words("reversal value")
_SENSES = (Words("positive direction ↑"), Words("negative direction ↓"))


@dataclass(frozen=True, slots=True)
class Measurand:
    """A kind of deviation.

    Attributes
    ----------
    identifier
        As standards, effects and jobs name it: ``straightness``.
    title
        What a document on it is about, as it stands before ``of axis X``.
    definition
        What one reading is, in a sentence.
    unit
        In which deviations are read and printed.
    coordinate
        What the deviation is measured over.
    is_closed
        Whether the end of the coordinate is its beginning, as of a full circle.
    is_position
        Whether a deviation is actual − target of the coordinate itself: only then it can be compensated
        along the axis, and expands with it.
    sign
        When a deviation is positive; ``{letter}`` stands for the direction that the error's symbol names.
    reversal
        What the difference of both directions is called.
    joins_tests
        Whether it is evaluated from several measured lines and has no readings of its own.
    of_lines
        What each of the measured lines is a measurement of, where its error does not say; None for
        positioning.
    test_names
        What the measured lines must be called, where what is evaluated depends on it; empty for any names.
    contributors
        What its uncertainty has besides what that of every test has, by the keys of a job's ``uncertainty``:
        what is neither stated nor declared negligible is missing.
    subject
        What a document is about: ``{name}`` of what ``{axis}`` names.
    bearer
        What ``{axis}`` names, as headings begin: ``Axis X``.
    target
        What a value of the coordinate is called at which readings are taken.
    senses
        What the two senses of motion are called: of the `Approach` that is positive, and of the negative one.
    is_continuous
        Whether it is read while the machine moves, or over time, without targets at which an axis stops:
        documents then show curves and carry the values, and print no table of them.
    has_reference_body
        Whether it is measured against a body that has a form of its own, a mirror, a square or a
        straightedge: the instrument's error may then be a bend along the whole line.
    item
        What it is measured on, where that is usually no machine.
    """

    identifier: str
    title: Words
    definition: Words
    unit: Unit = MICROMETRE
    coordinate: Coordinate = Coordinate.LENGTH
    is_closed: bool = False
    is_position: bool = False
    sign: Words = _ACTUAL
    reversal: Words = _REVERSAL
    joins_tests: bool = False
    of_lines: Measurand | None = None
    test_names: tuple[str, ...] = ()
    contributors: tuple[str, ...] = ()
    subject: Words = _OF_AXIS
    bearer: Words = _AXIS
    target: Words = _TARGET
    senses: tuple[Words, Words] = _SENSES
    is_continuous: bool = False
    has_reference_body: bool = False
    item: Words | None = None

    @property
    def units(self) -> Mapping[str, Unit]:
        """The units in which deviations may be given, by their spellings."""
        return ANGLE_UNITS if self.unit in ANGLES else LENGTH_UNITS

    def named(self, axis: str, symbol: str | Words = "") -> Words:
        """Return what a document is about: ``Straightness EYX of axis X``."""
        name = Words("{name} {symbol}").given(name=self.title, symbol=symbol) if symbol else self.title
        return self.subject.given(name=name, axis=axis)

    def sign_of(self, letter: str) -> Words:
        """Return when a deviation is positive, for an error in the direction of an axis."""
        return self.sign.given(letter=letter)


#: How far an axis stands from where it was told to stand.
POSITIONING = Measurand(
    identifier="positioning",
    title=Words("Positioning accuracy"),
    definition=Words("the actual position minus the target position"),
    is_position=True,
)
#: The same of a rotary axis.
ROTARY_POSITIONING = Measurand(
    identifier=POSITIONING.identifier,
    title=POSITIONING.title,
    definition=POSITIONING.definition,
    unit=ARCSECOND,
    coordinate=Coordinate.ANGLE,
    is_position=True,
)
#: How far a motion strays across its direction.
STRAIGHTNESS = Measurand(
    identifier="straightness",
    title=Words("Straightness error"),
    definition=Words("the displacement perpendicular to the motion, in one of the two directions across it"),
    sign=Words("displacement across the motion, positive in the positive direction of {letter}"),
    has_reference_body=True,
)
#: How far a moving component turns: roll, pitch or yaw.
ANGLE = Measurand(
    identifier="angle",
    title=Words("Angular error"),
    definition=Words("the rotation of the moving component about one of the three directions"),
    unit=ARCSECOND,
    sign=Words("rotation about {letter}, positive in the positive sense of ISO 841 (right-hand rule)"),
)
#: How far two axes are from a right angle.
SQUARENESS = Measurand(
    identifier="squareness",
    title=Words("Squareness error"),
    definition=Words("the angle between the reference straight lines of two axes, minus 90°"),
    unit=ARCSECOND,
    sign=Words(
        "turn of axis {letter} against its reference axis from the right angle, positive by the "
        "right-hand rule (this program's reading of ISO 230-1)"
    ),
    joins_tests=True,
    contributors=("square",),
)

#: How far the path of a circle strays from its radius.
CIRCLE = Measurand(
    identifier="circle",
    title=Words("Circular accuracy"),
    definition=Words("the distance of the actual path from its centre minus the nominal radius"),
    coordinate=Coordinate.ANGLE,
    is_closed=True,
    sign=Words("actual − nominal radius, positive outwards"),
    subject=Words("{name} in the plane {axis}"),
    bearer=Words("Plane {axis}"),
    target=Words("Angle"),
    senses=(Words("counter-clockwise"), Words("clockwise")),
    is_continuous=True,
)

#: How far a point of a machine moves while it stands: what one sensor reads over time.
DISPLACEMENT = Measurand(
    identifier="displacement",
    title=Words("Displacement over time"),
    definition=Words(
        "the displacement of one point of the machine against another since the sensor was set to zero"
    ),
    coordinate=Coordinate.TIME,
    sign=Words("displacement since the sensor was set to zero, with the sign of its display"),
    subject=Words("{name}, sensor {axis}"),
    bearer=Words("Sensor {axis}"),
    target=Words("Time"),
    senses=(Words("as time goes on"), Words("back in time")),
    is_continuous=True,
)

#: What ISO 230-1's symbols name, by identifier.
OF_SYMBOLS: Mapping[str, Measurand] = MappingProxyType(
    {each.identifier: each for each in (POSITIONING, STRAIGHTNESS, ANGLE, SQUARENESS)}
)


def list_measurands_of(plugin: Any) -> tuple[Measurand, ...]:
    """Return what a standard evaluates or an effect describes: positioning where it does not say."""
    found: tuple[Measurand, ...] = getattr(plugin, "measurands", (POSITIONING,))
    return found


def is_for(plugin: Any, measurand: Measurand) -> bool:
    """Return whether a standard or an effect is for what was measured."""
    return measurand.identifier in {each.identifier for each in list_measurands_of(plugin)}


def list_identifiers(measurands: Iterable[Measurand]) -> str:
    """Return measurands by their identifiers, for messages."""
    return ", ".join(dict.fromkeys(each.identifier for each in measurands))
