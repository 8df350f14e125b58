"""What is measured of a drift, how its sensors are called, and the parameters of ISO 230-3.

A sensor is called by the direction in which it reads; of two in one direction 1 is that nearer to the tool's
point. The symbols of the tilts are this program's.
"""

from __future__ import annotations

from zlmreport.plugin import ARCSECOND, DISPLACEMENT, Coordinate, Measurand, Words
from zlmreport.plugin.standard import Quantity, QuantityGroup

#: Both sensors of a direction, whose difference is a tilt.
PAIRS = {letter: (f"{letter}1", f"{letter}2") for letter in "XYZ"}
NAMES = tuple(name for letter, pair in PAIRS.items() for name in (letter, *pair))

#: Of all sensors together.
DRIFT = Measurand(
    identifier="drift",
    title=Words("Environmental temperature variation error"),
    definition=Words("the range of the displacements between tool and workpiece while the machine stands"),
    coordinate=Coordinate.TIME,
    sign=DISPLACEMENT.sign,
    joins_tests=True,
    of_lines=DISPLACEMENT,
    test_names=NAMES,
    subject=Words("{name}"),
    bearer=Words("Sensors {axis}"),
    target=DISPLACEMENT.target,
    senses=DISPLACEMENT.senses,
    is_continuous=True,
)


def write_shown(name: str) -> str:
    """Return the notation of what a sensor reads."""
    return f"{name[0]}_{{{name[1:]}}}" if name[1:] else name


def _define_of_a_sensor(name: str) -> Quantity:
    return Quantity(
        f"E_{name}",
        f"E_{{{name}}}",
        Words("Drift in {letter}, sensor {name}").given(letter=name[0], name=name),
        QuantityGroup.SYSTEMATIC,
        f"max({write_shown(name)}(t)) − min({write_shown(name)}(t))",
        Words(
            "How far tool and workpiece moved against each other in {letter} in the stated hours, and with "
            "that how far a part that took so long may be off."
        ).given(letter=name[0]),
    )


def _define_of_a_pair(letter: str) -> Quantity:
    first, second = PAIRS[letter]
    tilt = f"({write_shown(first)}(t) − {write_shown(second)}(t))/d"
    return Quantity(
        f"tilt_{letter}",
        f"φ_{{{letter}}}",
        Words("Tilt from {first} and {second}").given(first=first, second=second),
        QuantityGroup.SYSTEMATIC,
        f"max({tilt}) − min({tilt})",
        Words(
            "How far the tool turned against the workpiece in the stated hours; d is the distance of both "
            "sensors."
        ),
        unit=ARCSECOND,
    )


QUANTITIES = (*map(_define_of_a_sensor, NAMES), *map(_define_of_a_pair, PAIRS))

NOTES: tuple[Words, ...] = (
    Words(
        "The error is that of this machine in this environment in these hours. It is not made for comparing "
        "machines with each other."
    ),
    Words(
        "Over which hours the range is taken, which sensors there are and how long a test lasts at least is "
        "this program's reading of the standard; that its edition of 2020 has four tests, of which this is "
        "that of the environment, is published."
    ),
    Words(
        "Sensors, their holder and the mandrel change their lengths with the temperature too. What they did "
        "is in the readings and counts as the machine's unless the budget states it."
    ),
)
