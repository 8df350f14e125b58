"""A smooth bow of the axis: the polynomial that Halaj, Kureková, Palenčár and Loebl put over the travel."""

from __future__ import annotations

import numpy as np
from pydantic import Field

from zlmreport.plugin import (
    Confusion,
    Design,
    Dimension,
    Effect,
    FloatArray,
    Options,
    Parameter,
    Shape,
    Words,
    needs_targets,
)
from zlmreport_plugins.effects import told_apart

_ORDERS_OF_A_CONTEST = (2, 3, 4, 5)
_LARGEST = 50e-6


class PolynomialOptions(Options):
    """The order of the polynomial."""

    order: int = Field(3, ge=2, le=9, description="Highest power of the position; 3 is a cubic.")


class Polynomial(Effect):
    """The full polynomial from its constant up, over the position scaled to −1 … 1 of the measured travel.

    It describes and explains nothing: guideways, a screw's lead and a table's bow all look like this. Its
    constant and its slope are those of `offset` and `scale-error`, which cannot stand beside it. An order
    above 3 swallows Abbe errors and kinks.
    """

    identifier = "polynomial"
    title = Words(en="Polynomial over the position", de="Polynom über der Position")
    equation = "Σ c_{k}·p^k, k = 0 … n;  p = (P − P_{mid}) / (L/2)"
    shape = Shape.POSITION
    look = Words(
        en="The residuals follow a smooth bow over the position, the same in both directions.",
        de="Die Residuen folgen über der Position einem glatten Bogen, in beiden Richtungen demselben.",
    )
    confusions = (
        Confusion("abbe", told_apart.OTHER_HEIGHT),
        Confusion("scale-kink", told_apart.DENSER_TARGETS),
        Confusion("periodic", told_apart.DENSER_TARGETS),
        Confusion("compensation-sign", told_apart.TABLE_OFF),
        Confusion("eccentricity", told_apart.FULL_TURN),
        Confusion("ellipticity", told_apart.FULL_TURN),
    )
    contains = ("offset", "scale-error")
    options = PolynomialOptions

    def __init__(self, order: int = 3) -> None:
        self.settings = PolynomialOptions(order=order)
        self.order = order
        self.linear = tuple(_coefficient(power) for power in range(order + 1))

    def with_settings(self, settings: PolynomialOptions) -> Effect:
        """Return the polynomial of the stated order."""
        return Polynomial(settings.order)

    def forms(self) -> tuple[Effect, ...]:
        """Return the polynomials that a contest tries."""
        return tuple(Polynomial(order) for order in _ORDERS_OF_A_CONTEST)

    def untestable(self, design: Design) -> Words | None:
        """Demand more targets than coefficients."""
        return needs_targets(design, self.order + 2)

    def columns(self, design: Design, theta: FloatArray) -> FloatArray:  # noqa: ARG002 - no θ
        """Return the powers of p."""
        scaled = (design.position - design.middle) / (design.length / 2)
        return np.vander(scaled, self.order + 1, increasing=True)


def _coefficient(power: int) -> Parameter:
    bound = _LARGEST if power > 1 else None
    return Parameter(
        f"c{power}",
        f"c_{{{power}}}",
        Dimension.DEVIATION,
        Words(en="coefficient of power {power}", de="Koeffizient der {power}. Potenz").given(power=power),
        None if bound is None else -bound,
        bound,
    )
