"""The two renderers of PDF side by side: the same certificates set by WeasyPrint and by Typst."""

from __future__ import annotations

import gc
import sysconfig
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache, partial
from pathlib import Path
from tempfile import TemporaryDirectory

from alike import pages_of_same_document
from content import Content, content
from measure import (
    Cost,
    Measured,
    Sizes,
    alternately,
    cost_of_command,
    cpu,
    median,
    own_process,
    ratio,
    resident_megabytes,
    that_count,
    timed,
    wall,
)
from sample import write_job
from zlmreport.job.loading import load
from zlmreport.pipeline import compose, render, run
from zlmreport.plugin.registry import Registry, find_plugins

WEASYPRINT, TYPST = "pdf", "pdf-typst"

#: Of the plain recipe, for printing alone: in the layouts ``full`` and ``standard``.
_TARGETS = {WEASYPRINT: (0.40, 0.25), TYPST: (0.05, None)}


@dataclass(frozen=True, slots=True)
class _Made:
    """A certificate in one format: from the job to the file, and the printing alone of others, by layout."""

    whole: Cost
    printing: Cost
    in_standard: Cost
    pdf: bytes
    content: Content
    megabytes: float


@dataclass(frozen=True, slots=True)
class _Round:
    """One certificate by each renderer, and by the plain recipe."""

    made: Mapping[str, _Made]
    plain: Cost
    plain_pdf: bytes


def measure(sizes: Sizes) -> list[Measured]:
    """Measure each way in a process of its own, and all in turn; then the whole command, in turn too."""
    with TemporaryDirectory() as name:
        folder = Path(name)
        rounds = that_count(_rounds(folder, sizes.rounds))
        job = write_job(folder, "COLD-0001")
        command = Path(sysconfig.get_path("scripts"), "zlmreport")
        commands = {
            identifier: partial(
                cost_of_command,
                [command, job, "--output", folder / "out", "--format", identifier, "--quiet"],
            )
            for identifier in (WEASYPRINT, TYPST)
        }
        cold = alternately(commands, sizes.rounds)
    return list(_lines(rounds, cold))


def _rounds(folder: Path, number: int) -> list[_Round]:
    with own_process() as weasyprint, own_process() as typst, own_process() as plain:
        processes = {WEASYPRINT: weasyprint, TYPST: typst}
        rounds = []
        for count in range(number):
            jobs = [write_job(folder, f"{part}-{count:04}") for part in ("WHOLE", "PRINTED")]
            jobs.append(write_job(folder, f"STANDARD-{count:04}", "standard"))
            made = {
                identifier: process.submit(_made, identifier, *jobs).result()
                for identifier, process in processes.items()
            }
            cost, pdf = plain.submit(_by_plain_recipe, made[TYPST].content).result()
            rounds.append(_Round(made, cost, pdf))
    return rounds


def _lines(rounds: Sequence[_Round], cold: Mapping[str, Sequence[Cost]]) -> Iterator[Measured]:
    first = rounds[0]
    words = first.made[TYPST].content
    weasyprint_pdf, typst_pdf = (first.made[each].pdf for each in (WEASYPRINT, TYPST))
    pages = pages_of_same_document(words, weasyprint_pdf, typst_pdf)
    _, plain_pages = pages_of_same_document(words, weasyprint_pdf, first.plain_pdf)
    plain = cpu(each.plain for each in rounds)
    yield Measured("pages by the plain recipe", plain_pages)
    yield Measured("plain recipe, from the document", 1e3 * median(plain), "ms CPU")
    for identifier, number in zip((WEASYPRINT, TYPST), pages, strict=True):
        made = [each.made[identifier] for each in rounds]
        whole, printing = cpu(each.whole for each in made), cpu(each.printing for each in made)
        in_standard = cpu(each.in_standard for each in made)
        target, target_in_standard = _TARGETS[identifier]
        yield Measured(f"{identifier}: pages", number)
        yield Measured(f"{identifier}: size", len(made[0].pdf) / 1024, "kB")
        yield Measured(f"{identifier}: from the job", 1e3 * median(whole), "ms CPU")
        yield Measured(f"{identifier}: from the job / plain recipe", ratio(whole, plain))
        yield Measured(f"{identifier}: from the document", 1e3 * median(printing), "ms CPU")
        yield Measured(f"{identifier}: from the document / plain recipe", ratio(printing, plain), "", target)
        name = f"{identifier}: the layout standard from the document"
        yield Measured(name, 1e3 * median(in_standard), "ms CPU")
        yield Measured(f"{name} / plain recipe", ratio(in_standard, plain), "", target_in_standard)
        yield Measured(f"{identifier}: memory after {3 * (len(rounds) + 1)}", made[-1].megabytes, "MB")
        yield Measured(f"{identifier}: whole command, one certificate", median(wall(cold[identifier])), "s")
    both = [[each.made[identifier] for each in rounds] for identifier in (TYPST, WEASYPRINT)]
    typst, weasyprint = both
    yield Measured(
        f"{TYPST} / {WEASYPRINT}, from the job",
        ratio(cpu(each.whole for each in typst), cpu(each.whole for each in weasyprint)),
    )
    yield Measured(
        f"{TYPST} / {WEASYPRINT}, from the document",
        ratio(cpu(each.printing for each in typst), cpu(each.printing for each in weasyprint)),
    )
    yield Measured(f"{TYPST} / {WEASYPRINT}, whole command", ratio(wall(cold[TYPST]), wall(cold[WEASYPRINT])))


@cache
def _registry() -> Registry:
    return find_plugins()


def _made(identifier: str, whole: Path, printed: Path, in_standard: Path) -> _Made:
    """Make a certificate from its job, and print two others: Typst remembers what it has set."""
    registry = _registry()
    cost, outcome = timed(lambda: run(load(whole, registry, (identifier,)), registry))
    printing, standard = (_printing(identifier, each, registry) for each in (printed, in_standard))
    pdf = outcome.documents[0].content
    return _Made(cost, printing, standard, pdf, content(outcome.certificate), resident_megabytes())


def _printing(identifier: str, job: Path, registry: Registry) -> Cost:
    certificate = compose(load(job, registry, (identifier,)), registry)
    gc.collect()
    gc.disable()  # as in a run
    cost, _ = timed(lambda: render(certificate, [registry.renderer(identifier)], registry))
    gc.enable()
    return cost


def _by_plain_recipe(words: Content) -> tuple[Cost, bytes]:
    import plain  # noqa: PLC0415 - it changes matplotlib's configuration

    return timed(lambda: plain.certificate(words))
