"""Write the readings of this example: a plate that is hollow and a little twisted, and an autocollimator.

Run it from anywhere: ``python configs/flatness/make.py``.
"""

# ruff: noqa: INP001 - a script among examples, in no package

from __future__ import annotations

import math
import random
from collections.abc import Iterator
from pathlib import Path

HERE = Path(__file__).parent
#: Feet apart, and the sides within which the lines run, mm.
FOOT, WIDTH, DEPTH = 100.0, 800.0, 600.0
PLACES = {
    "NW": (0.0, 1.0), "N": (0.5, 1.0), "NE": (1.0, 1.0), "E": (1.0, 0.5),
    "SE": (1.0, 0.0), "S": (0.5, 0.0), "SW": (0.0, 0.0), "W": (0.0, 0.5),
}  # fmt: skip
LINES = ("NW-SE", "NE-SW", "NW-NE", "SW-SE", "NW-SW", "NE-SE", "W-E", "N-S")
#: Of one reading, arc seconds.
SCATTER = 0.04


def height(east: float, north: float) -> float:
    """Return the height of the plate, µm, at shares of its sides."""
    hollow = 3.2 * ((east - 0.45) ** 2 + (north - 0.5) ** 2)
    worn = -0.9 * math.exp(-((east - 0.62) ** 2 + (north - 0.4) ** 2) / 0.02)
    return hollow + worn + 0.8 * (east - 0.5) * (north - 0.5)


def rows(scatter: random.Random) -> Iterator[str]:
    """Yield the readings, line by line, two runs each; each line has a zero of its own."""
    yield "line,station,run,reading"
    for name in LINES:
        (first_east, first_north), (last_east, last_north) = (PLACES[point] for point in name.split("-"))
        length = math.hypot((last_east - first_east) * WIDTH, (last_north - first_north) * DEPTH)
        steps = round(length / FOOT)
        zero = scatter.uniform(2, 12)
        heights = []
        for step in range(steps + 1):
            share = step / steps
            east = first_east + share * (last_east - first_east)
            north = first_north + share * (last_north - first_north)
            heights.append(height(east, north))
        for run in (1, 2):
            for station in range(1, steps + 1):
                slope = math.degrees((heights[station] - heights[station - 1]) * 1e-3 / FOOT) * 3600
                yield f"{name},{station},{run},{zero + slope + scatter.gauss(0, SCATTER):.2f}"


if __name__ == "__main__":
    text = "\n".join(rows(random.Random(8))) + "\n"  # noqa: S311 - an example, no secret
    (HERE / "plate.csv").write_text(text, encoding="utf-8")
