"""``zlmreport plan`` of a circular test: its path, and part programs at each feed."""

from __future__ import annotations

from argparse import Namespace
from dataclasses import replace
from functools import partial

from zlmreport.cli.layout import lay_out_sections
from zlmreport.cli.part_programs import RUN, choose_programs, demand_file, make_program_files, tell_written
from zlmreport.cli.terminal import lay_out_heading, print_json, say, show_path
from zlmreport.document.subjects.circle_plan import (
    collect_circle_plan,
    lay_out_circle_plan,
    say_size_of_circle,
)
from zlmreport.errors import InputError
from zlmreport.files import Document, write_new
from zlmreport.job.choices import Choice
from zlmreport.job.job import Job
from zlmreport.language import Language
from zlmreport.model.planning.circle_path import CirclePath, plan_circle_path
from zlmreport.plugin.protocols import PartProgram, find_circle_writer
from zlmreport.plugin.registry import Registry


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
