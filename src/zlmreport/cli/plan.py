"""``zlmreport plan``: a test before it is done, and what it will not be able to see."""

from __future__ import annotations

import math
import os
from argparse import Namespace
from collections.abc import Callable, Iterator, Sequence
from functools import partial
from pathlib import Path
from typing import Any

from zlmreport import pipeline
from zlmreport.capture.of_job import options_of
from zlmreport.cli.plan_lines import plan_lines
from zlmreport.cli.terminal import Colour, print_json, said, shown_path, wrapped
from zlmreport.errors import AccessError, InputError, Place, Problem
from zlmreport.figures.sequence import sequence
from zlmreport.files import Document, write_new
from zlmreport.job.choices import Choice, ExtensionChoice, Find, programs_by_name
from zlmreport.job.job import Job
from zlmreport.job.loading import load
from zlmreport.language import Language
from zlmreport.measurement.axis import Axis
from zlmreport.model.effect import unit_of
from zlmreport.model.study import Study
from zlmreport.planning.deciding import deciding_experiment, deciding_number, deciding_text, experiment_values
from zlmreport.planning.planned_test import PlannedTest, planned_test
from zlmreport.planning.programs import Motion, motion_of
from zlmreport.planning.targets import in_users_unit
from zlmreport.planning.visibility import Remedy, SeenEffect
from zlmreport.plugin.extension import Extension, ExtensionPlan
from zlmreport.plugin.protocols import PartProgram
from zlmreport.plugins import Registry, find_plugins

SCHEMA, DECISION = "zlmreport/plan/1", "zlmreport/decision/1"
_RUN = Place("zlmreport plan --run")

_OPTION = Place("zlmreport plan --program")


def run(options: Namespace) -> int:
    """Plan the test of a job; its readings need not exist."""
    registry = find_plugins(files=options.plugin)
    job = load(options.job, registry)
    if options.decide:
        return _decide(options, job, registry)
    own = _plan_of_extension(job, registry)
    if own and options.run is not None:
        raise InputError.at(_RUN, "this plan has no runs of its own; leave it out")
    if own:
        return _show_plan(options, job, registry, own)
    programs = chosen_programs(
        options.program, options.output, job.programs, registry.part_program, registry.programs_for()
    )
    if options.run is not None and (not programs or not options.output):
        raise InputError.at(
            _RUN, "the program of a run is a file; state --program NAME and --output DIR, too"
        )
    planned = planned_test(job, pipeline.standards(job, registry), registry.effects)
    documents: tuple[Document, ...] = ()
    if options.output:
        number = job.keys.certificate.number
        motion = partial(motion_of, number, job.axis, planned.proposal.plan)
        if options.run is None:
            documents = (
                *plan_files(options.output, job, planned),
                *program_files(options.output, number, motion, programs, registry.part_program),
            )
        else:
            of_run = f"{number}-run-{options.run}"
            subject = partial(_motion_of_run, motion, options.run)
            documents = program_files(options.output, of_run, subject, programs, registry.part_program)
    written = write_new(documents)
    if options.json:
        print_json(plan_values(job, planned, written))
        return 0
    print(*plan_lines(job, planned), sep="\n")
    print()
    if programs and not options.output:
        names = ", ".join(each.identifier for each in programs)
        print(f"part programs for {names}: state a folder, --output DIR")
    for path in written:
        print(shown_path(path))
    command = "zlmreport capture" if options_of(job) else "measure, then zlmreport"
    print(f"next: {command} {shown_path(options.job)}")
    return 0


def _decide(options: Namespace, job: Job, registry: Registry) -> int:
    """Write or print the job of the experiment that decides between effects."""
    names = [name.strip() for name in options.decide.split(",") if name.strip()]
    study: Study | None = None
    try:
        study = Study.of(
            job, pipeline.read(job, registry), registry.effects, pipeline.read_sessions(job, registry)
        )
    except AccessError:
        file = getattr(job.source.options, "file", None)
        if file is None or Path(file).exists():
            raise
    experiment = deciding_experiment(names, job, study, registry.effects, pipeline.standards(job, registry))
    folder = options.output or Path()
    documents: tuple[Document, ...] = ()
    if experiment.plan:
        extends = Path(os.path.relpath(options.job, folder)).as_posix()
        text = deciding_text(experiment, job, extends)
        if options.output:
            documents = (Document(folder / f"{deciding_number(job)}.yaml", text.encode()),)
    written = write_new(documents)
    if options.json:
        values = experiment_values(experiment, job, Language.ENGLISH)
        print_json({"schema": DECISION, **values, "files": [str(path) for path in written]})
        return 0
    if experiment.plan and not options.output:
        print(text, end="")
    else:
        print(*wrapped(said(experiment.statement), ""), sep="\n")
    for path in written:
        print(shown_path(path))
        print(f"next: zlmreport plan {shown_path(path)}")
    return 0


