"""What an effect of circles is: one cause in drives or structure, and what it makes of a radial deviation.

All circles of a machine are fitted together, so that the laws of feed and radius tell apart what one circle
cannot. A law is as much a part of an effect as its shape over the angle.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from enum import Enum
from typing import Protocol, TypeAlias, runtime_checkable

import numpy as np

from zlmreport.language import Words, same
from zlmreport.measurement.arrays import FloatArray
from zlmreport.measurement.units import Unit
from zlmreport.model.effects.circle_design import CircleDesign

MILLISECOND = Unit("ms", "ms", 1e3)
SQUARE_MILLISECOND = Unit("ms²", "ms2", 1e6)
#: Of a machine that gives way to the acceleration of an axis.
PER_ACCELERATION = Unit("µm/(m/s²)", "um/(m/s2)", 1e6)
MICROMETRE_PER_MINUTE = Unit("µm/min", "um/min", 60e6)
HERTZ = Unit("Hz", "Hz", 1.0)
ONE = Unit("", "1", 1.0)

#: Values of searched parameters, SI.
Searched: TypeAlias = tuple[float, ...]


class Parity(Enum):
    """How an effect differs between the two senses of a circle."""

    EVEN = "even"  #: Alike in both senses at the same place.
    ODD = "odd"  #: Opposite.
    BY_TRAVEL = "by travel"  #: Its place follows the travel of an axis since it turned.
    IN_TIME = "in time"  #: It knows no place.


@dataclass(frozen=True, slots=True)
class Law:
    """How the size of an effect grows: as powers of the feed F and of the radius R.

    None where it is no power: a shape that changes with it, or that one searches.
    """

    parity: Parity
    feed: float | None = 0.0
    radius: float | None = 0.0


@dataclass(frozen=True, slots=True)
class CircleTerm:
    """A parameter of an effect with its column."""

    name: str  #: As results files have it: ``X``, ``T_X-T_Y``, ``C0Y``.
    unit: Unit
    column: FloatArray  #: (N,): What one unit (SI) makes of Δr, m.
    group: str = ""  #: Terms of one group come in together: an axis, a plane; its own name without it.
    low: float = -np.inf  #: Least value that physics allows, SI.
    high: float = np.inf
    #: A usual size, SI: what leads among effects with the same columns is what needs the less unusual value.
    usual: float = 0.0
    title: Words | None = None  #: As pages have it, in words; its name without it.


@dataclass(frozen=True, slots=True)
class SearchedParameter:
    """A parameter on which the columns depend nonlinearly."""

    name: str
    unit: Unit
    is_refined: bool = False  #: Whether the search goes on between two values of the grid.
    title: Words | None = None  #: As pages have it, in words; its name without it.


def title_parameter(parameter: CircleTerm | SearchedParameter) -> Words:
    """Return what a parameter is called on pages."""
    return same(parameter.name) if parameter.title is None else parameter.title


@dataclass(frozen=True, slots=True)
class Estimate:
    """A parameter as it was estimated, SI."""

    name: str
    unit: Unit
    value: float
    expanded_uncertainty: float  #: k = 2.


@runtime_checkable
class CircleEffect(Protocol):
    """A cause of radial deviations of circles: Δr = Σ γ_k · column_k(design; θ).

    Subclass it: then only what differs from the simplest effect need be said (no θ, nothing to say).

    Attributes
    ----------
    identifier
        As machine files name it: ``servo-mismatch``.
    title
        In words.
    equation
        Δr as printed, with s, θ, R, F, d the direction of an axis and φ the angle travelled since it turned.
    explains
        The cause, in half a sentence.
    law
        How it differs between the senses, and grows with feed and radius.
    searched
        The parameters θ; empty for most effects.
    is_base
        Whether it belongs into every model, stated or not: where the bar stands, and how long it is.
    is_length_of_bar
        Whether it is what a calibrated bar has none of: then it belongs in only where it is stated.
    is_single
        Whether one group of its terms comes in at a time: two bent guides may look like axes out of square.
    is_asked_for
        Whether a reader wants to know how much of it there might be where nothing of it is found.
    """

    identifier: str
    title: Words
    equation: str
    explains: Words
    law: Law
    searched: tuple[SearchedParameter, ...] = ()
    is_base: bool = False
    is_length_of_bar: bool = False
    is_single: bool = False
    is_asked_for: bool = False

    def terms(self, design: CircleDesign, searched: Searched) -> Sequence[CircleTerm]:
        """Return the parameters that are fitted, each with its column; `searched` are values of θ, SI.

        A row depends on its own reading and on what the design's turns share, never on other readings.
        """

    def grid(self, design: CircleDesign) -> Sequence[Searched]:  # noqa: ARG002 - this one has no θ
        """Return the values of θ that the search begins with; none where the circles cannot show it."""
        return [()]

    def findings(self, estimates: Sequence[Estimate]) -> Iterable[Words]:  # noqa: ARG002 - nothing to add
        """Return in sentences what its estimated parameters mean, where its title does not say it."""
        return ()

    def absence(self, estimates: Sequence[Estimate]) -> Iterable[Words]:  # noqa: ARG002 - nothing to add
        """Return in sentences what it means that nothing of it is found, by how much there might be."""
        return ()
