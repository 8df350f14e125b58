"""What a figure is drawn on: outlines and lines of text, and nothing else.

A canvas measures in points, from its upper left corner, y downwards. Whoever writes a file format
implements `Canvas`.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum
from typing import Protocol, TypeAlias

#: Red, green, blue of sRGB, each from 0 to 1.
Colour: TypeAlias = tuple[float, float, float]

#: ``M`` move to, ``L`` line to, ``C`` cubic curve to (two control points, end point), ``Z`` close; then
#: the coordinates x, y, x, y, …
Segment: TypeAlias = tuple[str, tuple[float, ...]]


class Face(Enum):
    """A face of the bundled typeface; the value is the stem of its file."""

    REGULAR = "IBMPlexSans-Regular"
    ITALIC = "IBMPlexSans-Italic"
    SEMIBOLD = "IBMPlexSans-SemiBold"


@dataclass(frozen=True, slots=True)
class Stroke:
    """A line: its colour, its width, and the lengths of dashes and gaps (none: solid), in points."""

    colour: Colour
    width: float
    dashes: tuple[float, ...] = ()


@dataclass(frozen=True, slots=True)
class Fill:
    """The inside of an outline; opacity from 0 (clear) to 1."""

    colour: Colour
    opacity: float = 1.0


@dataclass(frozen=True, slots=True)
class Run:
    """A stretch of a line of text that is set alike.

    Attributes
    ----------
    text
        What is set; base letter and combining mark together.
    face, size
        The font and its size in points.
    x, y
        Where its baseline begins.
    """

    text: str
    face: Face
    size: float
    x: float
    y: float


@dataclass(frozen=True, slots=True)
class Label:
    """A line of text before it has a place.

    Attributes
    ----------
    runs
        Relative to the beginning of the label's baseline.
    width
        From there to its end.
    size
        Of its largest type.
    """

    runs: tuple[Run, ...]
    width: float
    size: float

    @property
    def rise(self) -> float:
        """How far below its middle the baseline lies: half the height of capitals."""
        return 0.35 * self.size

    @property
    def height(self) -> float:
        """The height that it takes: a letter with a bar above, a subscript below."""
        return 1.2 * self.size


class Canvas(Protocol):
    """A page, or a part of one, that takes what is drawn in the order in which it is drawn.

    `kind` says what is drawn, in words that a format may keep: ``curve mean_positive``, ``bracket``.
    """

    def outline(
        self, kind: str, segments: Sequence[Segment], stroke: Stroke | None, fill: Fill | None
    ) -> None:
        """Draw an outline that has a stroke, a fill or both; filled first, butt ends, mitred corners."""

    def text(self, kind: str, runs: Sequence[Run], colour: Colour, angle: float) -> None:
        """Set one line of text.

        Parameters
        ----------
        kind
            What it belongs to.
        runs
            In reading order, each at its place.
        colour
            Of all of them.
        angle
            Degrees, anticlockwise, about the beginning of each run.
        """
