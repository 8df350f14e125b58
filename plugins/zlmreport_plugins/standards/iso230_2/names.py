"""What ISO 230-2 calls its parameters, edition by edition."""

from __future__ import annotations

from zlmreport.plugin import Words

_SINCE_1988 = {
    "A": Words("Bidirectional accuracy of positioning", "Zweiseitige Positioniergenauigkeit"),
    "A_fwd": Words(
        "Unidirectional accuracy of positioning, positive direction",
        "Einseitige Positioniergenauigkeit, positive Richtung",
    ),
    "A_bwd": Words(
        "Unidirectional accuracy of positioning, negative direction",
        "Einseitige Positioniergenauigkeit, negative Richtung",
    ),
    "E": Words(
        "Bidirectional systematic positional deviation", "Zweiseitige systematische Positionsabweichung"
    ),
    "E_fwd": Words(
        "Unidirectional systematic positional deviation, positive direction",
        "Einseitige systematische Positionsabweichung, positive Richtung",
    ),
    "E_bwd": Words(
        "Unidirectional systematic positional deviation, negative direction",
        "Einseitige systematische Positionsabweichung, negative Richtung",
    ),
    "M": Words(
        "Range of the mean bidirectional positional deviation",
        "Spannweite der mittleren zweiseitigen Positionsabweichung",
    ),
    "R": Words("Bidirectional repeatability of positioning", "Zweiseitige Wiederholgenauigkeit"),
    "R_fwd": Words(
        "Unidirectional repeatability of positioning, positive direction",
        "Einseitige Wiederholgenauigkeit, positive Richtung",
    ),
    "R_bwd": Words(
        "Unidirectional repeatability of positioning, negative direction",
        "Einseitige Wiederholgenauigkeit, negative Richtung",
    ),
    "B": Words("Reversal value", "Umkehrspanne"),
    "B_mean": Words("Mean reversal value", "Mittlere Umkehrspanne"),
}

_SINCE_2006 = _SINCE_1988 | {
    "B": Words("Reversal error", "Umkehrspanne"),
    "B_mean": Words("Mean reversal error", "Mittlere Umkehrspanne"),
}

_SINCE_2014 = _SINCE_2006 | {
    "A": Words(
        "Bidirectional positioning error (accuracy)", "Zweiseitige Positionierabweichung (Genauigkeit)"
    ),
    "A_fwd": Words(
        "Unidirectional positioning error (accuracy), positive direction",
        "Einseitige Positionierabweichung (Genauigkeit), positive Richtung",
    ),
    "A_bwd": Words(
        "Unidirectional positioning error (accuracy), negative direction",
        "Einseitige Positionierabweichung (Genauigkeit), negative Richtung",
    ),
    "E": Words(
        "Bidirectional systematic positioning error", "Zweiseitige systematische Positionierabweichung"
    ),
    "E_fwd": Words(
        "Unidirectional systematic positioning error, positive direction",
        "Einseitige systematische Positionierabweichung, positive Richtung",
    ),
    "E_bwd": Words(
        "Unidirectional systematic positioning error, negative direction",
        "Einseitige systematische Positionierabweichung, negative Richtung",
    ),
    "M": Words("Mean bidirectional positioning error", "Mittlere zweiseitige Positionierabweichung"),
    "R": Words("Bidirectional positioning repeatability", "Zweiseitige Positionier-Wiederholgenauigkeit"),
    "R_fwd": Words(
        "Unidirectional positioning repeatability, positive direction",
        "Einseitige Positionier-Wiederholgenauigkeit, positive Richtung",
    ),
    "R_bwd": Words(
        "Unidirectional positioning repeatability, negative direction",
        "Einseitige Positionier-Wiederholgenauigkeit, negative Richtung",
    ),
}

#: The names by year of the edition, then by symbol.
NAMES = {1988: _SINCE_1988, 1997: _SINCE_1988, 2006: _SINCE_2006, 2014: _SINCE_2014}
