"""The parameters of both guidelines and their columns by position."""

from __future__ import annotations

from zlmreport.plugin import PositionQuantity, Quantity, QuantityGroup, Words
from zlmreport_plugins.standards.vdi.guidelines import Guideline

_SPREAD = Words("Position spread", "Positionsstreubreite")
_REVERSAL = Words("Reversal span", "Umkehrspanne")


def parameters(guideline: Guideline) -> tuple[Quantity, ...]:
    """Return the parameters of the axis in the order of the results table."""
    k = guideline.factor
    band, mean = "½(U_{j} + P_{sj})", "x̄_{j}"
    spread = f"P_{{sj}} = {k}(s_{{j}}↑ + s_{{j}}↓)"
    reversal = "U_{j} = |x̄_{j}↑ − x̄_{j}↓|"

    def quantity(symbol: str, notation: str, name: Words, group: QuantityGroup, formula: str) -> Quantity:
        return Quantity(symbol, notation, name, group, formula, guideline.meanings[symbol])

    return (
        quantity(
            "P",
            "P",
            Words("Position uncertainty", "Positionsunsicherheit"),
            QuantityGroup.COMPOSITE,
            f"max[{mean} + {band}] − min[{mean} − {band}]",
        ),
        quantity(
            "Pa",
            "P_{a}",
            Words("Position deviation", "Positionsabweichung"),
            QuantityGroup.SYSTEMATIC,
            f"max[{mean}] − min[{mean}], {mean} = ½({mean}↑ + {mean}↓)",
        ),
        quantity(
            "Ps_max",
            "P_{s max}",
            Words("Largest position spread", "Größte Positionsstreubreite"),
            QuantityGroup.RANDOM,
            f"max[P_{{sj}}], {spread}",
        ),
        quantity(
            "Ps_mean",
            "P_{s mit}",
            Words("Mean position spread", "Mittlere Positionsstreubreite"),
            QuantityGroup.RANDOM,
            "(1/n) · ∑ P_{sj}",
        ),
        quantity(
            "U_max",
            "U_{max}",
            Words("Largest reversal span", "Größte Umkehrspanne"),
            QuantityGroup.SYSTEMATIC,
            f"max[U_{{j}}], {reversal}",
        ),
        quantity(
            "U_mean",
            "U_{mit}",
            Words("Mean reversal span", "Mittlere Umkehrspanne"),
            QuantityGroup.SYSTEMATIC,
            "(1/n) · ∑ U_{j}",
        ),
    )


#: The columns that the guidelines add to the table by position.
BY_POSITION: tuple[PositionQuantity, ...] = (
    PositionQuantity("U", "U_{j}", _REVERSAL),
    PositionQuantity("Ps", "P_{sj}", _SPREAD),
)
