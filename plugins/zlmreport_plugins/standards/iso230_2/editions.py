"""The editions of ISO 230-2 as data: names, symbols, coverage factors, formulas, columns by position."""

from __future__ import annotations

from dataclasses import dataclass

from zlmreport.plugin import Words
from zlmreport.plugin.standard import Basis, PositionQuantity, Quantity, QuantityGroup

_SINCE_1988 = {
    "A": Words("Bidirectional accuracy of positioning"),
    "A_fwd": Words("Unidirectional accuracy of positioning, positive direction"),
    "A_bwd": Words("Unidirectional accuracy of positioning, negative direction"),
    "E": Words("Bidirectional systematic positional deviation"),
    "E_fwd": Words("Unidirectional systematic positional deviation, positive direction"),
    "E_bwd": Words("Unidirectional systematic positional deviation, negative direction"),
    "M": Words("Range of the mean bidirectional positional deviation"),
    "R": Words("Bidirectional repeatability of positioning"),
    "R_fwd": Words("Unidirectional repeatability of positioning, positive direction"),
    "R_bwd": Words("Unidirectional repeatability of positioning, negative direction"),
    "B": Words("Reversal value"),
    "B_mean": Words("Mean reversal value"),
}

_SINCE_2006 = _SINCE_1988 | {"B": Words("Reversal error"), "B_mean": Words("Mean reversal error")}

_SINCE_2014 = _SINCE_2006 | {
    "A": Words("Bidirectional positioning error (accuracy)"),
    "A_fwd": Words("Unidirectional positioning error (accuracy), positive direction"),
    "A_bwd": Words("Unidirectional positioning error (accuracy), negative direction"),
    "E": Words("Bidirectional systematic positioning error"),
    "E_fwd": Words("Unidirectional systematic positioning error, positive direction"),
    "E_bwd": Words("Unidirectional systematic positioning error, negative direction"),
    "M": Words("Mean bidirectional positioning error"),
    "R": Words("Bidirectional positioning repeatability"),
    "R_fwd": Words("Unidirectional positioning repeatability, positive direction"),
    "R_bwd": Words("Unidirectional positioning repeatability, negative direction"),
}

#: The names by year of the edition, then by symbol.
NAMES = {1988: _SINCE_1988, 1997: _SINCE_1988, 2006: _SINCE_2006, 2014: _SINCE_2014}


_OF_ANGLES = {
    "A": Words("Bidirectional accuracy of the angle"),
    "E": Words("Bidirectional systematic angular error"),
    "M": Words("Range of the mean bidirectional angular error"),
    "R": Words("Bidirectional repeatability of the angle"),
    "B": Words("Reversal error of the angle"),
    "B_mean": Words("Mean reversal error of the angle"),
    "A_fwd": Words("Accuracy of the angle, positive direction"),
    "A_bwd": Words("Accuracy of the angle, negative direction"),
    "E_fwd": Words("Systematic angular error, positive direction"),
    "E_bwd": Words("Systematic angular error, negative direction"),
    "R_fwd": Words("Repeatability of the angle, positive direction"),
    "R_bwd": Words("Repeatability of the angle, negative direction"),
}
_TURN = Words(
    "How far the moving component turns, by the formula of the positioning error: on an arm of 100 mm 1″ is "
    "0.485 µm."
)

_ALWAYS_POSITIVE = Words("all positions are approached in the positive direction")
_ALWAYS_NEGATIVE = Words("all positions are approached in the negative direction")
_ACCURACY = Words(
    "The largest error, systematic and random together, that positioning is expected to bring into a "
    "dimension of a part if {condition}."
)
_SYSTEMATIC = Words(
    "The largest error of a dimension that remains on average over many like parts if {condition}."
)
_REPEATABILITY = Words("The largest scatter to expect of a feature's place among like parts if {condition}.")
#: One sentence for each symbol.
MEANINGS = {
    "A": _ACCURACY.given(condition=Words("positions are approached from either direction")),
    "A_fwd": _ACCURACY.given(condition=_ALWAYS_POSITIVE),
    "A_bwd": _ACCURACY.given(condition=_ALWAYS_NEGATIVE),
    "E": _SYSTEMATIC.given(condition=Words("each position is approached from its less favourable direction")),
    "E_fwd": _SYSTEMATIC.given(condition=_ALWAYS_POSITIVE),
    "E_bwd": _SYSTEMATIC.given(condition=_ALWAYS_NEGATIVE),
    "M": _SYSTEMATIC.given(condition=Words("each position is approached from both directions equally often")),
    "R": _REPEATABILITY.given(
        condition=Words(
            "it is approached now from one direction, now from the other: the reversal is part of it"
        )
    ),
    "R_fwd": _REPEATABILITY.given(condition=_ALWAYS_POSITIVE),
    "R_bwd": _REPEATABILITY.given(condition=_ALWAYS_NEGATIVE),
    "B": Words(
        "The largest average shift of a feature when its position is approached from the other direction."
    ),
    "B_mean": Words(
        "The average over the axis of the shift of features when their positions are approached from the "
        "other direction."
    ),
}


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


