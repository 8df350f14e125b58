"""Machines, a plate and an environment that are known, each with its job and the worlds it is measured in."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

import set_ups
from set_ups import KINDS, SLOW, World, on_each
from zlmreport.evaluation.uncertainty.drift import Drift
from zlmreport.measurement.arrays import FloatArray

#: Returns readings at places along a line, in their unit, for a side of −1 or 1.
Truth = Callable[[FloatArray, int], FloatArray]
_LENGTHS = ("misalignment", "machine_temperature", "device_temperature")
_COEFFICIENTS = ("expansion_coefficient", "device_expansion_coefficient")


@dataclass(frozen=True)
class Quantity:
    """What is measured, on what, and by which job."""

    keys: Mapping[str, Any]  #: Of the job.
    files: Mapping[str, str]  #: Readings without scatter, by the names of their files.
    worlds: Mapping[str, World]
    symbols: tuple[str, ...]  #: Of the parameters that are printed.
    scatter: float  #: Of the readings, which is the machine's and no error.
    step: float  #: In which readings are shown.
    left_out: tuple[str, ...] = ()  #: What the worlds say nothing of.


def _negligible(*names: str) -> dict[str, Any]:
    return {"negligible": dict.fromkeys(names, "there is none in this world")}


def _table(targets: FloatArray, truth: Truth, runs: int) -> str:
    """Return the readings of one line as a table: so many runs there and back."""
    rows = ["target,direction,run,deviation"]
    for run in range(1, runs + 1):
        for side, sign in ((1, "+"), (-1, "-")):
            values = truth(targets, side)
            rows += [
                f"{target:.4f},{sign},{run},{value:.6f}"
                for target, value in list(zip(targets, values, strict=True))[::side]
            ]
    return "\n".join(rows) + "\n"


def _stated(
    instrument: float, variation: float = 0.0, *others: Mapping[str, Any], **keys: Any
) -> dict[str, Any]:
    """Return what a job states of an instrument, of a drift and of what has no key of its own."""
    drift: dict[str, Any] = {"environmental_variation": variation} if variation else {}
    if not variation:
        drift = _negligible("environmental_variation")
    return {
        "instrument": {"name": "I", "expanded_uncertainty": instrument},
        "uncertainty": {**drift, "contributions": list(others)},
        **keys,
    }


def _worlds(
    of_device: Mapping[str, tuple[set_ups.Error, ...]], stated: Mapping[str, Any]
) -> dict[str, World]:
    return {name: World(errors, stated) for name, errors in of_device.items()}


def _drifts(full_range: float, stated: Mapping[str, Any], kinds: Iterable[Drift] = KINDS) -> dict[str, World]:
    return {
        f"drift of {full_range:g}, {kind.value}": World((set_ups.drifting(full_range, kind),), stated)
        for kind in kinds
    }


_NOTHING = 1e-3  #: U of an instrument that does nothing in a world.


def _straightness() -> Quantity:
    """Return EYX over 900 mm by a mirror and a prism: flatness of the mirror, slope of the set-up, air."""
    targets = np.linspace(0, 900, 10)

    def truth(x: FloatArray, side: int) -> FloatArray:
        share = x / 900
        return np.asarray(
            3 * (share - share**2) * 2 + 0.4 * np.sin(9 * share) + 100 * 0.9 * share + 0.15 * side
        )

    mirror = _stated(0.5)
    scale = {"name": "Scale", "acts": "with-the-reading", "expanded_uncertainty": 1.0}
    everything = _stated(0.5, 0.6, scale)
    return Quantity(
        keys={
            "axis": {"name": "X"},
            "measurement": {"error": "EYX", "source": {"plugin": "laser-csv", "file": "x.csv"}},
            "evaluate": ["iso230-1:2012"],
        },
        files={"x.csv": _table(targets, truth, 3)},
        worlds={
            **_worlds(
                {
                    "mirror, each position": (set_ups.at_each_position(0.25),),
                    "mirror, a smooth curve": (set_ups.smooth(0.25, 0.3),),
                    "mirror, a smoother curve": (set_ups.smooth(0.25, 0.7),),
                    "mirror, a bow": (set_ups.bow(0.25),),
                    "mirror, half a wave": (set_ups.wave(0.25, 0.5),),
                    "mirror, one wave": (set_ups.wave(0.25, 1.0),),
                    "mirror, two waves": (set_ups.wave(0.25, 2.0),),
                },
                mirror,
            ),
            **_worlds(
                {
                    "finer mirror, each position": (set_ups.at_each_position(0.12),),
                    "finer mirror, one wave": (set_ups.wave(0.12, 1.0),),
                    "finer mirror, two waves": (set_ups.wave(0.12, 2.0),),
                },
                _stated(0.24),
            ),
            "slope of 100 µm/m, scale of 1 %": World(
                (set_ups.in_proportion(0.5),), _stated(_NOTHING, 0, scale)
            ),
            **_drifts(0.6, _stated(_NOTHING, 0.6)),
            **{
                f"mirror, slope and air, {kind.value}": World(
                    (set_ups.smooth(0.25, 0.3), set_ups.in_proportion(0.5), set_ups.drifting(0.6, kind)),
                    everything,
                )
                for kind in (Drift.NOISE, Drift.RANDOM_WALK)
            },
        },
        symbols=("EYX", "EYX_fwd", "EYX_bwd", "EYX_run", "EYX_local", "slope"),
        scatter=0.15,
        step=0.01,
    )


def _angle() -> Quantity:
    """Return EBX over 1 m by an angle interferometer: its scale, the air in its dead path, its sine."""
    targets = np.linspace(0, 1000, 11)

    def truth(x: FloatArray, side: int) -> FloatArray:
        share = x / 1000
        return np.asarray(8 * share**2 + 0.5 * np.sin(8 * share) + 0.1 * side)

    scale = {"name": "Scale", "acts": "with-the-reading", "expanded_uncertainty": 0.6}
    travel = {"name": "Per metre of travel", "acts": "along-the-length", "expanded_uncertainty": 0.1}
    path = {"name": "Dead path", "acts": "in-time", "range": 0.2}
    return Quantity(
        keys={
            "axis": {"name": "X"},
            "measurement": {"error": "EBX", "source": {"plugin": "laser-csv", "file": "x.csv"}},
            "evaluate": ["iso230-1:2012"],
        },
        files={"x.csv": _table(targets, truth, 3)},
        worlds={
            **_worlds(
                {
                    "instrument, each position": (set_ups.at_each_position(0.1),),
                    "instrument, a smooth curve": (set_ups.smooth(0.1, 0.3),),
                    "instrument, a smoother curve": (set_ups.smooth(0.1, 0.7),),
                },
                _stated(0.2),
            ),
            "scale and sine": World(
                (set_ups.in_proportion(0.3), on_each(set_ups.sine)), _stated(_NOTHING, 0, scale)
            ),
            "per metre of travel": World((set_ups.along_the_length(0.05),), _stated(_NOTHING, 0, travel)),
            **{
                f"dead path, {kind.value}": World((set_ups.drifting(0.2, kind),), _stated(_NOTHING, 0, path))
                for kind in KINDS
            },
            **{
                f"all of these, {kind.value}": World(
                    (
                        set_ups.smooth(0.1, 0.3),
                        set_ups.in_proportion(0.3),
                        on_each(set_ups.sine),
                        set_ups.along_the_length(0.05),
                        set_ups.drifting(0.2, kind),
                    ),
                    _stated(0.2, 0, scale, travel, path),
                )
                for kind in (Drift.NOISE, Drift.RANDOM_WALK)
            },
        },
        symbols=("EBX", "EBX_fwd", "EBX_bwd", "EBX_both"),
        scatter=0.05,
        step=0.01,
    )


def _squareness() -> Quantity:
    """Return C0Y from two lines against one square: its angle, its faces, the indicator, the environment."""
    lines = {"x": np.linspace(0, 500, 11), "y": np.linspace(0, 400, 9)}

    def truth(x: FloatArray, side: int) -> FloatArray:
        share = x / x[-1]
        return np.asarray(12e-3 * x + 1.5 * (share - share**2) + 0.2 * np.sin(9 * share) + 0.1 * side)

    def of_the_square(expanded: float) -> dict[str, Any]:
        return {"square": {"error": 0, "expanded_uncertainty": expanded}}

    square, faces = of_the_square(0.5), of_the_square(1e-4)
    return Quantity(
        keys={
            "measurement": {
                "error": "C0Y",
                "tests": {
                    name: {"error": error, "source": {"plugin": "laser-csv", "file": f"{name}.csv"}}
                    for name, error in (("x", "EYX"), ("y", "EXY"))
                },
            },
            "evaluate": ["iso230-1:2012"],
        },
        files={f"{name}.csv": _table(at, truth, 3) for name, at in lines.items()},
        worlds={
            "square": World((set_ups.square_of(0.25),), _stated(_NOTHING, 0, **square)),
            **_worlds(
                {
                    "faces, each position": (set_ups.at_each_position(0.15),),
                    "faces, a smooth curve": (set_ups.smooth(0.15, 0.3),),
                    "faces, a smoother curve": (set_ups.smooth(0.15, 0.7),),
                    "faces, a bow": (set_ups.bow(0.15),),
                    "faces, half a wave": (set_ups.wave(0.15, 0.5),),
                    "faces, one wave": (set_ups.wave(0.15, 1.0),),
                    "faces, two waves": (set_ups.wave(0.15, 2.0),),
                },
                _stated(0.3, 0, **faces),
            ),
            **_drifts(0.5, _stated(_NOTHING, 0.5, **faces)),
            **{
                f"all of these, {kind.value}": World(
                    (set_ups.square_of(0.25), set_ups.smooth(0.15, 0.3), set_ups.drifting(0.5, kind)),
                    _stated(0.3, 0.5, **square),
                )
                for kind in (Drift.NOISE, Drift.RANDOM_WALK)
            },
        },
        symbols=("C0Y", "slope_1", "slope_2"),
        scatter=0.1,
        step=0.01,
    )


_ANGLES, _TURNS = 180, 2
_CIRCLE = ("G_ccw", "G_cw", "G_b", "F_max_ccw", "F_min_ccw", "F_max_cw", "F_min_cw", "D")


def _path(angles: FloatArray, side: int) -> FloatArray:
    """Return the path of a machine that is out of square, has lost motion, and stands off centre, µm."""
    path = 1.5 * np.sin(2 * angles) + 0.6 * np.cos(3 * angles) + 2.0
    path += side * (-1.2 * np.sign(np.sin(angles)) * np.cos(angles))
    path += side * (0.8 * np.sign(np.cos(angles)) * np.sin(angles))
    return np.asarray(path + 12.0 * np.cos(angles) - 5.0 * np.sin(angles))


def _circle_file(arc: float, centre: float) -> str:
    """Return two turns, or arcs of so many degrees, in each sense; `centre`: whether it lies off, 1 or 0."""
    degrees = (np.arange(_ANGLES) + 0.5) * arc / _ANGLES
    angles = np.radians(degrees)
    off = (1 - centre) * (12.0 * np.cos(angles) - 5.0 * np.sin(angles))
    rows = ["sense,run,angle,deviation"]
    for run in range(1, _TURNS + 1):
        for sense, side in (("ccw", 1), ("cw", -1)):
            rows += [
                f"{sense},{run},{angle:.3f},{value:.6f}"
                for angle, value in list(zip(degrees, _path(angles, side) - off, strict=True))[::side]
            ]
    return "\n".join(rows) + "\n"


def _circle_keys(*, calibrated: bool) -> dict[str, Any]:
    return {
        "circle": {"plane": "XY", "radius": 150, "feed": 1000, "calibrated_length": calibrated},
        "measurement": {"source": {"plugin": "circle-csv", "file": "c.csv", "feed_in": 0, "feed_out": 0}},
        "evaluate": ["iso230-4:2005"],
        "environment": {"axis_temperature": 20, "expansion_coefficient": 11.5},
    }


def _circle() -> Quantity:
    """Return a ballbar on a full turn: its curve, its length, its temperature, the environment."""
    of_radius = ("device_temperature", *_COEFFICIENTS, "centring")

    def stated(instrument: float, variation: float = 0.0, **of_length: float) -> dict[str, Any]:
        found = _stated(instrument, variation)
        silent = {"calibrated_length", "machine_temperature"} - of_length.keys()
        left = _negligible(*of_radius, *silent, *(() if variation else ("environmental_variation",)))
        return {**found, "uncertainty": {**found["uncertainty"], **left, **of_length}}

    device, length = set_ups.round_the_circle(0.25, 2, 3, 4), set_ups.all_alike(0.4)
    warm = set_ups.uniform_alike(11.5 * 0.15 * 0.6)
    return Quantity(
        keys=_circle_keys(calibrated=True),
        files={"c.csv": _circle_file(360, 1)},
        worlds={
            **_worlds(
                {
                    "instrument, smooth over the angle": (device,),
                    "instrument, two lobes": (set_ups.round_the_circle(0.25, 2),),
                    "instrument, four lobes": (set_ups.round_the_circle(0.25, 4),),
                    "instrument, in proportion to the displacement": (set_ups.in_proportion(0.25 / 0.18),),
                    "instrument, the same everywhere": (set_ups.all_alike(0.25),),
                },
                stated(0.5),
            ),
            "instrument and length": World((device, length), stated(0.5, calibrated_length=0.8)),
            "length and temperature": World(
                (length, warm), stated(_NOTHING, calibrated_length=0.8, machine_temperature=0.6)
            ),
            **{
                f"instrument, length, drift of 0.6, {kind.value}": World(
                    (device, length, set_ups.drifting(0.6, kind)), stated(0.5, 0.6, calibrated_length=0.8)
                )
                for kind in SLOW
            },
        },
        symbols=_CIRCLE,
        scatter=0.1,
        step=0.1,
    )


def _arc() -> Quantity:
    """Return a ballbar on an arc of 200°, which does not tell its centre: curve, length, centring."""
    of_radius = ("machine_temperature", "device_temperature", *_COEFFICIENTS, "environmental_variation")

    def stated(instrument: float, **others: float) -> dict[str, Any]:
        found = _stated(instrument)
        silent = {"calibrated_length", "centring"} - others.keys()
        return {**found, "uncertainty": {**_negligible(*of_radius, *silent), **others}}

    device, length = set_ups.round_the_circle(0.25, 2, 3, 4), set_ups.all_alike(0.4)
    return Quantity(
        keys=_circle_keys(calibrated=True),
        files={"c.csv": _circle_file(200, 0)},
        worlds={
            "instrument, smooth over the angle": World((device,), stated(0.5)),
            "centring": World((set_ups.off_centre(2.0),), stated(_NOTHING, centring=2.0)),
            "instrument, length and centring": World(
                (device, length, set_ups.off_centre(2.0)), stated(0.5, calibrated_length=0.8, centring=2.0)
            ),
        },
        symbols=_CIRCLE,
        scatter=0.1,
        step=0.1,
    )


_SIDES = {"NW-SE": 1000, "NE-SW": 1000, "NW-NE": 800, "SW-SE": 800, "NW-SW": 600, "NE-SE": 600}
_SIDES |= {"W-E": 800, "N-S": 600}
_CORNERS = {"NW": (0, 1), "N": (0.5, 1), "NE": (1, 1), "E": (1, 0.5), "SE": (1, 0), "S": (0.5, 0)}
_CORNERS |= {"SW": (0, 0), "W": (0, 0.5)}
_FOOT = 100


def _plate_file(runs: int) -> str:
    """Return the slopes of a plate with a hollow and a twist, ″, on a carriage that leans by 3″."""

    def height(at: FloatArray) -> FloatArray:
        x, y = at[..., 0] - 0.5, at[..., 1] - 0.5
        return np.asarray(9 * (x**2 + y**2) + 5 * x * y + 0.7 * np.sin(7 * x + 3 * y))  # µm

    rows = ["line,station,run,reading"]
    for name, length in _SIDES.items():
        first, last = (np.array(_CORNERS[point], dtype=float) for point in name.split("-"))
        shares = np.arange(0, length + 1, _FOOT) / length
        slopes = np.diff(height(first + shares[:, np.newaxis] * (last - first))) / _FOOT * 1e-3
        rows += [
            f"{name},{station},{run},{3 + slope * 648_000 / np.pi:.6f}"
            for run in range(1, runs + 1)
            for station, slope in enumerate(slopes, 1)
        ]
    return "\n".join(rows) + "\n"


def _flatness() -> Quantity:
    """Return a plate of 800 x 600 mm by an autocollimator: readings, scale, the feet of the carriage."""
    scale = {"name": "Scale", "acts": "with-the-reading", "expanded_uncertainty": 1.0}

    def stated(
        instrument: float,
        variation: float = 0.0,
        *others: Mapping[str, Any],
        feet: float = 0.0,
        acts: str = "",
    ) -> dict[str, Any]:
        found = _stated(instrument, variation, *others)
        keys = {**found["uncertainty"], **({"instrument_acts": acts} if acts else {})}
        if feet:
            return {**found, "uncertainty": keys, "carriage": {"expanded_uncertainty": feet}}
        keys["negligible"] = {**keys.get("negligible", {}), "foot_spacing": "there is no error in this world"}
        return {**found, "uncertainty": keys}

    own, same = stated(0.2, acts="at-each-reading"), stated(0.2)
    return Quantity(
        keys={
            "measurement": {
                "tests": {
                    name: {"source": {"plugin": "plate-csv", "file": "plate.csv", "foot": _FOOT}}
                    for name in _SIDES
                }
            },
            "evaluate": ["union-jack"],
        },
        files={"plate.csv": _plate_file(2)},
        worlds={
            "instrument, each reading": World((set_ups.at_each_reading(0.1),), own),
            "instrument, each station": World((set_ups.at_each_position(0.1),), same),
            "instrument, a curve over 6″": World((set_ups.over_the_reading(0.1, 6.0),), same),
            "instrument, a curve over 2″": World((set_ups.over_the_reading(0.1, 2.0),), same),
            "scale": World((set_ups.in_proportion(0.5),), stated(_NOTHING, 0, scale)),
            "feet": World((set_ups.in_proportion(0.5),), stated(_NOTHING, feet=1.0)),
            **_drifts(0.3, stated(_NOTHING, 0.3)),
            **{
                f"all of these, {kind.value}": World(
                    (
                        set_ups.at_each_position(0.1),
                        set_ups.in_proportion(0.5),
                        set_ups.in_proportion(0.5),
                        set_ups.drifting(0.3, kind),
                    ),
                    stated(0.2, 0.3, scale, feet=1.0),
                )
                for kind in (Drift.NOISE, Drift.RANDOM_WALK)
            },
        },
        symbols=("t", "t_LS", "t_MZ", "closure_WE", "closure_NS"),
        scatter=0.03,
        step=0.01,
    )


def _drift_file() -> str:
    """Return 24 h of five sensors, every ten minutes."""
    hours = np.arange(0, 24.01, 1 / 6)
    warm = 1 - np.exp(-hours / 5)
    day = np.sin(2 * np.pi * hours / 24)
    channels = {
        "X1": 4 * warm + 1.2 * day,
        "Y1": -7 * warm + 0.8 * day,
        "Z": 15 * warm + 2.5 * day,
        "X2": 3 * warm + 1.4 * day,
        "Y2": -4 * warm + 0.9 * day,
    }
    rows = [",".join(["time (h)", *(f"{name} (µm)" for name in channels)])]
    rows += [
        ",".join(f"{value:.6f}" for value in (hour, *values))
        for hour, *values in zip(hours, *channels.values(), strict=True)
    ]
    return "\n".join(rows) + "\n"


def _drift() -> Quantity:
    """Return a day of a standing machine by five sensors: their own drift and their scales."""
    scale = {"name": "Scale", "acts": "with-the-reading", "expanded_uncertainty": 2.0}
    return Quantity(
        keys={
            "measurement": {
                "tests": {
                    name: {"source": {"plugin": "channels-csv", "file": "d.csv"}}
                    for name in ("X1", "Y1", "Z", "X2", "Y2")
                }
            },
            "evaluate": [{"standard": "iso230-3", "hours": 24, "distance": {"X": 200, "Y": 200}}],
        },
        files={"d.csv": _drift_file()},
        worlds={
            **{
                f"sensors drift by 0.7, {kind.value}": World(
                    (set_ups.drifting(0.2 * 12**0.5, kind),),
                    {"instrument": {"name": "I", "expanded_uncertainty": 0.4}},
                )
                for kind in SLOW
            },
            "scales": World(
                (set_ups.own_scale(1.0),),
                {
                    "instrument": {"name": "I", "expanded_uncertainty": _NOTHING},
                    "uncertainty": {"contributions": [scale]},
                },
            ),
            **{
                f"scales, sensors drift by 0.7, {kind.value}": World(
                    (set_ups.own_scale(1.0), set_ups.drifting(0.2 * 12**0.5, kind)),
                    {
                        "instrument": {"name": "I", "expanded_uncertainty": 0.4},
                        "uncertainty": {"contributions": [scale]},
                    },
                )
                for kind in SLOW
            },
        },
        symbols=("E_X1", "E_Y1", "E_Z", "E_X2", "E_Y2", "tilt_X", "tilt_Y"),
        scatter=0.02,
        step=0.01,
    )


def _diagonals() -> Quantity:
    """Return body diagonals of 500 x 400 x 300 mm by one laser: wavelength, alignment, expansion."""
    length = float(np.hypot(np.hypot(500, 400), 300))
    targets = np.linspace(0, length, 11)
    slopes = {"PPP": 9.0, "NPP": -4.0, "PNP": 6.0, "NNP": 2.0}

    def along(slope: float) -> Truth:
        def truth(x: FloatArray, side: int) -> FloatArray:
            return np.asarray(slope * x / 1000 + 0.8 * np.sin(x / 90 + slope) + 0.5 * side)

        return truth

    def stated(instrument: float | str, variation: float = 0.0, **of_length: float) -> dict[str, Any]:
        found = _stated(instrument, variation)
        silent = {*_LENGTHS, *_COEFFICIENTS} - of_length.keys()
        left = _negligible(*silent, *(() if variation else ("environmental_variation",)))
        compensates = {"compensates": {"air": True}}
        return {
            "instrument": {**found["instrument"], **compensates},
            "uncertainty": {**found["uncertainty"], **left, **of_length},
        }

    scale, warm = set_ups.one_scale(0.4), set_ups.one_scale_in(11.5 * 0.4)
    return Quantity(
        keys={
            "axes": {"X": [0, 500], "Y": [0, 400], "Z": [0, 300]},
            "measurement": {
                "tests": {name: {"source": {"plugin": "laser-csv", "file": f"{name}.csv"}} for name in slopes}
            },
            "environment": {"axis_temperature": 20, "expansion_coefficient": 11.5},
            "evaluate": ["iso230-6:2002"],
        },
        files={f"{name}.csv": _table(targets, along(slope), 5) for name, slope in slopes.items()},
        worlds={
            **_worlds(
                {
                    "instrument, each position": (set_ups.at_each_position(0.2),),
                    "instrument, a smooth curve": (set_ups.smooth(0.2, 0.3),),
                    "instrument, a smoother curve": (set_ups.smooth(0.2, 0.7),),
                },
                stated(0.4),
            ),
            "wavelength": World((scale,), stated("0.001 + 0.8*L")),
            "misalignment": World((set_ups.misaligned(1.5),), stated(_NOTHING, misalignment=1.5)),
            "temperature": World((warm,), stated(_NOTHING, machine_temperature=0.4)),
            **_drifts(0.6, stated(_NOTHING, 0.6)),
            **{
                f"all of these, {kind.value}": World(
                    (
                        set_ups.smooth(0.2, 0.3),
                        scale,
                        set_ups.misaligned(1.5),
                        warm,
                        set_ups.drifting(0.6, kind),
                    ),
                    stated("0.4 + 0.8*L", 0.6, misalignment=1.5, machine_temperature=0.4),
                )
                for kind in (Drift.NOISE, Drift.RANDOM_WALK)
            },
        },
        symbols=(
            "E_d",
            "B_d",
            *(f"{letter}_{name}" for name in slopes for letter in ("E", "B")),
        ),
        scatter=0.3,
        step=0.01,
    )


QUANTITIES: Mapping[str, Quantity] = {
    "straightness": _straightness(),
    "angle": _angle(),
    "squareness": _squareness(),
    "circle": _circle(),
    "arc": _arc(),
    "flatness": _flatness(),
    "drift": _drift(),
    "diagonals": _diagonals(),
}
