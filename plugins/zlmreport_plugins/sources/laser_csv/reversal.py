"""Straightness by reversal: two tables, of the artefact as it lay and turned over.

A mirror is turned by 180° about the beam (optical reversal), a straightedge over its long edge. Readings
stand in the axis's own sense in both tables: what the axis does comes twice with the same sign, what the
artefact is once with each. Their mean is the axis, half their difference the artefact.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Literal

import numpy as np
from pydantic import Field

from zlmreport.plugin import (
    STRAIGHTNESS,
    Approach,
    FloatArray,
    InputError,
    JobPath,
    MeasurementSet,
    Options,
    Place,
    Problem,
    Words,
    read_only_floats,
)
from zlmreport.plugin.source import Provenance, SourceContext
from zlmreport_plugins.sources.laser_csv import LaserCsv
from zlmreport_plugins.sources.laser_csv.options import LaserCsvOptions

_FEWEST = 3
_ARTEFACTS = {
    "mirror": Words("the mirror turned by 180°"),
    "straightedge": Words("the straightedge turned over"),
}
_MEAN = Words(
    "Readings are the means of two tables, the second with {artefact}: the axis's own straightness. "
    "Half their difference, the artefact's, is {size} µm about its least squares line."
)


class ReversalOptions(LaserCsvOptions):
    """Two tables of one layout."""

    reversed: JobPath = Field(
        description="The second table, laid out as the first: the same line with the artefact turned."
    )
    artefact: Literal["mirror", "straightedge"] = Field("mirror", description="What was turned.")


class ReversedLaserCsv:
    """Readings of a line with an artefact as it lay and turned over."""

    identifier = "laser-csv-reversal"
    title = Words("Two tables of one line, the artefact turned over")
    options: type[Options] = ReversalOptions

    def read(self, options: ReversalOptions, context: SourceContext) -> MeasurementSet:
        """Read both tables; raise `InputError` with every defect, or if they are of two tests."""
        if context.axis.measurand.identifier != STRAIGHTNESS.identifier:
            raise InputError.at(
                context.place,
                "a reversal takes the straightness of an artefact out of a straightness error: "
                "measurement.error names one, such as EYX",
            )
        table = LaserCsv()
        first = table.read(options, context)
        second = table.read(options.model_copy(update={"file": options.reversed}), context)
        _demand_one_test(first, second, options)
        turned = second.deviations()[
            np.where(first.approach == Approach.POSITIVE, 0, 1),
            first.target,
            np.searchsorted(first.runs, first.run),
        ]
        artefact = replace(first, deviation=(first.deviation - turned) / 2).deviations()
        size = first.axis.deviation_unit.from_si(_measure_straightness(first.target_positions, artefact))
        remark = _MEAN.given(artefact=_ARTEFACTS[options.artefact], size=float(f"{size:.3g}"))
        files = (*first.provenance.files, *second.provenance.files)
        own = first.provenance.remarks
        others = (each for each in second.provenance.remarks if each not in own)
        return replace(
            first,
            deviation=read_only_floats((first.deviation + turned) / 2),
            provenance=Provenance(self.identifier, files, (remark, *own, *others)),
            artefact_is_reversed=True,
        )


def _demand_one_test(first: MeasurementSet, second: MeasurementSet, options: ReversalOptions) -> None:
    """Refuse a second table that is not of the same targets, directions and runs."""
    for what, one, other in (
        ("target positions", first.target_positions, second.target_positions),
        ("directions", first.approaches, second.approaches),
        ("runs", first.runs, second.runs),
    ):
        if not np.array_equal(one, other):
            both = (options.file, options.reversed)
            raise InputError(
                Problem(Place(str(file)), f"its {what} are not those of {beside.name}; both are of one plan")
                for file, beside in zip(both, both[::-1], strict=True)
            )


def _measure_straightness(positions: FloatArray, deviations: FloatArray) -> float:
    """Return the span of the mean of all readings by position about its least squares line, m."""
    with np.errstate(invalid="ignore"):
        there = np.isfinite(deviations)
        mean = np.where(there, deviations, 0.0).sum(axis=(0, 2)) / there.sum(axis=(0, 2))
    known = np.isfinite(mean)
    if np.count_nonzero(known) < _FEWEST:
        return 0.0
    x, y = positions[known] - positions[known].mean(), mean[known]
    return float(np.ptp(y - x * (x @ y) / (x @ x)))
