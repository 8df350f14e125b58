"""A job whose test is still to be done, to be changed in parts."""

from __future__ import annotations

from functools import cache
from pathlib import Path

from installed import registry
from replacing import replaced
from zlmreport import pipeline
from zlmreport.job.loading import load
from zlmreport.model.planning.planned_test import PlannedTest, describe_planned_test
from zlmreport.model.planning.visibility import SeenEffect
from zlmreport.plugin.extension import Job

JOB = """\
schema: zlmreport/job/1
certificate: {number: PLAN-1, kind: report}
axis: {name: X, travel: [0, 600], screw_pitch: 10}
measurement:
  method: linear
  feed: 3000
  dwell: 4
  source: {plugin: laser-csv, file: not-measured-yet.csv}
plan: {}
evaluate: ["iso230-2:2014"]
output: {formats: [json]}
"""
#: On whole pitches, as customers like to prescribe them.
WHOLE_PITCHES = "plan: {targets: {positions: [0, 60, 120, 180, 240, 300, 360, 420, 480, 540, 600]}}"
REGISTRY = registry()


def job_text(*changes: tuple[str, str]) -> str:
    """Return the job with parts of its text replaced."""
    return replaced(JOB, *changes)


def planned_job(*changes: tuple[str, str]) -> Job:
    return load(Path("job.yaml"), REGISTRY, content=job_text(*changes).encode())


@cache
def plan_of_test(*changes: tuple[str, str]) -> PlannedTest:
    job = planned_job(*changes)
    return describe_planned_test(job, pipeline.choose_standards(job, REGISTRY), REGISTRY.effects)


def sight_of(planned: PlannedTest, effect: str) -> SeenEffect:
    (found,) = (each for each in planned.seen_effects if each.effect.identifier == effect)
    return found
