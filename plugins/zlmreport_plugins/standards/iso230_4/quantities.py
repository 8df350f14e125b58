"""The parameters of ISO 230-4:2005, as it defines and this program prints them."""

from __future__ import annotations

from zlmreport.plugin import Words
from zlmreport.plugin.standard import Quantity, QuantityGroup

#: How the two senses stand in symbols, and what they are called.
SENSES = {
    "ccw": Words("counter-clockwise"),
    "cw": Words("clockwise"),
}
_RADIAL = Words("{which} radial deviation, {sense}")
_LARGEST = Words("Largest")
_SMALLEST = Words("Smallest")


def _define_circular(sense: str) -> Quantity:
    return Quantity(
        symbol=f"G_{sense}",
        notation=f"G({sense})",
        name=Words("Circular deviation, {sense}").given(sense=SENSES[sense]),
        group=QuantityGroup.SYSTEMATIC,
        formula=f"max(r({sense})) − min(r({sense}))",
        meaning=Words(
            "The radial distance of two circles about one centre that hold the path in this sense between "
            "them: the error of form of a circle that is milled so."
        ),
    )


def _define_radial(sense: str, which: str, words: Words) -> Quantity:
    return Quantity(
        symbol=f"F_{which}_{sense}",
        notation=f"F_{{{which}}}({sense})",
        name=_RADIAL.given(which=words, sense=SENSES[sense]),
        group=QuantityGroup.SYSTEMATIC,
        formula=f"{which}(r({sense}) − R)",
        meaning=Words(
            "How far the path in this sense lies outside (+) or inside (−) of the nominal circle at most."
        ),
    )


BOTH = Quantity(
    symbol="G_b",
    notation="G(b)",
    name=Words("Bidirectional circular deviation"),
    group=QuantityGroup.SYSTEMATIC,
    formula="max(r(ccw); r(cw)) − min(r(ccw); r(cw))",
    meaning=Words(
        "The radial distance of two circles about one centre that hold the paths of both senses between them."
    ),
    never_below=tuple(f"G_{sense}" for sense in SENSES),
)
MEAN_RADIAL = Quantity(
    symbol="D",
    notation="D",
    name=Words("Mean bidirectional radial deviation"),
    group=QuantityGroup.SYSTEMATIC,
    formula="R_{LS}(ccw; cw) − R",
    meaning=Words(
        "By how much the circle of least squares through both paths is larger (+) or smaller (−) than the "
        "nominal one."
    ),
)
#: In the order of the results table.
QUANTITIES: tuple[Quantity, ...] = (
    *map(_define_circular, SENSES),
    BOTH,
    *(
        _define_radial(sense, which, words)
        for sense in SENSES
        for which, words in (("max", _LARGEST), ("min", _SMALLEST))
    ),
    MEAN_RADIAL,
)

NOTES: tuple[Words, ...] = (
    Words(
        "r is the distance of the path from its centre, R the nominal radius. ccw: counter-clockwise, from "
        "the first axis of the plane towards the second; cw: clockwise. For G the centre is that of the two "
        "circles that are nearest to each other (minimum zone), unless the graph says that it is that of the "
        "circle of least squares; for F it is that of the circle of least squares of the path, and of an arc "
        "that of the set-up."
    ),
    Words("The path of a sense is the mean of its turns; that of a single turn holds its random part too."),
    Words(
        "Names and definitions as this program reads the standard; that the edition of 2005 has the "
        "bidirectional deviation G(b) in place of the hysteresis H of 1996 is published in its foreword."
    ),
)
