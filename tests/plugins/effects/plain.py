"""The equations of the effects once more, reading by reading in plain Python, in the users' units.

Deviations in µm (″), positions in mm (°), times in s, temperatures in °C: so a factor between the units, too,
is checked by other arithmetic than that of the program.
"""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from zlmreport.plugin.effect import Design


@dataclass(frozen=True)
class Reading:
    P: float  # mm or °
    d: float  # +1, −1
    c: int  # run
    t: float  # s
    s: float  # mm or °
    first: float  # of the measured travel
    last: float
    log: Mapping[str, float]  # °C, hPa, %
    table: tuple[Sequence[float], Sequence[float]] | None  # mm or °, µm or ″
    angles: tuple[Sequence[float], Sequence[float]] | None  # mm, µrad


Values = Mapping[str, float]
Equation = Callable[[Reading, Values], float]


def wave(angle: float, v: Values, order: int = 1) -> float:
    suffix = "" if order == 1 else f"_{order}"
    return v[f"sine{suffix}"] * math.sin(order * angle) + v[f"cosine{suffix}"] * math.cos(order * angle)


def waves(angle: float, v: Values) -> float:
    orders = (int(name.partition("_")[2] or 1) for name in v if name.startswith("sine"))
    return sum(wave(angle, v, order) for order in orders)


def interpolated(table: tuple[Sequence[float], Sequence[float]] | None, position: float) -> float:
    at, values = table
    if position <= at[0]:
        return values[0]
    if position >= at[-1]:
        return values[-1]
    right = bisect_right(at, position)
    share = (position - at[right - 1]) / (at[right] - at[right - 1])
    return values[right - 1] + share * (values[right] - values[right - 1])


def ppm(r: Reading) -> float:
    """Return Δn by the updated Edlén equation, its vapour pressure by Giacomo's formula instead of IAPWS."""

    def n(celsius: float, pascal: float, share: float) -> float:
        kelvin = celsius + 273.15
        vapour = share * math.exp(
            1.2378847e-5 * kelvin**2 - 1.9121316e-2 * kelvin + 33.93711047 - 6.3431645e3 / kelvin
        )
        s = 1 / 0.632991**2
        ns = (8342.54 + 2406147 / (130 - s) + 15998 / (38.9 - s)) * 1e-2
        x = (1 + 1e-8 * (0.601 - 0.00972 * celsius) * pascal) / (1 + 0.003661 * celsius)
        return pascal * ns * x / 96095.43 - 1e-4 * (292.75 / kelvin) * (3.7345 - 0.0401 * s) * vapour

    here = n(r.log["air_temperature"], 100 * r.log["air_pressure"], r.log["relative_humidity"] / 100)
    return here - n(20.0, 101325.0, 0.5)


def nearest(position: float, increment: float) -> float:
    """Return the nearest whole increment; half-way the upper one."""
    return math.floor(position / increment + 0.5) * increment


def fallen_back(r: Reading, v: Values) -> float:
    """Return what a pause took back and is not grown again yet."""
    since = r.t - v["restart"]
    return v["fallback"] * math.exp(-since / v["time_constant"]) if since >= 0 else 0.0


def normal(r: Reading) -> float:
    return (2 * r.P - r.first - r.last) / (r.last - r.first)


