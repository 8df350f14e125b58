"""Squareness measured at another tool offset, or with the other axes elsewhere, than straightness."""

import json

import numpy as np
import pytest

from machines.exact import exact_deviation
from zlmreport.cli import main
from zlmreport.machines.course import ToolCourse
from zlmreport.machines.kinematics import SQUARENESS, find_square_slope
from zlmreport.machines.machine import predict
from zlmreport.machines.reading import read_machine
from zlmreport.machines.volume import Space, map_volume, predict_diagonals
from zlmreport.plugin.registry import find_plugins

ARCSECOND = np.radians(1 / 3600)
LENGTH = np.linspace(0.0, 0.4, 9)
#: The place where squareness was measured: X, Y, Z and the tool's offset, mm.
PLACE, TOOL = {"X": 120.0, "Y": 60.0, "Z": 210.0}, (30.0, -40.0, 150.0)
AT = ", at: {X: 120, Y: 60, Z: 210, tool: [30, -40, 150]}"
#: By the tool alone.
HIGHER = ((0, 0, 150), {})
#: The turns of each axis over its 0.4 m, arc seconds: rising evenly.
TURNS = {"EAX": 3, "EBX": -5, "ECX": 4, "EAY": 6, "EBY": 7, "ECY": -3, "EAZ": 1, "EBZ": -6, "ECZ": 5}


def write(tmp_path, angles, squares, where=(TOOL, PLACE), chain="XYFZ"):
    """Return the machine of a file with straight axes, read at the origin with no tool."""
    tool, place = where
    at = ", ".join([*(f"{axis}: {value}" for axis, value in place.items()), f"tool: {list(tool)}"])
    lines = ["schema: zlmreport/machine/1", f"chain: {chain}", "errors:"]
    lines += [
        f"  - {{E{d}{a}: {{0: 0, 400: 0}}, expanded_uncertainty: 0.2}}"
        for a in "XYZ"
        for d in "XYZ"
        if d != a
    ]
    lines += [
        f"  - {{{name}: {{0: 0, 400: {turn}}}, expanded_uncertainty: 0.4}}" for name, turn in angles.items()
    ]
    lines += [
        f"  - {{{name}: {value}, expanded_uncertainty: 0.6, at: {{{at}}}}}" for name, value in squares.items()
    ]
    path = tmp_path / "machine.yaml"
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return read_machine(path, find_plugins()).machine


def make_line(axis, direction, place, tool):
    """Return the line of an axis with the others at a place, mm, sensed in a direction."""
    position = np.tile([place[each] / 1e3 for each in "XYZ"], (len(LENGTH), 1))
    position[:, "XYZ".index(axis)] = LENGTH
    sensing = np.zeros_like(position)
    sensing[:, "XYZ".index(direction)] = 1.0
    return ToolCourse(position, sensing, np.zeros_like(position), tuple(each / 1e3 for each in tool))


def lean(machine, axis, direction, place, tool):
    """Return how an axis leans in the model, rad, with the others at a place, mm."""
    return np.polyfit(LENGTH, predict(machine, make_line(axis, direction, place, tool)).values, 1)[0]


@pytest.mark.parametrize("chain", ["XYFZ", "YXFZ", "FZXY"])
def test_the_model_is_as_square_as_was_measured_where_it_was_measured(tmp_path, chain):
    squares = {"C0Y": 8.0, "B0Z": -3.0, "A0Z": 5.0}
    machine = write(tmp_path, TURNS, squares, chain=chain)
    for name, value in squares.items():
        leaning, along, sign = find_square_slope(name)
        both = lean(machine, along, leaning, PLACE, TOOL) + lean(machine, leaning, along, PLACE, TOOL)
        assert sign * both / ARCSECOND == pytest.approx(value, abs=1e-6)
    assert {each.name for each in machine.moved_squares} == set(SQUARENESS)


