"""Write the readings of this example: an invented machine that stands idle while its hall warms and cools.

Five sensors read a mandrel in the spindle: X1 and Y1 near its end, X2 and Y2 200 mm above, Z at its end.
The hall follows the day; the spindle head follows it within two hours, the bed within eight, and what one is
ahead of the other bends the column. Run it from anywhere: ``python configs/drift/make.py``.
"""

# ruff: noqa: INP001 - a script among examples, in no package

from __future__ import annotations

import math
import random
from collections.abc import Iterator
from pathlib import Path

HERE = Path(__file__).parent
HOURS, STEP = 24.0, 5.0  # h, min
#: µm for each kelvin by which the head is warmer than at the beginning, and by which it is ahead of the bed.
GAINS = {"X1": (0.9, 2.6), "Y1": (-2.4, -4.8), "Z": (6.5, 1.2), "X2": (0.8, 1.5), "Y2": (-2.2, -2.9)}
FOLLOWS = {"spindle_temperature": 2.0, "axis_temperature": 8.0}  # h


def hall(hour: float) -> float:
    """Return the temperature of the air at an hour of the test, which begins at eight in the morning, °C."""
    day = 1.4 * math.sin(math.tau * (hour - 1.5) / 24)
    door = 0.5 * math.exp(-((hour - 5.2) ** 2) / 0.05)  # it stood open at one o'clock
    return 20.9 + day - door


def temperatures() -> Iterator[tuple[float, float, float, float]]:
    """Yield hours, and the temperatures of air, spindle head and bed, °C."""
    steps = round(HOURS * 60 / STEP)
    head, bed = hall(0.0) + 0.3, hall(0.0) + 0.1
    for number in range(steps + 1):
        hour = number * STEP / 60
        yield hour, hall(hour), head, bed
        head += (hall(hour) + 0.3 - head) * STEP / 60 / FOLLOWS["spindle_temperature"]
        bed += (hall(hour) + 0.1 - bed) * STEP / 60 / FOLLOWS["axis_temperature"]


def readings(scatter: random.Random) -> Iterator[tuple[float, dict[str, float], tuple[float, float, float]]]:
    """Yield hours, what each sensor shows, µm, and the temperatures, °C."""
    _, _, first, first_of_bed = next(temperatures())
    ahead_at_first = first - first_of_bed
    zeros = {"X1": 12.4, "Y1": -31.8, "Z": 4.2, "X2": -8.6, "Y2": 20.1}
    for hour, air, head, bed in temperatures():
        shown = {
            name: zeros[name]
            + warmer * (head - first)
            + ahead * (head - bed - ahead_at_first)
            + scatter.gauss(0, 0.04)
            for name, (warmer, ahead) in GAINS.items()
        }
        yield hour, shown, (air, head, bed)


if __name__ == "__main__":
    found = list(readings(random.Random(6)))  # noqa: S311 - noise, no secret
    wide = ["# Simulated: configs/drift/make.py"]
    wide.append(
        "time (h),X1 (µm),Y1 (µm),Z (µm),X2 (µm),Y2 (µm),air_temperature,spindle_temperature,axis_temperature"
    )
    for hour, shown, warm in found:
        cells = (
            f"{hour:.4f}",
            *(f"{each:.2f}" for each in shown.values()),
            *(f"{each:.2f}" for each in warm),
        )
        wide.append(",".join(cells))
    (HERE / "drift.csv").write_text("\n".join(wide) + "\n", encoding="utf-8")
    long = ["# Simuliert: configs/drift/make.py", "Zeit;Kanal;Wert"]
    for hour, shown, warm in found[: round(4 * 60 / STEP) + 1]:
        clock = f"18.11.2026 {8 + int(hour + 1e-6):02}:{round(hour * 60) % 60:02}"
        channels = {f"Taster {name} (µm)": shown[name] for name in ("X1", "Y1", "Z")}
        channels |= {"Halle (°C)": warm[0], "Bett (°C)": warm[2]}
        long += [
            f"{clock};{name};{value:.2f}".replace(".", ",").replace("18,11,", "18.11.")
            for name, value in channels.items()
        ]
    (HERE / "drift-schicht.csv").write_text("\n".join(long) + "\n", encoding="utf-8")
