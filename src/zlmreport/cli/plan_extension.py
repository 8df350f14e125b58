"""``zlmreport plan`` for a job whose test an extension plans."""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Iterator
from functools import partial

from zlmreport.cli.plan_files import chosen_programs, program_files
from zlmreport.cli.terminal import Colour, print_json, shown_path, wrapped
from zlmreport.files import Document, demand_free, write
from zlmreport.job.job import ExtensionChoice, Job
from zlmreport.plugin.extension import Extension, ExtensionPlan
from zlmreport.plugins import Registry


def plan_of_extension(
    job: Job, registry: Registry
) -> tuple[Extension, ExtensionChoice, ExtensionPlan] | None:
    """Return the plan of the first extension of a job that plans its test; None if none does."""
    for extension, choice in registry.extensions_of(job):
        plan = extension.plan(job, choice.options)
        if plan:
            return extension, choice, plan
    return None


def show_plan(
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
    demand_free(document.path for document in documents)
    written = write(documents)
    if options.json:
        print_json({**plan.values, "files": [str(path) for path in written]})
        return 0
    print(*_lines(plan), sep="\n")
    print()
    if not options.output:
        names = ", ".join(each.identifier for each in programs)
        wait = f", part programs for {names}" if names else ""
        print(f"{plan.files_in_words}{wait}: state a folder, --output DIR")
    for path in written:
        print(shown_path(path))
    print(f"next: {plan.next_step}, then zlmreport {shown_path(options.job)}")
    return 0


def _lines(plan: ExtensionPlan) -> Iterator[str]:
    name, rest = plan.heading
    yield f"{Colour.BOLD.of(name)}  {rest}"
    for word, beside, sentences in plan.parts:
        yield ""
        yield f"{Colour.BOLD.of(word)}  {beside}"
        for sentence in sentences:
            yield from wrapped(sentence)
