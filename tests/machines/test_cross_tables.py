"""Tables across axes: what was entered goes, no sign is guessed, what a control cannot take is said."""

import json
from dataclasses import replace

import numpy as np
import pytest

import zlmreport as z
from machines.simulated import added, bare_machine, circle, lagging, out_of_square as turned
from machines.test_command import values
from zlmreport.cli import main
from zlmreport.machines.course import ToolCourse
from zlmreport.machines.cross_confirmation import CrossVerdict, confirm_circles
from zlmreport.machines.cross_tables import compensate_machine, plan_tables
from zlmreport.machines.curve import AxisErrorCurve
from zlmreport.machines.kinematics import ErrorLine
from zlmreport.machines.machine import predict
from zlmreport.plugin import InputError, Place
from zlmreport.plugin.registry import find_plugins

PLACE = Place("test")
NODES = np.linspace(0, 0.4, 9)
BOW = 8e-6 * (NODES / 0.2 - 1) ** 2


def square(name, value, u=1e-6):
    return AxisErrorCurve(name, np.zeros(1), np.array([value]), np.eye(1) * u, ErrorLine({}), "test")


def curve(name, values, u=0.1e-6):
    return AxisErrorCurve(name, NODES, np.asarray(values), np.eye(9) * u, ErrorLine({}), "test")


def displacements(machine):
    """What is left of Δ at some places, m, relative to the first."""
    places = np.array([[0, 0, 0], [0.4, 0.1, 0.3], [0.2, 0.35, 0.05], [0.05, 0.2, 0.4]])
    found = []
    for sensing in np.eye(3):
        course = ToolCourse(places, np.tile(sensing, (4, 1)), np.zeros_like(places))
        found.append(predict(machine, course).values)
    whole = np.array(found).T
    return whole - whole[0]


@pytest.fixture(scope="module")
def controls():
    return find_plugins()


@pytest.fixture
def out_of_square():
    """A machine of which all that a table across axes can hold is known, and nothing else."""
    straight = [curve(name, BOW) for name in ("EYX", "EXY", "EZX", "EXZ", "EYZ", "EZY")]
    return bare_machine([*straight, square("C0Y", 40e-6), square("B0Z", -25e-6), square("A0Z", 15e-6)])


@pytest.mark.parametrize("moves", [1, -1])
def test_what_siemens_reads_back_leaves_nothing_of_straightness_and_squareness(
    out_of_square, controls, moves
):
    control = controls.controller("siemens-840d-cec")
    plan = plan_tables(out_of_square, PLACE)
    assert len(plan.tables) == 6
    files = control.cross_files(plan.tables, moves)
    decoded = control.read_cross(files, plan.tables, moves)
    assert np.abs(displacements(out_of_square)).max() > 15e-6
    assert np.abs(displacements(compensate_machine(out_of_square, decoded))).max() < 0.05e-6


def test_a_wrong_sign_doubles_the_error(out_of_square, controls):
    control = controls.controller("siemens-840d-cec")
    plan = plan_tables(out_of_square, PLACE)
    decoded = control.read_cross(control.cross_files(plan.tables, 1), plan.tables, -1)
    before = displacements(out_of_square)
    assert displacements(compensate_machine(out_of_square, decoded)) == pytest.approx(2 * before, abs=0.05e-6)


def test_a_positive_value_that_moves_back_is_the_deviation_itself(controls):
    table = plan_tables(bare_machine([curve("EYX", BOW)]), PLACE).tables[0]
    (text,) = controls.controller("siemens-840d-cec").cross_files([table], -1).values()
    assert "$AN_CEC[0,8]=-0.00800\n" in text  # the middle lies 8 µm below the first row
    assert "$AN_CEC_INPUT_AXIS[0]=(X1)\n$AN_CEC_OUTPUT_AXIS[0]=(Y1)\n" in text
    assert "$AN_CEC_DIRECTION[0]=0\n" in text


def test_linuxcnc_takes_squareness_by_its_kinematics_and_leaves_straightness(out_of_square, controls):
    control = controls.controller("linuxcnc")
    plan = plan_tables(out_of_square, PLACE)
    files = control.cross_files(plan.tables, 1)
    # joint X = x + C_xy·y: C0Y > 0 leans Y towards −X, so X goes to +.
    assert sorted(files["-square.hal"].splitlines()) == [
        "setp matrixkins.C_xy 0.000040000",
        "setp matrixkins.C_xz 0.000025000",
        "setp matrixkins.C_yz 0.000015000",
    ]
    decoded = control.read_cross(files, plan.tables, 1)
    straight = bare_machine([each for each in out_of_square.curves if not each.is_single])
    assert displacements(compensate_machine(out_of_square, decoded)) == pytest.approx(
        displacements(straight), abs=1e-9
    )


