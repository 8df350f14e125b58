"""Part programs for LinuxCNC (RS274/NGC).

The words used are those of LinuxCNC's own documentation, and its stand-alone interpreter runs the programs.

- ``G53`` moves in machine coordinates; it holds for its own block, and takes the feed of ``G1``.
- ``G61.1`` stops exactly at the end of every block.
- ``M0`` stops until the operator lets the program go on.
- ``G4 P`` waits for so many seconds.
- ``F`` is mm/min, and degrees/min where only a rotary axis moves.
"""

from __future__ import annotations

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


class LinuxCncOptions(ProgramOptions):
    """The keys of ``linuxcnc``."""

    decimals: int = Field(4, ge=0, le=9, description="Digits after the decimal point of positions.")


class LinuxCnc:
    """RS274/NGC as LinuxCNC takes it."""

    identifier = "linuxcnc"
    title = Words(en="LinuxCNC (RS274/NGC)", de="LinuxCNC (RS274/NGC)")
    suffix = ".ngc"
    options: Any = LinuxCncOptions

    def write(self, motion: Motion, options: Any) -> str:
        """Return the program."""
        return "".join(f"{line}\n" for line in _lines(motion, options))


def _lines(motion: Motion, options: LinuxCncOptions) -> Iterator[str]:
    axis = axis_address(motion, options)
    yield from (f"({text})" for text in program_heading(motion))
    yield "G21 G90 G94 G40 G49 G80 (mm, absolute, feed per minute, no offsets)"
    yield "G61.1 (exact stop)"
    yield f"F{program_number(motion.feed)}"
    for stop in motion.in_decimals(options.decimals).stops:
        yield f"G53 G1 {axis}{stop.position:.{options.decimals}f}"
        if options.waits_at(stop):
            yield f"M0 (wait before the {stop.begins})"
        if stop.reading:
            yield f"(reading {stop.reading.number}, {reading_remark(stop.reading)})"
            yield f"G4 P{program_number(motion.dwell)}"
    yield "M2"


@hookimpl
def zlmreport_part_programs() -> Iterable[PartProgram]:
    """Return the writer."""
    return [LinuxCnc()]
