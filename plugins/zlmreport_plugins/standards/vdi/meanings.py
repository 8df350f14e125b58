"""What the parameters mean: for parts made on a machine tool, for points measured on a measuring machine."""

from __future__ import annotations

from zlmreport.plugin import Words

#: VDI/DGQ 3441, by symbol.
OF_A_PART_MADE = {
    "P": Words(
        "The largest error, systematic and random together, that positioning is expected to bring into a "
        "dimension of a part, whichever the direction of approach.",
        "Die größte Abweichung, systematisch und zufällig zusammen, die das Positionieren in einem Maß des "
        "Werkstücks erwarten lässt, gleich aus welcher Richtung angefahren wird.",
    ),
    "Pa": Words(
        "The largest error of a dimension that remains on average over many like parts.",
        "Die größte Abweichung eines Maßes, die im Mittel über viele gleiche Werkstücke bleibt.",
    ),
    "U_max": Words(
        "The largest average shift of a feature when its position is approached from the other direction.",
        "Die größte mittlere Verschiebung eines Formelements, wenn seine Position aus der anderen Richtung "
        "angefahren wird.",
    ),
    "U_mean": Words(
        "The amount of that shift, averaged over the positions of the axis.",
        "Der Betrag dieser Verschiebung, gemittelt über die Positionen der Achse.",
    ),
    "Ps_max": Words(
        "The scatter to expect of a feature's place among like parts, at the position where it is largest.",
        "Die zu erwartende Streuung der Lage eines Formelements unter gleichen Werkstücken, an der Position "
        "mit der größten Streuung.",
    ),
    "Ps_mean": Words(
        "The scatter to expect of a feature's place among like parts, averaged over the positions.",
        "Die zu erwartende Streuung der Lage eines Formelements unter gleichen Werkstücken, gemittelt über "
        "die Positionen.",
    ),
}

#: VDI/VDE 2617, by symbol.
OF_A_POINT_MEASURED = {
    "P": Words(
        "The largest error, systematic and random together, to expect of a length measured along the axis, "
        "whichever the direction of approach.",
        "Die größte Abweichung, systematisch und zufällig zusammen, die an einer entlang der Achse "
        "gemessenen Länge zu erwarten ist, gleich aus welcher Richtung angefahren wird.",
    ),
    "Pa": Words(
        "The largest error of a measured length that remains on average over many measurements.",
        "Die größte Abweichung einer gemessenen Länge, die im Mittel über viele Messungen bleibt.",
    ),
    "U_max": Words(
        "The largest average change of a measured coordinate when its position is approached from the other "
        "direction.",
        "Die größte mittlere Änderung einer gemessenen Koordinate, wenn ihre Position aus der anderen "
        "Richtung angefahren wird.",
    ),
    "U_mean": Words(
        "The amount of that change, averaged over the positions of the axis.",
        "Der Betrag dieser Änderung, gemittelt über die Positionen der Achse.",
    ),
    "Ps_max": Words(
        "The scatter to expect of a repeatedly measured coordinate, at the position where it is largest.",
        "Die zu erwartende Streuung einer wiederholt gemessenen Koordinate, an der Position mit der größten "
        "Streuung.",
    ),
    "Ps_mean": Words(
        "The scatter to expect of a repeatedly measured coordinate, averaged over the positions.",
        "Die zu erwartende Streuung einer wiederholt gemessenen Koordinate, gemittelt über die Positionen.",
    ),
}
