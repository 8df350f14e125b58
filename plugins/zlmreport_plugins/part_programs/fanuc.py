"""Part programs for Fanuc controls.

Everything here is (check): no Fanuc control has run such a program yet.

- Positions and times have a decimal point always: without one, a control may count least increments.
- ``G53`` moves at rapid traverse only; so positions are those of a work offset (``G54``) that must be zero
  for the axis, which makes them machine positions.
- ``G90`` and ``G94`` mean absolute positions and feed per minute on machining centres, and on lathes only in
  the systems B and C of G codes; a remark in the head says so.
- ``G61`` stops exactly at the end of every block; ``G04 X`` waits for so many seconds.
- The block of a reading has its number, so that the display tells what is being read.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any, Literal

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


class FanucOptions(ProgramOptions):
    """The keys of ``fanuc``."""

    decimals: int = Field(
        3,
        ge=1,
        le=6,
        description="Digits after the decimal point of positions: 3 with increment system IS-B.",
    )
    number: int = Field(7001, ge=1, le=9999, description="Program number, O0001 to O9999.")
    work_offset: Literal["G54", "G55", "G56", "G57", "G58", "G59"] = Field(
        "G54", description="Work offset that is zero for the axis, for positions to be those of the machine."
    )


class Fanuc:
    """ISO code as Fanuc controls take it."""

    identifier = "fanuc"
    title = Words(en="Fanuc (ISO code)", de="Fanuc (ISO-Code)")
    suffix = ".nc"
    options: Any = FanucOptions

    def write(self, motion: Motion, options: Any) -> str:
        """Return the program."""
        return "".join(f"{line}\n" for line in _lines(motion, options))


def _lines(motion: Motion, options: FanucOptions) -> Iterator[str]:
    axis = axis_address(motion, options)
    yield "%"
    yield f"O{options.number:04d}"
    yield from (_remark(text) for text in program_heading(motion))
    yield _remark("G codes of milling, on lathes those of system B or C")
    yield _remark(f"{options.work_offset} of {axis} must be zero")
    yield f"G21 G90 G94 G40 G49 G80 {options.work_offset}"
    yield "G61 (EXACT STOP)"
    feed, dwell = (_pointed(program_number(value)) for value in (motion.feed, motion.dwell))
    yield f"F{feed}"
    for stop in motion.in_decimals(options.decimals).stops:
        yield f"G01 {axis}{stop.position:.{options.decimals}f}"
        if options.waits_at(stop):
            yield "M00"
        if stop.reading:
            yield f"N{stop.reading.number} G04 X{dwell} {_remark(reading_remark(stop.reading))}"
    yield "M30"
    yield "%"


def _remark(text: str) -> str:
    """Return a remark in capitals, without the underscore that not every control knows."""
    return f"({text.upper().replace('_', '-')})"


def _pointed(number: str) -> str:
    return number if "." in number else f"{number}."


@hookimpl
def zlmreport_part_programs() -> Iterable[PartProgram]:
    """Return the writer."""
    return [Fanuc()]
