"""Part programs for Siemens SINUMERIK 840D.

Everything here is (check): no such control has run a program of this kind yet.

- ``SUPA`` moves in machine coordinates; it holds for its own block. ``D0`` switches tool offsets off.
- ``G710`` takes positions and feeds in millimetres, whatever the control's own system of units.
- ``G60`` stops exactly at the end of every block.
- ``STOPRE`` lets the control read no further ahead; ``G4 F`` waits for so many seconds, in its own block.
- The block of a reading has its number, so that the display tells what is being read.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from typing import Any

from pydantic import Field

from zlmreport.plugin import (
    Motion,
    PartProgram,
    ProgramOptions,
    Words,
    axis_address,
    hookimpl,
    program_heading,
    program_number,
    reading_remark,
)

#: Names of axes begin with the letter of a coordinate: X, X1, Z_2. Words of the language do not fit.
_ADDRESS = re.compile("[ABCUVWXYZ]([0-9][0-9A-Z_]{0,29}|_[0-9A-Z_]{0,29})?")


class Siemens840dOptions(ProgramOptions):
    """The keys of ``siemens-840d``."""

    axis: str | None = Field(
        None, description="Name of the axis in the channel, where it is not that of the job.", examples=["X1"]
    )
    decimals: int = Field(4, ge=0, le=9, description="Digits after the decimal point of positions.")


class Siemens840d:
    """The language of SINUMERIK 840D."""

    identifier = "siemens-840d"
    title = Words(en="Siemens SINUMERIK 840D", de="Siemens SINUMERIK 840D")
    suffix = ".mpf"
    options: Any = Siemens840dOptions

    def write(self, motion: Motion, options: Any) -> str:
        """Return the program."""
        return "".join(f"{line}\n" for line in _lines(motion, options))


def _lines(motion: Motion, options: Siemens840dOptions) -> Iterator[str]:
    axis = axis_address(motion, options, _ADDRESS, "X or X1")
    yield from (f"; {text}" for text in program_heading(motion))
    yield "G710 G90 G94 G40 D0 ; mm, absolute, feed per minute, no offsets"
    yield "G60 ; exact stop"
    yield f"F{program_number(motion.feed)}"
    for stop in motion.in_decimals(options.decimals).stops:
        yield f"SUPA G1 {axis}={stop.position:.{options.decimals}f}"
        if options.waits_at(stop):
            yield "M0"
        if stop.reading:
            yield "STOPRE"
            dwell = program_number(motion.dwell)
            yield f"N{stop.reading.number} G4 F{dwell} ; {reading_remark(stop.reading)}"
    yield "M30"


@hookimpl
def zlmreport_part_programs() -> Iterable[PartProgram]:
    """Return the writer."""
    return [Siemens840d()]
