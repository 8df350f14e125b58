"""An edition of ISO 230-2 as a standard that a job can name."""

from __future__ import annotations

from collections.abc import Iterable

from zlmreport.plugin import (
    Arithmetic,
    Evaluation,
    Figure,
    Finding,
    Information,
    MeasurementSet,
    Options,
    PositionStatistics,
    Words,
)
from zlmreport_plugins.standards.iso230_2 import figures, formulas, quantities, requirements
from zlmreport_plugins.standards.iso230_2.editions import Edition

_FULL_WIDTHS = Words(
    "All parameters are full widths, not ± values. The limits lie {k} standard deviations (n − 1) to either "
    "side of the mean of one direction.",
    "Alle Kenngrößen sind volle Spannweiten, keine ±-Werte. Die Grenzen liegen {k} Standardabweichungen "
    "(n − 1) beiderseits des Mittelwerts einer Richtung.",
)
_REPEATABILITY = Words(
    "R is the largest bidirectional repeatability of a position; it contains the reversal there and can "
    "exceed both R↑ and R↓.",
    "R ist die größte zweiseitige Wiederholpräzision einer Position; sie enthält die dortige Umkehrspanne "
    "und kann R↑ und R↓ übersteigen.",
)
_REVERSAL = Words(
    "The reversal at a position is the mean of the positive minus the mean of the negative direction. B is "
    "its largest amount, B̄ its mean over the positions with sign.",
    "Die Umkehrspanne einer Position ist der Mittelwert der positiven minus dem der negativen Richtung. B "
    "ist ihr größter Betrag, B̄ ihr Mittel über die Positionen mit Vorzeichen.",
)
_OPPOSITE_REVERSAL = Words(
    "B̄ is printed with the sign of this edition: the mean of the negative minus the mean of the positive "
    "direction. The table by position and the results file take the positive minus the negative direction.",
    "B̄ ist mit dem Vorzeichen dieser Ausgabe gedruckt: Mittelwert der negativen minus Mittelwert der "
    "positiven Richtung. Die Tabelle nach Sollposition und die Ergebnisdatei rechnen positive minus negative "
    "Richtung.",
)
_NOT_COMPARABLE = Words(
    "Limits at 3 standard deviations make A and R larger than by the editions since 1997, which take 2: the "
    "values are not to be compared. This edition defines neither E nor M.",
    "Grenzen bei 3 Standardabweichungen machen A und R größer als nach den Ausgaben seit 1997, die 2 "
    "verwenden: die Werte sind nicht vergleichbar. Diese Ausgabe kennt weder E noch M.",
)
_SOURCE = Words(
    "Formulas as in the manual of the program ZLM Position, G 1.3; corrected: bars over the means of the "
    "mean reversal value, targets P = N·p + r.",
    "Formeln nach dem Handbuch des Programms ZLM Position, G 1.3; berichtigt: Querstriche über den "
    "Mittelwerten der mittleren Umkehrspanne, Sollpositionen P = N·p + r.",
)


def notes(edition: Edition) -> tuple[Words, ...]:
    """Return the notes of an edition."""
    general = (_FULL_WIDTHS.given(k=edition.coverage_factor), _REPEATABILITY)
    if edition.prints_reversal_as_negative_minus_positive:
        return (*general, _OPPOSITE_REVERSAL, _NOT_COMPARABLE, _SOURCE)
    return (*general, _REVERSAL)


class Iso230Part2:
    """ISO 230-2 in one edition.

    Parameters
    ----------
    edition
        A row of the table of editions.
    """

    title = Words(
        "Accuracy and repeatability of positioning of numerically controlled axes",
        "Genauigkeit und Wiederholpräzision der Positionierung numerisch gesteuerter Achsen",
    )
    options = Options
    information = tuple(Information)

    def __init__(self, edition: Edition) -> None:
        self.edition = edition
        self.identifier = f"iso230-2:{edition.year}"
        self.designation = f"ISO 230-2:{edition.year}"
        self.position_index = edition.position_index
        self.quantities = quantities.parameters(edition)
        self.position_quantities = quantities.by_position(edition)
        self.notes = notes(edition)

    def requirements(self, measurements: MeasurementSet, options: Options) -> Iterable[Finding]:  # noqa: ARG002 - no keys of its own
        """Hold the edition's test design against the test."""
        return requirements.findings(self.edition, measurements)

    def arithmetic(self, statistics: PositionStatistics, options: Options) -> Arithmetic:  # noqa: ARG002 - no keys of its own
        """Return the edition's parameters and R_i by position."""
        k = self.edition.coverage_factor
        by_position = formulas.positions(statistics, k)
        parameters = formulas.parameters(statistics, k, by_position)
        reported = {quantity.symbol: parameters[quantity.symbol] for quantity in self.quantities}
        return Arithmetic(reported, by_position)

    def figures(self, evaluation: Evaluation, options: Options) -> Iterable[Figure]:  # noqa: ARG002 - no keys of its own
        """Return the bidirectional graphs and the graph of both directions one by one."""
        return figures.figures(self.edition, evaluation)
