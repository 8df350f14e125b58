"""What a reader of results by the guidelines must know."""

from __future__ import annotations

from zlmreport.plugin import Words
from zlmreport_plugins.standards.vdi.guidelines import Guideline

_WIDTHS = Words(
    "All parameters are full widths, not ± values. The position spread is {k} times the sum of the standard "
    "deviations (n − 1) of both directions; the limits lie half the sum of reversal span and position spread "
    "to either side of the mean.",
    "Alle Kenngrößen sind volle Breiten, keine ±-Werte. Die Positionsstreubreite ist das {k}-Fache der Summe "
    "der Standardabweichungen (n − 1) beider Richtungen; die Grenzen liegen um die halbe Summe aus "
    "Umkehrspanne und Positionsstreubreite beiderseits des Mittelwerts.",
)
_NOT_ACCURACY = Words(
    "P averages the scatter of both directions and therefore differs from the A of ISO 230-2, even at the "
    "same number of standard deviations.",
    "P mittelt die Streuung beider Richtungen und unterscheidet sich daher von A nach ISO 230-2, auch bei "
    "gleicher Anzahl von Standardabweichungen.",
)
_INDEX = Words(
    "The reversal span is an amount without sign. The index mit marks a mean over the positions.",
    "Die Umkehrspanne ist ein Betrag ohne Vorzeichen. Der Index mit (mittel) bezeichnet ein Mittel über die "
    "Positionen.",
)
_SOURCE = Words(
    "Formulas as in the manual of the program ZLM Position, G 1.3.",
    "Formeln nach dem Handbuch des Programms ZLM Position, G 1.3.",
)


def notes(guideline: Guideline) -> tuple[Words, ...]:
    """Return the notes of a guideline."""
    return (_WIDTHS.given(k=guideline.factor), _NOT_ACCURACY, _INDEX, _SOURCE)
