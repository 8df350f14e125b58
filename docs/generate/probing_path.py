"""The picture of the probing path of the example with a step gauge."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from zlmreport.figures.draw_path import path_svg
from zlmreport.job.loading import load
from zlmreport.language import Language
from zlmreport.plugins import find_plugins
from zlmreport.step_gauge.path_of_job import path_of_job

_JOB = Path(__file__).parents[2] / "configs" / "step-gauge" / "job.yaml"


def pictures() -> Mapping[str, str]:
    """Return the picture by the name of its file."""
    planned = path_of_job(load(_JOB, find_plugins()))
    return {"probing-path.svg": path_svg(planned, Language.ENGLISH)}
