"""The parameters of ISO 230-2 and its columns by position, as an edition defines and prints them."""

from __future__ import annotations

from zlmreport.plugin import PositionQuantity, Quantity, QuantityGroup, Words
from zlmreport_plugins.standards.iso230_2.editions import Edition
from zlmreport_plugins.standards.iso230_2.meanings import MEANINGS
from zlmreport_plugins.standards.iso230_2.names import NAMES

_GROUPS = {
    "A": QuantityGroup.COMPOSITE,
    "E": QuantityGroup.SYSTEMATIC,
    "M": QuantityGroup.SYSTEMATIC,
    "R": QuantityGroup.RANDOM,
    "B": QuantityGroup.SYSTEMATIC,
}
_NOTATIONS = {
    "A_fwd": "A↑",
    "A_bwd": "A↓",
    "E_fwd": "E↑",
    "E_bwd": "E↓",
    "R_fwd": "R↑",
    "R_bwd": "R↓",
    "B_mean": "B̄",
}
_SINCE_1997 = frozenset({"E", "E_fwd", "E_bwd", "M"})


def parameters(edition: Edition) -> tuple[Quantity, ...]:
    """Return the parameters of the axis in the order of the results table."""
    return tuple(
        Quantity(
            symbol=symbol,
            notation=_NOTATIONS.get(symbol, symbol),
            name=NAMES[edition.year][symbol],
            group=_GROUPS[symbol[0]],
            formula=formula,
            meaning=MEANINGS[symbol],
            printed_sign=_printed_sign(edition, symbol),
        )
        for symbol, formula in _formulas(edition).items()
        if edition.defines_systematic_deviation or symbol not in _SINCE_1997
    )


def by_position(edition: Edition) -> tuple[PositionQuantity, ...]:
    """Return the columns that the edition adds to the table by position."""
    i = f"_{{{edition.position_index}}}"
    return (
        PositionQuantity(
            "R_fwd",
            f"R{i}↑",
            Words(
                "Unidirectional repeatability at a position, positive direction",
                "Einseitige Wiederholgenauigkeit an einer Position, positive Richtung",
            ),
        ),
        PositionQuantity(
            "R_bwd",
            f"R{i}↓",
            Words(
                "Unidirectional repeatability at a position, negative direction",
                "Einseitige Wiederholgenauigkeit an einer Position, negative Richtung",
            ),
        ),
        PositionQuantity(
            "R",
            f"R{i}",
            Words(
                "Bidirectional repeatability at a position",
                "Zweiseitige Wiederholgenauigkeit an einer Position",
            ),
        ),
    )


def _printed_sign(edition: Edition, symbol: str) -> int:
    return -1 if symbol == "B_mean" and edition.prints_reversal_as_negative_minus_positive else 1


def _formulas(edition: Edition) -> dict[str, str]:
    """Return the definitions in notation, in the order of the results table."""
    k, i = edition.coverage_factor, f"_{{{edition.position_index}}}"
    up, down = f"x̄{i}↑", f"x̄{i}↓"
    s_up, s_down = f"{k}s{i}↑", f"{k}s{i}↓"
    reversal = f"{up} − {down}"
    if edition.prints_reversal_as_negative_minus_positive:
        mean_reversal = f"(1/n) · ∑ ({down} − {up})"
    else:
        mean_reversal = f"(1/m) · ∑ B{i}, B{i} = {reversal}"
    return {
        "A": f"max({up} + {s_up}; {down} + {s_down}) − min({up} − {s_up}; {down} − {s_down})",
        "A_fwd": f"max({up} + {s_up}) − min({up} − {s_up})",
        "A_bwd": f"max({down} + {s_down}) − min({down} − {s_down})",
        "E": f"max({up}; {down}) − min({up}; {down})",
        "E_fwd": f"max({up}) − min({up})",
        "E_bwd": f"max({down}) − min({down})",
        "M": f"max(x̄{i}) − min(x̄{i}), x̄{i} = ({up} + {down})/2",
        "R": f"max({s_up} + {s_down} + |B{i}|; {2 * k}s{i}↑; {2 * k}s{i}↓), B{i} = {reversal}",
        "R_fwd": f"max({2 * k}s{i}↑)",
        "R_bwd": f"max({2 * k}s{i}↓)",
        "B": f"max(|B{i}|), B{i} = {reversal}",
        "B_mean": mean_reversal,
    }
