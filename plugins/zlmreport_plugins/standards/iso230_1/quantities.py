"""The parameters of ISO 230-1 by what was measured, and their names; each bears the error's own symbol."""

from __future__ import annotations

from zlmreport.plugin import ANGLE, ARCSECOND, MICROMETRE_PER_METRE, SQUARENESS, ErrorSymbol, Measurand, Words
from zlmreport.plugin.standard import PositionQuantity, Quantity, QuantityGroup

#: Two axes, or an axis and a spindle, whose reference lines should have one direction.
PARALLELISM = Measurand(
    identifier="parallelism",
    title=Words("Parallelism error"),
    definition=Words("the slope of the reference straight line of the first line minus that of the second"),
    unit=ARCSECOND,
    sign=Words("slope of the first line − slope of the second line, both positive in the same direction"),
    joins_tests=True,
)

_STRAIGHTNESS = Words("Straightness error, mean of all runs")
_ANGLE = Words("Angular error, mean of all runs")
_DIRECTIONS = {
    "fwd": ("↑", Words("{name}, positive direction")),
    "bwd": ("↓", Words("{name}, negative direction")),
}
_STRAIGHT = Words("Straightness error")
_TURNED = Words("Angular error")
_SPAN_OF_STRAIGHTNESS = Words(
    "The distance of the two parallels to the reference line between which the mean path of the axis lies: a "
    "full width, not ±."
)
_SPAN_OF_ANGLE = Words(
    "The largest turn of the moving component between two positions on average over all runs: a full width, "
    "not ±."
)


def find_measurand(what: ErrorSymbol | Measurand) -> Measurand:
    """Return the quantity that an error is of; of a quantity, itself."""
    return what if isinstance(what, Measurand) else what.measurand


def define_of(what: ErrorSymbol | Measurand) -> tuple[tuple[Quantity, ...], tuple[PositionQuantity, ...]]:
    """Return the parameters and the columns by position of an error.

    Raises `ValueError` for a squareness error that has no symbol, and so no sign.
    """
    measurand = find_measurand(what)
    symbol = what.identifier if isinstance(what, Measurand) else what.symbol
    notation = symbol if isinstance(what, Measurand) else f"{symbol[0]}_{{{symbol[1:]}}}"
    if symbol == SQUARENESS.identifier:
        raise ValueError("a squareness error is named by its symbol, such as C0Y")
    if measurand.joins_tests:
        return _define_between(measurand, symbol, notation), ()
    if measurand.identifier == ANGLE.identifier:
        return tuple(_define_angles(symbol, notation)), ()
    return tuple(_define_straightness(symbol, notation)), _COLUMNS


def _add_index(notation: str, word: str) -> str:
    """Return a symbol with one more index: ``EYX_{run}``, ``E_{YX, run}``."""
    return f"{notation[:-1]}, {word}}}" if notation.endswith("}") else f"{notation}_{{{word}}}"


def _define_straightness(symbol: str, notation: str) -> list[Quantity]:
    systematic = QuantityGroup.SYSTEMATIC
    formula = "max(d̄_{i}) − min(d̄_{i}), d̄_{i} = x̄_{i} − (y_{0} + m·P_{i})"
    return [
        Quantity(
            symbol,
            notation,
            _STRAIGHTNESS,
            systematic,
            formula,
            _SPAN_OF_STRAIGHTNESS,
            never_below=(f"{symbol}_local",),
        ),
        *(
            Quantity(
                f"{symbol}_{way}",
                f"{notation}{arrow}",
                name.given(name=_STRAIGHT),
                systematic,
                f"max(d̄_{{i}}{arrow}) − min(d̄_{{i}}{arrow})",
                Words("The same of runs in one direction only, each about its own line."),
            )
            for way, (arrow, name) in _DIRECTIONS.items()
        ),
        Quantity(
            f"{symbol}_run",
            _add_index(notation, "run"),
            Words("Straightness error, worst single run"),
            QuantityGroup.COMPOSITE,
            "max_{j}[max(d_{ij}) − min(d_{ij})]",
            Words("The largest of the same of every run by itself: systematic and random together."),
            never_below=(symbol, *(f"{symbol}_{way}" for way in _DIRECTIONS)),
        ),
        Quantity(
            f"{symbol}_local",
            _add_index(notation, "local"),
            Words("Straightness error over a part of the length"),
            systematic,
            "max_{k}[max(d̄_{i}) − min(d̄_{i})], P_{k} ≤ P_{i} ≤ P_{k} + w",
            Words(
                "The largest straightness error of a piece of the axis as long as the window: what a short "
                "part shows."
            ),
        ),
        define_slope("slope", "m", Words("Slope of the reference line")),
    ]


