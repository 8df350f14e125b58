"""One certificate after the other in processes that have made some before."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory

from alike import pages_of_same_document
from content import Content, content
from measure import Cost, Measured, Sizes, median, own_process, ratio, that_count, timed
from sample import write_job
from zlmreport.job.loading import load
from zlmreport.pipeline import compose
from zlmreport.plugins import Registry, find_plugins

#: For WeasyPrint with tags, graphs drawn by matplotlib and tables that are tables.
_TARGET = 0.40


@dataclass(frozen=True, slots=True)
class _Product:
    """A certificate by zlmreport: what its document and its PDF cost, and both."""

    document: Cost
    pdf: Cost
    content: Content
    graphs: int
    printed: bytes


@dataclass(frozen=True, slots=True)
class _Plain:
    """The same document by the plain recipe."""

    pdf: Cost
    printed: bytes


def measure(sizes: Sizes) -> list[Measured]:
    """Measure both recipes, each in a process of its own, in turn: A B A B."""
    made: list[tuple[_Product, _Plain]] = []
    with TemporaryDirectory() as folder, own_process() as one, own_process() as other:
        for number in range(sizes.rounds):
            job = write_job(Path(folder), f"WARM-{number:04}")
            ours = one.submit(_by_zlmreport, job).result()
            plain = other.submit(_by_plain_recipe, ours.content).result()
            made.append((ours, plain))
    rounds = that_count(made)
    pages, plain_pages = pages_of_same_document(ours.content, ours.printed, plain.printed)
    document = [ours.document.cpu for ours, _ in rounds]
    pdf = [ours.pdf.cpu for ours, _ in rounds]
    whole = [ours.document.cpu + ours.pdf.cpu for ours, _ in rounds]
    plain_pdf = [plain.pdf.cpu for _, plain in rounds]
    return [
        Measured("graphs", ours.graphs),
        Measured("pages by zlmreport", pages),
        Measured("pages by the plain recipe", plain_pages),
        Measured("zlmreport, job to document", 1e3 * median(document), "ms CPU"),
        Measured("zlmreport, document to PDF", 1e3 * median(pdf), "ms CPU"),
        Measured("plain recipe, document to PDF", 1e3 * median(plain_pdf), "ms CPU"),
        Measured("document to PDF, zlmreport / plain recipe", ratio(pdf, plain_pdf), "", _TARGET),
        Measured("job to PDF / plain recipe's document to PDF", ratio(whole, plain_pdf)),
        Measured(
            "zlmreport, job to PDF",
            1 / median(ours.document.wall + ours.pdf.wall for ours, _ in rounds),
            "per s",
        ),
        Measured("plain recipe, document to PDF", 1 / median(plain.pdf.wall for _, plain in rounds), "per s"),
    ]


@cache
def _registry() -> Registry:
    return find_plugins()


def _by_zlmreport(job: Path) -> _Product:
    registry = _registry()
    of_document, certificate = timed(lambda: compose(load(job, registry), registry))
    of_pdf, pdf = timed(lambda: registry.renderer("pdf").render(certificate))
    return _Product(of_document, of_pdf, content(certificate), len(certificate.figures), pdf)


def _by_plain_recipe(words: Content) -> _Plain:
    import plain  # noqa: PLC0415 - it changes matplotlib's configuration

    return _Plain(*timed(lambda: plain.certificate(words)))
