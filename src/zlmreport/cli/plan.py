"""``zlmreport plan``: a test before it is done, what it will not be able to see, and its part programs."""

from __future__ import annotations

import os
from argparse import Namespace
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

from zlmreport import pipeline
from zlmreport.cli.layout import lay_out_sections
from zlmreport.cli.terminal import lay_out_heading, print_json, say, show_path, wrap
from zlmreport.document.figures.sequence import draw_sequence
from zlmreport.document.subjects.plan import (
    collect_circle_plan,
    lay_out_circle_plan,
    plan_sections,
    plan_values,
    say_size_of_circle,
    say_size_of_plan,
)
from zlmreport.errors import AccessError, InputError, Place, Problem
from zlmreport.files import Document, write_new
from zlmreport.job.choices import Choice, ExtensionChoice, Find, choose_programs_by_name
from zlmreport.job.job import Job
from zlmreport.job.loading import load
from zlmreport.language import Language
from zlmreport.live.capture.of_job import find_options_of
from zlmreport.measurement.measurand import is_for
from zlmreport.model.diagnosis.study import Study
from zlmreport.model.planning.circle_path import CirclePath, plan_circle_path
from zlmreport.model.planning.deciding import (
    collect_experiment,
    make_deciding_number,
    plan_deciding_experiment,
    write_deciding_text,
)
from zlmreport.model.planning.planned_test import PlannedTest, describe_planned_test
from zlmreport.model.planning.programs import Motion, plan_motion_of
from zlmreport.model.planning.targets import convert_to_users_unit
from zlmreport.plugin.extending import Extension, ExtensionPlan
from zlmreport.plugin.protocols import PartProgram, find_circle_writer
from zlmreport.plugin.registry import Registry, find_plugins

DECISION = "zlmreport/decision/1"

_TEST = Place("zlmreport plan --test")


def run(options: Namespace) -> int:
    """Plan the test of a job; its readings need not exist."""
    if options.decide:
        return _decide(options)
    registry = find_plugins(files=options.plugin)
    job = load(options.job, registry).line(options.test, _TEST)
    if job.axis.circle:
        return plan_circle(options, job, registry)
    own = _plan_of_extension(job, registry)
    if own and options.run is not None:
        raise InputError.at(RUN, "this plan has no runs of its own; leave it out")
    if own:
        return _show_plan(options, job, registry, own)
    programs = choose_programs(options, job.programs, registry.part_program, registry.list_programs_for())
    demand_file(options, programs)
    effects = [each for each in registry.effects if is_for(each, job.axis.measurand)]
    planned = describe_planned_test(job, pipeline.choose_standards(job, registry), effects)
    documents: tuple[Document, ...] = ()
    if options.output:
        number = job.keys.certificate.number
        motion = partial(plan_motion_of, number, job.axis, planned.proposal.plan)
        if options.run is None:
            documents = (
                *_make_plan_files(options.output, job, planned),
                *make_program_files(
                    options.output, number, partial(write_program_of, motion), programs, registry.part_program
                ),
            )
        else:
            of_run = f"{number}-run-{options.run}"
            subject = partial(_find_motion_of_run, motion, options.run)
            documents = make_program_files(
                options.output, of_run, partial(write_program_of, subject), programs, registry.part_program
            )
    written = write_new(documents)
    if options.json:
        print_json(plan_values(job, planned, written))
        return 0
    number, size = job.keys.certificate.number, say(say_size_of_plan(planned))
    print(*lay_out_heading(number, f"axis {job.axis.name}: {size}"), sep="\n")
    print(*lay_out_sections(plan_sections(job, planned, Language.ENGLISH)), sep="\n")
    print()
    tell_written(options, programs, written)
    command = "zlmreport capture" if find_options_of(job) else "measure, then zlmreport"
    print(f"next: {command} {show_path(options.job)}")
    return 0


def _refuse_programs(options: Namespace) -> None:
    """Refuse programs of the experiment that decides: the plan of its own job has them."""
    given = next((name for name in ("program", "run") if getattr(options, name) is not None), None)
    if given:
        message = f"--{given} writes programs of this plan, and --decide the job of another: take one of them"
        raise InputError.at(Place("zlmreport plan"), message)