def _motion_of_run(motion: Callable[[Place], Motion], run: int, place: Place) -> Motion:
    return motion(place).of_run(run)


def plan_values(job: Job, planned: PlannedTest, written: Sequence[Path]) -> dict[str, Any]:
    """Return a plan as plain values for JSON."""
    axis, proposal = job.axis, planned.proposal
    plan, position = proposal.plan, axis.position_unit
    targets = in_users_unit(axis, plan.targets)
    return {
        "schema": SCHEMA,
        "certificate": {"number": job.keys.certificate.number},
        "axis": {"name": axis.name, "kind": axis.kind.value},
        "units": {"position": position.ascii, "deviation": axis.deviation_unit.ascii, "time": "s"},
        "method": plan.method.value,
        "runs": plan.runs,
        "overrun": round(position.from_si(plan.overrun), 9),
        "feed_per_minute": round(position.from_si(plan.feed) * 60, 9),
        "dwell": plan.dwell,
        "seed": proposal.seed if proposal.has_fractions else None,
        "assumed": sorted(proposal.assumed),
        "expected": {
            "repeatability": axis.deviation_unit.from_si(proposal.expected.sigma),
            "temperature_change": proposal.expected.temperature_change,
        },
        "travelled": position.from_si(planned.travelled),
        "duration": planned.duration,
        "targets": targets,
        "two_phases_of": [said(period) for period in planned.half_seen],
        "visits": [
            {
                "target": targets[visit.target],
                "direction": visit.approach.sign,
                "run": visit.run,
                "time": time,
            }
            for visit, time in zip(planned.visits, planned.design.time.tolist(), strict=True)
        ],
        "model": list(planned.model.identifiers),
        "visibility": [
            _seen_effect(each, planned.remedies.get(each.effect.identifier), axis)
            for each in planned.seen_effects
        ],
        "log": [{"column": column, "effects": names} for column, names in planned.logs.items()],
        "requirements": [
            {
                "standard": designation,
                "requirement": said(finding.requirement),
                "found": said(finding.found),
                "met": finding.met,
            }
            for designation, findings in planned.findings.items()
            for finding in findings
        ],
        "files": [str(path) for path in written],
    }


def _seen_effect(found: SeenEffect, remedy: Remedy | None, axis: Axis) -> dict[str, Any]:
    seen = found.visibility
    smallest = None
    if seen.smallest is not None and math.isfinite(seen.smallest[1]):
        parameter, value = seen.smallest
        unit = unit_of(parameter.dimension, axis.kind)
        smallest = {"name": parameter.name, "value": value * unit.per_si, "unit": unit.ascii}
    return {
        "effect": seen.effect,
        "sight": found.sight.value,
        "share": seen.share,
        "smallest_rms": axis.deviation_unit.from_si(seen.smallest_rms)
        if math.isfinite(seen.smallest_rms)
        else None,
        "smallest": smallest,
        "log": list(found.logs),
        "reason": None if seen.reason is None else said(seen.reason),
        "remedy": None
        if remedy is None
        else {
            "reason": None if remedy.reason is None else said(remedy.reason),
            "advice": said(remedy.advice),
            "share": remedy.share,
        },
    }


def _plan_of_extension(
    job: Job, registry: Registry
) -> tuple[Extension, ExtensionChoice, ExtensionPlan] | None:
    """Return the plan of the first extension of a job that plans its test; None if none does."""
    for extension, choice in registry.extensions_of(job):
        plan = extension.plan(job, choice.options)
        if plan:
            return extension, choice, plan
    return None


def _show_plan(
    options: Namespace,
    job: Job,
    registry: Registry,
    found: tuple[Extension, ExtensionChoice, ExtensionPlan],
) -> int:
    """Write and print a plan."""
    extension, choice, plan = found
    find = partial(registry.part_program, takes=extension.takes)
    known = registry.programs_for(extension.takes) if extension.takes else ()
    programs = chosen_programs(options.program, options.output, choice.programs, find, known)
    number = job.keys.certificate.number
    documents: tuple[Document, ...] = ()
    if options.output:
        documents = (
            *(
                Document(options.output / f"{number}-{name}", text.encode())
                for name, text in plan.files().items()
            ),
            *program_files(options.output, number, plan.subject, programs, find),
        )
    written = write_new(documents)
    if options.json:
        print_json({**plan.values, "files": [str(path) for path in written]})
        return 0
    print(*_extension_lines(plan), sep="\n")
    print()
    if not options.output:
        names = ", ".join(each.identifier for each in programs)
        wait = f", part programs for {names}" if names else ""
        print(f"{plan.files_in_words}{wait}: state a folder, --output DIR")
    for path in written:
        print(shown_path(path))
    print(f"next: {plan.next_step}, then zlmreport {shown_path(options.job)}")
    return 0


