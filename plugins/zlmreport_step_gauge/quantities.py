"""The parameters and columns: names, formulas, meanings, notes."""

from __future__ import annotations

from zlmreport.plugin import (
    PositionQuantity,
    Quantity,
    QuantityGroup,
    Words,
)

_BANDWIDTH = Words(
    "The largest systematic error of a length between two positions of the line{condition}.",
    "Die größte systematische Abweichung einer Länge zwischen zwei Positionen der Linie{condition}.",
)
_REPEATABILITY = Words(
    "How far repeated touches of one face scatter at the worst face{condition}: two standard deviations, to "
    "either side of the mean.",
    "Wie weit wiederholte Antastungen einer Fläche an der ungünstigsten Fläche streuen{condition}: zwei "
    "Standardabweichungen, beiderseits des Mittelwerts.",
)
_NOTHING = Words("", "")
_FORWARD = Words(", touched forward", ", vorwärts angetastet")
_BACKWARD = Words(", touched backward", ", rückwärts angetastet")

#: The parameters of the line in the order of the results table.
PARAMETERS: tuple[Quantity, ...] = (
    Quantity(
        "W",
        "W",
        Words("Bandwidth", "Bandbreite"),
        QuantityGroup.SYSTEMATIC,
        "max(XF_{i}; XB_{i}) − min(XF_{i}; XB_{i})",
        _BANDWIDTH.given(condition=_NOTHING),
    ),
    Quantity(
        "W_fwd",
        "W↑",
        Words("Bandwidth, forward", "Bandbreite, vorwärts"),
        QuantityGroup.SYSTEMATIC,
        "max(XF_{i}) − min(XF_{i})",
        _BANDWIDTH.given(condition=_FORWARD),
    ),
    Quantity(
        "W_bwd",
        "W↓",
        Words("Bandwidth, backward", "Bandbreite, rückwärts"),
        QuantityGroup.SYSTEMATIC,
        "max(XB_{i}) − min(XB_{i})",
        _BANDWIDTH.given(condition=_BACKWARD),
    ),
    Quantity(
        "S2",
        "2S",
        Words("Repeatability", "Wiederholpräzision"),
        QuantityGroup.RANDOM,
        "max(2SF_{i}; 2SB_{i})",
        _REPEATABILITY.given(condition=_NOTHING),
    ),
    Quantity(
        "S2_fwd",
        "2S↑",
        Words("Repeatability, forward", "Wiederholpräzision, vorwärts"),
        QuantityGroup.RANDOM,
        "max(2SF_{i})",
        _REPEATABILITY.given(condition=_FORWARD),
    ),
    Quantity(
        "S2_bwd",
        "2S↓",
        Words("Repeatability, backward", "Wiederholpräzision, rückwärts"),
        QuantityGroup.RANDOM,
        "max(2SB_{i})",
        _REPEATABILITY.given(condition=_BACKWARD),
    ),
    Quantity(
        "XR",
        "XR",
        Words("Largest reversal error", "Größte Umkehrabweichung"),
        QuantityGroup.SYSTEMATIC,
        "max(|XR_{i}|), XR_{i} = XB_{i} − XF_{i}",
        Words(
            "The largest difference that the direction of probing makes to a position.",
            "Der größte Unterschied, den die Antastrichtung an einer Position ausmacht.",
        ),
    ),
    Quantity(
        "XR_mean",
        "X̄R",
        Words("Mean reversal error", "Mittlere Umkehrabweichung"),
        QuantityGroup.SYSTEMATIC,
        "(1/m) · ∑ XR_{i}",
        Words(
            "The difference that the direction of probing makes on average, with sign.",
            "Der Unterschied, den die Antastrichtung im Mittel ausmacht, mit Vorzeichen.",
        ),
        can_be_limited=False,
    ),
    Quantity(
        "B_mean",
        "B̄",
        Words(
            "Mean reversal error with the sign of ISO 230-2",
            "Mittlere Umkehrabweichung mit dem Vorzeichen von ISO 230-2",
        ),
        QuantityGroup.SYSTEMATIC,
        "−X̄R",
        Words(
            "The same as the mean of the positive minus that of the negative direction.",
            "Dasselbe als Mittelwert der positiven minus dem der negativen Richtung.",
        ),
        can_be_limited=False,
    ),
)

#: The columns of the table by position.
BY_POSITION: tuple[PositionQuantity, ...] = (
    PositionQuantity("XF", "XF_{i}", Words("Forward positional error", "Abweichung vorwärts")),
    PositionQuantity("XB", "XB_{i}", Words("Backward positional error", "Abweichung rückwärts")),
    PositionQuantity("XM", "XM_{i}", Words("Mean positional error", "Mittlere Abweichung")),
    PositionQuantity(
        "S2F", "2SF_{i}", Words("Two standard deviations, forward", "Zwei Standardabweichungen, vorwärts")
    ),
    PositionQuantity(
        "S2B", "2SB_{i}", Words("Two standard deviations, backward", "Zwei Standardabweichungen, rückwärts")
    ),
    PositionQuantity("XR", "XR_{i}", Words("Reversal error", "Umkehrabweichung")),
    PositionQuantity(
        "B",
        "B_{i}",
        Words(
            "Reversal error with the sign of ISO 230-2", "Umkehrabweichung mit dem Vorzeichen von ISO 230-2"
        ),
    ),
)

#: What a reader of the results must know.
NOTES: tuple[Words, ...] = (
    Words(
        "Formulas as in H. Pahk and J. Kim, Development of computer aided calibration module for CMMs and "
        "machine tools using a compensated step gauge, Eq. 1 to 13. Bandwidth and repeatability are defined "
        "there by example only: the definitions above are those of this program.",
        "Formeln nach H. Pahk und J. Kim, Development of computer aided calibration module for CMMs and "
        "machine tools using a compensated step gauge, Gl. 1 bis 13. Bandbreite und Wiederholpräzision sind "
        "dort nur am Beispiel erklärt: die Definitionen oben sind die dieses Programms.",
    ),
    Words(
        "XF, SF at a back face and XB, SB at a front face are interpolated: the mean of the two neighbours "
        "(Eq. 8 to 11). In the table by position they stand where x̄ and s of that direction are missing; in "
        "the graph marks stand at measured values only. At the ends of the section nothing is extrapolated.",
        "XF, SF an einer Rückfläche und XB, SB an einer Vorderfläche sind interpoliert: Mittel der beiden "
        "Nachbarn (Gl. 8 bis 11). In der Tabelle nach Sollposition stehen sie dort, wo x̄ und s dieser "
        "Richtung fehlen; im Diagramm tragen nur gemessene Werte eine Marke. An den Enden des Abschnitts "
        "wird nichts extrapoliert.",
    ),
    Words(
        "S is a single standard deviation (n − 1); what is stated is twice that. XR = XB − XF has the sign "
        "opposite to that of the reversal value B of ISO 230-2, which stands beside it.",
        "S ist die einfache Standardabweichung (n − 1); angegeben ist das Doppelte. XR = XB − XF hat das "
        "entgegengesetzte Vorzeichen der Umkehrspanne B nach ISO 230-2, die daneben steht.",
    ),
    Words(
        "All errors are relative to the first face of the section, where the forward error is zero by "
        "definition.",
        "Alle Abweichungen beziehen sich auf die erste Fläche des Abschnitts, an der die Abweichung vorwärts "
        "nach Definition null ist.",
    ),
)