def _decide(options: Namespace) -> int:
    """Write or print the job of the experiment that decides between effects."""
    _refuse_programs(options)
    registry = find_plugins(files=options.plugin)
    job = load(options.job, registry).line(options.test, _TEST)
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
    experiment = plan_deciding_experiment(
        names, job, study, registry.effects, pipeline.choose_standards(job, registry)
    )
    folder = options.output or Path()
    documents: tuple[Document, ...] = ()
    if experiment.plan:
        extends = Path(os.path.relpath(options.job, folder)).as_posix()
        text = write_deciding_text(experiment, job, extends)
        if options.output:
            documents = (Document(folder / f"{make_deciding_number(job)}.yaml", text.encode()),)
    written = write_new(documents)
    if options.json:
        values = collect_experiment(experiment, job, Language.ENGLISH)
        print_json({"schema": DECISION, **values, "files": [str(path) for path in written]})
        return 0
    if experiment.plan and not options.output:
        print(text, end="")
    else:
        print(*wrap(say(experiment.statement), ""), sep="\n")
    for path in written:
        print(show_path(path))
        print(f"next: zlmreport plan {show_path(path)}")
    return 0


def _find_motion_of_run(motion: Callable[[Place], Motion], run: int, place: Place) -> Motion:
    return motion(place).of_run(run)


def _plan_of_extension(
    job: Job, registry: Registry
) -> tuple[Extension, ExtensionChoice, ExtensionPlan] | None:
    """Return the plan of the first extension of a job that plans its test; None if none does."""
    for choice in job.extensions:
        extension = registry.extension(choice.identifier)
        plan = extension.plan(job, choice.options)
        if plan:
            return extension, choice, plan
    return None


def _show_plan(
    options: Namespace, job: Job, registry: Registry, found: tuple[Extension, ExtensionChoice, ExtensionPlan]
) -> int:
    extension, choice, plan = found
    find = partial(registry.part_program, takes=extension.takes)
    known = registry.list_programs_for(extension.takes) if extension.takes else ()
    programs = choose_programs(options, choice.programs, find, known)
    number = job.keys.certificate.number
    documents: tuple[Document, ...] = ()
    if options.output:
        documents = (
            *(
                Document(options.output / f"{number}-{name}", text.encode())
                for name, text in plan.files().items()
            ),
            *make_program_files(
                options.output, number, partial(write_program_of, plan.subject), programs, find
            ),
        )
    written = write_new(documents)
    if options.json:
        print_json({**plan.values, "files": [str(path) for path in written]})
        return 0
    print(*_tell_extensions(plan), sep="\n")
    print()
    if not options.output:
        names = ", ".join(each.identifier for each in programs)
        wait = f", part programs for {names}" if names else ""
        print(f"{plan.files_in_words}{wait}: state a folder, --output DIR")
    for path in written:
        print(show_path(path))
    print(f"next: {plan.next_step}, then zlmreport {show_path(options.job)}")
    return 0


def _tell_extensions(plan: ExtensionPlan) -> Iterator[str]:
    name, rest = plan.heading
    yield from lay_out_heading(name, rest)
    for word, beside, sentences in plan.parts:
        yield ""
        yield from lay_out_heading(word, beside)
        for sentence in sentences:
            yield from wrap(sentence)


def _make_plan_files(folder: Path, job: Job, planned: PlannedTest) -> tuple[Document, ...]:
    """Return the files of a plan: its targets, a form for the readings, and a picture of its sequence.

    The form has a row for each reading in the order in which they are to be taken, its deviation empty, and
    empty columns for what should be logged; the data source ``laser-csv`` reads it filled in.
    """
    texts = {
        "targets.csv": "".join(f"{line}\n" for line in _list_targets(job, planned)),
        "readings.csv": "".join(f"{line}\n" for line in _list_readings(job, planned)),
        "sequence.svg": _draw_plan(job, planned),
    }
    number = job.keys.certificate.number
    return tuple(Document(folder / f"{number}-{name}", text.encode()) for name, text in texts.items())


def _draw_plan(job: Job, planned: PlannedTest) -> str:
    from zlmreport.document.figures.draw import to_svg  # noqa: PLC0415 (brings the typeface)

    keys = job.keys.certificate
    motion = plan_motion_of(keys.number, job.axis, planned.proposal.plan, job.place_of("plan"))
    return to_svg(draw_sequence(motion), keys.language)


def _list_targets(job: Job, planned: PlannedTest) -> Iterator[str]:
    yield "number,target"
    targets = convert_to_users_unit(job.axis, planned.proposal.plan.targets)
    yield from (f"{number},{target:.12g}" for number, target in enumerate(targets, start=1))


def _list_readings(job: Job, planned: PlannedTest) -> Iterator[str]:
    logs = ["time", *planned.logs]
    targets = convert_to_users_unit(job.axis, planned.proposal.plan.targets)
    unit = job.axis.deviation_unit.symbol
    yield f"# A form to fill in: deviation is actual - target, {unit}. Columns that nobody logs may go out."
    yield ",".join(["target", "direction", "run", "deviation", *logs])
    for visit in planned.visits:
        cells = [f"{targets[visit.target]:.12g}", visit.approach.sign, str(visit.run)]
        yield ",".join([*cells, "", *("" for _ in logs)])