def _extension_lines(plan: ExtensionPlan) -> Iterator[str]:
    name, rest = plan.heading
    yield f"{Colour.BOLD.of(name)}  {rest}"
    for word, beside, sentences in plan.parts:
        yield ""
        yield f"{Colour.BOLD.of(word)}  {beside}"
        for sentence in sentences:
            yield from wrapped(sentence)


def plan_files(folder: Path, job: Job, planned: PlannedTest) -> tuple[Document, ...]:
    """Return the files of a plan: its targets, a form for the readings, and a picture of its sequence.

    The form has a row for each reading in the order in which they are to be taken, its deviation empty, and
    empty columns for what should be logged; the data source ``laser-csv`` reads it filled in.
    """
    texts = {
        "targets.csv": "".join(f"{line}\n" for line in _targets(job, planned)),
        "readings.csv": "".join(f"{line}\n" for line in _readings(job, planned)),
        "sequence.svg": _picture(job, planned),
    }
    number = job.keys.certificate.number
    return tuple(Document(folder / f"{number}-{name}", text.encode()) for name, text in texts.items())


def _picture(job: Job, planned: PlannedTest) -> str:
    from zlmreport.figures.draw import to_svg  # noqa: PLC0415 (brings the typeface)

    keys = job.keys.certificate
    motion = motion_of(keys.number, job.axis, planned.proposal.plan, job.place_of("plan"))
    return to_svg(sequence(motion), keys.language)


def _targets(job: Job, planned: PlannedTest) -> Iterator[str]:
    yield "number,target"
    targets = in_users_unit(job.axis, planned.proposal.plan.targets)
    yield from (f"{number},{target:.12g}" for number, target in enumerate(targets, start=1))


def _readings(job: Job, planned: PlannedTest) -> Iterator[str]:
    logs = ["time", *planned.logs]
    targets = in_users_unit(job.axis, planned.proposal.plan.targets)
    unit = job.axis.deviation_unit.symbol
    yield f"# A form to fill in: deviation is actual - target, {unit}. Columns that nobody logs may go out."
    yield ",".join(["target", "direction", "run", "deviation", *logs])
    for visit in planned.visits:
        cells = [f"{targets[visit.target]:.12g}", visit.approach.sign, str(visit.run)]
        yield ",".join([*cells, "", *("" for _ in logs)])


def chosen_programs(
    named: str | None,
    folder: Path | None,
    stated: tuple[Choice, ...],
    find: Find,
    known: Sequence[PartProgram],
) -> tuple[Choice, ...]:
    """Return the programs that the command line names, or else those of the job.

    `named`: Identifiers on the command line, parted by commas; None if there are none.

    Raises `InputError` if there is none of that name, or no folder to write it into.
    """
    if named is None:
        return stated
    if folder is None:
        raise InputError.at(_OPTION, "a program is a file; state its folder, too: --output DIR")
    names = [name.strip() for name in named.split(",") if name.strip()]
    if not names:
        such_as = ",".join(each.identifier for each in known[:2])
        raise InputError.at(_OPTION, f"there is no program in the list; for example {such_as}")
    return programs_by_name(names, _OPTION, stated, find)


def program_files(
    folder: Path,
    number: str,
    subject: Callable[[Place], Any],
    choices: Sequence[Choice],
    find: Callable[[str], PartProgram],
) -> tuple[Document, ...]:
    """Return the files of part programs.

    `subject`: Returns what the programs are written of, asked for at a place.

    Raises `InputError` with everything that one of the controls or machines cannot be told.
    """
    problems: list[Problem] = []
    documents: list[Document] = []
    for choice in choices:
        program = find(choice.identifier)
        try:
            text = program.write(subject(choice.place), choice.options)
        except InputError as error:
            problems.extend(error.problems)
            continue
        documents.append(Document(folder / f"{number}{program.suffix}", text.encode("ascii")))
    if problems:
        raise InputError(problems)
    return tuple(documents)
