"""Write the readings of this example: a ballbar on an invented machine, two turns in each sense.

The machine is 12 µrad out of square, its scales differ by 8 µm/m, X has 1.6 µm of lost motion and stands
still for a moment where it turns round. The bar reads 600 times a turn; each turn has 45° before and behind
it. Run it from anywhere: ``python configs/circle/make.py``.
"""

# ruff: noqa: INP001 - a script among examples, in no package

from __future__ import annotations

import math
import random
from collections.abc import Iterator
from pathlib import Path

HERE = Path(__file__).parent
RADIUS, FEED = 150.0, 1000.0 / 60.0  # mm, mm/s
PER_TURN, BESIDE = 600, 75  # readings of a turn, and of the arcs before and behind it
SQUARENESS, SCALES = 12e-6, 8e-6
LOST_MOTION = {"X": 1.6, "Y": 0.7}  # µm
SPIKES = {"X": (2.4, 1.5), "Y": (1.1, 1.2)}  # µm, and the way in degrees over which they fade
CENTRE = (9.0, -6.0)  # µm, of the bar
LONGER = -1.8  # µm, of the machine's radius


def deviation(angle: float, sense: int) -> float:
    """Return actual − nominal radius at an angle, rad, µm."""
    cosine, sine = math.cos(angle), math.sin(angle)
    found = LONGER + CENTRE[0] * cosine + CENTRE[1] * sine
    found += 1e3 * RADIUS * (SCALES * math.cos(2 * angle) - SQUARENESS * math.sin(2 * angle)) / 2
    for axis, size, way in (("X", cosine, -sense * sine), ("Y", sine, sense * cosine)):
        found -= LOST_MOTION[axis] / 2 * math.copysign(1.0, way) * size
        height, width = SPIKES[axis]
        since = math.degrees(sense * angle - (0.0 if axis == "X" else math.pi / 2)) % 180.0
        found += height * math.exp(-since / width)
    return found


def rows(scatter: random.Random) -> Iterator[str]:
    """Yield the readings in the order of time: of each turn its number, sense, angle, deviation, moment."""
    yield "sense,run,angle,deviation,time"
    begins = 0.0
    for run in (1, 2):
        for name, sense in (("ccw", 1), ("cw", -1)):
            for step in range(-BESIDE, PER_TURN + BESIDE + 1):
                angle = sense * math.tau * step / PER_TURN
                value = deviation(angle, sense) + scatter.gauss(0, 0.12)
                time = begins + math.tau * (step + BESIDE) / PER_TURN * RADIUS / FEED
                yield f"{name},{run},{math.degrees(angle) % 360:.1f},{value:.1f},{time:.2f}"
            begins += math.tau * (PER_TURN + 2 * BESIDE) / PER_TURN * RADIUS / FEED + 8.0


if __name__ == "__main__":
    lines = ["# Simulated: configs/circle/make.py", *rows(random.Random(4))]  # noqa: S311 - noise, no secret
    (HERE / "circle-xy.csv").write_text("\n".join(lines) + "\n", encoding="utf-8")
