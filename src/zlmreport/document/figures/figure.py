"""A graph as data: what is drawn, in words of metrology and without a line width or a colour.

A standard says which curves, bands, arrows and brackets its prescribed graph has, the error model which
points, curves and bars; `zlmreport.document.figures.draw` gives all of them one look. Coordinates are in
the units that the axes print (mm and µm, ° and ″).
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from typing import Literal

import numpy as np

from zlmreport.language import Words
from zlmreport.language.formatting import write_plain
from zlmreport.measurement.approach import Approach
from zlmreport.measurement.arrays import FloatArray


class Role(Enum):
    """What a mark stands for; the drawing style follows from it, in colour and in black and white."""

    MEAN_POSITIVE = "mean, positive approach"
    MEAN_NEGATIVE = "mean, negative approach"
    MEAN_BIDIRECTIONAL = "mean of both approaches"
    LIMIT_POSITIVE = "spread limit, positive approach"
    LIMIT_NEGATIVE = "spread limit, negative approach"
    SPREAD = "spread of both approaches"
    REVERSAL = "half reversal value about the mean"
    BAND_LIMIT = "limit of the overall band"
    TOLERANCE = "tolerance"
    MODEL_POSITIVE = "model, positive approach"
    MODEL_NEGATIVE = "model, negative approach"
    UNCERTAINTY_POSITIVE = "expanded uncertainty of the model, positive approach"
    UNCERTAINTY_NEGATIVE = "expanded uncertainty of the model, negative approach"
    NOISE = "scatter of single readings"
    PATH = "motion of the axis"
    CHANNEL_1 = "first of several channels over time"
    CHANNEL_2 = "second of several channels"
    CHANNEL_3 = "third of several channels"
    CHANNEL_4 = "fourth of several channels"
    CHANNEL_5 = "fifth of several channels"
    CHANNEL_6 = "sixth of several channels"


@dataclass(frozen=True, slots=True)
class Curve:
    """A line through one value at each target.

    Attributes
    ----------
    notation
        The symbol in the legend (`zlmreport.language.formatting`).
    role
        What it stands for.
    x, y : (m,) arrays
        Target positions and values; NaN leaves a gap.
    """

    notation: str
    role: Role
    x: FloatArray
    y: FloatArray


@dataclass(frozen=True, slots=True)
class Band:
    """The area between two limits; `lower` and `upper` have shape (m,), NaN leaves a gap."""

    notation: str
    role: Role
    x: FloatArray
    lower: FloatArray
    upper: FloatArray


@dataclass(frozen=True, slots=True)
class PlottedReadings:
    """All single readings of one approach, behind the curves: `x` and `y` of shape (N,)."""

    approach: Approach
    x: FloatArray
    y: FloatArray


@dataclass(frozen=True, slots=True)
class Arrow:
    """A double-headed arrow at one target position, between two values, with its symbol.

    ``B_i`` at the worst target, ``U_j/2`` about a mean. Equal ends make no arrow but a mark.
    """

    notation: str
    x: float
    low: float
    high: float


@dataclass(frozen=True, slots=True)
class Bracket:
    """An overall parameter as a dimension line beside the diagram.

    Attributes
    ----------
    notation
        The parameter's symbol.
    low, high
        The two values that it spans.
    low_at, high_at
        The target positions at which these values arise; extension lines lead from there to the bracket.
    """

    notation: str
    low: float
    high: float
    low_at: float
    high_at: float


@dataclass(frozen=True, slots=True)
class Level:
    """A horizontal line over the whole diagram: an offset, the middle of a band, a tolerance.

    One whose notation is empty has no label.
    """

    notation: str
    role: Role
    y: float


@dataclass(frozen=True, slots=True)
class Bar:
    """A value as a bar from zero; the bars of a panel stand side by side instead of over positions."""

    label: Words  #: Below the bar: words, or the notation of a symbol.
    y: float  #: Where it ends.
    value: Words  #: Written at its end.
    #: Half the width of the interval about its end that is drawn as a whisker; 0 for none.
    uncertainty: float = 0.0
    #: Up to where the bar may reach, marked by a line across it; None for no mark.
    accepted: float | None = None
    is_symbol: bool = False  #: Whether its label is one.


@dataclass(frozen=True, slots=True)
class Note:
    """What is written at a place of a wire picture: the value there, to one decimal, or a name."""

    x: float
    y: float
    value: float | Words
    is_below: bool = False  #: Whether it stands below the place instead of above it.


@dataclass(frozen=True, slots=True)
class Tiles:
    """Values over a grid, each as a tile about its place: the darker, the larger."""

    #: x, y: Places along both axes, rising, (n,) and (m,).
    x: FloatArray
    y: FloatArray
    #: Not negative, (n, m), in the unit that is printed; every other one is written on its tile.
    values: FloatArray
    darkest: float  #: The value of the darkest tile: that of several panels is one.

    @property
    def edges(self) -> tuple[FloatArray, FloatArray]:
        """Where tiles end along both axes, (n + 1,) and (m + 1,): half-way to the next place."""
        return _find_edges(self.x), _find_edges(self.y)


def _find_edges(places: FloatArray) -> FloatArray:
    between = (places[1:] + places[:-1]) / 2.0
    ends = (2.0 * places[0] - between[0], 2.0 * places[-1] - between[-1])
    return np.concatenate([[ends[0]], between, [ends[1]]])


@dataclass(frozen=True, slots=True)
class Panel:
    """One pair of axes.

    Attributes
    ----------
    heading
        Above the panel, where a figure has more than one; None otherwise.
    curves, bands, readings, arrows, brackets, levels, bars
        What is drawn.
    projection
        ``polar`` for values over an angle, in degrees: drawn outwards from a nominal circle, magnified. A
        curve then shows where it begins and in which sense it goes on; levels are circles, and arrows,
        brackets and bars have no place. ``wire`` for a picture of a body: curves whose coordinates are those
        of the picture, both on one scale, without axes; only curves and notes have a place.
    notes
        Of a wire picture: what stands at places of it.
    tiles
        Values over both axes, behind all else; None for none.
    directions
        Of a panel about a circle: angles, degrees, and what stands at them beside the angle, such as the
        letter of the axis that turns round there; a point on the nominal circle marks each.
    y_title, y_unit
        The quantity of a panel that shows another than the figure, and its unit as printed; None and empty
        for the figure's.
    """

    heading: Words | None = None
    curves: tuple[Curve, ...] = ()
    bands: tuple[Band, ...] = ()
    readings: tuple[PlottedReadings, ...] = ()
    arrows: tuple[Arrow, ...] = ()
    brackets: tuple[Bracket, ...] = ()
    levels: tuple[Level, ...] = ()
    bars: tuple[Bar, ...] = ()
    notes: tuple[Note, ...] = ()
    tiles: Tiles | None = None
    projection: Literal["straight", "polar", "wire"] = "straight"
    directions: tuple[tuple[float, str], ...] = ()
    y_title: Words | None = None
    y_unit: str = ""

    @property
    def is_polar(self) -> bool:
        """Whether it is drawn about a circle."""
        return self.projection == "polar"

    @property
    def is_wire(self) -> bool:
        """Whether it is a picture of a body, without axes."""
        return self.projection == "wire"


@dataclass(frozen=True, slots=True)
class Figure:
    """A graph of a certificate.

    Attributes
    ----------
    key
        Short and unique among one standard's figures: ``means``, ``overall``.
    title
        The caption.
    alternative
        What the graph shows, for those who cannot see it: with its values.
    x_title, y_title
        The axes' quantities, without unit. Of a wire picture the first one stands alone below it.
    x_unit, y_unit
        As printed.
    panels
        From top to bottom; they share the position axis.
    spans_are_alike
        Whether lengths of all panels compare by eye: not where one shows what is left of the other.
    height
        In millimetres; None for the usual one.
    is_wide
        Whether the panels stand beside each other instead of one below the other.
    """

    key: str
    title: Words
    alternative: Words
    x_title: Words
    y_title: Words
    x_unit: str
    y_unit: str
    panels: tuple[Panel, ...]
    spans_are_alike: bool = True
    height: float | None = None
    is_wide: bool = False

    @property
    def symbols(self) -> tuple[str, ...]:
        """Notations of what is drawn, those of several letters: what its caption may speak of.

        A single letter may be a word.
        """
        drawn: list[str] = []
        for panel in self.panels:
            drawn += [curve.notation for curve in panel.curves]
            drawn += [band.notation for band in panel.bands]
            drawn += [arrow.notation for arrow in panel.arrows]
            drawn += [bracket.notation for bracket in panel.brackets]
            drawn += [level.notation for level in panel.levels]
        return tuple(dict.fromkeys(each for each in drawn if len(write_plain(each)) > 1))

    @property
    def has_several_quantities(self) -> bool:
        """Whether panels show quantities of their own: then they stand one below the other on one axis."""
        return any(panel.y_title for panel in self.panels)

    def value_axis(self, panel: Panel) -> tuple[Words, str]:
        """Return the quantity along the upright axis of one of its panels, and its unit as printed."""
        return (panel.y_title, panel.y_unit) if panel.y_title else (self.y_title, self.y_unit)
