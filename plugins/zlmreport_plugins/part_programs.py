"""Part programs for LinuxCNC, FANUC, SINUMERIK 840D and HEIDENHAIN: G code, dwells, circles.

A circle is run about the zero of a work offset, as ballbars are set up: no control moves along an arc in
machine coordinates.

LinuxCNC's words are those of its documentation, and its stand-alone interpreter runs the programs. All else
here is (check): no such control has run a program of this kind yet.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from typing import Any, Literal

from pydantic import Field

from zlmreport.plugin import Approach, Words, hookimpl
from zlmreport.plugin.program import (
    CirclePath,
    Motion,
    PartProgram,
    PathBlock,
    ProgramOptions,
    axis_address,
    circle_heading,
    program_heading,
    program_number,
    reading_remark,
)

#: Names of axes of a SINUMERIK begin with the letter of a coordinate: X, X1, Z_2; its words do not fit.
_ADDRESS = re.compile("[ABCUVWXYZ]([0-9][0-9A-Z_]{0,29}|_[0-9A-Z_]{0,29})?")
_NOT_IN_NAMES = re.compile(r"[^A-Za-z0-9_-]")
#: Of ISO code: the plane of a circle, and the way from an arc's start to its centre.
_PLANES = {"XY": "G17", "ZX": "G18", "YZ": "G19"}
_TO_CENTRE = {"X": "I", "Y": "J", "Z": "K"}


class _Dialect:
    """What these writers share: a program is its lines."""

    def write(self, motion: Motion, options: Any) -> str:
        """Return the program."""
        return "".join(f"{line}\n" for line in self.write_lines(motion, options))

    def write_circle(self, path: CirclePath, options: Any) -> str:
        """Return the program of a circular test."""
        return "".join(f"{line}\n" for line in self.write_lines_of_circle(path, options))

    def write_lines(self, motion: Motion, options: Any) -> Iterator[str]:
        """Yield the lines of the program."""
        raise NotImplementedError

    def write_lines_of_circle(self, path: CirclePath, options: Any) -> Iterator[str]:
        """Yield the lines of the program of a circular test."""
        raise NotImplementedError


@dataclass(frozen=True)
class _Iso:
    """How a control with ISO code says the blocks of a circular test."""

    exact: str  #: From here it stops at the end of every block.
    runs_on: str  #: From here it does not.
    stop: str  #: It waits for the operator.
    rest: tuple[str, ...]  #: It rests between two turns.
    remark: Callable[[str], str]  #: A remark behind a block.
    digits: int = 1  #: Of the number of a G code, at least.
    between: str = ""  #: A letter and its number.
    omits_end: bool = False  #: Whether a full circle has no end.

    def write_blocks(self, path: CirclePath, options: ProgramOptions) -> Iterator[str]:
        """Yield the blocks from the first point to the last."""
        mode = ""
        for block in path.blocks(options.decimals):
            if block.begins == "turn":
                yield from (self.stop,) if options.wait == "runs" else self.rest if path.rest else ()
            wanted = self.exact if block.stops else self.runs_on
            if wanted != mode:
                yield wanted
                mode = wanted
            remark = f" {self.remark(block.remark)}" if block.remark else ""
            words = " ".join(self._write_words(path, block, options.decimals))
            yield f"{self._choose_code(block)} {words}{remark}"
            if block.begins == "test" and options.wait != "never":
                yield self.stop

    def _choose_code(self, block: PathBlock) -> str:
        number = {None: 1, Approach.NEGATIVE: 2, Approach.POSITIVE: 3}[block.sense]
        return f"G{number:0{self.digits}d}"

    def _write_words(self, path: CirclePath, block: PathBlock, decimals: int) -> Iterator[str]:
        """Yield the words to the end of a block, and of an arc to its centre."""
        if block.end != block.start or not self.omits_end:
            for axis, value in zip(path.circle.axes, block.end, strict=True):
                yield f"{axis}{self.between}{value:.{decimals}f}"
        if block.sense is not None:
            for axis, value in zip(path.circle.axes, block.centre, strict=True):
                yield f"{_TO_CENTRE[axis]}{self.between}{value:.{decimals}f}"


class LinuxCncProgramOptions(ProgramOptions):
    """The keys of ``linuxcnc``."""

    decimals: int = Field(4, ge=0, le=9, description="Digits after the decimal point of positions.")
    work_offset: Literal["G54", "G55", "G56", "G57", "G58", "G59"] = Field(
        "G54", description="Of a circle: the work offset whose zero is the centre."
    )


class LinuxCncProgram(_Dialect):
    """RS274/NGC as LinuxCNC takes it.

    - ``G53`` moves in machine coordinates; it holds for its own block, and takes the feed of ``G1``.
    - ``G61.1`` stops exactly at the end of every block.
    - ``M0`` stops until the operator lets the program go on.
    - ``G4 P`` waits for so many seconds.
    - ``F`` is mm/min, and degrees/min where only a rotary axis moves.
    - ``G2`` and ``G3`` run arcs in the plane of ``G17``, ``G18`` or ``G19``, and a full circle where an arc
      ends at its start; ``G91.1`` takes I, J and K from there to the centre. ``G53`` takes no arcs.
    - ``G64`` runs on from arc to arc, within 1 µm of the corner.
    """

    identifier = "linuxcnc"
    title = Words("LinuxCNC (RS274/NGC)")
    suffix = ".ngc"
    options: Any = LinuxCncProgramOptions

    def write_lines(self, motion: Motion, options: LinuxCncProgramOptions) -> Iterator[str]:
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

    def write_lines_of_circle(self, path: CirclePath, options: LinuxCncProgramOptions) -> Iterator[str]:
        """Yield the lines."""
        yield from (f"({text})" for text in circle_heading(path, options))
        yield "G21 G90 G94 G40 G49 G80 G91.1 (mm, absolute, feed per minute, no offsets, arcs by I J K)"
        yield f"{options.work_offset} {_PLANES[path.circle.plane]}"
        yield f"F{program_number(path.feed)}"
        words = _Iso(
            "G61.1 (exact stop)",
            "G64 P0.001 (no stop)",
            "M0",
            (f"G4 P{program_number(path.rest)}",),
            "({})".format,
        )
        yield from words.write_blocks(path, options)
        yield "M2"


class FanucProgramOptions(ProgramOptions):
    """The keys of ``fanuc``."""

    decimals: int = Field(
        3,
        ge=1,
        le=6,
        description="Digits after the decimal point of positions: 3 with increment system IS-B.",
    )
    number: int = Field(7001, ge=1, le=9999, description="Program number, O0001 to O9999.")
    work_offset: Literal["G54", "G55", "G56", "G57", "G58", "G59"] = Field(
        "G54",
        description="Work offset that is zero for the axis, for positions to be those of the machine; of a "
        "circle, the one whose zero is the centre.",
    )


class FanucProgram(_Dialect):
    """ISO code as Fanuc controls take it.

    - Positions and times have a decimal point always: without one, a control may count least increments.
    - ``G53`` moves at rapid traverse only; so positions are those of a work offset (``G54``) that must be
      zero for the axis, which makes them machine positions.
    - ``G90`` and ``G94`` mean absolute positions and feed per minute on machining centres, and on lathes only
      in the systems B and C of G codes; a remark in the head says so.
    - ``G61`` stops exactly at the end of every block; ``G04 X`` waits for so many seconds.
    - The block of a reading has its number, so that the display tells what is being read.
    - ``G02`` and ``G03`` run arcs in the plane of ``G17``, ``G18`` or ``G19``, with I, J and K from the start
      to the centre, and a full circle where no end is programmed. ``G64`` runs on from arc to arc.
    """

    identifier = "fanuc"
    title = Words("Fanuc (ISO code)")
    suffix = ".nc"
    options: Any = FanucProgramOptions

    def write_lines(self, motion: Motion, options: FanucProgramOptions) -> Iterator[str]:
        """Yield the lines."""
        axis = axis_address(motion, options)
        yield "%"
        yield f"O{options.number:04d}"
        yield from (_write_remark(text) for text in program_heading(motion))
        yield _write_remark("G codes of milling, on lathes those of system B or C")
        yield _write_remark(f"{options.work_offset} of {axis} must be zero")
        yield f"G21 G90 G94 G40 G49 G80 {options.work_offset}"
        yield "G61 (EXACT STOP)"
        feed, dwell = (_write_pointed(program_number(value)) for value in (motion.feed, motion.dwell))
        yield f"F{feed}"
        for stop in motion.in_decimals(options.decimals).stops:
            yield f"G01 {axis}{stop.position:.{options.decimals}f}"
            if options.waits_at(stop):
                yield "M00"
            if stop.reading:
                yield f"N{stop.reading.number} G04 X{dwell} {_write_remark(reading_remark(stop.reading))}"
        yield "M30"
        yield "%"

    def write_lines_of_circle(self, path: CirclePath, options: FanucProgramOptions) -> Iterator[str]:
        """Yield the lines."""
        yield "%"
        yield f"O{options.number:04d}"
        yield from (_write_remark(text) for text in circle_heading(path, options))
        yield _write_remark("G codes of milling, on lathes those of system B or C")
        yield f"G21 G90 G94 G40 G49 G80 {options.work_offset} {_PLANES[path.circle.plane]}"
        yield f"F{_write_pointed(program_number(path.feed))}"
        rest = f"G04 X{_write_pointed(program_number(path.rest))}"
        words = _Iso(
            "G61 (EXACT STOP)", "G64 (NO STOP)", "M00", (rest,), _write_remark, digits=2, omits_end=True
        )
        yield from words.write_blocks(path, options)
        yield "M30"
        yield "%"


class Siemens840dProgramOptions(ProgramOptions):
    """The keys of ``siemens-840d``."""

    axis: str | None = Field(
        None, description="Name of the axis in the channel, where it is not that of the job.", examples=["X1"]
    )
    decimals: int = Field(4, ge=0, le=9, description="Digits after the decimal point of positions.")
    work_offset: Literal["G54", "G55", "G56", "G57"] = Field(
        "G54", description="Of a circle: the settable work offset whose zero is the centre."
    )


class Siemens840dProgram(_Dialect):
    """The language of SINUMERIK 840D.

    - ``SUPA`` moves in machine coordinates; it holds for its own block. ``D0`` switches tool offsets off.
    - ``G710`` takes positions and feeds in millimetres, whatever the control's own system of units.
    - ``G60`` stops exactly at the end of every block.
    - ``STOPRE`` lets the control read no further ahead; ``G4 F`` waits for so many seconds, in its own block.
    - The block of a reading has its number, so that the display tells what is being read.
    - ``G2`` and ``G3`` run arcs in the plane of ``G17``, ``G18`` or ``G19``, with I, J and K from the start
      to the centre, and a full circle where an arc ends at its start. ``G64`` runs on from arc to arc.
    """

    identifier = "siemens-840d"
    title = Words("Siemens SINUMERIK 840D")
    suffix = ".mpf"
    options: Any = Siemens840dProgramOptions

    def write_lines(self, motion: Motion, options: Siemens840dProgramOptions) -> Iterator[str]:
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

    def write_lines_of_circle(self, path: CirclePath, options: Siemens840dProgramOptions) -> Iterator[str]:
        """Yield the lines."""
        yield from (f"; {text}" for text in circle_heading(path, options))
        yield "G710 G90 G94 G40 D0 ; mm, absolute, feed per minute, no offsets"
        yield f"{options.work_offset} {_PLANES[path.circle.plane]}"
        yield f"F{program_number(path.feed)}"
        rest = ("STOPRE", f"G4 F{program_number(path.rest)}")
        yield from _Iso(
            "G60 ; exact stop", "G64 ; no stop", "M0", rest, "; {}".format, between="="
        ).write_blocks(path, options)
        yield "M30"


class HeidenhainProgramOptions(ProgramOptions):
    """The keys of ``heidenhain``."""

    decimals: int = Field(4, ge=0, le=6, description="Digits after the decimal point of positions.")


class HeidenhainProgram(_Dialect):
    """Klartext.

    - ``M91`` moves in machine coordinates; it holds for its own block. ``R0`` is without radius compensation.
    - A straight line ``L`` with a feed of its own ends before the dwell after it begins.
    - ``STOP`` stops until the operator lets the program go on.
    - Cycle 9 waits for so many seconds, as soon as it is defined.
    - Blocks are numbered without a gap, from 0.
    - ``C`` runs an arc about the centre of ``CC``, counter-clockwise with ``DR+``, and a full circle where it
      ends at its start. It may lie in another plane than the working plane.
    """

    identifier = "heidenhain"
    title = Words("HEIDENHAIN Klartext")
    suffix = ".h"
    options: Any = HeidenhainProgramOptions

    def write_lines(self, motion: Motion, options: HeidenhainProgramOptions) -> Iterator[str]:
        """Yield the lines: its blocks with their numbers."""
        yield from (f"{number} {block}" for number, block in enumerate(self._write_blocks(motion, options)))

    def write_lines_of_circle(self, path: CirclePath, options: HeidenhainProgramOptions) -> Iterator[str]:
        """Yield the lines: its blocks with their numbers."""
        blocks = self._write_blocks_of_circle(path, options)
        yield from (f"{number} {block}" for number, block in enumerate(blocks))

    def _write_blocks_of_circle(self, path: CirclePath, options: HeidenhainProgramOptions) -> Iterator[str]:
        name, feed = _NOT_IN_NAMES.sub("_", path.number), program_number(path.feed)
        first, second = path.circle.axes
        yield f"BEGIN PGM {name} MM"
        yield from (f"; {text}" for text in circle_heading(path, options))
        yield f"CC {first}+0 {second}+0"
        for block in path.blocks(options.decimals):
            if block.remark:
                yield f"; {block.remark}"
            if block.begins == "turn":
                if options.wait == "runs":
                    yield "STOP"
                elif path.rest:
                    yield from _write_dwell(path.rest)
            ends = zip(path.circle.axes, block.end, strict=True)
            words = " ".join(f"{axis}{value:+.{options.decimals}f}" for axis, value in ends)
            if block.sense is None:
                yield f"L {words} R0 F{feed}"
            else:
                yield f"C {words} DR{block.sense.sign}"
            if block.begins == "test" and options.wait != "never":
                yield "STOP"
        yield f"END PGM {name} MM"

    def _write_blocks(self, motion: Motion, options: HeidenhainProgramOptions) -> Iterator[str]:
        axis = axis_address(motion, options)
        name = _NOT_IN_NAMES.sub("_", motion.number)
        feed = program_number(motion.feed)
        yield f"BEGIN PGM {name} MM"
        yield from (f"; {text}" for text in program_heading(motion))
        for stop in motion.in_decimals(options.decimals).stops:
            yield f"L {axis}{stop.position:+.{options.decimals}f} R0 F{feed} M91"
            if options.waits_at(stop):
                yield "STOP"
            if stop.reading:
                yield f"; reading {stop.reading.number}, {reading_remark(stop.reading)}"
                yield from _write_dwell(motion.dwell)
        yield f"END PGM {name} MM"


def _write_dwell(seconds: float) -> Iterator[str]:
    """Yield the two blocks of cycle 9."""
    text = program_number(seconds)
    yield "CYCL DEF 9.0 DWELL TIME"
    yield f"CYCL DEF 9.1 DWELL {text if '.' in text else f'{text}.0'}"


def _write_remark(text: str) -> str:
    """Return a remark in capitals, without the underscore that not every control knows."""
    return f"({text.upper().replace('_', '-')})"


def _write_pointed(number: str) -> str:
    return number if "." in number else f"{number}."


@hookimpl
def zlmreport_part_programs() -> Iterable[PartProgram]:
    """Return the writers."""
    return [FanucProgram(), HeidenhainProgram(), LinuxCncProgram(), Siemens840dProgram()]
