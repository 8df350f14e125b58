# ruff: noqa: E501 - lines of files
"""Every installed controller does what the kit asks."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from zlmreport.plugin.controller import Controller
from zlmreport.plugin.registry import find_plugins
from zlmreport.testing import CONTROLLER_CHECKS, ControlExample, CrossExample

CONTROLLERS = find_plugins().controllers
_UP, _DOWN = (0.0, 3.25, -2.5), (1.5, 4.75, -1.0)
_BOTH = tuple(zip((0.0, 50.25, 100.5), _UP, _DOWN, strict=True))
_ALIKE = tuple(zip((0.0, 50.25, 100.5), _UP, _UP, strict=True))

#: A file of each as its manual has them, or as this program reads it; and what the control takes away.
EXAMPLES = {
    # A table that LinuxCNC 2.9 was run with: at 100 mm the motor went 50 µm less forward, 20 µm less back.
    "linuxcnc": ControlExample(
        {".comp": "-10 -10 -10\n0 0 -0.01\n100 100.05 100.02\n200 199.97 199.95\n"},
        ((-10, 0, 0), (0, 0, -10), (100, 50, 20), (200, -30, -50)),
        deviation_step=0.001,
        # By LinuxCNC's own test of matrixkins C_xy moves X by so much for each unit of Y: X was off by −e.
        across=CrossExample(
            {"-square.hal": "setp matrixkins.C_xy 0.000040000\n"}, "Y", "X", ((0, 0), (100, -4))
        ),
    ),
    "csv": ControlExample(
        {
            "-compensation.csv": "position,forward,reverse\n0,0.000,1.500\n50.25,3.250,4.750\n100.5,-2.500,-1.000\n"
        },
        _BOTH,
        deviation_step=0.001,
        position_step=1e-6,
    ),
    # Extended Functions K3: a positive value moves the axis in the negative direction.
    "siemens-840d": ControlExample(
        {
            "_EEC.INI": "%_N_AX_EEC_INI\nCHANDATA(1)\n$AA_ENC_COMP[0,0,X1]=0.00000\n$AA_ENC_COMP[0,1,X1]=0.00325\n"
            "$AA_ENC_COMP[0,2,X1]=-0.00250\n$AA_ENC_COMP_STEP[0,X1]=50.25\n$AA_ENC_COMP_MIN[0,X1]=0\n"
            "$AA_ENC_COMP_MAX[0,X1]=100.5\n$AA_ENC_COMP_IS_MODULO[0,X1]=0\nM17\n"
        },
        _ALIKE,
        deviation_step=0.01,
    ),
    "siemens-840d-cec": ControlExample(
        {
            "_CEC.INI": "%_N_NC_CEC_INI\nCHANDATA(1)\n"
            "$AN_CEC[0,0]=0.00000\n$AN_CEC[0,1]=0.00325\n$AN_CEC[0,2]=-0.00250\n$AN_CEC_STEP[0]=50.25\n"
            "$AN_CEC_MIN[0]=0\n$AN_CEC_MAX[0]=100.5\n$AN_CEC_DIRECTION[0]=1\n"
            "$AN_CEC[1,0]=0.00150\n$AN_CEC[1,1]=0.00475\n$AN_CEC[1,2]=-0.00100\n$AN_CEC_STEP[1]=50.25\n"
            "$AN_CEC_MIN[1]=0\n$AN_CEC_MAX[1]=100.5\n$AN_CEC_DIRECTION[1]=-1\nM17\n"
        },
        _BOTH,
        deviation_step=0.01,
    ),
    # TF5200, axis compensation: set 19866.7 µm, actual 19856.5 upwards and 19874.7 downwards.
    "isg": ControlExample(
        {
            ".lis": "kw.ssfk.kw_nr_max 2\nkw.ssfk.table[0].setpoint 0\nkw.ssfk.table[0].pos 0\n"
            "kw.ssfk.table[0].neg 0\nkw.ssfk.table[1].setpoint 198667\nkw.ssfk.table[1].pos -102\n"
            "kw.ssfk.table[1].neg 80\n"
        },
        ((0, 0, 0), (19.8667, -10.2, 8)),
        position_step=1e-4,
    ),
    # 0i-PB parameter manual, p. 100: increments of an interval of 50 mm, which the control adds.
    "fanuc": ControlExample(
        {".txt": "%\nN10001P2\nN10002P1\nN10003P-2\n%\n"},
        ((0, 0, 0), (50, -2, -2), (100, -3, -3), (150, -1, -1)),
        keys={"reference": 0},
        deviation_step=1.0,
    ),
    # (interval − actual distance) × 2 in units of 0.001 mm: 30 mm that are 30.010 give −20.
    "mitsubishi": ControlExample(
        {"-increments.txt": "1 -20 0 30\n2 10 30 60\n"},
        ((0, 0, 0), (30, 10, 10), (60, 5, 5)),
        deviation_step=0.5,
    ),
    "heidenhain": ControlExample(
        {
            ".COM": "BEGIN X_AXIS .COM\nNR AXISPOS  BACKLASH  X\n0     +0.0000   +0.0015   +0.0000\n"
            "1     +50.2500   +0.0015   +0.0033\n2     +100.5000   +0.0015   -0.0025\n[END]\n",
            ".CMA": "BEGIN CONFIG .CMA\nNR ACTIVE X\n0  *      KIT-7.COM\n[END]\n",
        },
        ((0, 0, 1.5), (50.25, 3.3, 4.8), (100.5, -2.5, -1)),
    ),
    "etalon": ControlExample(
        {
            "-etalon.txt": "[EXX]\nGridpoints = {\n0 0.000000\n50.25 0.003250\n100.5 -0.002500\n} // end of EXX\n"
        },
        _ALIKE,
        deviation_step=0.001,
    ),
    "beckhoff": ControlExample(
        {
            "-positive.st": "(fPos := 0.0, fCompensation := 0.0),\n(fPos := 50.25, fCompensation := -0.00325),\n"
            "(fPos := 100.5, fCompensation := 0.0025),\n",
            "-negative.st": "(fPos := 0.0, fCompensation := -0.0015),\n"
            "(fPos := 50.25, fCompensation := -0.00475),\n(fPos := 100.5, fCompensation := 0.001),\n",
        },
        _BOTH,
        deviation_step=0.001,
    ),
}


@pytest.mark.parametrize("controller", CONTROLLERS, ids=lambda each: each.identifier)
@pytest.mark.parametrize("check", CONTROLLER_CHECKS)
def test_conforms(check: Callable[..., None], controller: Controller) -> None:
    check(controller, {}, EXAMPLES[controller.identifier])


def test_every_controller_has_an_example() -> None:
    assert {each.identifier for each in CONTROLLERS} == set(EXAMPLES)
