"""The NMTBA recommendation as a standard that a job can name."""

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
    Words,
)
from zlmreport_plugins.standards.nmtba import figures, formulas, requirements, words


class Nmtba:
    """The NMTBA recommendation of 1972."""

    identifier = "nmtba"
    designation = "NMTBA (1972)"
    position_index = "j"
    title = Words(
        "Positioning accuracy of numerically controlled machine tools",
        "Positioniergenauigkeit numerisch gesteuerter Werkzeugmaschinen",
    )
    options = Options
    quantities = words.PARAMETERS
    position_quantities = words.BY_POSITION
    notes = words.NOTES

    def requirements(self, measurements: MeasurementSet, options: Options) -> Iterable[Finding]:  # noqa: ARG002 - no keys of its own
        """Hold the requirements against the test."""
        return requirements.findings(measurements)

    def arithmetic(self, statistics: PositionStatistics, options: Options) -> Arithmetic:  # noqa: ARG002 - no keys of its own
        """Return the parameters, and X̄_j and P_sj by position."""
        mean = formulas.mean_deviation(statistics)
        spread = formulas.position_spread(statistics, mean)
        return Arithmetic(formulas.parameters(mean, spread), {"X": mean, "Ps": spread})

    def figures(self, evaluation: Evaluation, options: Options) -> Iterable[Figure]:  # noqa: ARG002 - no keys of its own
        """Return the two diagrams."""
        return figures.figures(evaluation)
