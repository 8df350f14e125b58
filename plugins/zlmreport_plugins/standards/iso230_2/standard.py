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
from zlmreport_plugins.standards.iso230_2 import figures, formulas, notes, quantities, requirements
from zlmreport_plugins.standards.iso230_2.editions import Edition


class Iso230Part2:
    """ISO 230-2 in one edition.

    Parameters
    ----------
    edition
        A row of the table of editions.
    """

    title = Words(
        "Accuracy and repeatability of positioning of numerically controlled axes",
        "Genauigkeit und Wiederholgenauigkeit der Positionierung numerisch gesteuerter Achsen",
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
        self.notes = notes.notes(edition)

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
