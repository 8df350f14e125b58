"""What axes predict: values, bands that hold, and what of it is nobody's knowledge."""

import numpy as np
import pytest

from machines.simulated import MICRO, bare_machine, circle, nothing
from zlmreport.machines.curve import make_measured_curve, remove_alignment, with_scale_error
from zlmreport.machines.kinematics import ErrorLine
from zlmreport.machines.machine import predict
from zlmreport.machines.reading import read_machine
from zlmreport.machines.volume import find_measured_space, map_volume, predict_diagonals
from zlmreport.model.fitting.estimate import InstrumentError
from zlmreport.plugin import Axis, MeasurementSet
from zlmreport.plugin.registry import find_plugins

TARGETS = np.linspace(0.0, 0.5, 21)
INSTRUMENT = InstrumentError(at_each_position=0.15 * MICRO, proportional=0.8e-6)


def readings(curve, random, lost_motion=0.0, scatter=0.4 * MICRO, runs=3):
    """Runs over an axis, with errors of the instrument that all runs share, and scatter of each reading."""
    shared = INSTRUMENT.at_each_position * random.standard_normal(len(TARGETS))
    shared = shared + INSTRUMENT.proportional * random.standard_normal() * (TARGETS - TARGETS.mean())
    count = len(TARGETS)
    rows = [(way, run) for run in range(1, runs + 1) for way in (1, -1)]
    deviation = np.concatenate(
        [curve + shared - way * lost_motion / 2 + scatter * random.standard_normal(count) for way, _ in rows]
    )
    return MeasurementSet(
        Axis("X"),
        TARGETS,
        np.tile(np.arange(count), len(rows)),
        np.repeat([way for way, _ in rows], count),
        np.repeat([run for _, run in rows], count),
        deviation,
    )


def test_the_band_holds_the_circle_that_the_axes_would_make():
    random = np.random.default_rng(7)
    true_x = 5 * MICRO * TARGETS / 0.5 + 1.5 * MICRO * np.sin(TARGETS / 0.09)
    true_y = -3 * MICRO * TARGETS / 0.5
    exact = {
        name: make_measured_curve(
            name, readings(curve, random, 2 * MICRO, 0.0, 1), InstrumentError(), ErrorLine({}), ""
        )
        for name, curve in (("EXX", true_x), ("EYY", true_y))
    }
    inside, count = 0, 0
    seen = circle(nothing, noise=0.0)
    for name, curve in (("EXX", true_x), ("EYY", true_y)):
        sides = np.concatenate([curve - MICRO, curve + MICRO])  # lost motion of 2 µm, without the instrument
        exact[name] = type(exact[name])(name, TARGETS, sides, np.zeros((len(sides), 0)), ErrorLine({}), "")
    truth = predict(bare_machine(exact.values()), seen.make_course()).values
    for _ in range(150):
        curves = [
            make_measured_curve(name, readings(curve, random, 2 * MICRO), INSTRUMENT, ErrorLine({}), "")
            for name, curve in (("EXX", true_x), ("EYY", true_y))
        ]
        found = predict(bare_machine(curves), seen.make_course())
        # A constant of an axis is the centre's: the instrument's scale is zero in the middle of the travel.
        inside += int(np.count_nonzero(np.abs(found.values - truth) <= found.expanded_uncertainty))
        count += len(truth)
    assert 0.93 <= inside / count <= 0.97


def test_a_straightness_error_loses_its_line_and_an_angle_its_mean():
    random = np.random.default_rng(1)
    bent = 4 * MICRO * (TARGETS / 0.5) ** 2
    for name, orders in (("EYX", 1), ("EBX", 0), ("EXX", None)):
        raw = make_measured_curve(name, readings(bent, random, scatter=0.0), INSTRUMENT, ErrorLine({}), "")
        found = remove_alignment(raw)
        if orders is None:
            assert found is raw
            continue
        mean = found.values.reshape(2, -1).mean(axis=0)
        assert np.polyfit(TARGETS, mean, orders) == pytest.approx(np.zeros(orders + 1), abs=1e-15)
        ones = np.ones(len(found.values)) / len(found.values)
        assert np.abs(ones @ found.factor).max() < 1e-15


@pytest.mark.parametrize(
    ("measured_at", "zero"),
    [("", 0.2), (", at: {X: 0}", 0.0), (", at: {X: 100}", 0.1), (", at: {X: 900}", 0.2)],
)
def test_an_angle_counts_from_where_the_axes_are_as_square_as_was_measured(tmp_path, measured_at, zero):
    path = tmp_path / "machine.yaml"
    path.write_text(
        "schema: zlmreport/machine/1\nchain: XYFZ\nerrors:\n"
        "  - {ECX: {0: 1, 400: 4}, expanded_uncertainty: 0.1}\n"
        f"  - {{C0Y: 8, expanded_uncertainty: 0.5{measured_at}}}\n",
        encoding="utf-8",
    )
    machine = read_machine(path, find_plugins()).machine
    yaw = next(each for each in machine.curves if each.name == "ECX")
    assert np.interp(zero, yaw.nodes, yaw.values) == pytest.approx(0.0, abs=1e-12)
    assert np.ptp(yaw.values) == pytest.approx(np.radians(3 / 3600))


def test_out_of_square_axes_stretch_one_diagonal_and_shorten_the_other():
    from zlmreport.machines.curve import AxisErrorCurve

    flat = [
        AxisErrorCurve(
            f"E{axis}{axis}", np.array([0.0, length]), np.zeros(2), np.zeros((2, 0)), ErrorLine({}), ""
        )
        for axis, length in (("X", 0.5), ("Y", 0.4), ("Z", 0.3))
    ]
    square = AxisErrorCurve("C0Y", np.zeros(1), np.array([20e-6]), np.eye(1) * 1e-6, ErrorLine({}), "")
    machine = bare_machine([*flat, square])
    space = find_measured_space(machine)
    length = np.sqrt(0.5**2 + 0.4**2 + 0.3**2)
    ends = {each.name: each.deviation[-1] for each in predict_diagonals(machine, space)}
    # L·δ = ± C0Y·a·b with the signs of machine.md 1.3: − for +++, + for −++ and +−+, − for ++−
    for name, sign in (("PPP", -1), ("NPP", 1), ("PNP", 1), ("NNP", -1)):
        assert ends[name] == pytest.approx(sign * 20e-6 * 0.5 * 0.4 / length, rel=1e-9)
    found = map_volume(machine, space)
    assert found.length.max() == pytest.approx(20e-6 * 0.2)
    assert found.expanded_uncertainty[found.largest] == pytest.approx(2e-6 * 0.2)
    assert found.bound.max() > 0


def test_an_error_of_scale_is_in_proportion_to_what_was_read_and_shared_by_all():
    random = np.random.default_rng(3)
    measured = readings(8 * MICRO * TARGETS, random, 0.0, 0.0, 1)
    curve = make_measured_curve("EYX", measured, InstrumentError(), ErrorLine({}), "")
    found = with_scale_error(curve, 0.02)
    covariance = found.factor @ found.factor.T
    assert np.sqrt(np.diag(covariance)) == pytest.approx(0.02 * np.abs(found.values))
    assert np.linalg.matrix_rank(covariance) == 1