def test_exact_matrices_lean_as_the_model_takes_off(tmp_path):
    """A straight axis that turns evenly leans at a tool's offset by arm times turn over length."""
    machine = write(tmp_path, {"EBY": 7.0}, {"C0Y": 8.0}, HIGHER)
    square = machine.find_curve("C0Y")
    along = [
        exact_deviation("XYFZ", (0.0, y, 0.0), (0.0, 0.0, 0.15), {"EBY": 7 * ARCSECOND * y / 0.4})[0]
        for y in LENGTH
    ]
    at_the_tool = np.polyfit(LENGTH, along, 1)[0]
    # ΔX along Y is −C0Y·y: what the turn adds there, C0Y had less of where it was measured.
    assert square.values[0] == pytest.approx(8 * ARCSECOND + at_the_tool, rel=1e-6)
    assert square.values[0] / ARCSECOND == pytest.approx(8 + 7 * 0.15 / 0.4)
    # U of the turn, 0.4″ at both its ends, enters beside that of the squareness itself.
    assert square.largest_uncertainty / ARCSECOND == pytest.approx(
        np.hypot(0.6, 0.4 * np.sqrt(2) * 0.15 / 0.4), rel=0.01
    )
    assert machine.moved_squares[0].measured == pytest.approx(8 * ARCSECOND)


@pytest.mark.parametrize("chain", ["XYFZ", "YXFZ", "FZXY"])
def test_where_squareness_was_measured_the_model_is_as_sure_as_it_was(tmp_path, chain):
    """What the angles lean there was taken off: their uncertainty is in both, and cancels."""
    machine = write(tmp_path, TURNS, {"C0Y": 8.0}, chain=chain)
    course = [make_line(axis, other, PLACE, TOOL) for axis, other in (("X", "Y"), ("Y", "X"))]
    both = ToolCourse(
        np.concatenate([each.position for each in course]),
        np.concatenate([each.sensing for each in course]),
        np.concatenate([each.motion for each in course]),
        course[0].tool,
    )
    off = LENGTH - LENGTH.mean()
    leaning = np.tile(off / np.sum(off**2), 2) @ predict(machine, both).factor
    assert 2 * np.linalg.norm(leaning) / ARCSECOND == pytest.approx(0.6, rel=1e-6)
    # Taken as independent of the angles, the squareness error alone would be as unsure as they are.
    assert machine.find_curve("C0Y").largest_uncertainty / ARCSECOND > 0.65


@pytest.mark.parametrize("chain", ["XYFZ", "FZXY"])
def test_u_of_the_work_space_is_what_each_stated_value_makes_of_it_in_turn(tmp_path, chain):
    """The law of propagation by differences: every value of the file moved by its u, the file read again."""
    stated = {**{name: {0: 0.0, 400: turn} for name, turn in TURNS.items()}, "C0Y": 8.0, "B0Z": -3.0}
    uncertain = {name: 0.6 if name in SQUARENESS else 0.4 for name in stated}

    def look(values):
        lines = [
            f"  - {{{name}: {value}, expanded_uncertainty: {uncertain[name]}{AT * (name in SQUARENESS)}}}"
            for name, value in values.items()
        ]
        path = tmp_path / "machine.yaml"
        path.write_text("\n".join([f"schema: zlmreport/machine/1\nchain: {chain}\nerrors:", *lines]) + "\n")
        machine = read_machine(path, find_plugins()).machine
        space = Space(np.zeros(3), np.full(3, 0.4))
        return map_volume(machine, space), predict_diagonals(machine, space)

    middle, diagonals = look(stated)
    along = middle.deviation / np.maximum(middle.length, 1e-30)[..., np.newaxis]
    moved, sensed = [], []
    for name, value in stated.items():
        for at in value if isinstance(value, dict) else [None]:
            more = (value if at is None else value[at]) + uncertain[name] / 2
            found, lines = look({**stated, name: more if at is None else {**value, at: more}})
            moved.append(np.sum((found.deviation - middle.deviation) * along, axis=-1))
            sensed.append(
                [one.deviation - other.deviation for one, other in zip(lines, diagonals, strict=True)]
            )
    expected = 2 * np.sqrt(np.sum(np.square(moved), axis=0))
    assert middle.expanded_uncertainty.ravel() == pytest.approx(expected.ravel(), rel=1e-6, abs=1e-12)
    for each, own in zip(diagonals, 2 * np.sqrt(np.sum(np.square(sensed), axis=0)), strict=True):
        assert each.expanded_uncertainty == pytest.approx(own, rel=1e-6, abs=1e-12)


def test_at_one_place_nothing_is_moved_and_nothing_doubtful(tmp_path):
    machine = write(tmp_path, {}, {"C0Y": 8.0}, ((0, 0, 0), {}))
    assert machine.find_curve("C0Y").values[0] == pytest.approx(8 * ARCSECOND)
    assert (machine.moved_squares, machine.square_doubts) == ((), ())


