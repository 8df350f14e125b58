"""What tells the two guidelines apart."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from zlmreport.plugin import Words
from zlmreport_plugins.standards.vdi.meanings import OF_A_PART_MADE, OF_A_POINT_MEASURED


@dataclass(frozen=True, slots=True)
class Guideline:
    """One of the two guidelines.

    Attributes
    ----------
    identifier, designation, title
        As in `zlmreport.plugin.protocols.Standard`.
    factor
        k: P_sj = k·(s_j↑ + s_j↓).
    positions_per_metre
        Least number of positions for each metre, one more to be added; None where none is stated.
    positions_in_all
        Least number of positions whatever the length; None where none is stated.
    positions_per_scale_element
        Least number of positions on each element of the scale.
    meanings
        What the parameters mean, by symbol: of a part made, or of a point measured on the machine.
    """

    identifier: str
    designation: str
    title: Words
    factor: int
    positions_per_metre: int | None
    positions_in_all: int | None
    positions_per_scale_element: int
    meanings: Mapping[str, Words]


GUIDELINES = (
    Guideline(
        identifier="vdi-dgq-3441",
        designation="VDI/DGQ 3441",
        title=Words(
            "Position uncertainty of machine tools, from repeated positioning",
            "Positionsunsicherheit von Werkzeugmaschinen aus wiederholtem Positionieren",
        ),
        factor=3,
        positions_per_metre=10,
        positions_in_all=None,
        positions_per_scale_element=1,
        meanings=OF_A_PART_MADE,
    ),
    Guideline(
        identifier="vdi-vde-2617",
        designation="VDI/VDE 2617",
        title=Words(
            "Position uncertainty of coordinate measuring machines, from repeated positioning",
            "Positionsunsicherheit von Koordinatenmessgeräten aus wiederholtem Positionieren",
        ),
        factor=2,
        positions_per_metre=None,
        positions_in_all=11,
        positions_per_scale_element=2,
        meanings=OF_A_POINT_MEASURED,
    ),
)
