"""The deviation that a model gives at any position of the travel, with its expanded uncertainty."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from zlmreport.cli.terminal import table
from zlmreport.errors import InputError, Place, Problem
from zlmreport.measurement.approach import Approach
from zlmreport.measurement.axis import Axis
from zlmreport.model.design import at_positions, outside_of_measured
from zlmreport.model.effect import Shape
from zlmreport.model.fit import Fit, Prediction
from zlmreport.quantities.arrays import FloatArray
from zlmreport.quantities.formatting import general_number
from zlmreport.quantities.uncertain import rounded_pair


@dataclass(frozen=True, slots=True)
class Points:
    """What a model gives at positions that were asked for.

    Attributes
    ----------
    positions : (M,) array
        m or rad.
    predictions
        By direction of approach.
    moves
        Whether the model changes with time or run: then the predictions are those of the mean of the test.
    """

    positions: FloatArray
    predictions: dict[Approach, Prediction]
    moves: bool


def points_of(fit: Fit, positions: Sequence[float]) -> Points | None:
    """Return what a model gives at positions in mm or degrees; None if none is asked for."""
    if not positions:
        return None
    design = fit.design
    unit = design.axis.position_unit
    places = unit.to_si(np.array(positions, dtype=np.float64))
    sentences = outside_of_measured(design.axis.name, unit, places, design.span)
    if sentences:
        raise InputError(Problem(Place("--at"), sentence) for sentence in sentences)
    measured = [approach for approach in Approach if np.any(design.direction == approach)]
    return Points(
        places,
        {approach: fit.predict(at_positions(design, places, approach)) for approach in measured},
        any(term.effect.shape in {Shape.TIME, Shape.RUN} for term in fit.model.terms),
    )


def point_lines(points: Points | None, axis: Axis) -> Iterator[str]:
    """Yield a table of the deviation at the positions, a column for each direction."""
    if points is None:
        return
    unit, position = axis.deviation_unit, axis.position_unit
    heads = (
        f"{axis.name} {position.symbol}",
        *(f"{each.arrow} {unit.symbol}" for each in points.predictions),
    )
    rows = [heads]
    for number, place in enumerate(position.from_si(points.positions).tolist()):
        cells = (
            rounded_pair(
                unit.from_si(float(each.deviation[number])),
                unit.from_si(float(each.expanded_uncertainty[number])),
            )
            for each in points.predictions.values()
        )
        rows.append((general_number(place), *map(" ± ".join, cells)))
    yield ""
    yield from table(rows, right=range(len(heads)), indent="  ")
    when = "; at the mean time and the mean logged conditions of the test" if points.moves else ""
    yield f"  deviation by the model, ± expanded uncertainty for 95 %{when}"


def point_values(points: Points | None, axis: Axis) -> dict[str, Any]:
    """Return the same for JSON, in full precision: positions in mm or degrees, deviations in µm or ″."""
    if points is None:
        return {}
    unit = axis.deviation_unit
    return {
        "points": [
            {
                "position": axis.position_unit.from_si(place),
                "direction": "+" if approach > 0 else "-",
                "deviation": unit.from_si(float(found.deviation[number])),
                "expanded_uncertainty": unit.from_si(float(found.expanded_uncertainty[number])),
                "coverage_factor": float(found.coverage_factor[number]),
                "unit": unit.ascii,
            }
            for number, place in enumerate(points.positions.tolist())
            for approach, found in points.predictions.items()
        ]
    }