def test_an_error_within_its_uncertainty_is_left():
    machine = bare_machine([curve("EYX", BOW), square("C0Y", 1e-6, u=2e-6)])
    plan = plan_tables(machine, PLACE)
    assert (plan.taken, plan.within_uncertainty) == (("EYX",), ("C0Y",))
    with pytest.raises(InputError, match="nothing for a table across axes"):
        plan_tables(bare_machine([square("C0Y", 1e-6, u=2e-6)]), PLACE)


def test_the_command_writes_the_table_with_its_forecast(folder, tmp_path, capsys):
    path = folder / "machine.yaml"
    found = values(
        capsys, "machine", "compensate", path, "--controller", "siemens-840d-cec", "--moves", "minus",
        "-o", tmp_path / "out",
    )  # fmt: skip
    assert found["schema"] == "zlmreport/machine-compensation/1"
    assert (found["taken"], found["within_uncertainty"]) == (["EYX", "EXY"], ["C0Y"])
    assert (tmp_path / "out" / "machine-across_CEC.INI").is_file()
    before, after = found["forecast"]["largest"]
    assert after < before


def test_an_unknown_sign_is_asked_for_and_a_trial_shows_it(folder, tmp_path, capsys):
    path = folder / "machine.yaml"
    command = ["machine", "compensate", str(path), "--controller", "siemens-840d-cec", "-o", str(tmp_path)]
    assert main(command) == 2
    assert "--trial writes a file that shows it" in capsys.readouterr().err
    assert not list(tmp_path.glob("*.INI"))
    assert main([*command, "--trial"]) == 0
    assert "moves an axis so (moves plus), else the other way (moves minus)" in " ".join(
        capsys.readouterr().out.split()
    )
    (trial,) = tmp_path.glob("*.INI")
    assert "$AN_CEC[0,10]=0.01000\n" in trial.read_text("ascii")


@pytest.mark.parametrize(
    ("control", "said"),
    [
        ("fanuc", "of fanuc no tables across axes are known to this program"),
        ("linuxcnc", "linuxcnc can take away squareness alone"),
    ],
)
def test_what_a_control_cannot_take_is_said_by_its_name(folder, capsys, control, said):
    assert main(["machine", "compensate", str(folder / "machine.yaml"), "--controller", control]) == 2
    assert said in capsys.readouterr().err


@pytest.mark.parametrize("step", [30, 25, 400])
def test_rows_stand_where_the_step_has_them(controls, step):
    machine = bare_machine([curve("EYX", BOW)])
    (table,) = plan_tables(machine, PLACE, step / 1e3).tables
    assert table.positions * 1e3 == pytest.approx(np.arange(0, 401, step))
    (text,) = controls.controller("siemens-840d-cec", PLACE).cross_files([table], 1).values()
    assert f"$AN_CEC_STEP[0]={step:.6f}" in text


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["--trial", "--step", "300"], "two rows have no middle for a trial value"),
        (["--trial", "--step", "501"], "the step is longer than the measured length"),
        (["--moves", "plus", "--step", "501"], "the step is longer than the measured length"),
        (["--moves", "plus", "--step", "0.0001"], "the step makes more than 10000 rows"),
    ],
)
def test_a_step_that_leaves_no_rows_is_refused_and_nothing_is_written(
    folder, tmp_path, capsys, arguments, said
):
    path, out = folder / "machine.yaml", tmp_path / "out"
    command = ["machine", "compensate", str(path), "--controller", "siemens-840d-cec", "-o", str(out)]
    assert main([*command, *arguments]) == 2
    assert said in capsys.readouterr().err
    assert not out.exists()


STATED = """\
schema: zlmreport/machine/1
chain: XYFZ
errors:
  - {EYX: {0: 0, 250: 9, 500: 0}, expanded_uncertainty: 0.5}
  - {EYY: {0: 0, 400: 2}, expanded_uncertainty: 0.5}
  - {C0Y: 25, expanded_uncertainty: 0.6}
"""


def test_what_linuxcnc_holds_is_squareness_alone_and_its_sign_needs_no_trial(tmp_path, capsys):
    path = tmp_path / "machine.yaml"
    path.write_text(STATED, encoding="utf-8")
    command = ["machine", "compensate", str(path), "--controller"]
    assert main([*command, "siemens-840d-cec", "--moves", "plus"]) == 0
    assert "They hold EYX and C0Y." in capsys.readouterr().out
    assert main([*command, "linuxcnc"]) == 0
    assert "They hold C0Y." in capsys.readouterr().out
    assert values(capsys, *command, "linuxcnc")["taken"] == ["C0Y"]
    assert main([*command, "linuxcnc", "--trial"]) == 2
    assert "the sign of linuxcnc is known; no trial is needed" in capsys.readouterr().err