def plan_circle(options: Namespace, job: Job, registry: Registry) -> int:
    """Write and print the path of a circular test: a program for each control and each feed."""
    programs = choose_programs(options, job.programs, registry.part_program, registry.list_programs_for())
    demand_file(options, programs)
    keys, number = job.keys, job.keys.certificate.number
    stated = keys.plan.circle.feeds if keys.plan.circle else []
    place = job.place_of("circle")
    paths = [plan_circle_path(job, place, feed) for feed in stated or (None,)]
    documents: list[Document] = []
    for path in paths if options.output else ():
        of_run = path if options.run is None else replace(path, place=RUN).of_run(options.run)
        parts = [
            number,
            *([] if options.run is None else [f"run-{options.run}"]),
            *([f"F{path.feed:g}"] if len(paths) > 1 else []),
        ]
        documents += make_program_files(
            options.output,
            "-".join(parts),
            partial(_write_program, registry, of_run),
            programs,
            registry.part_program,
        )
    written = write_new(tuple(documents))
    if options.json:
        print_json(collect_circle_plan(job, paths, written))
        return 0
    size = say(say_size_of_circle(paths[0]))
    print(*lay_out_heading(number, f"plane {job.axis.name}: {size}"), sep="\n")
    print(*lay_out_sections(lay_out_circle_plan(job, paths, Language.ENGLISH)), sep="\n")
    print()
    tell_written(options, programs, written)
    print(f"next: measure, then zlmreport {show_path(options.job)}")
    return 0


def _write_program(registry: Registry, path: CirclePath, program: PartProgram, choice: Choice) -> str:
    """Return the program of a circle; raise `InputError` where its writer writes none."""
    write = find_circle_writer(program)
    if write is None:
        known = [each.identifier for each in registry.list_programs_for() if find_circle_writer(each)]
        raise InputError.at(
            choice.place, f"{program.identifier} writes no circles; these do: {', '.join(known) or 'none'}"
        )
    return write(replace(path, place=choice.place), choice.options)


RUN = Place("zlmreport plan --run")
_OPTION = Place("zlmreport plan --program")


def demand_file(options: Namespace, programs: Sequence[Choice]) -> None:
    """Refuse to show a run that nobody asks to have written."""
    if options.run is not None and (not programs or not options.output):
        raise InputError.at(RUN, "the program of a run is a file; state --program NAME and --output DIR, too")


def write_program_of(subject: Callable[[Place], Any], program: PartProgram, choice: Choice) -> str:
    """Return the program of a subject, asked for where a program is named."""
    return program.write(subject(choice.place), choice.options)


def choose_programs(
    options: Namespace, stated: tuple[Choice, ...], find: Find, known: Sequence[PartProgram]
) -> tuple[Choice, ...]:
    """Return the programs that the command line names, or else those of the job.

    Raises `InputError` if there is none of that name, or no folder to write it into.
    """
    if options.program is None:
        return stated
    if options.output is None:
        raise InputError.at(_OPTION, "a program is a file; state its folder, too: --output DIR")
    names = [name.strip() for name in options.program.split(",") if name.strip()]
    if not names:
        such_as = ",".join(each.identifier for each in known[:2])
        raise InputError.at(_OPTION, f"there is no program in the list; for example {such_as}")
    return choose_programs_by_name(names, _OPTION, stated, find)


def tell_written(options: Namespace, programs: Sequence[Choice], written: Sequence[Path]) -> None:
    """Print the files of a plan; which programs there are, where nobody says into which folder."""
    if programs and not options.output:
        names = ", ".join(each.identifier for each in programs)
        print(f"part programs for {names}: state a folder, --output DIR")
    for path in written:
        print(show_path(path))


def make_program_files(
    folder: Path,
    number: str,
    write: Callable[[PartProgram, Choice], str],
    choices: Sequence[Choice],
    find: Callable[[str], PartProgram],
) -> tuple[Document, ...]:
    """Return the files of part programs.

    `write`: Returns the program that a writer writes with the keys of a choice, as `write_program_of` does.

    Raises `InputError` with everything that one of the controls or machines cannot be told.
    """
    problems: list[Problem] = []
    documents: list[Document] = []
    for choice in choices:
        program = find(choice.identifier)
        try:
            text = write(program, choice)
        except InputError as error:
            problems.extend(error.problems)
            continue
        documents.append(Document(folder / f"{number}{program.suffix}", text.encode("ascii")))
    if problems:
        raise InputError(problems)
    return tuple(documents)
