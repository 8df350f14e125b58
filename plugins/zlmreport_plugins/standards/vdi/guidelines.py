"""The two VDI guidelines as data: parameters, which is never below which, factors, wording, columns."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from zlmreport.plugin import Words
from zlmreport.plugin.standard import PositionQuantity, Quantity, QuantityGroup

#: VDI/DGQ 3441, by symbol.
OF_A_PART_MADE = {
    "P": Words(
        "The largest error, systematic and random together, that positioning is expected to bring into a "
        "dimension of a part, whichever the direction of approach."
    ),
    "Pa": Words("The largest error of a dimension that remains on average over many like parts."),
    "U_max": Words(
        "The largest average shift of a feature when its position is approached from the other direction."
    ),
    "U_mean": Words("The amount of that shift, averaged over the positions of the axis."),
    "Ps_max": Words(
        "The scatter to expect of a feature's place among like parts, at the position where it is largest."
    ),
    "Ps_mean": Words(
        "The scatter to expect of a feature's place among like parts, averaged over the positions."
    ),
}

#: VDI/VDE 2617, by symbol.
OF_A_POINT_MEASURED = {
    "P": Words(
        "The largest error, systematic and random together, to expect of a length measured along the axis, "
        "whichever the direction of approach."
    ),
    "Pa": Words("The largest error of a measured length that remains on average over many measurements."),
    "U_max": Words(
        "The largest average change of a measured coordinate when its position is approached from the other "
        "direction."
    ),
    "U_mean": Words("The amount of that change, averaged over the positions of the axis."),
    "Ps_max": Words(
        "The scatter to expect of a repeatedly measured coordinate, at the position where it is largest."
    ),
    "Ps_mean": Words(
        "The scatter to expect of a repeatedly measured coordinate, averaged over the positions."
    ),
}


@dataclass(frozen=True, slots=True)
class Guideline:
    """One of the two guidelines."""

    #: identifier, designation and title: As in `zlmreport.plugin.protocols.Standard`.
    identifier: str
    designation: str
    title: Words
    factor: int  #: k: P_sj = k·(s_j↑ + s_j↓).
    #: Least number of positions for each metre, one more to be added; None where none is stated.
    positions_per_metre: int | None
    positions_in_all: int | None  #: Least number of positions whatever the length; None where none is stated.
    positions_per_scale_element: int  #: Least number of positions on each element of the scale.
    #: What the parameters mean, by symbol: of a part made, or of a point measured on the machine.
    meanings: Mapping[str, Words]


GUIDELINES = (
    Guideline(
        identifier="vdi-dgq-3441",
        designation="VDI/DGQ 3441",
        title=Words("Position uncertainty of machine tools, from repeated positioning"),
        factor=3,
        positions_per_metre=10,
        positions_in_all=None,
        positions_per_scale_element=1,
        meanings=OF_A_PART_MADE,
    ),
    Guideline(
        identifier="vdi-vde-2617",
        designation="VDI/VDE 2617",
        title=Words("Position uncertainty of coordinate measuring machines, from repeated positioning"),
        factor=2,
        positions_per_metre=None,
        positions_in_all=11,
        positions_per_scale_element=2,
        meanings=OF_A_POINT_MEASURED,
    ),
)


#: What follows from the formulas: the symbols of parameters that each is never smaller than.
_NEVER_BELOW: dict[str, tuple[str, ...]] = {
    "P": ("Pa", "Ps_max", "U_max"),
    "Ps_max": ("Ps_mean",),
    "U_max": ("U_mean",),
}

_SPREAD = Words("Position spread")
_REVERSAL = Words("Reversal span")


def list_quantities(guideline: Guideline) -> tuple[Quantity, ...]:
    """Return the parameters of the axis in the order of the results table."""
    k = guideline.factor
    band, mean = "½(U_{j} + P_{sj})", "x̄_{j}"
    spread = f"P_{{sj}} = {k}(s_{{j}}↑ + s_{{j}}↓)"
    reversal = "U_{j} = |x̄_{j}↑ − x̄_{j}↓|"

    def quantity(symbol: str, notation: str, name: Words, group: QuantityGroup, formula: str) -> Quantity:
        return Quantity(
            symbol,
            notation,
            name,
            group,
            formula,
            guideline.meanings[symbol],
            never_below=_NEVER_BELOW.get(symbol, ()),
        )

    return (
        quantity(
            "P",
            "P",
            Words("Position uncertainty"),
            QuantityGroup.COMPOSITE,
            f"max[{mean} + {band}] − min[{mean} − {band}]",
        ),
        quantity(
            "Pa",
            "P_{a}",
            Words("Position deviation"),
            QuantityGroup.SYSTEMATIC,
            f"max[{mean}] − min[{mean}], {mean} = ½({mean}↑ + {mean}↓)",
        ),
        quantity(
            "Ps_max",
            "P_{s max}",
            Words("Largest position spread"),
            QuantityGroup.RANDOM,
            f"max[P_{{sj}}], {spread}",
        ),
        quantity(
            "Ps_mean", "P_{s mit}", Words("Mean position spread"), QuantityGroup.RANDOM, "(1/n) · ∑ P_{sj}"
        ),
        quantity(
            "U_max",
            "U_{max}",
            Words("Largest reversal span"),
            QuantityGroup.SYSTEMATIC,
            f"max[U_{{j}}], {reversal}",
        ),
        quantity(
            "U_mean", "U_{mit}", Words("Mean reversal span"), QuantityGroup.SYSTEMATIC, "(1/n) · ∑ U_{j}"
        ),
    )


#: The columns that the guidelines add to the table by position.
BY_POSITION: tuple[PositionQuantity, ...] = (
    PositionQuantity("U", "U_{j}", _REVERSAL),
    PositionQuantity("Ps", "P_{sj}", _SPREAD),
)
