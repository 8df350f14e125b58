"""What ``zlmreport model build`` prints: how the error fell, step by step, what is left, what to do next."""

from __future__ import annotations

from collections.abc import Iterator

from zlmreport.cli.model_lines import find_next_step, measure_lines
from zlmreport.cli.terminal import lay_out_heading, wrap
from zlmreport.document.subjects.fit import write_deviation
from zlmreport.job.edit import Edit
from zlmreport.job.job import Job
from zlmreport.language import Language
from zlmreport.measurement.units import write_behind
from zlmreport.model.diagnosis.building import Built, name_steps
from zlmreport.model.diagnosis.report import write_statement_after_build

_ENGLISH = Language.ENGLISH


def build_lines(built: Built, job: Job, path: str, edit: Edit | None, *, is_tried: bool) -> Iterator[str]:
    """Yield the lines on a build; `path` is the job as the user types it."""
    names, last = name_steps(built.steps), built.last
    yield from lay_out_heading(job.keys.certificate.number, f"axis {job.axis.name}")
    yield from wrap(_write_staircase(built), "")
    yield from wrap(write_statement_after_build(last, has_steps=bool(names)).in_language(_ENGLISH), "")
    for question in built.questions:
        yield from wrap(question.in_language(_ENGLISH), "")
    for each in built.needless:
        yield from wrap(
            f"{each}: nothing of it exceeds its uncertainty, it may not be there; without it: "
            f"zlmreport model remove {path} {each}",
            "",
        )
    if edit is None:
        yield f"{path}: nothing to change"
    elif is_tried:
        yield f"{path}: left as it is; without --dry-run: {', '.join(names)}"
    else:
        yield f"{path}: {', '.join(names)}"
    if is_tried and edit is not None:
        yield f"next: zlmreport model build {path}"
    else:
        yield from measure_lines(last)
        yield f"next: {find_next_step(last, path)}"


def _write_staircase(built: Built) -> str:
    """Return how the error fell in one line: ``offset 5.4 → + backlash 3.2 µm; noise 0.7 µm``."""
    axis = built.first.fit.design.axis
    unit = write_behind(axis.deviation_unit.symbol)
    began = " + ".join(built.first.fit.model.identifiers) or "without model"
    errors = [built.first.error.rms, *(each.after.rms for each in built.steps)]
    stairs = [
        f"{name} {write_deviation(error, axis, _ENGLISH)}"
        for name, error in zip([began, *name_steps(built.steps)], errors, strict=True)
    ]
    floor = built.last.error.noise_rms
    noise = "" if floor is None else f"; noise {write_deviation(floor, axis, _ENGLISH)}{unit}"
    return f"{' → '.join(stairs)}{unit}{noise}"
