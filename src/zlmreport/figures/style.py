"""How each role looks: told apart by line and mark before colour.

The colours are those of Okabe and Ito, which people of all kinds of colour vision tell apart; since many
certificates are printed or copied in black and white, no two roles share both line and mark.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import Enum

from zlmreport.figures.canvas import Colour, Fill, Stroke
from zlmreport.figures.figure import Role
from zlmreport.measurement.approach import Approach

_BLACK = (0.0, 0.0, 0.0)
_BLUE = (0.0, 0.39, 0.65)
_VERMILION = (0.8, 0.33, 0.0)
_GREEN = (0.0, 0.45, 0.335)
_VIOLET = (0.45, 0.22, 0.62)
_GREY = (0.4, 0.4, 0.4)

#: Colour of axes and letters.
INK: Colour = (0.1, 0.1, 0.1)
WHITE: Colour = (1.0, 1.0, 1.0)


class Mark(Enum):
    """The shape of a point."""

    UP = "triangle, up"
    DOWN = "triangle, down"
    DISC = "disc"


@dataclass(frozen=True, slots=True)
class RoleStyle:
    """The look of a curve or a band.

    Attributes
    ----------
    stroke
        Of the curve, or of both limits of a band.
    mark
        At each target; None for a bare line.
    tint
        Of a band's inside.
    """

    stroke: Stroke
    mark: Mark | None
    tint: Fill


def _style(
    colour: Colour, width: float, dashes: tuple[float, ...], mark: Mark | None, tint: float
) -> RoleStyle:
    return RoleStyle(Stroke(colour, width, dashes), mark, Fill(colour, tint))


#: How a curve of each role is drawn.
ROLES = {
    Role.MEAN_POSITIVE: _style(_BLUE, 1.1, (), Mark.UP, 0.11),
    Role.MEAN_NEGATIVE: _style(_VERMILION, 1.1, (5.0, 1.6), Mark.DOWN, 0.11),
    Role.MEAN_BIDIRECTIONAL: _style(_BLACK, 1.1, (8.0, 1.6, 1.6, 1.6), Mark.DISC, 0.11),
    Role.LIMIT_POSITIVE: _style(_BLUE, 0.7, (2.6, 1.4), None, 0.12),
    Role.LIMIT_NEGATIVE: _style(_VERMILION, 0.7, (0.9, 1.3), None, 0.12),
    Role.SPREAD: _style(_GREEN, 0.7, (), None, 0.12),
    Role.REVERSAL: _style(_VIOLET, 0.7, (4.0, 1.3, 0.9, 1.3), None, 0.14),
    Role.BAND_LIMIT: _style(_BLACK, 0.8, (9.0, 2.4), None, 0.06),
    Role.TOLERANCE: _style(_BLACK, 0.9, (9.0, 1.6, 1.4, 1.6, 1.4, 1.6), None, 0.06),
    Role.MODEL_POSITIVE: _style(_BLUE, 1.1, (14.0, 1.2), None, 0.11),
    Role.MODEL_NEGATIVE: _style(_VERMILION, 1.1, (4.4, 1.5), None, 0.11),
    Role.UNCERTAINTY_POSITIVE: _style(_BLUE, 0.6, (1.8, 1.0), None, 0.14),
    Role.UNCERTAINTY_NEGATIVE: _style(_VERMILION, 0.6, (0.7, 0.9), None, 0.14),
    Role.NOISE: _style(_BLACK, 0.7, (3.2, 1.8), None, 0.07),
    Role.PATH: _style(_GREY, 0.5, (24.0, 0.8), None, 0.06),
}
#: Of a triangle of height 1 with three equal sides.
TRIANGLE_HALF_WIDTH = 0.5 / math.cos(math.pi / 6)
MARK_SIZES = {Mark.UP: 4.6, Mark.DOWN: 4.6, Mark.DISC: 3.8}
#: Parts a mark from the line that it sits on.
RIM = Stroke(WHITE, 0.5)

READINGS = {
    Approach.POSITIVE: (Mark.UP, Stroke((0.35, 0.6, 0.76), 0.45)),
    Approach.NEGATIVE: (Mark.DOWN, Stroke((0.88, 0.56, 0.34), 0.45)),
}

#: A bar: its outline and its inside.
BAR = (Stroke(_BLUE, 0.8), Fill(_BLUE, 0.2))

FRAME = Stroke(INK, 0.6)
TICK = Stroke(INK, 0.5)
GRID = Stroke((0.9, 0.9, 0.9), 0.4)
ZERO = Stroke((0.45, 0.45, 0.45), 0.6)
EXTENSION = Stroke((0.35, 0.35, 0.35), 0.35)
DIMENSION = Stroke(INK, 0.55)

#: Size of the letters of a graph, points.
TEXT_SIZE = 8.0
TICK_TEXT_SIZE = 7.5
READING_SIZE = 3.0
#: Behind labels among lines.
GROUND = Fill(WHITE, 0.8)