def test_what_a_straight_line_leaves_by_rounding_is_worth_no_table():
    rounded = AxisErrorCurve(
        "EXY", NODES[:2], np.array([0.0, 4e-22]), np.eye(2) * 1e-22, ErrorLine({}), "test"
    )
    plan = plan_tables(bare_machine([rounded, curve("EYX", BOW)]), PLACE)
    assert (plan.taken, plan.within_uncertainty) == (("EYX",), ("EXY",))


def test_a_table_ends_where_its_own_axis_was_measured(tmp_path, capsys):
    path = tmp_path / "machine.yaml"
    apart = "  - {EXX: {600: 0, 900: 2}, expanded_uncertainty: 0.5}\n"
    path.write_text(STATED + apart, encoding="utf-8")
    assert main(["machine", "compensate", str(path), "--controller", "linuxcnc"]) == 0
    path.write_text(STATED + apart.replace("EXX", "EXY"), encoding="utf-8")
    assert main(["machine", "compensate", str(path), "--controller", "linuxcnc"]) == 2
    said = "the ranges over which the errors of Y were measured do not overlap, so no table over Y has an end"
    assert said in capsys.readouterr().err


def test_a_key_of_compensate_belongs_to_no_other_action(folder, capsys):
    assert main(["machine", "predict", str(folder / "machine.yaml"), "--moves", "plus"]) == 2
    assert "--moves belongs to compensate, not to predict" in capsys.readouterr().err


LAG = lagging(0.0, 0.5e-3)


@pytest.mark.parametrize(
    ("left", "verdict"),
    [
        (0.0, CrossVerdict.HELD),
        (80e-6, CrossVerdict.WRONG_SIGN),
        (40e-6, CrossVerdict.NOT_IN_EFFECT),
        (20e-6, CrossVerdict.HALF),
        (130e-6, CrossVerdict.OTHER),
    ],
)
def test_circles_run_again_tell_what_became_of_the_tables(left, verdict):
    """The drive's lag, the centre and the bar are what they are: they belong to no table."""
    machine = bare_machine([square("C0Y", 40e-6), *(curve(f"E{each}{each}", 0 * BOW) for each in "XY")])
    tables = plan_tables(machine, PLACE).tables
    before = circle(added(turned(40e-6), LAG), seed=1)
    after = circle(added(turned(left), LAG), seed=2)
    after = replace(after, deviation=after.deviation + 20e-6 * np.cos(after.angle) + 7e-6)
    found = confirm_circles(machine, tables, [before], [after], PLACE)
    assert found.verdict is verdict
    assert found.applied == pytest.approx(1 - left / 40e-6, abs=found.expanded_uncertainty)


def test_a_circle_that_does_not_see_the_tables_decides_nothing():
    machine = bare_machine([square("C0Y", 40e-6), *(curve(f"E{each}{each}", 0 * BOW) for each in "XYZ")])
    tables = plan_tables(machine, PLACE).tables
    before, after = (circle(LAG, seed=seed, plane="ZX") for seed in (1, 2))
    found = confirm_circles(machine, tables, [before], [after], PLACE)
    assert found.verdict is CrossVerdict.NOT_SEEN


def test_a_circle_on_another_path_is_refused():
    machine = bare_machine([square("C0Y", 40e-6), *(curve(f"E{each}{each}", 0 * BOW) for each in "XY")])
    tables = plan_tables(machine, PLACE).tables
    with pytest.raises(InputError, match="was run on no path of a circle before"):
        confirm_circles(machine, tables, [circle(LAG)], [circle(LAG, radius=0.1)], PLACE)


def test_the_command_confirms_a_circle_and_its_exit_code_says_so(folder, capsys):
    command = [
        "machine", "compensate", folder / "machine.yaml", "--controller", "siemens-840d-cec", "--moves",
        "minus", "--confirm", folder / "circle-xy.yaml",
    ]  # fmt: skip
    assert main([*map(str, command), "--json"]) == 1
    found = json.loads(capsys.readouterr().out)
    assert (found["schema"], found["verdict"]) == ("zlmreport/machine-confirmation/1", "not-in-effect")
    assert main(list(map(str, command))) == 1
    assert "Were they loaded and switched on?" in " ".join(capsys.readouterr().out.split())


def test_tables_are_made_saved_and_confirmed_in_python(folder, tmp_path):
    machine = z.machine(folder / "machine.yaml")
    with pytest.raises(InputError, match='state moves="plus" or moves="minus"'):
        machine.compensate("siemens-840d-cec")
    tables = machine.compensate("siemens-840d-cec", moves="minus")
    assert repr(tables) == "<Tables: machine-across_CEC.INI>"
    assert "A forecast is no measurement" in tables._repr_html_()
    before, after = tables.forecast["largest"]
    assert after < before
    assert tables.save(tmp_path / "out") == tmp_path / "out"
    assert [each.name for each in (tmp_path / "out").iterdir()] == list(tables.files)
    assert tables.confirm(folder / "circle-xy.yaml")["verdict"] == "not-in-effect"
