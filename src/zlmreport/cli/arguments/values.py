"""What stands after an option: positions, faults and ports, read from their text."""

from __future__ import annotations

import argparse
import math

from zlmreport.errors import did_you_mean

#: As `zlmreport.emulation.emulator` knows them; a test holds the two together.
FAULTS = ("lost-beam", "skipped", "error", "garbled", "unplugged")
POINT_FAULTS = ("no-touch", "no-surface", "collision", "emergency-stop", "lost-connection")


def fault(text: str) -> tuple[str, float]:
    """Read a fault and when it happens."""
    kind, _, moment = text.partition("@")
    if kind not in FAULTS:
        raise argparse.ArgumentTypeError(f"{kind!r} is no fault; {did_you_mean(kind, FAULTS)}")
    try:
        start = float(moment)
    except ValueError:
        start = math.nan
    if not (math.isfinite(start) and start >= 0):
        raise argparse.ArgumentTypeError(f"{text!r} does not say when; write seconds, such as {kind}@30")
    return kind, start


def point_fault(text: str) -> tuple[str, int]:
    """Read a fault of a coordinate measuring machine and the measuring move at which it happens."""
    kind, _, number = text.partition("@")
    if kind not in POINT_FAULTS:
        raise argparse.ArgumentTypeError(f"{kind!r} is no fault; {did_you_mean(kind, POINT_FAULTS)}")
    if not (number.isascii() and number.isdigit() and int(number)):
        raise argparse.ArgumentTypeError(f"{text!r} does not say at which move; write such as {kind}@7")
    return kind, int(number)


def course(text: str) -> tuple[float, ...]:
    """Read positions, parted by commas."""
    return tuple(position(part) for part in text.split(","))


def port(text: str) -> int:
    """Read the number of a TCP port."""
    if not (text.isascii() and text.isdigit() and int(text) < 65_536):
        raise argparse.ArgumentTypeError(f"{text!r} is no TCP port; write a number up to 65535, such as 9090")
    return int(text)


def position(text: str) -> float:
    """Read a position."""
    try:
        position = float(text)
    except ValueError:
        position = math.nan
    if not math.isfinite(position):
        raise argparse.ArgumentTypeError(f"{text!r} is no position; write a number, such as 250")
    return position


def point(text: str) -> tuple[float, float]:
    """Read two positions, parted by a comma."""
    along, _, across = text.partition(",")
    try:
        point = float(along), float(across)
    except ValueError:
        point = math.nan, math.nan
    if not all(map(math.isfinite, point)):
        raise argparse.ArgumentTypeError(f"{text!r} is no point; write two positions in mm, such as 250,130")
    return point
