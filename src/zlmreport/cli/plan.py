"""``zlmreport plan``: a test before it is done, and what it will not be able to see."""

from __future__ import annotations

from argparse import Namespace

from zlmreport import pipeline
from zlmreport.capture.of_job import options_of
from zlmreport.cli.plan_files import plan_files
from zlmreport.cli.plan_json import plan_values
from zlmreport.cli.plan_lines import plan_lines
from zlmreport.cli.plan_path import run_path
from zlmreport.cli.plan_programs import chosen_programs, program_files
from zlmreport.cli.terminal import print_json, shown_path
from zlmreport.files import Document, demand_free, write
from zlmreport.job.loading import load
from zlmreport.planning.planned_test import planned_test
from zlmreport.plugins import find_plugins


def run(options: Namespace) -> int:
    """Plan the test of a job; its readings need not exist."""
    registry = find_plugins(files=options.plugin)
    job = load(options.job, registry)
    if job.keys.step_gauge is not None:
        return run_path(options, job, registry)
    programs = chosen_programs(
        options.program, options.output, job.programs, registry.part_program, "linuxcnc,fanuc"
    )
    planned = planned_test(job, pipeline.standards(job, registry), registry.effects)
    documents: tuple[Document, ...] = ()
    if options.output:
        plan = planned.proposal.plan
        documents = (
            *plan_files(options.output, job, planned),
            *program_files(options.output, job, plan, programs, registry),
        )
    demand_free(document.path for document in documents)
    written = write(documents)
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
