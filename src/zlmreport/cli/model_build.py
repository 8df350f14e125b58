"""What ``zlmreport model build`` prints: how the error fell, step by step, what is left, what to do next."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from zlmreport.cli.model_lines import find_next_step, measure_lines, write_needless_lines
from zlmreport.cli.terminal import lay_out_changes, lay_out_heading, wrap, wrap_steps
from zlmreport.document.subjects.fit import write_deviation
from zlmreport.job.edit import Edit
from zlmreport.job.job import Job
from zlmreport.language import Language
from zlmreport.measurement.units import write_behind
from zlmreport.model.diagnosis.building import Built, ModelStep, name_steps
from zlmreport.model.diagnosis.report import find_stated_fault, list_chances, write_statement_after_build

_ENGLISH = Language.ENGLISH


def build_lines(built: Built, job: Job, path: str, edit: Edit | None, *, is_tried: bool) -> Iterator[str]:
    """Yield the lines on a build; `path` is the job as the user types it."""
    names, last = name_steps(built.steps), built.last
    yield from lay_out_heading(job.keys.certificate.number, f"axis {job.axis.name}")
    yield from wrap_steps(_write_staircase(built))
    yield from wrap(write_statement_after_build(last, has_steps=bool(names)).in_language(_ENGLISH), "")
    if built.exchange is not None:
        coming, going = map(" and ".join, (built.exchange.coming, built.exchange.going))
        yield from wrap(
            f"{coming} in place of {going} would do as well: the readings do not tell which it is", ""
        )
    if built.doubts:
        chances = list_chances(built.doubts).in_language(_ENGLISH)
        yield from wrap(f"not sure: {chances}; else another effect, or something without a name", "")
    for question in built.questions:
        yield from wrap(question.in_language(_ENGLISH), "")
    yield from write_needless_lines(built.needless, path)
    yield from lay_out_changes(path, names if edit is not None else (), is_tried=is_tried)
    if is_tried and edit is not None and find_stated_fault(last) is None:
        yield f"next: zlmreport model build {path}"
    else:
        yield from measure_lines(last)
        yield f"next: {find_next_step(last, path)}"


def _write_staircase(built: Built) -> str:
    """Return how the error fell in one line: ``offset 5.4 → + backlash 3.2 µm; noise 0.7 µm``.

    What goes out for what comes in is one stair with it: on the way both were there, or neither.
    """
    axis = built.first.fit.design.axis
    unit = write_behind(axis.deviation_unit.symbol)
    began = " + ".join(built.first.fit.model.identifiers) or "without model"
    stairs = [f"{began} {write_deviation(built.first.error.rms, axis, _ENGLISH)}"]
    for flight in _unite_exchanges(built.steps):
        error = write_deviation(flight[-1].after.rms, axis, _ENGLISH)
        stairs.append(f"{', '.join(name_steps(flight))} {error}")
    floor = built.last.error.noise_rms
    noise = "" if floor is None else f"; noise {write_deviation(floor, axis, _ENGLISH)}{unit}"
    return f"{' → '.join(stairs)}{unit}{noise}"


def _unite_exchanges(steps: Sequence[ModelStep]) -> list[list[ModelStep]]:
    united: list[list[ModelStep]] = []
    for each in steps:
        if united and (each.is_removed or all(other.is_removed for other in united[-1])):
            united[-1].append(each)
        else:
            united.append([each])
    return united
