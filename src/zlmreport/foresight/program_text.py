"""What part programs share whatever the control: the axis's address, remarks in the head, numbers."""

from __future__ import annotations

import re
from collections.abc import Iterator

from pydantic import Field

from zlmreport.errors import InputError
from zlmreport.foresight.motion import Motion, Reading
from zlmreport.job.types import Options
from zlmreport.measurement.approach import Approach
from zlmreport.measurement.axis import AxisKind

#: Digits after the decimal point of feeds and dwells: what every control takes.
_RATE_DIGITS = 3
_TARGETS_A_LINE = 5
_LONGEST_NAME = 32
#: What no control takes for the end of a remark, for an address, or for a word of its own.
_NOT_PLAIN = re.compile(r"[^A-Za-z0-9 ._+-]")
_SIGNS = {Approach.POSITIVE: "+", Approach.NEGATIVE: "-"}


class ProgramOptions(Options):
    """The job keys that part programs share; a dialect states its own number of decimals."""

    axis: str | None = Field(
        None,
        description="Address of the axis in the program, where it is not the axis's name.",
        examples=["X"],
    )
    decimals: int = Field(3, ge=0, le=9, description="Digits after the decimal point of positions.")


def axis_address(motion: Motion, options: ProgramOptions, addresses: re.Pattern[str], such_as: str) -> str:
    """Return how the program addresses the axis.

    Parameters
    ----------
    motion
        Its axis's name serves if the options state nothing.
    options
        The keys of the part program.
    addresses
        What the control takes, in capitals.
    such_as
        The same for people.

    Raises
    ------
    InputError
        For anything else: no user's text becomes a part of a program.
    """
    address = (options.axis or motion.axis.name).strip().upper()
    if not addresses.fullmatch(address):
        raise InputError.at(
            motion.place,
            f"{address[:_LONGEST_NAME]!r} is no address of an axis on this control; state its key axis: "
            f"{such_as}",
        )
    return address


def heading(motion: Motion) -> Iterator[str]:
    """Yield the remarks at the head of a program: plain ASCII, each beginning with a word of its own."""
    unit = motion.axis.position_unit.ascii
    runs = "1 run" if motion.runs == 1 else f"{motion.runs} runs"
    readings = sum(stop.reading is not None for stop in motion.stops)
    yield f"job {_plain(motion.number)}"
    yield f"axis {_plain(motion.axis.name)}, {motion.method.value} method, {runs}, {readings} readings"
    yield (
        f"feed {program_number(motion.feed)} {unit}/min, dwell {program_number(motion.dwell)} s, "
        f"overrun {motion.overrun:.12g} {unit}"
    )
    for start in range(0, len(motion.targets), _TARGETS_A_LINE):
        some = motion.targets[start : start + _TARGETS_A_LINE]
        which = f"targets {start + 1} to {start + len(some)}" if len(some) > 1 else f"target {start + 1}"
        yield f"{which}, {' '.join(f'{target:.12g}' for target in some)} {unit}"
    if motion.axis.kind is AxisKind.ROTARY:
        yield "check that the control does not turn a rotary axis by the shorter way"


def remark(reading: Reading) -> str:
    """Return what is remarked on a reading."""
    return f"target {reading.target} {_SIGNS[reading.approach]} run {reading.run}"


def program_number(value: float) -> str:
    """Write a feed or a dwell as every control reads it: no exponent, no trailing zeros.

    >>> program_number(2000.0), program_number(4.5)
    ('2000', '4.5')
    """
    text = f"{value:.{_RATE_DIGITS}f}"
    return text.rstrip("0").rstrip(".")


def _plain(text: str) -> str:
    return _NOT_PLAIN.sub("_", text)[:_LONGEST_NAME]
