"""Part programs for controls, one dialect beside the other: the motion is the same, and each has its words.

LinuxCNC's words are those of its documentation, and its stand-alone interpreter runs the programs. All else
here is (check): no such control has run a program of this kind yet.
"""

from __future__ import annotations

import re
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

#: Names of axes of a SINUMERIK begin with the letter of a coordinate: X, X1, Z_2; its words do not fit.
_ADDRESS = re.compile("[ABCUVWXYZ]([0-9][0-9A-Z_]{0,29}|_[0-9A-Z_]{0,29})?")
_NOT_IN_NAMES = re.compile(r"[^A-Za-z0-9_-]")


class _Dialect:
    """What these writers share: a program is its lines."""

    def write(self, motion: Motion, options: Any) -> str:
        """Return the program."""
        return "".join(f"{line}\n" for line in self.lines(motion, options))

    def lines(self, motion: Motion, options: Any) -> Iterator[str]:
        """Yield the lines of the program."""
        raise NotImplementedError


class LinuxCncOptions(ProgramOptions):
    """The keys of ``linuxcnc``."""

    decimals: int = Field(4, ge=0, le=9, description="Digits after the decimal point of positions.")


class LinuxCnc(_Dialect):
    """RS274/NGC as LinuxCNC takes it.

    - ``G53`` moves in machine coordinates; it holds for its own block, and takes the feed of ``G1``.
    - ``G61.1`` stops exactly at the end of every block.
    - ``M0`` stops until the operator lets the program go on.
    - ``G4 P`` waits for so many seconds.
    - ``F`` is mm/min, and degrees/min where only a rotary axis moves.
    """

    identifier = "linuxcnc"
    title = Words(en="LinuxCNC (RS274/NGC)", de="LinuxCNC (RS274/NGC)")
    suffix = ".ngc"
    options: Any = LinuxCncOptions

    def lines(self, motion: Motion, options: LinuxCncOptions) -> Iterator[str]:
        """Yield the lines."""
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


class Fanuc(_Dialect):
    """ISO code as Fanuc controls take it.

    - Positions and times have a decimal point always: without one, a control may count least increments.
    - ``G53`` moves at rapid traverse only; so positions are those of a work offset (``G54``) that must be
      zero for the axis, which makes them machine positions.
    - ``G90`` and ``G94`` mean absolute positions and feed per minute on machining centres, and on lathes only
      in the systems B and C of G codes; a remark in the head says so.
    - ``G61`` stops exactly at the end of every block; ``G04 X`` waits for so many seconds.
    - The block of a reading has its number, so that the display tells what is being read.
    """

    identifier = "fanuc"
    title = Words(en="Fanuc (ISO code)", de="Fanuc (ISO-Code)")
    suffix = ".nc"
    options: Any = FanucOptions

    def lines(self, motion: Motion, options: FanucOptions) -> Iterator[str]:
        """Yield the lines."""
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


class Siemens840dOptions(ProgramOptions):
    """The keys of ``siemens-840d``."""

    axis: str | None = Field(
        None, description="Name of the axis in the channel, where it is not that of the job.", examples=["X1"]
    )
    decimals: int = Field(4, ge=0, le=9, description="Digits after the decimal point of positions.")


class Siemens840d(_Dialect):
    """The language of SINUMERIK 840D.

    - ``SUPA`` moves in machine coordinates; it holds for its own block. ``D0`` switches tool offsets off.
    - ``G710`` takes positions and feeds in millimetres, whatever the control's own system of units.
    - ``G60`` stops exactly at the end of every block.
    - ``STOPRE`` lets the control read no further ahead; ``G4 F`` waits for so many seconds, in its own block.
    - The block of a reading has its number, so that the display tells what is being read.
    """

    identifier = "siemens-840d"
    title = Words(en="Siemens SINUMERIK 840D", de="Siemens SINUMERIK 840D")
    suffix = ".mpf"
    options: Any = Siemens840dOptions

    def lines(self, motion: Motion, options: Siemens840dOptions) -> Iterator[str]:
        """Yield the lines."""
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


class HeidenhainOptions(ProgramOptions):
    """The keys of ``heidenhain``."""

    decimals: int = Field(4, ge=0, le=6, description="Digits after the decimal point of positions.")


class Heidenhain(_Dialect):
    """Klartext.

    - ``M91`` moves in machine coordinates; it holds for its own block. ``R0`` is without radius compensation.
    - A straight line ``L`` with a feed of its own ends before the dwell after it begins.
    - ``STOP`` stops until the operator lets the program go on.
    - Cycle 9 waits for so many seconds, as soon as it is defined.
    - Blocks are numbered without a gap, from 0.
    """

    identifier = "heidenhain"
    title = Words(en="HEIDENHAIN Klartext", de="HEIDENHAIN-Klartext")
    suffix = ".h"
    options: Any = HeidenhainOptions

    def lines(self, motion: Motion, options: HeidenhainOptions) -> Iterator[str]:
        """Yield the lines: its blocks with their numbers."""
        yield from (f"{number} {block}" for number, block in enumerate(self._blocks(motion, options)))

    def _blocks(self, motion: Motion, options: HeidenhainOptions) -> Iterator[str]:
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


def _remark(text: str) -> str:
    """Return a remark in capitals, without the underscore that not every control knows."""
    return f"({text.upper().replace('_', '-')})"


def _pointed(number: str) -> str:
    return number if "." in number else f"{number}."


@hookimpl
def zlmreport_part_programs() -> Iterable[PartProgram]:
    """Return the writers."""
    return [Fanuc(), Heidenhain(), LinuxCnc(), Siemens840d()]