#: What follows from the formulas: the symbols of parameters that each is never smaller than.
_NEVER_BELOW: dict[str, tuple[str, ...]] = {
    "A": ("A_fwd", "A_bwd", "E", "R"),
    "A_fwd": ("E_fwd", "R_fwd"),
    "A_bwd": ("E_bwd", "R_bwd"),
    "E": ("E_fwd", "E_bwd", "M", "B"),
    "R": ("R_fwd", "R_bwd", "B"),
    "B": ("B_mean",),
}


@dataclass(frozen=True, slots=True)
class Edition:
    """One edition."""

    year: int  #: Of publication.
    #: k: limits are x̄ ± k·s. 3 in 1988 (ZLM, G 1.3), 2 since 1997 (confirmed by published results).
    coverage_factor: int
    #: The letter that counts target positions: j in 1988, i since; the other one counts the runs.
    position_index: str
    defines_systematic_deviation: bool  #: Whether E and M exist: since 1997.
    #: Whether the mean reversal value is printed as x̄↓ − x̄↑: in 1988 (ZLM, G 1.3).
    prints_reversal_as_negative_minus_positive: bool
    #: Where the rule for axes above 2000 mm or 360° is known from; None where the edition has none.
    long_axis: Basis | None


EDITIONS = (
    Edition(
        year=1988,
        coverage_factor=3,
        position_index="j",
        defines_systematic_deviation=False,
        prints_reversal_as_negative_minus_positive=True,
        long_axis=None,
    ),
    Edition(
        year=1997,
        coverage_factor=2,
        position_index="i",
        defines_systematic_deviation=True,
        prints_reversal_as_negative_minus_positive=False,
        long_axis=Basis.APPLIED,
    ),
    Edition(
        year=2006,
        coverage_factor=2,
        position_index="i",
        defines_systematic_deviation=True,
        prints_reversal_as_negative_minus_positive=False,
        long_axis=Basis.APPLIED,
    ),
    Edition(
        year=2014,
        coverage_factor=2,
        position_index="i",
        defines_systematic_deviation=True,
        prints_reversal_as_negative_minus_positive=False,
        long_axis=Basis.PUBLISHED,
    ),
)


def list_parameters(edition: Edition, *, of_angle: bool) -> tuple[Quantity, ...]:
    """Return the parameters of the axis in the order of the results table.

    `of_angle`: Whether they are those of an angular error, of which the standard has the formulas only.
    """
    return tuple(
        Quantity(
            symbol=symbol,
            notation=_NOTATIONS.get(symbol, symbol),
            name=_OF_ANGLES[symbol] if of_angle else NAMES[edition.year][symbol],
            group=_GROUPS[symbol[0]],
            formula=formula,
            meaning=_TURN if of_angle else MEANINGS[symbol],
            printed_sign=-1
            if symbol == "B_mean" and edition.prints_reversal_as_negative_minus_positive
            else 1,
            never_below=tuple(
                each
                for each in _NEVER_BELOW.get(symbol, ())
                if edition.defines_systematic_deviation or each not in _SINCE_1997
            ),
        )
        for symbol, formula in _list_formulas(edition).items()
        if edition.defines_systematic_deviation or symbol not in _SINCE_1997
    )


def list_by_position(edition: Edition) -> tuple[PositionQuantity, ...]:
    """Return the columns that the edition adds to the table by position."""
    i = f"_{{{edition.position_index}}}"
    return (
        PositionQuantity(
            "R_fwd", f"R{i}↑", Words("Unidirectional repeatability at a position, positive direction")
        ),
        PositionQuantity(
            "R_bwd", f"R{i}↓", Words("Unidirectional repeatability at a position, negative direction")
        ),
        PositionQuantity("R", f"R{i}", Words("Bidirectional repeatability at a position")),
    )


def _list_formulas(edition: Edition) -> dict[str, str]:
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
