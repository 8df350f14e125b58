"""A machine carries out the plan and errs as described, and its truth says how."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from model.simulation.describing import described, hidden
from zlmreport.model.planning.methods import Method
from zlmreport.model.simulation.description import ConditionCourse, Description, SimulatedNoise
from zlmreport.model.simulation.simulate import (
    EmulatedMachine,
    StartedMachine,
    make_emulated_machine,
    simulate,
)

LEAD = 3.0
NOISY = SimulatedNoise(reading=0.5e-6, drift=0.2e-6, outlier_share=0.1, outlier_size=5e-6)
EFFECTS = (hidden("offset", offset=2e-6), hidden("backlash", lost_motion=-4e-6))


def _erring(method: Method = Method.LINEAR) -> Description:
    return described(targets=5, runs=2, method=method, effects=EFFECTS, noise=NOISY)


def _at(machine: EmulatedMachine, times: np.ndarray) -> np.ndarray:
    return np.array([machine.position(time) for time in times])


@pytest.mark.parametrize("method", Method)
def test_it_rests_at_each_visit_as_long_as_the_plan_says(method: Method) -> None:
    machine = make_emulated_machine(_erring(method), LEAD)
    np.testing.assert_allclose(machine.leaves - machine.arrives, 5.0)
    for moments in (machine.arrives, machine.leaves):
        np.testing.assert_allclose(_at(machine, moments), _at(machine, machine.leaves), atol=1e-15)


@pytest.mark.parametrize("method", Method)
def test_at_each_visit_it_stands_at_the_target_and_errs_by_the_truth(method: Method) -> None:
    machine = make_emulated_machine(_erring(method), LEAD)
    truth = machine.truth
    stands = truth.target_positions[truth.target] + truth.deviation
    # positions are sums of up to 1 m: rounding is that of a double
    np.testing.assert_allclose(_at(machine, machine.leaves), stands, atol=1e-15, rtol=0)


def test_its_errors_are_those_of_the_simulated_readings() -> None:
    simulated = simulate(_erring()).measurements
    np.testing.assert_array_equal(make_emulated_machine(_erring(), LEAD).truth.deviation, simulated.deviation)


def test_what_the_description_says_of_an_instrument_is_left_to_the_instrument() -> None:
    coarse = replace(_erring(), noise=replace(NOISY, resolution=1e-6, missing_share=0.5))
    truth = make_emulated_machine(coarse, LEAD).truth.deviation
    np.testing.assert_array_equal(truth, simulate(_erring()).measurements.deviation)


@pytest.mark.parametrize("method", Method)
def test_it_comes_to_each_target_from_the_side_of_the_visit(method: Method) -> None:
    description = _erring(method)
    machine = make_emulated_machine(description, LEAD)
    listed = description.plan.visits
    before = _at(machine, machine.arrives - 0.05)
    assert [visit.target for visit in listed] == machine.truth.target.tolist()
    np.testing.assert_array_equal(
        np.sign(_at(machine, machine.arrives) - before), [int(visit.approach) for visit in listed]
    )


def test_it_rests_before_its_program_where_it_does_not_err_and_after_it() -> None:
    description = _erring()
    machine = make_emulated_machine(description, LEAD)
    start = description.plan.targets[0] - description.plan.overrun
    assert {machine.position(time) for time in (0.0, 1.0, LEAD)} == {start}
    assert machine.position(machine.duration) == machine.position(machine.duration + 1e6)


def test_it_moves_at_the_feed() -> None:
    description = described(targets=5, runs=1)
    machine = make_emulated_machine(description, LEAD)
    begins = machine.leaves[0]
    way = machine.position(begins + 1.0) - machine.position(begins)
    assert way == pytest.approx(description.plan.feed)


def test_conditions_follow_their_course() -> None:
    course = ConditionCourse(293.15, 295.15, sensor_noise=1.0, resolution=0.5, is_logged=False)
    machine = make_emulated_machine(replace(_erring(), conditions={"air_temperature": course}), LEAD)
    first, last = machine.leaves[0], machine.leaves[-1]
    times = [0.0, first, (first + last) / 2, last, last + 100]
    seen = [machine.conditions(time)["air_temperature"] for time in times]
    assert seen == pytest.approx([293.15, 293.15, 294.15, 295.15, 295.15])


def test_a_machine_that_waits_begins_when_it_is_started_and_not_again() -> None:
    machine = make_emulated_machine(_erring(), LEAD)
    waiting = StartedMachine(machine)
    assert {waiting.position(time) for time in (0.0, 50.0, 99.0)} == {machine.position(0.0)}
    assert waiting.elapsed is None
    waiting.start()
    seen = [waiting.position(100.0 + since) for since in (0.0, LEAD + 0.5, LEAD + 40.0)]
    waiting.start()
    assert seen == [machine.position(since) for since in (0.0, LEAD + 0.5, LEAD + 40.0)]
    assert waiting.position(200.0) == machine.position(100.0)
    assert waiting.elapsed == 100.0
