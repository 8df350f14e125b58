"""A file of another kind is named for what it is."""

from __future__ import annotations

from pathlib import Path

from installed import registry
from refusals import refused
from zlmreport.job.loading import load
from zlmreport.job.simulation import load_simulation

CONFIGS = Path(__file__).parents[2] / "configs"


def test_a_simulation_is_no_job_and_its_own_command_is_named():
    (problem,) = refused(load, CONFIGS / "hidden-effect" / "simulation.yaml", registry()).problems
    assert problem.message == (
        "this file is the description of a simulated test (zlmreport/simulation/1), and a job is expected; "
        "zlmreport simulate takes it"
    )


def test_a_job_is_no_simulation():
    (problem,) = refused(load_simulation, CONFIGS / "hidden-effect" / "job.yaml", registry()).problems
    assert "this file is a job (zlmreport/job/1)" in problem.message
