"""The evaluation of a step gauge as a standard that a job can name."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from zlmreport.evaluation.checks.readings import no_missing_readings, number_of_runs
from zlmreport.evaluation.evaluation import Arithmetic, Evaluation
from zlmreport.evaluation.requirements import Basis, Finding
from zlmreport.evaluation.statistics import PositionStatistics
from zlmreport.figures.figure import Figure
from zlmreport.job.types import Options
from zlmreport.language import Words
from zlmreport.measurement.measurement_set import MeasurementSet
from zlmreport_plugins.standards.step_gauge import figures, formulas, words

_RUNS_FOR_A_SCATTER = 2


class StepGaugeEvaluation:
    """Linear displacement accuracy by step gauge, after Pahk and Kim, sections 4.1 and 4.2."""

    identifier = "step-gauge"
    designation = "Pahk & Kim 4.1, 4.2"
    position_index = "i"
    title = Words(
        "Linear displacement accuracy by step gauge", "Längenabweichung nach Messung eines Stufenendmaßes"
    )
    options = Options
    quantities = words.PARAMETERS
    position_quantities = words.BY_POSITION
    notes = words.NOTES

    def requirements(self, measurements: MeasurementSet, options: Options) -> Iterable[Finding]:  # noqa: ARG002 - no keys of its own
        """Hold what the formulas need against the test."""
        return _findings(measurements)

    def arithmetic(self, statistics: PositionStatistics, options: Options) -> Arithmetic:  # noqa: ARG002 - no keys of its own
        """Return the parameters, and errors and reversal by position."""
        return formulas.arithmetic(statistics)

    def figures(self, evaluation: Evaluation, options: Options) -> Iterable[Figure]:  # noqa: ARG002 - no keys of its own
        """Return the graphs of errors and of the reversal."""
        return figures.figures(evaluation)


def _findings(measurements: MeasurementSet) -> Iterator[Finding]:
    yield number_of_runs(measurements, _RUNS_FOR_A_SCATTER, Basis.APPLIED)
    yield no_missing_readings(measurements)
    if measurements.is_bidirectional:
        yield _radius_from_elsewhere(measurements)


def _radius_from_elsewhere(measurements: MeasurementSet) -> Finding:
    """Ask that what parts the directions is the machine and not what was taken for the probe's radius."""
    requirement = Words(
        "An effective radius of the probe that is known from elsewhere, for the reversal error",
        "Ein anderweitig bekannter wirksamer Tastkugelradius, für die Umkehrabweichung",
    )
    if not measurements.reversal_is_relative:
        known = Words("known from elsewhere", "anderweitig bekannt")
        return Finding(requirement, known, met=True)
    found = Words(
        "determined from the blocks of the gauge: XR and B are relative to their mean within a block",
        "aus den Blöcken des Stufenendmaßes bestimmt: XR und B sind relativ zu ihrem Mittel innerhalb eines "
        "Blocks",
    )
    return Finding(requirement, found, met=False)