def define_slope(symbol: str, notation: str, name: Words) -> Quantity:
    """Return the slope of a reference line: the alignment of the set-up, and no error of one axis."""
    return Quantity(
        symbol,
        notation,
        name,
        QuantityGroup.SYSTEMATIC,
        "x̄_{i} ≈ y_{0} + m·P_{i}",
        Words("How far the reference was out of line with the axis: the alignment of the set-up, taken off."),
        can_be_limited=False,
        unit=MICROMETRE_PER_METRE,
    )


def _define_angles(symbol: str, notation: str) -> list[Quantity]:
    systematic = QuantityGroup.SYSTEMATIC
    return [
        Quantity(symbol, notation, _ANGLE, systematic, "max(x̄_{i}) − min(x̄_{i})", _SPAN_OF_ANGLE),
        *(
            Quantity(
                f"{symbol}_{way}",
                f"{notation}{arrow}",
                name.given(name=_TURNED),
                systematic,
                f"max(x̄_{{i}}{arrow}) − min(x̄_{{i}}{arrow})",
                Words("The same of runs in one direction only."),
            )
            for way, (arrow, name) in _DIRECTIONS.items()
        ),
        Quantity(
            f"{symbol}_both",
            _add_index(notation, "both"),
            Words("Angular error over both directions"),
            systematic,
            "max(x̄_{i}↑; x̄_{i}↓) − min(x̄_{i}↑; x̄_{i}↓)",
            Words(
                "The largest turn between two positions if each is approached from its less favourable "
                "direction: the reversal is part of it."
            ),
            never_below=(symbol, *(f"{symbol}_{way}" for way in _DIRECTIONS)),
        ),
    ]


def _define_between(measurand: Measurand, symbol: str, notation: str) -> tuple[Quantity, ...]:
    """Return the angle between two lines, and the slopes that it is formed of."""
    is_parallelism = measurand is PARALLELISM
    meaning = Words(
        "How far the second axis moves off sideways, seen from the first: 1″ is 4.848 µm on a metre."
    )
    return (
        Quantity(
            symbol,
            notation,
            measurand.title,
            QuantityGroup.SYSTEMATIC,
            "m_{1} − m_{2}" if is_parallelism else FORMULAS[symbol],
            meaning,
        ),
        define_slope("slope_1", "m_{1}", Words("Slope of the first line")),
        define_slope("slope_2", "m_{2}", Words("Slope of the second line")),
    )


#: Of each squareness error, by the slopes of its two lines and the error ε of the square.
FORMULAS = {"C0Y": "−(m_{1} + m_{2}) + ε", "B0Z": "(m_{1} + m_{2}) − ε", "A0Z": "−(m_{1} + m_{2}) + ε"}
_COLUMNS = (
    PositionQuantity("d_fwd", "d̄_{i}↑", Words("Deviation from the reference line, positive direction")),
    PositionQuantity("d_bwd", "d̄_{i}↓", Words("Deviation from the reference line, negative direction")),
    PositionQuantity("d", "d̄_{i}", Words("Deviation from the reference line, mean of all runs")),
)
