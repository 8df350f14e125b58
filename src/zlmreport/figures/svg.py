"""A figure as an SVG image whose text stays text."""

from __future__ import annotations

import math
from collections.abc import Sequence
from html import escape

from zlmreport.figures.canvas import Colour, Face, Fill, Run, Segment, Stroke

_FONT = "'IBM Plex Sans', sans-serif"
_FACES = {
    Face.REGULAR: "",
    Face.ITALIC: ' font-style="italic"',
    Face.SEMIBOLD: ' font-weight="600"',
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
        self._parts = [f'<svg xmlns="http://www.w3.org/2000/svg" {size} {view} {role} font-family="{_FONT}">']

    def outline(
        self, kind: str, segments: Sequence[Segment], stroke: Stroke | None, fill: Fill | None
    ) -> None:
        """Add a path."""
        data = "".join(operator + " ".join(map(_number, points)) for operator, points in segments)
        inside = ' fill="none"'
        if fill is not None:
            inside = f' fill="{hexadecimal(fill.colour)}"'
            if fill.opacity < 1:
                inside += f' fill-opacity="{_number(fill.opacity)}"'
        line = ""
        if stroke is not None:
            line = f' stroke="{hexadecimal(stroke.colour)}" stroke-width="{_number(stroke.width)}"'
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
        self._parts.append(f'<text class="{escape(kind)}" fill="{hexadecimal(colour)}"{turn}>{spans}</text>')

    def image(self) -> str:
        """Return the image."""
        return "\n".join([*self._parts, "</svg>\n"])


def _number(value: float) -> str:
    text = f"{value:.3f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def hexadecimal(colour: Colour) -> str:
    """Return a colour as style sheets write it: ``#0063a6``."""
    return "#" + "".join(f"{round(255 * part):02x}" for part in colour)
