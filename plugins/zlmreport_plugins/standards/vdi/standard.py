"""A guideline as a standard that a job can name."""

from __future__ import annotations

from collections.abc import Iterable

from zlmreport.plugin import (
    Arithmetic,
    Evaluation,
    Figure,
    Finding,
    MeasurementSet,
    Options,
    PositionStatistics,
)
from zlmreport_plugins.standards.vdi import figures, formulas, notes, quantities, requirements
from zlmreport_plugins.standards.vdi.guidelines import Guideline


class VdiGuideline:
    """VDI/DGQ 3441 or VDI/VDE 2617.

    Parameters
    ----------
    guideline
        A row of the table of guidelines.
    """

    position_index = "j"
    options = Options
    position_quantities = quantities.BY_POSITION

    def __init__(self, guideline: Guideline) -> None:
        self.guideline = guideline
        self.identifier = guideline.identifier
        self.designation = guideline.designation
        self.title = guideline.title
        self.quantities = quantities.parameters(guideline)
        self.notes = notes.notes(guideline)

    def requirements(self, measurements: MeasurementSet, options: Options) -> Iterable[Finding]:  # noqa: ARG002 - no keys of its own
        """Hold the guideline's requirements against the test."""
        return requirements.findings(self.guideline, measurements)

    def arithmetic(self, statistics: PositionStatistics, options: Options) -> Arithmetic:  # noqa: ARG002 - no keys of its own
        """Return the guideline's parameters, and U_j and P_sj by position."""
        factor = self.guideline.factor
        return Arithmetic(formulas.parameters(statistics, factor), formulas.positions(statistics, factor))

    def figures(self, evaluation: Evaluation, options: Options) -> Iterable[Figure]:  # noqa: ARG002 - no keys of its own
        """Return the guideline's two diagrams."""
        return figures.figures(evaluation)
