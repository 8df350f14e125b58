"""How many targets and runs: as few as meet the requirements of the standards, and what custom adds."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from typing import Any, Protocol, TypeAlias

import numpy as np

from zlmreport.evaluation.requirements import Finding
from zlmreport.measurement.approach import Approach
from zlmreport.measurement.axis import Axis, AxisKind
from zlmreport.measurement.measurement_set import MeasurementSet
from zlmreport.planning.methods import Method
from zlmreport.quantities.arrays import FloatArray, read_only_floats, read_only_integers

#: Where a job names no number: targets in all, and the interval that is not exceeded where these are not
#: too many, m or rad.
_LEAST_TARGETS, _MOST_TARGETS = 11, 101
_LARGEST_INTERVAL = {AxisKind.LINEAR: 0.1, AxisKind.ROTARY: math.radians(30)}
_FURTHER_TARGETS = 60
#: Runs in the order in which they are tried: the first that meets most requirements is taken.
_RUNS = (5, 1, 2, 3, 4, 6, 7, 8, 9, 10)
_ROUNDING = 1e-9


class DemandingStandard(Protocol):
    """The part of a standard that a plan needs (the whole: `zlmreport.plugin.protocols.Standard`)."""

    designation: str

    def requirements(self, measurements: MeasurementSet, options: Any) -> Iterable[Finding]:
        """Hold the standard's requirements against the test."""


#: A standard with its own job keys.
PlannedStandard: TypeAlias = tuple[DemandingStandard, Any]


def chosen_count(
    axis: Axis,
    method: Method,
    runs: int | None,
    drawn: Callable[[int], FloatArray],
    standards: Sequence[PlannedStandard],
) -> int:
    """Return the least number of targets that meets as many requirements as can be met.

    Parameters
    ----------
    axis
        An axis with a travel.
    method
        The positioning method.
    runs
        Where the job states them.
    drawn
        Returns targets by their number.
    standards
        Those of the job.
    """
    assert axis.travel is not None  # noqa: S101 - the caller has seen to it
    intervals = math.ceil((axis.travel[1] - axis.travel[0]) / _LARGEST_INTERVAL[axis.kind] - _ROUNDING)
    least = min(max(_LEAST_TARGETS, intervals + 1), _MOST_TARGETS)
    runs = runs or chosen_runs(axis, method, drawn(least), standards)
    unmet = []
    for count in range(least, least + _FURTHER_TARGETS):
        unmet.append(_unmet(as_measured(axis, method, drawn(count), runs), standards))
        if unmet[-1] == 0:
            break
    return least + unmet.index(min(unmet))


def chosen_runs(axis: Axis, method: Method, targets: FloatArray, standards: Sequence[PlannedStandard]) -> int:
    """Return the number of runs that meets most requirements; 5 if several do."""
    return min(_RUNS, key=lambda runs: _unmet(as_measured(axis, method, targets, runs), standards))


def as_measured(axis: Axis, method: Method, targets: FloatArray, runs: int) -> MeasurementSet:
    """Return a test as standards would see it once it is done; its deviations are zero."""
    approaches = [Approach.POSITIVE] if method is Method.UNIDIRECTIONAL else list(Approach)
    run, approach, target = np.meshgrid(
        np.arange(1, runs + 1), [int(each) for each in approaches], np.arange(len(targets)), indexing="ij"
    )
    return MeasurementSet(
        axis=axis,
        target_positions=targets,
        target=read_only_integers(target.ravel()),
        approach=read_only_integers(approach.ravel()),
        run=read_only_integers(run.ravel()),
        deviation=read_only_floats(np.zeros(target.size)),
    )


def _unmet(measurements: MeasurementSet, standards: Sequence[PlannedStandard]) -> int:
    return sum(
        finding.met is False
        for standard, options in standards
        for finding in standard.requirements(measurements, options)
    )
