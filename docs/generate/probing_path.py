"""The picture of the probing path of the example with a step gauge."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from zlmreport.job.loading import load
from zlmreport.language import Language
from zlmreport.plugin.registry import find_plugins
from zlmreport_step_gauge.paths.foretold import draw_path
from zlmreport_step_gauge.paths.plan import plan_path_of_job

_JOB = Path(__file__).parents[2] / "configs" / "step-gauge" / "job.yaml"


def pictures() -> Mapping[str, str]:
    """Return the picture by the name of its file."""
    job = load(_JOB, find_plugins())
    planned = plan_path_of_job(job, job.own_keys("step_gauge"))
    return {"probing-path.svg": draw_path(planned, Language.ENGLISH)}
