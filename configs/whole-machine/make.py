"""Write the readings that this example has beside those of ``configs/machine``: pitch, and body diagonals.

The machine is the same, and so are its errors. Run it from anywhere:
``python configs/whole-machine/make.py``.
"""

# ruff: noqa: INP001 - a script among examples, in no package

from __future__ import annotations

import math
import random
import runpy
from collections.abc import Iterator
from pathlib import Path

HERE = Path(__file__).parent
MACHINE = runpy.run_path(str(HERE.parent / "machine" / "make.py"))
TRAVEL, LOST_MOTION = MACHINE["TRAVEL"], MACHINE["LOST_MOTION"]
DIAGONALS = ("PPP", "NPP", "PNP", "NNP")
STEPS = 14


def deviation(name: str, share: float, way: int) -> float:
    """Return the error along a body diagonal, µm, at a share of it."""
    length = math.hypot(*TRAVEL.values())
    total = 0.0
    places = {}
    for axis, sign in zip("XYZ", name, strict=True):
        places[axis] = TRAVEL[axis] * (share if sign == "P" else 1.0 - share)
    for axis, sign in zip("XYZ", name, strict=True):
        sense = 1 if sign == "P" else -1
        error = MACHINE["position_error"](axis, places[axis])
        error -= way * sense * LOST_MOTION[axis] / 2
        if axis != "Z":
            other = "Y" if axis == "X" else "X"
            error += MACHINE["straightness"](other, places[other])
        total += sense * error * TRAVEL[axis] / length
    return total


def diagonal_rows(name: str, scatter: random.Random) -> Iterator[str]:
    """Yield five cycles along a diagonal: a laser interferometer, set to zero at its first position."""
    length = math.floor(math.hypot(*TRAVEL.values()))
    targets = [length * step / STEPS for step in range(STEPS + 1)]
    zero = deviation(name, 0.0, 1)
    yield "target,direction,run,deviation"
    for run in range(1, 6):
        for way, visited in ((1, targets), (-1, targets[::-1])):
            for at in visited:
                value = deviation(name, at / length, way) - zero + scatter.gauss(0, 0.3)
                yield f"{at:g},{'+' if way > 0 else '-'},{run},{value:.2f}"


def pitch_rows(scatter: random.Random) -> Iterator[str]:
    """Yield three cycles of a level on the table of X: its way is bowed by a long wave."""
    targets = [25 * step for step in range(21)]
    yield "target,direction,run,deviation"
    for run in range(1, 4):
        for way, visited in ((1, targets), (-1, targets[::-1])):
            for at in visited:
                value = 1.6 * math.sin(at / 140.0) - 0.004 * at - 0.15 * way + scatter.gauss(0, 0.08)
                yield f"{at:g},{'+' if way > 0 else '-'},{run},{value:.2f}"


def write(name: str, rows: Iterator[str]) -> None:
    """Write a table, its origin at the head."""
    text = "# Simulated: configs/whole-machine/make.py\n" + "\n".join(rows) + "\n"
    (HERE / name).write_text(text, encoding="utf-8")


def main() -> None:
    """Write all tables."""
    scatter = random.Random(32)  # noqa: S311 - readings, no secret
    for name in DIAGONALS:
        write(f"{name.lower()}.csv", diagonal_rows(name, scatter))
    write("x-pitch.csv", pitch_rows(scatter))


if __name__ == "__main__":
    main()
