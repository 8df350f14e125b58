"""``zlmreport model learn``: what the earlier tests in a folder say of noise and sizes of effects."""

from __future__ import annotations

from argparse import Namespace
from dataclasses import replace
from pathlib import Path

from zlmreport import pipeline
from zlmreport.cli.terminal import print_json, shown_path, table
from zlmreport.errors import AccessError, InputError, Place, ZlmreportError
from zlmreport.files import Document, read, reason, write
from zlmreport.job.extends import JOB
from zlmreport.job.loading import load
from zlmreport.job.parse import LARGEST
from zlmreport.model.diagnosis import Verdict
from zlmreport.model.priors import Lesson, as_text, learned
from zlmreport.model.study import Study
from zlmreport.plugins import Registry, find_plugins

_COMMAND = Place("zlmreport model learn")


def run(options: Namespace) -> int:
    """Learn from every test in a folder whose model describes its readings."""
    registry, folder = find_plugins(files=options.plugin), options.job
    if not folder.is_dir():
        raise AccessError.at(_COMMAND, f"{shown_path(folder)} is no folder of jobs")
    lessons, told = _lessons(sorted(folder.rglob("*.yaml")), registry)
    if not lessons:
        reasons = "".join(f"\n  {name}: {why}" for name, why in told)
        raise InputError.at(
            _COMMAND,
            f"no job in {shown_path(folder)} has an error model that describes its readings{reasons}",
        )
    found = learned(lessons)
    if options.output:
        write([Document(options.output, as_text(found, folder.resolve().name).encode())])
    if options.json:
        print_json(found.model_dump(mode="json", by_alias=True))
        return 0
    if not options.output:
        print(as_text(found, folder.resolve().name), end="")
        return 0
    print(*table(told, indent="  "), sep="\n")
    print(f"\n{found.tests} tests taught {shown_path(options.output)}")
    print(f"next: name it in a job: model: {{priors: {options.output.name}}}")
    return 0


def _lessons(paths: list[Path], registry: Registry) -> tuple[list[Lesson], list[tuple[str, str]]]:
    """Return what tests teach whose models describe their readings, and what is to be said of each job."""
    lessons: list[Lesson] = []
    told: list[tuple[str, str]] = []
    seen: dict[tuple[str, ...], str] = {}
    for path in paths:
        name = shown_path(path)
        try:
            if JOB.schema.encode() not in read(path, LARGEST):
                continue  # what jobs extend, a simulation, a fleet
            job = load(path, registry)
            if not job.effects:
                told.append((name, "left out: it has no error model"))
                continue
            alone = replace(job, sessions=(), priors=None)
            measurements = pipeline.read(alone, registry)
            readings = tuple(each.sha256 for each in measurements.provenance.files)
            if readings in seen:
                told.append((name, f"left out: the readings of {seen[readings]}"))
                continue
            if lessons and lessons[0].kind != job.axis.kind:
                told.append((name, f"left out: its axis is {job.axis.kind}"))
                continue
            diagnosis = Study.of(alone, measurements, registry.effects).diagnosis(registry.effects)
        except ZlmreportError as error:
            told.append((name, f"left out: {error.problems[0].message}"))
            continue
        except OSError as error:  # of the file itself: a pipe, a folder of this name, nobody's to read
            told.append((name, f"left out: it cannot be read: {reason(error)}"))
            continue
        if diagnosis.verdict is not Verdict.ADEQUATE:
            told.append((name, f"left out: its model is not adequate ({diagnosis.verdict})"))
            continue
        seen[readings] = name
        lessons.append(Lesson.of(diagnosis.fit))
        told.append((name, "learned"))
    return lessons, told