def interval(r: Reading) -> float:
    steps = sorted(b - a for a, b in zip(r.table[0], r.table[0][1:], strict=False))
    return steps[len(steps) // 2]


EQUATIONS: Mapping[str, Equation] = {
    "offset": lambda _, v: v["offset"],
    "scale-error": lambda r, v: v["slope"] * r.P * 1e-3,
    "polynomial": lambda r, v: sum(v[f"c{k}"] * normal(r) ** k for k in range(len(v))),
    "cosine-error": lambda r, v: -v["shortening"] * r.P * 1e-3,
    "screw-pitch": lambda r, v: waves(2 * math.pi * r.P / v["period"], v),
    "encoder-interpolation": lambda r, v: waves(2 * math.pi * r.P / v["period"], v),
    "periodic": lambda r, v: wave(2 * math.pi * r.P / v["period"], v),
    "scale-joint": lambda r, v: v["step"] if v["joint"] < r.P else 0.0,
    "scale-kink": lambda r, v: v["slope"] * 1e-3 * (r.P - v["kink"]) if v["kink"] < r.P else 0.0,
    "compensation-sign": lambda r, v: v["factor"] * interpolated(r.table, r.P),
    "compensation-shift": lambda r, v: (
        v["factor"] * (interpolated(r.table, r.P) - interpolated(r.table, r.P + interval(r)))
    ),
    "abbe": lambda r, v: v["abbe_offset"] * interpolated(r.angles, r.P) * 1e-3,
    "backlash": lambda r, v: v["lost_motion"] / 2 * r.d,
    "backlash-gradient": lambda r, v: v["gradient"] * r.d * r.P * 1e-3,
    "backlash-bow": lambda r, v: (
        4 * v["bow"] * r.d * (r.P - r.first) * (r.last - r.P) / (r.last - r.first) ** 2
    ),
    "reversal-relaxation": lambda r, v: v["amplitude"] * r.d * math.exp(-r.s / v["relaxation_length"]),
    "directional-pitch": lambda r, v: r.d * wave(2 * math.pi * r.P / v["period"], v),
    "scale-expansion": lambda r, v: v["expansion"] * r.P * 1e-3 * (r.log["axis_temperature"] - 20),
    "screw-expansion": lambda r, v: v["expansion"] * r.P * 1e-3 * (r.log["screw_temperature"] - 20),
    "thermal-growth": lambda r, v: v["growth"] * r.P * 1e-3 * (1 - math.exp(-r.t / v["time_constant"])),
    "thermal-drift": lambda r, v: v["drift"] * (1 - math.exp(-r.t / v["time_constant"])),
    "datum-temperature": lambda r, v: v["sensitivity"] * (r.log["axis_temperature"] - 20),
    "air-index": lambda r, v: v["factor"] * r.P * 1e-3 * ppm(r),
    "dead-path": lambda r, v: v["dead_path"] * 1e-3 * ppm(r),
    "time-periodic": lambda r, v: wave(2 * math.pi * r.t / v["period"], v),
    "datum-step": lambda r, v: v["step"] if r.t > v["moment"] else 0.0,
    "first-run": lambda r, v: v["step"] if r.c == 1 else 0.0,
    "eccentricity": lambda r, v: wave(math.radians(r.P), v),
    "ellipticity": lambda r, v: wave(math.radians(2 * r.P), v),
    "gear-mesh": lambda r, v: wave(math.radians(v["teeth"] * r.P), v),
    "worn-zone": lambda r, v: v["height"] / 2 ** ((2 * (r.P - v["place"]) / v["width"]) ** 2),
    "control-increment": lambda r, v: v["factor"] * (nearest(r.P, v["increment"]) - r.P) * 1e3,
    "scale-elements": lambda r, v: v["reset"] * (r.P % v["element"] / v["element"] - 0.5),
    "lost-motion-step": lambda r, v: r.d * v["step"] / 2 if v["place"] < r.P else 0.0,
    "lost-motion-wave": lambda r, v: r.d * wave(2 * math.pi * r.P / v["period"], v),
    "lost-motion-turn": lambda r, v: r.d * wave(math.radians(r.P), v),
    "one-way-kink": lambda r, v: v["slope"] * 1e-3 * max(0.0, r.P - v["kink"]) * (r.d > 0),
    "one-way-step": lambda r, v: v["step"] if v["place"] < r.P and r.d > 0 else 0.0,
    "drive-period": lambda r, v: wave(2 * math.pi * r.P / 10 * v["ratio"], v),
    "pole-pitch": lambda r, v: wave(2 * math.pi * r.P / 24, v),
    "growth-from-bearing": lambda r, v: (
        v["growth"] * 1e-3 * (r.P - v["fixed_point"]) * (1 - math.exp(-r.t / v["time_constant"]))
    ),
    "growth-after-pause": lambda r, v: (
        r.P * 1e-3 * (v["growth"] * (1 - math.exp(-r.t / v["time_constant"])) - fallen_back(r, v))
    ),
    "material-expansion": lambda r, v: v["expansion"] * r.P * 1e-3 * (r.log["material_temperature"] - 20),
    "passing-warmth": lambda r, v: v["drift"] / 2 ** ((2 * (r.t - v["peak"]) / v["spell"]) ** 2),
    "first-run-slope": lambda r, v: v["slope"] * r.P * 1e-3 if r.c == 1 else 0.0,
    "run-displaced": lambda r, v: v["step"] if r.c == v["which"] else 0.0,
    "probe-radius": lambda r, v: v["radius_error"] * r.log["face"],
    "gauge-misalignment": lambda r, v: -v["shortening"] * r.P * 1e-3,
}

#: The screw of the tests is held where the travel begins, at 0 mm.


def readings(design: Design) -> list[Reading]:
    """Return the readings of a design in users' units."""
    axis = design.axis
    to_mm, to_um = axis.position_unit.per_si, axis.deviation_unit.per_si
    table, angles = axis.compensation_table, axis.angular_errors
    logs = {
        "axis_temperature": (1.0, -273.15),
        "screw_temperature": (1.0, -273.15),
        "material_temperature": (1.0, -273.15),
        "air_temperature": (1.0, -273.15),
        "air_pressure": (0.01, 0.0),
        "relative_humidity": (100.0, 0.0),
        "face": (1.0, 0.0),
    }
    return [
        Reading(
            P=design.position[k] * to_mm,
            d=design.direction[k],
            c=int(design.run[k]),
            t=design.time[k],
            s=design.since_reversal[k] * to_mm,
            first=min(design.position) * to_mm,
            last=max(design.position) * to_mm,
            log={name: design.conditions[name][k] * factor + shift for name, (factor, shift) in logs.items()},
            table=table and ([P * to_mm for P in table.positions], [x * to_um for x in table.values]),
            angles=angles and ([P * to_mm for P in angles.positions], [x * 1e6 for x in angles.values]),
        )
        for k in range(len(design.position))
    ]
