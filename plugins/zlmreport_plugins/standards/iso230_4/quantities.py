"""The parameters of ISO 230-4:2005, as it defines and this program prints them."""

from __future__ import annotations

from zlmreport.plugin import Words
from zlmreport.plugin.standard import Quantity, QuantityGroup

#: How the two senses stand in symbols, and what they are called.
SENSES = {
    "ccw": Words("counter-clockwise", "Gegenuhrzeigersinn"),
    "cw": Words("clockwise", "Uhrzeigersinn"),
}
_CIRCULAR = Words("Circular deviation, {sense}", "Kreisformabweichung, {sense}")
_RADIAL = Words("{which} radial deviation, {sense}", "{which} Radialabweichung, {sense}")
_LARGEST = Words("Largest", "Größte")
_SMALLEST = Words("Smallest", "Kleinste")


def _circular(sense: str) -> Quantity:
    return Quantity(
        symbol=f"G_{sense}",
        notation=f"G({sense})",
        name=_CIRCULAR.given(sense=SENSES[sense]),
        group=QuantityGroup.SYSTEMATIC,
        formula=f"max(r({sense})) − min(r({sense}))",
        meaning=Words(
            "The radial distance of two circles about one centre that hold the path in this sense between "
            "them: the error of form of a circle that is milled so.",
            "Der radiale Abstand zweier Kreise um einen Mittelpunkt, zwischen denen die Bahn in diesem Sinn "
            "liegt: die Formabweichung eines so gefrästen Kreises.",
        ),
    )


def _radial(sense: str, which: str, words: Words) -> Quantity:
    return Quantity(
        symbol=f"F_{which}_{sense}",
        notation=f"F_{{{which}}}({sense})",
        name=_RADIAL.given(which=words, sense=SENSES[sense]),
        group=QuantityGroup.SYSTEMATIC,
        formula=f"{which}(r({sense}) − R)",
        meaning=Words(
            "How far the path in this sense lies outside (+) or inside (−) of the nominal circle at most.",
            "Wie weit die Bahn in diesem Sinn höchstens außerhalb (+) oder innerhalb (−) des Sollkreises "
            "liegt.",
        ),
    )


BOTH = Quantity(
    symbol="G_b",
    notation="G(b)",
    name=Words("Bidirectional circular deviation", "Zweiseitige Kreisformabweichung"),
    group=QuantityGroup.SYSTEMATIC,
    formula="max(r(ccw); r(cw)) − min(r(ccw); r(cw))",
    meaning=Words(
        "The radial distance of two circles about one centre that hold the paths of both senses between "
        "them.",
        "Der radiale Abstand zweier Kreise um einen Mittelpunkt, zwischen denen die Bahnen beider Sinne "
        "liegen.",
    ),
)
MEAN_RADIAL = Quantity(
    symbol="D",
    notation="D",
    name=Words("Mean bidirectional radial deviation", "Mittlere zweiseitige Radialabweichung"),
    group=QuantityGroup.SYSTEMATIC,
    formula="R_{LS}(ccw; cw) − R",
    meaning=Words(
        "By how much the circle of least squares through both paths is larger (+) or smaller (−) than the "
        "nominal one.",
        "Um wie viel der Kreis der kleinsten Quadrate durch beide Bahnen größer (+) oder kleiner (−) ist als "
        "der Sollkreis.",
    ),
)
#: In the order of the results table.
QUANTITIES: tuple[Quantity, ...] = (
    *map(_circular, SENSES),
    BOTH,
    *(
        _radial(sense, which, words)
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
        "that of the set-up.",
        "r ist der Abstand der Bahn von ihrem Mittelpunkt, R der Sollradius. ccw: im Gegenuhrzeigersinn, von "
        "der ersten Achse der Ebene zur zweiten; cw: im Uhrzeigersinn. Für G ist der Mittelpunkt der der "
        "beiden Kreise, die einander am nächsten liegen (Minimalzone), sofern das Diagramm nicht den des "
        "Kreises der kleinsten Quadrate nennt; für F ist es der des Kreises der kleinsten Quadrate der Bahn, "
        "bei einem Bogen der der Aufspannung.",
    ),
    Words(
        "The path of a sense is the mean of its turns; that of a single turn holds its random part too.",
        "Die Bahn eines Drehsinns ist das Mittel seiner Umläufe; die eines einzelnen Umlaufs enthält auch "
        "dessen zufälligen Anteil.",
    ),
    Words(
        "Names and definitions as this program reads the standard; that the edition of 2005 has the "
        "bidirectional deviation G(b) in place of the hysteresis H of 1996 is published in its foreword.",
        "Benennungen und Definitionen, wie dieses Programm die Norm versteht; dass die Ausgabe 2005 anstelle "
        "der Hysterese H von 1996 die zweiseitige Abweichung G(b) hat, steht in ihrem veröffentlichten "
        "Vorwort.",
    ),
)
