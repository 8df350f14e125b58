"""What a figure is drawn on: strokes, fills, labels, faces of type; its SVG, in which text stays text."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum
from html import escape
from typing import Protocol, TypeAlias

#: Red, green, blue of sRGB, each from 0 to 1.
Colour: TypeAlias = tuple[float, float, float]

#: ``M`` move to, ``L`` line to, ``C`` cubic curve to (two control points, end point), ``Z`` close; then
#: the coordinates x, y, x, y, …
Segment: TypeAlias = tuple[str, tuple[float, ...]]

#: The family of the bundled typeface, as style sheets know it.
FAMILY = "IBM Plex Sans"


class TypeFace(Enum):
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
    face: TypeFace
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


_FACES = {
    TypeFace.REGULAR: "",
    TypeFace.ITALIC: ' font-style="italic"',
    TypeFace.SEMIBOLD: ' font-weight="600"',
}


class SvgCanvas:
    """A canvas that becomes the text of an SVG image; nothing in it depends on the clock or on chance.

    Parameters
    ----------
    width, height
        In points.
    title
        What the image shows, for those who cannot see it.
    """

    def __init__(self, width: float, height: float, title: str) -> None:
        size = f'width="{_number(width)}pt" height="{_number(height)}pt"'
        view = f'viewBox="0 0 {_number(width)} {_number(height)}"'
        role = f'role="img" aria-label="{escape(title)}"'
        font = f"font-family=\"'{FAMILY}', sans-serif\""
        self._parts = [f'<svg xmlns="http://www.w3.org/2000/svg" {size} {view} {role} {font}>']

    def outline(
        self, kind: str, segments: Sequence[Segment], stroke: Stroke | None, fill: Fill | None
    ) -> None:
        """Add a path."""
        data = "".join(operator + " ".join(map(_number, points)) for operator, points in segments)
        inside = ' fill="none"'
        if fill is not None:
            inside = f' fill="{write_hexadecimal(fill.colour)}"'
            if fill.opacity < 1:
                inside += f' fill-opacity="{_number(fill.opacity)}"'
        line = ""
        if stroke is not None:
            line = f' stroke="{write_hexadecimal(stroke.colour)}" stroke-width="{_number(stroke.width)}"'
            if stroke.dashes:
                line += f' stroke-dasharray="{" ".join(map(_number, stroke.dashes))}"'
        self._parts.append(f'<path class="{escape(kind)}" d="{data}"{inside}{line}/>')

    def text(self, kind: str, runs: Sequence[Run], colour: Colour, angle: float) -> None:
        """Add a line of text."""
        # Places are told in the turned system of coordinates, so that all runs share one turn.
        cosine, sine = math.cos(math.radians(angle)), math.sin(math.radians(angle))
        spans = ""
        for run in runs:
            x, y = run.x * cosine - run.y * sine, run.x * sine + run.y * cosine
            place = f'x="{_number(x)}" y="{_number(y)}" font-size="{_number(run.size)}"{_FACES[run.face]}'
            spans += f"<tspan {place}>{escape(run.text, quote=False)}</tspan>"
        turn = f' transform="rotate({_number(-angle)})"' if angle else ""
        self._parts.append(
            f'<text class="{escape(kind)}" fill="{write_hexadecimal(colour)}"{turn}>{spans}</text>'
        )

    def image(self) -> str:
        """Return the image."""
        return "\n".join([*self._parts, "</svg>\n"])


def _number(value: float) -> str:
    text = f"{value:.3f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def write_hexadecimal(colour: Colour) -> str:
    """Return a colour as style sheets write it: ``#0063a6``."""
    return "#" + "".join(f"{round(255 * part):02x}" for part in colour)
