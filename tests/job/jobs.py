"""A sound job, to be spoilt line by line."""

from __future__ import annotations

from functools import cache
from pathlib import Path

from jsonschema import Draft202012Validator
from pydantic import BaseModel

from offers import exemplary_registry
from zlmreport import ZlmreportError
from zlmreport.job.loading import load
from zlmreport.job.schema import make_job_schema
from zlmreport.job.types import find_model_in
from zlmreport.plugin.extension import Job
from zlmreport.plugin.registry import Registry

SOUND = """\
schema: zlmreport/job/1
certificate:
  number: CAL-1
  kind: report
  language: en
machine: {serial: 17}
axis: {name: X, kind: linear, travel: [0, 300]}
measurement:
  date: 2026-11-18
  source:
    plugin: exemplary-text
    file: six.txt
evaluate:
  - {standard: "exemplary:1", tolerances: {E: 20}}
output: {directory: out, formats: [exemplary]}
"""
REGISTRY = exemplary_registry()


def with_line(number: int, line: str) -> str:
    """Return the sound job with one of its lines replaced."""
    lines = SOUND.splitlines()
    lines[number - 1] = line
    return "\n".join(lines) + "\n"


def with_lines(*lines: str) -> str:
    """Return the sound job with lines after its last."""
    return SOUND + "\n".join(lines) + "\n"


def loaded(text: str | bytes, folder: Path) -> Job:
    """Load a job of this text."""
    path = folder / "job.yaml"
    path.write_bytes(text.encode() if isinstance(text, str) else text)
    return load(path, REGISTRY)


def mistakes(text: str | bytes, folder: Path) -> list[str]:
    """Return the messages on a job, without its folder; none if it is sound."""
    try:
        loaded(text, folder)
    except ZlmreportError as error:
        return [str(problem).removeprefix(f"{folder}/") for problem in error.problems]
    return []


@cache
def make_editor(registry: Registry = REGISTRY) -> Draft202012Validator:
    """Return what holds a job against the schema, as editors do."""
    return Draft202012Validator(make_job_schema(registry), format_checker=Draft202012Validator.FORMAT_CHECKER)


def list_groups(model: type[BaseModel]) -> set[type[BaseModel]]:
    """Return a group of keys and all groups in it."""
    found = {model}
    for field in model.model_fields.values():
        for annotation in [field.annotation, *getattr(field.annotation, "__args__", ())]:
            part = find_model_in(annotation)
            if part:
                found |= list_groups(part)
    return found
