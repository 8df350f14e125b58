"""Runs that seem to be in another unit than the others."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from zlmreport.language import Words
from zlmreport.measurement.measurement_set import MeasurementSet

_OF_A_RUN = Words("{statement}; {remedy}")


def find_doubts_of_runs(measurements: MeasurementSet) -> Iterator[Words]:
    """Yield a sentence for each run that seems to be in another unit than the others."""
    if not np.isfinite(measurements.deviation).any():
        return
    from zlmreport.model.diagnosis.faults import FaultKind, find_recorded_faults  # noqa: PLC0415 - brings the error model
    from zlmreport.model.fitting.observations import make_observations_of  # noqa: PLC0415 - likewise

    observed = make_observations_of(measurements)
    for each in find_recorded_faults(observed.design, observed.deviation):
        if each.kind is FaultKind.WRONG_UNIT and each.run is not None:
            yield _OF_A_RUN.given(statement=each.statement, remedy=each.remedy)
