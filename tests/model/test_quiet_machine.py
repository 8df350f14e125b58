"""However little a machine scatters, the same axis gets the same answer."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from model.axis_tests import INSTALLED, hidden, linear_test, model_of, noise, observations, pendulum_test
from zlmreport.measurement.arrays import read_only_integers
from zlmreport.model.diagnosis.diagnosis import AxisDiagnosis, DiagnosisVerdict, diagnose
from zlmreport.model.fitting.observations import Observations
from zlmreport.model.fitting.repeats import find_resolution
from zlmreport.plugin import Axis, FloatArray, read_only_floats
from zlmreport.plugin.effect import Design

_READINGS = Path(__file__).parents[1] / "data" / "controls" / "linuxcnc.csv"
_NODES = 32
_LINEAR, _PENDULUM = linear_test(11, 3), pendulum_test(11, 3)
_MODEL = model_of("offset", "scale-error", "backlash")


def _named(diagnosis: AxisDiagnosis) -> tuple[DiagnosisVerdict, str]:
    return diagnosis.verdict, diagnosis.candidates[0].identifier


def _diagnosed(design: Design, deviation: FloatArray) -> AxisDiagnosis:
    return diagnose(_MODEL, observations(design, deviation), INSTALLED)


def _wave_through_nodes(position: FloatArray, pitch: float) -> FloatArray:
    """Return a wave of 3 µm as a control's table has it: straight between its nodes, and no pure sine."""
    turns = position / pitch
    nodes = np.arange(np.floor(turns.min()) * _NODES, np.ceil(turns.max()) * _NODES + 1) / _NODES
    return 3e-6 * np.interp(turns, nodes, np.sin(2 * np.pi * nodes))


@pytest.mark.long
@pytest.mark.parametrize(
    ("design", "sigma"), [(_LINEAR, 0.0), (_LINEAR, 3e-8), (_PENDULUM, 1e-9), (_PENDULUM, 3e-7)]
)
def test_pitch_error_is_named_however_little_the_readings_scatter(design: Design, sigma: float) -> None:
    shape = _wave_through_nodes(design.position, 0.01)
    found = _diagnosed(design, shape + noise(design, sigma=sigma))
    assert _named(found) == (DiagnosisVerdict.MISSING, "screw-pitch")


def test_expansion_of_the_scale_keeps_its_name_on_a_quiet_machine() -> None:
    found = _diagnosed(_LINEAR, hidden(_LINEAR, "scale-expansion") + noise(_LINEAR, sigma=1e-9))
    assert _named(found) == (DiagnosisVerdict.MISSING, "scale-expansion")


@pytest.mark.long
def test_rounding_that_repeats_is_no_irregular_geometry() -> None:
    exact = hidden(_LINEAR, "screw-pitch", [0.01], size=3.0) + noise(_LINEAR, sigma=1e-8)
    found = _diagnosed(_LINEAR, np.round(exact / 5e-7) * 5e-7)
    assert _named(found) == (DiagnosisVerdict.MISSING, "screw-pitch")


def test_model_that_explains_all_but_rounding_is_adequate() -> None:
    exact = 2e-6 + 20e-6 * _LINEAR.position - 4e-6 * _LINEAR.direction
    assert _diagnosed(_LINEAR, np.round(exact / 1e-8) * 1e-8).verdict is DiagnosisVerdict.ADEQUATE


@pytest.mark.long
@pytest.mark.parametrize("sigma", [0.0, 3e-7])
def test_pitch_error_of_a_real_control_is_named_at_every_noise(sigma: float) -> None:
    """A control that compensates itself to 0.1 µm: its own readings, and 3 µm of pitch error on top."""
    observed = _of_control(Axis("X", travel=(0.0, 0.3), screw_pitch=0.016))
    position = observed.design.position
    shape = _wave_through_nodes(position, 0.016) + noise(observed.design, sigma=sigma)
    found = diagnose(
        _MODEL, replace(observed, deviation=read_only_floats(observed.deviation + shape)), INSTALLED
    )
    assert _named(found) == (DiagnosisVerdict.MISSING, "screw-pitch")


@pytest.mark.parametrize(
    ("readings", "step"),
    [([0.4, 1.2, -0.6], 0.2), ([5.0, 10.0], 5.0), ([np.pi, np.e], 0.0), ([0.0, 0.0], 0.0)],
)
def test_resolution_is_the_step_of_which_readings_are_multiples(readings: list[float], step: float) -> None:
    assert find_resolution(np.array(readings)) == step


def _of_control(axis: Axis) -> Observations:
    target, sign, run, deviation, time = np.loadtxt(
        _READINGS, delimiter=",", skiprows=2, converters={1: lambda sign: float(f"{sign}1")}, encoding="utf-8"
    ).T
    position = target * 1e-3
    design = Design(
        axis=axis,
        position=read_only_floats(position),
        direction=read_only_floats(sign),
        run=read_only_integers(run.astype(int)),
        target=read_only_integers(np.unique(target, return_inverse=True)[1]),
        time=read_only_floats(time),
        time_is_counted=False,
        since_reversal=read_only_floats(np.where(sign > 0, position, 0.3 - position) + 5e-3),
    )
    return Observations(design, read_only_floats(deviation * 1e-6), read_only_integers(range(len(run))), ())
