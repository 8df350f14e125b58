"""The keys of a table of circles in a job, and the names by which senses go."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from zlmreport.plugin import (
    ANGLE_UNITS,
    CONDITIONS,
    DEGREE,
    LENGTH_UNITS,
    MICROMETRE,
    MILLIMETRE,
    SECOND,
    TIME_UNITS,
    Approach,
    Finite,
    NotNegative,
    ReadingScale,
    Unit,
    did_you_mean,
)
from zlmreport.plugin.table import TableOptions, folded

#: The columns that have a meaning; any other is kept as a condition under its own name.
COLUMN_NAMES = ("sense", "run", "angle", "time", "deviation", "radius", *CONDITIONS)
#: Units that a column may have by their spellings, and the usual one.
UNITS: Mapping[str, tuple[Mapping[str, Unit | ReadingScale], Unit | ReadingScale]] = MappingProxyType(
    {
        "angle": (ANGLE_UNITS, DEGREE),
        "time": (TIME_UNITS, SECOND),
        "deviation": (LENGTH_UNITS, MICROMETRE),
        "radius": (LENGTH_UNITS, MILLIMETRE),
        **{name: (kind.units, kind.unit) for name, kind in CONDITIONS.items()},
    }
)
_SENSES: Mapping[str, Approach] = {
    **dict.fromkeys(
        ("ccw", "counter_clockwise", "counterclockwise", "anticlockwise", "anti_clockwise", "acw"),
        Approach.POSITIVE,
    ),
    **dict.fromkeys(("gegenuhrzeigersinn", "guz", "guzs", "↺", "g3", "g03", "+"), Approach.POSITIVE),
    **dict.fromkeys(("cw", "clockwise"), Approach.NEGATIVE),
    **dict.fromkeys(("uhrzeigersinn", "uz", "uzs", "↻", "g2", "g02", "-"), Approach.NEGATIVE),
}


def read_sense(spelling: str) -> Approach:
    """Return the sense that a cell names, + for counter-clockwise; raise ValueError if it names none."""
    found = _SENSES.get(spelling.strip() if spelling.strip() in "+-" else folded(spelling))
    if found is None:
        near = did_you_mean(spelling[:40], ["ccw", "cw"])
        raise ValueError(f"{spelling.strip()[:40]!r} is no sense of a circle; {near}")
    return found


class CircleCsvOptions(TableOptions):
    """Where the table of a circle is, and what it does not say itself."""

    column_names = COLUMN_NAMES
    column_units = MappingProxyType({name: units for name, (units, _) in UNITS.items()})
    header_example = "sense,run,angle,deviation"

    sense: Literal["ccw", "cw"] | None = Field(
        None, description="Sense of all readings, where the file names none: ccw is counter-clockwise."
    )
    start: Finite = Field(
        0.0,
        description="Angle at which each turn begins, degrees from the plane's first axis towards its "
        "second, where the file has times and no angles.",
    )
    feed_in: NotNegative | None = Field(
        None,
        description="Arc at the beginning of each turn that is not evaluated, degrees: the machine gains its "
        "speed there. Without it, and without feed_out, half of what goes beyond a full turn.",
        examples=[45],
    )
    feed_out: NotNegative | None = Field(
        None, description="Likewise at the end of each turn, degrees.", examples=[45]
    )
    readings_per_turn: Annotated[int, Field(ge=8, le=36_000)] | None = Field(
        None,
        description="Readings are averaged over so many equal arcs of a turn. Without it they are kept as "
        "they are, up to 3600 a turn, if both senses have the same angles.",
        examples=[1800],
    )

    @model_validator(mode="after")
    def _arcs_are_less_than_a_turn_each(self) -> Self:
        for name, arc in (("feed_in", self.feed_in), ("feed_out", self.feed_out)):
            if arc is not None and arc > 360:
                raise ValueError(f"{name} is an arc in degrees, and {arc:g} is more than a turn")
        return self

    @property
    def stated_sense(self) -> Approach | None:
        """The sense of all readings that the job states."""
        return read_sense(self.sense) if self.sense else None
