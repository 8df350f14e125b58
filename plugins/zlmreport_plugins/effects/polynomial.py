"""The effect ``polynomial``: a polynomial of chosen order over the position, which no catalogue can say."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from pydantic import Field

from zlmreport.plugin import POSITIONING, STRAIGHTNESS, FloatArray, Options, Words, hookimpl
from zlmreport.plugin.effect import (
    Confusion,
    Design,
    Dimension,
    Effect,
    Parameter,
    Shape,
    measurements_of_catalogue,
    needs_targets,
)

_ORDERS_OF_A_CONTEST = (2, 3, 4, 5)
_LARGEST = 500e-6
#: What it is taken for, and which measurement tells the two apart.
_TAKEN_FOR = {
    "abbe": "other-height",
    "scale-kink": "denser-targets",
    "periodic": "denser-targets",
    "compensation-sign": "table-off",
    "eccentricity": "full-turn",
    "ellipticity": "full-turn",
    "worn-zone": "other-zone",
}


class PolynomialOptions(Options):
    """The order of the polynomial."""

    order: int = Field(3, ge=2, le=9, description="Highest power of the position; 3 is a cubic.")


class Polynomial(Effect):
    """The full polynomial from its constant up, over the position scaled to −1 … 1 of the measured travel."""

    identifier = "polynomial"
    title = Words("Polynomial over the position")
    equation = "Σ c_{k}·p^k, k = 0 … n;  p = (P − P_{mid}) / (L/2)"
    shape = Shape.POSITION
    physics = Words(
        "The full polynomial from its constant up, over the position scaled to −1 … 1 of the measured "
        "travel. It describes and explains nothing: guideways, a screw's lead and a table's bow all look "
        "like this. Its constant and its slope are those of `offset` and `scale-error`, which cannot stand "
        "beside it. An order above 3 swallows Abbe errors and kinks."
    )
    look = Words("The residuals follow a smooth bow over the position, the same in both directions.")
    remedy = Words(
        "It names no cause: the lead of the screw, bent guideways and the bow of a mounted scale look "
        "like this. Check level, straightness and tension. A pitch table with rows at the targets removes"
        " what stays, in the measured line."
    )
    source = Words("a series; M. Halaj and others describe axes by one of third order")
    contains = ("offset", "scale-error")
    measurands = (POSITIONING, STRAIGHTNESS)
    options = PolynomialOptions

    def __init__(self, order: int = 3) -> None:
        self.settings = PolynomialOptions(order=order)
        self.order = order
        self.linear = tuple(_make_coefficient(power) for power in range(order + 1))

    @property
    def confusions(self) -> tuple[Confusion, ...]:  # type: ignore[override]  # read where it is asked for
        """What it is taken for."""
        told = measurements_of_catalogue(__file__, "measurements.yaml")
        return tuple(Confusion(effect, told[name]) for effect, name in _TAKEN_FOR.items())

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


def _make_coefficient(power: int) -> Parameter:
    bound = _LARGEST if power > 1 else None
    return Parameter(
        f"c{power}",
        f"c_{{{power}}}",
        Dimension.DEVIATION,
        Words("coefficient of power {power}").given(power=power),
        None if bound is None else -bound,
        bound,
    )


@hookimpl
def zlmreport_effects() -> Iterable[Effect]:
    """Return it."""
    return (Polynomial(),)
