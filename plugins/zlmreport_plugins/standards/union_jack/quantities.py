"""The parameters of a union jack, and what a reader of them must know."""

from __future__ import annotations

from collections.abc import Iterator

from zlmreport.plugin import Words
from zlmreport.plugin.standard import Quantity, QuantityGroup
from zlmreport_plugins.union_jack_lines import CENTRE_LINES

#: Of a closure, m: 100 µin.
MOST_CLOSURE = 2.54e-6


def make_closure_symbol(name: str) -> str:
    """Return the symbol of the closure of a centre line."""
    return f"closure_{name.replace('-', '')}"


def _define_span(symbol: str, notation: str, name: Words, formula: str, meaning: Words) -> Quantity:
    return Quantity(symbol, notation, name, QuantityGroup.SYSTEMATIC, formula, meaning)


def _define_closures() -> Iterator[Quantity]:
    for name in CENTRE_LINES:
        yield Quantity(
            make_closure_symbol(name),
            f"c_{{{name.replace('-', '')}}}",
            Words("Closure of the centre line {name}").given(name=name),
            QuantityGroup.SYSTEMATIC,
            f"h_{{{name}}}(L/2)",
            Words(
                "The height in the middle of the plate by this line, where the diagonals have 0: how well "
                "all lines agree."
            ),
        )


QUANTITIES = (
    _define_span(
        "t",
        "t",
        Words("Flatness deviation from the base plane"),
        "max(h) − min(h)",
        Words(
            "The largest height of the plate above its lowest point, over the base plane of the union jack."
        ),
    ),
    _define_span(
        "t_LS",
        "t_{LS}",
        Words("Flatness deviation, least squares plane"),
        "max(h − h_{LS}) − min(h − h_{LS})",
        Words("The same about the plane from which the squares of all heights are least."),
    ),
    _define_span(
        "t_MZ",
        "t_{MZ}",
        Words("Flatness deviation, minimum zone"),
        "min(max(h − h_{E}) − min(h − h_{E}))",
        Words("The least distance of two parallel planes that hold all points: never more than the others."),
    ),
    *_define_closures(),
)
NOTES = (
    Words(
        "The base plane of the union jack runs through the crossing of both diagonals, parallel to the lines "
        "through their ends (J. C. Moody, 1955). It is neither the least squares plane nor that of the "
        "minimum zone."
    ),
    Words(
        "Each centre line was shifted to 0 in the middle of the plate, by its closure; heights are known "
        "along the eight lines only."
    ),
    Words(
        "All heights are in proportion to the distance of the carriage's feet: an error of 0.1 mm in 100 mm "
        "changes them by 0.1 %."
    ),
)
