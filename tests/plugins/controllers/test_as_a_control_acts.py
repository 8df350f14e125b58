"""Axes with their tables, moved by controls written after the makers' pages: the error falls.

Each control here is written from its maker's words and reads the files by itself; nothing of the program's
own reading is used. FANUC: 0i-PB parameter manual, p. 99-100. Mitsubishi: machine error compensation,
incremental system. Siemens: Extended Functions K3, 03/2013, p. 240-241. HEIDENHAIN: technical manual
MANUALplus 620, p. 715-716. LinuxCNC: its source, tried.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

import numpy as np
import pytest

import zlmreport as z
from zlmreport.language import Language
from zlmreport.model.compensation.basis import make_basis_of_means
from zlmreport.model.compensation.curve import make_error_curve
from zlmreport.model.compensation.making import Made, make
from zlmreport.plugin import Axis, AxisKind, InputError, Place
from zlmreport.plugin.registry import find_plugins

PLACE = Place("job.yaml", 1)
#: What a control adds to a commanded position, mm (°), moving forward or back.
Control = Callable[[float, int], float]
Files = Mapping[str, str]
#: Deviations at places, moving forward (1) or back (−1), µm (″).
Error = Callable[[np.ndarray, int], np.ndarray]


def parameters_of(files: Files) -> dict[str, str]:
    return dict(line.split()[:2] for line in files["-parameters.txt"].splitlines())


def sum_sections(position: float, reference: float, interval: float, values: Mapping[int, float]) -> float:
    """Return the compensation at a position: zero at the reference point, a value for each section.

    `values`: Of the section from point k − 1 to k, points counted from the reference point.
    """

    def at_point(point: int) -> float:
        if point >= 0:
            return sum(values.get(each, 0.0) for each in range(1, point + 1))
        return -sum(values.get(each, 0.0) for each in range(point + 1, 1))

    place = (position - reference) / interval
    below = int(np.floor(place + 1e-9))
    return at_point(below) + (place - below) * values.get(below + 1, 0.0)


def run_fanuc(files: Files, reference: float) -> Control:
    stated = parameters_of(files)
    quantum, interval = float(stated["3623"]) * 1e-3, float(stated["3624"])
    entered = {int(n): int(v) * quantum for n, v in re.findall(r"N1(\d{4})P(-?\d+)", files[".txt"])}
    zero, first, last = (int(stated[each]) for each in ("3620", "3621", "3622"))
    turn = float(stated.get("3625", 0.0))
    forward = {number - zero: entered[number] for number in range(first, last + 1) if number in entered}
    back, apart = forward, 0.0
    if stated.get("3605#0") == "1":
        shift = int(stated["3626"]) - first
        back = {number - zero: entered[number + shift] for number in range(first, last + 1)}
        apart = int(stated["3627"]) * quantum
    if turn:  # of a rotary axis the farthest point on the negative side is the reference point itself
        assert first == zero
        assert last - zero == turn / interval
        forward, back = ({k: v for k, v in each.items() if k > 0} for each in (forward, back))

    def add(position: float, way: int) -> float:
        place = reference + (position - reference) % turn if turn else position
        values = forward if way > 0 else back
        total = sum_sections(place, reference, interval, values) + (0.0 if way > 0 else apart)
        if turn:  # what does not sum up to zero over a turn accumulates
            total += (position - reference) // turn * sum(values.values())
        return total

    return add


def run_mitsubishi(files: Files, reference: float) -> Control:
    """A division point n is n intervals from the reference point, and has (interval − distance) × 2."""
    rows = [line.split() for line in files["-increments.txt"].splitlines()]
    is_round = float(rows[-1][3]) - float(rows[0][2]) == 360.0  # whether it repeats is taken for granted
    points = {int(number): int(value) * 0.5e-3 for number, value, *_ in rows}
    interval = float(rows[0][3]) - float(rows[0][2])
    # The value of a point on the negative side belongs to the section towards the reference point.
    values = {(number if number > 0 else number + 1): value for number, value in points.items()}
    for number, _, begin, end in rows:
        low, high = (int(number) - 1, int(number)) if int(number) > 0 else (int(number), int(number) + 1)
        assert [float(begin), float(end)] == pytest.approx(
            [reference + low * interval, reference + high * interval], abs=2e-6
        )
    turn = 360.0 if is_round else 0.0

    def add(position: float, _: int) -> float:
        place = reference + (position - reference) % turn if turn else position
        return sum_sections(place, reference, interval, values)

    return add


def run_siemens(files: Files, _reference: float) -> Control:
    text = files["_EEC.INI"]
    values = [float(each) for each in re.findall(r"COMP\[0,\d+,\w+\]=(\S+)", text)]
    step, first, last, modulo = (
        float(re.findall(rf"COMP_{name}\[0,\w+\]=(\S+)", text)[0])
        for name in ("STEP", "MIN", "MAX", "IS_MODULO")
    )
    assert last - first == pytest.approx(step * (len(values) - 1), abs=1e-9)
    if modulo:
        assert values[0] == values[-1]  # else it jumps there
    at = first + step * np.arange(len(values))

    def add(position: float, _: int) -> float:
        place = first + (position - first) % (last - first) if modulo else position
        return -float(np.interp(place, at, values))  # a positive value moves in the negative direction

    return add


def run_heidenhain(files: Files, _reference: float) -> Control:
    rows = [[float(each) for each in line.split()] for line in files[".COM"].splitlines()[2:-1]]
    at, back, forward = np.array(rows)[:, 1:].T
    assert np.ptp(np.diff(at)) < 2e-4  # equidistant spacing is necessary

    def add(position: float, way: int) -> float:
        return -float(np.interp(position, at, forward if way > 0 else back))

    return add


def run_linuxcnc(files: Files, _reference: float) -> Control:
    at, forward, back = np.loadtxt(files[".comp"].splitlines()).T
    return lambda position, way: float(np.interp(position, at, at - (forward if way > 0 else back)))


CONTROLS: dict[str, Callable[[Files, float], Control]] = {
    "fanuc": run_fanuc,
    "mitsubishi": run_mitsubishi,
    "siemens-840d": run_siemens,
    "heidenhain": run_heidenhain,
    "linuxcnc": run_linuxcnc,
}
#: Those whose tables act in both directions with these keys, and those of one column.
DIRECTIONAL = {"linuxcnc", "heidenhain"}


#: Those that count their rows from the reference point.
COUNTING = {"fanuc", "mitsubishi"}
#: The keys of the control whose manual was read.
KEYS: dict[str, dict[str, object]] = {"heidenhain": {"backlash": "reverse"}, "fanuc": {"magnification": 2}}


def make_of(  # noqa: PLR0913, PLR0917 - a test, and what is asked for
    name: str,
    targets: Sequence[float],
    error: Error,
    axis: Axis,
    directions: str = "+-",
    step: float | None = None,
    **keys: object,
) -> Made:
    """Return the table of an axis with that error, µm (″), measured at targets in mm (°)."""
    places = np.array(targets, dtype=float)
    tests = [error(places, 1 if each == "+" else -1)[np.newaxis, :] for each in directions]
    kind = "linear" if axis.kind is AxisKind.LINEAR else "rotary"
    up = np.repeat(tests[0], 2, axis=0) if "+" in directions else None
    down = np.repeat(tests[-1], 2, axis=0) if "-" in directions else None
    readings = z.test(places, up, down, axis={"name": axis.name, "kind": kind}).measurements
    basis = make_basis_of_means(make_error_curve(readings, PLACE), readings)
    controller = find_plugins().controller(name)
    options = controller.options.model_validate(keys)
    return make(
        basis, axis, "T-1", PLACE, controller, options, step=axis.position_unit.to_si(step) if step else None
    )


def left(control: Control, targets: Sequence[float], error: Error, axis: Axis) -> np.ndarray:
    """Return what is left of the error, µm (″), shape (2, m): forward and back."""
    factor = 1e3 if axis.kind is AxisKind.LINEAR else 3600.0
    places = np.array(targets, dtype=float)
    return np.array(
        [
            error(places, way) + factor * np.array([control(float(each), way) for each in places])
            for way in (1, -1)
        ]
    )


def screw(places: np.ndarray, way: int) -> np.ndarray:
    """A screw that is 24 µm/m too long, with a bow and 4 µm of play."""
    return 0.024 * places + 6 * np.sin(places / 70) + (2 if way > 0 else -2) + 5


REFERENCES = [0.0, -400.0, 35.0, 400.0, 520.0]


@pytest.mark.parametrize("reference", REFERENCES)
@pytest.mark.parametrize("name", CONTROLS)
def test_a_linear_axis_is_taken_to_its_lost_motion(name: str, reference: float) -> None:
    axis, targets = Axis("X"), np.arange(-400.0, 401.0, 25.0)
    keys = {"reference_position": reference} if name in COUNTING else dict(KEYS.get(name, {}))
    if name == "fanuc":
        keys["reference"] = 70
    made = make_of(name, targets, screw, axis, **keys)
    rest = left(CONTROLS[name](made.files, reference), targets, screw, axis)
    play = 0.0 if name in DIRECTIONAL else 4.0
    if name not in DIRECTIONAL:
        rest += np.array([[-2.0], [2.0]])
    assert np.ptp(screw(targets, 1)) > 9
    assert np.ptp(rest) < 2.1, "half a step of the control, and straight lines between its rows"
    assert made.forecast.after.systematic * 1e6 == pytest.approx(np.ptp(rest) + play, abs=1.2)


@pytest.mark.parametrize("reference", [0.0, -400.0, 410.0])
def test_fanuc_in_both_directions_takes_the_lost_motion_too(reference: float) -> None:
    axis, targets = Axis("X"), np.arange(-400.0, 401.0, 25.0)
    keys = {"reference_position": reference, "reference": 100, "reverse": 300}
    made = make_of("fanuc", targets, screw, axis, **keys)
    rest = left(run_fanuc(made.files, reference), targets, screw, axis)
    assert np.ptp(rest) < 2.1


@pytest.mark.parametrize("directions", ["+", "-"])
@pytest.mark.parametrize("name", CONTROLS)
def test_an_axis_measured_in_one_direction_is_compensated_in_that(name: str, directions: str) -> None:
    axis, targets = Axis("X"), np.arange(0.0, 501.0, 50.0)
    made = make_of(name, targets, screw, axis, directions, **KEYS.get(name, {}))
    rest = left(CONTROLS[name](made.files, 0.0), targets, screw, axis)[int(directions == "-")]
    assert np.ptp(rest) < 2.1


def test_a_fanuc_that_counts_finer_gets_more_units() -> None:
    axis, targets = Axis("X"), np.arange(0.0, 301.0, 25.0)
    (coarse, fine) = (
        make_of("fanuc", targets, screw, axis, detection_unit=unit, magnification=7).files[".txt"]
        for unit in (0.001, 0.0005)
    )
    sums = [sum(map(int, re.findall(r"P(-?\d+)", text))) for text in (coarse, fine)]
    assert sums[1] == pytest.approx(2 * sums[0], abs=1)


def table_of_round(places: np.ndarray, way: int) -> np.ndarray:
    """A rotary table whose scale is eccentric and oval, with 1.2″ of play."""
    angle = np.radians(places)
    return 9 * np.sin(angle - 0.4) + 2 * np.cos(2 * angle) + (0.6 if way > 0 else -0.6)


ROUND = Axis("C", AxisKind.ROTARY)
#: Steps of the control, ″, and the straight lines between rows 30° apart.
UNIT, LINES = 3.6, 9 * (1 - np.cos(np.radians(15))) + 2 * (1 - np.cos(np.radians(30)))


@pytest.mark.parametrize("reference", [0.0, 90.0])
@pytest.mark.parametrize("last", [330.0, 360.0])
@pytest.mark.parametrize("name", CONTROLS)
def test_a_table_goes_round_a_rotary_axis(name: str, last: float, reference: float) -> None:
    keys = {"reference_position": reference} if name in COUNTING else KEYS.get(name, {})
    made = make_of(name, np.arange(0.0, last + 1, 30.0), table_of_round, ROUND, **keys)
    control = CONTROLS[name](made.files, reference)
    open_part = np.arange(300.0, 361.0, 2.5)
    rest = left(control, open_part, table_of_round, ROUND)
    rounding = UNIT / 2 if name in COUNTING else 0.1
    play = 0.0 if name in DIRECTIONAL else 1.2
    assert np.ptp(table_of_round(open_part, 1)) > 8
    assert np.ptp(rest) < 2 * rounding + LINES + play
    for way in (1, -1):
        assert control(360.0, way) == pytest.approx(control(0.0, way), abs=1e-9)
    if name in {"fanuc", "siemens-840d"}:  # they know what a turn is: no step, and no sum that grows
        turns = [control(120.0 + 360 * turn, 1) for turn in range(-2, 3)]
        assert turns == pytest.approx([turns[0]] * 5, abs=1e-9)


def test_fanuc_numbers_a_turn_as_its_maker_does() -> None:
    """0i-PB parameter manual, p. 100: 45°, number 60: the last is 68, and number 60 has its value."""
    made = make_of("fanuc", np.arange(0.0, 316, 45), table_of_round, ROUND, reference=60, step=45.0)
    stated = parameters_of(made.files)
    assert (stated["3620"], stated["3621"], stated["3622"], stated["3624"]) == ("60", "60", "68", "45")
    assert stated["3625"] == "360"
    values = {int(n): int(v) for n, v in re.findall(r"N1(\d{4})P(-?\d+)", made.files[".txt"])}
    assert sorted(values) == list(range(60, 69))
    assert sum(values[number] for number in range(61, 69)) == 0
    assert values[60] == values[68]


def test_a_table_with_a_larger_gap_than_between_targets_stays_open_and_so_it_is_said() -> None:
    wide = make_of("linuxcnc", np.arange(0.0, 301, 30), table_of_round, ROUND)
    assert not wide.meant.is_closed
    limited = replace(ROUND, travel=(0.0, np.radians(330.0)))
    assert not make_of("linuxcnc", np.arange(0.0, 331, 30), table_of_round, limited).meant.is_closed
    turning = replace(ROUND, travel=(0.0, 2 * np.pi))
    assert make_of("linuxcnc", np.arange(0.0, 331, 30), table_of_round, turning).meant.is_closed


def test_steps_that_do_not_go_into_a_turn_are_refused_where_rows_are_equally_far_apart() -> None:
    targets = np.arange(0.0, 331, 30)
    with pytest.raises(InputError, match="no whole number of such steps"):
        make_of("siemens-840d", targets, table_of_round, ROUND, step=50.0)
    rows = make_of("linuxcnc", targets, table_of_round, ROUND, step=50.0).decoded.positions
    assert np.degrees(rows) == pytest.approx([0, 50, 100, 150, 200, 250, 300, 350, 360])


def test_siemens_is_zero_at_a_stated_reference_point() -> None:
    axis, targets = Axis("X"), np.arange(0.0, 501.0, 50.0)
    made = make_of("siemens-840d", targets, screw, axis, reference_position=150.0)
    control = run_siemens(made.files, 0.0)
    assert control(150.0, 1) == pytest.approx(0.0, abs=1e-5)
    assert made.forecast.constant * 1e6 == pytest.approx(-screw(np.array([150.0]), 1)[0] + 2, abs=0.2)


def test_what_no_key_states_is_said_and_what_is_stated_is_not() -> None:
    axis, targets = Axis("X"), np.arange(0.0, 301.0, 25.0)

    def said(name: str, error: Error = screw, **keys: object) -> list[str]:
        made = make_of(name, targets, error, axis, **keys)
        return [each.in_language(Language.ENGLISH) for each in made.assumed]

    assert [text.count("reference_position") for text in said("fanuc", magnification=7)] == [1, 0]
    assert "0.001 mm" in said("fanuc", magnification=7)[1]
    assert said("fanuc", magnification=7, reference_position=0, detection_unit=0.001) == []
    assert len(said("mitsubishi")) == 2
    assert said("mitsubishi", reference_position=0, output_unit=0.001) == []
    assert "BACKLASH" in said("heidenhain")[0]
    assert said("heidenhain", backlash="play") == []
    assert said("heidenhain", lambda places, _: screw(places, 1)) == []
    assert said("linuxcnc") == []
