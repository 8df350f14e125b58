"""What the measured air adds to the uncertainty of lengths that were corrected for its refractive index."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from zlmreport.correction.corrections import air_conditions
from zlmreport.correction.refractive_index import refractive_index
from zlmreport.job.job import Job
from zlmreport.language import Words
from zlmreport.measurement.measurement_set import CONDITION_NAMES, CONDITIONS, STATE_OF_AIR, MeasurementSet
from zlmreport.uncertainty import wording
from zlmreport.uncertainty.budget import Acts, Contribution, Distribution, from_range

#: Step of the difference quotients: of each condition a small part, that rounding does not reach.
_STEP = 1e-4
#: Range of the equation's own error: over the air of a workshop it agrees with Ciddor's to 2 parts in 10⁸.
_EQUATION_RANGE = 4e-8
_EQUATION = Words(en="Equation of the refractive index", de="Gleichung der Brechzahl")
_EQUATION_STATED = Words(en="R = {parts} × 10⁻⁸ of the length", de="R = {parts} × 10⁻⁸ der Länge")
_EQUATION_SOURCE = Words(
    en="updated Edlén equation against Ciddor's", de="aktualisierte Edlén-Gleichung gegen die von Ciddor"
)
_SOURCE = Words(
    en="sensitivity of the updated Edlén equation, {sensitivity} × 10⁻⁶ per {unit}, at L = {length}",
    de="Empfindlichkeit der aktualisierten Edlén-Gleichung, {sensitivity} × 10⁻⁶ je {unit}, bei L = {length}",
)


def air_contributions(job: Job, measurements: MeasurementSet, length: float) -> Iterator[Contribution]:
    """Yield the contributions of the air; none where the readings are not corrected for it.

    `length`: L, m.
    """
    corrections = job.keys.corrections
    if corrections is None or corrections.air is None:
        return
    conditions = [float(np.mean(each)) for each in air_conditions(job, measurements)]
    for place, name in enumerate(STATE_OF_AIR):
        stated = getattr(job.keys.uncertainty, name)
        if stated is not None:
            unit = CONDITIONS[name].unit
            sensitivity = _sensitivity(conditions, place) * unit.si
            yield Contribution(
                name=CONDITION_NAMES[name],
                standard_uncertainty=from_range(abs(sensitivity) * stated * length, Distribution.RECTANGULAR),
                acts=Acts.ALONG_THE_LENGTH,
                distribution=Distribution.RECTANGULAR,
                stated=wording.full_range("R", stated, _difference_unit(unit.symbol)),
                source=_SOURCE.given(
                    sensitivity=float(f"{1e6 * sensitivity:.2g}"),
                    unit=_difference_unit(unit.symbol),
                    length=wording.length(length),
                ),
                contributor=name,
            )
    yield Contribution(
        name=_EQUATION,
        standard_uncertainty=from_range(_EQUATION_RANGE * length, Distribution.RECTANGULAR),
        acts=Acts.ALONG_THE_LENGTH,
        distribution=Distribution.RECTANGULAR,
        stated=_EQUATION_STATED.given(parts=1e8 * _EQUATION_RANGE),
        source=_EQUATION_SOURCE,
    )


def _sensitivity(conditions: list[float], place: int) -> float:
    """Return ∂n/∂c of one of temperature, pressure and humidity, by a central difference."""
    step = _STEP * max(conditions[place], 1.0)
    ends = []
    for side in (-1, 1):
        moved = list(conditions)
        moved[place] += side * step
        temperature, pressure, humidity = map(np.array, moved)
        ends.append(float(refractive_index(temperature, pressure, humidity)))
    return (ends[1] - ends[0]) / (2 * step)


def _difference_unit(symbol: str) -> str:
    """Return the unit of a difference: kelvin for degrees Celsius."""
    return "K" if symbol == "°C" else symbol
