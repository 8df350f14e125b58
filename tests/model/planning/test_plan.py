"""What a job leaves open of its test is chosen by its standards and by custom."""

from __future__ import annotations

import numpy as np
import pytest

from model.planning.planned import REGISTRY, WHOLE_PITCHES, planned_job
from refusals import refusal
from zlmreport import pipeline
from zlmreport.model.planning.methods import Method
from zlmreport.model.planning.plan import Proposal, make_as_measured, make_seed_of, propose


def _proposed(*changes: tuple[str, str]) -> Proposal:
    job = planned_job(*changes)
    return propose(job, pipeline.choose_standards(job, REGISTRY))


def test_readings_need_not_exist() -> None:
    assert len(_proposed().plan.targets) == 11


def test_motion_is_that_of_the_measurement_in_si() -> None:
    plan = _proposed(("plan: {}", "plan: {overrun: 4}")).plan
    assert plan.method is Method.LINEAR
    assert plan.feed == pytest.approx(0.05)
    assert plan.dwell == 4
    assert plan.overrun == pytest.approx(0.004)


def test_what_the_job_does_not_state_is_named_as_assumed() -> None:
    changes = ("  feed: 3000\n", ""), ("plan: {}", "plan: {repeatability: 0.5}")
    assumed = _proposed(*changes).assumed
    assert assumed == {"measurement.feed", "plan.temperature_change", "model.effects"}


@pytest.mark.parametrize(
    ("travel", "standards", "targets"),
    [
        ("[0, 200]", "iso230-2:2014", 11),
        ("[0, 1500]", "iso230-2:2014", 16),
        ("[0, 1500]", "vdi-dgq-3441", 16),
    ],
)
def test_targets_are_eleven_at_least_and_no_more_than_100_mm_apart(
    travel: str, standards: str, targets: int
) -> None:
    changes = ("[0, 600]", travel), ("iso230-2:2014", standards)
    assert len(_proposed(*changes).plan.targets) == targets


@pytest.mark.parametrize("standard", ["iso230-2:1988", "iso230-2:2014", "vdi-dgq-3441", "vdi-vde-2617"])
@pytest.mark.parametrize("travel", ["[0, 100]", "[0, 600]", "[0, 1990]"])
def test_proposed_test_meets_every_requirement_of_its_standard(standard: str, travel: str) -> None:
    job = planned_job(("iso230-2:2014", standard), ("[0, 600]", travel))
    ((found, options),) = pipeline.choose_standards(job, REGISTRY)
    plan = propose(job, [(found, options)]).plan
    measured = make_as_measured(job.axis, plan.method, plan.targets, plan.runs)
    assert [finding for finding in found.requirements(measured, options) if finding.met is False] == []


def test_full_turn_meets_every_requirement_of_iso_230_2() -> None:
    job = planned_job(
        ("name: X, travel: [0, 600], screw_pitch: 10", "name: C, kind: rotary, travel: [0, 360]")
    )
    ((found, options),) = pipeline.choose_standards(job, REGISTRY)
    plan = propose(job, [(found, options)]).plan
    measured = make_as_measured(job.axis, plan.method, plan.targets, plan.runs)
    assert [finding for finding in found.requirements(measured, options) if finding.met is False] == []


def test_long_axis_is_measured_once_where_its_only_standard_says_so() -> None:
    assert _proposed(("[0, 600]", "[0, 2500]")).plan.runs == 1


def test_stated_numbers_are_taken_as_they_are() -> None:
    plan = _proposed(("plan: {}", "plan: {targets: {count: 6}, runs: 3}")).plan
    assert (len(plan.targets), plan.runs) == (6, 3)


def test_listed_targets_are_taken_as_they_are() -> None:
    proposal = _proposed(("plan: {}", WHOLE_PITCHES))
    np.testing.assert_allclose(proposal.plan.targets, np.linspace(0, 0.6, 11))
    assert not proposal.has_fractions


def test_seed_follows_from_the_number_of_the_certificate() -> None:
    one = _proposed()
    again = _proposed()
    other = _proposed(("PLAN-1", "PLAN-2"))
    assert one.seed == make_seed_of("PLAN-1")
    np.testing.assert_array_equal(one.plan.targets, again.plan.targets)
    assert not np.any(one.plan.targets == other.plan.targets)


def test_stated_seed_is_used_whatever_the_number() -> None:
    seeded = ("plan: {}", "plan: {seed: 7}")
    one, other = _proposed(seeded), _proposed(seeded, ("PLAN-1", "PLAN-2"))
    np.testing.assert_array_equal(one.plan.targets, other.plan.targets)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ([(", travel: [0, 600]", "")], "job.yaml:3:1: axis.travel is missing"),
        (
            [("plan: {}", "plan: {targets: {count: 21, fractions_of: 100}}")],
            "job.yaml:9:8: plan.targets: 21 targets with fractions of a period do not fit",
        ),
        (
            [("plan: {}", "plan: {targets: {count: 600}}")],
            "job.yaml:9:1: plan: 600 targets in 5 runs are more than 5,000 readings",
        ),
        (
            [("plan: {}", "plan: {targets: {count: 3, positions: [0, 1]}}")],
            "job.yaml:9:28: plan.targets.positions: either positions, or a count",
        ),
        (
            [("plan: {}", "plan: {targets: {positions: [0, 2, 1]}}")],
            "job.yaml:9:18: plan.targets.positions: target positions rise",
        ),
        (
            [("plan: {}", "plan: {target: {count: 3}}")],
            "job.yaml:9:8: unknown key 'target' in plan; did you mean 'targets'?",
        ),
    ],
    ids=["no travel", "do not fit", "too many", "contradiction", "not rising", "unknown key"],
)
def test_mistake_is_told_at_its_place(changes: list[tuple[str, str]], message: str) -> None:
    assert message in refusal(_proposed, *changes)
