"""What the air adds to the uncertainty of lengths that are counted in wavelengths of light.

Of lengths that were corrected for the refractive index the measured state of the air; of those that nobody
corrected also what the index changed by, as an error of known size.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from zlmreport.evaluation.correction.compensated import (
    counts_wavelengths,
    find_compensated_by_instrument,
    is_blind_to_air,
    speaks_of_air,
)
from zlmreport.evaluation.correction.corrections import (
    correct_displacement_in_air,
    find_condition_at_readings,
)
from zlmreport.evaluation.uncertainty import wording
from zlmreport.evaluation.uncertainty.budget import Acts, Contribution, Distribution, KnownError, from_range
from zlmreport.job.job import Job
from zlmreport.language import Words
from zlmreport.language.numbers import number_words
from zlmreport.measurement.arrays import FloatArray, read_only_floats
from zlmreport.measurement.measurement_set import CONDITION_NAMES, CONDITIONS, STATE_OF_AIR, MeasurementSet
from zlmreport.measurement.refractive_index import (
    HELIUM_NEON,
    STANDARD_HUMIDITY,
    STANDARD_PRESSURE,
    compute_standard_index,
    refractive_index,
)
from zlmreport.measurement.units import METRE, MICROMETRE, REFERENCE_TEMPERATURE, say_with_unit

#: Step of the difference quotients: of each condition a small part, that rounding does not reach.
_STEP = 1e-4
#: Range of the equation's own error: over the air of a workshop it agrees with Ciddor's to 2 parts in 10⁸.
_EQUATION_RANGE = 4e-8
_SOURCE = Words("sensitivity of the updated Edlén equation, {sensitivity} µm/m per {unit}, at L = {length}")


#: The state of the air in which an instrument that does not look at it is right.
_STANDARD_AIR = (REFERENCE_TEMPERATURE, STANDARD_PRESSURE, STANDARD_HUMIDITY)
_UNCOMPENSATED_SOURCE = Words(
    "of known size: n = {index} by the updated Edlén equation, where the instrument is taken to "
    "have assumed {assumed} (20 °C, 1013.25 hPa, 50 %); L = {length}"
)


def is_silent_on_air(job: Job, measurements: MeasurementSet) -> bool:
    """Return whether lengths were counted in wavelengths and neither job nor file says in which air.

    Neither silence nor "automatic" is a word that the instrument looked at the air: one that did is told of
    by ``instrument.compensates: {air: true}``, or in words that name the air under
    ``instrument.compensation``.
    """
    keys = job.keys
    instrument = keys.instrument
    if instrument is None or not job.axis.has_length or not counts_wavelengths(instrument.name):
        return False
    is_told = keys.corrections is not None and keys.corrections.air is not None
    is_said = speaks_of_air(instrument.compensation or "")
    return not (is_told or is_said or find_compensated_by_instrument(job, measurements).air is not None)


def find_air_error(job: Job, measurements: MeasurementSet) -> Iterator[KnownError]:
    """Yield the error of lengths whose instrument did not look at the air, where its state is known."""
    if not is_blind_to_air(job):
        return
    state = _find_state(job, measurements)
    if any(each is None for each in state):
        return
    temperature, pressure, humidity = (each for each in state if each is not None)
    index = refractive_index(temperature, pressure, humidity)
    assumed = compute_standard_index(HELIUM_NEON)
    targets = measurements.target_positions
    displayed = targets[measurements.target] - measurements.zero
    correction = read_only_floats(correct_displacement_in_air(displayed, index, assumed) - displayed)
    length = float(targets[-1] - targets[0])
    at_end = float(correct_displacement_in_air(np.array(length), np.array(np.mean(index)), assumed)) - length
    yield KnownError(
        name=Words("Refractive index of the air, not compensated"),
        correction=correction,
        stated=Words("Δn·L = {size} µm").given(size=float(f"{abs(MICROMETRE.from_si(at_end)):.3g}")),
        source=_UNCOMPENSATED_SOURCE.given(
            index=number_words(float(np.mean(index)), 7),
            assumed=number_words(assumed, 7),
            length=say_with_unit(length, METRE.symbol),
        ),
    )


def _find_state(job: Job, measurements: MeasurementSet) -> list[FloatArray | None]:
    """Return temperature, pressure and humidity of the air at each reading; None for what nobody knows."""
    return [find_condition_at_readings(name, job, measurements) for name in STATE_OF_AIR]


def list_air_contributions(job: Job, measurements: MeasurementSet, length: float) -> Iterator[Contribution]:
    """Yield the contributions of the air.

    None where lengths are not counted in its wavelengths, or where that of the instrument has it in it; of an
    instrument that compensated the air itself those of the sensors of which a range is stated.

    `length`: L, m.
    """
    corrections = job.keys.corrections
    by_program = corrections is not None and corrections.air is not None
    is_blind = is_blind_to_air(job)
    if not (by_program or is_blind or find_compensated_by_instrument(job, measurements).air):
        return
    state = _find_state(job, measurements)
    conditions = [
        usual if known is None else float(np.mean(known))
        for known, usual in zip(state, _STANDARD_AIR, strict=True)
    ]
    for place, name in enumerate(STATE_OF_AIR):
        stated = getattr(job.keys.uncertainty, name)
        if stated and not (is_blind and state[place] is None):
            unit = CONDITIONS[name].unit
            sensitivity = _compute_sensitivity(conditions, place) * unit.si
            yield Contribution(
                name=CONDITION_NAMES[name],
                standard_uncertainty=from_range(abs(sensitivity) * stated * length, Distribution.RECTANGULAR),
                acts=Acts.ALONG_THE_LENGTH,
                distribution=Distribution.RECTANGULAR,
                stated=wording.say_full_range("R", stated, _name_difference_unit(unit.symbol)),
                source=_SOURCE.given(
                    sensitivity=float(f"{1e6 * sensitivity:.2g}"),
                    unit=_name_difference_unit(unit.symbol),
                    length=say_with_unit(length, METRE.symbol),
                ),
                contributor=name,
            )
    if not (by_program or is_blind):
        return
    yield Contribution(
        name=Words("Equation of the refractive index"),
        standard_uncertainty=from_range(_EQUATION_RANGE * length, Distribution.RECTANGULAR),
        acts=Acts.ALONG_THE_LENGTH,
        distribution=Distribution.RECTANGULAR,
        stated=Words("R = {range} µm/m").given(range=1e6 * _EQUATION_RANGE),
        source=Words("updated Edlén equation against Ciddor's"),
    )


def _compute_sensitivity(conditions: list[float], place: int) -> float:
    """Return ∂n/∂c of one of temperature, pressure and humidity, by a central difference."""
    step = _STEP * max(conditions[place], 1.0)
    ends = []
    for side in (-1, 1):
        moved = list(conditions)
        moved[place] += side * step
        temperature, pressure, humidity = map(np.array, moved)
        ends.append(float(refractive_index(temperature, pressure, humidity)))
    return (ends[1] - ends[0]) / (2 * step)


def _name_difference_unit(symbol: str) -> str:
    """Return the unit of a difference: kelvin for degrees Celsius."""
    return "K" if symbol == "°C" else symbol
