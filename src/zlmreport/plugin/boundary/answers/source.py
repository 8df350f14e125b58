"""Checks what the methods of a data source answer."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from zlmreport.measurement.measurement_set import MeasurementSet
from zlmreport.measurement.provenance import Provenance
from zlmreport.plugin.boundary import Guarded, Unacceptable
from zlmreport.plugin.boundary.answers.required import (
    accept_all_of,
    require_finite,
    require_kind,
    require_real,
)
from zlmreport.plugin.protocols import SourceProposal


def read(source: Guarded, answer: Any, _options: Any, context: Any) -> MeasurementSet:
    """Refuse a set that is not whole, and hand it on so that nobody can alter a reading."""
    of: MeasurementSet = require_kind(MeasurementSet, answer)
    if of.axis != context.axis:
        raise Unacceptable(f"reads the axis {of.axis}; the job describes {context.axis}")
    require_kind(Provenance, of.provenance)
    if of.provenance.source != source.identifier:
        raise Unacceptable(f"names {of.provenance.source!r} as the source; its own identifier is expected")
    _require_whole(of)
    for array in (of.target_positions, of.target, of.approach, of.run, of.deviation, of.time):
        if array is not None:
            array.setflags(write=False)
    for log in of.conditions.values():
        log.setflags(write=False)
    return of


def _require_whole(of: MeasurementSet) -> None:
    """Refuse a measurement set whose parts do not belong together, or whose readings are no numbers."""
    targets = require_finite(of.target_positions, (np.size(of.target_positions),), "target positions")
    if not targets.size or np.any(np.diff(targets) <= 0):
        raise Unacceptable(f"gives target positions that do not rise: {targets}")
    shape = (np.size(of.deviation),)
    require_real(of.deviation, shape, "a deviation")
    for name, values in (("time", of.time), *of.conditions.items()):
        if values is not None:
            require_real(values, shape, str(name))
    if of.datum is not None:
        require_finite(of.datum, (), "datum")
    _require_designations(of, shape)


def _require_designations(of: MeasurementSet, shape: tuple[int, ...]) -> None:
    """Refuse readings that do not say which they are."""
    for what, whole_numbers in (("target", of.target), ("approach", of.approach), ("run", of.run)):
        if np.asarray(whole_numbers).dtype.kind not in "iu":
            raise Unacceptable(f"gives {what} that is not of whole numbers")
        require_real(whole_numbers, shape, what)
    if np.any((of.target < 0) | (of.target >= of.target_positions.size)):
        raise Unacceptable("gives target that is no index of the target positions")
    if not np.isin(of.approach, (1, -1)).all():
        raise Unacceptable("gives approach that is neither 1 nor -1")
    if np.any(of.run < 1):
        raise Unacceptable("gives run below 1; runs are numbered from 1")
    readings = np.stack([of.target, of.approach, of.run])
    if np.unique(readings, axis=1).shape != readings.shape:
        raise Unacceptable("gives two readings of the same target, direction and run")


#: What is made of an answer, by method.
ACCEPTED: Mapping[str, Callable[..., Any]] = {
    "read": read,
    "proposals": accept_all_of(SourceProposal),
}
