"""Tables as makers print them, and as LinuxCNC read them: figures that are not the program's own."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace
from decimal import Decimal

import numpy as np
import pytest

from installed import registry
from zlmreport.plugin import Axis, InputError, Place, read_only_floats
from zlmreport.plugin.controller import CompensationTable

PLACE = Place("job.yaml", 1)
#: A screw every 30 mm, µm moving forward; moving back 12 µm more. The files below are of this curve.
FORWARD = (-3.0, 7.06, 2.14, 3.81, 21.37, 31.36, 27.45, 31.40, 44.47, 48.81, 50.39)
MEAN = tuple(each + 6 for each in FORWARD)


def table(
    positions: Sequence[float], forward: Sequence[float], reverse: Sequence[float] | None = None
) -> CompensationTable:
    """Return a table of positions in mm and deviations in µm."""
    return CompensationTable(
        Axis("X"),
        "X-1",
        read_only_floats(np.array(positions) * 1e-3),
        read_only_floats(np.array(forward) * 1e-6),
        read_only_floats(np.array(forward if reverse is None else reverse) * 1e-6),
        PLACE,
    )


def curve() -> CompensationTable:
    return table([30.0 * row for row in range(11)], FORWARD, [each + 12 for each in FORWARD])


def written(name: str, of: CompensationTable, **keys) -> dict[str, str]:
    controller = registry().controller(name)
    return dict(controller.files(of, controller.options.model_validate(keys)))


def decoded(name: str, files: dict[str, str], of: CompensationTable, **keys) -> CompensationTable:
    controller = registry().controller(name)
    return controller.read(files, of, controller.options.model_validate(keys))


def test_siemens_eec_is_an_ini_file_with_m17() -> None:
    """Extended Functions K3, 03/2013: a positive value moves the axis in the negative direction."""
    lines = written("siemens-840d", curve())["_EEC.INI"].splitlines()
    assert lines[:2] == ["%_N_AX_EEC_INI", "CHANDATA(1)"]
    values = [f"$AA_ENC_COMP[0,{row},X1]={each / 1000:.5f}" for row, each in enumerate(MEAN)]
    assert lines[2:13] == values
    assert [line.partition("=")[0] for line in lines[13:17]] == [
        f"$AA_ENC_COMP_{name}[0,X1]" for name in ("STEP", "MIN", "MAX", "IS_MODULO")
    ]
    assert [float(line.partition("=")[2]) for line in lines[13:17]] == [30, 0, 300, 0]
    assert lines[-1] == "M17"


@pytest.mark.parametrize(
    ("name", "file", "axis"), [("siemens-840d", "_EEC.INI", "0,X1"), ("siemens-840d-cec", "_CEC.INI", "1")]
)
def test_siemens_finds_room_for_every_row_between_first_and_last(name: str, file: str, axis: str) -> None:
    rows = np.linspace(-413.0, 200.0, 24)  # 26.652173913… mm apart, which is written rounded up
    text = written(name, table(rows.tolist(), [0.0] * 24))[file]
    step, first, last = (
        Decimal(text.split(f"_{key}[{axis}]=")[1].split()[0]) for key in ("STEP", "MIN", "MAX")
    )
    assert (last - first) / step == 23
    assert abs(last - 200) < Decimal("0.0001")


def test_siemens_cec_has_a_table_for_each_direction() -> None:
    text = written("siemens-840d-cec", curve(), axis="X2")["_CEC.INI"]
    for line in (
        "$AN_CEC[0,1]=0.00706",
        "$AN_CEC[1,1]=0.01906",
        "$AN_CEC_DIRECTION[0]=1",
        "$AN_CEC_DIRECTION[1]=-1",
        "$AN_CEC_INPUT_AXIS[1]=(X2)",
        "$AN_CEC_OUTPUT_AXIS[0]=(X2)",
    ):
        assert line in text.splitlines()


def test_isg_counts_tenths_of_a_micrometre() -> None:
    lines = written("isg", curve())[".lis"].splitlines()
    assert lines[:7] == [
        "kopf.achs_nr 1",
        "kopf.log_achs_name X",
        "kw.ssfk.interval 0",
        "kw.ssfk.kw_startpos 0",
        "kw.ssfk.kw_nr_max 11",
        "kw.ssfk.unit 1",
        "kw.ssfk.bilateral 1",
    ]
    tenths = [-30, 71, 21, 38, 214, 314, 274, 314, 445, 488, 504]  # of the sixth 274.5, rounded either way
    for row, each in enumerate(tenths):
        assert f"kw.ssfk.table[{row}].setpoint {300000 * row}" in lines
        for name, value in (("pos", each), ("neg", each + 120)):
            found = next(line for line in lines if line.startswith(f"kw.ssfk.table[{row}].{name} "))
            assert int(found.split()[1]) == pytest.approx(value, abs=1 if row == 6 else 0)


def test_fanuc_sums_what_its_manual_plots() -> None:
    """0i-PB parameter manual, p. 100: interval 50 mm from −400 mm, reference number 40."""
    steps = (2, 1, 1, -2, 0, -1, 0, -1, 2, 1, 0, -1, -1, -2, 0, 1, 2)
    text = "".join(f"N1{33 + row:04d}P{step}\n" for row, step in enumerate(steps))
    of = table([-400.0 + 50 * row for row in range(18)], [0.0] * 18)
    found = -decoded("fanuc", {".txt": f"%\n{text}%\n"}, of, reference=40).forward * 1e6
    by_number = dict(zip(range(32, 50), np.round(found).astype(int).tolist(), strict=True))
    assert [by_number[number] for number in (40, 41, 49, 39, 35, 32)] == [0, 2, 2, 1, 4, 0]
    assert (min(by_number.values()), max(by_number.values())) == (-1, 4)
    meant = table(of.positions * 1e3, -np.cumsum([0, *steps]))
    files = written("fanuc", meant, reference=40)
    assert files[".txt"] == f"%\n{text}%\n"
    assert files["-parameters.txt"] == "3620 40\n3621 33\n3622 49\n3623 1\n3624 50 mm\n"


def test_fanuc_rounds_the_running_sum() -> None:
    text = written("fanuc", curve(), reference=0, magnification=4)[".txt"]
    steps = (-3, 2, -1, -4, -3, 1, -1, -3, -1, 0)
    assert text == "%\n" + "".join(f"N1{n:04d}P{step}\n" for n, step in enumerate(steps, 1)) + "%\n"


def test_fanuc_in_both_directions_is_two_tables_and_what_is_between_them() -> None:
    keys = {"reference": 0, "reverse": 60, "magnification": 3}
    files = written("fanuc", curve(), **keys)
    assert files["-parameters.txt"] == (
        "3620 0\n3621 1\n3622 10\n3623 3\n3624 30 mm\n3605#0 1\n3626 60\n3627 -4\n"
    )
    assert re.findall(r"N1(\d+)P", files[".txt"]) == [f"{n:04d}" for n in (*range(1, 11), *range(60, 70))]
    found = decoded("fanuc", files, curve(), **keys)
    gap = (found.reverse - found.forward) * 1e6
    assert gap == pytest.approx(np.full(11, 12.0), abs=3.0)
    assert found.forward * 1e6 == pytest.approx(np.array(FORWARD) - FORWARD[0], abs=1.5)
    with pytest.raises(InputError, match="overlap"):
        written("fanuc", curve(), reference=0, reverse=5, magnification=3)


def test_fanuc_has_no_number_beyond_its_last() -> None:
    """Numbers of the control are 0 to 1023; eleven rows from 1013 have the increments 1014 to 1023."""
    text = written("fanuc", curve(), reference=1013, magnification=4)[".txt"]
    assert text.splitlines()[-2].startswith("N11023P")
    for keys in ({"reference": 1014}, {"reference": 0, "reverse": 1015}):
        with pytest.raises(InputError, match="a row has the number 1024"):
            written("fanuc", curve(), magnification=4, **keys)


def test_fanuc_states_magnification_and_interval() -> None:
    assert written("fanuc", curve(), magnification=4)["-parameters.txt"] == (
        "3620 40\n3621 41\n3622 50\n3623 4\n3624 30 mm\n"
    )


@pytest.mark.parametrize("name", ["siemens-840d", "siemens-840d-cec", "isg", "heidenhain", "etalon"])
def test_a_file_names_the_axis_as_a_control_does(name: str) -> None:
    of = replace(curve(), axis=Axis("X-axis (left)"))
    with pytest.raises(InputError, match="is no name of an axis on this control; state its key axis"):
        written(name, of)
    assert decoded(name, written(name, of, axis="X1"), of, axis="X1").positions == pytest.approx(of.positions)


def test_etalon_has_all_digits_of_a_long_axis() -> None:
    of = table([10014.368, 10014.412], [1.0, 2.0])
    assert "10014.368 0.001000\n10014.412 0.002000\n" in written("etalon", of)["-etalon.txt"]


def test_mitsubishi_doubles_what_an_interval_is_too_short() -> None:
    """(interval − actual distance) × 2 in units of 0.001 mm: 30 mm that are 30.010 give −20."""
    text = written("mitsubishi", table([0, 30, 60], [0.0, 10.0, 5.0]))["-increments.txt"]
    assert text == "1 -20 0 30\n2 10 30 60\n"
    with pytest.raises(InputError, match="127"):
        written("mitsubishi", table([0, 30], [0.0, 64.0]))


@pytest.mark.parametrize(("wanted", "back"), [(None, 0.012), ("play", 0.012), ("reverse", 0.009)])
def test_heidenhain_has_the_play_or_the_deviation_back_beside_that_forward(
    wanted: str | None, back: float
) -> None:
    """Technical manual MANUALplus 620, 6.10: BACKLASH has what was measured in the negative direction."""
    files = written("heidenhain", curve(), backlash=wanted)
    rows = [line.split() for line in files[".COM"].splitlines()]
    assert rows[1] == ["NR", "AXISPOS", "BACKLASH", "X"]
    assert rows[2] == ["0", "+0.0000", f"{back:+.4f}", "-0.0030"]
    assert rows[12] == ["10", "+300.0000", f"{back + (wanted == 'reverse') * 0.0534:+.4f}", "+0.0504"]
    assert rows[-1] == ["[END]"]
    assert [line.split() for line in files[".CMA"].splitlines()][1:3] == [
        ["NR", "ACTIVE", "X"],
        ["0", "*", "X-1.COM"],
    ]


def test_etalon_has_a_section_named_by_the_axis() -> None:
    lines = written("etalon", curve())["-etalon.txt"].splitlines()
    assert lines[:2] == ["[EXX]", "Gridpoints = {"]
    found = [tuple(map(float, line.split())) for line in lines[2:-1]]
    expected = [(30.0 * row, each / 1000) for row, each in enumerate(MEAN)]
    np.testing.assert_allclose(found, expected, atol=1e-9)


#: A table in both types, and where LinuxCNC 2.9 sent the motor with it: commanded, sign of the last motion.
TYPES = {
    0: "-10 -10 -10\n0 0 -0.01\n100 100.05 100.02\n200 199.97 199.95\n",
    1: "-10 0 0\n0 0 0.01\n100 -0.05 -0.02\n200 0.03 0.05\n",
}
SENT = (
    (-20, -1, -20.0),
    (0, 1, 0.0),
    (50, 1, 49.975),
    (100, 1, 99.95),
    (150, 1, 149.99),
    (200, 1, 200.03),
    (250, 1, 250.03),
    (200, -1, 200.05),
    (150, -1, 150.015),
    (100, -1, 99.98),
    (50, -1, 49.995),
    (0, -1, 0.01),
)


@pytest.mark.parametrize("kind", TYPES)
def test_a_linuxcnc_table_moves_the_motor_as_it_did(kind: int) -> None:
    found = decoded("linuxcnc", {".comp": TYPES[kind]}, curve(), type=kind)
    for commanded, direction, motor in SENT:
        gone = found.at(np.array([commanded * 1e-3]))[0 if direction > 0 else 1, 0]
        assert commanded - gone * 1e3 == pytest.approx(motor, abs=5.1e-4)


@pytest.mark.parametrize(
    ("text", "rows"),
    [
        ("0 0 0\n100 99.95 99.95\n\n200 200.5 200.5\n", 2),  # a blank line ends it
        ("0.0,0.010,0.010\n100.0,100.02,100.02\n", 0),
        ("# header comment\n0 0.001 0.002\n", 0),
        ("100 100.05 100.05\n0 0.01 0.01\n200 200.02 200.02\n", 2),  # a row that falls is dropped
        ("0.0 0.010 0.010 ; x\n100.0 100.02 100.02 extra\n", 2),
        ("".join(f"{row} {row}.01 {row}.01\n" for row in range(300)), 256),
    ],
)
def test_linuxcnc_cuts_tables_off(text: str, rows: int) -> None:
    assert len(decoded("linuxcnc", {".comp": text}, curve()).positions) == rows
