"""Readings as they would be if the axis were corrected by its error model."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace

from zlmreport.language import Words
from zlmreport.measurement.measurement_set import MeasurementSet
from zlmreport.model.effect import Shape
from zlmreport.model.fit import Fit
from zlmreport.model.observe import Observations
from zlmreport.quantities.arrays import read_only_floats

#: What a table of positions, one for each direction, can take away; the rest changes with time or run.
BY_TABLE = frozenset({Shape.POSITION, Shape.DIRECTION})
_CORRECTED = Words(
    en="Predicted: less what the error model explains by {effects}",
    de="Vorhergesagt: abzüglich dessen, was das Fehlermodell durch {effects} erklärt",
)


def corrected(
    measurements: MeasurementSet,
    observed: Observations,
    fitted: Fit,
    shapes: Collection[Shape] = frozenset(Shape),
) -> MeasurementSet:
    """Return the readings less what a model explains of them; none is left out, flagged ones neither.

    Parameters
    ----------
    measurements
        The readings.
    observed
        The same as the model sees them, none set aside.
    fitted
        The model.
    shapes
        Only effects that change along these are taken away.
    """
    left = measurements.deviation.copy()
    taken = []
    solution = fitted.solution
    for term, theta, gamma in zip(fitted.model.terms, solution.thetas, solution.coefficients, strict=True):
        if term.effect.shape in shapes:
            left[observed.reading] -= term.effect.columns(observed.design, theta) @ gamma
            taken.append(term.effect.identifier)
    if not taken:
        return measurements
    provenance = measurements.provenance
    remark = _CORRECTED.given(effects=", ".join(taken))
    return replace(
        measurements,
        deviation=read_only_floats(left),
        provenance=replace(provenance, remarks=(*provenance.remarks, remark)),
    )


def moves_with_time(fitted: Fit) -> tuple[str, ...]:
    """Return the effects of a model that no table of positions takes away."""
    return tuple(term.effect.identifier for term in fitted.model.terms if term.effect.shape not in BY_TABLE)