def test_angles_that_nobody_measured_are_a_doubt_with_its_size(tmp_path):
    """Bounds are ± 6″: 2·6″·150 mm are 8.7 µm over the range, of EBY in X and of EAX in Y each."""
    machine = write(tmp_path, {}, {"C0Y": 8.0}, HIGHER)
    found = {each.straightness: each for each in machine.square_doubts}
    assert {name: each.angles for name, each in found.items()} == {"EXY": ("EBY",), "EYX": ("EAX",)}
    for each in found.values():
        assert each.size == pytest.approx(2 * 6 * ARCSECOND * 0.15)
        assert each.length == pytest.approx(0.4)
    known = write(tmp_path, {"EBY": 7.0, "EAX": 1.0}, {"C0Y": 8.0}, HIGHER)
    assert known.square_doubts == ()


def test_where_nobody_says_the_place_of_squareness_it_is_that_of_straightness(tmp_path):
    path = tmp_path / "machine.yaml"
    path.write_text(
        "schema: zlmreport/machine/1\nchain: XYFZ\nerrors:\n"
        "  - {EXY: {0: 0, 400: 0}, expanded_uncertainty: 0.2, at: {tool: [0, 0, 120]}}\n"
        "  - {C0Y: 8, expanded_uncertainty: 0.5}\n",
        encoding="utf-8",
    )
    machine = read_machine(path, find_plugins()).machine
    assert (machine.moved_squares, machine.square_doubts) == ((), ())


@pytest.mark.parametrize("stated", ["", "X: 120", "X: 120, Z: 210", "tool: [30, -40, 150]"])
def test_of_its_place_what_nobody_says_is_that_of_straightness(tmp_path, stated):
    """The tool as well as the axes, and where the yaw of X counts from."""

    def look(at):
        known = "".join(
            f"  - {{{name}: {{0: 0, 400: {turn}}}, expanded_uncertainty: 0.4}}\n"
            for name, turn in TURNS.items()
        )
        path = tmp_path / "machine.yaml"
        path.write_text(
            f"schema: zlmreport/machine/1\nchain: XYFZ\nerrors:\n{known}"
            f"  - {{EXY: {{0: 0, 400: 0}}, expanded_uncertainty: 0.2{AT.replace('Y: 60, ', '')}}}\n"
            f"  - {{EYX: {{0: 0, 400: 0}}, expanded_uncertainty: 0.2{AT.replace('X: 120, ', '')}}}\n"
            f"  - {{C0Y: 8, expanded_uncertainty: 0.5{at}}}\n",
            encoding="utf-8",
        )
        return read_machine(path, find_plugins()).machine

    line = make_line("Y", "X", {"X": 300.0, "Y": 0.0, "Z": 20.0}, (0.0, 0.0, 0.0))
    everything = predict(look(AT), line).values
    assert np.ptp(everything) > 1e-6
    assert predict(look(f", at: {{{stated}}}"), line).values == pytest.approx(everything, abs=1e-15)


def test_a_job_of_two_lines_says_with_each_where_the_other_axis_stood(folder):
    machine = read_machine(folder / "machine.yaml", find_plugins()).machine
    assert machine.find_curve("C0Y").line.others == pytest.approx({"X": 0.25, "Y": 0.2, "Z": 0.1})
    assert machine.square_doubts == ()


def test_what_is_doubtful_is_said_with_the_errors(tmp_path, capsys):
    write(tmp_path, {}, {"C0Y": 8.0}, HIGHER)
    assert main(["machine", "predict", str(tmp_path / "machine.yaml")]) == 0
    text = " ".join(capsys.readouterr().out.split())
    assert "(EBY) may make up to 8.73 µm of it over 400 mm" in text
    write(tmp_path, {"EBY": 7.0, "EAX": 0.0}, {"C0Y": 8.0}, HIGHER)
    assert main(["machine", "predict", str(tmp_path / "machine.yaml")]) == 0
    text = " ".join(capsys.readouterr().out.split())
    assert "8″ there are 10.6″ here, by the known EBY" in text
    assert main(["machine", "predict", str(tmp_path / "machine.yaml"), "--json"]) == 0
    errors = {each["error"]: each for each in json.loads(capsys.readouterr().out)["errors"]}
    assert errors["C0Y"]["as_measured"] == pytest.approx(8.0)
