"""``zlmreport model learn``: what the earlier tests in a folder say of noise and sizes of effects."""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

from zlmreport import pipeline
from zlmreport.cli.terminal import print_json, shown_path, table
from zlmreport.errors import AccessError, InputError, Place, ZlmreportError
from zlmreport.files import Document, read, reason, write
from zlmreport.job.evaluation_keys import PriorsKeys
from zlmreport.job.extends import JOB
from zlmreport.job.loading import load
from zlmreport.job.parse import LARGEST
from zlmreport.model.diagnosis import Verdict
from zlmreport.model.fit import Fit
from zlmreport.model.priors import learned
from zlmreport.model.study import Study
from zlmreport.plugins import Registry, find_plugins

_COMMAND = Place("zlmreport model learn")


def run(options: Namespace) -> int:
    """Learn from every test in a folder whose model describes its readings."""
    registry, folder = find_plugins(files=options.plugin), options.job
    if not folder.is_dir():
        raise AccessError.at(_COMMAND, f"{shown_path(folder)} is no folder of jobs")
    fits, told = _fits(sorted(folder.rglob("*.yaml")), registry)
    if not fits:
        reasons = "".join(f"\n  {name}: {why}" for name, why in told)
        raise InputError.at(
            _COMMAND,
            f"no job in {shown_path(folder)} has an error model that describes its readings{reasons}",
        )
    found = learned(fits)
    if options.output:
        write([Document(options.output, _text(found, folder.resolve().name).encode())])
    if options.json:
        print_json(found.model_dump(mode="json", by_alias=True))
        return 0
    if not options.output:
        print(_text(found, folder.resolve().name), end="")
        return 0
    print(*table(told, indent="  "), sep="\n")
    print(f"\n{found.tests} tests taught {shown_path(options.output)}")
    print(f"next: name it in a job: model: {{priors: {options.output.name}}}")
    return 0


def _fits(paths: list[Path], registry: Registry) -> tuple[list[Fit], list[tuple[str, str]]]:
    """Return the models that describe their readings, and what is to be said of each job."""
    fits: list[Fit] = []
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
            if fits and fits[0].design.axis.kind != job.axis.kind:
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
        fits.append(diagnosis.fit)
        told.append((name, "learned"))
    return fits, told


def _text(found: PriorsKeys, folder: str) -> str:
    """Return the file, with what it says beside it."""
    return "".join(f"{line}\n" for line in _lines(found, folder))


def _lines(found: PriorsKeys, folder: str) -> Iterator[str]:
    unit = "µm" if found.kind == "linear" else "″"
    yield f"# What {found.tests} tests in {folder} say of noise and sizes of effects: model.priors of a job."
    yield f"schema: {found.schema_}"
    yield f"kind: {found.kind}"
    yield f"tests: {found.tests}"
    yield "noise: # how probable each ratio of a shared variance to that of a single reading is"
    for source, keys in found.noise.items():
        ratios = ", ".join(f"{each:g}" for each in keys.ratios)
        probabilities = ", ".join(f"{each:.3f}" for each in keys.probabilities)
        yield f"  {source}: {{ratios: [{ratios}], probabilities: [{probabilities}]}}"
    yield f"effects: # what the rest of the model cannot imitate of each, root mean square, {unit}"
    for name, size in found.effects.items():
        yield f"  {name}: {{rms: {size.rms:.4g}, tests: {size.tests}}}"
