"""Conditions that nobody has measured yet: a plausible course of each, to ask what it would show.

What a plan sees of an effect depends on the course of its condition, not on its size; the smallest effect
that is found falls as the condition changes more.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

from zlmreport.correction.refractive_index import STANDARD_HUMIDITY, STANDARD_PRESSURE
from zlmreport.language import Words
from zlmreport.quantities.temperature import REFERENCE_TEMPERATURE
from zlmreport.simulation.description import Course

#: What the air does in an hour of an ordinary day: Pa, and a share.
_FALL_OF_PRESSURE, _RISE_OF_HUMIDITY = 100.0, 0.03
#: How many of its time constants a machine has warmed up for when the test ends.
_TIME_CONSTANTS = 3.0

ASSUMPTION = Words(
    en="temperatures rise by {rise} K during the test from 20 °C, the machine's ever more slowly, the air's "
    "steadily; air pressure falls by 1 hPa, humidity rises by 3 %",
    de="während der Prüfung steigen die Temperaturen um {rise} K von 20 °C an, die der Maschine immer "
    "langsamer, die der Luft stetig; der Luftdruck fällt um 1 hPa, die Feuchte steigt um 3 %",
)


@dataclass(frozen=True, slots=True)
class Expected:
    """What is expected of a test that nobody has done yet.

    Attributes
    ----------
    sigma
        Repeatability of a single reading, m or rad.
    temperature_change
        From the first reading to the last, K.
    """

    sigma: float
    temperature_change: float


def expected_courses(rise: float, duration: float) -> Mapping[str, Course]:
    """Return a course of every condition that files may log, by its name.

    Parameters
    ----------
    rise
        Of temperatures from the first reading to the last, K.
    duration
        Of the test, s.
    """
    done = -math.expm1(-_TIME_CONSTANTS)
    warmest = REFERENCE_TEMPERATURE + rise / done
    warming = Course(REFERENCE_TEMPERATURE, warmest, time_constant=duration / _TIME_CONSTANTS or 1.0)
    return {
        "axis_temperature": warming,
        "screw_temperature": warming,
        "material_temperature": warming,
        "air_temperature": Course(REFERENCE_TEMPERATURE, REFERENCE_TEMPERATURE + rise),
        "air_pressure": Course(STANDARD_PRESSURE, STANDARD_PRESSURE - _FALL_OF_PRESSURE),
        "relative_humidity": Course(STANDARD_HUMIDITY, STANDARD_HUMIDITY + _RISE_OF_HUMIDITY),
    }
