"""Write the readings of this example: the axes of a machine, and two runs of a ballbar about its middle.

The machine is invented: square, its scales agree, and its Y drive lags 0.8 ms behind the X drive. Run it from
anywhere: ``python configs/machine/make.py``.
"""

# ruff: noqa: INP001 - a script among examples, in no package

from __future__ import annotations

import math
import random
from collections.abc import Iterator
from pathlib import Path

HERE = Path(__file__).parent
CENTRE, RADIUS = (250.0, 200.0), 150.0  # mm
FEED = 1000.0 / 60.0  # mm/s
LAG = 0.0008  # s, of Y behind X
LOST_MOTION = {"X": 0.8, "Y": 1.2, "Z": 0.6}  # µm
TRAVEL = {"X": 500, "Y": 400, "Z": 300}  # mm


def position_error(axis: str, at: float) -> float:
    """Return actual − nominal of an axis, µm, the mean of both directions."""
    waves = {"X": (0.006, 1.4, 60.0), "Y": (0.006, 0.9, 45.0), "Z": (-0.004, 0.6, 70.0)}
    slope, size, length = waves[axis]
    return slope * at + size * math.sin(at / length)


def straightness(axis: str, at: float) -> float:
    """Return the error across an axis in its horizontal plane, µm."""
    share = at / TRAVEL[axis]
    return 4.0 * {"X": 1.1, "Y": -0.7}[axis] * share * (1.0 - share)


def line_rows(axis: str, alignment: float, scatter: random.Random) -> Iterator[str]:
    """Yield three cycles along a side of a granite square: an indicator across the axis.

    The square stands askew by the alignment, µm/m, alike on both sides but for its own error.
    """
    targets = [TRAVEL[axis] * step / 20 for step in range(21)]
    yield "target,direction,run,deviation"
    for run in range(1, 4):
        for sign, way in ((1, targets), (-1, targets[::-1])):
            for at in way:
                value = straightness(axis, at) + alignment * at / 1000 + scatter.gauss(0, 0.2)
                yield f"{at:g},{'+' if sign > 0 else '-'},{run},{value:.2f}"


def axis_rows(axis: str, scatter: random.Random) -> Iterator[str]:
    """Yield five cycles over the axis: a laser interferometer."""
    step = TRAVEL[axis] / 20
    targets = [
        round(step * (place + (scatter.uniform(-0.3, 0.3) if 0 < place < 20 else 0)), 1)
        for place in range(21)
    ]
    yield "target,direction,run,deviation"
    for run in range(1, 6):
        for sign, way in ((1, targets), (-1, targets[::-1])):
            for at in way:
                value = position_error(axis, at) - sign * LOST_MOTION[axis] / 2 + scatter.gauss(0, 0.25)
                yield f"{at:g},{'+' if sign > 0 else '-'},{run},{value:.2f}"


def circle_rows(scatter: random.Random) -> Iterator[str]:
    """Yield a turn counter-clockwise and one clockwise: a ballbar, a reading a degree."""
    yield "sense,run,angle,deviation"
    for sense in (1, -1):
        path = 0.0
        for degree in range(360):
            angle = math.radians(sense * (degree + 0.5))
            cosine, sine = math.cos(angle), math.sin(angle)
            x, y = CENTRE[0] + RADIUS * cosine, CENTRE[1] + RADIUS * sine
            way_x, way_y = math.copysign(1, -sense * sine), math.copysign(1, sense * cosine)
            off_x = position_error("X", x) - way_x * LOST_MOTION["X"] / 2 + straightness("Y", y)
            off_y = position_error("Y", y) - way_y * LOST_MOTION["Y"] / 2 + straightness("X", x)
            off_y -= 1000.0 * LAG * sense * FEED * cosine
            path = 0.85 * path + 0.15 * scatter.gauss(0, 0.5)
            value = off_x * cosine + off_y * sine + 11.0 * cosine - 7.0 * sine + 3.0 + path
            value += scatter.gauss(0, 0.35)
            yield f"{'ccw' if sense > 0 else 'cw'},1,{math.degrees(angle) % 360:.1f},{value:.2f}"


def write(name: str, rows: Iterator[str]) -> None:
    """Write a table, its origin at the head."""
    text = "# Simulated: configs/machine/make.py\n" + "\n".join(rows) + "\n"
    (HERE / name).write_text(text, encoding="utf-8")


def main() -> None:
    """Write all tables."""
    scatter = random.Random(31)  # noqa: S311 - readings, no secret
    for axis in TRAVEL:
        write(f"{axis.lower()}-positioning.csv", axis_rows(axis, scatter))
    # C0Y = −(slope of EYX + slope of EXY): the axes are square.
    write("x-straightness.csv", line_rows("X", 31.0, scatter))
    write("y-straightness.csv", line_rows("Y", -31.0, scatter))
    write("circle-xy.csv", circle_rows(scatter))


if __name__ == "__main__":
    main()
