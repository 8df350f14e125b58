"""Part programs for HEIDENHAIN controls, in Klartext.

Everything here is (check): no such control has run a program of this kind yet.

- ``M91`` moves in machine coordinates; it holds for its own block. ``R0`` is without radius compensation.
- A straight line ``L`` with a feed of its own ends before the dwell after it begins.
- ``STOP`` stops until the operator lets the program go on.
- Cycle 9 waits for so many seconds, as soon as it is defined.
- Blocks are numbered without a gap, from 0.
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

_NOT_IN_NAMES = re.compile(r"[^A-Za-z0-9_-]")


class HeidenhainOptions(ProgramOptions):
    """The keys of ``heidenhain``."""

    decimals: int = Field(4, ge=0, le=6, description="Digits after the decimal point of positions.")


class Heidenhain:
    """Klartext."""

    identifier = "heidenhain"
    title = Words(en="HEIDENHAIN Klartext", de="HEIDENHAIN-Klartext")
    suffix = ".h"
    options: Any = HeidenhainOptions

    def write(self, motion: Motion, options: Any) -> str:
        """Return the program."""
        return "".join(f"{number} {line}\n" for number, line in enumerate(_blocks(motion, options)))


def _blocks(motion: Motion, options: HeidenhainOptions) -> Iterator[str]:
    axis = axis_address(motion, options)
    name = _NOT_IN_NAMES.sub("_", motion.number)
    feed, dwell = program_number(motion.feed), program_number(motion.dwell)
    yield f"BEGIN PGM {name} MM"
    yield from (f"; {text}" for text in program_heading(motion))
    for stop in motion.in_decimals(options.decimals).stops:
        yield f"L {axis}{stop.position:+.{options.decimals}f} R0 F{feed} M91"
        if options.waits_at(stop):
            yield "STOP"
        if stop.reading:
            yield f"; reading {stop.reading.number}, {reading_remark(stop.reading)}"
            yield "CYCL DEF 9.0 DWELL TIME"
            yield f"CYCL DEF 9.1 DWELL {dwell if '.' in dwell else f'{dwell}.0'}"
    yield f"END PGM {name} MM"


@hookimpl
def zlmreport_part_programs() -> Iterable[PartProgram]:
    """Return the writer."""
    return [Heidenhain()]
