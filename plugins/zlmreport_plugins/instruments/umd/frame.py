"""The lines that a µMD sends: one a sample, integers parted by blanks, no checksum.

One axis, 8 fields: ``REF MEAS1 DISP1 VEL1 PHASE1 SEQ LSCODE LSDATA``; three axes, 16 fields: these, then
``MEAS2 DISP2 VEL2 PHASE2 MEAS3 DISP3 VEL3 PHASE3``. Source: the firmwares 0.9 (µMD0), 57.04 and 60.00 (µMD1),
1.26, 3.15e, 2.61 and 2.64.07 (µMD2) of J. Beck and S. Goldwasser.
"""

from __future__ import annotations

import re
from enum import IntEnum
from typing import NamedTuple

_DIGITS = re.compile(rb"[-0-9 ]{15,320}")


class Code(IntEnum):
    """What the low-speed channel says, of which each line carries one number."""

    NONE = 0
    TEMPERATURE_1 = 3
    TEMPERATURE_2 = 4
    PRESSURE = 5
    HUMIDITY = 6
    SAMPLE_RATE = 8
    FIRMWARE = 10
    COUNTING = 20
    FLAGS = 112


class AxisCounts(NamedTuple):
    """What a line says of one axis.

    Attributes
    ----------
    measured
        MEAS, cycles of the measurement signal in the sample; 0 of a homodyne instrument.
    displacement
        DISP, counts from switching on.
    velocity
        VEL, counts from the sample before; 0 of a homodyne instrument.
    phase
        PHASE, the fraction of a count, or a flag that it was not found.
    """

    measured: int
    displacement: int
    velocity: int
    phase: int


class Frame(NamedTuple):
    """A line.

    Attributes
    ----------
    reference
        REF, cycles of the laser's reference in the sample; 0 of a homodyne instrument.
    axes
        One, or three.
    sequence
        SEQ, the number of the sample.
    code, data
        The low-speed channel.
    """

    reference: int
    axes: tuple[AxisCounts, ...]
    sequence: int
    code: int
    data: int


def frame_in(line: bytes) -> Frame | None:
    """Return what a line without its end says; None if it is none, such as a banner or debug text (``!``)."""
    if not _DIGITS.fullmatch(line):  # or a number might be written in a way that only Python takes for one
        return None
    fields = line.split(b" ")
    if len(fields) not in {8, 16}:
        return None
    try:
        numbers = tuple(map(int, fields))
    except ValueError:
        return None
    axes: tuple[AxisCounts, ...] = (AxisCounts(*numbers[1:5]),)
    if len(numbers) > 8:
        axes += (AxisCounts(*numbers[8:12]), AxisCounts(*numbers[12:]))
    return Frame(numbers[0], axes, *numbers[5:8])
