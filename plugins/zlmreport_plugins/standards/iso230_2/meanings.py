"""What the parameters of ISO 230-2 mean for a part that is made on the machine."""

from __future__ import annotations

from zlmreport.plugin import Words

_ALWAYS_POSITIVE = Words(
    "all positions are approached in the positive direction",
    "alle Positionen in positiver Richtung angefahren werden",
)
_ALWAYS_NEGATIVE = Words(
    "all positions are approached in the negative direction",
    "alle Positionen in negativer Richtung angefahren werden",
)
_ACCURACY = Words(
    "The largest error, systematic and random together, that positioning is expected to bring into a "
    "dimension of a part if {condition}.",
    "Die größte Abweichung, systematisch und zufällig zusammen, die das Positionieren in einem Maß des "
    "Werkstücks erwarten lässt, wenn {condition}.",
)
_SYSTEMATIC = Words(
    "The largest error of a dimension that remains on average over many like parts if {condition}.",
    "Die größte Abweichung eines Maßes, die im Mittel über viele gleiche Werkstücke bleibt, wenn "
    "{condition}.",
)
_REPEATABILITY = Words(
    "The largest scatter to expect of a feature's place among like parts if {condition}.",
    "Die größte zu erwartende Streuung der Lage eines Formelements unter gleichen Werkstücken, wenn "
    "{condition}.",
)
#: One sentence for each symbol.
MEANINGS = {
    "A": _ACCURACY.given(
        condition=Words(
            "positions are approached from either direction",
            "Positionen aus beiden Richtungen angefahren werden",
        )
    ),
    "A_fwd": _ACCURACY.given(condition=_ALWAYS_POSITIVE),
    "A_bwd": _ACCURACY.given(condition=_ALWAYS_NEGATIVE),
    "E": _SYSTEMATIC.given(
        condition=Words(
            "each position is approached from its less favourable direction",
            "jede Position aus der jeweils ungünstigeren Richtung angefahren wird",
        )
    ),
    "E_fwd": _SYSTEMATIC.given(condition=_ALWAYS_POSITIVE),
    "E_bwd": _SYSTEMATIC.given(condition=_ALWAYS_NEGATIVE),
    "M": _SYSTEMATIC.given(
        condition=Words(
            "each position is approached from both directions equally often",
            "jede Position aus beiden Richtungen gleich oft angefahren wird",
        )
    ),
    "R": _REPEATABILITY.given(
        condition=Words(
            "it is approached now from one direction, now from the other: the reversal is part of it",
            "es bald aus der einen, bald aus der anderen Richtung angefahren wird: die Umkehrspanne "
            "gehört dazu",
        )
    ),
    "R_fwd": _REPEATABILITY.given(condition=_ALWAYS_POSITIVE),
    "R_bwd": _REPEATABILITY.given(condition=_ALWAYS_NEGATIVE),
    "B": Words(
        "The largest average shift of a feature when its position is approached from the other direction.",
        "Die größte mittlere Verschiebung eines Formelements, wenn seine Position aus der anderen Richtung "
        "angefahren wird.",
    ),
    "B_mean": Words(
        "The average over the axis of the shift of features when their positions are approached from the "
        "other direction.",
        "Die über die Achse gemittelte Verschiebung von Formelementen, wenn ihre Positionen aus der anderen "
        "Richtung angefahren werden.",
    ),
}
